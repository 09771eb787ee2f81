//! The contact sheet: each frame a row with its polar and fan images, without and with labels.

use std::collections::BTreeMap;

use image::RgbImage;

use super::canvas::{Area, Canvas, Colour, text_width};
use crate::label::ViewLabels;

/// Height of each picture on the sheet, pixels.
const PICTURE_HEIGHT: u32 = 400;
/// Space around pictures, pixels.
const GAP: u32 = 12;
/// Height of a frame's title line, pixels.
const TITLE_HEIGHT: u32 = 32;
const BACKGROUND: Colour = [16, 20, 26];
const TITLE: Colour = [224, 230, 238];
const LABEL_BACK: Colour = [8, 10, 13];
/// Weight of an instance's colour over the image, of 255.
const TINT: u8 = 90;
/// Colours of instances, easy to tell apart on grey; they repeat.
const COLOURS: [Colour; 10] = [
    [255, 140, 50],
    [60, 190, 255],
    [120, 230, 90],
    [255, 90, 130],
    [200, 140, 255],
    [255, 220, 70],
    [60, 225, 195],
    [255, 150, 205],
    [150, 175, 255],
    [205, 215, 120],
];

/// An 8-bit grey image, row by row, `width · height` pixels.
#[derive(Clone, Copy, Debug)]
pub struct GreyImage<'a> {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Row by row.
    pub pixels: &'a [u8],
}

/// A frame on the sheet.
#[derive(Clone, Copy, Debug)]
pub struct SheetFrame<'a> {
    /// What is written above it.
    pub title: &'a str,
    /// Polar image and its labels.
    pub polar: (GreyImage<'a>, &'a ViewLabels),
    /// Fan image and its labels.
    pub fan: (GreyImage<'a>, &'a ViewLabels),
    /// What is written at each body's box; body number = index + 1.
    pub names: &'a [String],
}

