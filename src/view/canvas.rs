//! A picture to draw on: rectangles, text, and other pictures scaled to fit.

use font8x8::UnicodeFonts as _;
use image::{Rgb, RgbImage};

/// Red, green, blue.
pub(super) type Colour = [u8; 3];

/// Where something is drawn, in pixels of the canvas.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Area {
    pub left: u32,
    pub top: u32,
    pub width: u32,
    pub height: u32,
}

/// Side of a letter at size 1, pixels.
const LETTER: u32 = 8;

/// An RGB picture; what lies outside is not drawn.
pub(super) struct Canvas {
    picture: RgbImage,
}

impl Canvas {
    pub fn new(width: u32, height: u32, background: Colour) -> Self {
        Self { picture: RgbImage::from_pixel(width, height, Rgb(background)) }
    }

    pub fn into_picture(self) -> RgbImage {
        self.picture
    }

    /// Mixes `colour` into a pixel; `weight` 0 leaves it, 255 replaces it.
    pub fn blend(&mut self, x: u32, y: u32, colour: Colour, weight: u8) {
        if let Some(Rgb(pixel)) = self.picture.get_pixel_mut_checked(x, y) {
            let weight = u32::from(weight);
            for (old, new) in pixel.iter_mut().zip(colour) {
                *old = ((u32::from(*old) * (255 - weight) + u32::from(new) * weight + 127) / 255) as u8;
            }
        }
    }

    pub fn fill(&mut self, area: Area, colour: Colour, weight: u8) {
        for y in area.top..area.top + area.height {
            (area.left..area.left + area.width).for_each(|x| self.blend(x, y, colour, weight));
        }
    }

    /// The outline of an area, one pixel wide, inside it.
    pub fn outline(&mut self, area: Area, colour: Colour) {
        let Area { left, top, width, height } = area;
        for top in [top, top + height.saturating_sub(1)] {
            self.fill(Area { top, height: 1, ..area }, colour, 255);
        }
        for left in [left, left + width.saturating_sub(1)] {
            self.fill(Area { left, width: 1, ..area }, colour, 255);
        }
    }

    /// Text with its top left corner at (left, top), letters of `size` · 8 pixels. Letters that the font lacks are `?`.
    pub fn text(&mut self, left: u32, top: u32, text: &str, style: (u32, Colour)) {
        let (size, colour) = style;
        for (letter, left) in text.chars().zip((left..).step_by((LETTER * size) as usize)) {
            for (row, bits) in (0..).zip(glyph(letter)) {
                for column in (0..LETTER).filter(|column| bits >> column & 1 == 1) {
                    let (left, top) = (left + column * size, top + row * size);
                    self.fill(Area { left, top, width: size, height: size }, colour, 255);
                }
            }
        }
    }

    /// A grey picture in an area, each pixel the mean of what it covers.
    pub fn grey(&mut self, area: Area, source: (u32, u32), pixels: &[u8]) {
        let (width, height) = source;
        let (columns, rows) = (spans(width, area.width), spans(height, area.height));
        for (y, row) in (area.top..).zip(&rows) {
            for (x, column) in (area.left..).zip(&columns) {
                let (mut sum, mut weights) = (0.0, 0.0);
                for (source_y, weight_y) in row.pixels() {
                    let line = &pixels[source_y * width as usize..][..width as usize];
                    for (source_x, weight_x) in column.pixels() {
                        sum += f64::from(line[source_x]) * weight_x * weight_y;
                        weights += weight_x * weight_y;
                    }
                }
                self.blend(x, y, [(sum / weights).round() as u8; 3], 255);
            }
        }
    }
}

/// Width of a text, pixels.
pub(super) fn text_width(text: &str, size: u32) -> u32 {
    text.chars().count() as u32 * LETTER * size
}

fn glyph(letter: char) -> [u8; 8] {
    let known = |letter| font8x8::BASIC_FONTS.get(letter).or_else(|| font8x8::LATIN_FONTS.get(letter));
    known(letter).or_else(|| known('?')).unwrap_or_default()
}

/// The stretch of source pixels under one target pixel.
struct Span {
    start: f64,
    end: f64,
}

fn spans(source: u32, target: u32) -> Vec<Span> {
    let scale = f64::from(source) / f64::from(target);
    (0..target).map(|i| Span { start: f64::from(i) * scale, end: f64::from(i + 1) * scale }).collect()
}

impl Span {
    /// Source pixels and how much of each is covered.
    fn pixels(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        // A rounding error may reach past the last pixel by less than a millionth of one.
        let last = (self.end - 1e-6).floor() as usize;
        (self.start.floor() as usize..=last).map(|pixel| {
            let covered = self.end.min(pixel as f64 + 1.0) - self.start.max(pixel as f64);
            (pixel, covered.max(1e-9))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scaling_keeps_the_mean() {
        let pixels: Vec<u8> = (0..7 * 5).map(|i| (i * 7) as u8).collect();
        let area = Area { left: 1, top: 2, width: 1, height: 1 };
        let mut canvas = Canvas::new(3, 4, [0, 0, 0]);
        canvas.grey(area, (7, 5), &pixels);
        let picture = canvas.into_picture();
        assert_eq!(picture.get_pixel(1, 2), &Rgb([119; 3]));
        assert_eq!(picture.get_pixel(0, 2), &Rgb([0; 3]));
        let mut canvas = Canvas::new(14, 15, [0, 0, 0]);
        canvas.grey(Area { left: 0, top: 0, width: 14, height: 15 }, (7, 5), &pixels);
        let picture = canvas.into_picture();
        for (x, y, pixel) in picture.enumerate_pixels() {
            assert_eq!(pixel.0[0], pixels[(y / 3 * 7 + x / 2) as usize], "enlarged pixels stay as they are");
        }
    }

    #[test]
    fn letters_are_drawn_and_the_edge_cuts_them() {
        let mut canvas = Canvas::new(10, 8, [0, 0, 0]);
        canvas.text(0, 0, "I\u{4e00}", (1, [255; 3]));
        let picture = canvas.into_picture();
        assert!(picture.pixels().filter(|pixel| pixel.0 == [255; 3]).count() > 8);
    }
}
