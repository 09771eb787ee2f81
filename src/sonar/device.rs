//! The sonar itself: geometry of its ping and the figures of its transmitter and receiver.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::Grid;
use crate::math::real::radians;
use crate::math::{Impossible, Pose};
use crate::physics::motion::change_during_ping;

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
    /// Rate at which the vehicle turns during a ping, to port positive, degrees a second: far echoes come back to an array
    /// that has turned on.
    pub yaw_rate_deg_s: f64,
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

impl Sonar {
    /// Widest horizontal aperture that beam planes cover, degrees.
    pub const MAX_AZIMUTH_DEG: f64 = 170.0;
    /// Highest vertical aperture, degrees.
    pub const MAX_ELEVATION_DEG: f64 = 120.0;
    /// Most beams, bins or elevations.
    pub const MAX_SIDE: u32 = 8192;

    /// Refuses figures that no sonar has.
    ///
    /// # Errors
    /// The first impossible figure, with its key and a remedy.
    pub fn validate(&self) -> Result<(), Impossible> {
        let [near, far] = self.range_m;
        let most = f64::from(Self::MAX_SIDE);
        let above_0 = f64::MIN_POSITIVE;
        Impossible::outside("beams", f64::from(self.beams), 1.0, most)?;
        Impossible::outside("elevations", f64::from(self.elevations), 2.0, most)?;
        Impossible::outside("range_bins", f64::from(self.range_bins), 1.0, most)?;
        Impossible::outside("azimuth_deg", self.azimuth_deg, 0.01, Self::MAX_AZIMUTH_DEG)?;
        Impossible::outside("elevation_deg", self.elevation_deg, above_0, Self::MAX_ELEVATION_DEG)?;
        Impossible::outside("beam_width_deg", self.beam_width_deg, 0.02, 45.0)?;
        Impossible::outside("vertical_beam_deg", self.vertical_beam_deg.unwrap_or(1.0), above_0, 180.0)?;
        Impossible::outside("frequency_khz", self.frequency_khz, 10.0, 10_000.0)?;
        Impossible::outside("bandwidth_khz", self.bandwidth_khz, 0.1, 2.0 * self.frequency_khz)?;
        Impossible::outside("source_level_db", self.source_level_db, 100.0, 260.0)?;
        Impossible::outside("directivity_db", self.directivity_db, 0.0, 60.0)?;
        Impossible::outside("yaw_rate_deg_s", self.yaw_rate_deg_s, -360.0, 360.0)?;
        let possible = near > 0.0 && far > near && far <= 2000.0;
        let problem = format!("[{near}, {far}] is not 0 < near < far <= 2000");
        Impossible::unless(possible, "range_m", problem, "write [near, far] in metres")
    }

    /// Beams that the array turns by while sound travels to a range of 1 m and back, at c = 1500 m/s; to port positive.
    #[must_use]
    pub fn turn_beams_per_m(&self) -> f64 {
        change_during_ping(radians(self.yaw_rate_deg_s), 1.0, 1500.0) / self.grid().beam_rad()
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
