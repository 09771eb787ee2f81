//! Whether a wish can be at all: no thing is larger than the pool that it lies in, and no sonar flies above the sea.
//!
//! Knows nothing of prompts: wishes of every drafter are checked alike.

use std::ops::Range;

use super::wish::{Amount, Said, Source, Stand, Thing, Wish};
use super::{Problem, Refusal};

/// Most of one thing in a scene.
const MOST_OF_A_THING: u32 = 1000;
/// Greatest depth of the sea, metres.
const DEEPEST_M: f64 = 11_000.0;

/// Checks what a wish says against itself.
///
/// # Errors
/// Everything that cannot be, with the words that say so.
pub(in crate::draft) fn sense(wish: &Wish) -> Result<(), Refusal> {
    let mut problems = Vec::new();
    water(wish, &mut problems);
    heights(wish, &mut problems);
    sizes(wish, &mut problems);
    counts(wish, &mut problems);
    sonar(wish, &mut problems);
    if let Some(splits) = &wish.splits {
        let sum: f64 = splits.value.shares.iter().sum();
        if (sum - 1.0).abs() > 0.02 {
            let what = format!("shares of training, validation and test that add up to {} %", short(sum * 100.0));
            problems.push(problem(splits, what, "say shares that add up to 100 %, such as 80/10/10"));
        }
    }
    if problems.is_empty() { Ok(()) } else { Err(Refusal { problems }) }
}

/// The bytes that a part of a wish was said by.
fn words<T>(said: &Said<T>) -> Option<Range<usize>> {
    match &said.source {
        Source::Words(words) => Some(words.first()?.start..words.last()?.end),
        Source::Option(_) | Source::Model | Source::Assumed(_) => None,
    }
}

fn problem<T>(said: &Said<T>, what: String, help: &str) -> Problem {
    Problem { words: words(said), what, help: help.to_owned() }
}

/// A number without needless digits.
fn short(value: f64) -> String {
    let rounded = (value * 100.0).round() / 100.0;
    format!("{rounded}")
}

fn water(wish: &Wish, problems: &mut Vec<Problem>) {
    let water = &wish.water;
    if let Some(depth) = &water.depth_m {
        let [low, high] = depth.value.ends();
        if low <= 0.0 {
            let what = format!("a depth of {} m: there is no water to see anything in", short(low));
            problems.push(problem(depth, what, "say how deep the water is, such as \"at 12 m depth\""));
        } else if high > DEEPEST_M {
            let what = format!("a depth of {} m is deeper than any sea", short(high));
            problems.push(problem(depth, what, "say a depth of up to 11,000 m"));
        }
    }
    let ranges = [
        (&water.temperature_c, [-3.0, 60.0], "°C", "a temperature"),
        (&water.salinity_ppt, [0.0, 60.0], "ppt", "a salinity"),
        (&water.ph, [4.0, 11.0], "", "a pH"),
    ];
    for (said, [least, most], unit, name) in ranges {
        let Some(said) = said else { continue };
        let [low, high] = said.value.ends();
        if low < least || high > most {
            let value = if low < least { low } else { high };
            let what = format!("{name} of {} {unit}: no water that sonars work in has it", short(value));
            let help = format!("say a value from {} to {} {unit}", short(least), short(most));
            problems.push(problem(said, what.replace("  ", " ").replace(" :", ":"), help.trim()));
        }
    }
}

