//! A body of water as one sonar frequency meets it: every figure, its equation, and where that equation was carried too far.
//!
//! Figures only; `report_text` lays them out. Knows no device: the useful range is that of a stated reference sonar.

use serde::Serialize;

use super::absorption::{Absorption, ainslie_mccolm, francois_garrison};
use super::noise::ambient_noise_db;
use super::numeric::crossing;
use super::response::pulse_resolution_m;
use super::sonar_equation::{Levels, seabed_cell_area_m2, seabed_strength_db, transmission_loss_db};
use super::sound_speed::{chen_millero_m_s, mackenzie_m_s, marczak_m_s, medwin_m_s, temperature_68_c};
use super::stated::{Outside, Stated};
use super::turbidity::Turbidity;
use super::water::{SpeedEquation, Water};
use crate::math::Impossible;
use crate::math::real::{log10, radians};

/// What a water does to sound of one frequency.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct WaterReport {
    /// The water.
    pub water: Water,
    /// Frequency, kHz.
    pub frequency_khz: f64,
    /// Absorption by both models; the first is the one in use.
    pub absorption: [AbsorptionLine; 2],
    /// Speed of sound in use, m/s.
    pub sound_speed_m_s: f64,
    /// The equation that it comes from.
    pub sound_speed_equation: SpeedEquation,
    /// Speed of sound by every equation.
    pub sound_speeds: Vec<SpeedLine>,
    /// Wavelength, m.
    pub wavelength_m: f64,
    /// Density, kg/m³ (TEOS-10).
    pub density_kg_m3: f64,
    /// Two-way losses at some ranges.
    pub losses: Vec<LossLine>,
    /// How far a sonar sees.
    pub useful_range: UsefulRange,
    /// What suspended sediment adds, by named level.
    pub turbidity: Vec<TurbidityLine>,
    /// What to know before trusting the figures above: equations in use beyond their stated ranges.
    pub warnings: Vec<String>,
}

/// Absorption by one model.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AbsorptionLine {
    /// The model's authors and year.
    pub model: &'static str,
    /// Its parts, dB/km.
    pub parts_db_per_km: Absorption,
    /// Their sum, dB/km.
    pub total_db_per_km: f64,
    /// Where it was carried beyond its stated range.
    pub outside: Vec<Outside>,
}

/// Sound speed by one equation.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SpeedLine {
    /// The equation's authors and year.
    pub equation: &'static str,
    /// Speed, m/s.
    pub m_s: f64,
    /// Where it was carried beyond its stated range.
    pub outside: Vec<Outside>,
}

/// Two-way losses of an echo.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct LossLine {
    /// Slant range, m.
    pub range_m: f64,
    /// Spherical spreading there and back, `40·log R` dB.
    pub spreading_db: f64,
    /// Absorption there and back, `2αR` dB.
    pub absorption_db: f64,
    /// Time from ping to echo, ms.
    pub two_way_time_ms: f64,
}

/// How far a sonar sees in this water, by two measures.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct UsefulRange {
    /// Slant range at which the echo of [`REFERENCE`]'s seabed cell is as loud as its noise, m.
    pub seabed_echo_meets_noise_m: f64,
    /// Slant range at which absorption alone takes 60 dB there and back, m: the outer limit, whatever the sonar.
    pub absorption_60_db_m: f64,
}

/// What one turbidity level adds.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TurbidityLine {
    /// The level.
    pub level: Turbidity,
    /// Mass of sediment, kg/m³.
    pub concentration_kg_m3: f64,
    /// Radius of its grains, m.
    pub grain_radius_m: f64,
    /// Absorption that it adds, dB/km.
    pub absorption_db_per_km: f64,
    /// Volume backscattering strength, dB re 1 m⁻¹.
    pub volume_strength_db: f64,
}

/// The sonar and the seabed that the useful range is stated for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReferenceSonar {
    /// Source level, dB re 1 µPa at 1 m.
    pub source_level_db: f64,
    /// Directivity index of a receive beam, dB.
    pub directivity_db: f64,
    /// Width of a receive beam, degrees.
    pub beam_width_deg: f64,
    /// Bandwidth over frequency.
    pub relative_bandwidth: f64,
    /// Backscattering strength of the seabed, dB.
    pub seabed_db: f64,
    /// Wind speed, m/s.
    pub wind_m_s: f64,
}

