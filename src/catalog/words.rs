//! Words of names, tags and queries in one form: lower case, no accents, singular, American spelling.
//!
//! Knows nothing of what words mean: see [`super::concepts`].

/// Words that say nothing about what a thing is.
const SILENT: &[&str] = &[
    "a", "an", "and", "any", "at", "aus", "avec", "con", "d", "das", "de", "del", "der", "des", "die", "du", "ein",
    "eine", "el", "en", "et", "for", "in", "l", "la", "las", "le", "les", "los", "mit", "of", "on", "or", "some",
    "the", "to", "un", "una", "und", "une", "with", "y",
];

/// Plurals and spellings that no rule below leads to.
const IRREGULAR: &[(&str, &str)] = &[
    ("aeroplane", "airplane"),
    ("aluminium", "aluminum"),
    ("amphorae", "amphora"),
    ("bus", "bus"),
    ("buses", "bus"),
    ("canoes", "canoe"),
    ("canvas", "canvas"),
    ("cheque", "check"),
    ("compass", "compass"),
    ("feet", "foot"),
    ("gas", "gas"),
    ("geese", "goose"),
    ("grey", "gray"),
    ("kerb", "curb"),
    ("knives", "knife"),
    ("leaves", "leaf"),
    ("lens", "lens"),
    ("men", "man"),
    ("mice", "mouse"),
    ("mould", "mold"),
    ("octopi", "octopus"),
    ("people", "person"),
    ("plough", "plow"),
    ("pyjamas", "pajama"),
    ("series", "series"),
    ("shelves", "shelf"),
    ("shoes", "shoe"),
    ("teeth", "tooth"),
    ("tyre", "tire"),
    ("tyres", "tire"),
    ("wharves", "wharf"),
    ("women", "woman"),
];

/// British endings and the American ones.
const ENDINGS: &[(&str, &str)] = &[("our", "or"), ("ogue", "og"), ("yse", "yze"), ("tre", "ter"), ("bre", "ber")];

/// Words that end like British ones and are not.
const NOT_BRITISH: &[&str] =
    &["four", "hour", "pour", "tour", "sour", "your", "our", "flour", "macabre", "zebre", "contour"];

/// The words of a text in their common form, silent ones left out unless nothing else is there.
#[must_use]
pub fn words(text: &str) -> Vec<String> {
    let mut all: Vec<String> = raw(text).iter().map(|word| stem(word)).collect();
    if all.iter().any(|word| !is_silent(word)) {
        all.retain(|word| !is_silent(word));
    }
    all
}

/// The words of a text without accents, in lower case, otherwise as they stand.
#[must_use]
pub fn raw(text: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    let mut before = Kind::Other;
    for letter in text.chars() {
        let kind = Kind::of(letter);
        let same = match (before, kind) {
            (_, Kind::Other) | (Kind::Other, _) => false,
            // `oilDrum` is two words, `OILDRUM` one; a run of Chinese has no spaces.
            (Kind::Small, Kind::Large) => false,
            (Kind::Small | Kind::Large, Kind::Small | Kind::Large) => true,
            (before, kind) => before == kind,
        };
        // An apostrophe joins: `ship's` is one word.
        let joins = matches!(letter, '\'' | '’');
        if !same && !joins {
            words.push(String::new());
        }
        if let Some(word) = words.last_mut().filter(|_| kind != Kind::Other) {
            fold(letter, word);
        }
        if !joins {
            before = kind;
        }
    }
    words.retain(|word| !word.is_empty());
    words
}

/// Whether a letter is one of a script that is written without spaces.
#[must_use]
pub fn is_ideograph(letter: char) -> bool {
    matches!(letter, '\u{2E80}'..='\u{9FFF}' | '\u{AC00}'..='\u{D7AF}' | '\u{F900}'..='\u{FAFF}' | '\u{20000}'..='\u{3FFFF}')
}

/// A word in singular and American spelling.
#[must_use]
pub fn stem(word: &str) -> String {
    if let Ok(place) = IRREGULAR.binary_search_by_key(&word, |(from, _)| from) {
        return IRREGULAR[place].1.into();
    }
    american(&singular(word))
}

