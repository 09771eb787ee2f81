//! The items of `objects`: what each may be, and which of them somebody means.

use super::Which;
use crate::catalog::pick::Pick;
use crate::catalog::words::words;
use crate::draft::edit::subject::Subject;
use crate::draft::read::vocabulary::vocabulary;
use crate::draft::{Known, Problem};
use crate::recipe::Node;

/// An item of the list.
pub(super) struct Item<'a> {
    /// Its path.
    pub path: String,
    pub index: usize,
    pub node: &'a Node,
    /// What may be picked: uids with their labels; empty where no catalog tells.
    pub models: Vec<(String, String)>,
}

/// How an item has what somebody calls so.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Has {
    All,
    Some,
    None,
}

/// The items of a recipe.
pub(super) fn items<'a>(subject: &'a Subject, known: &Known) -> Vec<Item<'a>> {
    let nodes = subject.said("objects").map_or(&[][..], |(node, _)| node.items());
    let item = |(index, node): (usize, &'a Node)| {
        let path = format!("objects[{index}]");
        let pick: Option<Pick> = node.get("pick").and_then(|pick| pick.to("pick").ok());
        let catalog = pick.as_ref().and_then(|pick| known.catalogs.iter().find(|(name, _)| *name == pick.catalog));
        let assets = pick.and_then(|pick| catalog?.1.pick(&pick).ok()).unwrap_or_default();
        let models = assets.into_iter().map(|asset| (asset.uid, asset.label)).collect();
        Item { path, index, node, models }
    };
    nodes.iter().enumerate().map(item).collect()
}

impl Item<'_> {
    /// How it has what somebody calls so.
    pub fn has(&self, which: &Which) -> Has {
        let named = |label: &str| which.labels.contains(label) || which.labels.contains(&words(label).join(" "));
        if self.node.get("label").and_then(Node::text).is_some_and(named) {
            return Has::All;
        }
        let fitting = self.models.iter().filter(|(uid, label)| which.uids.contains(uid) || named(label)).count();
        match fitting {
            0 => Has::None,
            all if all == self.models.len() => Has::All,
            _ => Has::Some,
        }
    }

    /// Uids of its models but those that somebody means, in the order of the recipe.
    pub fn others(&self, which: &Which) -> Vec<String> {
        let rest = self.models.iter().filter(|(uid, label)| !which.uids.contains(uid) && !which.labels.contains(label));
        let mut uids: Vec<String> = rest.map(|(uid, _)| uid.clone()).collect();
        let listed = self.node.at("pick.uid").map_or(&[][..], Node::items);
        uids.sort_by_key(|uid| listed.iter().position(|node| node.text() == Some(uid)));
        uids
    }

    /// Whether poses may refer to it by this label.
    pub fn is_called(&self, label: &str) -> bool {
        match self.node.get("label").and_then(Node::text) {
            Some(own) => own == label,
            None => self.models.iter().any(|(_, own)| own == label),
        }
    }

    /// What it is called: its label, else those of its models.
    pub fn names(&self) -> String {
        if let Some(label) = self.node.get("label").and_then(Node::text) {
            return label.to_owned();
        }
        let mut labels: Vec<&str> = self.models.iter().map(|(_, label)| label.as_str()).collect();
        labels.dedup();
        match labels.len() {
            0 => self.node.get("pick").map_or_else(String::new, |pick| pick.json().to_string()),
            few if few <= 4 => labels.join(", "),
            _ => format!("{}, …", labels[..4].join(", ")),
        }
    }
}

/// What stands in the recipe, for questions.
fn what_is_there(items: &[Item<'_>]) -> String {
    let names: Vec<String> = items.iter().map(Item::names).collect();
    if names.is_empty() { "there are no objects".to_owned() } else { format!("there are {}", names.join("; ")) }
}

/// What somebody means among the items: where nothing is called just so, what passes for it.
pub(super) fn widened(which: &Which, items: &[Item<'_>]) -> Which {
    let mut which = which.clone();
    if items.iter().all(|item| item.has(&which) == Has::None) {
        let labels = items.iter().flat_map(|item| item.models.iter().map(|(_, label)| label));
        let passes = |label: &&String| which.labels.iter().any(|called| vocabulary().passes(label, called));
        let more: Vec<String> = labels.filter(passes).cloned().collect();
        which.labels.extend(more);
    }
    which
}

/// The question back where nothing is called so.
pub(super) fn nothing(which: &Which, items: &[Item<'_>]) -> Problem {
    Problem::whole(
        format!("the recipe has no {}", which.called),
        format!("{}; name one of these", what_is_there(items)),
    )
}
