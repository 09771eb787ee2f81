//! A model from three sides, at one scale, with a bar to measure by.
//!
//! Knows nothing of catalogs: it gets geometry at true size and the materials of its surfaces.

use glam::Vec3;
use image::RgbImage;

use super::canvas::{Area, Canvas, Colour};
use crate::catalog::Model;

/// What to draw.
#[derive(Clone, Copy)]
pub struct Portrait<'a> {
    /// At true size: x right, y back, z up, metres.
    pub model: &'a Model,
    /// Over the picture.
    pub title: &'a str,
    /// The acoustic material of a surface, by its name.
    pub material_of: &'a dyn Fn(&str) -> String,
}

/// Side of a view, pixels.
const SIDE: u32 = 380;
const MARGIN: u32 = 20;
const HEAD: u32 = 34;
const FOOT: u32 = 44;

const PAPER: Colour = [250, 250, 248];
const INK: Colour = [40, 44, 48];

/// Draws a model from the front, from its right side and from above.
#[must_use]
pub fn portrait(asked: &Portrait<'_>) -> RgbImage {
    let (low, high) = asked.model.bounds().unwrap_or_default();
    let size = high - low;
    let longest = f64::from(size.max_element()).max(1e-6);
    let scale = f64::from(SIDE - 2 * MARGIN) / longest;
    let mut canvas = Canvas::new(3 * SIDE, HEAD + SIDE + FOOT, PAPER);
    canvas.text(MARGIN, 12, asked.title, (1, INK));
    for (number, view) in [View::Front, View::Side, View::Top].into_iter().enumerate() {
        let left = SIDE * number as u32;
        let mut sheet = Sheet::new(view, (low + high) * 0.5, scale);
        for part in &asked.model.parts {
            let colour = colour_of(&(asked.material_of)(&part.material));
            for corners in &part.triangles {
                sheet.triangle(corners.map(|vertex| part.positions[vertex as usize]), colour);
            }
        }
        sheet.put(&mut canvas, left);
        canvas.text(left + MARGIN, HEAD + SIDE + 4, view.name(), (1, INK));
    }
    let bar = nice(longest / 3.0);
    let area = Area { left: MARGIN, top: HEAD + SIDE + 22, width: (bar * scale).round() as u32, height: 4 };
    canvas.fill(area, INK, 255);
    let text = if bar < 1.0 { format!("{:.0} cm", bar * 100.0) } else { format!("{bar:.0} m") };
    canvas.text(area.left + area.width + 8, area.top - 2, &text, (1, INK));
    canvas.into_picture()
}

/// 1, 2 or 5 times a power of ten, not above `length`.
fn nice(length: f64) -> f64 {
    let mut decade = 1.0;
    while decade > length {
        decade /= 10.0;
    }
    while decade * 10.0 <= length {
        decade *= 10.0;
    }
    [5.0, 2.0, 1.0].into_iter().map(|step| step * decade).find(|bar| *bar <= length).unwrap_or(decade)
}

#[derive(Clone, Copy)]
enum View {
    Front,
    Side,
    Top,
}

impl View {
    fn name(self) -> &'static str {
        match self {
            Self::Front => "front",
            Self::Side => "right side",
            Self::Top => "top",
        }
    }

    /// Right and up on the picture, and towards the eye.
    fn axes(self) -> [Vec3; 3] {
        match self {
            Self::Front => [Vec3::X, Vec3::Z, Vec3::NEG_Y],
            Self::Side => [Vec3::Y, Vec3::Z, Vec3::X],
            Self::Top => [Vec3::X, Vec3::Y, Vec3::Z],
        }
    }
}

/// A view while it is drawn: the nearest surface of each pixel.
struct Sheet {
    axes: [Vec3; 3],
    centre: Vec3,
    scale: f64,
    depth: Vec<f64>,
    colour: Vec<Colour>,
}

impl Sheet {
    fn new(view: View, centre: Vec3, scale: f64) -> Self {
        let pixels = (SIDE * SIDE) as usize;
        Self { axes: view.axes(), centre, scale, depth: vec![f64::NEG_INFINITY; pixels], colour: vec![PAPER; pixels] }
    }

