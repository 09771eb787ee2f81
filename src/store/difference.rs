//! What differs between two JSON texts, in words.

use std::fs;
use std::path::Path;

use serde_json::Value;

/// Larger plans are not compared: their hashes must do.
const MOST_BYTES: u64 = 64 << 20;
/// Differences that are told.
const MOST: usize = 3;

/// The first values in which the plan in a folder differs from another.
pub(super) fn of_plans(there: &Path, ours: &[u8]) -> Option<String> {
    if fs::metadata(there).ok()?.len() > MOST_BYTES || ours.len() as u64 > MOST_BYTES {
        return None;
    }
    let there: Value = serde_json::from_slice(&fs::read(there).ok()?).ok()?;
    let ours: Value = serde_json::from_slice(ours).ok()?;
    let found = of_values(&there, &ours);
    (!found.is_empty()).then(|| found.join(", "))
}

/// The first few differences, each as `path: there → ours`.
#[must_use]
pub(crate) fn of_values(there: &Value, ours: &Value) -> Vec<String> {
    let mut found = Vec::new();
    walk(there, ours, &mut String::new(), &mut found);
    found
}

fn walk(there: &Value, ours: &Value, path: &mut String, found: &mut Vec<String>) {
    if there == ours || found.len() >= MOST {
        return;
    }
    let length = path.len();
    match (there, ours) {
        (Value::Object(a), Value::Object(b)) => {
            let keys: std::collections::BTreeSet<&String> = a.keys().chain(b.keys()).collect();
            // A single value tells more than the first of many that follow from it.
            let is_deep =
                |key: &&String| [a, b].iter().any(|map| map.get(*key).is_some_and(|v| v.is_object() || v.is_array()));
            let (deep, flat): (Vec<_>, Vec<_>) = keys.into_iter().partition(is_deep);
            for key in flat.into_iter().chain(deep) {
                path.push_str(if path.is_empty() { "" } else { "." });
                path.push_str(key);
                walk(a.get(key).unwrap_or(&Value::Null), b.get(key).unwrap_or(&Value::Null), path, found);
                path.truncate(length);
            }
        }
        (Value::Array(a), Value::Array(b)) if a.len() == b.len() => {
            for (number, (a, b)) in a.iter().zip(b).enumerate() {
                path.push_str(&format!("[{number}]"));
                walk(a, b, path, found);
                path.truncate(length);
            }
        }
        _ => found.push(format!("{path}: {} → {}", short(there), short(ours))),
    }
}

fn short(value: &Value) -> String {
    match value {
        Value::Array(items) => format!("a list of {}", items.len()),
        Value::Object(_) => "a map".to_owned(),
        Value::Null => "nothing".to_owned(),
        other => other.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn the_first_differences_are_named_with_both_values() {
        let a = json!({"seed": 7, "jobs": [{"x": 1.5}, {"x": 2}], "name": "a"});
        let b = json!({"seed": 8, "jobs": [{"x": 1.5}, {"x": 3}], "extra": true, "name": "a"});
        assert_eq!(of_values(&a, &b), ["extra: nothing → true", "seed: 7 → 8", "jobs[1].x: 2 → 3"]);
        assert!(of_values(&a, &a).is_empty());
    }
}
