//! The figures of a set of sonar images, in the shape in which they are published and written.
//!
//! Reading ignores keys that are not measured here; absent sections are compared as absent.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::RealismError;
use super::geometry::FanGeometry;

/// Name of the pooled group in [`Figures::intensity`].
pub const ALL: &str = "all";

/// Everything that is measured on a set of images. Greys are the displayed 0–255.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Figures {
    /// Grey inside the fan: of [`ALL`] frames, and of each group of one geometry.
    pub intensity: BTreeMap<String, Intensity>,
    /// Homogeneous patches; absent where no patch is homogeneous.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub speckle: Option<Speckle>,
    /// Labelled objects; absent without masks.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub objects: Option<Objects>,
    /// Autocorrelation of homogeneous patches by group, near to far.
    #[serde(default)]
    pub correlation: BTreeMap<String, Vec<CorrelationRow>>,
    /// Grey over range by group.
    #[serde(default)]
    pub range_profile: BTreeMap<String, RangeProfile>,
    /// Beam-to-beam ripple of each frame; absent where beams are unknown or finer than pixels.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub beam_gain_sd: Option<Spread>,
    /// Shape of the fans by group.
    #[serde(default)]
    pub geometry: BTreeMap<String, GeometryEntry>,
}

/// Grey levels inside the fan.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Intensity {
    /// Images.
    pub frames: u64,
    /// Quantiles of all pixels together, by probability: the least grey with at least that share at or below it.
    pub pooled_quantiles: BTreeMap<String, f64>,
    /// Mean of all pixels together.
    pub pooled_mean: f64,
    /// Share of pixels that are 0.
    pub zero_fraction: f64,
    /// Share of pixels that are 255.
    pub saturated_255_fraction: f64,
    /// Mean over the frames of each frame's quantile.
    pub per_frame_quantile_mean: BTreeMap<String, f64>,
    /// Standard deviation of the same.
    pub per_frame_quantile_sd: BTreeMap<String, f64>,
}

/// Homogeneous patches.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Speckle {
    /// How many.
    pub patches: u64,
    /// Side, pixels.
    pub patch_px: u32,
    /// Mean / standard deviation of a patch.
    pub mean_over_std: Middle,
    /// Standard deviation / mean.
    pub cv_std_over_mean: Middle,
    /// Third standardised moment.
    pub skewness: Middle,
    /// How the standard deviation depends on the mean.
    pub std_vs_mean: StdVsMean,
    /// (range from the apex in pixels, median cv, patches), near to far.
    #[serde(default)]
    pub cv_by_range: Vec<(f64, f64, u64)>,
    /// Laws fitted to patches, by name.
    #[serde(default)]
    pub fits: BTreeMap<String, FitFigures>,
    /// Whether a K law could be fitted at all.
    #[serde(rename = "K_amplitude_moment_estimate")]
    pub k_amplitude: KAmplitude,
    /// Shape of the gamma law, over patches.
    #[serde(rename = "gamma_shape_ENL_like")]
    pub gamma_shape: GammaShape,
}

/// Standard deviation against mean, over patches.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StdVsMean {
    /// (median mean, median standard deviation, median cv, patches) of twelve equal shares of the patches, by mean.
    pub table_mean_std_cv_n: Vec<(f64, f64, f64, u64)>,
    /// Slope of ln(std) over ln(mean), least squares.
    pub loglog_slope: f64,
    /// Their correlation.
    pub r: f64,
}

/// A law fitted to patches.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FitFigures {
    /// Median Kolmogorov–Smirnov distance.
    #[serde(rename = "median_KS")]
    pub median_ks: f64,
    /// Median of each parameter.
    pub median_params: Vec<f64>,
}

/// K law of the amplitude.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct KAmplitude {
    /// Share of patches with E[x⁴] / E[x²]² > 2.
    pub patches_with_finite_nu: f64,
}

/// Shape of the gamma law.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[allow(missing_docs)]
pub struct GammaShape {
    pub median_shape: f64,
    pub p10: f64,
    pub p90: f64,
}

/// Median and outer tenths.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[allow(missing_docs)]
pub struct Middle {
    pub median: f64,
    pub p10: f64,
    pub p90: f64,
}

/// Quantiles of one value an object or a frame.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[allow(missing_docs)]
pub struct Spread {
    pub n: u64,
    pub p05: f64,
    pub p25: f64,
    pub median: f64,
    pub p75: f64,
    pub p95: f64,
}

/// Objects against what surrounds them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Objects {
    /// Mean grey in the mask / mean grey of the ring.
    pub contrast_mean_object_over_ring: Spread,
    /// 95th percentile of grey in the mask / mean grey of the ring.
    pub contrast_p95_object_over_ring: Spread,
    /// Mean grey behind the object / mean grey of the same ranges beside it; absent if no object has room behind it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shadow_over_background: Option<Spread>,
    /// Share of objects whose shadow is below 0.8.
    #[serde(rename = "shadow_fraction_of_objects_below_0.8")]
    pub shadow_below_08: f64,
    /// Share of objects whose shadow is below 0.6.
    #[serde(rename = "shadow_fraction_below_0.6")]
    pub shadow_below_06: f64,
    /// Medians by label.
    #[serde(default)]
    pub per_class: BTreeMap<String, ClassContrast>,
    /// The shadow's measure where there is no object; absent if there is no such place.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shadow_control_without_object: Option<ShadowControl>,
}

