//! How far a set of sonar images is from another in what can be measured: figures of grey levels, speckle, objects, shadows,
//! correlation, range profile and beams, with the definitions of the published figures of real sonar images.
//!
//! All is measured on the displayed grey of fan pictures, in their own pixels. Each file of this room holds the definition
//! of its figures; where a publication does not tell one, its module says what was chosen.
//!
//! Knows nothing of how images are made, and judges none: it measures and compares.

pub mod compare;
mod contrast;
mod correlation;
mod error;
pub mod figures;
pub mod fits;
pub mod geometry;
pub mod images;
mod patches;
mod profile;
mod quantiles;
#[cfg(test)]
mod sample;
mod special;
pub mod table;

use std::collections::BTreeMap;

use rayon::prelude::*;

pub use compare::{Comparison, compare};
pub use error::RealismError;
pub use figures::Figures;
pub use images::{FolderOptions, Source};

use contrast::ObjectFigures;
use correlation::Correlation;
use figures::{ALL, GeometryEntry};
use fits::Law;
use geometry::FanGeometry;
use images::{Frame, FrameFiles};
use patches::PatchFigures;
use profile::FrameProfile;
use quantiles::{Histogram, Sorted};

/// Sizes in the definitions; the default is the published ones', or what was chosen where those are not told.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Side of a patch, pixels; published: 20.
    pub patch_px: u32,
    /// Largest distance of a quarter's mean from its patch's mean, relative; chosen.
    pub homogeneity: f64,
    /// Most patches of one frame; chosen (published: ten on the average).
    pub patches_per_frame: usize,
    /// About how many patches laws are fitted to; published: 1500.
    pub fitted: usize,
    /// Width of the ring around an object, pixels; published: 14.
    pub ring_px: u32,
    /// Length of range in which a shadow is measured, pixels; chosen.
    pub shadow_px: u32,
}

impl Default for Settings {
    fn default() -> Self {
        Self { patch_px: 20, homogeneity: 0.1, patches_per_frame: 40, fitted: 1500, ring_px: 14, shadow_px: 30 }
    }
}

/// Measures all images of a source. Frames are measured in parallel and summed in their order.
///
/// # Errors
/// The first image or mask, in order, that cannot be read.
pub fn measure(source: &Source, settings: &Settings) -> Result<Figures, RealismError> {
    let fits = settings.fitted.div_ceil(source.len().max(1));
    let frames: Vec<Result<FrameFigures, RealismError>> =
        source.frames.par_iter().map(|files| measure_frame(source, files, settings, fits)).collect();
    let frames = frames.into_iter().collect::<Result<Vec<_>, _>>()?;
    Ok(gather(source, &frames, settings))
}

/// What is kept of a frame.
struct FrameFigures {
    shape: usize,
    greys: Histogram,
    patches: Vec<PatchFigures>,
    correlation: Correlation,
    profile: Option<FrameProfile>,
    ripple: Option<f64>,
    objects: Vec<ObjectFigures>,
}

fn measure_frame(
    source: &Source,
    files: &FrameFiles,
    settings: &Settings,
    fits: usize,
) -> Result<FrameFigures, RealismError> {
    let frame: Frame<'_> = source.load(files)?;
    let inside = frame.grey.iter().zip(&frame.inside).filter(|(_, inside)| **inside);
    let greys = Histogram::of(inside.map(|(&grey, _)| grey));
    let patches = patches::homogeneous(&frame, settings);
    let fitted = fits.min(patches.len());
    // Patches that laws are fitted to lie evenly among all.
    let is_fitted = |i: usize| (i + 1) * fitted / patches.len() > i * fitted / patches.len();
    let laws = |i: usize| if is_fitted(i) { &Law::ALL[..] } else { &[] };
    Ok(FrameFigures {
        shape: files.shape,
        patches: patches.iter().enumerate().map(|(i, p)| p.figures(frame.fan.rmax_px, laws(i))).collect(),
        correlation: Correlation::of(&frame, &patches, settings.patch_px as usize),
        profile: FrameProfile::of(&frame, &greys),
        ripple: profile::beam_ripple(&frame),
        objects: contrast::objects(&frame, settings),
        greys,
    })
}

fn gather(source: &Source, frames: &[FrameFigures], settings: &Settings) -> Figures {
    let everything: Vec<&Histogram> = frames.iter().map(|frame| &frame.greys).collect();
    let patches: Vec<PatchFigures> = frames.iter().flat_map(|frame| frame.patches.iter().cloned()).collect();
    let objects: Vec<ObjectFigures> = frames.iter().flat_map(|frame| frame.objects.iter().cloned()).collect();
    let rmax_px = source.shapes.first().map_or(0.0, |fan| fan.rmax_px);
    let mut figures = Figures {
        intensity: BTreeMap::from([(ALL.to_owned(), quantiles::intensity(&everything))]),
        speckle: patches::speckle(&patches, settings.patch_px, rmax_px),
        objects: contrast::contrasts(&objects),
        correlation: BTreeMap::new(),
        range_profile: BTreeMap::new(),
        beam_gain_sd: Sorted::new(frames.iter().filter_map(|frame| frame.ripple)).map(|ripple| ripple.spread()),
        geometry: BTreeMap::new(),
    };
    for (shape, fan) in source.shapes.iter().enumerate() {
        let group: Vec<&FrameFigures> = frames.iter().filter(|frame| frame.shape == shape).collect();
        add_group(&mut figures, group_name(shape), fan, &group);
    }
    figures
}

