//! Which sonar, where nobody says so, and what its figures make possible.

use serde::Deserialize;

use crate::catalog::sonars;
use crate::math::real::radians;

/// Beams over the smallest thing at its distance, at least: its outline is seen.
const BEAMS_A_THING: f64 = 12.0;
/// Two beams this part of their width apart tell two things apart; closer ones show no more.
const APART: f64 = 0.5;
/// Part of a device's range that images may take: its ends are faint.
const USED: f64 = 0.8;
/// What is chosen from, in the order of preference: wide fans before narrow ones, fine before far.
const PREFERRED: [(&str, &str); 4] = [
    ("oculus-m1200d-lf", "1.2 MHz over 130 degrees suits things of some decimetres within 20 m"),
    ("oculus-m1200d-hf", "2.1 MHz shows small things from near"),
    ("oculus-m750d-lf", "750 kHz sees far"),
    ("blueview-m450-130", "450 kHz sees beyond 100 m"),
];
/// Farthest range that the first of them is chosen for, metres: beyond it 750 kHz hears more.
const FINE_TO_M: f64 = 20.0;
/// A device is chosen for a frequency that is at most this ratio from its own.
const SAME_FREQUENCY: f64 = 1.12;

/// Figures of a device.
#[derive(Clone, Debug, PartialEq)]
pub struct Device {
    /// Its name.
    pub name: String,
    /// Beams.
    pub beams: u32,
    /// Width of the fan, degrees.
    pub azimuth_deg: f64,
    /// -3 dB width of a beam, degrees.
    pub beam_width_deg: f64,
    /// -3 dB height of the fan, degrees.
    pub vertical_deg: f64,
    /// Kilohertz.
    pub frequency_khz: f64,
    /// Ranges that its maker gives, metres.
    pub range_m: [f64; 2],
}

#[derive(Deserialize)]
struct Figures {
    beams: u32,
    azimuth_deg: f64,
    beam_width_deg: f64,
    vertical_beam_deg: f64,
    elevation_deg: f64,
    frequency_khz: f64,
}

/// A built-in device.
#[must_use]
pub fn device(name: &str) -> Option<Device> {
    let text = sonars::find(name)?;
    let figures: Figures = serde_yaml::from_str(text).ok()?;
    Some(Device {
        name: name.to_owned(),
        beams: figures.beams,
        azimuth_deg: figures.azimuth_deg,
        beam_width_deg: figures.beam_width_deg,
        vertical_deg: figures.vertical_beam_deg.min(figures.elevation_deg),
        frequency_khz: figures.frequency_khz,
        range_m: ranges(text)?,
    })
}

/// All built-in devices.
pub fn devices() -> impl Iterator<Item = Device> {
    sonars::DEVICES.iter().filter_map(|(name, _)| device(name))
}

/// The first line of a device file ends in `ranges 0.1 to 40 m.`
fn ranges(text: &str) -> Option<[f64; 2]> {
    let (_, ranges) = text.lines().next()?.rsplit_once("ranges ")?;
    let (near, far) = ranges.trim_end().strip_suffix(" m.")?.split_once(" to ")?;
    Some([near.parse().ok()?, far.parse().ok()?])
}

impl Device {
    /// Beams over a thing at a distance, such as show more of it.
    #[must_use]
    pub fn beams_over(&self, size_m: f64, distance_m: f64) -> f64 {
        let spacing_deg = self.azimuth_deg / f64::from(self.beams);
        size_m / (distance_m * radians(spacing_deg.max(APART * self.beam_width_deg)))
    }
}

/// What is asked of a device.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Need {
    /// Longest side of the smallest thing, metres; 0 without things.
    pub smallest_m: f64,
    /// Its distance, metres.
    pub distance_m: f64,
    /// Farthest range, metres.
    pub far_m: f64,
    /// A frequency that was asked for, kilohertz.
    pub frequency_khz: Option<f64>,
}

