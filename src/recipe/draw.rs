//! Drawing: a tree with distributions becomes a tree of values.
//!
//! Every leaf has a stream of its own, addressed by seed, scope, index and the leaf's path. So a new key, another order of
//! keys or more scenes move no other draw.

use std::collections::BTreeMap;

use crate::math::real;
use crate::math::rng::Stream;

use super::corner::{Corner, Given};
use super::distribution::{Choice, Distribution, Law, Number, Per};
use super::error::Error;
use super::node::{Kind, Node};
use super::path;

/// What is drawn: which scene of which dataset, and how often this part of the recipe is drawn in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Address {
    /// The dataset's seed.
    pub seed: u64,
    /// The scene's number.
    pub scene: u64,
    /// How often this part is drawn.
    pub level: Level,
}

/// How often a part of a recipe is drawn. It decides what `per` may say and what holds without it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Level {
    /// Once: every leaf is `per: dataset`.
    Dataset,
    /// Once a scene: leaves are `per: scene`, or `dataset`.
    Scene,
    /// For a frame of the scene, by its number in the scene: leaves are `per: scene`, or `frame`, or `dataset`.
    Frame(u64),
    /// For an instance in the scene, by its number in its list entry: leaves are drawn for each instance;
    /// those with `per: scene` once for all of them, those with `per: dataset` once for all scenes.
    Instance(u64),
}

/// What was drawn: the value of every distribution by its path.
pub type Draws = BTreeMap<String, serde_json::Value>;

/// Draws of a truncated normal outside its bounds before the last one is clamped.
const REDRAWS: usize = 100;

impl Node {
    /// This tree with every distribution replaced by a drawn value; `path` is where the node stands in the recipe.
    ///
    /// A drawn number stands where its distribution stood; a chosen value keeps its own place.
    ///
    /// # Errors
    /// A malformed distribution, or a `per` that this level does not have. What was not chosen is not looked at:
    /// [`Node::check_distributions`] looks at all.
    pub fn draw(&self, path: &str, address: &Address) -> Result<Self, Error> {
        self.draw_recorded(path, address).map(|(node, _)| node)
    }

    /// As [`Node::draw`], and what was drawn. A chosen map is recorded whole, with what was drawn inside.
    ///
    /// # Errors
    /// As [`Node::draw`].
    pub fn draw_recorded(&self, path: &str, address: &Address) -> Result<(Self, Draws), Error> {
        self.draw_at(path, address, None)
    }

    /// As [`Node::draw_recorded`], with one leaf at a corner, if one is given and in this tree.
    ///
    /// # Errors
    /// As [`Node::draw`].
    pub fn draw_at(&self, path: &str, address: &Address, corner: Option<&Corner>) -> Result<(Self, Draws), Error> {
        let mut pen = Pen { address: *address, corner, draws: Draws::new() };
        let node = pen.node(self, path, 0)?;
        Ok((node, pen.draws))
    }

    /// Checks every distribution of this tree without drawing, those inside choices too.
    ///
    /// # Errors
    /// The first malformed distribution, or a `per` that this level does not have.
    pub fn check_distributions(&self, path: &str, level: Level) -> Result<(), Error> {
        let Some(distribution) = Distribution::read(self, path)? else {
            let mut entries = self.entries().iter();
            entries.try_for_each(|(key, value)| value.check_distributions(&path::under(path, &key.text), level))?;
            let mut items = self.items().iter().enumerate();
            return items.try_for_each(|(i, value)| value.check_distributions(&path::item(path, i), level));
        };
        scope(&distribution, path, level)?;
        match &distribution.law {
            Law::Choice(choices) => choices.iter().try_for_each(|c| c.value.check_distributions(path, level)),
            Law::Number(_) => Ok(()),
        }
    }
}

/// Whose draw it is.
#[derive(Clone, Copy)]
enum Scope {
    Dataset,
    Scene,
    Frame(u64),
    Instance(u64),
}

fn scope(distribution: &Distribution<'_>, path: &str, level: Level) -> Result<Scope, Error> {
    let refuse = |node: &Node, word: &str, often: &str, help: &str| {
        let message = format!("`per: {word}` is not possible here: this part is drawn once {often}");
        Err(Error::new(&node.span, path, message, help))
    };
    match (distribution.per, level) {
        (Some((Per::Dataset, _)), _) | (None, Level::Dataset) => Ok(Scope::Dataset),
        (Some((Per::Scene, node)), Level::Dataset) => refuse(node, "scene", "for the dataset", "leave out `per`"),
        (Some((Per::Frame, node)), Level::Dataset) => refuse(node, "frame", "for the dataset", "leave out `per`"),
        (Some((Per::Scene, _)), _) | (None, Level::Scene | Level::Frame(_)) => Ok(Scope::Scene),
        (Some((Per::Frame, _)), Level::Frame(frame)) => Ok(Scope::Frame(frame)),
        (None, Level::Instance(instance)) => Ok(Scope::Instance(instance)),
        (Some((Per::Frame, node)), Level::Scene) => refuse(node, "frame", "a scene", FRAME_HELP),
        (Some((Per::Frame, node)), Level::Instance(_)) => refuse(node, "frame", "an instance", FRAME_HELP),
    }
}

