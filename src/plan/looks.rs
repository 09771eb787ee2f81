//! Looks: the same echoes under other water or another image model, drawn frame by frame.
//!
//! A look is the recipe with its own `water` and `image` laid over the recipe's. Values that it does not change keep their
//! paths, hence their draws: looks of a frame differ in what they say and in nothing else.

use super::Look;
use super::sections::{Checker, Turn};
use crate::image::ImageModel;
use crate::math::Impossible;
use crate::physics::TurbidWater;
use crate::recipe::{self, Draws, Level, Node, Recipe, Tree};

/// Sections that a look may change: what comes after the echoes.
pub(super) const SECTIONS: [&str; 2] = ["water", "image"];
/// Most looks of a dataset.
pub(super) const MOST: usize = 64;

/// The recipe as one look sees it.
pub(super) struct LookTree {
    pub(super) name: Option<String>,
    pub(super) tree: Tree,
}

/// The looks of a recipe; one without a name where it has none.
pub(super) fn read(recipe: &Recipe, check: &Checker<'_>) -> Result<Vec<LookTree>, recipe::Error> {
    let Some(list) = recipe.node().get("looks") else {
        return Ok(vec![LookTree { name: None, tree: check.tree.clone() }]);
    };
    let help = "write for example `looks: [{name: clear}, {name: warm, water: {temperature_c: 20}}]`";
    if list.items().is_empty() {
        return Err(list.error("", "`looks` is a list of at least one look", help));
    }
    if list.items().len() > MOST {
        return Err(list.error("", &format!("more than {MOST} looks"), "make several datasets"));
    }
    let mut looks: Vec<LookTree> = Vec::new();
    for (i, item) in list.items().iter().enumerate() {
        let path = format!("looks[{i}]");
        item.allow_keys(&path, &["name", SECTIONS[0], SECTIONS[1]])?;
        let name = name(item, &path)?;
        if looks.iter().any(|look| look.name.as_ref() == Some(&name)) {
            return Err(item.error("name", &format!("there are two looks `{name}`"), "give each its own name"));
        }
        let mut varied = recipe.clone();
        for section in SECTIONS {
            if let Some(over) = item.get(section) {
                varied = varied.with_section_over(section, over);
            }
        }
        let tree = varied.completed();
        for section in SECTIONS {
            check.distributions_of(&tree, section, Level::Frame(0))?;
        }
        looks.push(LookTree { name: Some(name), tree });
    }
    Ok(looks)
}

/// Whether a look may be called so: its name stands in file names.
pub(super) fn is_name(name: &str) -> bool {
    let plain = |c: char| c.is_ascii_alphanumeric() || c == '-';
    (1..=40).contains(&name.len()) && name.chars().all(plain)
}

/// The name of a look.
fn name(item: &Node, path: &str) -> Result<String, recipe::Error> {
    let help = "write a word of letters, digits and `-`, such as `name: murky`";
    let name: String = match item.get("name") {
        Some(node) => node.to(&format!("{path}.name"))?,
        None => return Err(item.error("", "a look needs a `name`", help)),
    };
    if !is_name(&name) {
        return Err(item.error("name", &format!("`{name}` cannot stand in a file name"), help));
    }
    Ok(name)
}

impl LookTree {
    /// Draws the look for a frame; what was drawn is recorded under the look's name.
    pub fn draw(&self, turn: &Turn<'_>, drawn: &mut Draws) -> Result<Look, recipe::Error> {
        let mut section = |path: &str| {
            let missing = || self.tree.reject("", &format!("the section `{path}` is missing"), "");
            let (node, draws) = turn.draw(self.tree.at(path).ok_or_else(missing)?, path)?;
            drawn.extend(draws.into_iter().map(|(leaf, value)| match &self.name {
                Some(name) => (format!("looks.{name}.{leaf}"), value),
                None => (leaf, value),
            }));
            Ok::<Node, recipe::Error>(node)
        };
        let water: TurbidWater = section("water")?.to("water")?;
        let image: ImageModel = section("image")?.to("image")?;
        water.validate().map_err(|fault| impossible(&self.tree, "water", &fault))?;
        image.validate().map_err(|fault| impossible(&self.tree, "image", &fault))?;
        Ok(Look { name: self.name.clone(), water, image })
    }
}

/// A figure that cannot be, at its place in the recipe.
pub(super) fn impossible(tree: &Tree, section: &str, fault: &Impossible) -> recipe::Error {
    tree.reject(&format!("{section}.{}", fault.key), &fault.problem, &fault.remedy)
}
