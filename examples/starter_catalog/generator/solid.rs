//! Closed triangle surfaces and the moves that keep them closed.
//!
//! Knows nothing of objects, materials or files. Modelling frame: x right, y back, z up, metres.

use ensonify::math::real::{cos, radians, sin};
use glam::{DMat3, DVec3};

/// A closed surface: every edge belongs to two triangles that run along it in opposite directions.
#[derive(Clone, Debug)]
pub struct Solid {
    /// Vertices, each used by all triangles that meet there.
    pub positions: Vec<DVec3>,
    /// Three vertex numbers a triangle, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
}

/// An axis of the modelling frame.
#[derive(Clone, Copy, Debug)]
pub enum Axis {
    X,
    Y,
    Z,
}

impl Solid {
    /// The surface with its triangles turned so that it encloses a positive volume.
    #[must_use]
    pub fn outward(positions: Vec<DVec3>, triangles: Vec<[u32; 3]>) -> Self {
        let mut solid = Self { positions, triangles };
        if solid.volume() < 0.0 {
            solid.triangles.iter_mut().for_each(|t| t.swap(1, 2));
        }
        solid
    }

    /// Every vertex sent through `map`, which must not turn the surface inside out.
    #[must_use]
    pub fn mapped(mut self, map: impl Fn(DVec3) -> DVec3) -> Self {
        self.positions.iter_mut().for_each(|p| *p = map(*p));
        self
    }

    /// Shifted by (x, y, z) metres.
    #[must_use]
    pub fn at(self, x: f64, y: f64, z: f64) -> Self {
        self.mapped(|p| p + DVec3::new(x, y, z))
    }

    /// Turned about an axis through the origin, right-hand rule, degrees.
    #[must_use]
    pub fn turned(self, axis: Axis, degrees: f64) -> Self {
        let turn = turn(axis, degrees);
        self.mapped(|p| turn * p)
    }

    /// Turned so that its z axis points along `direction`, then shifted to `place`.
    #[must_use]
    pub fn aimed(self, direction: DVec3, place: DVec3) -> Self {
        let z = direction.normalize();
        let x = across(z);
        let turn = DMat3::from_cols(x, z.cross(x), z);
        self.mapped(|p| turn * p + place)
    }

    /// `count` copies spread evenly about the z axis, the first where it is.
    #[must_use]
    pub fn around(&self, count: usize) -> Vec<Self> {
        (0..count).map(|i| self.clone().turned(Axis::Z, 360.0 * i as f64 / count as f64)).collect()
    }

    /// This and its mirror image in the plane across `axis`.
    #[must_use]
    pub fn mirrored(self, axis: Axis) -> [Self; 2] {
        let flip = match axis {
            Axis::X => DVec3::new(-1.0, 1.0, 1.0),
            Axis::Y => DVec3::new(1.0, -1.0, 1.0),
            Axis::Z => DVec3::new(1.0, 1.0, -1.0),
        };
        let image = Self::outward(self.positions.iter().map(|&p| p * flip).collect(), self.triangles.clone());
        [self, image]
    }

    /// Enclosed volume, cubic metres; negative if the triangles face inwards.
    fn volume(&self) -> f64 {
        let corner = |v: u32| self.positions[v as usize];
        self.triangles.iter().map(|&[a, b, c]| corner(a).dot(corner(b).cross(corner(c)))).sum::<f64>() / 6.0
    }
}

/// The rotation about an axis, right-hand rule, degrees.
#[must_use]
pub fn turn(axis: Axis, degrees: f64) -> DMat3 {
    let (s, c) = (sin(radians(degrees)), cos(radians(degrees)));
    match axis {
        Axis::X => DMat3::from_cols(DVec3::X, DVec3::new(0.0, c, s), DVec3::new(0.0, -s, c)),
        Axis::Y => DMat3::from_cols(DVec3::new(c, 0.0, -s), DVec3::Y, DVec3::new(s, 0.0, c)),
        Axis::Z => DMat3::from_cols(DVec3::new(c, s, 0.0), DVec3::new(-s, c, 0.0), DVec3::Z),
    }
}

/// A unit vector at right angles to `direction`.
#[must_use]
pub fn across(direction: DVec3) -> DVec3 {
    let far = if direction.z.abs() < 0.9 * direction.length() { DVec3::Z } else { DVec3::X };
    far.cross(direction).normalize()
}