/// Draws the sheet: one row a frame, each with the polar image, the same with labels, the fan image, the same with labels.
///
/// # Panics
/// If an image's pixels or its labels' mask do not fit its size.
#[must_use]
pub fn contact_sheet(frames: &[SheetFrame<'_>]) -> RgbImage {
    let row_height = TITLE_HEIGHT + PICTURE_HEIGHT + GAP;
    let width = frames.iter().map(row_width).max().unwrap_or(GAP);
    let mut canvas = Canvas::new(width, GAP + row_height * frames.len() as u32, BACKGROUND);
    for (frame, top) in frames.iter().zip((GAP..).step_by(row_height as usize)) {
        canvas.text(GAP, top + 4, frame.title, (2, TITLE));
        let mut left = GAP;
        for (image, labels) in [frame.polar, frame.fan] {
            let area = Area { left, top: top + TITLE_HEIGHT, width: scaled_width(image), height: PICTURE_HEIGHT };
            canvas.grey(area, (image.width, image.height), image.pixels);
            let area = Area { left: left + area.width + GAP, ..area };
            canvas.grey(area, (image.width, image.height), image.pixels);
            draw_labels(&mut canvas, area, labels, frame.names);
            left = area.left + area.width + GAP;
        }
    }
    canvas.into_picture()
}

fn row_width(frame: &SheetFrame<'_>) -> u32 {
    let pictures = GAP + [frame.polar, frame.fan].iter().map(|view| 2 * (scaled_width(view.0) + GAP)).sum::<u32>();
    pictures.max(text_width(frame.title, 2) + 2 * GAP)
}

fn scaled_width(image: GreyImage<'_>) -> u32 {
    (image.width * PICTURE_HEIGHT / image.height.max(1)).max(1)
}

/// Masks first, then boxes, then names, so that no mask hides a name.
fn draw_labels(canvas: &mut Canvas, area: Area, labels: &ViewLabels, names: &[String]) {
    tint(canvas, area, labels);
    let boxes: BTreeMap<u16, Area> =
        labels.annotations.iter().map(|annotation| (annotation.body, place(annotation.bbox, labels, area))).collect();
    for (&body, &place) in &boxes {
        canvas.outline(place, colour(body));
    }
    for (&body, &place) in &boxes {
        let unnamed = String::new();
        let name = names.get(usize::from(body) - 1).unwrap_or(&unnamed);
        draw_name(canvas, area, place, (name, colour(body)));
    }
}

/// The colour of each pixel's dominant body over the image.
fn tint(canvas: &mut Canvas, area: Area, labels: &ViewLabels) {
    for y in 0..area.height {
        // The source pixel under the middle of the target pixel.
        let row = (2 * y + 1) * labels.height / (2 * area.height);
        let line = &labels.mask[(row * labels.width) as usize..][..labels.width as usize];
        for x in 0..area.width {
            let body = line[((2 * x + 1) * labels.width / (2 * area.width)) as usize];
            if body != 0 {
                canvas.blend(area.left + x, area.top + y, colour(body), TINT);
            }
        }
    }
}

/// A box of the view where it lies on the sheet, a pixel larger on each side, within `area`.
fn place(bbox: [u32; 4], labels: &ViewLabels, area: Area) -> Area {
    let [x, y, width, height] = bbox;
    let across = |x: u32| x * area.width / labels.width;
    let down = |y: u32| y * area.height / labels.height;
    let (left, top) = (across(x).saturating_sub(1), down(y).saturating_sub(1));
    let (right, bottom) = ((across(x + width) + 2).min(area.width), (down(y + height) + 2).min(area.height));
    Area { left: area.left + left, top: area.top + top, width: right - left, height: bottom - top }
}

/// A name above its box, or below it where there is no room above; always within `area`.
fn draw_name(canvas: &mut Canvas, area: Area, place: Area, name: (&str, Colour)) {
    const HEIGHT: u32 = 11;
    let width = (text_width(name.0, 1) + 3).min(area.width);
    let letters = ((width - 3) / text_width("x", 1)) as usize;
    let text: String = name.0.chars().take(letters).collect();
    let left = place.left.min(area.left + area.width - width);
    let above = place.top.checked_sub(HEIGHT).filter(|&top| top >= area.top);
    let top = above.unwrap_or((place.top + place.height).min(area.top + area.height - HEIGHT));
    canvas.fill(Area { left, top, width, height: HEIGHT }, LABEL_BACK, 200);
    canvas.text(left + 2, top + 2, &text, (1, name.1));
}

fn colour(body: u16) -> Colour {
    COLOURS[usize::from(body.wrapping_sub(1)) % COLOURS.len()]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::label::{Annotation, Rle};

    fn labels() -> ViewLabels {
        let mut mask = vec![0; 40 * 80];
        (30..40).for_each(|row| mask[row * 40 + 10..row * 40 + 20].fill(2));
        let rle = Rle::from_runs(3200, &[(830, 10)]);
        ViewLabels {
            width: 40,
            height: 80,
            mask,
            annotations: vec![Annotation { body: 2, bbox: [10, 30, 10, 10], area: 100, rle }],
        }
    }

    #[test]
    fn labels_are_drawn_on_the_second_of_each_pair_only() {
        let (pixels, labels) = (vec![60; 3200], labels());
        let image = GreyImage { width: 40, height: 80, pixels: &pixels };
        let names = ["tire".to_owned(), "a very long name that does not fit".to_owned()];
        let frame = SheetFrame { title: "000001", polar: (image, &labels), fan: (image, &labels), names: &names };
        let sheet = contact_sheet(&[frame, frame]);
        assert_eq!(sheet.dimensions(), (4 * 200 + 5 * 12, 12 + 2 * (400 + 32 + 12)));
        // The middle of the body in each of the four pictures of the first row.
        let middle = |picture: u32| sheet.get_pixel(12 + picture * 212 + 75, 12 + 32 + 175).0;
        assert_eq!([middle(0), middle(2)], [[60; 3]; 2]);
        let tinted = [0, 1, 2].map(|c| (60 * (255 - 90) + u32::from(COLOURS[1][c]) * 90 + 127) / 255).map(|c| c as u8);
        assert_eq!([middle(1), middle(3)], [tinted; 2]);
        assert_eq!(sheet.get_pixel(12 + 212 + 49, 12 + 32 + 175).0, COLOURS[1], "left side of the box");
        assert_eq!(sheet.get_pixel(5, 300).0, BACKGROUND);
    }

    #[test]
    fn boxes_at_the_edges_and_empty_sheets_are_drawn() {
        let mut labels = labels();
        labels.annotations[0].bbox = [0, 0, 40, 80];
        labels.annotations[0].body = 700;
        let pixels = vec![0; 3200];
        let image = GreyImage { width: 40, height: 80, pixels: &pixels };
        let frame = SheetFrame { title: "ü", polar: (image, &labels), fan: (image, &labels), names: &[] };
        assert_eq!(contact_sheet(&[frame]).height(), 12 + 444);
        assert_eq!(contact_sheet(&[]).dimensions(), (12, 12));
    }
}
