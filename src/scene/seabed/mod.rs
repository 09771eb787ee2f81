//! Seabeds: a height field of a kind, the grid it is sampled on, and the mesh of that grid.
//!
//! Knows nothing of objects. What stands on the bottom asks [`HeightGrid`], which answers with the very surface that
//! the mesh shows, not with the smooth field behind it.

mod flat;
mod fractal;
mod grid;
mod height_map;
mod noise;
mod patches;
mod pipeline_trench;
mod raster;
mod reef;
mod ripples;
mod rock_field;
mod rubble;
mod sand_waves;
mod slope;
mod stones;
mod tiles;
mod trench;

use std::path::PathBuf;
use std::sync::Arc;

use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::assets::AssetCache;
use crate::catalog::materials;
use crate::math::rng::Stream;

pub use flat::Flat;
pub use fractal::Fractal;
pub use grid::HeightGrid;
pub use height_map::HeightMap;
pub use patches::{Gathering, Patch};
pub use pipeline_trench::PipelineTrench;
pub use raster::Raster;
pub use reef::Reef;
pub use ripples::Ripples;
pub use rock_field::RockField;
pub use rubble::Rubble;
pub use sand_waves::SandWaves;
pub use slope::Slope;
pub use trench::Trench;

/// Most triangles of one seabed in cells of `cell_m`: 300 MB of mesh.
const MAX_TRIANGLES: f64 = 2e7;

/// A square of seabed centred at the world's origin.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SeabedSpec {
    /// What it is shaped like.
    pub shape: Shape,
    /// Name of a sediment.
    pub sediment: String,
    /// Side of the square, metres.
    pub extent_m: f64,
    /// Side of a cell of two triangles, metres.
    pub cell_m: f64,
    /// Side of the middle square that is shown in these cells, metres; beyond it cells grow with the distance, up to
    /// sixteenfold. Without it all cells are alike.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fine_m: Option<f64>,
    /// Other sediments on parts of it, each on those before it.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub patches: Vec<Patch>,
}

/// Kinds of seabed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Shape {
    /// A plane.
    Flat(Flat),
    /// Hills on hills: a power-law spectrum.
    Fractal(Fractal),
    /// Sand ripples with wandering crests.
    Ripples(Ripples),
    /// An even rise.
    Slope(Slope),
    /// Dunes with ripples on them.
    SandWaves(SandWaves),
    /// Boulders on softer ground.
    RockField(RockField),
    /// Cobbles side by side.
    Rubble(Rubble),
    /// Ledges and coral heads in sand.
    Reef(Reef),
    /// Dredge marks.
    Trench(Trench),
    /// A trench for a pipeline.
    PipelineTrench(PipelineTrench),
    /// Heights from a file.
    HeightMap(HeightMap),
}

/// A seabed that cannot be built.
#[derive(Debug, Error, PartialEq)]
pub enum SeabedError {
    /// A length that must be positive, or a share beyond its range.
    #[error("seabed: {name} is {value}, which is not {range}")]
    Range {
        /// The parameter.
        name: &'static str,
        /// What it is.
        value: f64,
        /// What it may be.
        range: &'static str,
    },
    /// More triangles than one seabed may have.
    #[error(
        "seabed: {extent_m} m in cells of {cell_m} m are {triangles:.1e} triangles, more than 2e7; \
         take cells of {enough_m:.3} m or a smaller extent_m"
    )]
    TooFine {
        /// Side of the square.
        extent_m: f64,
        /// Side of a cell.
        cell_m: f64,
        /// How many triangles that makes.
        triangles: f64,
        /// Cells that would do.
        enough_m: f64,
    },
    /// A shape with waves that the cells cannot show.
    #[error("seabed: {name} is {wave_m} m, which cells of {cell_m} m cannot show; take cell_m {enough_m:.3} or less")]
    TooCoarse {
        /// The parameter.
        name: &'static str,
        /// The wave.
        wave_m: f64,
        /// Side of a cell.
        cell_m: f64,
        /// Cells that would do.
        enough_m: f64,
    },
    /// A sediment that no table has.
    #[error("seabed: {0}")]
    Sediment(String),
    /// A height map that cannot be used.
    #[error("{path} {problem}", path = path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// What is wrong with it, reading on from its name, and the remedy.
        problem: String,
    },
}

impl SeabedSpec {
    /// Whether it can be built, height maps read included; [`SeabedSpec::build`] fails with the same errors.
    ///
    /// # Errors
    /// See [`SeabedError`].
    pub fn check(&self, assets: &AssetCache) -> Result<(), SeabedError> {
        positive("extent_m", self.extent_m)?;
        positive("cell_m", self.cell_m)?;
        sediment(&self.sediment)?;
        self.fine_m.map_or(Ok(()), |fine| positive("fine_m", fine))?;
        self.patches.iter().try_for_each(|patch| patch.check(self.cell_m))?;
        let triangles = 2.0 * (self.extent_m / self.cell_m) * (self.extent_m / self.cell_m);
        if triangles > MAX_TRIANGLES {
            let (extent_m, cell_m) = (self.extent_m, self.cell_m);
            let enough_m = extent_m / (MAX_TRIANGLES / 2.0).sqrt();
            return Err(SeabedError::TooFine { extent_m, cell_m, triangles, enough_m });
        }
        self.shape.check(self.cell_m)?;
        self.raster(assets).map(|_| ())
    }

