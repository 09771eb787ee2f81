//! Numbers in digits and words.
//!
//! Knows nothing of units and of what is counted: see [`super::quantity`].

use super::text::Text;
use super::token::{Kind, Language};
use super::vocabulary::vocabulary;
use crate::draft::read::vocabulary::RangeWord;

/// A number and how many tokens it takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::draft) struct Spoken {
    /// What it is; negative only with a minus sign before it.
    pub value: f64,
    /// How many tokens.
    pub tokens: usize,
    /// Whether it is a share of something ("half", "a third"), not a number of things.
    pub is_share: bool,
}

/// The number that begins at a token: `12`, `-3`, `2k`, `twenty-five`, `one hundred and twenty`, `half a thousand`,
/// `fünfundzwanzig`, `treinta y cinco`, `quatre-vingt-dix`, `一百二十`, `half`.
pub(in crate::draft) fn number_at(text: &Text<'_>, at: usize) -> Option<Spoken> {
    if let Some(behind) = minus(text, at) {
        let number = number_at(text, at + behind).filter(|number| !number.is_share && number.value >= 0.0)?;
        return Some(Spoken { value: -number.value, tokens: behind + number.tokens, ..number });
    }
    if let Some((tokens, share)) = vocabulary().shares.at(text, at) {
        // `half a thousand`, but not `half a metre`, which has no number in it.
        let article = usize::from(matches!(text.form(at + tokens), "a" | "an" | "ein" | "eine" | "un" | "une"));
        if let Some((more, power)) = vocabulary().powers.at(text, at + tokens + article) {
            return Some(Spoken { value: share * power, tokens: tokens + article + more, is_share: false });
        }
        return Some(Spoken { value: *share, tokens, is_share: true });
    }
    let mut sum = Sum::default();
    let mut taken = 0;
    let mut and = 0;
    while let Some((tokens, atom)) = atom_at(text, at + taken + and, taken == 0) {
        if !sum.takes(atom) || !sum.add(atom) {
            break;
        }
        if atom == Atom::And {
            and = tokens;
        } else {
            taken += and + tokens;
            and = 0;
        }
    }
    let value = sum.total + sum.current;
    (taken > 0).then_some(Spoken { value, tokens: taken, is_share: false })
}

/// Tokens of a minus sign before a number; none behind another number, where it makes a range.
fn minus(text: &Text<'_>, at: usize) -> Option<usize> {
    match text.form(at) {
        "minus" | "negative" | "menos" | "moin" | "moins" => Some(1),
        "负" => Some(1),
        "-" => {
            let next = text.tokens.get(at + 1).filter(|next| matches!(next.kind, Kind::Number(_)) && next.glued)?;
            let before = at.checked_sub(1).and_then(|before| text.tokens.get(before));
            let is_range = before.is_some_and(|before| {
                before.number().is_some() || (text.tokens[at].glued && before.kind == Kind::Word)
            });
            (!is_range && next.number().is_some()).then_some(1)
        }
        _ => None,
    }
}

/// A piece of a number.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Atom {
    /// In digits.
    Digits(f64),
    /// Up to 99, or hundreds in one word.
    Ones(f64),
    /// What is multiplied with.
    Power(f64),
    /// A compound word, whole: `fünfundzwanzig`.
    Whole(f64),
    /// Joins ones to hundreds or tens: `and`.
    And,
}

fn atom_at(text: &Text<'_>, at: usize, is_first: bool) -> Option<(usize, Atom)> {
    let token = text.tokens.get(at)?;
    if let Some(value) = token.number() {
        return Some((1, Atom::Digits(value)));
    }
    let article = is_first && matches!(token.form.as_str(), "a" | "an");
    if article {
        // `a hundred`, `a dozen`: elsewhere it is an article.
        let (tokens, power) = vocabulary().powers.at(text, at + 1).filter(|_| text.form(at + 1).len() > 1)?;
        return Some((1 + tokens, Atom::Power(*power)));
    }
    let power = vocabulary().powers.at(text, at);
    // A lone letter multiplies digits that it is glued to: `2k`. `290K` is a temperature.
    let written = text.words(at..at + 1);
    let kelvin = written == "K" && at > 0 && text.tokens[at - 1].number().is_some_and(|n| (250.0..330.0).contains(&n));
    let power = power.filter(|_| token.form.len() > 1 || (token.glued && !is_first && !kelvin));
    let ones = vocabulary().numbers.at(text, at);
    match (power, ones) {
        (Some((tokens, power)), _) => Some((tokens, Atom::Power(*power))),
        (_, Some((tokens, ones))) => Some((tokens, Atom::Ones(*ones))),
        _ if !is_first && vocabulary().ranges.all_at(text, at).any(|(_, word)| *word == RangeWord::And) => {
            // Only where a number goes on behind it.
            let next = atom_at(text, at + 1, false).filter(|(_, next)| matches!(next, Atom::Ones(_)));
            next.map(|_| (1, Atom::And))
        }
        _ if text.language == Language::German => compound(&token.form).map(|value| (1, Atom::Whole(value))),
        _ => None,
    }
}

