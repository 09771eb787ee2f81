//! Patches of another sediment: mud in troughs, gravel on crests, beds at random places.

use serde::{Deserialize, Serialize};

use super::noise::Noise;
use super::{HeightGrid, SeabedError, positive, sediment, shown, within};
use crate::math::rng::Stream;

/// A sediment on part of the seabed. Later patches lie on earlier ones.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Patch {
    /// Name of the sediment.
    pub sediment: String,
    /// Where it gathers.
    #[serde(rename = "where")]
    pub place: Gathering,
    /// Part of the area that it covers, 0 to 1; met exactly.
    pub share: f64,
    /// Across a patch, metres. In troughs and on crests: the width over which a place is compared with its surroundings,
    /// about the wavelength of what is to be filled.
    pub size_m: f64,
}

/// Where a sediment gathers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Gathering {
    /// In beds at random places.
    Random,
    /// Where the bottom lies lower than about it.
    Troughs,
    /// Where the bottom stands higher than about it.
    Crests,
}

impl Patch {
    pub(super) fn check(&self, cell_m: f64) -> Result<(), SeabedError> {
        sediment(&self.sediment)?;
        within("patches: share", self.share, [0.0, 1.0], "0 to 1")?;
        positive("patches: size_m", self.size_m)?;
        shown("patches: size_m", self.size_m, cell_m, 1.0)
    }

    /// Covers its share of the grid's cells.
    pub(super) fn cover(&self, grid: &mut HeightGrid, stream: &mut Stream) {
        let score = match self.place {
            Gathering::Random => self.beds(grid, stream),
            Gathering::Troughs => grid.relief(0.5 * self.size_m).into_iter().map(|height| -height).collect(),
            Gathering::Crests => grid.relief(0.5 * self.size_m),
        };
        let mut order = score.clone();
        let wanted = (self.share * score.len() as f64).round() as usize;
        if wanted == 0 {
            return;
        }
        let (_, &mut least, _) = order.select_nth_unstable_by(wanted - 1, |a, b| b.total_cmp(a));
        // Equal scores, as on a level bottom, would cover more than was asked: those go by their order.
        let mut equal = wanted - score.iter().filter(|&&value| value > least).count();
        grid.paint_cells(&self.sediment, |cell| {
            let takes = score[cell] > least || (score[cell] == least && equal > 0);
            equal -= usize::from(takes && score[cell] == least);
            takes
        });
    }

    /// Smooth noise with frayed edges, a number a cell.
    fn beds(&self, grid: &HeightGrid, stream: &mut Stream) -> Vec<f32> {
        let beds = Noise::new(2.0 * self.size_m, grid.reach(), stream);
        let edges = Noise::new((0.3 * self.size_m).max(2.0 * grid.cell()), grid.reach(), stream);
        grid.of_cells(|x, y| (beds.at(x, y) + 0.25 * edges.at(x, y)) as f32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn covered(place: Gathering) -> HeightGrid {
        let mut grid = HeightGrid::flat(12.0, 0.1);
        grid.add(|x, _| 0.05 * crate::math::real::sin(std::f64::consts::TAU * x / 1.5));
        let patch = Patch { sediment: "mud".into(), place, share: 0.3, size_m: 1.5 };
        patch.cover(&mut grid, &mut Stream::at(1, "test", 0, "patches"));
        grid
    }

    #[test]
    fn a_patch_covers_its_share_where_it_belongs() {
        for (place, low, high) in
            [(Gathering::Troughs, -0.06, -0.02), (Gathering::Crests, 0.02, 0.06), (Gathering::Random, -0.012, 0.012)]
        {
            let mesh = covered(place).mesh();
            assert_eq!(mesh.materials[1], "mud");
            let (mut area, mut height) = (0.0, 0.0);
            let of_mud = mesh.clusters.iter().filter(|cluster| cluster.material == 1);
            for [a, b, c] in of_mud.flat_map(|k| k.triangles.iter().map(|t| t.map(|v| k.vertex(v.into())))) {
                let plan = 0.5 * f64::from((b - a).cross(c - a).z);
                (area, height) = (area + plan, height + plan * f64::from((a.z + b.z + c.z) / 3.0));
            }
            assert!((area - 0.3 * 144.0).abs() < 0.01, "{place:?}: {area} m²");
            assert!((low..high).contains(&(height / area)), "{place:?}: {}", height / area);
        }
        let mut level = HeightGrid::flat(10.0, 0.5);
        let patch = Patch { sediment: "mud".into(), place: Gathering::Troughs, share: 0.25, size_m: 2.0 };
        patch.cover(&mut level, &mut Stream::at(1, "test", 0, "patches"));
        let of_mud = level.mesh().clusters.iter().filter(|c| c.material == 1).map(|c| c.triangles.len()).sum::<usize>();
        assert_eq!(of_mud, 200);
    }
}
