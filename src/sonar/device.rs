//! The sonar itself: geometry of its ping and the figures of its transmitter and receiver.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::Grid;
use crate::math::Pose;
use crate::math::real::radians;

/// A forward-looking sonar as a recipe or a device file describes it, every figure resolved.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Sonar {
    /// Name of the device file that the figures came from, if any.
    pub device: Option<String>,
    /// Where the figures were found (data sheet, code), for device files.
    pub source: Option<String>,
    /// Receive beams, evenly spaced in bearing.
    pub beams: u32,
    /// Horizontal aperture that the beams share, degrees.
    pub azimuth_deg: f64,
    /// −3 dB width of a receive beam in bearing, degrees.
    pub beam_width_deg: f64,
    /// Vertical aperture, degrees: the two-way pattern is cut off outside it.
    pub elevation_deg: f64,
    /// One-way −3 dB width of the vertical pattern, degrees; none for an ideal sonar that hears the aperture evenly.
    pub vertical_beam_deg: Option<f64>,
    /// Elevation samples of each beam plane.
    pub elevations: u32,
    /// Nearest and farthest slant range, metres.
    pub range_m: [f64; 2],
    /// Range bins.
    pub range_bins: u32,
    /// What a beam's bearing is.
    pub bearing: Bearing,
    /// Centre frequency, kHz.
    pub frequency_khz: f64,
    /// Bandwidth of pulse and receiver, kHz.
    pub bandwidth_khz: f64,
    /// Source level, dB re 1 µPa at 1 m.
    pub source_level_db: f64,
    /// Receive directivity index, dB.
    pub directivity_db: f64,
    /// Where the sonar sits on its vehicle.
    pub mount: Mount,
}

/// What the bearing of a beam means.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Bearing {
    /// Cone angle about the array's axis, `asin(y / |C|)`: what a horizontal line array measures.
    Cone,
    /// Azimuth, `atan2(y, x)`: what a mechanically turned head or an idealised renderer measures.
    Azimuth,
}

/// The sonar's pose in the vehicle's frame.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Mount {
    /// Forward, port, up; metres.
    pub position_m: [f64; 3],
    /// To port positive, degrees.
    pub yaw_deg: f64,
    /// Up positive, degrees.
    pub pitch_deg: f64,
    /// Port side up positive, degrees.
    pub roll_deg: f64,
}

impl Mount {
    /// vehicle_from_sonar.
    #[must_use]
    pub fn pose(&self) -> Pose {
        let position = DVec3::from_array(self.position_m);
        Pose::from_angles(position, radians(self.yaw_deg), radians(self.pitch_deg), radians(self.roll_deg))
    }
}

/// A figure of a sonar that cannot be, with the key it stands under.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{key}: {problem}")]
pub struct DeviceError {
    /// Key in the sonar section (`range_m`, …).
    pub key: &'static str,
    /// What is wrong with it.
    pub problem: String,
    /// What to do.
    pub remedy: &'static str,
}

impl Sonar {
    /// Widest horizontal aperture that beam planes cover, degrees.
    pub const MAX_AZIMUTH_DEG: f64 = 170.0;
    /// Highest vertical aperture, degrees.
    pub const MAX_ELEVATION_DEG: f64 = 120.0;
    /// Most cells of one ping.
    pub const MAX_CELLS: u64 = 1 << 25;

    /// Refuses figures that no sonar has.
    ///
    /// # Errors
    /// The first impossible figure, with its key and a remedy.
    pub fn validate(&self) -> Result<(), DeviceError> {
        let [near, far] = self.range_m;
        let cells = u64::from(self.beams) * u64::from(self.range_bins.max(self.elevations));
        let within = |value: f64, low: f64, high: f64| value > low && value <= high;
        let checks: [(bool, &'static str, String, &'static str); 11] = [
            (self.beams >= 1, "beams", "a sonar has at least 1 beam".into(), "write a whole number from 1 to 4096"),
            (
                within(self.azimuth_deg, 0.0, Self::MAX_AZIMUTH_DEG),
                "azimuth_deg",
                format!("{} is not in (0, {}]", self.azimuth_deg, Self::MAX_AZIMUTH_DEG),
                "write the horizontal aperture in degrees",
            ),
            (
                within(self.elevation_deg, 0.0, Self::MAX_ELEVATION_DEG),
                "elevation_deg",
                format!("{} is not in (0, {}]", self.elevation_deg, Self::MAX_ELEVATION_DEG),
                "write the vertical aperture in degrees",
            ),
            (
                self.vertical_beam_deg.is_none_or(|width| within(width, 0.0, 180.0)),
                "vertical_beam_deg",
                "it is not in (0, 180]".into(),
                "write the -3 dB width in degrees, or null for an even pattern",
            ),
            (
                within(self.beam_width_deg, 0.0, 45.0),
                "beam_width_deg",
                format!("{} is not in (0, 45]", self.beam_width_deg),
                "write the -3 dB width of a beam in degrees",
            ),
            (self.elevations >= 2, "elevations", "at least 2 are needed".into(), "667 serves most sonars"),
            (self.range_bins >= 1, "range_bins", "at least 1 is needed".into(), "write the image height in bins"),
            (
                near > 0.0 && far > near && far <= 2000.0,
                "range_m",
                format!("[{near}, {far}] is not 0 < near < far <= 2000"),
                "write [near, far] in metres",
            ),
            (
                within(self.frequency_khz, 10.0, 10_000.0),
                "frequency_khz",
                format!("{} is not in (10, 10000]", self.frequency_khz),
                "write the centre frequency in kHz",
            ),
            (
                within(self.bandwidth_khz, 0.0, self.frequency_khz * 2.0),
                "bandwidth_khz",
                format!("{} is not in (0, 2 x frequency]", self.bandwidth_khz),
                "write the bandwidth in kHz",
            ),
            (
                cells <= Self::MAX_CELLS,
                "beams",
                format!("{cells} cells or samples are more than {}", Self::MAX_CELLS),
                "lower beams, range_bins or elevations",
            ),
        ];
        for (holds, key, problem, remedy) in checks {
            if !holds {
                return Err(DeviceError { key, problem, remedy });
            }
        }
        Ok(())
    }

    /// Length of the pulse after the receiver, metres of slant range: `c / 2B` at c = 1500 m/s.
    #[must_use]
    pub fn pulse_m(&self) -> f64 {
        1500.0 / (2.0 * 1000.0 * self.bandwidth_khz)
    }

    /// The polar grid of a ping.
    #[must_use]
    pub fn grid(&self) -> Grid {
        Grid {
            beams: self.beams,
            bins: self.range_bins,
            azimuth_deg: self.azimuth_deg,
            near_m: self.range_m[0],
            far_m: self.range_m[1],
        }
    }
}