/// Pieces added up.
#[derive(Clone, Copy, Debug, Default)]
struct Sum {
    total: f64,
    current: f64,
    last: Option<Atom>,
}

impl Sum {
    /// Whether a piece goes on what is there: `twenty five`, not `five twenty`.
    fn takes(&self, atom: Atom) -> bool {
        let rest = self.current % 100.0;
        match (self.last, atom) {
            (None, _) => true,
            (Some(Atom::Digits(_)), Atom::Digits(value)) => value > 0.0 && value < 1.0,
            (Some(Atom::Digits(_)), Atom::Power(power)) => power != 12.0 || self.current < 100.0,
            (Some(Atom::Digits(_)), _) | (_, Atom::Whole(_) | Atom::Digits(_)) => false,
            (Some(Atom::And), Atom::Ones(value)) => {
                value > 0.0 && (rest == 0.0 || (rest % 10.0 == 0.0 && value < 10.0))
            }
            (Some(Atom::And), _) => false,
            (Some(Atom::Power(_)), Atom::And) => true,
            // `treinta y cinco`, `trente et un`; `twenty and five` are two numbers, and so are `one and two`.
            (Some(Atom::Ones(value)), Atom::And) => value >= 30.0 && value % 10.0 == 0.0 && value < 100.0,
            (Some(Atom::Whole(_)), Atom::And) => false,
            (Some(_), Atom::Power(_)) => true,
            (Some(Atom::Power(_)), Atom::Ones(value)) => rest == 0.0 || (rest % 10.0 == 0.0 && value < 10.0),
            // `一百零五`.
            (Some(Atom::Ones(0.0)), Atom::Ones(_)) => self.current >= 100.0,
            (Some(Atom::Ones(last)), Atom::Ones(value)) => {
                let tens = last >= 20.0 && last % 10.0 == 0.0 && last < 100.0 && value < 10.0 && value > 0.0;
                let french = (last == 60.0 || last == 80.0) && (10.0..20.0).contains(&value);
                let french_ones = last == 10.0 && (7.0..10.0).contains(&value);
                let hundreds = last >= 200.0 && value < 100.0;
                tens || french || french_ones || hundreds
            }
            (Some(Atom::Whole(_)), Atom::Ones(_)) => false,
        }
    }

    fn add(&mut self, atom: Atom) -> bool {
        match atom {
            Atom::Digits(value) | Atom::Ones(value) | Atom::Whole(value) => self.current += value,
            Atom::Power(power) if power < 100.0 => {
                // `二十`, `三百二十`, `two dozen`.
                let ones = self.current % 10.0;
                let ones = if power == 10.0 { ones } else { self.current };
                self.current = self.current - ones + if ones == 0.0 { power } else { ones * power };
            }
            Atom::Power(100.0) => {
                let hundreds = if self.current == 0.0 { 1.0 } else { self.current };
                self.current = hundreds * 100.0;
            }
            Atom::Power(power) => {
                let all = if self.current == 0.0 && self.total == 0.0 { 1.0 } else { self.total + self.current };
                // `two million three hundred thousand`.
                if self.total > power && self.current > 0.0 {
                    self.total += self.current * power;
                } else {
                    self.total = all * power;
                }
                self.current = 0.0;
            }
            Atom::And => {}
        }
        self.last = Some(atom);
        self.total + self.current < 1e15
    }
}

