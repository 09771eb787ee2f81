//! Changes of values that may be distributions: every number of them, or every word on its way along a ladder.

use super::act::{list, number, word};
use crate::recipe::{Kind, Node};

/// What happens to a number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Move {
    /// So much more.
    By(f64),
    /// So many times as much.
    Times(f64),
}

impl Move {
    /// A number, moved; of a few digits again.
    #[must_use]
    pub fn of(self, value: f64) -> f64 {
        match self {
            Self::By(more) => rounded(value + more),
            Self::Times(factor) => short(value * factor),
        }
    }
}

/// A number without the tail that arithmetic leaves: six significant digits.
#[must_use]
pub fn rounded(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}

/// Three significant digits: what is made by a factor is not exacter.
fn short(value: f64) -> f64 {
    format!("{value:.2e}").parse().unwrap_or(value)
}

/// A value with all its numbers moved; none where it has no numbers, or refers to a name.
#[must_use]
pub fn moved(node: &Node, how: Move) -> Option<Node> {
    if let Some(value) = node.number() {
        return Some(number(how.of(value)));
    }
    if !node.is_distribution() {
        return None;
    }
    let mut result = node.clone();
    let Kind::Map(entries) = &mut result.kind else { return None };
    for (key, value) in entries {
        let changed = match (key.text.as_str(), how) {
            ("uniform" | "log_uniform" | "choice", _) => all(value, |value| Some(number(how.of(value))))?,
            ("int", _) => all(value, |value| Some(number(how.of(value).round())))?,
            ("normal", Move::By(_)) => first(value, how)?,
            ("normal", Move::Times(_)) => all(value, |value| Some(number(how.of(value))))?,
            ("min" | "max", _) => number(how.of(value.number()?)),
            _ => continue,
        };
        *value = changed;
    }
    Some(result)
}

fn all(node: &Node, change: impl Fn(f64) -> Option<Node>) -> Option<Node> {
    let items = node.items().iter().map(|item| change(item.number()?));
    (!node.items().is_empty()).then(|| items.collect::<Option<_>>().map(list))?
}

fn first(node: &Node, how: Move) -> Option<Node> {
    let [mean, spread] = node.items() else { return None };
    Some(list(vec![number(how.of(mean.number()?)), spread.clone()]))
}

/// Where a ladder was at its end.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Climb {
    /// Words that could not go on.
    pub at_end: Vec<String>,
}

/// A value with its words so many steps further along a ladder; none where it has words of no ladder.
#[must_use]
pub fn climbed(node: &Node, ladder: &[&str], steps: i32, climb: &mut Climb) -> Option<Node> {
    if let Some(text) = node.text() {
        return step(text, ladder, steps, climb).map(word);
    }
    let choice = node.get("choice")?;
    let mut result = node.clone();
    let Kind::Map(entries) = &mut result.kind else { return None };
    let place = &mut entries.iter_mut().find(|(key, _)| key.text == "choice")?.1;
    match &choice.kind {
        Kind::Seq(items) => {
            let weighted = node.get("weights").is_some();
            let mut climbed: Vec<Node> = Vec::new();
            for item in items {
                let item = word(step(item.text()?, ladder, steps, climb)?);
                if weighted || !climbed.iter().any(|known| known.text() == item.text()) {
                    climbed.push(item);
                }
            }
            if let [one] = &climbed[..] {
                return Some(one.clone());
            }
            *place = list(climbed);
        }
        Kind::Map(weights) => {
            let mut climbed: Vec<(crate::recipe::Key, Node)> = Vec::new();
            for (key, weight) in weights {
                let text = step(&key.text, ladder, steps, climb)?;
                match climbed.iter_mut().find(|(known, _)| known.text == text) {
                    Some((_, sum)) => *sum = number(rounded(sum.number()? + weight.number()?)),
                    None => climbed.push((crate::recipe::Key { text: text.to_owned(), ..key.clone() }, weight.clone())),
                }
            }
            if let [(key, _)] = &climbed[..] {
                return Some(word(&key.text));
            }
            place.kind = Kind::Map(climbed);
        }
        _ => return None,
    }
    Some(result)
}

fn step<'a>(text: &str, ladder: &[&'a str], steps: i32, climb: &mut Climb) -> Option<&'a str> {
    let here = ladder.iter().position(|rung| *rung == text)?;
    let there = (here as i64 + i64::from(steps)).clamp(0, ladder.len() as i64 - 1) as usize;
    if there == here {
        climb.at_end.push(text.to_owned());
    }
    Some(ladder[there])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recipe::{Origin, parse};

    fn yaml(text: &str) -> Node {
        parse("a", text, Origin::Given).unwrap()
    }

    #[test]
    fn distributions_are_moved_as_a_whole() {
        for (value, how, expected) in [
            ("3", Move::By(5.0), "8"),
            ("0.1", Move::Times(3.0), "0.3"),
            ("{uniform: [4, 22], per: frame}", Move::By(5.0), "{uniform: [9, 27], per: frame}"),
            ("{normal: [10, 2], min: 0, max: 20}", Move::By(5.0), "{normal: [15, 2], min: 5, max: 25}"),
            ("{normal: [10, 2]}", Move::Times(2.0), "{normal: [20, 4]}"),
            ("{int: [1, 3]}", Move::Times(1.5), "{int: [2, 5]}"),
            ("{choice: [5, 20], weights: [1, 2]}", Move::By(1.0), "{choice: [6, 21], weights: [1, 2]}"),
        ] {
            assert_eq!(moved(&yaml(value), how).unwrap().json(), yaml(expected).json(), "{value}");
        }
        for value in ["word", "$depth", "{choice: [a, 1]}", "[1, 2]", "{uniform: [$a, 3]}", "null"] {
            assert_eq!(moved(&yaml(value), Move::By(1.0)), None, "{value}");
        }
    }

    #[test]
    fn words_climb_each_for_itself() {
        let ladder = ["clear", "coastal", "turbid", "very-turbid"];
        for (value, steps, expected, ends) in [
            ("clear", 1, "coastal", 0),
            ("very-turbid", 1, "very-turbid", 1),
            ("{choice: [clear, coastal]}", 1, "{choice: [coastal, turbid]}", 0),
            ("{choice: [turbid, very-turbid]}", 1, "very-turbid", 1),
            ("{choice: {clear: 1, coastal: 2}, per: frame}", -1, "clear", 1),
            ("{choice: {clear: 1, turbid: 2, very-turbid: 3}}", 2, "{choice: {turbid: 1, very-turbid: 5}}", 1),
        ] {
            let mut climb = Climb::default();
            assert_eq!(climbed(&yaml(value), &ladder, steps, &mut climb).unwrap().json(), yaml(expected).json());
            assert_eq!(climb.at_end.len(), ends, "{value}");
        }
        assert_eq!(climbed(&yaml("{choice: [clear, mud]}"), &ladder, 1, &mut Climb::default()), None);
    }
}
