//! `ensonify realism`: figures of images beside those of real ones.

use std::path::PathBuf;

use clap::Args;
use serde::Serialize;

use super::Code;
use crate::realism::{Comparison, Figures, FolderOptions, Settings, Source, compare, measure, table};

/// Measures how near images are to real sonar images
///
/// Measures the fan images of a dataset, or of any folder of grey PNGs, and shows the figures beside those of real sonar
/// images, with the distance of each: quantiles of grey, patch mean/std and its dependence on the mean, object and shadow
/// contrast, lateral and range correlation, range profile, beam ripple, and which laws the grey of patches follows.
///
/// It does not judge: the exit code is 0 whatever the distances are. All is measured on the displayed grey, in pixels of the
/// picture, so compare pictures of about the same size (output.fan_height_px).
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    ensonify realism --against stats.json out/quickstart        a table, real beside ours\n  \
    ensonify realism --json out/quickstart > ours.json          figures that --against reads\n  \
    ensonify realism --against ours.json out/other              one dataset beside another\n  \
    ensonify realism --against stats.json --fan-deg 30 photos   a folder of plain images")]
pub struct Realism {
    /// Folder of a dataset, such as out/quickstart, or of grey PNG images
    images: PathBuf,
    /// Figures to compare with: a file that --json wrote, or published ones of the same shape
    #[arg(long, value_name = "JSON", required_unless_present = "json")]
    against: Option<PathBuf>,
    /// The figures as JSON, and the comparison if there is one
    #[arg(long)]
    json: bool,
    /// Side of a homogeneous patch, pixels
    #[arg(long, value_name = "PX", default_value_t = Settings::default().patch_px, value_parser = clap::value_parser!(u32).range(12..=200))]
    patch_px: u32,
    /// Width of the ring around an object, pixels
    #[arg(long, value_name = "PX", default_value_t = Settings::default().ring_px, value_parser = clap::value_parser!(u32).range(1..=200))]
    ring_px: u32,
    /// Length of range behind an object in which its shadow is measured, pixels
    #[arg(long, value_name = "PX", default_value_t = Settings::default().shadow_px, value_parser = clap::value_parser!(u32).range(2..=500))]
    shadow_px: u32,
    #[command(flatten)]
    folder: FolderArgs,
}

/// What a folder of plain images does not tell.
#[derive(Debug, Args)]
#[command(next_help_heading = "Folders of plain images")]
struct FolderArgs {
    /// Horizontal aperture of the fan, degrees; apex below, far range at the top
    #[arg(long, value_name = "DEG", value_parser = aperture)]
    fan_deg: Option<f64>,
    /// Where the apex is, pixels right and down [default: the fan just fills the picture]
    #[arg(long, value_name = "X,Y", value_parser = pair, allow_hyphen_values = true)]
    apex_px: Option<[f64; 2]>,
    /// Nearest and farthest range from the apex, pixels [default: the fan just fills the picture]
    #[arg(long, value_name = "NEAR,FAR", value_parser = pair)]
    range_px: Option<[f64; 2]>,
    /// Beams across the fan; without it there is no beam ripple
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=8192))]
    beams: Option<u32>,
    /// Folder of masks, grey PNGs with the images' names: 0 is background, every other value one object
    #[arg(long, value_name = "FOLDER")]
    masks: Option<PathBuf>,
}

impl Realism {
    pub(super) fn run(&self) -> anyhow::Result<Code> {
        // A bad file of figures is told before anything is measured.
        let real = self.against.as_deref().map(Figures::read).transpose()?;
        let source = Source::open(&self.images, &self.folder.options())?;
        let settings = Settings {
            patch_px: self.patch_px,
            ring_px: self.ring_px,
            shadow_px: self.shadow_px,
            ..Settings::default()
        };
        let figures = measure(&source, &settings)?;
        let comparison = real.map(|real| compare(&real, &figures));
        if self.json {
            say!("{}", serde_json::to_string_pretty(&Output { figures, comparison })?);
        } else if let Some(comparison) = comparison {
            say!("{} images of {}\n", source.len(), self.images.display());
            print!("{}", table::table(&comparison));
        }
        Ok(Code::Done)
    }
}

impl FolderArgs {
    fn options(&self) -> FolderOptions {
        let Self { fan_deg, apex_px, range_px, beams, .. } = *self;
        FolderOptions { fan_deg, apex_px, range_px, beams, masks: self.masks.clone() }
    }
}

/// What `--json` prints: figures as `--against` reads them, and what came of the comparison.
#[derive(Serialize)]
struct Output {
    #[serde(flatten)]
    figures: Figures,
    #[serde(skip_serializing_if = "Option::is_none")]
    comparison: Option<Comparison>,
}

fn aperture(text: &str) -> Result<f64, String> {
    let degrees = text.parse().ok().filter(|degrees| (1.0..=170.0).contains(degrees));
    degrees.ok_or_else(|| "write degrees from 1 to 170".to_owned())
}

fn pair(text: &str) -> Result<[f64; 2], String> {
    let number = |text: &str| text.trim().parse().ok().filter(|number: &f64| number.is_finite());
    let numbers = text.split_once(',').and_then(|(first, second)| Some([number(first)?, number(second)?]));
    numbers.ok_or_else(|| "write two numbers with a comma between them".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pairs_and_apertures_are_parsed_or_refused() {
        assert_eq!(pair("159.5, -3"), Ok([159.5, -3.0]));
        assert!(pair("159.5").is_err() && pair("1,nan").is_err() && pair("1,2,3").is_err());
        assert_eq!(aperture("30"), Ok(30.0));
        assert!(aperture("0").is_err() && aperture("180").is_err() && aperture("x").is_err());
    }
}
