//! Shared draws: the section `let` names values that stand as `$name` anywhere in a recipe.
//!
//! A constant is written out before anything else, so it may stand everywhere. A draw is written in for each scene, or for
//! each frame where it says `per: frame`, before the section around it is drawn: `{uniform: [1, $deepest]}` is possible.

use std::collections::{BTreeMap, BTreeSet};

use super::corner::Corner;
use super::distribution;
use super::draw::{Address, Draws, Level};
use super::error::{Error, quoted};
use super::node::{Key, Kind, Node};
use super::parse::{MAX_DEPTH, MAX_NODES};
use super::path;
use super::{Recipe, Tree, defaults};

mod names;

use names::{check_names, has_dollar, is_name, order, reference, references, unescaped};

/// The section's key.
const LET: &str = "let";

/// The named draws of a recipe that are no constants.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Lets {
    /// Each after those that it refers to.
    draws: Vec<Named>,
}

/// One named draw.
#[derive(Clone, Debug, PartialEq)]
struct Named {
    name: String,
    node: Node,
    /// Whether it, or one that it refers to, is drawn for each frame.
    rhythm: Rhythm,
}

/// How often a named draw changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Rhythm {
    Scene,
    Frame,
}

/// The values of the named draws in one scene or frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Shared {
    values: BTreeMap<String, Value>,
    /// Names that have values in frames only.
    of_frames: BTreeSet<String>,
    /// What was drawn, by path (`let.NAME`); in a frame what is drawn for it alone.
    pub drawn: Draws,
}

#[derive(Clone, Debug, PartialEq)]
struct Value {
    node: Node,
    /// Values in it.
    size: usize,
}

impl Value {
    fn of(node: Node) -> Self {
        Self { size: node.size(), node }
    }
}

impl Recipe {
    /// The recipe with its constants written out, and the draws that are left.
    ///
    /// # Errors
    /// Names that are none, names that refer to themselves, a `$name` that `let` does not have.
    pub fn with_constants(&self) -> Result<(Self, Lets), Error> {
        let named = self.named()?;
        let mut constants = Shared::default();
        let mut lets = Lets::default();
        let mut left = MAX_NODES;
        let mut of_frames = BTreeSet::new();
        for index in order(named)? {
            let (key, node) = &named[index];
            let node = constants.written(node, &path::under(LET, &key.text), Missing::Stays, &mut left)?;
            if is_constant(&node) {
                constants.values.insert(key.text.clone(), Value::of(node));
            } else {
                let rhythm = rhythm(&node, &of_frames);
                if rhythm == Rhythm::Frame {
                    of_frames.insert(&key.text);
                }
                lets.draws.push(Named { name: key.text.clone(), node, rhythm });
            }
        }
        let plain = self.without(LET);
        let mut names: Vec<&str> = named.iter().map(|(key, _)| key.text.as_str()).collect();
        names.sort_unstable();
        check_names(plain.node(), "", &names)?;
        Ok((Self(constants.written(plain.node(), "", Missing::Stays, &mut left)?), lets))
    }

    /// Names in `let` that stand nowhere in `used_in`, each as a fault to tell of.
    #[must_use]
    pub fn unused_lets(&self, used_in: &Node) -> Vec<Error> {
        let mut used = BTreeSet::new();
        references(used_in, &mut |name, _| {
            used.insert(name.to_owned());
        });
        let entries = self.node().get(LET).map_or(&[][..], Node::entries);
        let unused = entries.iter().filter(|(key, _)| !used.contains(&key.text));
        let tell = |(key, _): &(Key, Node)| {
            let message = format!("nothing refers to {}", quoted(&key.text));
            Error::new(
                &key.span,
                LET,
                message,
                format!("write `${}` where its value should stand, or remove it", key.text),
            )
        };
        unused.map(tell).collect()
    }

