//! Changes of the list of objects.

use super::item::{Has, Item, items, nothing, widened};
use super::pose::{self, Posing};
use super::{Acts, Addition, Move, Named, NumberOf, Which, values};
use crate::draft::edit::act::{Act, list, map, number as numeral, word};
use crate::draft::edit::numbers;
use crate::draft::edit::subject::{Subject, Whose};
use crate::draft::wish::{Count, Stand};
use crate::draft::{Known, Models, Problem};
use crate::recipe::Node;

fn own_list(subject: &Subject) -> Result<(), Problem> {
    match subject.said("objects") {
        Some((_, Whose::Included)) => {
            Err(Problem::whole("the objects stand in an included file", "change that file: a list is taken whole"))
        }
        _ => Ok(()),
    }
}

/// All of a kind go: whole items, or their models out of a list of several.
pub(super) fn remove(subject: &Subject, known: &Known, which: &Which) -> Result<Acts, Problem> {
    own_list(subject)?;
    let items = items(subject, known);
    let which = &widened(which, &items);
    let mut acts = Acts::default();
    for item in items.iter().rev() {
        acts = match item.has(which) {
            Has::All => acts.with(Acts::one(Act::Remove { path: item.path.clone() })),
            Has::Some => acts.with(without(item, which)),
            Has::None => acts,
        };
    }
    if acts.acts.is_empty() {
        return Err(nothing(which, &items));
    }
    Ok(acts)
}

/// An item of several models, without some.
fn without(item: &Item<'_>, which: &Which) -> Acts {
    let value = words_of(&item.others(which));
    let pick = item.node.get("pick");
    let is_listed = pick.and_then(|pick| pick.get("uid")).is_some();
    if is_listed {
        return Acts::one(Act::set(format!("{}.pick.uid", item.path), value));
    }
    let catalog = pick.and_then(|pick| pick.get("catalog")).cloned().unwrap_or_else(|| word(""));
    let note = format!("`{}.pick` lists its models now: all that it had but {}", item.path, which.called);
    Acts::one(Act::set(format!("{}.pick", item.path), map([("catalog", catalog), ("uid", value)]))).note(note)
}

/// Objects whose pose refers to what no other object is called: what they are called, and to what.
pub(super) fn orphans(subject: &Subject, known: &Known) -> Vec<[String; 2]> {
    let items = items(subject, known);
    let alone =
        |item: &&Item<'_>, of: &str| !items.iter().any(|other| other.index != item.index && other.is_called(of));
    let orphan = |item: &Item<'_>| {
        let (_, of) = pose::refers_to(item.node)?;
        alone(&item, of).then(|| [item.names(), of.to_owned()])
    };
    items.iter().filter_map(orphan).collect()
}

/// All objects go.
pub(super) fn clear(subject: &Subject) -> Result<Acts, Problem> {
    own_list(subject)?;
    match subject.said("objects") {
        Some((node, _)) if !node.items().is_empty() => Ok(Acts::one(Act::set("objects", list(Vec::new())))),
        _ => Ok(Acts::default().note("there are no objects in the recipe")),
    }
}

/// Objects more.
pub(super) fn add(subject: &Subject, known: &Known, addition: &Addition) -> Result<Acts, Problem> {
    own_list(subject)?;
    let items = items(subject, known);
    let wanted = pick_of(&addition.thing.models);
    let uids = &addition.thing.models.uids;
    let same = |item: &&Item<'_>| !item.models.is_empty() && item.models.iter().all(|(uid, _)| uids.contains(uid));
    let places = addition.stands.iter().any(|stand| !matches!(stand, Stand::Resting));
    if addition.is_more
        && !places
        && let Some(item) = items.iter().find(same)
        && let Count::Exactly(more) = addition.count
    {
        return moved(subject, item, Move::By(f64::from(more)));
    }
    let posing = Posing { subject, items: &items };
    let pose = posing.pose(&addition.thing, &addition.stands)?;
    let mut entries = Vec::new();
    let asset_label = addition.thing.models.label.as_deref();
    if asset_label != Some(addition.thing.label.as_str()) && asset_label.is_none() {
        entries.push(("label", word(&addition.thing.label)));
    }
    entries.push(("pick", wanted));
    if addition.count != Count::Exactly(1) {
        entries.push(("count", count_of(addition.count)));
    }
    entries.extend(pose.clear_m.map(|clear_m| ("clear_m", numeral(clear_m))));
    entries.extend(pose.value.map(|pose| ("pose", pose)));
    let mut acts = Acts::one(Act::Insert { list: "objects".to_owned(), index: items.len(), value: map(entries) });
    acts.notes = pose.notes;
    Ok(acts)
}

/// What a recipe says of models.
fn pick_of(models: &Models) -> Node {
    let catalog = ("catalog", word(&models.catalog));
    match &models.label {
        Some(label) if models.is_whole_label && models.uids.len() > 1 => map([catalog, ("label", word(label))]),
        _ => map([catalog, ("uid", words_of(&models.uids))]),
    }
}

/// One word, or a list of several.
fn words_of(words: &[String]) -> Node {
    match words {
        [one] => word(one),
        several => list(several.iter().map(|text| word(text)).collect()),
    }
}

fn count_of(count: Count) -> Node {
    match count {
        Count::Exactly(count) => numeral(f64::from(count)),
        Count::Between(least, most) => map([("int", list(vec![numeral(f64::from(least)), numeral(f64::from(most))]))]),
    }
}

