//! Closed solids that structures are put together from: blocks, bars, round bars, tubes, boulders.
//!
//! Knows nothing of structures or materials. World frame, metres.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use crate::math::real::{cos, sin};

/// A closed surface, its triangles counter-clockwise seen from outside.
#[derive(Clone, Debug)]
pub(super) struct Solid {
    pub positions: Vec<DVec3>,
    pub triangles: Vec<[u32; 3]>,
}

impl Solid {
    /// A box along the axes of the world.
    pub fn block(low: DVec3, high: DVec3) -> Self {
        let y = (high.y - low.y).abs();
        let middle = 0.5 * (low + high);
        let (from, to) = (DVec3::new(low.x, middle.y, middle.z), DVec3::new(high.x, middle.y, middle.z));
        Self::bar(from, to, [y, (high.z - low.z).abs()])
    }

    /// A rectangular bar between two points: its width is level, its height across that.
    pub fn bar(from: DVec3, to: DVec3, [width, height]: [f64; 2]) -> Self {
        let (w, h) = (0.5 * width, 0.5 * height);
        Self::prism(from, to, &[DVec2::new(-w, -h), DVec2::new(w, -h), DVec2::new(w, h), DVec2::new(-w, h)])
    }

    /// A round bar between two points.
    pub fn rod(from: DVec3, to: DVec3, radius: f64, sides: u32) -> Self {
        let corner = |k: u32| TAU * f64::from(k) / f64::from(sides);
        let section: Vec<DVec2> = (0..sides).map(|k| radius * DVec2::new(cos(corner(k)), sin(corner(k)))).collect();
        Self::prism(from, to, &section)
    }

    /// A pipe that is open at both ends.
    pub fn tube(from: DVec3, to: DVec3, [inner, outer]: [f64; 2], sides: u32) -> Self {
        let frame = Frame::along(to - from);
        let mut positions = Vec::new();
        for (middle, radius) in [(from, outer), (to, outer), (to, inner), (from, inner)] {
            let corner = |k: u32| TAU * f64::from(k) / f64::from(sides);
            positions
                .extend((0..sides).map(|k| middle + frame.at(radius * DVec2::new(cos(corner(k)), sin(corner(k))))));
        }
        let mut triangles = Vec::new();
        for (ring, k) in (0..4).flat_map(|ring| (0..sides).map(move |k| (ring, k))) {
            let (here, there, next) = (ring * sides, (ring + 1) % 4 * sides, (k + 1) % sides);
            triangles.extend([[here + k, here + next, there + next], [here + k, there + next, there + k]]);
        }
        Self { positions, triangles }
    }

    /// A convex section, counter-clockwise seen against the way, carried from one point to another.
    fn prism(from: DVec3, to: DVec3, section: &[DVec2]) -> Self {
        let frame = Frame::along(to - from);
        let n = section.len() as u32;
        let frame = &frame;
        let positions = [from, to].into_iter().flat_map(|end| section.iter().map(move |&p| end + frame.at(p)));
        let sides = (0..n).map(|k| (k, (k + 1) % n)).flat_map(|(k, next)| [[k, next, n + next], [k, n + next, n + k]]);
        let ends = (1..n - 1).flat_map(|k| [[0, k + 1, k], [n, n + k, n + k + 1]]);
        Self { positions: positions.collect(), triangles: sides.chain(ends).collect() }
    }

    /// A ring of round bar about a vertical line.
    pub fn hoop(middle: DVec3, radius: f64, thickness: f64, [around, sides]: [u32; 2]) -> Self {
        let angle = |k: u32, of: u32| TAU * f64::from(k) / f64::from(of);
        let mut positions = Vec::new();
        for (i, j) in (0..around).flat_map(|i| (0..sides).map(move |j| (i, j))) {
            let (a, b) = (angle(i, around), angle(j, sides));
            let out = radius + 0.5 * thickness * cos(b);
            positions.push(middle + DVec3::new(out * cos(a), out * sin(a), 0.5 * thickness * sin(b)));
        }
        let mut triangles = Vec::new();
        for (i, j) in (0..around).flat_map(|i| (0..sides).map(move |j| (i, j))) {
            let (here, there, next) = (i * sides, (i + 1) % around * sides, (j + 1) % sides);
            triangles.extend([[here + j, there + j, there + next], [here + j, there + next, here + next]]);
        }
        Self { positions, triangles }
    }

    /// Enclosed volume, cubic metres; negative if it faces inwards.
    #[cfg(test)]
    pub fn volume(&self) -> f64 {
        let corner = |v: u32| self.positions[v as usize];
        self.triangles.iter().map(|&[a, b, c]| corner(a).dot(corner(b).cross(corner(c)))).sum::<f64>() / 6.0
    }
}

/// Two directions across a way, the first level.
struct Frame {
    level: DVec3,
    up: DVec3,
}

impl Frame {
    fn along(way: DVec3) -> Self {
        let along = way.normalize();
        let level = DVec3::new(-along.y, along.x, 0.0).try_normalize().unwrap_or(DVec3::Y);
        Self { level, up: along.cross(level) }
    }

    fn at(&self, p: DVec2) -> DVec3 {
        self.level * p.x + self.up * p.y
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;

    #[test]
    fn every_solid_is_closed_and_faces_outwards() {
        let (a, b) = (DVec3::new(1.0, -2.0, 0.5), DVec3::new(2.0, 1.0, 3.0));
        let length = (b - a).length();
        let ring = TAU / 2.0;
        for (name, solid, volume) in [
            ("block", Solid::block(a, b), 1.0 * 3.0 * 2.5),
            ("bar", Solid::bar(a, b, [0.2, 0.5]), 0.1 * length),
            ("upright bar", Solid::bar(DVec3::ZERO, DVec3::Z, [0.2, 0.5]), 0.1),
            ("rod", Solid::rod(b, a, 0.3, 64), ring * 0.09 * length),
            ("tube", Solid::tube(a, b, [0.2, 0.3], 64), ring * (0.09 - 0.04) * length),
            ("hoop", Solid::hoop(a, 3.0, 0.4, [64, 32]), TAU * 3.0 * ring * 0.04),
        ] {
            assert!((solid.volume() / volume - 1.0).abs() < 0.01, "{name}: {} for {volume}", solid.volume());
            let mut edges: BTreeMap<(u32, u32), u32> = BTreeMap::new();
            for [a, b, c] in &solid.triangles {
                [(a, b), (b, c), (c, a)].iter().for_each(|(a, b)| *edges.entry((**a, **b)).or_default() += 1);
            }
            let closed = edges.iter().all(|(&(a, b), &count)| count == 1 && edges.contains_key(&(b, a)));
            assert!(closed, "{name} is not closed");
        }
    }
}