    /// Samples the shape: heights of mean 0. The same stream and files give the same bits.
    ///
    /// # Errors
    /// See [`SeabedError`].
    pub fn build(&self, assets: &AssetCache, stream: &mut Stream) -> Result<HeightGrid, SeabedError> {
        self.check(assets)?;
        let mut grid = HeightGrid::flat(self.extent_m, self.cell_m);
        grid.sediments[0].clone_from(&self.sediment);
        match &self.shape {
            Shape::Flat(flat) => flat.raise(&mut grid),
            Shape::Fractal(fractal) => fractal.raise(&mut grid, stream),
            Shape::Ripples(ripples) => ripples.raise(&mut grid, stream),
            Shape::Slope(slope) => slope.raise(&mut grid, stream),
            Shape::SandWaves(waves) => waves.raise(&mut grid, stream),
            Shape::RockField(rocks) => rocks.raise(&mut grid, stream),
            Shape::Rubble(rubble) => rubble.raise(&mut grid, stream),
            Shape::Reef(reef) => reef.raise(&mut grid, stream),
            Shape::Trench(trench) => trench.raise(&mut grid, stream),
            Shape::PipelineTrench(trench) => trench.raise(&mut grid, stream),
            Shape::HeightMap(map) => self.raster(assets)?.iter().for_each(|raster| map.raise(&mut grid, raster)),
        }
        grid.subtract_mean();
        self.patches.iter().for_each(|patch| patch.cover(&mut grid, stream));
        self.fine_m.iter().for_each(|&fine| grid.coarsen(fine));
        Ok(grid)
    }

    /// File of its height map, from the recipe's folder.
    #[must_use]
    pub fn file(&self) -> Option<&str> {
        if let Shape::HeightMap(map) = &self.shape { Some(&map.file) } else { None }
    }

    fn raster(&self, assets: &AssetCache) -> Result<Option<Arc<Raster>>, SeabedError> {
        let Shape::HeightMap(map) = &self.shape else { return Ok(None) };
        let raster = assets.raster(&map.file)?;
        map.check_map(&raster)?;
        Ok(Some(raster))
    }
}

impl Shape {
    fn check(&self, cell_m: f64) -> Result<(), SeabedError> {
        match self {
            Self::Flat(flat) => flat.check(),
            Self::Fractal(fractal) => fractal.check(cell_m),
            Self::Ripples(ripples) => ripples.check(cell_m),
            Self::Slope(slope) => slope.check(cell_m),
            Self::SandWaves(waves) => waves.check(cell_m),
            Self::RockField(rocks) => rocks.check(cell_m),
            Self::Rubble(rubble) => rubble.check(cell_m),
            Self::Reef(reef) => reef.check(cell_m),
            Self::Trench(trench) => trench.check(cell_m),
            Self::PipelineTrench(trench) => trench.check(cell_m),
            Self::HeightMap(map) => map.check(),
        }
    }
}

fn sediment(name: &str) -> Result<(), SeabedError> {
    materials::sediment(name).map(|_| ()).map_err(|fault| SeabedError::Sediment(fault.to_string()))
}

fn within(name: &'static str, value: f64, [low, high]: [f64; 2], range: &'static str) -> Result<(), SeabedError> {
    let fine = value.is_finite() && (low..=high).contains(&value);
    if fine { Ok(()) } else { Err(SeabedError::Range { name, value, range }) }
}

fn direction(name: &'static str, value: f64) -> Result<(), SeabedError> {
    within(name, value, [f64::MIN, f64::MAX], "a number")
}

/// Smallest and largest, the smallest of at least `cells` cells.
fn sizes(name: &'static str, [small, large]: [f64; 2], cell_m: f64, cells: f64) -> Result<(), SeabedError> {
    positive(name, small)?;
    within(name, large, [small, f64::MAX], "[smallest, largest]")?;
    shown(name, small, cell_m, cells)
}

fn positive(name: &'static str, value: f64) -> Result<(), SeabedError> {
    let fine = value.is_finite() && value > 0.0;
    if fine { Ok(()) } else { Err(SeabedError::Range { name, value, range: "above 0" }) }
}

fn not_negative(name: &'static str, value: f64) -> Result<(), SeabedError> {
    let fine = value.is_finite() && value >= 0.0;
    if fine { Ok(()) } else { Err(SeabedError::Range { name, value, range: "0 or more" }) }
}

/// A wave needs `cells` cells to be seen.
fn shown(name: &'static str, wave_m: f64, cell_m: f64, cells: f64) -> Result<(), SeabedError> {
    let enough_m = wave_m / cells;
    if cell_m > enough_m * (1.0 + 1e-9) {
        return Err(SeabedError::TooCoarse { name, wave_m, cell_m, enough_m });
    }
    Ok(())
}

#[cfg(test)]
mod tests;