/// A forward-looking sonar of 1° × 20° beams (10·log(41253/20) = 33 dB) over fine sand (10·log μ = −19 dB) at 16° grazing.
///
/// Source: Urick (1983), ch. 2 for the measure, ch. 3 for the index, ch. 8 for sand; source level as assumed for the devices
/// of the catalog.
pub const REFERENCE: ReferenceSonar = ReferenceSonar {
    source_level_db: 210.0,
    directivity_db: 33.0,
    beam_width_deg: 1.0,
    relative_bandwidth: 0.1,
    seabed_db: -30.0,
    wind_m_s: 5.0,
};

const RANGES_M: [f64; 8] = [1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0];

impl WaterReport {
    /// The report on a water at a frequency in kHz.
    ///
    /// # Errors
    /// A figure that no water has, or a frequency outside of 0.1–10 000 kHz.
    pub fn new(water: Water, frequency_khz: f64) -> Result<Self, Impossible> {
        water.validate()?;
        Impossible::outside("frequency_khz", frequency_khz, 0.1, 10_000.0)?;
        let absorption = [
            AbsorptionLine::new("Francois & Garrison 1982", francois_garrison(frequency_khz, &water)),
            AbsorptionLine::new("Ainslie & McColm 1998", ainslie_mccolm(frequency_khz, &water)),
        ];
        let (sound_speed_equation, speed) = water.sound_speed();
        let per_m = absorption[0].total_db_per_km / 1000.0;
        let mut warnings = Vec::new();
        for line in &absorption {
            warnings.extend(line.outside.iter().map(|outside| format!("absorption, {}: {outside}", line.model)));
        }
        if frequency_khz > 1000.0 {
            warnings.push("absorption: above 1000 kHz the viscous part is carried on as f²".to_owned());
        }
        warnings.extend(speed.outside.iter().map(|outside| format!("sound speed: {outside}")));
        Ok(Self {
            water,
            frequency_khz,
            sound_speed_m_s: speed.value,
            sound_speed_equation,
            sound_speeds: speeds(&water),
            wavelength_m: water.wavelength_m(frequency_khz),
            density_kg_m3: water.seawater().density_kg_m3().value,
            losses: RANGES_M.iter().map(|&range| LossLine::new(range, per_m, speed.value)).collect(),
            useful_range: useful_range(frequency_khz, per_m, speed.value),
            turbidity: turbidity(&water, frequency_khz, &mut warnings),
            absorption,
            warnings,
        })
    }
}

impl AbsorptionLine {
    fn new(model: &'static str, stated: Stated<Absorption>) -> Self {
        let Stated { value, outside } = stated;
        Self { model, parts_db_per_km: value, total_db_per_km: value.total(), outside }
    }
}

impl LossLine {
    fn new(range_m: f64, absorption_db_per_m: f64, sound_speed_m_s: f64) -> Self {
        Self {
            range_m,
            spreading_db: 40.0 * log10(range_m),
            absorption_db: 2.0 * absorption_db_per_m * range_m,
            two_way_time_ms: 1000.0 * super::motion::two_way_time_s(range_m, sound_speed_m_s),
        }
    }
}

/// Every equation on this water, within its range or not.
fn speeds(water: &Water) -> Vec<SpeedLine> {
    let Water { temperature_c: t, salinity_ppt: s, depth_m: z, .. } = *water;
    let state = water.seawater();
    // Marczak's equation knows neither salt nor pressure: 10 m of depth are worth 0.2 m/s.
    let mut marczak = marczak_m_s(t);
    marczak.outside.extend(Stated::new((), &[("salinity, ppt", s, 0.0, 0.0), ("depth, m", z, 0.0, 10.0)]).outside);
    [
        ("Mackenzie 1981", mackenzie_m_s(t, s, z)),
        ("TEOS-10 2010", state.sound_speed_m_s()),
        ("Chen & Millero 1977", chen_millero_m_s(temperature_68_c(t), s, state.pressure_dbar / 10.0)),
        ("Medwin 1975", medwin_m_s(t, s, z)),
        ("Marczak 1997 (fresh)", marczak),
    ]
    .map(|(equation, Stated { value, outside })| SpeedLine { equation, m_s: value, outside })
    .into()
}

fn turbidity(water: &Water, frequency_khz: f64, warnings: &mut Vec<String>) -> Vec<TurbidityLine> {
    let line = |level: Turbidity| {
        let (load, Stated { value, outside }) = (level.load(), level.acoustics(water, frequency_khz));
        warnings.extend(outside.iter().map(|outside| format!("turbidity, {}: {outside}", level.name())));
        TurbidityLine {
            level,
            concentration_kg_m3: load.concentration_kg_m3,
            grain_radius_m: load.grain_radius_m,
            absorption_db_per_km: 1000.0 * value.absorption_db_per_m(),
            volume_strength_db: value.volume_strength_db(),
        }
    };
    Turbidity::ALL.into_iter().map(line).collect()
}

