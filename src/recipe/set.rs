//! Changing one value of a tree by its path: `--set sonar.range_m=[0.5, 10]`, or a cell of a sweep.

use super::error::{Error, quoted};
use super::merge::word;
use super::node::{Kind, Node};
use super::parse::parse_part;
use super::path::{self, Step, steps};
use super::source::{Origin, Source, Span};

impl Node {
    /// Puts the YAML text `value` at `path`; maps on the way that are not there yet are made.
    ///
    /// # Errors
    /// A path that leads nowhere, a value that is not YAML; located as `--set:1:column` in `path=value`.
    pub fn set(&mut self, path: &str, value: &str) -> Result<(), Error> {
        let source = Source::new("--set", &format!("{path}={value}"), Origin::Given);
        let shift = path.chars().count() as u32 + 1;
        if value.trim().is_empty() {
            let span = Span { source, line: 1, column: shift + 1 };
            return Err(Error::new(&span, path, "the value is missing", "write path=value; null is a value too"));
        }
        let value = parse_part(&source, value, shift)?;
        self.put(path, value, &Span { source, line: 1, column: 1 })
    }

    /// Puts a value at `path`, which was written at `span`; maps on the way that are not there yet are made.
    ///
    /// # Errors
    /// A path that leads nowhere; located at `span`.
    pub fn put(&mut self, path: &str, value: Self, span: &Span) -> Result<(), Error> {
        let fault = |message: String, help: &str| Error::new(span, "", message, help);
        let example = "write a path such as sonar.range_m or objects[0].count";
        let steps =
            steps(path).map_err(|why| fault(format!("the path {} is not one: {why}", quoted(path)), example))?;
        if steps.is_empty() {
            return Err(fault("the path is empty".to_owned(), example));
        }
        if steps.len() > super::parse::MAX_DEPTH {
            return Err(fault("the path is too deep".to_owned(), example));
        }
        let mut node = self;
        let mut walked = String::new();
        for step in steps {
            let (next, here) = match &step {
                Step::Key(key) => (node.entry(key, span), path::under(&walked, key)),
                Step::Index(index) => (node.item_mut(*index), path::item(&walked, *index)),
            };
            node = next.map_err(|(message, help)| Error::new(span, &walked, message, help))?;
            walked = here;
        }
        *node = value;
        Ok(())
    }

    /// The value under a key, made if it is not there. A bare word becomes the map of its kind: `ripples` is `{ripples: {}}`.
    fn entry(&mut self, key: &str, span: &Span) -> Result<&mut Self, (String, String)> {
        let is_bare_kind = self.text() == Some(key);
        if is_bare_kind || self.kind == Kind::Null {
            self.kind = Kind::Map(Vec::new());
        }
        let found = self.describe();
        let Kind::Map(entries) = &mut self.kind else {
            return Err((format!("{found} has no key {}", quoted(key)), "set the whole value instead".to_owned()));
        };
        let index = entries.iter().position(|(k, _)| k.text == key).unwrap_or_else(|| {
            entries.push((word(key, span), Self { kind: Kind::Null, span: span.clone() }));
            entries.len() - 1
        });
        Ok(&mut entries[index].1)
    }

    fn item_mut(&mut self, index: usize) -> Result<&mut Self, (String, String)> {
        let (found, count) = (self.describe(), self.items().len());
        let help = match count {
            0 => "set the whole list instead".to_owned(),
            _ => format!("the items are [0] to [{}]", count - 1),
        };
        match &mut self.kind {
            Kind::Seq(items) => items.get_mut(index).ok_or((format!("there is no item [{index}]"), help)),
            _ => Err((format!("{found} has no item [{index}]"), help)),
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::recipe::{Origin, parse};

    const TEXT: &str = "{water: {depth_m: 5}, objects: [{count: 1}], seabed: {shape: ripples}, looks: }";

    fn set(path: &str, value: &str) -> Result<String, String> {
        let mut tree = parse("a", TEXT, Origin::Given).unwrap();
        match tree.set(path, value) {
            Ok(()) => Ok(tree.json().to_string()),
            Err(error) => Err(error.to_string().lines().next().unwrap().to_owned()),
        }
    }

    #[test]
    fn values_are_put_and_maps_are_made() {
        for (path, value, part) in [
            ("water.depth_m", "{uniform: [1, 2]}", r#""depth_m":{"uniform":[1,2]}"#),
            ("objects[0].count", "3", r#"[{"count":3}]"#),
            ("sonar.mount.pitch_deg", "-3", r#""sonar":{"mount":{"pitch_deg":-3}}"#),
            ("seabed.shape.ripples.height_m", "1", r#""shape":{"ripples":{"height_m":1}}"#),
            ("looks.a", "b", r#""looks":{"a":"b"}"#),
            ("water", "null", r#""water":null"#),
            ("[\"x.y\"]", "1", r#""x.y":1"#),
        ] {
            assert!(set(path, value).unwrap().contains(part), "{path}={value}: {:?}", set(path, value));
        }
    }

    #[test]
    fn what_cannot_be_set_is_refused() {
        for (path, value, message) in [
            ("", "1", "--set:1:1: the path is empty"),
            ("a..b", "1", "--set:1:1: the path `a..b` is not one: a key is missing"),
            ("water.depth_m.x", "1", "--set:1:1: the number 5 has no key `x` in water.depth_m"),
            ("objects[2].count", "1", "--set:1:1: there is no item [2] in objects"),
            ("water[0]", "1", "--set:1:1: a map has no item [0] in water"),
            ("water.depth_m", " ", "--set:1:15: the value is missing in water.depth_m"),
            ("water.depth_m", "[1, .inf]", "--set:1:19: infinity and not-a-number are no values of a recipe: `.inf`"),
            ("water.depth_m", "{a: 1, a: 2}", "--set:1:22: the key `a` stands twice"),
        ] {
            assert_eq!(set(path, value).unwrap_err(), message);
        }
    }

    #[test]
    fn a_set_value_is_located_in_its_setting() {
        let mut tree = parse("a", TEXT, Origin::Given).unwrap();
        tree.set("water.depth_m", "[1, two]").unwrap();
        let error = tree.get("water").unwrap().get("depth_m").unwrap().to::<[f64; 2]>("water.depth_m").unwrap_err();
        assert_eq!((error.file(), error.line(), error.column()), ("--set", Some(1), Some(19)));
        assert_eq!(error.source_line(), Some("water.depth_m=[1, two]"));
    }
}
