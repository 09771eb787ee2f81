//! Distributions: what may stand at any leaf instead of a value.
//!
//! `{uniform: [a, b]}`, `{log_uniform: [a, b]}`, `{normal: [mean, sd]}` with `min` and `max`, `{int: [a, b]}` with both ends,
//! `{choice: [a, b, …]}` with `weights: [1, 2, …]` or `{choice: {a: 1, b: 2}}`. Beside each, `per: dataset | scene | frame`.
//! A map with one of these keys is a distribution, so they are reserved words among the keys of a recipe.

use std::borrow::Cow;

use super::error::{Error, quoted};
use super::nearest::did_you_mean;
use super::node::{Key, Kind, Node, Style, unknown_key};
use super::path::{self, steps};
use super::scalar::resolve;

/// The keys that make a map a distribution.
pub(crate) const WORDS: [&str; 5] = ["uniform", "log_uniform", "normal", "int", "choice"];

/// Bounds of `int` that a double holds exactly.
const LARGEST_INT: i128 = 1 << 53;

/// A distribution as it is written.
#[derive(Debug)]
pub(super) struct Distribution<'a> {
    pub(super) law: Law<'a>,
    /// How often it is drawn, if it says so, and where it says so.
    pub(super) per: Option<(Per, &'a Node)>,
}

/// The law that a value follows.
#[derive(Debug)]
pub(super) enum Law<'a> {
    /// A number.
    Number(Number),
    /// One of several values, any subtree.
    Choice(Vec<Choice<'a>>),
}

/// The law that a number follows.
#[derive(Clone, Copy, Debug)]
pub(super) enum Number {
    /// Equally likely in [low, high).
    Uniform { low: f64, high: f64 },
    /// The logarithm is equally likely; both positive.
    LogUniform { low: f64, high: f64 },
    /// Gaussian, truncated where `low` and `high` are finite.
    Normal { mean: f64, sd: f64, low: f64, high: f64 },
    /// Whole numbers, equally likely, both ends included.
    Int { low: i64, high: i64 },
}

/// One value of a choice.
#[derive(Debug)]
pub(super) struct Choice<'a> {
    pub(super) weight: f64,
    pub(super) value: Cow<'a, Node>,
}

/// How often a leaf is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Per {
    Dataset,
    Scene,
    Frame,
}

/// The distribution's word, if the node is a distribution.
pub(super) fn word(node: &Node) -> Option<&'static str> {
    node.entries().iter().find_map(|(key, _)| WORDS.into_iter().find(|word| *word == key.text))
}

impl Node {
    /// Whether this is a distribution and not a value.
    #[must_use]
    pub fn is_distribution(&self) -> bool {
        word(self).is_some()
    }

    /// The distribution at a path below this value, or the one that the path leads into.
    #[must_use]
    pub fn distribution_on(&self, path: &str) -> Option<&Self> {
        let mut node = self;
        for step in steps(path).ok()? {
            if node.is_distribution() {
                break;
            }
            node = node.step(&step)?;
        }
        node.is_distribution().then_some(node)
    }
}

impl<'a> Distribution<'a> {
    /// The distribution at a node; `None` when the node is a value.
    pub(super) fn read(node: &'a Node, path: &str) -> Result<Option<Self>, Error> {
        let Some(word) = word(node) else { return Ok(None) };
        let siblings: &[&str] = match word {
            "normal" => &["normal", "min", "max", "per"],
            "choice" => &["choice", "weights", "per"],
            "uniform" => &["uniform", "per"],
            "log_uniform" => &["log_uniform", "per"],
            _ => &["int", "per"],
        };
        if let Some((key, _)) = node.entries().iter().find(|(key, _)| !siblings.contains(&key.text.as_str())) {
            if WORDS.contains(&key.text.as_str()) {
                let message = format!("both `{word}` and `{}` stand here", key.text);
                return Err(Error::new(&key.span, path, message, "keep one distribution"));
            }
            return Err(Error {
                message: format!("unknown key {} beside `{word}`", quoted(&key.text)),
                ..unknown_key(key, path, siblings)
            });
        }
        let reader = Reader { node, word, path };
        let law = match word {
            "uniform" => Law::Number(reader.uniform()?),
            "log_uniform" => Law::Number(reader.log_uniform()?),
            "normal" => Law::Number(reader.normal()?),
            "int" => Law::Number(reader.int()?),
            _ => Law::Choice(reader.choice()?),
        };
        Ok(Some(Self { law, per: node.get("per").map(|per| Ok((read_per(per, path)?, per))).transpose()? }))
    }
}

fn read_per(node: &Node, path: &str) -> Result<Per, Error> {
    match node.text() {
        Some("dataset") => Ok(Per::Dataset),
        Some("scene") => Ok(Per::Scene),
        Some("frame") => Ok(Per::Frame),
        other => {
            let help = did_you_mean(other.unwrap_or(""), &["dataset", "scene", "frame"]);
            Err(Error::new(&node.span, &path::under(path, "per"), format!("`per` cannot be {}", node.describe()), help))
        }
    }
}

