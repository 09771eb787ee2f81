//! An answer as a wish: its names looked up in the catalogs, its words put into the recipe's.

use super::answer::{Answer, Bottom, Clarity, Item, LookWord, Relief, StandWord, Structure, Way};
use crate::catalog::sonars::DEVICES;
use crate::draft::find;
use crate::draft::wish::{Amount, Count, Look, LookChange, Route, Said, Source, Splits, Stand, Thing, Unknown, Wish};
use crate::draft::{Known, Models};

/// A wish of which all is said by the model; things that no catalog has are among its unknown ones.
pub(super) fn to_wish(answer: &Answer, known: &Known) -> Wish {
    let mut wish = Wish { images: answer.images.map(model), ..Wish::default() };
    for item in &answer.objects {
        match find::models(&item.name, known) {
            Ok(found) => wish.things.push(thing(item, found.label, found.models)),
            Err(near) => wish.unknown.push(Unknown { called: item.name.clone(), words: None, near }),
        }
    }
    for name in answer.without.iter().flatten() {
        let label = find::models(name, known).map_or_else(|_| name.clone(), |found| found.label);
        wish.without.push(model(label));
    }
    ground(answer, &mut wish);
    sonar(answer, &mut wish);
    path(answer, &mut wish);
    wish.splits = splits(answer);
    wish.looks = answer.looks.iter().flatten().map(|word| model(look(*word))).collect();
    wish
}

fn model<T>(value: T) -> Said<T> {
    Said { value, source: Source::Model }
}

fn exactly(value: Option<f64>) -> Option<Said<Amount>> {
    value.map(|value| model(Amount::Exactly(value)))
}

/// Small models write 0 for what is not said: no depth, height or length is that.
fn positive(value: Option<f64>) -> Option<f64> {
    value.filter(|value| *value > 0.0)
}

fn between(least: Option<f64>, most: Option<f64>) -> Option<Said<Amount>> {
    match (least, most) {
        (Some(least), Some(most)) if most > least => Some(model(Amount::Between(least, most))),
        (least, most) => exactly(least.or(most)),
    }
}

fn thing(item: &Item, label: String, models: Models) -> Thing {
    let count = match (item.count, item.count_most) {
        (Some(least), Some(most)) if most > least => Some(model(Count::Between(least, most))),
        (least, most) => least.or(most).filter(|count| *count > 0).map(|count| model(Count::Exactly(count))),
    };
    let over = item.over_bottom_m.filter(|metres| *metres > 0.0).map(Amount::Exactly);
    let buried = item.buried.filter(|share| *share > 0.0).map(|share| Stand::Buried(Amount::Exactly(share)));
    let mut stands: Vec<Stand> = match item.stand {
        None | Some(StandWord::Buried) => Vec::new(),
        Some(StandWord::Upright) => vec![Stand::Upright],
        Some(StandWord::OnItsSide) => vec![Stand::OnSide],
        Some(StandWord::Dumped) => vec![Stand::Settled],
        Some(StandWord::Floating) => vec![Stand::Floating(over.clone())],
        Some(StandWord::Moored) => vec![Stand::Moored(over.clone())],
        Some(StandWord::InAHeap) => vec![Stand::Heap],
        Some(StandWord::InARow) => vec![Stand::Row(None)],
        Some(StandWord::Leaning) => vec![Stand::Leaning(None)],
    };
    if stands.is_empty()
        && let Some(over) = over
    {
        stands.push(Stand::Floating(Some(over)));
    }
    stands.extend(buried);
    let stands = stands.into_iter().map(model).collect();
    Thing { called: model(item.name.clone()), label, models, count, size_m: None, stands }
}

fn ground(answer: &Answer, wish: &mut Wish) {
    wish.seabed.sediments = answer.bottom.map(|bottom| model(sediments(bottom)));
    wish.seabed.shape = answer.shape.map(|relief| model(shape(relief).to_owned()));
    wish.environment = answer.structure.map(|structure| model(environment(structure).to_owned()));
    wish.water.depth_m = between(positive(answer.depth_m), positive(answer.depth_most_m));
    wish.water.turbidity = answer.water.map(|clarity| model(vec![turbidity(clarity).to_owned()]));
    wish.water.temperature_c = exactly(answer.temperature_c);
    wish.water.salinity_ppt = exactly(answer.salinity_ppt);
}

fn sediments(bottom: Bottom) -> Vec<String> {
    let names: &[&str] = match bottom {
        Bottom::Mud | Bottom::Clay => &["mud"],
        Bottom::Silt => &["silt"],
        Bottom::Sand => &["fine-sand", "medium-sand", "coarse-sand"],
        Bottom::Gravel => &["gravel"],
        Bottom::Cobbles => &["cobbles"],
        Bottom::Rock => &["rock"],
    };
    names.iter().map(|name| (*name).to_owned()).collect()
}

