//! Licences by their SPDX names, from the many ways in which catalogs write them, and which of them a dataset may use.
//!
//! Knows nothing of catalogs. Says nothing about law.

use serde::{Deserialize, Serialize};

use super::asset::Asset;

/// Name of a licence that nobody stated.
pub const UNKNOWN: &str = "unknown";

/// Licences that are no Creative Commons: what to look for in lower case without separators, SPDX name, address.
const OTHERS: [(&str, &str, &str); 14] = [
    ("apache", "Apache-2.0", "https://www.apache.org/licenses/LICENSE-2.0"),
    ("mit", "MIT", "https://opensource.org/license/mit"),
    ("bsd3", "BSD-3-Clause", "https://opensource.org/license/bsd-3-clause"),
    ("bsd2", "BSD-2-Clause", "https://opensource.org/license/bsd-2-clause"),
    ("bsdlicense", "BSD-3-Clause", "https://opensource.org/license/bsd-3-clause"),
    ("agpl", "AGPL-3.0", "https://www.gnu.org/licenses/agpl-3.0.html"),
    ("lgpl", "LGPL-3.0", "https://www.gnu.org/licenses/lgpl-3.0.html"),
    ("gpl2", "GPL-2.0", "https://www.gnu.org/licenses/old-licenses/gpl-2.0.html"),
    ("gpl", "GPL-3.0", "https://www.gnu.org/licenses/gpl-3.0.html"),
    ("mpl", "MPL-2.0", "https://www.mozilla.org/MPL/2.0/"),
    ("odcby", "ODC-By-1.0", "https://opendatacommons.org/licenses/by/1-0/"),
    ("odbl", "ODbL-1.0", "https://opendatacommons.org/licenses/odbl/1-0/"),
    ("unlicense", "Unlicense", "https://unlicense.org"),
    ("isc", "ISC", "https://opensource.org/license/isc-license-txt"),
];

/// Texts that state no licence.
const NOTHING: [&str; 9] = ["", "unknown", "none", "na", "null", "notstated", "unlicensed", "other", "noassertion"];

/// A licence.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Licence {
    /// SPDX name where it has one, [`UNKNOWN`] where none is stated, else the text itself.
    pub id: String,
    /// Whether it is one that this module knows.
    pub known: bool,
}

impl Licence {
    /// The licence that a text speaks of: an SPDX name, an Objaverse code (`by-nc`), an address or a description.
    #[must_use]
    pub fn read(text: &str) -> Self {
        let text = super::text::clean(text);
        let plain: String = text.to_lowercase().chars().filter(char::is_ascii_alphanumeric).collect();
        let known = |id: String| Self { id, known: true };
        if NOTHING.contains(&plain.as_str()) {
            return Self { id: UNKNOWN.into(), known: false };
        }
        if text.starts_with("LicenseRef-") {
            return known(text);
        }
        if let Some(id) = creative_commons(&text.to_lowercase(), &plain) {
            return known(id);
        }
        let names = |key: &str| {
            if key.len() <= 3 { plain == key || plain.starts_with(&format!("{key}lic")) } else { plain.contains(key) }
        };
        let gnu = plain.contains("gnu") && plain.contains("gpl");
        match OTHERS
            .iter()
            .find(|(key, id, _)| names(key) || (gnu && *id == "GPL-3.0") || text.eq_ignore_ascii_case(id))
        {
            Some((_, id, _)) => known((*id).into()),
            None => Self { id: text, known: false },
        }
    }

    /// Where it can be read; empty if that is not known.
    #[must_use]
    pub fn url(&self) -> String {
        if self.id == "CC0-1.0" {
            return "https://creativecommons.org/publicdomain/zero/1.0/".into();
        }
        if self.id == "CC-PDDC" {
            return "https://creativecommons.org/publicdomain/mark/1.0/".into();
        }
        if let Some((terms, version)) = self.id.strip_prefix("CC-").and_then(|rest| rest.rsplit_once('-')) {
            return format!("https://creativecommons.org/licenses/{}/{version}/", terms.to_lowercase());
        }
        OTHERS.iter().find(|(_, id, _)| *id == self.id).map(|(_, _, url)| (*url).into()).unwrap_or_default()
    }
}

