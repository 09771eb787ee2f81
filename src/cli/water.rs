//! `ensonify water`: what a water does to sound.

use anyhow::anyhow;
use clap::Args;

use super::Code;
use crate::physics::{Water, WaterReport};

/// Shows what a water does to sound of one frequency
///
/// Absorption by both models with their parts, the speed of sound by every equation, losses there and back, and the useful
/// range. Equations carried beyond their stated range say so.
#[derive(Debug, Args)]
#[command(
    allow_negative_numbers = true,
    after_help = "Example:\n  ensonify water --frequency-khz 750 --temperature-c 8 --salinity-ppt 33 --depth-m 20"
)]
pub struct WaterVerb {
    /// Frequency, kHz
    #[arg(short, long, value_name = "KHZ")]
    frequency_khz: f64,
    /// Temperature, °C
    #[arg(short, long, value_name = "C", default_value_t = 10.0)]
    temperature_c: f64,
    /// Salinity, parts per thousand
    #[arg(short, long, value_name = "PPT", default_value_t = 35.0)]
    salinity_ppt: f64,
    /// Acidity
    #[arg(long, value_name = "PH", default_value_t = 8.0)]
    ph: f64,
    /// Depth, m
    #[arg(short, long, value_name = "M", default_value_t = 10.0)]
    depth_m: f64,
    /// The same as JSON, with stable names
    #[arg(long)]
    json: bool,
}

impl WaterVerb {
    pub(super) fn run(&self) -> anyhow::Result<Code> {
        let Self { temperature_c, salinity_ppt, ph, depth_m, .. } = *self;
        let water = Water { temperature_c, salinity_ppt, ph, depth_m };
        let report = WaterReport::new(water, self.frequency_khz)
            .map_err(|fault| anyhow!("--{} {}; {}", fault.key.replace('_', "-"), fault.problem, fault.remedy))?;
        if self.json {
            say!("{}", serde_json::to_string_pretty(&report)?);
        } else {
            say!("{}", report.text().trim_end());
        }
        Ok(Code::Done)
    }
}
