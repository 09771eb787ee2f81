//! A model's reading beside that of the built-in reader, field by field.
//!
//! What both say alike is as the prompt says it. Where they differ, the words of the prompt count. What only the model says
//! counts where the prompt can have said it: a number that stands there and that nobody has read, a thing that is named.

use super::evidence::{Evidence, is_same};
use crate::draft::Prompt;
use crate::draft::read::quantity::Measure;
use crate::draft::wish::{Amount, Count, Path, Route, Said, Seabed, Sonar, Source, Splits, Thing, Water, Wish};

/// How much the built-in reader has made of a prompt.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Reader {
    /// It has understood it: words of the prompt stand behind what it says.
    Understood,
    /// It could make nothing of it: the model leads.
    Lost,
}

/// A wish that both have a part in.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Settled {
    /// The wish.
    pub wish: Wish,
    /// What the model is told: it missed it or got it wrong.
    pub wrong: Vec<String>,
    /// What was left out of what it said.
    pub left_out: Vec<String>,
}

/// Puts a model's wish beside the reader's.
pub(super) fn settle(prompt: &Prompt, read: &Wish, said: Wish, evidence: &Evidence, reader: Reader) -> Settled {
    let mut scales = Scales { prompt, evidence, reader, wrong: Vec::new(), left_out: Vec::new() };
    let mut wish = read.clone();
    wish.images = scales.number("images", &read.images, said.images, |images| (Measure::Number, whole(*images)));
    scales.things(&mut wish, said.things);
    scales.without(&mut wish, said.without);
    if reader == Reader::Lost {
        wish.unknown = said.unknown;
    } else {
        let new = said
            .unknown
            .iter()
            .filter(|unknown| !wish.unknown.iter().any(|known| alike(&known.called, &unknown.called)));
        scales.left_out.extend(new.map(|unknown| format!("objects: {:?} is in no catalog", unknown.called)));
    }
    wish.seabed = scales.seabed(&read.seabed, said.seabed);
    wish.water = scales.water(&read.water, said.water);
    wish.sonar = scales.sonar(&read.sonar, said.sonar);
    wish.path = scales.path(&read.path, said.path);
    wish.environment = scales.word("structure", &read.environment, said.environment, PartialEq::eq);
    wish.splits = scales.word("train, val, test", &read.splits, said.splits, same_splits);
    if wish.looks.is_empty() && scales.may_add_words() {
        wish.looks = said.looks;
    }
    Settled { wish, wrong: scales.wrong, left_out: scales.left_out }
}

struct Scales<'a> {
    prompt: &'a Prompt,
    evidence: &'a Evidence,
    reader: Reader,
    wrong: Vec<String>,
    left_out: Vec<String>,
}

