//! The JSON Schema of recipes, for editors: made from the types that read them, the built-in defaults and `titles.yaml`.
//!
//! Each value may be what the type reads, a distribution where the section is drawn, or a `$name`. The schema is no judge:
//! `check` knows more.

mod probe;

use serde_json::{Map, Value, json};

use self::probe::{Shape, shape_of};
use super::header::{Output, Splits};
use super::sections::ObjectEntry;
use crate::catalog::LicencePolicy;
use crate::image::ImageModel;
use crate::label::LabelSettings;
use crate::physics::TurbidWater;
use crate::recipe::{DEFAULTS, Node, Origin, parse};
use crate::scene::{EnvironmentSpec, Multipath, SeabedSpec};
use crate::sonar::Sonar;
use crate::vehicle::{Trajectory, Vehicle};

const TITLES: &str = include_str!("titles.yaml");

/// Units by the end of a key; the longest first.
const UNITS: [(&str, &str); 15] = [
    ("_db_per_decade", "dB per decade of range"),
    ("_db_per_m", "dB per metre of slant range"),
    ("_kg_m3", "kilograms a cubic metre"),
    ("_deg_s", "degrees a second"),
    ("_m_s", "metres a second"),
    ("_khz", "kHz"),
    ("_ppt", "parts per thousand"),
    ("_deg", "degrees"),
    ("_ms", "milliseconds"),
    ("_db", "dB"),
    ("_px", "pixels"),
    ("_pixels", "pixels"),
    ("_m", "metres"),
    ("_s", "seconds"),
    ("_c", "degrees Celsius"),
];

/// Whether a section's values may be distributions.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Drawn {
    Yes,
    No,
}

/// The schema, as pretty JSON with a line break at its end.
///
/// # Panics
/// Never: the texts that it is made from are part of the program and tested.
#[must_use]
pub fn schema() -> String {
    let built_in = |name, text| parse(name, text, Origin::BuiltIn).expect("built-in YAML: tested");
    let writer = Writer { titles: built_in("titles", TITLES), defaults: built_in("defaults", DEFAULTS) };
    let mut text = serde_json::to_string_pretty(&writer.recipe()).expect("a schema is plain data");
    text.push('\n');
    text
}

struct Writer {
    titles: Node,
    defaults: Node,
}

impl Writer {
    fn recipe(&self) -> Value {
        let mut keys = Map::new();
        keys.insert("ensonify".to_owned(), self.titled("ensonify", json!({"const": 1})));
        for (key, kind) in
            [("name", Shape::Text), ("seed", Shape::Whole), ("scenes", Shape::Whole), ("frames", Shape::Whole)]
        {
            keys.insert(key.to_owned(), self.value(key, &kind, Drawn::No));
        }
        keys.insert("include".to_owned(), self.titled("include", json!({"type": "string"})));
        keys.insert("let".to_owned(), self.titled("let", json!({"type": "object"})));
        keys.insert("sweep".to_owned(), self.sweep());
        for (key, shape, drawn) in [
            ("sonar", shape_of::<Sonar>(), Drawn::Yes),
            ("water", shape_of::<TurbidWater>(), Drawn::Yes),
            ("seabed", shape_of::<SeabedSpec>(), Drawn::Yes),
            ("environment", shape_of::<EnvironmentSpec>(), Drawn::Yes),
            ("multipath", shape_of::<Multipath>(), Drawn::Yes),
            ("vehicle", shape_of::<Vehicle>(), Drawn::Yes),
            ("trajectory", shape_of::<Trajectory>(), Drawn::Yes),
            ("image", shape_of::<ImageModel>(), Drawn::Yes),
            ("licences", shape_of::<LicencePolicy>(), Drawn::No),
            ("labels", shape_of::<LabelSettings>(), Drawn::No),
            ("splits", shape_of::<Splits>(), Drawn::No),
            ("output", shape_of::<Output>(), Drawn::No),
        ] {
            keys.insert(key.to_owned(), self.value(key, &shape, drawn));
        }
        keys.insert("objects".to_owned(), self.objects());
        keys.insert("looks".to_owned(), self.looks(&keys));
        json!({
            "$schema": "http://json-schema.org/draft-07/schema#",
            "title": "Recipe of ensonify",
            "description": "A YAML recipe that becomes a labelled sonar dataset.",
            "type": "object",
            "properties": keys,
            "required": ["ensonify"],
            "additionalProperties": false,
            "definitions": definitions(),
        })
    }