/// Other models in the stead of some.
pub(super) fn swap(subject: &Subject, known: &Known, which: &Which, thing: &Named) -> Result<Acts, Problem> {
    own_list(subject)?;
    let items = items(subject, known);
    let which = &widened(which, &items);
    let mut acts = Acts::default();
    for item in &items {
        match item.has(which) {
            Has::None => {}
            Has::All => acts = acts.with(swapped(item, &items, thing)),
            Has::Some => {
                let mut uids = item.others(which);
                uids.extend(thing.models.uids.iter().filter(|uid| !uids.contains(uid)).cloned().collect::<Vec<_>>());
                acts.acts.push(Act::set(format!("{}.pick.uid", item.path), words_of(&uids)));
            }
        }
    }
    if acts.acts.is_empty() { Err(nothing(which, &items)) } else { Ok(acts) }
}

/// An item with other models; what stands by it refers to them then.
fn swapped(item: &Item<'_>, items: &[Item<'_>], thing: &Named) -> Acts {
    let mut acts = Acts::one(Act::set(format!("{}.pick", item.path), pick_of(&thing.models)));
    let own = item.node.get("label").and_then(Node::text);
    let new = match (own, &thing.models.label) {
        (None, Some(label)) => label,
        _ => &thing.label,
    };
    if own.is_some() || thing.models.label.is_none() {
        acts.acts.push(Act::set(format!("{}.label", item.path), word(new)));
    }
    for other in items {
        if let Some((path, of)) = pose::refers_to(other.node)
            && item.is_called(of)
        {
            acts.acts.push(Act::set(format!("{}.{path}", other.path), word(new)));
        }
    }
    acts
}

/// Another number of some.
pub(super) fn number(subject: &Subject, known: &Known, which: &Which, number: NumberOf) -> Result<Acts, Problem> {
    own_list(subject)?;
    let items = items(subject, known);
    let which = &widened(which, &items);
    let whole: Vec<&Item<'_>> = items.iter().filter(|item| item.has(which) == Has::All).collect();
    let mixed = items.iter().find(|item| item.has(which) == Has::Some);
    match (&whole[..], mixed, number) {
        ([], Some(item), _) => {
            let what =
                format!("{} are some of what `{}` picks, and its count is for all of them", which.called, item.path);
            let help = format!(
                "change the count of all with --set {}.count=…, or add some: `add two {}`",
                item.path, which.called
            );
            Err(Problem::whole(what, help))
        }
        ([], None, _) => Err(nothing(which, &items)),
        ([item], _, NumberOf::Count(count)) => values::set(subject, &format!("{}.count", item.path), count_of(count)),
        ([_, _, ..], _, NumberOf::Count(_)) => {
            let paths: Vec<&str> = whole.iter().map(|item| item.path.as_str()).collect();
            let what = format!("{} are at several places: {}", which.called, paths.join(", "));
            Err(Problem::whole(what, format!("say which with --set {}.count=…", paths[0])))
        }
        (all, _, NumberOf::Moved(how)) => {
            all.iter().try_fold(Acts::default(), |acts, item| Ok(acts.with(moved(subject, item, how)?)))
        }
    }
}

/// More or fewer of an item.
fn moved(subject: &Subject, item: &Item<'_>, how: Move) -> Result<Acts, Problem> {
    let path = format!("{}.count", item.path);
    let one = numeral(1.0);
    let there = subject.said(&path).map_or(&one, |(node, _)| node);
    let moved = if let Some(count) = there.number() {
        Some(numeral(how.of(count).round().max(0.0)))
    } else {
        numbers::moved(there, how)
    };
    match moved {
        Some(value) => Ok(Acts::one(Act::set(path, value))),
        None => Err(Problem::whole(
            format!("`{path}` is {}", there.describe()),
            format!("say the whole count: --set {path}=…"),
        )),
    }
}

/// How some stand.
pub(super) fn stand(subject: &Subject, known: &Known, which: &Which, stands: &[Stand]) -> Result<Acts, Problem> {
    own_list(subject)?;
    let items = items(subject, known);
    let which = &widened(which, &items);
    if items.iter().all(|item| item.has(which) == Has::None) {
        return Err(nothing(which, &items));
    }
    let whole: Vec<&Item<'_>> = items.iter().filter(|item| item.has(which) == Has::All).collect();
    if whole.is_empty() {
        let what = format!("{} are among others of one item, which stand alike", which.called);
        return Err(Problem::whole(what, "say it of all of them with --set, or add some of their own"));
    }
    let posing = Posing { subject, items: &items };
    whole.iter().try_fold(Acts::default(), |acts, item| Ok(acts.with(posing.changed(item, stands)?)))
}

/// Whether a recipe has what somebody calls so.
pub(in crate::draft::edit) fn has(subject: &Subject, known: &Known, which: &Which) -> bool {
    let items = items(subject, known);
    let which = widened(which, &items);
    items.iter().any(|item| item.has(&which) != Has::None)
}

/// The label by which poses refer to what somebody calls so.
pub(in crate::draft::edit) fn label_of(subject: &Subject, known: &Known, which: &Which) -> Option<String> {
    let items = items(subject, known);
    let which = &widened(which, &items);
    let of_item = |item: &Item<'_>, wanted: Has| {
        if item.has(which) != wanted {
            return None;
        }
        let own = item.node.get("label").and_then(Node::text).map(str::to_owned);
        own.or_else(|| {
            item.models
                .iter()
                .find(|(uid, label)| which.uids.contains(uid) || which.labels.contains(label))
                .map(|(_, label)| label.clone())
        })
    };
    [Has::All, Has::Some].into_iter().find_map(|wanted| items.iter().find_map(|item| of_item(item, wanted)))
}