impl Scales<'_> {
    /// Whether words of the prompt are left that could say something.
    fn may_add_words(&self) -> bool {
        self.reader == Reader::Lost || !self.evidence.strange.is_empty()
    }

    /// What the prompt says of a field, as a model is told.
    fn quote(&self, source: &Source) -> Option<String> {
        let Source::Words(ranges) = source else { return None };
        let words: Vec<&str> = ranges.iter().map(|range| self.prompt.words(range)).collect();
        Some(format!("{:?}", words.join(" … ")))
    }

    fn field<T: Clone>(
        &mut self,
        name: &str,
        read: &Option<Said<T>>,
        said: Option<Said<T>>,
        rule: &Rule<'_, T>,
    ) -> Option<Said<T>> {
        match (read, said) {
            (None, None) => None,
            (Some(read), None) => {
                if let Some(quote) = self.quote(&read.source) {
                    self.wrong.push(format!("{name} is missing: the request says {quote}"));
                }
                Some(read.clone())
            }
            (Some(read), Some(said)) => {
                if let Some(quote) = self.quote(&read.source).filter(|_| !(rule.same)(&read.value, &said.value)) {
                    self.wrong.push(format!("{name}: {} is wrong, the request says {quote}", (rule.show)(&said.value)));
                }
                Some(read.clone())
            }
            (None, Some(said)) => match (rule.ground)(self, &said.value) {
                Ground::Said(source) => Some(Said { source, ..said }),
                Ground::None => {
                    self.left_out.push(format!("{name}: the request does not say {}", (rule.show)(&said.value)));
                    None
                }
            },
        }
    }

    /// A field that is a number, with its measure.
    fn number<T: Clone>(
        &mut self,
        name: &str,
        read: &Option<Said<T>>,
        said: Option<Said<T>>,
        of: impl Fn(&T) -> (Measure, Amount),
    ) -> Option<Said<T>> {
        let rule = Rule {
            same: &|one: &T, other: &T| is_same(&of(one).1, &of(other).1),
            show: &|value: &T| shown(&of(value).1),
            ground: &|scales: &Scales<'_>, value: &T| {
                let (measure, amount) = of(value);
                match scales.evidence.amount(measure, &amount) {
                    Some(words) => Ground::Said(Source::Words(vec![words])),
                    None => Ground::None,
                }
            },
        };
        self.field(name, read, said, &rule)
    }

    fn amount(
        &mut self,
        name: &str,
        measure: Measure,
        read: &Option<Said<Amount>>,
        said: Option<Said<Amount>>,
    ) -> Option<Said<Amount>> {
        self.number(name, read, said, |amount| (measure, amount.clone()))
    }

    /// A field that is a word of a closed list.
    fn word<T: Clone + std::fmt::Debug>(
        &mut self,
        name: &str,
        read: &Option<Said<T>>,
        said: Option<Said<T>>,
        same: impl Fn(&T, &T) -> bool,
    ) -> Option<Said<T>> {
        let rule = Rule {
            same: &same,
            show: &|value: &T| format!("{value:?}"),
            ground: &|scales: &Scales<'_>, _: &T| {
                if scales.may_add_words() { Ground::Said(Source::Model) } else { Ground::None }
            },
        };
        self.field(name, read, said, &rule)
    }

    fn seabed(&mut self, read: &Seabed, said: Seabed) -> Seabed {
        Seabed {
            sediments: self.word("bottom", &read.sediments, said.sediments, |one, other| meet(one, other)),
            shape: self.word("shape", &read.shape, said.shape, PartialEq::eq),
            ..read.clone()
        }
    }

    fn water(&mut self, read: &Water, said: Water) -> Water {
        Water {
            depth_m: self.amount("depth_m", Measure::Length, &read.depth_m, said.depth_m),
            temperature_c: self.amount("temperature_c", Measure::Temperature, &read.temperature_c, said.temperature_c),
            salinity_ppt: self.amount("salinity_ppt", Measure::Salinity, &read.salinity_ppt, said.salinity_ppt),
            turbidity: self.word("water", &read.turbidity, said.turbidity, |one, other| meet(one, other)),
            ph: read.ph.clone(),
        }
    }

    fn sonar(&mut self, read: &Sonar, said: Sonar) -> Sonar {
        Sonar {
            devices: self.word("sonar", &read.devices, said.devices, |one, other| meet(one, other)),
            frequency_khz: self.amount("frequency_khz", Measure::Frequency, &read.frequency_khz, said.frequency_khz),
            beams: self.number("beams", &read.beams, said.beams, |beams| (Measure::Number, whole(u64::from(*beams)))),
            fov_deg: self.amount("fov_deg", Measure::Angle, &read.fov_deg, said.fov_deg),
            most_range_m: self.amount("range_m", Measure::Length, &read.most_range_m, said.most_range_m),
            pitch_deg: self.amount("tilt_deg", Measure::Angle, &read.pitch_deg, said.pitch_deg),
            ..read.clone()
        }
    }

    fn path(&mut self, read: &Path, said: Path) -> Path {
        Path {
            route: self.word("way", &read.route, said.route, same_route),
            altitude_m: self.amount("altitude_m", Measure::Length, &read.altitude_m, said.altitude_m),
            range_m: self.amount("distance_m", Measure::Length, &read.range_m, said.range_m),
            ..read.clone()
        }
    }

    fn things(&mut self, wish: &mut Wish, said: Vec<Thing>) {
        for thing in &wish.things {
            let quote = self.quote(&thing.called.source).unwrap_or_else(|| format!("{:?}", thing.called.value));
            let Some(other) = said.iter().find(|other| is_same_thing(thing, other)) else {
                self.wrong.push(format!("objects: {quote} is missing"));
                continue;
            };
            if let (Some(count), Some(counted)) = (&thing.count, &other.count)
                && count.value != counted.value
                && wish.things.iter().filter(|thing| is_same_thing(thing, other)).count() == 1
            {
                self.wrong.push(format!(
                    "objects: the request says {}, not {}, of {quote}",
                    counted_as(count.value),
                    counted_as(counted.value)
                ));
            }
        }
        for mut thing in said {
            let is_new = !wish.things.iter().any(|read| is_same_thing(read, &thing));
            let learnt = self.evidence.learnt(&thing.label);
            let named = match self.reader {
                Reader::Understood => learnt,
                Reader::Lost => self.evidence.label(&thing.label).or(learnt),
            };
            match (is_new, named) {
                (false, _) => {}
                (true, Some(words)) => {
                    wish.unknown.retain(|unknown| unknown.words.as_ref() != Some(&words));
                    thing.called.source = Source::Words(vec![words]);
                    wish.things.push(thing);
                }
                (true, None) => {
                    self.left_out.push(format!("objects: the request does not ask for {:?}", thing.called.value));
                }
            }
        }
    }

    fn without(&mut self, wish: &mut Wish, said: Vec<Said<String>>) {
        for label in &wish.without {
            if !said.iter().any(|other| other.value == label.value) {
                self.wrong.push(format!("without: {:?} is missing", label.value));
            }
        }
        let wanted = |label: &str| wish.things.iter().any(|thing| thing.label == label);
        let new: Vec<_> =
            said.into_iter().filter(|label| !wanted(&label.value) && !wish.without.contains(label)).collect();
        if self.reader == Reader::Lost {
            wish.without.extend(new);
        }
    }
}