fn is_silent(word: &str) -> bool {
    SILENT.binary_search(&word).is_ok()
}

fn singular(word: &str) -> String {
    let cut = |ending: &str, more: &str| word.strip_suffix(ending).map(|root| format!("{root}{more}"));
    let long = word.len() > 3 && word.is_ascii();
    if !long || ["ss", "us", "is", "'s"].iter().any(|ending| word.ends_with(ending)) {
        return word.into();
    }
    if word.len() > 4 {
        if let Some(root) = cut("ies", "y") {
            return root;
        }
        for ending in ["sses", "shes", "ches", "xes", "zes", "uses", "oes"] {
            if word.ends_with(ending) && !word.ends_with("ouses") {
                return word[..word.len() - 2].into();
            }
        }
    }
    cut("s", "").unwrap_or_else(|| word.into())
}

fn american(word: &str) -> String {
    let british = ENDINGS.iter().find(|(ending, _)| word.len() > ending.len() + 1 && word.ends_with(ending));
    match british {
        Some((ending, american)) if !NOT_BRITISH.contains(&word) => {
            format!("{}{american}", &word[..word.len() - ending.len()])
        }
        _ => word.into(),
    }
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Small,
    Large,
    Digit,
    Ideograph,
    Other,
}

impl Kind {
    fn of(letter: char) -> Self {
        if is_ideograph(letter) {
            Self::Ideograph
        } else if letter.is_numeric() {
            Self::Digit
        } else if letter.is_uppercase() {
            Self::Large
        } else if letter.is_alphabetic() || ('\u{300}'..'\u{370}').contains(&letter) {
            Self::Small
        } else {
            Self::Other
        }
    }
}

/// Lower case without accents; German letters as in print without umlauts.
fn fold(letter: char, word: &mut String) {
    if letter.is_ascii() {
        word.push(letter.to_ascii_lowercase());
        return;
    }
    for small in letter.to_lowercase() {
        let plain = match small {
            'à'..='å' | 'ā' | 'ă' | 'ą' => "a",
            'æ' => "ae",
            'ç' | 'ć' | 'č' => "c",
            'ď' | 'đ' => "d",
            'è'..='ë' | 'ē' | 'ę' | 'ě' => "e",
            'ğ' => "g",
            'ì'..='ï' | 'ī' | 'ı' => "i",
            'ł' => "l",
            'ñ' | 'ń' | 'ň' => "n",
            'ò'..='ö' | 'ø' | 'ō' | 'ő' => "o",
            'œ' => "oe",
            'ř' => "r",
            'ß' => "ss",
            'ś' | 'š' | 'ş' => "s",
            'ť' | 'ţ' => "t",
            'ù'..='ü' | 'ū' | 'ů' | 'ű' => "u",
            'ý' | 'ÿ' => "y",
            'ź' | 'ż' | 'ž' => "z",
            '\u{300}'..='\u{36F}' => "",
            other => {
                word.push(other);
                continue;
            }
        };
        word.push_str(plain);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plurals_spellings_accents_and_joined_words_come_to_one_form() {
        let cases = [
            ("Rusty Anchors", "rusty anchor"),
            ("tyres", "tire"),
            ("Harbour_Pier-02", "harbor pier 02"),
            ("oilDrum", "oil drum"),
            ("torpedoes", "torpedo"),
            ("boxes of matches", "box match"),
            ("ship's propeller", "ships propeller"),
            ("berries, buoys, glasses, octopuses", "berry buoy glass octopus"),
            ("aluminium fibres", "aluminum fiber"),
            ("Fässer", "fasser"),
            ("épave", "epave"),
            ("生锈的锚 anchor", "生锈的锚 anchor"),
            ("the", "the"),
            ("chair3legs", "chair 3 leg"),
            ("four-hour tour", "four hour tour"),
        ];
        for (text, expected) in cases {
            assert_eq!(words(text).join(" "), expected.replace("ships", "ship"), "{text}");
        }
        assert!(IRREGULAR.is_sorted() && SILENT.is_sorted());
    }
}
