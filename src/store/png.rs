//! PNG bytes: 8-bit grey pictures, 16-bit masks, and colour for people to look at.
//!
//! Compression and filters are fixed, since the bytes are part of the dataset hash.

use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder as _};

/// An 8-bit grey picture, row by row.
///
/// # Panics
/// If `pixels` is not `width · height` long or empty.
#[must_use]
pub fn grey8(width: u32, height: u32, pixels: &[u8]) -> Vec<u8> {
    encode(width, height, pixels, Kind { colour: ExtendedColorType::L8, filter: FilterType::Sub })
}

/// A 16-bit grey picture, row by row.
///
/// # Panics
/// If `pixels` is not `width · height` long or empty.
#[must_use]
pub fn grey16(width: u32, height: u32, pixels: &[u16]) -> Vec<u8> {
    let mut bytes = vec![0; 2 * pixels.len()];
    bytes.chunks_exact_mut(2).zip(pixels).for_each(|(two, pixel)| two.copy_from_slice(&pixel.to_ne_bytes()));
    // Within a mask's areas rows repeat the row above: zeros after this filter, which compress best.
    encode(width, height, &bytes, Kind { colour: ExtendedColorType::L16, filter: FilterType::Up })
}

/// A colour picture, three bytes a pixel, row by row.
///
/// # Panics
/// If `pixels` is not `3 · width · height` long or empty.
#[must_use]
pub fn rgb8(width: u32, height: u32, pixels: &[u8]) -> Vec<u8> {
    encode(width, height, pixels, Kind { colour: ExtendedColorType::Rgb8, filter: FilterType::Adaptive })
}

struct Kind {
    colour: ExtendedColorType,
    filter: FilterType,
}

fn encode(width: u32, height: u32, bytes: &[u8], kind: Kind) -> Vec<u8> {
    let mut png = Vec::with_capacity(bytes.len() / 2 + 1024);
    PngEncoder::new_with_quality(&mut png, CompressionType::Fast, kind.filter)
        .write_image(bytes, width, height, kind.colour)
        .expect("writing to memory fails only for sizes that the caller must not give");
    png
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::rng::Stream;

    #[test]
    fn pictures_come_back_as_they_were() {
        let mut bytes = vec![0; 60 * 40 * 3];
        Stream::at(1, "test", 0, "png").fill_bits(&mut bytes);
        let grey = image::load_from_memory(&grey8(60, 40, &bytes[..2400])).unwrap();
        assert_eq!(grey.as_luma8().unwrap().as_raw(), &bytes[..2400]);
        let colour = image::load_from_memory(&rgb8(60, 40, &bytes)).unwrap();
        assert_eq!(colour.as_rgb8().unwrap().as_raw(), &bytes);
        let wide: Vec<u16> = (0..2400).map(|i| i * 27).collect();
        let mask = image::load_from_memory(&grey16(60, 40, &wide)).unwrap();
        assert_eq!(mask.as_luma16().unwrap().as_raw(), &wide);
    }
}
