//! Device files: the figures of real sonars, built into the program.

/// Name and text of each built-in device file, in alphabetical order.
pub const DEVICES: &[(&str, &str)] = &[
    ("aris-1200-hf", include_str!("../../catalogs/sonars/aris-1200-hf.yaml")),
    ("aris-1200-lf", include_str!("../../catalogs/sonars/aris-1200-lf.yaml")),
    ("aris-1800-hf", include_str!("../../catalogs/sonars/aris-1800-hf.yaml")),
    ("aris-1800-lf", include_str!("../../catalogs/sonars/aris-1800-lf.yaml")),
    ("aris-3000-hf", include_str!("../../catalogs/sonars/aris-3000-hf.yaml")),
    ("aris-3000-lf", include_str!("../../catalogs/sonars/aris-3000-lf.yaml")),
    ("blueview-m450-130", include_str!("../../catalogs/sonars/blueview-m450-130.yaml")),
    ("blueview-m900-130-mk2", include_str!("../../catalogs/sonars/blueview-m900-130-mk2.yaml")),
    ("blueview-p900-130", include_str!("../../catalogs/sonars/blueview-p900-130.yaml")),
    ("didson-hf", include_str!("../../catalogs/sonars/didson-hf.yaml")),
    ("didson-lf", include_str!("../../catalogs/sonars/didson-lf.yaml")),
    ("gemini-1200ik-hf", include_str!("../../catalogs/sonars/gemini-1200ik-hf.yaml")),
    ("gemini-1200ik-lf", include_str!("../../catalogs/sonars/gemini-1200ik-lf.yaml")),
    ("gemini-720is", include_str!("../../catalogs/sonars/gemini-720is.yaml")),
    ("imagenex-deltat-837", include_str!("../../catalogs/sonars/imagenex-deltat-837.yaml")),
    ("oculus-m1200d-hf", include_str!("../../catalogs/sonars/oculus-m1200d-hf.yaml")),
    ("oculus-m1200d-lf", include_str!("../../catalogs/sonars/oculus-m1200d-lf.yaml")),
    ("oculus-m3000d-hf", include_str!("../../catalogs/sonars/oculus-m3000d-hf.yaml")),
    ("oculus-m3000d-lf", include_str!("../../catalogs/sonars/oculus-m3000d-lf.yaml")),
    ("oculus-m750d-hf", include_str!("../../catalogs/sonars/oculus-m750d-hf.yaml")),
    ("oculus-m750d-lf", include_str!("../../catalogs/sonars/oculus-m750d-lf.yaml")),
    ("waterlinked-3d15-insp", include_str!("../../catalogs/sonars/waterlinked-3d15-insp.yaml")),
    ("waterlinked-3d15-nav", include_str!("../../catalogs/sonars/waterlinked-3d15-nav.yaml")),
];

/// Names of the built-in device files, in alphabetical order.
pub fn names() -> impl Iterator<Item = &'static str> {
    DEVICES.iter().map(|(name, _)| *name)
}

/// The text of a built-in device file.
#[must_use]
pub fn find(name: &str) -> Option<&'static str> {
    DEVICES.iter().find(|(known, _)| *known == name).map(|(_, text)| *text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_device_states_its_source() {
        for (name, text) in DEVICES {
            assert!(text.contains("\nsource: \""), "{name}");
            assert_eq!(find(name), Some(*text));
        }
    }
}
