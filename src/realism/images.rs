//! The images to be measured: a dataset's fan views, or a plain folder of grey pictures.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use image::DynamicImage;
use serde::Deserialize;

use super::RealismError;
use super::geometry::FanGeometry;
use crate::label::View;
use crate::sonar::{FanMap, Grid};
use crate::store::{Dataset, Place, layout};

/// What a plain folder does not tell of itself. A dataset needs none of it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FolderOptions {
    /// Horizontal aperture, degrees.
    pub fan_deg: Option<f64>,
    /// Apex, pixels right and down; as if the fan just filled the picture where it is not given.
    pub apex_px: Option<[f64; 2]>,
    /// Near and far edge from the apex, pixels; the same.
    pub range_px: Option<[f64; 2]>,
    /// Beams across the aperture.
    pub beams: Option<u32>,
    /// Folder of masks, grey PNGs of the images' names: 0 is background, every other value an object.
    pub masks: Option<PathBuf>,
}

/// A set of images, grouped by the shape of their fans.
#[derive(Clone, Debug)]
pub struct Source {
    /// The shapes; a frame names one by index.
    pub(super) shapes: Vec<FanGeometry>,
    pub(super) frames: Vec<FrameFiles>,
}

/// Files of one frame.
#[derive(Clone, Debug)]
pub(super) struct FrameFiles {
    image: Place,
    mask: Option<Place>,
    /// Labels of the mask's values, where they are known.
    labels: BTreeMap<u16, String>,
    /// Index of the shape.
    pub shape: usize,
}

/// A frame in memory.
pub(super) struct Frame<'a> {
    pub fan: &'a FanGeometry,
    pub width: usize,
    pub height: usize,
    pub grey: Vec<u8>,
    /// Which pixels are in the fan.
    pub inside: Vec<bool>,
    /// Number of the object of each pixel, 0 for none; `None` without masks.
    pub mask: Option<Vec<u16>>,
    pub labels: &'a BTreeMap<u16, String>,
}

impl Source {
    /// A dataset folder (with a manifest), or a plain folder of PNG images.
    ///
    /// # Errors
    /// [`RealismError`] if there is nothing to measure or the shape of the fans is not known.
    pub fn open(folder: &Path, options: &FolderOptions) -> Result<Self, RealismError> {
        if folder.join(layout::MANIFEST).is_file() { Self::dataset(folder) } else { Self::plain(folder, options) }
    }

    /// How many images.
    #[must_use]
    pub fn len(&self) -> usize {
        self.frames.len()
    }

    /// Never, of a source that was opened.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.frames.is_empty()
    }

    /// Finished frames of a dataset, finished or not.
    fn dataset(root: &Path) -> Result<Self, RealismError> {
        let dataset = Dataset::open(root)?;
        let plan = PlanShapes::read(root)?;
        let (mut shapes, mut grids) = (Vec::new(), Vec::<Grid>::new());
        let mut frames = Vec::new();
        for record in dataset.records() {
            let record = record?;
            let (Some(fan), Some(job)) = (record.views.get(&View::Fan), plan.jobs.get(record.id as usize)) else {
                continue;
            };
            let grid = job.sonar.grid();
            let known = grids.iter().position(|&other| other == grid);
            let shape = known.unwrap_or_else(|| {
                shapes.push(FanGeometry::of_map(&grid, &FanMap::new(&grid, plan.output.fan_height_px)));
                grids.push(grid);
                grids.len() - 1
            });
            // Of several looks the first is measured: it is the one that the others vary.
            let look = record.looks.first().map(String::as_str);
            frames.push(FrameFiles {
                image: dataset.place(&record, &layout::image(View::Fan, &record.name, look)),
                mask: Some(dataset.place(&record, &layout::mask(View::Fan, &record.name))),
                labels: fan.annotations.iter().map(|seen| (seen.body, seen.label.clone())).collect(),
                shape,
            });
        }
        if frames.is_empty() {
            return Err(RealismError::NoFan { path: root.to_path_buf() });
        }
        Ok(Self { shapes, frames })
    }

    /// All PNG images of a folder, by name.
    fn plain(folder: &Path, options: &FolderOptions) -> Result<Self, RealismError> {
        let images = pngs(folder)?;
        if images.is_empty() {
            return Err(RealismError::NoImages { path: folder.to_path_buf() });
        }
        let (mut shapes, mut sizes) = (Vec::new(), Vec::new());
        let mut frames = Vec::new();
        for image in images {
            let size = image::image_dimensions(&image).map_err(|error| unreadable(&image, &error))?;
            let known = sizes.iter().position(|&other| other == size);
            let shape = match known {
                Some(shape) => shape,
                None => {
                    shapes.push(given_shape(folder, &image, size, options)?);
                    sizes.push(size);
                    sizes.len() - 1
                }
            };
            let mask =
                options.masks.as_ref().zip(image.file_name()).map(|(folder, name)| Place::whole(folder.join(name)));
            frames.push(FrameFiles { image: Place::whole(image), mask, labels: BTreeMap::new(), shape });
        }
        Ok(Self { shapes, frames })
    }

    /// Reads a frame's files.
    pub(super) fn load<'a>(&'a self, files: &'a FrameFiles) -> Result<Frame<'a>, RealismError> {
        let picture = open(&files.image)?.into_luma8();
        let (width, height) = picture.dimensions();
        let fan = &self.shapes[files.shape];
        let mask = files.mask.as_ref().map(|place| read_mask(place, (width, height))).transpose()?;
        Ok(Frame {
            fan,
            width: width as usize,
            height: height as usize,
            grey: picture.into_raw(),
            inside: fan.inside(width, height),
            mask,
            labels: &files.labels,
        })
    }
}