    /// The entries of `let`.
    fn named(&self) -> Result<&[(Key, Node)], Error> {
        let Some(node) = self.node().get(LET) else { return Ok(&[]) };
        if !matches!(node.kind, Kind::Map(_)) || node.is_distribution() {
            let message = format!("`let` is a map of names, found {}", node.describe());
            return Err(Error::new(&node.span, LET, message, "write `let: {depth: {uniform: [2, 10]}}`"));
        }
        match node.entries().iter().find(|(key, _)| !is_name(&key.text)) {
            Some((key, _)) => {
                let message = format!("{} cannot be a name", quoted(&key.text));
                Err(Error::new(&key.span, LET, message, "begin with a letter; letters, digits, `_` and `-` may follow"))
            }
            None => Ok(node.entries()),
        }
    }
}

impl Lets {
    /// Draws every name for an address: all of them for a frame, and but those of frames otherwise.
    ///
    /// # Errors
    /// A distribution that is malformed, also where a value that it refers to makes it so.
    pub fn draw(&self, address: &Address) -> Result<Shared, Error> {
        self.draw_at(address, None)
    }

    /// As [`Lets::draw`], with one leaf at a corner, if one is given and among them.
    ///
    /// # Errors
    /// As [`Lets::draw`].
    pub fn draw_at(&self, address: &Address, corner: Option<&Corner>) -> Result<Shared, Error> {
        self.drawn(address, corner, &mut Vec::new())
    }

    /// The corners of every name at an address, the others as they are drawn there.
    ///
    /// # Errors
    /// As [`Lets::draw`].
    pub fn corners(&self, address: &Address) -> Result<Vec<Corner>, Error> {
        let mut corners = Vec::new();
        self.drawn(address, None, &mut corners)?;
        Ok(corners)
    }

    fn drawn(&self, address: &Address, corner: Option<&Corner>, corners: &mut Vec<Corner>) -> Result<Shared, Error> {
        let (mut shared, mut left) = (Shared::default(), MAX_NODES);
        let level = match address.level {
            Level::Frame(frame) => Level::Frame(frame),
            Level::Dataset | Level::Scene | Level::Instance(_) => Level::Scene,
        };
        for Named { name, node, rhythm } in &self.draws {
            if *rhythm == Rhythm::Frame && level == Level::Scene {
                shared.of_frames.insert(name.clone());
                continue;
            }
            let path = path::under(LET, name);
            let written = shared.written(node, &path, Missing::IsAFault, &mut left)?;
            written.check_distributions(&path, level)?;
            corners.extend(written.corners(&path)?);
            let (drawn, draws) = written.draw_at(&path, &Address { level, ..*address }, corner)?;
            if level == Level::Scene || *rhythm == Rhythm::Frame {
                shared.drawn.extend(draws);
            }
            shared.values.insert(name.clone(), Value::of(drawn));
        }
        Ok(shared)
    }
}

/// How often a value changes that may refer to names that change with the frame.
fn rhythm(node: &Node, of_frames: &BTreeSet<&str>) -> Rhythm {
    let mut found = is_of_frames(node);
    references(node, &mut |name, _| found |= of_frames.contains(name));
    if found { Rhythm::Frame } else { Rhythm::Scene }
}

/// What becomes of a `$name` that has no value.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Missing {
    Stays,
    IsAFault,
}

impl Shared {
    /// A part of a recipe with every `$name` in it replaced by its value, and with the defaults of what came so; `path` is
    /// where it stands.
    ///
    /// # Errors
    /// A `$name` that has no value here.
    pub fn complete_into(&self, node: &Node, path: &str) -> Result<Node, Error> {
        let written = self.write_into(node, path)?;
        Ok(if written == *node { written } else { defaults::complete_at(&written, &path::pattern(path)) })
    }

