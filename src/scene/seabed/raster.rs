//! Height maps from files: PNG, EXR and CSV to a grid of numbers.
//!
//! Knows nothing of metres or of where the map will lie.

use std::path::Path;

use exr::prelude::{FlatSamples, read_first_flat_layer_from_file};

use super::SeabedError;

/// Longest side of a map.
const MAX_SIDE: usize = 20_000;

/// Numbers row by row, the first row in the north.
#[derive(Clone, Debug, PartialEq)]
pub struct Raster {
    /// Columns.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// `width × height` finite numbers.
    pub values: Vec<f32>,
    /// What the numbers are.
    pub unit: Unit,
}

/// What a map's numbers are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// Metres.
    Metre,
    /// Brightness of a picture, from black 0 to white 1.
    Brightness,
}

impl Raster {
    /// Reads a file by its extension: `.png` (grey, 8 or 16 bits), `.exr` (its first channel) or `.csv` (a number a cell,
    /// no header).
    ///
    /// # Errors
    /// A missing or odd file, with its path, the place in it and the remedy.
    pub fn load(path: &Path) -> Result<Self, SeabedError> {
        let extension = path.extension().and_then(|extension| extension.to_str()).unwrap_or("").to_lowercase();
        let read = match extension.as_str() {
            "png" => png(path),
            "exr" => exr(path),
            "csv" => csv(path),
            _ => Err("is no height map that can be read: take a .png, .exr or .csv file".to_owned()),
        };
        let refuse = |problem| SeabedError::File { path: path.to_owned(), problem };
        read.and_then(Self::checked).map_err(refuse)
    }

    fn checked(self) -> Result<Self, String> {
        let (width, height) = (self.width, self.height);
        if width < 2 || height < 2 {
            return Err(format!("is {width} by {height} numbers; a height map has at least 2 by 2"));
        }
        if width > MAX_SIDE || height > MAX_SIDE {
            return Err(format!("is {width} by {height} numbers; take at most {MAX_SIDE} a side"));
        }
        match self.values.iter().position(|value| !value.is_finite()) {
            Some(at) => {
                let (row, column) = (at / width + 1, at % width + 1);
                Err(format!("has no finite number in row {row}, column {column}; fill the gaps"))
            }
            None => Ok(self),
        }
    }
}

fn unreadable(error: impl std::fmt::Display) -> String {
    format!("cannot be read: {error}")
}

fn png(path: &Path) -> Result<Raster, String> {
    use image::DynamicImage::{ImageLuma8, ImageLuma16};
    let bytes = std::fs::read(path).map_err(unreadable)?;
    let picture = image::load_from_memory_with_format(&bytes, image::ImageFormat::Png).map_err(unreadable)?;
    let (width, height) = (picture.width() as usize, picture.height() as usize);
    let values = match picture {
        ImageLuma8(grey) => grey.into_raw().into_iter().map(|v| f32::from(v) / 255.0).collect(),
        ImageLuma16(grey) => grey.into_raw().into_iter().map(|v| f32::from(v) / 65_535.0).collect(),
        other => return Err(format!("is a picture of {:?}; save it as grey of 8 or 16 bits", other.color())),
    };
    Ok(Raster { width, height, values, unit: Unit::Brightness })
}

fn exr(path: &Path) -> Result<Raster, String> {
    std::fs::metadata(path).map_err(unreadable)?;
    let picture = read_first_flat_layer_from_file(path).map_err(unreadable)?;
    let layer = picture.layer_data;
    let Some(channel) = layer.channel_data.list.into_iter().next() else {
        return Err("has no channel; save one channel of heights in metres".into());
    };
    let values = match channel.sample_data {
        FlatSamples::F32(values) => values,
        FlatSamples::F16(values) => values.into_iter().map(exr::prelude::f16::to_f32).collect(),
        FlatSamples::U32(values) => values.into_iter().map(|value| value as f32).collect(),
    };
    Ok(Raster { width: layer.size.width(), height: layer.size.height(), values, unit: Unit::Metre })
}

