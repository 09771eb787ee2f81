//! What comes back from a ping before water, noise and display: the truth that images and labels are made from.

use super::Grid;

/// Noise-free echo energy of one ping.
///
/// Energy is the two-way power ratio re the source at 1 m, without absorption:
/// `E = Σ pattern · f(cos θ) · dΩ / R²` (1/m²), summed over everything visible in a cell, with `f` the surface's
/// backscatter (`μ·cos θ` and the specular lobe, see [`super::surface::backscatter`]).
#[derive(Clone, Debug, PartialEq)]
pub struct Echoes {
    /// The cells.
    pub grid: Grid,
    /// Energy of each cell, from bodies and background together (`grid.len()` values, cell order).
    pub energy: Vec<f32>,
    /// Solid angle through which open water is seen in each cell, weighted by the two-way vertical pattern, sr: what
    /// volume reverberation is made from. Shadows have none.
    pub water: Vec<f32>,
    /// Energy of echoes that came by a mirror (sea surface, smooth bottom), where the scene has one. Images show it,
    /// labels do not count it.
    pub ghosts: Option<Vec<f32>>,
    /// The part of each cell's energy that labelled bodies gave: sorted by cell, then body, each pair once, energy > 0.
    pub bodies: Vec<BodyEcho>,
    /// Energy-weighted means, where asked for.
    pub detail: Option<Detail>,
    /// Counts of rays, where asked for.
    pub rays: Option<Rays>,
}

impl Echoes {
    /// A ping that met nothing, in clear water that nothing was traced through.
    #[must_use]
    pub fn silence(grid: Grid) -> Self {
        let zeros = || vec![0.0; grid.len()];
        Self { grid, energy: zeros(), water: zeros(), ghosts: None, bodies: Vec::new(), detail: None, rays: None }
    }
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

/// The samples of a ping as rays, for models that average over rays (`grid.len()` values each).
///
/// A ray stands for the surface up to its neighbours' and counts in every range bin that this spans by its part, and in two
/// neighbouring beams where bearing is a cone angle: what many thin rays would give, without holes where rays are few.
#[derive(Clone, Debug, PartialEq)]
pub struct Rays {
    /// Rays that met a surface in the cell.
    pub count: Vec<f32>,
    /// Sum of their ρ·cos θ: reflectivity of the surface times cosine of incidence.
    pub reflected: Vec<f32>,
}

/// The range by which rays are sorted into bins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RayRange {
    /// Slant range, as everything else in a ping.
    Slant,
    /// Range in the sonar's own horizontal plane, `√(x² + y²)` in its frame.
    Horizontal,
}

impl Rays {
    /// No rays.
    #[must_use]
    pub fn none(cells: usize) -> Self {
        Self { count: vec![0.0; cells], reflected: vec![0.0; cells] }
    }

    /// Mean ρ·cos θ of each cell; 0 where no ray met a surface.
    #[must_use]
    pub fn mean(&self) -> Vec<f32> {
        let cells = self.reflected.iter().zip(&self.count);
        cells.map(|(&sum, &count)| if count > 0.0 { sum / count } else { 0.0 }).collect()
    }
}