    /// As [`Shared::complete_into`], without defaults.
    ///
    /// # Errors
    /// A `$name` that has no value here.
    pub fn write_into(&self, node: &Node, path: &str) -> Result<Node, Error> {
        if !has_dollar(node) {
            return Ok(node.clone());
        }
        Ok(unescaped(self.written(node, path, Missing::IsAFault, &mut { MAX_NODES })?))
    }

    fn written(&self, node: &Node, path: &str, missing: Missing, left: &mut usize) -> Result<Node, Error> {
        Writer { shared: self, missing, left }.node(node, path, 0)
    }
}

struct Writer<'a> {
    shared: &'a Shared,
    missing: Missing,
    /// Values that may still be written: names that refer to names must not multiply without end.
    left: &'a mut usize,
}

impl Writer<'_> {
    fn node(&mut self, node: &Node, path: &str, depth: usize) -> Result<Node, Error> {
        let kind = match &node.kind {
            Kind::Text(text) => match reference(text) {
                Some(name) => return self.value(name, node, path, depth),
                None => node.kind.clone(),
            },
            Kind::Map(entries) => {
                let written = entries
                    .iter()
                    .map(|(key, value)| Ok((key.clone(), self.node(value, &path::under(path, &key.text), depth + 1)?)));
                Kind::Map(written.collect::<Result<_, Error>>()?)
            }
            Kind::Seq(items) => {
                let written =
                    items.iter().enumerate().map(|(i, item)| self.node(item, &path::item(path, i), depth + 1));
                Kind::Seq(written.collect::<Result<_, Error>>()?)
            }
            Kind::Null | Kind::Bool(_) | Kind::Int(_) | Kind::Float(_) => node.kind.clone(),
        };
        Ok(Node { kind, span: node.span.clone() })
    }

    fn value(&mut self, name: &str, node: &Node, path: &str, depth: usize) -> Result<Node, Error> {
        let fault = |message: String, help: &str| Err(Error::new(&node.span, path, message, help));
        let Some(value) = self.shared.values.get(name) else {
            if self.missing == Missing::Stays {
                return Ok(node.clone());
            }
            if self.shared.of_frames.contains(name) {
                let message = format!("`${name}` is drawn for each frame, but this part once a scene");
                return fault(message, "leave out `per: frame` there, or give this part a value of its own");
            }
            let message = format!("`${name}` has no value here");
            return fault(message, "only constants may stand where nothing is drawn");
        };
        if value.size > *self.left {
            let message = format!("with `${name}` written out, there are more than {MAX_NODES} values");
            return fault(message, "let fewer names refer to names");
        }
        if depth + self::depth(&value.node) > MAX_DEPTH {
            let message = format!("with `${name}` written out, it is nested deeper than {MAX_DEPTH} levels");
            return fault(message, "write it flatter");
        }
        *self.left -= value.size;
        Ok(value.node.clone())
    }
}

impl Tree {
    /// The fault of the first `$name` below a path: what stands there is the same for all, so only constants may.
    ///
    /// # Errors
    /// As said.
    pub fn refuse_draws(&self, section: &str) -> Result<(), Error> {
        let Some(node) = self.at(section) else { return Ok(()) };
        Shared::default().written(node, section, Missing::IsAFault, &mut { MAX_NODES }).map(|_| ())
    }
}

fn is_constant(node: &Node) -> bool {
    let here = node.is_distribution() || node.text().and_then(reference).is_some();
    !here && node.entries().iter().all(|(_, value)| is_constant(value)) && node.items().iter().all(is_constant)
}

fn is_of_frames(node: &Node) -> bool {
    let here = distribution::word(node).is_some() && node.get("per").and_then(Node::text) == Some("frame");
    here || node.entries().iter().any(|(_, value)| is_of_frames(value)) || node.items().iter().any(is_of_frames)
}

fn depth(node: &Node) -> usize {
    let children = node.entries().iter().map(|(_, value)| value).chain(node.items());
    children.map(|child| 1 + depth(child)).max().unwrap_or(0)
}

#[cfg(test)]
mod tests;