impl Frame<'_> {
    /// Index of the pixel at a place, if it is in the fan.
    pub fn pixel(&self, place: (f64, f64)) -> Option<usize> {
        let (x, y) = ((place.0 + 0.5).floor(), (place.1 + 0.5).floor());
        if x < 0.0 || y < 0.0 || x >= self.width as f64 || y >= self.height as f64 {
            return None;
        }
        let pixel = y as usize * self.width + x as usize;
        self.inside[pixel].then_some(pixel)
    }

    /// The object at a pixel, 0 for none.
    pub fn object(&self, pixel: usize) -> u16 {
        self.mask.as_ref().map_or(0, |mask| mask[pixel])
    }

    /// Column and row of a pixel.
    pub fn place(&self, pixel: usize) -> (f64, f64) {
        ((pixel % self.width) as f64, (pixel / self.width) as f64)
    }
}

fn open(place: &Place) -> Result<DynamicImage, RealismError> {
    let picture = place.read().map_err(image::ImageError::IoError).and_then(|bytes| image::load_from_memory(&bytes));
    picture.map_err(|error| unreadable(&place.path, &error))
}

fn read_mask(place: &Place, size: (u32, u32)) -> Result<Vec<u16>, RealismError> {
    let refuse = |reason: String| RealismError::Image { path: place.path.clone(), reason };
    let mask = open(place)?;
    if (mask.width(), mask.height()) != size {
        let (width, height) = size;
        return Err(refuse(format!("is {} × {}, its image {width} × {height}", mask.width(), mask.height())));
    }
    match mask {
        DynamicImage::ImageLuma8(mask) => Ok(mask.into_raw().into_iter().map(u16::from).collect()),
        DynamicImage::ImageLuma16(mask) => Ok(mask.into_raw()),
        _ => Err(refuse("a mask is a grey PNG of 8 or 16 bits".to_owned())),
    }
}

fn unreadable(path: &Path, error: &image::ImageError) -> RealismError {
    RealismError::Image { path: path.to_path_buf(), reason: error.to_string() }
}

fn pngs(folder: &Path) -> Result<Vec<PathBuf>, RealismError> {
    let io = |source| RealismError::Io { path: folder.to_path_buf(), source };
    let mut images = Vec::new();
    for entry in fs::read_dir(folder).map_err(io)? {
        let path = entry.map_err(io)?.path();
        if path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("png")) {
            images.push(path);
        }
    }
    images.sort();
    Ok(images)
}

/// The shape that options give for pictures of a size.
fn given_shape(
    folder: &Path,
    image: &Path,
    size: (u32, u32),
    options: &FolderOptions,
) -> Result<FanGeometry, RealismError> {
    let Some(fan_deg) = options.fan_deg else {
        return Err(RealismError::NoGeometry { path: folder.to_path_buf() });
    };
    let mut fan = FanGeometry::filling(size.0, size.1, fan_deg);
    fan.apex_px = options.apex_px.unwrap_or(fan.apex_px);
    [fan.rmin_px, fan.rmax_px] = options.range_px.unwrap_or([fan.rmin_px, fan.rmax_px]);
    fan.beams = options.beams;
    let refuse = |problem, remedy| Err(RealismError::Geometry { path: image.to_path_buf(), problem, remedy });
    if !(0.0..fan.rmax_px).contains(&fan.rmin_px) {
        let problem = format!("ranges from {} to {} pixels are none", fan.rmin_px, fan.rmax_px);
        return refuse(problem, "give --range-px NEAR,FAR with 0 <= near < far");
    }
    if !fan.inside(size.0, size.1).contains(&true) {
        let problem = format!("a fan of {fan_deg}° lies outside the {} × {} pixels", size.0, size.1);
        return refuse(problem, "give the place of the fan with --apex-px and --range-px");
    }
    Ok(fan)
}