fn shape(relief: Relief) -> &'static str {
    match relief {
        Relief::Flat => "flat",
        Relief::Ripples => "ripples",
        Relief::SandWaves => "sand-waves",
        Relief::Slope => "slope",
        Relief::Rocks => "rock-field",
        Relief::Rubble => "rubble",
        Relief::Reef => "reef",
        Relief::Trench => "trench",
    }
}

fn environment(structure: Structure) -> &'static str {
    match structure {
        Structure::Pier => "pier",
        Structure::Dam => "dam",
        Structure::Harbour => "harbour",
        Structure::Tank => "tank",
        Structure::Pipeline => "pipeline",
        Structure::NetPen => "net-pen",
    }
}

fn turbidity(clarity: Clarity) -> &'static str {
    match clarity {
        Clarity::Clear => "clear",
        Clarity::SlightlyTurbid => "coastal",
        Clarity::Turbid => "turbid",
        Clarity::VeryTurbid => "very-turbid",
    }
}

fn sonar(answer: &Answer, wish: &mut Wish) {
    wish.sonar.devices = answer.sonar.as_deref().and_then(devices).map(model);
    wish.sonar.frequency_khz = exactly(answer.frequency_khz);
    wish.sonar.beams = answer.beams.map(model);
    wish.sonar.fov_deg = exactly(answer.fov_deg);
    wish.sonar.most_range_m = exactly(answer.range_m);
    wish.sonar.pitch_deg = exactly(answer.tilt_deg);
}

/// Device files whose name begins with what somebody calls a sonar: "Oculus M1200d" has two.
fn devices(called: &str) -> Option<Vec<String>> {
    let plain = |text: &str| text.chars().filter(char::is_ascii_alphanumeric).collect::<String>().to_lowercase();
    let called = plain(called);
    if called.len() < 4 {
        return None;
    }
    let fit = DEVICES.iter().map(|(name, _)| *name).filter(|name| plain(name).starts_with(&called));
    let fit: Vec<String> = fit.map(str::to_owned).collect();
    (!fit.is_empty()).then_some(fit)
}

fn path(answer: &Answer, wish: &mut Wish) {
    let (length_m, spacing_m) = (positive(answer.length_m), positive(answer.spacing_m));
    let route = answer.way.and_then(|way| match way {
        Way::Around => Some(Route::Orbit { arc_deg: None, sides: None }),
        Way::Lawnmower => Some(Route::Lawnmower { length_m, width_m: None, spacing_m, lines: None }),
        Way::Follow => {
            let what = answer.structure.map(|structure| environment(structure).to_owned());
            Some(Route::Follow { what, length_m })
        }
        Way::Approach => {
            Some(Route::Approach { from_m: positive(answer.distance_most_m), to_m: positive(answer.distance_m) })
        }
        Way::ManySides => Some(Route::Views),
        Way::Hover => Some(Route::Hover),
        // Down to where, only the prompt's own numbers say.
        Way::Dive => None,
    });
    wish.path.route = route.map(model);
    wish.path.altitude_m = exactly(positive(answer.altitude_m));
    wish.path.range_m = between(positive(answer.distance_m), positive(answer.distance_most_m));
}

fn splits(answer: &Answer) -> Option<Said<Splits>> {
    let shares = [answer.train?, answer.val.unwrap_or(0.0), answer.test.unwrap_or(0.0)];
    let sum: f64 = shares.iter().sum();
    (sum > 0.0).then(|| model(Splits { shares: shares.map(|share| share / sum), by: None }))
}

fn look(word: LookWord) -> Look {
    let (name, change) = match word {
        LookWord::NoNoise => ("no-noise", LookChange::Speckle(0.0)),
        LookWord::LittleNoise => ("little-noise", LookChange::Speckle(0.25)),
        LookWord::MediumNoise => ("medium-noise", LookChange::Speckle(0.5)),
        LookWord::StrongNoise => ("strong-noise", LookChange::Speckle(1.0)),
        LookWord::ClearWater => ("clear-water", LookChange::Turbidity("clear".into())),
        LookWord::TurbidWater => ("turbid-water", LookChange::Turbidity("turbid".into())),
    };
    let more = matches!(word, LookWord::NoNoise).then_some(LookChange::Noise(0.0));
    Look { name: name.into(), changes: std::iter::once(change).chain(more).collect() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sonars_by_the_names_that_people_give_them() {
        assert_eq!(devices("Oculus M1200d"), Some(vec!["oculus-m1200d-hf".into(), "oculus-m1200d-lf".into()]));
        assert_eq!(devices("gemini 720is"), Some(vec!["gemini-720is".into()]));
        assert_eq!(devices("an"), None);
        assert_eq!(devices("../../etc/passwd"), None);
    }
}