    fn triangle(&mut self, corners: [Vec3; 3], colour: Colour) {
        let [right, up, eye] = self.axes;
        let half = 0.5 * f64::from(SIDE);
        let p = corners.map(|corner| {
            let at = corner - self.centre;
            let along = |axis: Vec3| f64::from(at.dot(axis)) * self.scale;
            [half + along(right), half - along(up), along(eye)]
        });
        let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize_or_zero();
        let shaded = shade(colour, normal, self.axes);
        let twice = (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0]);
        if twice.abs() < 1e-9 {
            return;
        }
        let range = |axis: usize| {
            let low = p.iter().map(|c| c[axis]).fold(f64::INFINITY, f64::min).floor().max(0.0);
            let high = p.iter().map(|c| c[axis]).fold(0.0, f64::max).ceil().min(f64::from(SIDE - 1));
            low as u32..=high.max(0.0) as u32
        };
        for y in range(1) {
            for x in range(0) {
                let (px, py) = (f64::from(x) + 0.5, f64::from(y) + 0.5);
                let weight =
                    |a: [f64; 3], b: [f64; 3]| ((b[0] - a[0]) * (py - a[1]) - (b[1] - a[1]) * (px - a[0])) / twice;
                let weights = [weight(p[1], p[2]), weight(p[2], p[0]), weight(p[0], p[1])];
                if weights.iter().any(|w| *w < -1e-9) {
                    continue;
                }
                let depth: f64 = weights.iter().zip(p).map(|(w, corner)| w * corner[2]).sum();
                let pixel = (y * SIDE + x) as usize;
                if depth > self.depth[pixel] {
                    self.depth[pixel] = depth;
                    self.colour[pixel] = shaded;
                }
            }
        }
    }

    fn put(&self, canvas: &mut Canvas, left: u32) {
        for (pixel, colour) in self.colour.iter().enumerate() {
            let (x, y) = (pixel as u32 % SIDE, pixel as u32 / SIDE);
            canvas.blend(left + x, HEAD + y, *colour, 255);
        }
    }
}

/// Light from over the viewer's left shoulder; both sides of a surface are seen.
fn shade(colour: Colour, normal: Vec3, [right, up, eye]: [Vec3; 3]) -> Colour {
    let light = (eye * 0.8 + up * 0.5 - right * 0.35).normalize();
    let facing = if normal.dot(eye) < 0.0 { -normal } else { normal };
    let bright = 0.35 + 0.65 * facing.dot(light).max(0.0);
    colour.map(|part| (f32::from(part) * bright).min(255.0) as u8)
}

fn colour_of(material: &str) -> Colour {
    match material {
        "steel" => [150, 160, 172],
        "iron" => [148, 104, 84],
        "aluminium" => [196, 202, 208],
        "concrete" => [172, 168, 158],
        "rock" => [140, 130, 118],
        "wood" => [184, 136, 86],
        "rubber" => [86, 86, 90],
        "glass" => [122, 182, 150],
        "ceramic" => [206, 138, 98],
        "plastic" => [230, 150, 60],
        "rope" => [208, 186, 134],
        "flesh" => [222, 160, 156],
        "plant" => [116, 168, 90],
        _ => [176, 170, 190],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalog::Part;

    #[test]
    fn a_flat_plate_is_broad_from_above_and_thin_from_the_sides() {
        let corners = [[-1.0, -0.5, 0.0], [1.0, -0.5, 0.0], [1.0, 0.5, 0.02], [-1.0, 0.5, 0.02]];
        let positions = corners.map(Vec3::from_array).to_vec();
        let plate = Part { positions, triangles: vec![[0, 1, 2], [0, 2, 3]], ..Part::default() };
        let model = Model { parts: vec![plate], ..Model::default() };
        let picture = portrait(&Portrait { model: &model, title: "plate", material_of: &|_| "steel".into() });
        let count = |left: u32| {
            let pixels = (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y)));
            pixels.filter(|&(x, y)| picture.get_pixel(left + x, HEAD + y).0 != PAPER).count()
        };
        let (front, side, top) = (count(0), count(SIDE), count(2 * SIDE));
        assert!(top > 50_000 && front < 2_500 && side < 2_500, "{front} {side} {top}");
        assert_eq!(nice(0.7), 0.5);
        assert_eq!(nice(33.0), 20.0);
    }
}