/// How a field is compared.
struct Rule<'a, T> {
    same: &'a dyn Fn(&T, &T) -> bool,
    show: &'a dyn Fn(&T) -> String,
    /// What stands behind a value that only the model says.
    ground: &'a dyn Fn(&Scales<'_>, &T) -> Ground,
}

enum Ground {
    Said(Source),
    None,
}

/// Whether two things are the same one by their models.
pub(super) fn is_same_thing(one: &Thing, other: &Thing) -> bool {
    let share = one.models.uids.iter().any(|uid| other.models.uids.contains(uid));
    one.label == other.label || (one.models.catalog == other.models.catalog && share)
}

fn alike(one: &str, other: &str) -> bool {
    let words = crate::catalog::words::words;
    let (one, other) = (words(one), words(other));
    one.last() == other.last()
}

/// Whether two lists of alternatives have something in common.
fn meet(one: &[String], other: &[String]) -> bool {
    one.iter().any(|word| other.contains(word))
}

fn same_splits(one: &Splits, other: &Splits) -> bool {
    one.shares.iter().zip(other.shares).all(|(one, other)| (one - other).abs() < 0.011)
}

/// Whether two ways are of one kind; views and orbits both show things from all sides.
fn same_route(one: &Route, other: &Route) -> bool {
    let is_round = |route: &Route| matches!(route, Route::Orbit { .. } | Route::Views);
    std::mem::discriminant(one) == std::mem::discriminant(other) || (is_round(one) && is_round(other))
}

fn whole(number: u64) -> Amount {
    Amount::Exactly(number as f64)
}

fn shown(amount: &Amount) -> String {
    let [least, most] = amount.ends();
    if least == most { format!("{least}") } else { format!("{least} to {most}") }
}