/// What is over the bottom must be under the surface.
fn heights(wish: &Wish, problems: &mut Vec<Problem>) {
    if let Some(altitude) = wish.path.altitude_m.as_ref().filter(|said| said.value.ends()[0] <= 0.0) {
        let what = format!("a sonar {} m above the bottom: that is in the ground", short(altitude.value.ends()[0]));
        problems.push(problem(altitude, what, "say a height above 0"));
    }
    let Some(depth) = &wish.water.depth_m else { return };
    let deepest = depth.value.ends()[1];
    let mut over = |said: &Said<Amount>, what: &str| {
        let height = said.value.ends()[0];
        if height >= deepest && deepest > 0.0 {
            let text = format!(
                "{what} {} m above the bottom in water {} m deep: that is above the surface",
                short(height),
                short(deepest)
            );
            problems.push(problem(said, text, "say a height below the depth of the water, or deeper water"));
        }
    };
    if let Some(altitude) = &wish.path.altitude_m {
        over(altitude, "a sonar");
    }
    for thing in &wish.things {
        for stand in &thing.stands {
            if let Stand::Floating(Some(height)) | Stand::Moored(Some(height)) = &stand.value {
                over(&Said { value: height.clone(), source: stand.source.clone() }, &format!("a {}", thing.label));
            }
        }
    }
    let mut under = |said: &Said<Amount>, what: &str| {
        let below = said.value.ends()[0];
        if below > deepest && deepest > 0.0 {
            let text = format!(
                "{what} {} m under the surface of water {} m deep: that is below the bottom",
                short(below),
                short(deepest)
            );
            problems.push(problem(said, text, "say a depth above the bottom, or deeper water"));
        }
    };
    if let Some(below) = &wish.path.vehicle_depth_m {
        under(below, "a sonar");
    }
    for thing in &wish.things {
        for stand in &thing.stands {
            if let Stand::BelowSurface(below) = &stand.value {
                under(&Said { value: below.clone(), source: stand.source.clone() }, &format!("a {}", thing.label));
            }
        }
    }
}

/// Nothing is larger than what it is in.
fn sizes(wish: &Wish, problems: &mut Vec<Problem>) {
    for thing in &wish.things {
        let least = least_size(thing);
        if let Some(room) = &wish.environment_m {
            let most = room.value.iter().copied().fold(0.0, f64::max);
            let place = wish.environment.as_ref().map_or("place", |said| said.value.as_str());
            if least > most && most > 0.0 && matches!(place, "tank" | "net-pen" | "harbour" | "place") {
                let what =
                    format!("a {} of {} m does not fit into a {place} of {} m", thing.label, short(least), short(most));
                let mut fault = problem(room, what, "ask for something smaller, or for more room");
                fault.words = thing.size_m.as_ref().and_then(words).or(fault.words);
                problems.push(fault);
            }
        }
        if let Some(size) = &thing.size_m
            && size.value.ends()[0] <= 0.0
        {
            let what = format!("a {} of {} m has no size", thing.label, short(size.value.ends()[0]));
            problems.push(problem(size, what, "say a size above 0, or none: models have their own"));
        }
        for stand in &thing.stands {
            if let Stand::Buried(share) = &stand.value
                && (share.ends()[0] < 0.0 || share.ends()[1] > 1.0)
            {
                let percent = share.ends().map(|share| share * 100.0);
                let value = if percent[1] > 100.0 { percent[1] } else { percent[0] };
                let what = format!(
                    "{} {} % buried: a thing can be buried from 0 to 100 % of its height",
                    thing.label,
                    short(value)
                );
                problems.push(problem(stand, what, "say a share such as \"half buried\" or \"30 % buried\""));
            }
        }
    }
}

/// The least longest side of a thing, metres: as it was said, else of its smallest model.
fn least_size(thing: &Thing) -> f64 {
    thing.size_m.as_ref().map_or(thing.models.size_m[0], |size| size.value.ends()[0])
}

fn counts(wish: &Wish, problems: &mut Vec<Problem>) {
    for thing in &wish.things {
        let Some(count) = &thing.count else { continue };
        let most = count.value.most();
        if most > MOST_OF_A_THING {
            let what =
                format!("{most} of {} in one scene are more than find room: at most {MOST_OF_A_THING}", thing.label);
            problems.push(problem(count, what, "ask for fewer in a scene and for more scenes"));
        }
    }
}

