//! The form that a language model fills in: flat, short words, few fields that it must have.
//!
//! Made for small models: what is not said is left out, so a whole answer is a line or two.

use serde::{Deserialize, Serialize};

use super::shape::Shape;

/// A request as a model understands it. What it does not say is `None` or empty.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct Answer {
    pub images: Option<u64>,
    pub objects: Vec<Item>,
    pub bottom: Option<Bottom>,
    pub depth_m: Option<f64>,
    pub depth_most_m: Option<f64>,
    pub shape: Option<Relief>,
    pub structure: Option<Structure>,
    pub water: Option<Clarity>,
    pub temperature_c: Option<f64>,
    pub salinity_ppt: Option<f64>,
    pub without: Option<Vec<String>>,
    pub sonar: Option<String>,
    pub frequency_khz: Option<f64>,
    pub beams: Option<u32>,
    pub fov_deg: Option<f64>,
    pub range_m: Option<f64>,
    pub tilt_deg: Option<f64>,
    pub way: Option<Way>,
    pub altitude_m: Option<f64>,
    pub distance_m: Option<f64>,
    pub distance_most_m: Option<f64>,
    pub spacing_m: Option<f64>,
    pub length_m: Option<f64>,
    pub train: Option<f64>,
    pub val: Option<f64>,
    pub test: Option<f64>,
    pub looks: Option<Vec<LookWord>>,
    pub refusal: Option<String>,
}

/// An object.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct Item {
    pub name: String,
    pub count: Option<u32>,
    pub count_most: Option<u32>,
    pub stand: Option<StandWord>,
    pub buried: Option<f64>,
    pub over_bottom_m: Option<f64>,
}