/// Both measures; the level of a seabed cell falls with range without end, so there is one crossing.
fn useful_range(frequency_khz: f64, absorption_db_per_m: f64, sound_speed_m_s: f64) -> UsefulRange {
    let bandwidth_hz = REFERENCE.relative_bandwidth * 1000.0 * frequency_khz;
    let sonar = Levels {
        source_db: REFERENCE.source_level_db,
        // Where the wind's equation ends, at 100 kHz, wind no longer counts: no word on its range is needed.
        noise_db: ambient_noise_db(frequency_khz, REFERENCE.wind_m_s).value,
        directivity_db: REFERENCE.directivity_db,
        bandwidth_hz,
        processing_db: 0.0,
    };
    let resolution = pulse_resolution_m(sound_speed_m_s, bandwidth_hz);
    let heard = |range: f64| {
        let area = seabed_cell_area_m2(range, radians(REFERENCE.beam_width_deg), resolution, 0.0);
        let loss = transmission_loss_db(range, absorption_db_per_m);
        sonar.snr_db(loss, seabed_strength_db(REFERENCE.seabed_db, area)) > 0.0
    };
    UsefulRange { seabed_echo_meets_noise_m: crossing(0.0, 1e7, heard), absorption_60_db_m: 30.0 / absorption_db_per_m }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SEA: Water = Water { temperature_c: 10.0, salinity_ppt: 35.0, ph: 8.0, depth_m: 5.0 };

    #[test]
    fn a_sonar_of_750_khz_in_the_sea() {
        let report = WaterReport::new(SEA, 750.0).unwrap();
        assert!((report.absorption[0].total_db_per_km - 222.32).abs() < 0.01);
        assert_eq!(report.warnings, Vec::<String>::new());
        assert_eq!(report.sound_speed_equation, SpeedEquation::Mackenzie);
        let ten = report.losses.iter().find(|line| line.range_m == 10.0).unwrap();
        assert!((ten.spreading_db - 40.0).abs() < 1e-12 && (ten.absorption_db - 4.4464).abs() < 1e-3);
        // Data sheets of imaging sonars at this frequency state 100 to 120 m at most.
        let UsefulRange { seabed_echo_meets_noise_m: seabed, absorption_60_db_m: limit } = report.useful_range;
        assert!(seabed > 30.0 && seabed < limit && (limit - 134.94).abs() < 0.1, "{seabed} {limit}");
    }

    #[test]
    fn ranges_shrink_with_frequency() {
        let ranges = [375.0, 750.0, 1200.0, 2100.0, 3000.0]
            .map(|khz| WaterReport::new(SEA, khz).unwrap().useful_range.seabed_echo_meets_noise_m);
        assert!(ranges.is_sorted_by(|a, b| a > b), "{ranges:?}");
    }

    #[test]
    fn a_lake_at_high_frequency_has_warnings_and_another_equation() {
        let lake = Water { salinity_ppt: 0.0, ..SEA };
        let report = WaterReport::new(lake, 1200.0).unwrap();
        assert_eq!(report.sound_speed_equation, SpeedEquation::Teos10);
        let about = |word: &str| report.warnings.iter().filter(|warning| warning.contains(word)).count();
        assert!(about("Ainslie & McColm 1998: salinity, ppt: 0 is outside 5 to 50") == 1, "{:?}", report.warnings);
        assert_eq!(about("f²"), 1);
        assert_eq!(about("sound speed"), 0);
        let marczak = report.sound_speeds.iter().find(|line| line.equation.contains("Marczak")).unwrap();
        assert!(marczak.outside.is_empty());
    }

    #[test]
    fn what_is_no_water_is_refused() {
        assert!(WaterReport::new(Water { temperature_c: 80.0, ..SEA }, 750.0).is_err());
        assert_eq!(WaterReport::new(SEA, 0.0).unwrap_err().key, "frequency_khz");
    }

    #[test]
    fn field_names_are_stable() {
        let json = serde_json::to_value(WaterReport::new(SEA, 750.0).unwrap()).unwrap();
        assert!(json["absorption"][0]["parts_db_per_km"]["magnesium_sulphate"].is_number());
        assert_eq!(json["sound_speed_equation"], "mackenzie");
        assert_eq!(json["turbidity"][3]["level"], "very-turbid");
        assert!(json["useful_range"]["seabed_echo_meets_noise_m"].is_number());
    }
}
