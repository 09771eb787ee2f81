//! The nearest valid word to one that was mistyped.

use super::error::quoted;

/// Words listed in a remedy before the rest is counted.
const LISTED: usize = 24;

/// The valid word that was probably meant; `None` when nothing is near.
///
/// Near is: the same but for case, hyphens and a missing unit (`depth` for `depth_m`), or about one slip in three letters.
#[must_use]
pub fn nearest<'a>(word: &str, valid: &[&'a str]) -> Option<&'a str> {
    if word.chars().count() > 64 {
        return None;
    }
    let plain = plain(word);
    let distance = |candidate: &&'a str| {
        let other = self::plain(candidate);
        let unit_missing = !plain.is_empty() && other.starts_with(&format!("{plain}_"));
        let steps = if unit_missing { 1 } else { strsim::damerau_levenshtein(&plain, &other) };
        let allowed = (plain.chars().count().max(other.chars().count()) / 3).clamp(1, 4);
        // A word of one or two letters is one slip from too many others.
        (steps <= allowed && (steps == 0 || plain.len() > 1)).then_some((steps, *candidate))
    };
    // The first of equals wins: the order of `valid` is the author's.
    valid.iter().filter_map(distance).min_by_key(|(steps, _)| *steps).map(|(_, candidate)| candidate)
}

/// A remedy that offers the nearest word and lists the valid ones.
#[must_use]
pub fn did_you_mean(word: &str, valid: &[&str]) -> String {
    let list = listed(valid);
    match nearest(word, valid) {
        Some(near) => format!("did you mean {}? (valid: {list})", quoted(near)),
        None if valid.is_empty() => "remove it: nothing is valid here".to_owned(),
        None => format!("valid: {list}"),
    }
}

/// The words as `a, b, c`, cut when there are very many.
pub(crate) fn listed(words: &[&str]) -> String {
    let shown = words[..words.len().min(LISTED)].join(", ");
    match words.len().saturating_sub(LISTED) {
        0 => shown,
        more => format!("{shown}, … {more} more"),
    }
}

fn plain(word: &str) -> String {
    word.to_lowercase().replace(['-', ' '], "_")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn near_words_are_found_and_far_ones_are_not() {
        let keys = ["wavelength_m", "height_m", "depth_m", "direction_deg"];
        for (typed, meant) in [
            ("wavelenth_m", Some("wavelength_m")),
            ("wavelength", Some("wavelength_m")),
            ("Depth-M", Some("depth_m")),
            ("depth", Some("depth_m")),
            ("hieght_m", Some("height_m")),
            ("colour", None),
            ("", None),
            ("m", None),
        ] {
            assert_eq!(nearest(typed, &keys), meant, "{typed}");
        }
        assert_eq!(nearest(&"x".repeat(100_000), &keys), None);
        assert_eq!(nearest("uniformm", &["uniform", "log_uniform"]), Some("uniform"));
    }

    #[test]
    fn the_remedy_lists_what_is_valid() {
        assert_eq!(did_you_mean("flatt", &["flat", "ripples"]), "did you mean `flat`? (valid: flat, ripples)");
        assert_eq!(did_you_mean("moon", &["flat", "ripples"]), "valid: flat, ripples");
        assert_eq!(did_you_mean("moon", &[]), "remove it: nothing is valid here");
        assert!(listed(&["w"; 30]).ends_with("w, … 6 more"));
    }
}