/// German numbers in one word: `fünfundzwanzig`, `zweihundertfünfzig`, `zweitausend`.
fn compound(word: &str) -> Option<f64> {
    const ONES: [(&str, f64); 22] = [
        ("ein", 1.0),
        ("eins", 1.0),
        ("zwei", 2.0),
        ("drei", 3.0),
        ("vier", 4.0),
        ("funf", 5.0),
        ("fuenf", 5.0),
        ("sechs", 6.0),
        ("sech", 6.0),
        ("sieben", 7.0),
        ("acht", 8.0),
        ("neun", 9.0),
        ("zehn", 10.0),
        ("elf", 11.0),
        ("zwolf", 12.0),
        ("zwoelf", 12.0),
        ("zwanzig", 20.0),
        ("dreissig", 30.0),
        ("vierzig", 40.0),
        ("funfzig", 50.0),
        ("fuenfzig", 50.0),
        ("sechzig", 60.0),
    ];
    const TENS: [(&str, f64); 3] = [("siebzig", 70.0), ("achtzig", 80.0), ("neunzig", 90.0)];
    if let Some((_, value)) = ONES.iter().chain(&TENS).find(|(name, _)| *name == word) {
        return Some(*value);
    }
    for (power, value) in [("tausend", 1000.0), ("hundert", 100.0)] {
        if let Some((before, behind)) = word.split_once(power) {
            let times = if before.is_empty() { Some(1.0) } else { compound(before) }?;
            let more =
                if behind.is_empty() { Some(0.0) } else { compound(behind.strip_prefix("und").unwrap_or(behind)) }?;
            return Some(times * value + more);
        }
    }
    let (ones, tens) = word.split_once("und")?;
    let (ones, tens) = (compound(ones)?, compound(tens)?);
    (ones < 10.0 && (20.0..100.0).contains(&tens)).then_some(ones + tens)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(words: &str) -> Option<(f64, usize)> {
        number_at(&Text::of(words), 0).map(|number| (number.value, number.tokens))
    }

    #[test]
    fn digits_and_words() {
        for (words, value) in [
            ("12 m", 12.0),
            ("1,000 images", 1000.0),
            ("10 000 images", 10000.0),
            ("1,234,567.5", 1_234_567.5),
            ("12,5 m Tiefe und Sand", 12.5),
            ("1.000 Bilder von einem Anker", 1000.0),
            ("1.5 m", 1.5),
            ("−12 m", -12.0),
            ("minus ten", -10.0),
            ("2k images", 2000.0),
            ("1½ m", 1.5),
            ("twenty-five", 25.0),
            ("one hundred and twenty crates", 120.0),
            ("two hundred and fifty frames", 250.0),
            ("a hundred", 100.0),
            ("two thousand five hundred", 2500.0),
            ("half a thousand", 500.0),
            ("half a dozen", 6.0),
            ("two dozen", 24.0),
            ("one million", 1e6),
            ("fünfundzwanzig Bilder von dem Anker", 25.0),
            ("zweihundertfünfzig Bilder mit Reifen und Anker", 250.0),
            ("hundert Bilder von einem Anker", 100.0),
            ("treinta y cinco imágenes con un barril", 35.0),
            ("doscientas imágenes de un ancla", 200.0),
            ("quatre-vingt-dix images avec une ancre", 90.0),
            ("soixante-dix images avec une ancre et deux pneus", 70.0),
            ("vingt-cinq images de deux pneus", 25.0),
            ("三十张图像", 30.0),
            ("一百二十张图像", 120.0),
            ("两个轮胎", 2.0),
            ("十五个轮胎", 15.0),
            ("二十五个轮胎", 25.0),
            ("一百零五", 105.0),
            ("2万", 20000.0),
            ("half", 0.5),
        ] {
            assert_eq!(read(words).map(|(value, _)| value), Some(value), "{words}");
        }
        for (words, tokens) in
            [("one and two", 1), ("five twenty", 1), ("20 tires", 1), ("ten or twelve", 1), ("70,20,10", 1)]
        {
            assert_eq!(read(words).map(|(_, tokens)| tokens), Some(tokens), "{words}");
        }
        for words in ["k", "a tire", "and", "", "- 12", "anchor"] {
            assert_eq!(read(words), None, "{words}");
        }
    }
}