fn csv(path: &Path) -> Result<Raster, String> {
    let mut reader =
        csv::ReaderBuilder::new().has_headers(false).trim(csv::Trim::All).from_path(path).map_err(unreadable)?;
    let (mut values, mut width, mut height) = (Vec::new(), 0, 0);
    for record in reader.records() {
        // Its words for rows of unequal length name the line and both lengths.
        let record = record.map_err(|error| format!("cannot be read: {error}; give every row the same length"))?;
        (width, height) = (record.len(), height + 1);
        for (column, text) in record.iter().enumerate() {
            let line = record.position().map_or(height as u64, csv::Position::line);
            let value = text.parse::<f32>().map_err(|_| {
                format!("has `{text}` in line {line}, column {}: write a height in metres, no header", column + 1)
            })?;
            values.push(value);
        }
    }
    Ok(Raster { width, height, values, unit: Unit::Metre })
}

#[cfg(test)]
mod tests {
    use exr::prelude::{SpecificChannels, WritableImage as _};

    use super::*;

    fn load(name: &str, bytes: &[u8]) -> Result<Raster, SeabedError> {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join(name);
        std::fs::write(&path, bytes).expect("written");
        Raster::load(&path)
    }

    fn png_of(picture: image::DynamicImage) -> Vec<u8> {
        let mut bytes = std::io::Cursor::new(Vec::new());
        picture.write_to(&mut bytes, image::ImageFormat::Png).expect("encoded");
        bytes.into_inner()
    }

    #[test]
    fn pictures_and_tables_become_numbers() {
        let grey8 = image::GrayImage::from_raw(2, 2, vec![0, 255, 51, 102]).expect("four pixels");
        let read = load("a.png", &png_of(grey8.into())).expect("8 bits");
        assert_eq!((read.width, read.values, read.unit), (2, vec![0.0, 1.0, 0.2, 0.4], Unit::Brightness));
        let grey16 = image::ImageBuffer::<image::Luma<u16>, _>::from_raw(3, 2, vec![0u16, 65_535, 13_107, 1, 2, 3]);
        let read = load("a.PNG", &png_of(grey16.expect("six pixels").into())).expect("16 bits");
        assert_eq!((read.width, read.height, read.values[2]), (3, 2, 0.2));
        let read = load("a.csv", b"1.5, -2\n3,4e-1\n0,0\n").expect("a table");
        assert_eq!((read.width, read.height, &read.values[..4]), (2, 3, &[1.5, -2.0, 3.0, 0.4][..]));
        assert_eq!(read.unit, Unit::Metre);
    }

    #[test]
    fn exr_heights_come_back_to_the_bit() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("a.exr");
        let heights = vec![0.1f32, -3.25, 7e-3, 1e4, 0.0, 2.0];
        let channels = SpecificChannels::build().with_channel("Y").with_pixel_fn(|at| (heights[at.1 * 3 + at.0],));
        exr::prelude::Image::from_channels((3, 2), channels).write().to_file(&path).expect("written");
        assert_eq!(Raster::load(&path).expect("readable").values, heights);
    }

    #[test]
    fn odd_files_are_refused_with_a_remedy() {
        let told = |name: &str, bytes: &[u8], words: &[&str]| {
            let message = load(name, bytes).expect_err(name).to_string();
            words.iter().for_each(|word| assert!(message.contains(word), "`{word}` is not in: {message}"));
        };
        told("a.csv", b"1,2\n3,x\n", &["a.csv", "`x` in line 2, column 2"]);
        told("a.csv", b"1,2\n3\n", &["a.csv", "line: 2", "same length"]);
        told("a.csv", b"1,2\n3,nan\n", &["row 2, column 2"]);
        told("a.csv", b"1,2\n", &["2 by 1", "at least 2 by 2"]);
        told("a.png", b"no picture", &["a.png", "cannot be read"]);
        told("a.png", &png_of(image::RgbImage::new(2, 2).into()), &["Rgb8", "grey"]);
        told("a.exr", b"no picture", &["a.exr", "cannot be read"]);
        told("a.tif", b"", &["a.tif", ".png, .exr or .csv"]);
        let missing = Raster::load(Path::new("/no/such.exr")).expect_err("missing").to_string();
        assert!(missing.contains("such.exr") && missing.contains("cannot be read"), "{missing}");
    }
}
