//! Numbers of a recipe that people speak of, and where they stand.

use crate::draft::Problem;
use crate::draft::edit::subject::Subject;
use crate::recipe::path::under;

/// A number of a recipe that people speak of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Param {
    /// Degrees Celsius.
    Temperature,
    /// Parts per thousand.
    Salinity,
    /// Acidity.
    Ph,
    /// Depth of the bottom, metres.
    Depth,
    /// Farthest range shown, metres.
    Range,
    /// Nearest range shown, metres.
    LeastRange,
    /// Tilt of the sonar, degrees: below the horizon is negative.
    Pitch,
    /// The sonar to port, degrees.
    Yaw,
    /// Height of the vehicle over the bottom, metres.
    Altitude,
    /// Distance of the vehicle from what it looks at, metres.
    Distance,
    /// Metres a second.
    Speed,
    /// Frames of each scene.
    Frames,
    /// Scenes.
    Scenes,
    /// Seed.
    Seed,
    /// Strength shown white, decibels.
    White,
    /// Side of the seabed, metres.
    Extent,
    /// Lines of a lawnmower.
    Lines,
    /// Between lines of a lawnmower, metres.
    Spacing,
    /// From crest to crest, metres.
    Wavelength,
    /// Noise of the receiver, decibels.
    Noise,
}

impl Param {
    /// How people call it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Temperature => "temperature",
            Self::Salinity => "salinity",
            Self::Ph => "pH",
            Self::Depth => "depth",
            Self::Range => "range",
            Self::LeastRange => "nearest range",
            Self::Pitch => "pitch of the sonar",
            Self::Yaw => "yaw of the sonar",
            Self::Altitude => "altitude",
            Self::Distance => "distance",
            Self::Speed => "speed",
            Self::Frames => "frames",
            Self::Scenes => "scenes",
            Self::Seed => "seed",
            Self::White => "brightness",
            Self::Extent => "extent of the seabed",
            Self::Lines => "lines",
            Self::Spacing => "line spacing",
            Self::Wavelength => "wavelength",
            Self::Noise => "noise",
        }
    }

    /// Whether it is counted.
    pub(super) fn is_count(self) -> bool {
        matches!(self, Self::Frames | Self::Scenes | Self::Seed | Self::Lines)
    }

    /// Paths at which it stands in a recipe.
    pub(super) fn paths(self, subject: &Subject) -> Result<Vec<String>, Problem> {
        let fixed = match self {
            Self::Temperature => "water.temperature_c",
            Self::Salinity => "water.salinity_ppt",
            Self::Ph => "water.ph",
            Self::Depth => "water.depth_m",
            Self::Range => "sonar.range_m[1]",
            Self::LeastRange => "sonar.range_m[0]",
            Self::Pitch => "sonar.mount.pitch_deg",
            Self::Yaw => "sonar.mount.yaw_deg",
            Self::Frames => "frames",
            Self::Scenes => "scenes",
            Self::Seed => "seed",
            Self::White => "image.display.white_db",
            Self::Extent => "seabed.extent_m",
            Self::Noise => "image.model.physical.receiver.noise_figure_db",
            Self::Altitude | Self::Distance | Self::Speed | Self::Lines | Self::Spacing => {
                return self.of_kinds(subject, "trajectory");
            }
            Self::Wavelength => return self.of_kinds(subject, "seabed.shape"),
        };
        Ok(vec![fixed.to_owned()])
    }

    fn of_kinds(self, subject: &Subject, path: &str) -> Result<Vec<String>, Problem> {
        let kinds = subject.kinds(path);
        let paths: Vec<String> = kinds.iter().filter_map(|(path, kind)| Some(within(path, self.key(kind)?))).collect();
        if paths.is_empty() {
            let names: Vec<&str> = kinds.iter().map(|(_, kind)| kind.as_str()).collect();
            let there = if names.is_empty() {
                format!("there is no {path}")
            } else {
                format!("{path} is {}", names.join(", "))
            };
            let what = format!("no {} can be changed: {there}", self.name());
            return Err(Problem::whole(what, format!("change the {path} first, or use --set")));
        }
        Ok(paths)
    }

    /// Its key among the parameters of a kind.
    fn key(self, kind: &str) -> Option<&'static str> {
        Some(match (self, kind) {
            (Self::Altitude, "orbit" | "lawnmower" | "terrain" | "approach" | "views") => "altitude_m",
            (Self::Altitude, "hover") => "position_m[2]",
            (Self::Distance, "orbit") => "radius_m",
            (Self::Distance, "views") => "range_m",
            (Self::Distance, "approach") => "to_m",
            (Self::Speed, "orbit" | "lawnmower" | "terrain" | "approach" | "waypoints") => "speed_m_s",
            (Self::Lines, "lawnmower") => "lines",
            (Self::Spacing, "lawnmower") => "spacing_m",
            (Self::Wavelength, "ripples" | "sand-waves") => "wavelength_m",
            _ => return None,
        })
    }
}

fn within(path: &str, key: &str) -> String {
    match key.split_once('[') {
        Some((name, rest)) => format!("{}[{rest}", under(path, name)),
        None => under(path, key),
    }
}