fn counted_as(count: Count) -> String {
    match count {
        Count::Exactly(count) => format!("{count}"),
        Count::Between(least, most) => format!("{least} to {most}"),
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path as File;

    use super::super::answer::{Answer, Bottom, Clarity, Item, Relief};
    use super::super::to_wish::to_wish;
    use super::*;
    use crate::draft::{Known, Options};

    fn known() -> Known {
        let starter = File::new(env!("CARGO_MANIFEST_DIR")).join("catalogs/starter");
        Known::open(File::new("."), &[starter.to_string_lossy().into_owned()]).expect("the starter catalog")
    }

    fn item(name: &str, count: u32) -> Item {
        Item { name: name.into(), count: Some(count), ..Item::default() }
    }

    fn settled(prompt: &str, read: &Wish, answer: &Answer, reader: Reader) -> Settled {
        let prompt = Prompt::new(prompt, Options::default());
        let known = known();
        let evidence = Evidence::of(&prompt, &known, (reader == Reader::Understood).then_some(read));
        settle(&prompt, read, to_wish(answer, &known), &evidence, reader)
    }

    #[test]
    fn words_of_the_prompt_count_where_a_model_says_otherwise() {
        let mut read = Wish { images: Some(Said::by(19..29, 100)), ..Wish::default() };
        read.water.depth_m = Some(Said::by(11..18, Amount::Exactly(12.192)));
        let answer = Answer { images: Some(100), depth_m: Some(40.0), fov_deg: Some(180.0), ..Answer::default() };
        let settled = settled("anchors at 40 feet 100 images", &read, &answer, Reader::Understood);
        assert_eq!(settled.wish.water.depth_m, read.water.depth_m);
        assert_eq!(settled.wrong, ["depth_m: 40 is wrong, the request says \"40 feet\""]);
        assert_eq!(settled.left_out, ["fov_deg: the request does not say 180"]);
        assert_eq!(settled.wish.sonar.fov_deg, None);
    }

    #[test]
    fn what_was_said_must_be_there_and_what_was_not_must_not() {
        let known = known();
        let tires = to_wish(&Answer { objects: vec![item("tire", 2)], ..Answer::default() }, &known);
        let mut read = tires.clone();
        read.things[0].called = Said::by(4..9, "tires".into());
        read.things[0].count = Some(Said::by(0..3, Count::Exactly(2)));
        let prompt = "two tires on a muddy bottom";
        let none = settled(prompt, &read, &Answer::default(), Reader::Understood);
        assert_eq!(none.wrong, ["objects: \"tires\" is missing"]);
        let three =
            Answer { objects: vec![item("tyre", 3), item("anchor", 1), item("muddy bottom", 1)], ..Answer::default() };
        let three = settled(prompt, &read, &three, Reader::Understood);
        assert_eq!(three.wrong, ["objects: the request says 2, not 3, of \"tires\""]);
        assert_eq!(
            three.left_out,
            ["objects: the request does not ask for \"anchor\"", "objects: \"muddy bottom\" is in no catalog"]
        );
        assert_eq!(three.wish.things.len(), 1);
    }

    #[test]
    fn a_model_leads_where_the_reader_is_lost_but_invents_nothing() {
        let answer = Answer {
            images: Some(70),
            objects: vec![item("tire", 2), item("torpedo", 1)],
            bottom: Some(Bottom::Sand),
            depth_m: Some(12.0),
            range_m: Some(9.0),
            ..Answer::default()
        };
        let settled = settled("70 zdjec tire blah 12 m", &Wish::default(), &answer, Reader::Lost);
        assert_eq!(settled.wish.things.len(), 1);
        assert_eq!(settled.wish.things[0].label, "tire");
        assert_eq!(settled.wish.images.as_ref().map(|said| said.value), Some(70));
        assert!(settled.wish.water.depth_m.is_some() && settled.wish.sonar.most_range_m.is_none());
        assert_eq!(settled.wish.seabed.sediments.map(|said| said.source), Some(Source::Model));
        assert_eq!(settled.left_out.len(), 2, "{:?}", settled.left_out);
    }

    #[test]
    fn words_are_added_only_where_some_are_unread() {
        let answer = Answer { water: Some(Clarity::Turbid), shape: Some(Relief::Ripples), ..Answer::default() };
        let none = settled("two tires", &Wish::default(), &answer, Reader::Understood);
        assert_eq!((none.wish.water.turbidity, none.wish.seabed.shape, none.left_out.len()), (None, None, 2));
        let some = settled("two tires in pea-soupish brine", &Wish::default(), &answer, Reader::Understood);
        assert_eq!(some.wish.water.turbidity.map(|said| said.source), Some(Source::Model));
    }
}
