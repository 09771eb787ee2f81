//! What a prompt says, whoever reads it: its numbers with their units, the things that it names, the words that nobody has read.

use std::collections::BTreeMap;
use std::ops::Range;

use crate::catalog::concepts::concepts;
use crate::draft::read::quantity::{Measure, Quantity, quantity_at};
use crate::draft::read::text::Text;
use crate::draft::read::token::Kind;
use crate::draft::read::vocabulary::vocabulary;
use crate::draft::wish::{Amount, Source, Wish};
use crate::draft::{Known, Prompt, find};

/// Most words of a thing's name.
const LONGEST_NAME: usize = 3;
/// Most tokens that are looked at: a prompt that names things after these names too many.
const MOST_TOKENS: usize = 400;

/// What a prompt says.
#[derive(Debug)]
pub(super) struct Evidence {
    /// Amounts with their bytes.
    amounts: Vec<(Range<usize>, Quantity)>,
    /// Things that are in a catalog, by label, with the bytes that name them first.
    labels: BTreeMap<String, Range<usize>>,
    /// Things that strange words turned out to name.
    learnt: BTreeMap<String, Range<usize>>,
    /// Words that no table knows and that the reader has not used.
    pub strange: Vec<Range<usize>>,
    /// Bytes that the reader has used.
    read: Vec<Range<usize>>,
}

impl Evidence {
    /// Of a prompt, beside what the built-in reader makes of it.
    pub fn of(prompt: &Prompt, known: &Known, read: Option<&Wish>) -> Self {
        let text = Text::of(prompt.text());
        let read = read.map(ranges_of).unwrap_or_default();
        let last = text.tokens.len().min(MOST_TOKENS);
        let amounts = (0..last).filter_map(|at| quantity_at(&text, at));
        let amounts = amounts.map(|quantity| (text.bytes(quantity.tokens.clone()), quantity)).collect();
        let mut labels = BTreeMap::new();
        // Short names first: `anchor`, not `an anchor`.
        for length in 1..=LONGEST_NAME {
            for first in 0..(last + 1).saturating_sub(length) {
                let tokens = first..first + length;
                if text.tokens[tokens.clone()].iter().any(|token| token.kind != Kind::Word) {
                    continue;
                }
                if let Ok(found) = find::models(text.words(tokens.clone()), known) {
                    labels.entry(found.label).or_insert_with(|| text.bytes(tokens));
                }
            }
        }
        let strange = text.tokens.iter().filter(|token| {
            token.kind == Kind::Word
                && token.form.chars().count() > 2
                && !is_known(&token.form)
                && !is_within(&token.bytes, &read)
        });
        let strange = strange.map(|token| token.bytes.clone()).collect();
        Self { amounts, labels, learnt: BTreeMap::new(), strange, read }
    }

    /// The words that say an amount of this measure, or the same number without a unit; those that the reader has used for
    /// something else do not count.
    pub fn amount(&self, measure: Measure, amount: &Amount) -> Option<Range<usize>> {
        let fits = |quantity: &Quantity| {
            let other = match (quantity.measure, measure) {
                (given, wanted) if given == wanted => quantity.amount.clone(),
                (Measure::Angle, Measure::Temperature) | (Measure::Number, _) => quantity.amount.clone(),
                _ => return false,
            };
            is_same(&other, amount)
        };
        let free = self.amounts.iter().filter(|(bytes, _)| !is_within(bytes, &self.read));
        free.clone().find(|(_, quantity)| fits(quantity)).map(|(bytes, _)| bytes.clone())
    }

    /// The words that name a thing with this label.
    pub fn label(&self, label: &str) -> Option<Range<usize>> {
        self.labels.get(label).cloned()
    }

    /// Takes in what strange words turned out to name.
    pub fn learn(&mut self, label: String, words: Range<usize>) {
        self.learnt.insert(label, words);
    }

    /// The strange words that turned out to name a thing with this label.
    pub fn learnt(&self, label: &str) -> Option<Range<usize>> {
        self.learnt.get(label).cloned()
    }

    /// Labels of the things that are named.
    pub fn labels(&self) -> impl Iterator<Item = &str> {
        self.labels.keys().map(String::as_str)
    }
}

