//! Each thing that a prompt says, held against the plan of what was drafted from it.

use std::fmt::Display;

use serde_json::Value;

use crate::drafted::{Body, Drafted, kind, text};
use crate::expected::{Case, Kinds, Vocabulary};
use crate::number::{Grain, Number, Words};
use crate::ways;

/// What became of a prompt.
pub enum Outcome {
    Drafted(Box<Drafted>),
    Refused(String),
    /// A recipe that `check` refuses: never right.
    Invalid(String),
}

/// One field: whether it is as expected.
pub struct Mark {
    pub field: String,
    pub right: bool,
    pub expected: String,
    pub found: String,
}

/// Scores every field of a case.
pub fn score(case: &Case, outcome: &Outcome, words: &Vocabulary) -> Vec<Mark> {
    let mut sheet = Sheet { drafted: None, words, marks: Vec::new() };
    match (outcome, &case.refused) {
        (Outcome::Refused(message), Some(expected)) => {
            let message = message.to_lowercase();
            for word in expected {
                let right = word.split('|').any(|either| message.contains(&either.to_lowercase()));
                sheet.mark("refused", right, word, &message);
            }
        }
        (Outcome::Drafted(_), Some(expected)) => sheet.all_wrong(expected.len(), "refused", "a recipe"),
        (Outcome::Invalid(fault), Some(expected)) => sheet.all_wrong(expected.len(), "refused", fault),
        (Outcome::Drafted(drafted), None) => {
            sheet.drafted = Some(drafted);
            sheet.fields(case);
        }
        (Outcome::Refused(fault) | Outcome::Invalid(fault), None) => {
            sheet.fields(case);
            sheet.marks.iter_mut().for_each(|mark| fault.clone_into(&mut mark.found));
        }
    }
    sheet.marks
}

/// What is scored. Without a draft each field is asked all the same, and none is right.
struct Sheet<'a> {
    drafted: Option<&'a Drafted>,
    words: &'a Vocabulary,
    marks: Vec<Mark>,
}

impl<'a> Sheet<'a> {
    fn mark(&mut self, field: &str, right: bool, expected: impl Display, found: impl Display) {
        let right = right && (self.drafted.is_some() || field == "refused");
        let (expected, found) = (expected.to_string(), found.to_string());
        self.marks.push(Mark { field: field.into(), right, expected, found });
    }

    fn all_wrong(&mut self, fields: usize, field: &str, found: &str) {
        (0..fields).for_each(|_| self.mark(field, false, field, found));
    }

    fn fields(&mut self, case: &Case) {
        self.dataset(case);
        self.objects(case);
        self.poses(case);
        self.world(case);
        self.sonar(case);
        self.way(case);
    }

    fn dataset(&mut self, case: &Case) {
        let of = |measure: fn(&Drafted) -> f64| self.drafted.map(measure).into_iter().collect::<Vec<f64>>();
        let images = of(|drafted| drafted.jobs().len() as f64 / drafted.variants() as f64);
        let versions = of(|drafted| (drafted.looks() * drafted.variants()) as f64);
        let scenes = of(|drafted| drafted.at("/scenes_per_variant").as_f64().unwrap_or_default());
        let seed = of(|drafted| drafted.at("/seed").as_f64().unwrap_or_default());
        self.number("images", case.images.as_ref(), &images, Grain::Counted);
        self.number("versions", case.versions.as_ref(), &versions, Grain::Counted);
        self.number("scenes", case.scenes.as_ref(), &scenes, Grain::Counted);
        self.number("seed", case.seed.as_ref(), &seed, Grain::Counted);
        if let Some(name) = &case.name {
            let found = self.drafted.map_or("", |drafted| text(drafted.at("/name")));
            self.mark("name", found == name, name, found);
        }
        for (section, expected) in [("splits", &case.splits), ("output", &case.output)] {
            for (key, expected) in expected {
                let found = self.drafted.map_or(&Value::Null, |drafted| drafted.at(&format!("/{section}/{key}")));
                self.mark(&format!("{section}.{key}"), same(expected, found), expected, found);
            }
        }
    }