struct Reader<'a, 'p> {
    node: &'a Node,
    word: &'static str,
    path: &'p str,
}

impl<'a> Reader<'a, '_> {
    fn uniform(&self) -> Result<Number, Error> {
        let [low, high] = self.ordered()?;
        if !(high - low).is_finite() {
            return Err(self.fault(self.arguments(), "the interval is too wide", "bring the ends closer together"));
        }
        Ok(Number::Uniform { low, high })
    }

    fn log_uniform(&self) -> Result<Number, Error> {
        let [low, high] = self.ordered()?;
        if low <= 0.0 {
            let help = "both ends must be greater than 0; `uniform` takes any";
            return Err(self.fault(&self.arguments().items()[0], format!("{low} has no logarithm"), help));
        }
        Ok(Number::LogUniform { low, high })
    }

    fn normal(&self) -> Result<Number, Error> {
        let [mean, sd] = self.pair("mean, standard deviation")?;
        if sd < 0.0 {
            let node = &self.arguments().items()[1];
            return Err(self.fault(
                node,
                format!("the standard deviation {sd} is negative"),
                "write it without the minus",
            ));
        }
        let bound = |key, unbounded| self.node.get(key).map_or(Ok(unbounded), |node| self.number(node));
        let (low, high) = (bound("min", f64::NEG_INFINITY)?, bound("max", f64::INFINITY)?);
        if low > high {
            return Err(self.fault(self.node, format!("min {low} is greater than max {high}"), "swap them"));
        }
        Ok(Number::Normal { mean, sd, low, high })
    }

    fn int(&self) -> Result<Number, Error> {
        self.ordered()?;
        let whole = |node: &Node| match node.kind {
            Kind::Int(value) if value.abs() <= LARGEST_INT => Ok(value as i64),
            Kind::Int(value) => Err(self.fault(node, format!("{value} is too large"), "stay below 2^53")),
            _ => Err(self.fault(node, format!("expected a whole number, found {}", node.describe()), "round it")),
        };
        let ends = self.arguments().items();
        Ok(Number::Int { low: whole(&ends[0])?, high: whole(&ends[1])? })
    }

    fn choice(&self) -> Result<Vec<Choice<'a>>, Error> {
        let arguments = self.arguments();
        let choices: Vec<Choice<'a>> = match (&arguments.kind, self.node.get("weights")) {
            (Kind::Seq(items), None) => {
                items.iter().map(|value| Choice { weight: 1.0, value: Cow::Borrowed(value) }).collect()
            }
            (Kind::Seq(items), Some(weights)) => {
                if !matches!(weights.kind, Kind::Seq(_)) || weights.items().len() != items.len() {
                    let help = format!("write a list of {} numbers, one for each value", items.len());
                    return Err(self.fault(weights, "the weights do not match the choice", help));
                }
                let both = items.iter().zip(weights.items());
                both.map(|(value, weight)| Ok(Choice { weight: self.weight(weight)?, value: Cow::Borrowed(value) }))
                    .collect::<Result<_, Error>>()?
            }
            (Kind::Map(_), Some(weights)) => {
                return Err(self.fault(weights, "the weights stand twice", "keep those in the map, or write a list"));
            }
            (Kind::Map(entries), None) => entries
                .iter()
                .map(|(key, weight)| Ok(Choice { weight: self.weight(weight)?, value: Cow::Owned(key_value(key)) }))
                .collect::<Result<_, Error>>()?,
            _ => {
                let help = "write {choice: [a, b]} or {choice: {a: 0.7, b: 0.3}}";
                return Err(self.fault(arguments, format!("`choice` cannot be {}", arguments.describe()), help));
            }
        };
        let total: f64 = choices.iter().map(|choice| choice.weight).sum();
        match (choices.is_empty(), total > 0.0 && total.is_finite()) {
            (true, _) => Err(self.fault(arguments, "there is nothing to choose from", "write at least one value")),
            (_, false) => {
                Err(self.fault(arguments, "no weight is greater than 0", "give one value a weight such as 1"))
            }
            (false, true) => Ok(choices),
        }
    }

    fn weight(&self, node: &Node) -> Result<f64, Error> {
        match node.number() {
            Some(weight) if (0.0..=1e12).contains(&weight) => Ok(weight),
            _ => Err(self.fault(
                node,
                format!("a weight cannot be {}", node.describe()),
                "write a number from 0 to 1e12, such as 0.5",
            )),
        }
    }

    /// What stands behind the distribution's word.
    fn arguments(&self) -> &'a Node {
        self.node.get(self.word).expect("the word was found among the keys")
    }

    /// Two numbers, the smaller one first.
    fn ordered(&self) -> Result<[f64; 2], Error> {
        let [low, high] = self.pair("low, high")?;
        if low > high {
            let message = format!("{low} is greater than {high}");
            return Err(self.fault(self.arguments(), message, format!("write [{high}, {low}]")));
        }
        Ok([low, high])
    }

    fn pair(&self, names: &str) -> Result<[f64; 2], Error> {
        let arguments = self.arguments();
        match arguments.items() {
            [first, second] => Ok([self.number(first)?, self.number(second)?]),
            items => {
                let found = match &arguments.kind {
                    Kind::Seq(_) => format!("{} value{}", items.len(), if items.len() == 1 { "" } else { "s" }),
                    _ => arguments.describe(),
                };
                let message = format!("`{}` takes two numbers, found {found}", self.word);
                Err(self.fault(arguments, message, format!("write {{{}: [{names}]}}", self.word)))
            }
        }
    }

    fn number(&self, node: &Node) -> Result<f64, Error> {
        node.number().ok_or_else(|| {
            let message = format!("expected a number, found {}", node.describe());
            self.fault(node, message, format!("`{}` takes plain numbers", self.word))
        })
    }

    fn fault(&self, node: &Node, message: impl Into<String>, help: impl Into<String>) -> Error {
        Error::new(&node.span, self.path, message, help)
    }
}