fn is_known(form: &str) -> bool {
    !vocabulary().languages_of(form).is_empty()
        || concepts().vocabulary().contains(form)
        || crate::catalog::words::words(form).is_empty()
        || form.chars().all(crate::catalog::words::is_ideograph)
}

fn is_within(bytes: &Range<usize>, all: &[Range<usize>]) -> bool {
    all.iter().any(|range| bytes.start < range.end && range.start < bytes.end)
}

/// Whether two amounts are the same but for rounding: people say 40 feet, models 12.2 m.
pub(super) fn is_same(one: &Amount, other: &Amount) -> bool {
    let near = |a: f64, b: f64| (a - b).abs() <= 0.02 * a.abs().max(b.abs()) + 1e-9;
    one.ends().into_iter().zip(other.ends()).all(|(a, b)| near(a, b))
}

/// Every range of a prompt's bytes that a wish comes from.
fn ranges_of(wish: &Wish) -> Vec<Range<usize>> {
    let mut out = Vec::new();
    let mut take = |source: &Source| {
        if let Source::Words(ranges) = source {
            out.extend(ranges.iter().cloned());
        }
    };
    macro_rules! take_all {
        ($($said:expr),+ $(,)?) => { $( $said.iter().for_each(|said| take(&said.source)); )+ };
    }
    let Wish { seabed, water, sonar, path, output, .. } = wish;
    take_all!(wish.images, wish.scenes, wish.seed, wish.without, wish.environment, wish.environment_m, wish.splits);
    take_all!(wish.looks, wish.ignored, wish.multipath, output.raw, output.views, output.pack);
    take_all!(seabed.shape, seabed.sediments, seabed.slope_deg, seabed.height_m, seabed.wavelength_m);
    take_all!(water.depth_m, water.temperature_c, water.salinity_ppt, water.ph, water.turbidity);
    take_all!(sonar.devices, sonar.frequency_khz, sonar.beams, sonar.fov_deg, sonar.least_range_m, sonar.most_range_m);
    take_all!(sonar.pitch_deg, sonar.yaw_deg);
    take_all!(path.route, path.altitude_m, path.vehicle_depth_m, path.range_m, path.speed_m_s, path.position_m);
    take_all!(path.heading_deg, path.points_m, path.sway);
    for thing in &wish.things {
        take(&thing.called.source);
        take_all!(thing.count, thing.size_m, thing.stands);
    }
    out.extend(wish.unknown.iter().filter_map(|unknown| unknown.words.clone()));
    out
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::draft::Options;
    use crate::draft::wish::Said;

    fn known() -> Known {
        let starter = Path::new(env!("CARGO_MANIFEST_DIR")).join("catalogs/starter");
        Known::open(Path::new("."), &[starter.to_string_lossy().into_owned()]).expect("the starter catalog")
    }

    #[test]
    fn what_a_prompt_says() {
        let prompt = Prompt::new("due reifen and an admiralty anchor at 40 feet", Options::default());
        let evidence = Evidence::of(&prompt, &known(), None);
        let words =
            |range: Option<Range<usize>>| range.map(|range| prompt.words(&range).to_owned()).unwrap_or_default();
        assert_eq!(words(evidence.label("tire")), "reifen");
        assert_eq!(words(evidence.label("anchor")), "anchor");
        assert_eq!(evidence.label("torpedo"), None);
        assert!(words(evidence.amount(Measure::Length, &Amount::Exactly(12.2))).contains("40 feet"));
        assert_eq!(evidence.amount(Measure::Length, &Amount::Exactly(40.0)), None);
        assert_eq!(evidence.amount(Measure::Frequency, &Amount::Exactly(12.2)), None);
    }

    #[test]
    fn what_was_read_says_nothing_else() {
        let prompt = Prompt::new("anchor at 12 m", Options::default());
        let mut wish = Wish::default();
        wish.water.depth_m = Some(Said::by(7..14, Amount::Exactly(12.0)));
        let evidence = Evidence::of(&prompt, &known(), Some(&wish));
        assert_eq!(evidence.amount(Measure::Length, &Amount::Exactly(12.0)), None);
    }
}