/// The SPDX name of a Creative Commons licence; `lower` as written, `plain` letters and digits only.
fn creative_commons(lower: &str, plain: &str) -> Option<String> {
    // What stands in brackets are remarks: `CC-BY-4.0 (also CC-BY-2.0)`.
    let head = lower.split('(').next().map(str::trim).filter(|head| !head.is_empty()).unwrap_or(lower);
    if ["cc0", "publicdomainzero", "publicdomaindedication", "creativecommonszero"]
        .iter()
        .any(|key| plain.contains(key))
        || lower.contains("publicdomain/zero")
    {
        return Some("CC0-1.0".into());
    }
    if plain == "publicdomain" || plain.contains("publicdomainmark") || plain == "creativecommonspublicdomain" {
        return Some("CC-PDDC".into());
    }
    let words: Vec<&str> =
        head.split(|c: char| !c.is_ascii_alphanumeric() && c != '.').filter(|w| !w.is_empty()).collect();
    let is_code = words.first().is_some_and(|w| matches!(*w, "by" | "cc" | "ccby")) && words.len() <= 6;
    let named = ["creative commons", "creativecommons", "attribution"].iter().any(|key| lower.contains(key));
    if !(is_code || named) {
        return None;
    }
    let has = |code: &str, names: &[&str]| words.contains(&code) || names.iter().any(|name| plain.contains(name));
    if !has("by", &["attribution", "ccby"]) {
        return None;
    }
    let mut id = String::from("CC-BY");
    for (code, names) in [("nc", &["noncommercial"][..]), ("nd", &["noderiv"]), ("sa", &["sharealike"])] {
        if has(code, names) {
            id += &format!("-{}", code.to_uppercase());
        }
    }
    let version = words.iter().find(|w| matches!(**w, "1.0" | "2.0" | "2.5" | "3.0" | "4.0"));
    Some(format!("{id}-{}", version.unwrap_or(&"4.0")))
}

/// Which licences a dataset may use: the section `licences` of a recipe.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LicencePolicy {
    /// Allowed licences, `unknown` for those that nobody stated; without the list all that are known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub allow: Option<Vec<String>>,
    /// What becomes of models under others.
    #[serde(default)]
    pub others: Others,
}

/// What becomes of a model that a pick meets and the policy does not allow.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Others {
    /// The recipe is refused.
    #[default]
    Refuse,
    /// Picks go on without it.
    LeaveOut,
}

impl LicencePolicy {
    /// Whether the policy says nothing.
    #[must_use]
    pub fn is_default(&self) -> bool {
        *self == Self::default()
    }

    /// Whether a licence may be used.
    #[must_use]
    pub fn allows(&self, licence: &Licence) -> bool {
        let listed = |text: &String| {
            let allowed = Licence::read(text);
            allowed.id == licence.id || (allowed.id == UNKNOWN && !licence.known)
        };
        match &self.allow {
            None => licence.known,
            Some(list) => list.iter().any(listed),
        }
    }

