//! A water report as aligned text for a terminal.

use std::fmt::Write;

use super::report::{AbsorptionLine, REFERENCE, WaterReport};
use super::stated::Outside;
use super::water::{SpeedEquation, Water};
use crate::math::real::log10;

impl WaterReport {
    /// The report as aligned tables, four significant digits, warnings last.
    #[must_use]
    pub fn text(&self) -> String {
        let mut out = String::new();
        let Water { temperature_c, salinity_ppt, ph, depth_m } = self.water;
        let sections = [
            format!(
                "water {temperature_c} °C, {salinity_ppt} ppt, pH {ph}, {depth_m} m deep; {} kHz\n",
                self.frequency_khz
            ),
            self.absorption_text(),
            self.speed_text(),
            self.loss_text(),
            self.range_text(),
            self.turbidity_text(),
            self.warning_text(),
        ];
        for section in sections.iter().filter(|section| !section.is_empty()) {
            let gap = if out.is_empty() { "" } else { "\n" };
            out.push_str(gap);
            out.push_str(section);
        }
        out
    }

    fn absorption_text(&self) -> String {
        let mut text = row("absorption, dB/km", &["boric acid", "MgSO4", "viscous", "total"].map(String::from), "");
        for AbsorptionLine { model, parts_db_per_km: parts, total_db_per_km, outside } in &self.absorption {
            let figures = [parts.boric_acid, parts.magnesium_sulphate, parts.viscous, *total_db_per_km];
            text += &row(&format!("  {model}"), &figures.map(four), &note(outside));
            let share = |part: f64| format!("{:.1} %", 100.0 * part / total_db_per_km);
            let shares = [parts.boric_acid, parts.magnesium_sulphate, parts.viscous].map(share);
            text += &row("    of the total", &shares, "");
        }
        text
    }

    fn speed_text(&self) -> String {
        let name = match self.sound_speed_equation {
            SpeedEquation::Mackenzie => "Mackenzie 1981",
            SpeedEquation::Teos10 => "TEOS-10 2010",
        };
        let mut text = row("sound speed, m/s", &[format!("{:.2}", self.sound_speed_m_s)], &format!("by {name}"));
        for line in &self.sound_speeds {
            text += &row(&format!("  {}", line.equation), &[format!("{:.2}", line.m_s)], &note(&line.outside));
        }
        text += &row("wavelength, mm", &[four(1000.0 * self.wavelength_m)], "");
        text + &row("density, kg/m³", &[format!("{:.2}", self.density_kg_m3)], "")
    }

    fn loss_text(&self) -> String {
        let head = ["spreading", "absorption", "both", "time, ms"].map(String::from);
        let mut text = row("two-way loss, dB", &head, "");
        for line in &self.losses {
            let both = line.spreading_db + line.absorption_db;
            let figures = [line.spreading_db, line.absorption_db, both].map(|db| format!("{db:.2}"));
            let [spreading, absorption, both] = figures;
            let figures = [spreading, absorption, both, four(line.two_way_time_ms)];
            text += &row(&format!("  at {} m", line.range_m), &figures, "");
        }
        text
    }

    fn range_text(&self) -> String {
        let sonar = format!(
            "{} dB source, {}° beams, seabed of {} dB",
            REFERENCE.source_level_db, REFERENCE.beam_width_deg, REFERENCE.seabed_db
        );
        let range = &self.useful_range;
        row("useful range, m", &[], "")
            + &row("  seabed echo meets noise", &[four(range.seabed_echo_meets_noise_m)], &sonar)
            + &row("  absorption takes 60 dB", &[four(range.absorption_60_db_m)], "there and back, whatever the sonar")
    }

    fn turbidity_text(&self) -> String {
        let head = ["mg/l", "grain, µm", "dB/km", "S_v, dB"].map(String::from);
        let mut text = row("turbidity adds", &head, "");
        for line in &self.turbidity {
            let grain = 1e6 * line.grain_radius_m;
            let figures = [1000.0 * line.concentration_kg_m3, grain, line.absorption_db_per_km].map(four);
            let [concentration, grain, absorption] = figures;
            let figures = [concentration, grain, absorption, format!("{:.1}", line.volume_strength_db)];
            text += &row(&format!("  {}", line.level.name()), &figures, "");
        }
        text
    }

    fn warning_text(&self) -> String {
        self.warnings.iter().fold(String::new(), |mut text, warning| {
            // Writing to a string cannot fail.
            let _ = writeln!(text, "warning: {warning}");
            text
        })
    }
}

/// A line: a name, figures in columns, a remark.
fn row(name: &str, figures: &[String], remark: &str) -> String {
    let columns: String = figures.iter().map(|figure| format!("{figure:>12}")).collect();
    let line = format!("{name:<28}{columns}   {remark}");
    format!("{}\n", line.trim_end())
}

/// What lies outside of an equation's range, in words.
fn note(outside: &[Outside]) -> String {
    let words: Vec<String> = outside.iter().map(Outside::to_string).collect();
    words.join("; ")
}

/// Four significant digits, and no more than six decimals.
fn four(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return format!("{value}");
    }
    let decimals = (3.0 - log10(value.abs()).floor()).clamp(0.0, 6.0) as usize;
    format!("{value:.decimals$}")
}

#[cfg(test)]
mod tests {
    use super::*;

    const SEA: Water = Water { temperature_c: 10.0, salinity_ppt: 35.0, ph: 8.0, depth_m: 5.0 };

    #[test]
    fn columns_are_aligned_and_lines_end_clean() {
        let text = WaterReport::new(SEA, 750.0).unwrap().text();
        let line = |start: &str| text.lines().find(|line| line.starts_with(start)).unwrap_or_else(|| panic!("{text}"));
        assert_eq!(line("  Francois"), "  Francois & Garrison 1982        0.1157       47.42       174.8       222.3");
        assert_eq!(line("absorption"), "absorption, dB/km             boric acid       MgSO4     viscous       total");
        assert_eq!(line("  at 10 m"), "  at 10 m                          40.00        4.45       44.45       13.42");
        assert!(text.lines().all(|line| line.trim_end() == line));
        assert!(!text.contains("warning"));
    }

    #[test]
    fn warnings_come_last() {
        let text = WaterReport::new(Water { salinity_ppt: 0.0, ..SEA }, 2100.0).unwrap().text();
        assert!(text.lines().last().unwrap().starts_with("warning: "), "{text}");
        assert!(text.contains("Mackenzie 1981") && text.contains("by TEOS-10"));
    }

    #[test]
    fn four_digits_are_four_digits() {
        assert_eq!([222.32, 0.115_68, 1489.884, 0.0, 12_345.6].map(four), ["222.3", "0.1157", "1490", "0", "12346"]);
        assert_eq!(four(1e-9), "0.000000");
    }
}