/// The value that a key of a weighted choice stands for: `{choice: {1: 0.7, 2: 0.3}}` gives numbers.
pub(super) fn key_value(key: &Key) -> Node {
    let text = || Kind::Text(key.text.clone());
    let kind = match key.style {
        Style::Plain => resolve(&key.text).unwrap_or_else(|_| text()),
        Style::Quoted => text(),
    };
    Node { kind, span: key.span.clone() }
}

#[cfg(test)]
mod tests {
    use crate::recipe::{Level, Origin, parse};

    /// The message, column and help of the fault in `x: TEXT`.
    fn fault(text: &str) -> (String, u32, String) {
        let tree = parse("a", &format!("x: {text}"), Origin::Given).unwrap();
        let error = tree.check_distributions("", Level::Scene).unwrap_err();
        assert!(error.path.starts_with('x'), "{error}");
        (error.message.clone(), error.column().unwrap(), error.help)
    }

    #[test]
    fn each_fault_is_named_and_located() {
        for (text, message, column) in [
            ("{uniform: [1]}", "`uniform` takes two numbers, found 1 value", 14),
            ("{uniform: 3}", "`uniform` takes two numbers, found the number 3", 14),
            ("{uniform: [a, 2]}", "expected a number, found the text `a`", 15),
            ("{uniform: [5, 2]}", "5 is greater than 2", 14),
            ("{uniform: [-1.7e308, 1.7e308]}", "the interval is too wide", 14),
            ("{log_uniform: [0, 2]}", "0 has no logarithm", 19),
            ("{normal: [0, -1]}", "the standard deviation -1 is negative", 17),
            ("{normal: [0, 1], min: 3, max: 2}", "min 3 is greater than max 2", 4),
            ("{normal: [0, 1], min: low}", "expected a number, found the text `low`", 26),
            ("{int: [1, 2.5]}", "expected a whole number, found the number 2.5", 14),
            ("{int: [0, 18446744073709551615]}", "18446744073709551615 is too large", 14),
            ("{int: [3, 1]}", "3 is greater than 1", 10),
            ("{choice: []}", "there is nothing to choose from", 13),
            ("{choice: {}}", "there is nothing to choose from", 13),
            ("{choice: a}", "`choice` cannot be the text `a`", 13),
            ("{choice: {a: -1}}", "a weight cannot be the number -1", 17),
            ("{choice: {a: x}}", "a weight cannot be the text `x`", 17),
            ("{choice: {a: 0, b: 0}}", "no weight is greater than 0", 13),
            ("{choice: [a, b], weights: [1]}", "the weights do not match the choice", 30),
            ("{choice: {a: 1}, weights: [1]}", "the weights stand twice", 30),
            ("{uniform: [0, 1], per: sene}", "`per` cannot be the text `sene`", 27),
            ("{uniform: [0, 1], per: frame}", "`per: frame` is not possible here: this part is drawn once a scene", 27),
            ("{uniform: [0, 1], mn: 3}", "unknown key `mn` beside `uniform`", 22),
            ("{uniform: [0, 1], int: [0, 1]}", "both `uniform` and `int` stand here", 22),
            ("{choice: [{uniform: [5, 2]}]}", "5 is greater than 2", 24),
            ("{choice: [{a: [{uniform: [5, 2]}]}]}", "5 is greater than 2", 29),
        ] {
            let found = fault(text);
            assert_eq!((found.0.as_str(), found.1), (message, column), "{text}");
            assert!(!found.2.is_empty(), "{text}");
        }
        assert_eq!(fault("{uniform: [5, 2]}").2, "write [2, 5]");
        assert_eq!(fault("{normal: [0, 1], mim: 3}").2, "did you mean `min`? (valid: normal, min, max, per)");
        assert_eq!(fault("{int: [1, 2], per: sene}").2, "did you mean `scene`? (valid: dataset, scene, frame)");
    }
}