const FRAME_HELP: &str = "leave out `per`; `per: frame` is possible in sonar, water, image, vehicle and trajectory";

struct Pen<'c> {
    address: Address,
    corner: Option<&'c Corner>,
    draws: Draws,
}

impl Pen<'_> {
    /// `nesting` counts the choices that led to this node without a step down the path.
    fn node(&mut self, node: &Node, path: &str, nesting: usize) -> Result<Node, Error> {
        if let Some(distribution) = Distribution::read(node, path)? {
            let mut stream = self.stream(scope(&distribution, path, self.address.level)?, path, nesting);
            let given = self.corner.and_then(|corner| corner.given(node, path));
            let drawn = match (&distribution.law, given) {
                (Law::Choice(choices), given) => {
                    let there = if let Some(Given::Choice(index)) = given { choices.get(*index) } else { None };
                    let chosen = there.unwrap_or_else(|| choose(&mut stream, choices));
                    self.node(&chosen.value, path, nesting + 1)?
                }
                (Law::Number(_), Some(Given::Number(kind))) => Node { kind: kind.clone(), span: node.span.clone() },
                (Law::Number(law), _) => Node { kind: number(&mut stream, *law), span: node.span.clone() },
            };
            self.draws.insert(path.to_owned(), drawn.json());
            return Ok(drawn);
        }
        let kind = match &node.kind {
            Kind::Map(entries) => {
                let drawn = entries
                    .iter()
                    .map(|(key, value)| Ok((key.clone(), self.node(value, &path::under(path, &key.text), 0)?)));
                Kind::Map(drawn.collect::<Result<_, Error>>()?)
            }
            Kind::Seq(items) => {
                let drawn = items.iter().enumerate().map(|(i, value)| self.node(value, &path::item(path, i), 0));
                Kind::Seq(drawn.collect::<Result<_, Error>>()?)
            }
            Kind::Null | Kind::Bool(_) | Kind::Int(_) | Kind::Float(_) | Kind::Text(_) => node.kind.clone(),
        };
        Ok(Node { kind, span: node.span.clone() })
    }

    /// The leaf's stream. `#` and `/` cannot stand in a path outside of quotes, so no two leaves share one.
    fn stream(&self, scope: Scope, path: &str, nesting: usize) -> Stream {
        let leaf = if nesting == 0 { path.to_owned() } else { format!("{path}#{nesting}") };
        let Address { seed, scene, .. } = self.address;
        match scope {
            Scope::Dataset => Stream::at(seed, "dataset", 0, &leaf),
            Scope::Scene => Stream::at(seed, "scene", scene, &leaf),
            Scope::Frame(frame) => Stream::at(seed, "frame", scene, &format!("{frame}/{leaf}")),
            Scope::Instance(instance) => Stream::at(seed, "instance", scene, &format!("{instance}/{leaf}")),
        }
    }
}

fn number(stream: &mut Stream, law: Number) -> Kind {
    match law {
        Number::Uniform { low, high } => Kind::Float(stream.uniform(low, high).clamp(low, high)),
        Number::LogUniform { low, high } => {
            Kind::Float(real::exp(stream.uniform(real::ln(low), real::ln(high))).clamp(low, high))
        }
        Number::Normal { mean, sd, low, high } => {
            let mut draw = || mean + sd * stream.normal();
            let mut value = draw();
            for _ in 0..REDRAWS {
                if (low..=high).contains(&value) {
                    break;
                }
                value = draw();
            }
            Kind::Float(value.clamp(low, high).clamp(f64::MIN, f64::MAX))
        }
        Number::Int { low, high } => Kind::Int(i128::from(low) + i128::from(stream.below((high - low) as u64 + 1))),
    }
}

fn choose<'c, 'a>(stream: &mut Stream, choices: &'c [Choice<'a>]) -> &'c Choice<'a> {
    let total: f64 = choices.iter().map(|choice| choice.weight).sum();
    let mut left = stream.unit() * total;
    let possible = choices.iter().filter(|choice| choice.weight > 0.0);
    let mut chosen = None;
    for choice in possible {
        chosen = Some(choice);
        left -= choice.weight;
        if left < 0.0 {
            break;
        }
    }
    // Rounding may leave the sum a hair above all weights: then it is the last one.
    chosen.expect("a choice has a weight above 0: checked when it was read")
}

#[cfg(test)]
mod tests;