/// A closed list of words: the enum, and all of it in the order that a model sees.
macro_rules! words {
    ($(#[$doc:meta])* $name:ident { $($word:ident),+ $(,)? }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
        #[serde(rename_all = "kebab-case")]
        pub(super) enum $name { $($word),+ }

        impl $name {
            fn shape() -> Shape {
                let all = [$(Self::$word),+];
                Shape::word(all.map(|word| match serde_json::to_value(word) {
                    Ok(serde_json::Value::String(text)) => text,
                    _ => unreachable!("a word without fields is a text"),
                }))
            }
        }
    };
}

words!(
    /// What the bottom is made of.
    Bottom { Mud, Silt, Clay, Sand, Gravel, Cobbles, Rock }
);
words!(
    /// The form of the bottom.
    Relief { Flat, Ripples, SandWaves, Slope, Rocks, Rubble, Reef, Trench }
);
words!(
    /// What is built there.
    Structure { Pier, Dam, Harbour, Tank, Pipeline, NetPen }
);
words!(
    /// How clear the water is.
    Clarity { Clear, SlightlyTurbid, Turbid, VeryTurbid }
);
words!(
    /// How an object is placed.
    StandWord { Upright, OnItsSide, Dumped, Buried, Floating, Moored, InAHeap, InARow, Leaning }
);
words!(
    /// How the vehicle moves.
    Way { Around, Lawnmower, Follow, Approach, ManySides, Hover, Dive }
);
words!(
    /// A picture of the same echoes that differs.
    LookWord { NoNoise, LittleNoise, MediumNoise, StrongNoise, ClearWater, TurbidWater }
);

/// The form of the whole answer.
pub(super) fn shape() -> Shape {
    let metres = |most| Shape::Number(0.0, most);
    let name = || Shape::Text(40);
    let share = || Shape::Number(0.0, 100.0);
    let item = Shape::Record(vec![
        name().always("name"),
        Shape::Whole(0, 10_000).or_null().always("count"),
        Shape::Whole(1, 10_000).where_said("count_most"),
        StandWord::shape().where_said("stand"),
        Shape::Number(0.0, 1.0).where_said("buried"),
        metres(200.0).where_said("over_bottom_m"),
    ]);
    Shape::Record(vec![
        Shape::Whole(0, 1_000_000_000).or_null().always("images"),
        item.list(12).always("objects"),
        Bottom::shape().or_null().always("bottom"),
        metres(11_000.0).or_null().always("depth_m"),
        metres(11_000.0).where_said("depth_most_m"),
        Relief::shape().where_said("shape"),
        Structure::shape().where_said("structure"),
        Clarity::shape().where_said("water"),
        Shape::Number(-2.0, 40.0).where_said("temperature_c"),
        Shape::Number(0.0, 45.0).where_said("salinity_ppt"),
        name().list(8).where_said("without"),
        name().where_said("sonar"),
        Shape::Number(1.0, 5000.0).where_said("frequency_khz"),
        Shape::Whole(1, 4096).where_said("beams"),
        Shape::Number(1.0, 360.0).where_said("fov_deg"),
        Shape::Number(0.1, 500.0).where_said("range_m"),
        Shape::Number(-90.0, 90.0).where_said("tilt_deg"),
        Way::shape().where_said("way"),
        metres(200.0).where_said("altitude_m"),
        metres(200.0).where_said("distance_m"),
        metres(200.0).where_said("distance_most_m"),
        metres(100.0).where_said("spacing_m"),
        metres(1000.0).where_said("length_m"),
        share().where_said("train"),
        share().where_said("val"),
        share().where_said("test"),
        LookWord::shape().list(6).where_said("looks"),
        Shape::Text(120).where_said("refusal"),
    ])
}

#[cfg(test)]
mod tests {
    use super::super::Reply;
    use super::super::parse::parse;
    use super::*;

    fn parsed(text: &str) -> Result<Answer, Vec<String>> {
        parse(&Reply { text: text.into(), is_cut: false }, &shape())
    }

    #[test]
    fn every_field_of_the_form_is_one_of_the_answer() {
        let all = r#"{"images": 5, "objects": [{"name": "tire", "count": 2, "count_most": 3, "stand": "in-a-heap", "buried": 0.5,
            "over_bottom_m": 1}], "bottom": "mud", "depth_m": 5, "depth_most_m": 9, "shape": "sand-waves", "structure": "net-pen",
            "water": "very-turbid", "temperature_c": 4, "salinity_ppt": 35, "without": ["anchor"], "sonar": "didson",
            "frequency_khz": 1800, "beams": 96, "fov_deg": 29, "range_m": 10, "tilt_deg": -20, "way": "many-sides",
            "altitude_m": 2, "distance_m": 3, "distance_most_m": 4, "spacing_m": 2, "length_m": 20, "train": 80, "val": 10,
            "test": 10, "looks": ["no-noise"], "refusal": null}"#;
        let answer = parsed(all).expect("an answer");
        assert_eq!(
            (answer.images, answer.objects[0].stand, answer.way),
            (Some(5), Some(StandWord::InAHeap), Some(Way::ManySides))
        );
        let Shape::Record(fields) = shape() else { panic!("a record") };
        for field in fields {
            assert!(all.contains(&format!("\"{}\"", field.name)), "{}", field.name);
        }
    }

    #[test]
    fn what_is_beyond_the_form_is_told() {
        let least = |more: &str| format!(r#"{{"images": 5, "objects": [], "bottom": null, "depth_m": null{more}}}"#);
        assert!(parsed(&least("")).is_ok());
        for (more, told) in [
            (r#", "bottom": "lava""#, "bottom: `lava` is none of mud, silt"),
            (r#", "depth_m": -12"#, "depth_m: -12 is not between 0 and 11000"),
            (r#", "files": "/etc/passwd""#, "`files` is no field"),
            (r#", "way": "lawnmower", "path": "!include /etc/passwd""#, "`path` is no field"),
            (r#", "beams": 2.5"#, "beams: a whole number is wanted"),
        ] {
            let problems = parsed(&least(more)).expect_err(more);
            assert!(problems.iter().any(|problem| problem.contains(told)), "{more}: {problems:?}");
        }
        let many = format!(r#"{{"objects": [{}]}}"#, vec![r#"{"name": "tire", "count": 1}"#; 13].join(","));
        let problems = parsed(&many).expect_err("too many");
        assert!(problems.contains(&"objects: 13 are too many, at most 12".to_owned()), "{problems:?}");
        assert!(problems.contains(&"`images` is missing".to_owned()), "{problems:?}");
    }
}