/// What depends on the shape of the fan.
fn add_group(figures: &mut Figures, name: String, fan: &FanGeometry, frames: &[&FrameFigures]) {
    let greys: Vec<&Histogram> = frames.iter().map(|frame| &frame.greys).collect();
    figures.intensity.insert(name.clone(), quantiles::intensity(&greys));
    let mut correlation = Correlation::default();
    frames.iter().for_each(|frame| correlation.merge(&frame.correlation));
    figures.correlation.insert(name.clone(), correlation.rows(fan));
    let profiles: Vec<&FrameProfile> = frames.iter().filter_map(|frame| frame.profile.as_ref()).collect();
    figures.range_profile.insert(name.clone(), profile::range_profile(&profiles));
    let (frames, fan) = (frames.len() as u64, fan.clone());
    figures.geometry.insert(name, GeometryEntry::Group { frames, fan });
}

/// A, B … Z, then numbers: groups as the published figures name them.
fn group_name(shape: usize) -> String {
    match u8::try_from(shape) {
        Ok(letter @ 0..26) => char::from(b'A' + letter).to_string(),
        _ => format!("group-{:05}", shape + 1),
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;
    use crate::math::rng::Stream;
    use crate::store::png;

    /// A folder of three noisy fans, one of them of another size, with a block object in each.
    fn folder() -> tempfile::TempDir {
        let folder = tempfile::tempdir().unwrap();
        fs::create_dir(folder.path().join("masks")).unwrap();
        for (id, (width, height)) in (0u64..).zip([(320u32, 300u32), (320, 300), (300, 280)]) {
            let mut stream = Stream::at(1, "test", id, "images");
            let mut mask = vec![0u16; (width * height) as usize];
            (90..110).for_each(|y| mask[(y * width + 130) as usize..][..25].fill(5));
            let grey = |&object: &u16| {
                let mean = if object == 0 { 80.0 } else { 160.0 };
                (mean + 10.0 * stream.normal()).clamp(0.0, 255.0) as u8
            };
            let grey: Vec<u8> = mask.iter().map(grey).collect();
            fs::write(folder.path().join(format!("{id}.png")), png::grey8(width, height, &grey)).unwrap();
            fs::write(folder.path().join(format!("masks/{id}.png")), png::grey16(width, height, &mask)).unwrap();
        }
        folder
    }

    fn figures() -> Figures {
        let folder = folder();
        let masks = Some(folder.path().join("masks"));
        let options = FolderOptions { fan_deg: Some(60.0), beams: Some(128), masks, ..FolderOptions::default() };
        measure(&Source::open(folder.path(), &options).unwrap(), &Settings::default()).unwrap()
    }

    #[test]
    fn every_group_of_figures_is_there_and_right() {
        let figures = figures();
        assert_eq!(figures.intensity.keys().collect::<Vec<_>>(), ["A", "B", "all"]);
        assert_eq!((figures.intensity["A"].frames, figures.intensity["all"].frames), (2, 3));
        assert!((figures.intensity["all"].pooled_quantiles["0.5"] - 80.0).abs() <= 1.0);
        let speckle = figures.speckle.as_ref().unwrap();
        assert!((speckle.mean_over_std.median - 7.95).abs() < 0.2 && speckle.patches == 120);
        let objects = figures.objects.as_ref().unwrap();
        assert!((objects.contrast_mean_object_over_ring.median - 2.0).abs() < 0.05);
        assert!((objects.shadow_over_background.as_ref().unwrap().median - 1.0).abs() < 0.05);
        assert_eq!((figures.correlation.len(), figures.range_profile.len()), (2, 2));
        // A beam is the mean of some 200 pixels of 12.5 %: 0.9 %.
        assert!((figures.beam_gain_sd.as_ref().unwrap().median - 0.009).abs() < 0.003);
        assert_eq!(figures.group("B").unwrap().1.beams, Some(128));
    }

    #[test]
    fn figures_survive_their_file_and_do_not_depend_on_threads() {
        let first = figures();
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
        assert_eq!(pool.install(figures), first);
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("ours.json");
        fs::write(&path, serde_json::to_vec(&first).unwrap()).unwrap();
        assert_eq!(Figures::read(&path).unwrap(), first);
        let comparison = compare(&first, &first);
        assert_eq!(comparison.groups.len(), 7);
        for group in &comparison.groups {
            assert!(group.verdict.starts_with("within 0 %"), "{}: {}", group.name, group.verdict);
        }
    }

    #[test]
    fn groups_have_names_in_order() {
        assert_eq!([group_name(0), group_name(25), group_name(26)], ["A", "Z", "group-00027"]);
    }
}