    fn sweep(&self) -> Value {
        let lists = |path: &str| {
            let values = json!({"type": "object", "additionalProperties": {"type": "array", "minItems": 1}});
            self.titled(path, values)
        };
        let count = self.titled("sweep.count", json!({"type": "integer", "minimum": 1}));
        let keys = json!({"grid": lists("sweep.grid"), "zip": lists("sweep.zip"), "count": count});
        self.titled("sweep", json!({"type": "object", "properties": keys, "additionalProperties": false}))
    }

    fn objects(&self) -> Value {
        let Shape::Map(mut keys) = shape_of::<ObjectEntry>() else { unreachable!("an object is read from a map") };
        keys.push(("count", Shape::Whole));
        let item = self.bare("objects[]", &Shape::Map(keys), Drawn::Yes);
        let list = json!({"type": "array", "items": either(vec![item, json!({"$ref": "#/definitions/choice"})])});
        self.titled("objects", either(vec![list, json!({"$ref": "#/definitions/name"}), json!({"type": "null"})]))
    }

    /// A look has the sections of the recipe that it may change.
    fn looks(&self, keys: &Map<String, Value>) -> Value {
        let name = self.titled("looks[].name", json!({"type": "string", "pattern": "^[A-Za-z0-9-]{1,40}$"}));
        let keys = json!({"name": name, "water": keys["water"], "image": keys["image"]});
        let item = json!({"type": "object", "properties": keys, "required": ["name"], "additionalProperties": false});
        self.titled("looks", json!({"type": "array", "minItems": 1, "items": item}))
    }

    /// What may stand at a path: a value, a distribution, a name; with title, unit, default and example.
    fn value(&self, path: &str, shape: &Shape, drawn: Drawn) -> Value {
        let mut forms = vec![self.bare(path, shape, drawn)];
        if drawn == Drawn::Yes {
            forms.push(json!({"$ref": format!("#/definitions/{}", distribution(shape))}));
        }
        forms.push(json!({"$ref": "#/definitions/name"}));
        self.titled(path, either(forms))
    }

    /// A value of a shape.
    fn bare(&self, path: &str, shape: &Shape, drawn: Drawn) -> Value {
        let item = |path: &str, item: &Shape| {
            let mut forms = vec![self.bare(path, item, drawn)];
            if drawn == Drawn::Yes {
                forms.push(json!({"$ref": format!("#/definitions/{}", distribution(item))}));
            }
            forms.push(json!({"$ref": "#/definitions/name"}));
            either(forms)
        };
        match shape {
            Shape::Bool => json!({"type": "boolean"}),
            Shape::Whole => json!({"type": "integer"}),
            Shape::Number => json!({"type": "number"}),
            Shape::Text => json!({"type": "string"}),
            Shape::Unseen | Shape::Nothing => json!({"type": ["object", "null"], "maxProperties": 0}),
            Shape::Any => form_of(path),
            Shape::Optional(inner) => either(vec![self.bare(path, inner, drawn), json!({"type": "null"})]),
            Shape::List(inner) => json!({"type": "array", "items": item(&format!("{path}[]"), inner)}),
            Shape::Tuple(count, inner) => {
                json!({"type": "array", "items": item(path, inner), "minItems": count, "maxItems": count})
            }
            Shape::Map(entries) => {
                let keys: Map<String, Value> = entries
                    .iter()
                    .map(|(key, shape)| ((*key).to_owned(), self.value(&below(path, key), shape, drawn)))
                    .collect();
                json!({"type": "object", "properties": keys, "additionalProperties": false})
            }
            Shape::Kinds(kinds) => self.kinds(path, kinds, drawn),
        }
    }