/// What a plan tells of fans.
#[derive(Deserialize)]
struct PlanShapes {
    output: PlanOutput,
    jobs: Vec<PlanJob>,
}

#[derive(Deserialize)]
struct PlanOutput {
    fan_height_px: u32,
}

#[derive(Deserialize)]
struct PlanJob {
    sonar: PlanSonar,
}

#[derive(Deserialize)]
struct PlanSonar {
    beams: u32,
    azimuth_deg: f64,
    range_m: [f64; 2],
    range_bins: u32,
}

impl PlanSonar {
    fn grid(&self) -> Grid {
        let [near_m, far_m] = self.range_m;
        Grid { beams: self.beams, bins: self.range_bins, azimuth_deg: self.azimuth_deg, near_m, far_m }
    }
}

impl PlanShapes {
    fn read(root: &Path) -> Result<Self, RealismError> {
        let path = root.join(layout::PLAN);
        let bytes = fs::read(&path).map_err(|source| RealismError::Io { path: path.clone(), source })?;
        serde_json::from_slice(&bytes).map_err(|error| RealismError::Plan { path, reason: error.to_string() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::store::png;

    fn options() -> FolderOptions {
        FolderOptions { fan_deg: Some(60.0), ..FolderOptions::default() }
    }

    #[test]
    fn a_plain_folder_is_read_by_name_with_its_masks() {
        let folder = tempfile::tempdir().unwrap();
        let masks = folder.path().join("masks");
        fs::create_dir(&masks).unwrap();
        for (name, grey) in [("b.png", 9), ("a.png", 7)] {
            fs::write(folder.path().join(name), png::grey8(40, 36, &[grey; 1440])).unwrap();
            fs::write(masks.join(name), png::grey16(40, 36, &[700; 1440])).unwrap();
        }
        fs::write(folder.path().join("notes.txt"), "no image").unwrap();
        let source = Source::open(folder.path(), &FolderOptions { masks: Some(masks), ..options() }).unwrap();
        let frames: Vec<Frame> = source.frames.iter().map(|files| source.load(files).unwrap()).collect();
        assert_eq!(frames.iter().map(|frame| frame.grey[0]).collect::<Vec<_>>(), [7, 9]);
        assert_eq!((frames[0].object(5), source.shapes.len(), source.len()), (700, 1, 2));
        assert!(frames[0].pixel((19.6, 10.4)).is_some() && frames[0].pixel((0.0, 35.0)).is_none());
        assert_eq!(frames[0].pixel((-3.0, 4.0)), None);
    }

    #[test]
    fn folders_that_cannot_be_measured_say_why() {
        let folder = tempfile::tempdir().unwrap();
        let refused = |options: &FolderOptions| Source::open(folder.path(), options).unwrap_err().to_string();
        assert!(refused(&options()).contains("no PNG image"));
        let path = folder.path().join("a.png");
        fs::write(&path, png::grey8(40, 36, &[1; 1440])).unwrap();
        assert!(refused(&FolderOptions::default()).contains("--fan-deg"));
        assert!(refused(&FolderOptions { range_px: Some([9.0, 3.0]), ..options() }).contains("--range-px"));
        assert!(refused(&FolderOptions { apex_px: Some([9.0, 900.0]), ..options() }).contains("--apex-px"));
        fs::write(&path, "no image").unwrap();
        assert!(refused(&options()).contains("a.png"));
        assert!(matches!(Source::open(&folder.path().join("x"), &options()), Err(RealismError::Io { .. })));
    }

    #[test]
    fn a_mask_of_another_size_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let masks = folder.path().join("masks");
        fs::create_dir(&masks).unwrap();
        fs::write(folder.path().join("a.png"), png::grey8(40, 36, &[1; 1440])).unwrap();
        fs::write(masks.join("a.png"), png::grey8(4, 3, &[1; 12])).unwrap();
        let source = Source::open(folder.path(), &FolderOptions { masks: Some(masks), ..options() }).unwrap();
        let message = source.load(&source.frames[0]).err().unwrap().to_string();
        assert!(message.contains("4 × 3") && message.contains("40 × 36"), "{message}");
    }
}
