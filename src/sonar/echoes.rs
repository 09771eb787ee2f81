//! What comes back from a ping before water, noise and display: the truth that images and labels are made from.

use super::Grid;

/// Noise-free echo energy of one ping.
///
/// Energy is the dimensionless two-way power ratio at 1 m re source, without absorption:
/// `E = Σ pattern · μ · cos θ · dΩ / R²` (1/m²), summed over everything visible in a cell.
#[derive(Clone, Debug, PartialEq)]
pub struct Echoes {
    /// The cells.
    pub grid: Grid,
    /// Energy of each cell, from bodies and background together (`grid.len()` values, cell order).
    pub energy: Vec<f32>,
    /// The part of each cell's energy that labelled bodies gave: sorted by cell, then body, each pair once, energy > 0.
    pub bodies: Vec<BodyEcho>,
    /// Energy-weighted means, where asked for.
    pub detail: Option<Detail>,
}

/// One body's share of one cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyEcho {
    /// Cell number.
    pub cell: u32,
    /// Body number, from 1.
    pub body: u16,
    /// Energy, in the unit of [`Echoes::energy`].
    pub energy: f32,
}

/// Energy-weighted means of each cell (`grid.len()` values each; 0 where nothing echoes).
#[derive(Clone, Debug, PartialEq)]
pub struct Detail {
    /// Elevation angle in the sonar's frame, radians, up positive.
    pub elevation_rad: Vec<f32>,
    /// Angle of incidence from the surface normal, radians.
    pub incidence_rad: Vec<f32>,
    /// Index into the scene's materials, plus one, of the strongest contribution; 0 where nothing echoes.
    pub material: Vec<u16>,
}
