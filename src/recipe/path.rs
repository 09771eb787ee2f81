//! Paths of values: `objects[0].pose.rest.burial`.
//!
//! A key that is not a plain word is written `["sonar.device"]`, so that different leaves never share a path.

/// One step down a tree.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Step {
    /// Into a map.
    Key(String),
    /// Into a list.
    Index(usize),
}

/// Path of the value under `key`.
pub(crate) fn under(path: &str, key: &str) -> String {
    let is_word = !key.is_empty() && key.chars().all(|c| c.is_alphanumeric() || c == '_' || c == '-');
    match (is_word, path.is_empty()) {
        (true, true) => key.to_owned(),
        (true, false) => format!("{path}.{key}"),
        (false, _) => format!("{path}[{}]", serde_json::Value::from(key)),
    }
}

/// Path of the item at `index`.
pub(crate) fn item(path: &str, index: usize) -> String {
    format!("{path}[{index}]")
}

/// The pattern that a path is one of: `objects[0].pose` is of `objects[].pose`.
pub(crate) fn pattern(path: &str) -> String {
    let mut pattern = String::new();
    for step in steps(path).unwrap_or_default() {
        match step {
            Step::Key(key) => pattern = under(&pattern, &key),
            Step::Index(_) => pattern.push_str("[]"),
        }
    }
    pattern
}

/// The steps of a path; what is wrong with it otherwise. The empty path has none.
pub(crate) fn steps(path: &str) -> Result<Vec<Step>, String> {
    let mut steps = Vec::new();
    let mut rest = path;
    while !rest.is_empty() {
        if let Some(inside) = rest.strip_prefix('[') {
            let (step, after) = bracket(inside)?;
            steps.push(step);
            rest = after;
        } else {
            let start = if steps.is_empty() { rest } else { rest.strip_prefix('.').ok_or("expected `.` or `[`")? };
            let end = start.find(['.', '[']).unwrap_or(start.len());
            if end == 0 {
                return Err("a key is missing".to_owned());
            }
            steps.push(Step::Key(start[..end].to_owned()));
            rest = &start[end..];
        }
    }
    Ok(steps)
}

/// What stands behind `[`: a number or a quoted key, and the rest behind `]`.
fn bracket(inside: &str) -> Result<(Step, &str), String> {
    let (step, after) = if inside.starts_with('"') {
        let mut words = serde_json::Deserializer::from_str(inside).into_iter::<String>();
        let key = words.next().and_then(Result::ok).ok_or("a quoted key has no end")?;
        (Step::Key(key), &inside[words.byte_offset()..])
    } else {
        let end = inside.find(']').ok_or("`[` has no `]`")?;
        let index = inside[..end].parse().map_err(|_| format!("`[{}]` is not an item's number", &inside[..end]))?;
        (Step::Index(index), &inside[end..])
    };
    Ok((step, after.strip_prefix(']').ok_or("`[` has no `]`")?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_turn_back_into_steps() {
        let keys = ["a", "höhe_m", "sonar.device", "", "x[0]", "quote\"d", "#1", "1/a"];
        for key in keys {
            let path = under(&item(&under(&under("", "root"), key), 3), key);
            let expected =
                [Step::Key("root".into()), Step::Key(key.into()), Step::Index(3), Step::Key(key.into())].to_vec();
            assert_eq!(steps(&path), Ok(expected), "{path}");
        }
        assert_eq!(under("a.b", "c"), "a.b.c");
        assert_eq!(steps(""), Ok(vec![]));
    }

    #[test]
    fn patterns_forget_numbers() {
        assert_eq!(pattern("objects[12].pose.rest"), "objects[].pose.rest");
    }

    #[test]
    fn malformed_paths_are_refused() {
        for path in ["a..b", ".a", "a[", "a[x]", "a[-1]", "a[0]b", "a[\"b]", "a[\"b\"", "a."] {
            assert!(steps(path).is_err(), "{path}");
        }
    }
}