    /// A bare word, or a map of one kind with its parameters.
    fn kinds(&self, path: &str, kinds: &[(&'static str, Shape)], drawn: Drawn) -> Value {
        let words: Vec<&str> = kinds.iter().map(|(kind, _)| *kind).collect();
        if kinds.iter().all(|(_, shape)| *shape == Shape::Nothing) {
            return json!({"enum": words});
        }
        let parameters = |(kind, shape): &(&'static str, Shape)| {
            let path = below(path, kind);
            let forms = vec![self.bare(&path, shape, drawn), json!({"type": "null"})];
            ((*kind).to_owned(), self.titled(&path, either(forms)))
        };
        let keys: Map<String, Value> = kinds.iter().map(parameters).collect();
        let map = json!({
            "type": "object", "properties": keys, "additionalProperties": false, "minProperties": 1, "maxProperties": 1
        });
        either(vec![json!({"enum": words}), map])
    }

    /// A schema with what is known of its path.
    fn titled(&self, path: &str, mut schema: Value) -> Value {
        let key = path.rsplit('.').next().unwrap_or(path);
        let Value::Object(entries) = &mut schema else { return schema };
        let words = self.title(path);
        if let Some(title) = words.and_then(|words| words.items().first()) {
            entries.insert("title".to_owned(), title.json());
        }
        if let Some((_, unit)) = UNITS.iter().find(|(end, _)| key.ends_with(end)) {
            entries.insert("description".to_owned(), json!(format!("Unit: {unit}.")));
        }
        if let Some(example) = words.and_then(|words| words.items().get(1)) {
            entries.insert("examples".to_owned(), json!([example.json()]));
        }
        if let Some(default) = self.default_of(path) {
            entries.insert("default".to_owned(), default);
        }
        schema
    }

    fn title(&self, path: &str) -> Option<&Node> {
        let key = path.rsplit('.').next().unwrap_or(path);
        self.titles.get(path).or_else(|| self.titles.get(key))
    }

    /// The built-in default of a path: of the values, of an optional section, or of a kind.
    fn default_of(&self, path: &str) -> Option<Value> {
        let leaf = |node: &Node| (node.entries().is_empty() || node.is_distribution()).then(|| node.json());
        let parts =
            ["sections", "kinds"].iter().flat_map(|part| self.defaults.get(part).map_or(&[][..], Node::entries));
        let inside =
            parts.filter_map(|(pattern, values)| values.at(path.strip_prefix(&pattern.text)?.strip_prefix('.')?));
        self.defaults.at(path).into_iter().chain(inside).find_map(leaf)
    }
}

/// The forms of values that are told apart by the reader.
fn form_of(path: &str) -> Value {
    let number = either(vec![
        json!({"type": "number"}),
        json!({"$ref": "#/definitions/number"}),
        json!({"$ref": "#/definitions/name"}),
    ]);
    match path.rsplit('.').next() {
        Some("look_at" | "centre" | "of") => either(vec![
            json!({"enum": ["objects", "origin"]}),
            json!({"type": "array", "items": number, "minItems": 3, "maxItems": 3}),
        ]),
        Some("frames") => {
            either(vec![json!({"enum": ["all"]}), json!({"type": "array", "items": {"type": "integer"}})])
        }
        Some("uid") => either(vec![json!({"type": "string"}), json!({"type": "array", "items": {"type": "string"}})]),
        _ => json!({}),
    }
}

fn either(forms: Vec<Value>) -> Value {
    json!({"anyOf": forms})
}

fn below(path: &str, key: &str) -> String {
    format!("{path}.{key}")
}

/// The distributions that may stand for a shape.
fn distribution(shape: &Shape) -> &'static str {
    match shape {
        Shape::Number | Shape::Whole => "number",
        Shape::Optional(inner) => distribution(inner),
        _ => "choice",
    }
}

/// Distributions and names.
fn definitions() -> Value {
    let number = json!({"anyOf": [{"type": "number"}, {"$ref": "#/definitions/name"}]});
    let pair = json!({"type": "array", "items": number, "minItems": 2, "maxItems": 2});
    let per = json!({"enum": ["dataset", "scene", "frame"], "title": "How often it is drawn"});
    let law = |word: &str, title: &str, example: Value| {
        let keys = json!({word: pair, "per": per});
        json!({
            "title": title, "type": "object", "properties": keys, "required": [word], "additionalProperties": false,
            "examples": [example]
        })
    };
    let mut normal = law("normal", "Normal: mean and standard deviation", json!({"normal": [10, 2], "min": 0}));
    normal["properties"]["min"] = number.clone();
    normal["properties"]["max"] = number.clone();
    let choices = json!({"anyOf": [
        {"type": "array", "minItems": 1},
        {"type": "object", "minProperties": 1, "additionalProperties": number},
        {"$ref": "#/definitions/name"}
    ]});
    let keys = json!({"choice": choices, "weights": {"type": "array", "items": number}, "per": per});
    let choice = json!({
        "title": "One of several values, a list or a map of weights", "type": "object", "properties": keys,
        "required": ["choice"], "additionalProperties": false, "examples": [{"choice": {"silt": 1, "gravel": 3}}]
    });
    json!({
        "name": {"title": "A name of `let`", "type": "string", "pattern": "^\\$[A-Za-z][A-Za-z0-9_-]*$"},
        "choice": choice,
        "number": {"anyOf": [
            law("uniform", "Equally likely between two ends", json!({"uniform": [4, 22]})),
            law("log_uniform", "The logarithm equally likely between two ends", json!({"log_uniform": [0.1, 10]})),
            normal,
            law("int", "Whole numbers, both ends included", json!({"int": [1, 3]})),
            {"$ref": "#/definitions/choice"}
        ]}
    })
}

#[cfg(test)]
mod tests;