    /// The models that a pick goes on with: where others are left out, those whose licence is allowed.
    ///
    /// # Errors
    /// If none is left.
    pub fn narrowed<'m>(&self, models: Vec<&'m Asset>) -> Result<Vec<&'m Asset>, String> {
        let count = models.len();
        let may = |asset: &&Asset| match self.others {
            Others::Refuse => true,
            Others::LeaveOut => self.allows(&Licence::read(&asset.licence)),
        };
        let allowed: Vec<&Asset> = models.into_iter().filter(may).collect();
        if allowed.is_empty() {
            return Err(format!(
                "none of the {count} models of this pick is under a licence that `licences` allows; allow more, or pick others"
            ));
        }
        Ok(allowed)
    }

    /// Refuses a licence that may not be used, with the remedy.
    ///
    /// # Errors
    /// What is wrong, as a sentence about `whose` model.
    pub fn check(&self, whose: &str, licence: &str) -> Result<(), String> {
        let licence = Licence::read(licence);
        if self.allows(&licence) {
            return Ok(());
        }
        let id = &licence.id;
        Err(match &self.allow {
            Some(list) => format!(
                "the licence of `{whose}` is {id}, but `licences.allow` has only {}; add it there, or pick another model",
                list.join(", ")
            ),
            None if id == UNKNOWN => format!(
                "the licence of `{whose}` is not stated; state it in the catalog, or write `licences: {{allow: [unknown, …]}}`"
            ),
            None => format!(
                "the licence of `{whose}`, `{id}`, is none that is known; correct it in the catalog, or list it in \
                 `licences: {{allow: [\"{id}\", …]}}`"
            ),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_way_to_write_a_licence_comes_to_its_spdx_name() {
        let cases = [
            ("by", "CC-BY-4.0"),
            ("by-nc-sa", "CC-BY-NC-SA-4.0"),
            ("by-nd", "CC-BY-ND-4.0"),
            ("cc0", "CC0-1.0"),
            ("CC0-1.0 (Quaternius packs)", "CC0-1.0"),
            ("CC-BY-4.0 (LDraw library, also CC-BY-2.0)", "CC-BY-4.0"),
            ("CC-BY-3.0", "CC-BY-3.0"),
            ("CC BY-SA 4.0", "CC-BY-SA-4.0"),
            ("Creative Commons - Attribution - Non-Commercial", "CC-BY-NC-4.0"),
            ("Creative Commons - Attribution - Share Alike", "CC-BY-SA-4.0"),
            ("Creative Commons - Public Domain Dedication", "CC0-1.0"),
            ("http://creativecommons.org/licenses/by-nc/3.0/", "CC-BY-NC-3.0"),
            ("CC-BY-4.0 (http://creativecommons.org/licenses/by/4.0/)", "CC-BY-4.0"),
            ("Apache-2.0", "Apache-2.0"),
            ("MIT License", "MIT"),
            ("GNU - GPL", "GPL-3.0"),
            ("BSD License", "BSD-3-Clause"),
            ("", "unknown"),
            ("N/A", "unknown"),
            ("my own terms", "my own terms"),
            ("LicenseRef-ours", "LicenseRef-ours"),
            ("limited by permission", "limited by permission"),
        ];
        for (text, id) in cases {
            assert_eq!(Licence::read(text).id, id, "{text}");
            assert_eq!(Licence::read(&Licence::read(text).id).id, id, "{text} twice");
        }
        assert_eq!(Licence::read("by-nc").url(), "https://creativecommons.org/licenses/by-nc/4.0/");
    }

    #[test]
    fn what_nobody_stated_is_refused_unless_it_is_allowed() {
        let policy = |allow: Option<&[&str]>| LicencePolicy {
            allow: allow.map(|list| list.iter().map(|s| (*s).into()).collect()),
            ..LicencePolicy::default()
        };
        let any = policy(None);
        assert!(any.check("a", "CC-BY-NC-4.0").is_ok());
        assert!(any.check("a", "").unwrap_err().contains("not stated"));
        assert!(any.check("a", "my terms").unwrap_err().contains("my terms"));
        let free = policy(Some(&["CC0-1.0", "cc-by-4.0"]));
        assert!(free.check("a", "by").is_ok());
        assert!(free.check("a", "by-nc").unwrap_err().contains("CC-BY-NC-4.0"));
        assert!(free.check("a", "unknown").is_err());
        assert!(policy(Some(&["unknown"])).check("a", "").is_ok());
        assert!(policy(Some(&["unknown"])).check("a", "my terms").is_ok());
        assert!(policy(Some(&["unknown"])).check("a", "cc0").is_err());
        assert!(policy(Some(&["my terms"])).check("a", "my terms").is_ok());
    }
}