/// The device that suits best, and why.
#[must_use]
pub fn choose(need: &Need) -> (Device, String) {
    if let Some(found) = need.frequency_khz.and_then(by_frequency) {
        return found;
    }
    let all = || PREFERRED.iter().filter_map(|(name, why)| Some((device(name)?, *why)));
    let reaches = |device: &Device| {
        let most = if device.name == PREFERRED[0].0 { FINE_TO_M } else { USED * device.range_m[1] };
        need.far_m <= most
    };
    let resolves = |device: &Device| device.beams_over(need.smallest_m, need.distance_m.max(0.1)) >= BEAMS_A_THING;
    let fits = |(device, _): &(Device, &str)| reaches(device) && (need.smallest_m <= 0.0 || resolves(device));
    let over = |device: &Device| device.beams_over(need.smallest_m, need.distance_m.max(0.1));
    let finest = || all().filter(|(device, _)| reaches(device)).min_by(|a, b| over(&b.0).total_cmp(&over(&a.0)));
    let found = all().find(fits).or_else(finest).or_else(|| all().next_back());
    let (device, why) = found.expect("the table names built-in devices");
    let over = device.beams_over(need.smallest_m, need.distance_m.max(0.1));
    let seen = match over {
        0.5.. => format!("; {over:.0} beams over {:.2} m at {:.1} m", need.smallest_m, need.distance_m),
        _ => String::new(),
    };
    (device, format!("{why}{seen}"))
}

/// The device of the nearest frequency, where one is near.
fn by_frequency(frequency_khz: f64) -> Option<(Device, String)> {
    let apart = |device: &Device| {
        let ratio = device.frequency_khz / frequency_khz;
        ratio.max(1.0 / ratio)
    };
    // Of devices of one frequency the preferred come first, then the alphabet.
    let preferred = PREFERRED.iter().filter_map(|(name, _)| device(name));
    let found = preferred.chain(devices()).min_by(|a, b| apart(a).total_cmp(&apart(b)))?;
    let why = match apart(&found) {
        near if near <= SAME_FREQUENCY => format!("a device of {} kHz", found.frequency_khz),
        _ => format!("of {} kHz, nearest to what was asked for", found.frequency_khz),
    };
    Some((found, why))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_device_file_has_figures_and_ranges() {
        assert_eq!(devices().count(), sonars::DEVICES.len());
        for device in devices() {
            assert!(0.0 < device.range_m[0] && device.range_m[0] < device.range_m[1], "{}", device.name);
        }
        assert_eq!(device("oculus-m1200d-hf").map(|d| (d.range_m, d.vertical_deg)), Some(([0.1, 10.0], 12.0)));
        assert!(PREFERRED.iter().all(|(name, _)| device(name).is_some()));
    }

    #[test]
    fn sizes_distances_and_frequencies_choose() {
        let chosen = |need: Need| choose(&need).0.name;
        let tire = Need { smallest_m: 0.63, distance_m: 5.0, far_m: 9.0, frequency_khz: None };
        assert_eq!(chosen(tire), "oculus-m1200d-lf");
        let can = Need { smallest_m: 0.115, distance_m: 2.4, far_m: 4.0, frequency_khz: None };
        assert_eq!(chosen(can), "oculus-m1200d-hf");
        let ship = Need { smallest_m: 25.0, distance_m: 24.0, far_m: 45.0, frequency_khz: None };
        assert_eq!(chosen(ship), "oculus-m750d-lf");
        assert_eq!(chosen(Need { far_m: 200.0, ..ship }), "blueview-m450-130");
        assert_eq!(chosen(Need { frequency_khz: Some(900.0), ..ship }), "blueview-m900-130-mk2");
        assert_eq!(chosen(Need::default()), "oculus-m1200d-lf");
        // 0.63 m at 5 m are 7.22°: half beams of 0.3°.
        let over = device("oculus-m1200d-lf").expect("built in").beams_over(0.63, 5.0);
        assert!((over - 24.064).abs() < 0.01, "{over}");
    }
}