fn sonar(wish: &Wish, problems: &mut Vec<Problem>) {
    let sonar = &wish.sonar;
    if let (Some(least), Some(most)) = (&sonar.least_range_m, &sonar.most_range_m)
        && least.value.ends()[0] >= most.value.ends()[1]
    {
        let (near, far) = (short(least.value.ends()[0]), short(most.value.ends()[1]));
        let what = format!("a range from {near} m to {far} m runs backwards");
        problems.push(problem(most, what, "say the nearest range first, such as \"range 1 to 10 m\""));
    }
    if let Some(none) = sonar.beams.as_ref().filter(|beams| beams.value == 0) {
        problems.push(problem(
            none,
            "a sonar of 0 beams sees nothing".to_owned(),
            "say how many, such as \"512 beams\"",
        ));
    }
    if let Some(fov) = &sonar.fov_deg {
        let [low, high] = fov.value.ends();
        if low <= 0.0 || high > 180.0 {
            let value = if low <= 0.0 { low } else { high };
            let what = format!("a field of view of {} degrees: forward-looking sonars see up to 180", short(value));
            problems.push(problem(fov, what, "say a field of view from 1 to 180 degrees"));
        }
    }
    if let Some(frequency) = &sonar.frequency_khz {
        let [low, high] = frequency.value.ends();
        if low < 10.0 || high > 10_000.0 {
            let value = if low < 10.0 { low } else { high };
            let what = format!("a frequency of {} kHz: no imaging sonar works there", short(value));
            problems.push(problem(frequency, what, "say a frequency from 10 kHz to 10 MHz"));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::draft::Models;
    use crate::draft::wish::Count;

    fn ship() -> Thing {
        let models = Models {
            catalog: "starter".into(),
            uids: vec!["shipwreck".into()],
            label: Some("shipwreck".into()),
            is_whole_label: true,
            size_m: [24.0, 24.0],
            material: "iron".into(),
        };
        Thing {
            called: Said::by(0..4, "ship".into()),
            label: "ship".into(),
            models,
            count: None,
            size_m: None,
            stands: Vec::new(),
        }
    }

    fn refused(wish: &Wish) -> String {
        sense(wish).err().map(|refusal| refusal.to_string()).unwrap_or_default()
    }

    #[test]
    fn what_cannot_be_is_told() {
        let at = |value: f64| Some(Said::by(1..2, Amount::Exactly(value)));
        assert_eq!(refused(&Wish::default()), "");
        let mut wish = Wish { things: vec![ship()], ..Wish::default() };
        wish.environment = Some(Said::by(0..1, "tank".into()));
        wish.environment_m = Some(Said::by(0..1, vec![10.0, 6.0]));
        assert!(refused(&wish).contains("24 m does not fit into a tank of 10 m"));
        wish.things[0].size_m = at(40.0);
        assert!(refused(&wish).contains("40 m"));
        let mut wish = Wish::default();
        wish.water.depth_m = at(3.0);
        wish.path.altitude_m = at(5.0);
        assert!(refused(&wish).contains("above the surface"));
        wish.path.altitude_m = None;
        wish.path.vehicle_depth_m = at(7.0);
        assert!(refused(&wish).contains("below the bottom"));
        let mut thing = ship();
        thing.stands = vec![Said::by(0..1, Stand::Buried(Amount::Exactly(1.5)))];
        thing.count = Some(Said::by(0..1, Count::Exactly(4000)));
        let told = refused(&Wish { things: vec![thing], ..Wish::default() });
        assert!(told.contains("150 %") && told.contains("4000"), "{told}");
        let mut wish = Wish::default();
        wish.water.temperature_c = at(500.0);
        wish.sonar.least_range_m = at(10.0);
        wish.sonar.most_range_m = at(5.0);
        let told = refused(&wish);
        assert!(told.contains("500 °C") && told.contains("backwards"), "{told}");
    }
}
