//! Fewer triangles for models that have more than any sonar resolves: vertices of one small cell become one.
//!
//! Knows nothing of catalogs. Source: Rossignac & Borrel (1993), Multi-resolution 3D approximations for rendering complex
//! scenes, vertex clustering.

use std::collections::{BTreeMap, BTreeSet};

use glam::{DVec3, Vec3};

use super::model::{Model, Part};

/// Most triangles that a model keeps.
pub const MOST_TRIANGLES: usize = 200_000;

/// Cells along the longest side, at first; halved until the triangles are few enough.
const CELLS: f32 = 2048.0;

/// What simplifying did.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Simplified {
    /// Triangles before.
    pub from: usize,
    /// Triangles after.
    pub to: usize,
    /// No vertex moved farther than this, in the model's units.
    pub moved: f64,
}

/// Merges vertices until a model has at most `most` triangles; none if it has no more than that. Equal models come out
/// equal, bit for bit.
pub fn simplify(model: &mut Model, most: usize) -> Option<Simplified> {
    let count = |model: &Model| model.parts.iter().map(|part| part.triangles.len()).sum::<usize>();
    let from = count(model);
    let (low, high) = model.bounds()?;
    let longest = (high - low).max_element();
    if from <= most || longest <= 0.0 {
        return None;
    }
    let mut cells = CELLS;
    loop {
        let cell = longest / cells;
        let parts: Vec<Part> = model.parts.iter().map(|part| clustered(part, low, cell)).collect();
        let coarser = Model { parts, origin: model.origin };
        let to = count(&coarser);
        if to <= most || cells < 4.0 {
            *model = coarser;
            model.parts.retain(|part| !part.triangles.is_empty());
            return Some(Simplified { from, to, moved: f64::from(cell) * 3.0_f64.sqrt() });
        }
        cells *= 0.5;
    }
}

/// A part with one vertex a cell: the mean of those that were there.
fn clustered(part: &Part, low: Vec3, cell: f32) -> Part {
    let cell_of = |p: Vec3| ((p - low) / cell).floor().to_array().map(|c| c as i32);
    let mut cells: BTreeMap<[i32; 3], (u32, DVec3, f64)> = BTreeMap::new();
    let mut used: BTreeSet<u32> = BTreeSet::new();
    used.extend(part.triangles.iter().flatten());
    let mut number_of = vec![0_u32; part.positions.len()];
    for &vertex in &used {
        let place = part.positions[vertex as usize];
        let next = cells.len() as u32;
        let (number, sum, weight) = cells.entry(cell_of(place)).or_insert((next, DVec3::ZERO, 0.0));
        *sum += place.as_dvec3();
        *weight += 1.0;
        number_of[vertex as usize] = *number;
    }
    let mut positions = vec![Vec3::ZERO; cells.len()];
    for (number, sum, weight) in cells.values() {
        positions[*number as usize] = (*sum / *weight).as_vec3();
    }
    // What fell onto one triangle, either way round, is one.
    let mut seen: BTreeSet<[u32; 3]> = BTreeSet::new();
    let triangles = part.triangles.iter().map(|corners| corners.map(|vertex| number_of[vertex as usize]));
    let triangles = triangles.filter(|&[a, b, c]| {
        let mut sorted = [a, b, c];
        sorted.sort_unstable();
        a != b && b != c && c != a && seen.insert(sorted)
    });
    Part { triangles: triangles.collect(), positions, ..part.clone() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_dense_ball_stays_a_ball() {
        // Rings of latitude: 2·n² triangles without shared vertices.
        let n = 240;
        let at = |i: usize, j: usize| {
            let (a, b) = (std::f64::consts::PI * i as f64 / n as f64, std::f64::consts::TAU * j as f64 / n as f64);
            let (sin, cos) = (crate::math::real::sin, crate::math::real::cos);
            DVec3::new(sin(a) * cos(b), sin(a) * sin(b), cos(a)).as_vec3()
        };
        let mut part = Part::default();
        for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
            for corners in [[at(i, j), at(i + 1, j), at(i + 1, j + 1)], [at(i, j), at(i + 1, j + 1), at(i, j + 1)]] {
                let first = part.positions.len() as u32;
                part.positions.extend(corners);
                part.triangles.push([first, first + 1, first + 2]);
            }
        }
        let whole = Model { parts: vec![part], ..Model::default() };
        let mut model = whole.clone();
        assert_eq!(simplify(&mut model, 10_000_000), None);
        let Simplified { from, to, moved } = simplify(&mut model, 20_000).expect("too dense");
        assert!(from == 2 * n * n && to <= 20_000 && to > 3_000, "{from} {to}");
        let part = &model.parts[0];
        assert!(part.positions.iter().all(|p| f64::from((p.length() - 1.0).abs()) <= moved));
        let volume: f32 = part
            .triangles
            .iter()
            .map(|t| {
                let [a, b, c] = t.map(|v| part.positions[v as usize]);
                a.dot(b.cross(c)) / 6.0
            })
            .sum();
        assert!((volume.abs() / (4.0 / 3.0 * std::f32::consts::PI) - 1.0).abs() < 0.05, "{volume}");
        let mut again = whole;
        simplify(&mut again, 20_000);
        assert_eq!(again, model);
    }
}