    fn objects(&mut self, case: &Case) {
        for (word, expected) in &case.objects {
            let counts = self.counts(word);
            let known = self.drafted.map(labels);
            let found = format!("{} of {}", short(&counts), known.unwrap_or_default());
            self.mark(&format!("objects.{word}"), expected.counts(&counts), expected, found);
        }
        for word in &case.without {
            let counts = self.counts(word);
            self.mark(&format!("without.{word}"), counts.iter().all(|&count| count == 0.0), 0, short(&counts));
        }
    }

    fn counts(&self, word: &str) -> Vec<f64> {
        let scenes = self.drafted.map_or(&[] as &[Value], Drafted::scenes);
        scenes.iter().map(|scene| self.things(scene, word).len() as f64).collect()
    }

    fn things(&self, scene: &'a Value, word: &str) -> Vec<Body<'a>> {
        let Some(drafted) = self.drafted else { return Vec::new() };
        drafted.bodies(scene).filter(|body| drafted.is(body, word, self.words)).collect()
    }

    /// Poses of all that a word stands for, in all scenes.
    fn poses_of(&self, word: &str) -> Vec<(&'a str, &'a Value)> {
        let scenes = self.drafted.map_or(&[] as &[Value], Drafted::scenes);
        scenes.iter().flat_map(|scene| self.things(scene, word)).map(|body| body.pose).collect()
    }

    fn poses(&mut self, case: &Case) {
        for (word, expected) in &case.pose {
            let found = self.poses_of(word);
            self.kinds(&format!("pose.{word}"), expected, &found);
        }
        for (word, expected) in &case.burial {
            let found: Vec<f64> = self.poses_of(word).iter().filter_map(|(_, of)| of["burial"].as_f64()).collect();
            self.number(&format!("burial.{word}"), Some(expected), &found, Grain::Measured);
        }
        for (word, expected) in &case.floating {
            let found: Vec<f64> = self.poses_of(word).iter().filter_map(|pose| afloat(*pose)).collect();
            self.number(&format!("floating.{word}"), Some(expected), &found, Grain::Measured);
        }
        for (word, expected) in &case.tipped {
            let found: Vec<f64> = self.poses_of(word).iter().map(|(_, of)| tipped(of)).collect();
            self.number(&format!("tipped.{word}"), Some(expected), &found, Grain::Measured);
        }
        for word in &case.lying {
            let poses = self.poses_of(word);
            let found = poses.iter().map(|(name, _)| *name).collect::<Vec<_>>();
            self.mark(
                &format!("lying.{word}"),
                poses.iter().any(|pose| afloat(*pose).is_none()),
                "lying",
                several(&found),
            );
        }
    }

    fn world(&mut self, case: &Case) {
        let drafted = self.drafted;
        let of_scenes = move |pointer: &str| drafted.map(|drafted| drafted.of_scenes(pointer)).unwrap_or_default();
        if let Some(expected) = &case.sediment {
            let own = of_scenes("/seabed/sediment");
            let floors = of_scenes("/environment/sediment");
            let shapes = of_scenes("/seabed/shape");
            let found: Vec<&str> =
                own.iter().zip(floors).map(|(own, floor)| text(if own.is_null() { floor } else { own })).collect();
            let fits = |(at, sediment): (usize, &&str)| {
                let wanted = expected.all().iter().flat_map(|word| self.sediments(word)).collect::<Vec<_>>();
                wanted.contains(&(*sediment).to_owned()) || wanted.contains(&kind(shapes[at]).0.to_owned())
            };
            let right = !found.is_empty() && found.iter().enumerate().all(fits);
            self.mark("sediment", right, several(expected.all()), several(&found));
        }
        if let Some(expected) = &case.shape {
            let found: Vec<_> = of_scenes("/seabed/shape").into_iter().map(kind).collect();
            self.kinds("shape", expected, &found);
        }
        if let Some(expected) = &case.environment {
            let found: Vec<_> = of_scenes("/environment/kind").into_iter().map(kind).collect();
            self.kinds("environment", expected, &found);
        }
        if let Some(mirror) = &case.multipath {
            let found = of_scenes(&format!("/multipath/{mirror}"));
            let right = !found.is_empty() && found.iter().all(|mirror| !mirror.is_null());
            self.mark("multipath", right, mirror, found.first().map_or("none".into(), ToString::to_string));
        }
        self.water(case);
    }

    fn sediments(&self, word: &str) -> Vec<String> {
        self.words.sediments.get(word).cloned().unwrap_or_else(|| vec![word.to_owned()])
    }

    fn water(&mut self, case: &Case) {
        for (field, expected) in
            [("depth_m", &case.depth_m), ("temperature_c", &case.temperature_c), ("salinity_ppt", &case.salinity_ppt)]
        {
            let found = self.drafted.map(|drafted| drafted.of_looks(&format!("/water/{field}"))).unwrap_or_default();
            self.number(field, expected.as_ref(), &numbers(&found), Grain::Measured);
        }
        if let Some(expected) = &case.turbidity {
            let found = self.drafted.map(|drafted| drafted.of_looks("/water/turbidity")).unwrap_or_default();
            let found: Vec<&str> = found.into_iter().map(|value| kind(value).0).collect();
            self.one_of("turbidity", expected, &found);
        }
    }

    fn sonar(&mut self, case: &Case) {
        let of = |pointer: &str| self.drafted.map(|drafted| drafted.of_jobs(pointer)).unwrap_or_default();
        let devices: Vec<&str> = of("/sonar/device").into_iter().map(text).collect();
        let pitch: Vec<f64> = self.drafted.map(ways::pitches).unwrap_or_default();
        let measured = [
            ("frequency_khz", &case.frequency_khz, numbers(&of("/sonar/frequency_khz")), Grain::Measured),
            ("beams", &case.beams, numbers(&of("/sonar/beams")), Grain::Counted),
            ("range_bins", &case.range_bins, numbers(&of("/sonar/range_bins")), Grain::Counted),
            ("fov_deg", &case.fov_deg, numbers(&of("/sonar/azimuth_deg")), Grain::Measured),
            ("near_m", &case.near_m, numbers(&of("/sonar/range_m/0")), Grain::Measured),
            ("range_m", &case.range_m, numbers(&of("/sonar/range_m/1")), Grain::Measured),
            ("pitch_deg", &case.pitch_deg, pitch, Grain::Measured),
        ];
        if let Some(expected) = &case.sonar {
            self.one_of("sonar", expected, &devices);
        }
        if let Some(expected) = &case.sonars {
            let right = expected.iter().all(|one| devices.iter().any(|device| device.starts_with(one.as_str())));
            self.mark("sonars", right, several(expected), several(&devices));
        }
        for (field, expected, found, grain) in measured {
            self.number(field, expected.as_ref(), &found, grain);
        }
        for (field, expected) in &case.motion {
            let pointer = format!("/vehicle/attitude_noise/{field}");
            let found = self.drafted.map(|drafted| drafted.of_jobs(&pointer)).unwrap_or_default();
            self.number(&format!("motion.{field}"), Some(expected), &numbers(&found), Grain::Measured);
        }
    }

    fn way(&mut self, case: &Case) {
        if let Some(expected) = &case.trajectory {
            let found = self.drafted.map(|drafted| drafted.of_jobs("/trajectory")).unwrap_or_default();
            let found: Vec<_> = found.into_iter().map(kind).collect();
            self.kinds("trajectory", expected, &found);
        }
        for (field, expected, measure) in [
            ("altitude_m", &case.altitude_m, ways::altitudes as fn(&Drafted) -> Vec<f64>),
            ("deepest_m", &case.deepest_m, ways::deepest),
            ("path_m", &case.path_m, ways::lengths),
        ] {
            let asked = self.drafted.filter(|_| expected.is_some());
            self.number(field, expected.as_ref(), &asked.map(measure).unwrap_or_default(), Grain::Measured);
        }
        if let Some(expected) = &case.object_range_m {
            let words: Vec<&str> = case.objects.keys().map(String::as_str).collect();
            let ranges = self.drafted.map(|drafted| ways::ranges(drafted, &words, self.words)).unwrap_or_default();
            self.mark("object_range_m", ways::is_at_range(expected, &ranges), expected, ways::told(&ranges));
        }
        for (word, expected) in &case.area_m {
            let places = self.drafted.map(|drafted| ways::places(drafted, word, self.words)).unwrap_or_default();
            let right = !places.is_empty() && places.iter().all(|place| ways::is_inside(*place, *expected));
            self.mark(&format!("area_m.{word}"), right, format!("{expected:?}"), ways::spanned(&places));
        }
    }

    fn number(&mut self, field: &str, expected: Option<&Number>, found: &[f64], grain: Grain) {
        if let Some(expected) = expected {
            self.mark(field, expected.takes(found, grain), expected, short(found));
        }
    }

    /// Whether all that was found begins as one of these words does: a device's modes have its name and a suffix.
    fn one_of(&mut self, field: &str, expected: &Words, found: &[&str]) {
        let is_right = |value: &&str| expected.all().iter().any(|word| value.starts_with(word.as_str()));
        let right = !found.is_empty() && found.iter().all(is_right);
        self.mark(field, right, several(expected.all()), several(found));
    }

    fn kinds(&mut self, field: &str, expected: &Kinds, found: &[(&str, &Value)]) {
        let names: Vec<&str> = found.iter().map(|(name, _)| *name).collect();
        let right = !names.is_empty() && names.iter().all(|name| expected.names().contains(name));
        self.mark(field, right, several(&expected.names()), several(&names));
        for (_, parameter, expected) in expected.parameters() {
            let values: Vec<f64> = found.iter().filter_map(|(_, of)| of[parameter].as_f64()).collect();
            let right = right && values.len() == found.len() && expected.takes(&values, Grain::Measured);
            self.mark(&format!("{field}.{parameter}"), right, expected, short(&values));
        }
    }
}

/// How high something floats over the bottom; nothing if it does not.
fn afloat((name, of): (&str, &Value)) -> Option<f64> {
    match name {
        "float" => of["altitude_m"].as_f64(),
        "at" => of["position_m"][2].as_f64().filter(|z| *z > 0.2),
        _ => None,
    }
}

/// How far from upright a pose lays something.
fn tipped(of: &Value) -> f64 {
    let angles = ["tip_deg", "roll_deg", "pitch_deg"].map(|key| of[key].as_f64().unwrap_or_default().abs());
    angles.into_iter().fold(0.0, f64::max)
}

fn same(expected: &Value, found: &Value) -> bool {
    match (expected.as_f64(), found.as_f64()) {
        (Some(expected), Some(found)) => (expected - found).abs() < 1e-6,
        _ => expected == found,
    }
}

fn numbers(values: &[&Value]) -> Vec<f64> {
    values.iter().filter_map(|value| value.as_f64()).collect()
}

/// All labels of a draft.
fn labels(drafted: &Drafted) -> String {
    let labels = drafted.scenes().iter().flat_map(|scene| drafted.bodies(scene)).map(|body| body.label.to_owned());
    several(&labels.collect::<Vec<_>>())
}

/// Each once, in order.
fn several<T: AsRef<str>>(words: &[T]) -> String {
    let mut words: Vec<&str> = words.iter().map(AsRef::as_ref).collect();
    words.sort_unstable();
    words.dedup();
    if words.is_empty() { "none".into() } else { words.join(", ") }
}

/// Values, or their ends where they are many.
fn short(values: &[f64]) -> String {
    let mut values = values.to_vec();
    values.sort_by(f64::total_cmp);
    values.dedup();
    match values.as_slice() {
        [] => "none".into(),
        [one] => format!("{one}"),
        [first, .., last] => format!("{first:.4}..{last:.4}"),
    }
}
