//! In which order bodies find their places.

use std::collections::{BTreeMap, BTreeSet};

use super::{BodySpec, PoseSpec};

/// Exact poses first, for they stand wherever they stand; then item by item as in the recipe, but what refers to others
/// after those.
///
/// # Errors
/// A body of an item that waits for itself, by way of others.
pub(in crate::scene) fn order(bodies: &[BodySpec]) -> Result<Vec<usize>, usize> {
    let exact = |body: &usize| matches!(bodies[*body].pose, PoseSpec::At(_));
    let (mut order, rest): (Vec<usize>, Vec<usize>) = (0..bodies.len()).partition(|body| exact(body));
    let mut of_item: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
    rest.iter().for_each(|&body| of_item.entry(bodies[body].item).or_default().push(body));
    let mut waits: BTreeMap<u32, BTreeSet<u32>> =
        of_item.iter().map(|(&item, members)| (item, waits_for(item, members, bodies, &of_item))).collect();
    while !waits.is_empty() {
        let Some(ready) = waits.iter().find(|(_, others)| others.is_empty()).map(|(&item, _)| item) else {
            let stuck = waits
                .keys()
                .find_map(|item| of_item[item].iter().find(|&&body| bodies[body].pose.refers_to().is_some()));
            return Err(stuck.copied().unwrap_or_default());
        };
        waits.remove(&ready);
        waits.values_mut().for_each(|others| {
            others.remove(&ready);
        });
        order.extend(&of_item[&ready]);
    }
    Ok(order)
}

/// Items that have labels which poses of this one refer to.
fn waits_for(item: u32, members: &[usize], bodies: &[BodySpec], of_item: &BTreeMap<u32, Vec<usize>>) -> BTreeSet<u32> {
    let labels: BTreeSet<&str> =
        members.iter().filter_map(|&body| bodies[body].pose.refers_to()).map(|(_, label)| label).collect();
    let has = |others: &[usize]| others.iter().any(|&other| labels.contains(&*bodies[other].label));
    of_item.iter().filter(|(other, others)| **other != item && has(others)).map(|(&other, _)| other).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn body(item: u32, instance: u32, label: &str, pose: &str) -> BodySpec {
        let text = format!(
            "{{label: {label}, catalog: c, uid: u, pose: {pose}, clear_m: 0, tries: 1, on_failure: drop, item: {item}, \
             instance: {instance}}}"
        );
        serde_json::from_value(serde_yaml::from_str(&text).expect("YAML")).expect("a body")
    }

    const REST: &str = "{rest: {yaw_deg: 0, tip_deg: 0, burial: 0, within_m: 1}}";

    fn near(label: &str) -> String {
        format!("{{near: {{of: {label}, distance_m: 1, yaw_deg: 0, tip_deg: 0, burial: 0}}}}")
    }

    #[test]
    fn what_refers_to_others_comes_after_them() {
        let at = "{at: {position_m: [0, 0, 0], yaw_deg: 0, pitch_deg: 0, roll_deg: 0}}";
        let bodies = [
            body(0, 0, "a", &near("c")),
            body(1, 0, "b", &near("a")),
            body(2, 0, "c", REST),
            body(2, 1, "c", REST),
            body(3, 0, "d", at),
            body(4, 0, "e", &near("e")),
        ];
        assert_eq!(order(&bodies), Ok(vec![4, 2, 3, 0, 1, 5]));
    }

    #[test]
    fn circles_are_found() {
        let bodies = [body(0, 0, "x", REST), body(1, 0, "a", &near("b")), body(2, 0, "b", &near("a"))];
        assert_eq!(order(&bodies), Err(1));
    }
}