/// Medians over the objects of one label.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[allow(missing_docs)]
pub struct ClassContrast {
    pub n: u64,
    pub contrast_mean: f64,
    pub contrast_p95: f64,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shadow_ratio: Option<f64>,
    /// Width in bearing.
    pub extent_deg: f64,
    /// Length in range / (rmax − rmin).
    pub extent_range_frac: f64,
    pub area_px: f64,
}

/// The shadow's measure without objects.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[allow(missing_docs)]
pub struct ShadowControl {
    pub n: u64,
    pub p05: f64,
    pub p25: f64,
    pub median: f64,
    pub p75: f64,
}

/// Autocorrelation of patches at one range. Lags lie between whole pixels by linear interpolation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CorrelationRow {
    /// Mean range of the patches from the apex, pixels.
    pub range_px: f64,
    /// Patches.
    pub n: u64,
    /// Lag across at which the correlation falls to 1/2, pixels.
    pub lateral_half_px: f64,
    /// The same in bearing, degrees.
    pub lateral_half_deg: f64,
    /// Lag across at 1/e, degrees.
    pub lateral_1e_deg: f64,
    /// The same in beam spacings of the set's own sonar, where that is known.
    #[serde(default, alias = "beams_of_0p234", skip_serializing_if = "Option::is_none")]
    pub lateral_1e_beams: Option<f64>,
    /// Lag along range at 1/2, pixels.
    pub range_half_px: f64,
    /// Lag along range at 1/e, pixels.
    pub range_1e_px: f64,
    /// Correlation of neighbouring pixels across.
    pub lag1_lateral: f64,
    /// Correlation of neighbouring pixels along range.
    pub lag1_range: f64,
}

/// Grey over range. Bins hold no value where no frame has pixels.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RangeProfile {
    /// Middles of the bins, 0 at rmin and 1 at rmax.
    pub bin_centres_fraction_of_rmin_to_rmax: Vec<f64>,
    /// Median over frames of each frame's median grey in the bin.
    pub median_grey: Vec<f64>,
    /// Median over frames of (median grey in the bin / median grey of the frame).
    pub normalised_median: Vec<f64>,
    /// Its lowest tenth.
    pub normalised_p10: Vec<f64>,
    /// Its highest tenth.
    pub normalised_p90: Vec<f64>,
}

/// What stands under `geometry`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum GeometryEntry {
    /// The fan of a group.
    Group {
        /// Images of this shape.
        frames: u64,
        /// The shape.
        #[serde(flatten)]
        fan: FanGeometry,
    },
    /// A remark.
    Note(String),
}

impl Figures {
    /// Reads a file of figures.
    ///
    /// # Errors
    /// [`RealismError::Io`] or [`RealismError::Figures`].
    pub fn read(path: &Path) -> Result<Self, RealismError> {
        let bytes = fs::read(path).map_err(|source| RealismError::Io { path: path.to_path_buf(), source })?;
        let refuse = |reason: String| RealismError::Figures { path: path.to_path_buf(), reason };
        let figures: Self = serde_json::from_slice(&bytes).map_err(|error| refuse(error.to_string()))?;
        if figures.intensity.contains_key(ALL) {
            return Ok(figures);
        }
        Err(refuse("there is no `all` under `intensity`".to_owned()))
    }

    /// Grey of all frames together.
    #[must_use]
    pub fn pooled(&self) -> Option<&Intensity> {
        self.intensity.get(ALL)
    }

    /// Frames and shape of a group, if the figures tell.
    #[must_use]
    pub fn group(&self, name: &str) -> Option<(u64, &FanGeometry)> {
        match self.geometry.get(name)? {
            GeometryEntry::Group { frames, fan } => Some((*frames, fan)),
            GeometryEntry::Note(_) => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_published_figures_are_read_whole() {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/real-sonar/aris3000_stats.json");
        if !path.exists() {
            println!("skipped: {} is not there", path.display());
            return;
        }
        let figures = Figures::read(&path).unwrap();
        assert_eq!(figures.pooled().unwrap().pooled_quantiles["0.5"], 71.0);
        let speckle = figures.speckle.as_ref().unwrap();
        assert_eq!((speckle.fits["nakagami"].median_ks, speckle.cv_by_range.len()), (0.04, 5));
        assert_eq!(figures.objects.as_ref().unwrap().per_class["Tire"].shadow_ratio, Some(0.516));
        assert_eq!(figures.correlation["A"][0].lateral_1e_beams, Some(0.95));
        assert_eq!(figures.group("B").unwrap().1.rmax_px, 574.4);
        assert_eq!(figures.group("A").unwrap().1.vertical_stretch, 1.239);
        assert_eq!(figures.group("note"), None);
        let again: Figures = serde_json::from_str(&serde_json::to_string(&figures).unwrap()).unwrap();
        assert_eq!(again, figures);
    }

    #[test]
    fn a_file_of_something_else_is_refused_with_its_name() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("stats.json");
        for text in ["{}", "[1, 2", "{\"intensity\": {}}"] {
            fs::write(&path, text).unwrap();
            let message = Figures::read(&path).unwrap_err().to_string();
            assert!(message.contains("stats.json") && message.contains("realism --json"), "{message}");
        }
        assert!(matches!(Figures::read(&folder.path().join("none")), Err(RealismError::Io { .. })));
    }
}
