//! The vertex attributes of a primitive that move vertices, by name.

use std::fmt;

use serde::de::{Deserialize, Deserializer, IgnoredAny, MapAccess, Visitor};

/// Most sets of four joints a vertex.
pub(super) const JOINT_SETS: usize = 4;

/// Numbers (of accessors, or within a compressed stream) of the attributes that geometry needs.
#[derive(Clone, Debug, Default)]
pub(super) struct Attributes {
    pub position: Option<u32>,
    /// `JOINTS_n`.
    pub joints: [Option<u32>; JOINT_SETS],
    /// `WEIGHTS_n`.
    pub weights: [Option<u32>; JOINT_SETS],
    /// Some other attribute, whose length tells how many vertices there are where no position does.
    pub other: Option<u32>,
}

impl<'de> Deserialize<'de> for Attributes {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(ByName)
    }
}

struct ByName;

impl<'de> Visitor<'de> for ByName {
    type Value = Attributes;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("attribute names with numbers")
    }

    fn visit_map<M: MapAccess<'de>>(self, mut map: M) -> Result<Attributes, M::Error> {
        let mut found = Attributes::default();
        while let Some(name) = map.next_key::<std::borrow::Cow<'de, str>>()? {
            let set = |prefix| name.strip_prefix(prefix).and_then(|n| n.parse::<usize>().ok()).filter(|n| *n < 4);
            if name == "POSITION" {
                found.position = Some(map.next_value()?);
            } else if let Some(n) = set("JOINTS_") {
                found.joints[n] = Some(map.next_value()?);
            } else if let Some(n) = set("WEIGHTS_") {
                found.weights[n] = Some(map.next_value()?);
            } else if matches!(&*name, "NORMAL" | "TANGENT" | "TEXCOORD_0" | "COLOR_0") {
                found.other = Some(map.next_value()?);
            } else {
                map.next_value::<IgnoredAny>()?;
            }
        }
        Ok(found)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_sorted_into_kinds() {
        let text = r#"{"POSITION": 3, "JOINTS_1": 4, "WEIGHTS_0": 5, "JOINTS_9": 6, "_ID": "any", "NORMAL": 7}"#;
        let found: Attributes = serde_json::from_str(text).expect("attributes");
        assert_eq!((found.position, found.other), (Some(3), Some(7)));
        assert_eq!((found.joints, found.weights), ([None, Some(4), None, None], [Some(5), None, None, None]));
        assert!(serde_json::from_str::<Attributes>(r#"{"POSITION": -1}"#).is_err());
    }
}
