//! A bottom as surveyed or drawn: heights from a file.

use serde::{Deserialize, Serialize};

use super::raster::{Raster, Unit};
use super::{HeightGrid, SeabedError, not_negative};

/// Heights from a PNG, EXR or CSV file, whose middle square is stretched over the seabed; its first row lies in the north.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HeightMap {
    /// The file, from the recipe's folder.
    pub file: String,
    /// Height of white above black in a PNG, metres. Of an EXR or CSV file, which are in metres, from the lowest to the
    /// highest; as in the file without.
    pub height_m: Option<f64>,
}

impl HeightMap {
    pub(super) fn check(&self) -> Result<(), SeabedError> {
        self.height_m.map_or(Ok(()), |height| not_negative("height_m", height))
    }

    /// Whether the file's numbers can be turned into metres.
    pub(super) fn check_map(&self, raster: &Raster) -> Result<(), SeabedError> {
        match (raster.unit, self.height_m) {
            (Unit::Brightness, None) => Err(SeabedError::File {
                path: self.file.clone().into(),
                problem: "is a picture, which has no metres: write `height_m`, the height of white above black".into(),
            }),
            _ => Ok(()),
        }
    }

    /// Adds the map to a grid, smooth between its numbers.
    pub(super) fn raise(&self, grid: &mut HeightGrid, raster: &Raster) {
        let (low, high) = raster.values.iter().fold((f32::MAX, f32::MIN), |(l, h), &v| (l.min(v), h.max(v)));
        let scale = match (raster.unit, self.height_m) {
            (Unit::Metre, None) => 1.0,
            (Unit::Metre, Some(height)) if high > low => height / (f64::from(high) - f64::from(low)),
            (Unit::Brightness, Some(height)) => height,
            _ => 0.0,
        };
        let (extent, steps) = (grid.extent(), (raster.width.min(raster.height) - 1) as f64);
        let place = |coordinate: f64, side: usize| 0.5 * (side - 1) as f64 + steps * coordinate / extent;
        grid.add(|x, y| scale * smooth(raster, place(x, raster.width), place(-y, raster.height)));
    }
}

/// The map between its numbers, through every one of them.
///
/// Source: Catmull & Rom (1974), A class of local interpolating splines.
fn smooth(raster: &Raster, column: f64, row: f64) -> f64 {
    let (i, across) = weights(column, raster.width);
    let (j, down) = weights(row, raster.height);
    let at = |i: i64, j: i64| {
        let (i, j) = (i.clamp(0, raster.width as i64 - 1), j.clamp(0, raster.height as i64 - 1));
        f64::from(raster.values[j as usize * raster.width + i as usize])
    };
    let line = |j: i64| across.iter().zip(i - 1..).map(|(weight, i)| weight * at(i, j)).sum::<f64>();
    down.iter().zip(j - 1..).map(|(weight, j)| weight * line(j)).sum()
}

/// The number at or below a place, and the weights of it, the one before it and the two after it.
fn weights(place: f64, side: usize) -> (i64, [f64; 4]) {
    let cell = place.floor().clamp(0.0, side as f64 - 2.0);
    let t = (place - cell).clamp(0.0, 1.0);
    let (t2, t3) = (t * t, t * t * t);
    let weights =
        [-t + 2.0 * t2 - t3, 2.0 - 5.0 * t2 + 3.0 * t3, t + 4.0 * t2 - 3.0 * t3, t3 - t2].map(|weight| 0.5 * weight);
    (cell as i64, weights)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_map_lies_north_up_and_goes_through_its_numbers() {
        let values = vec![0.0, 1.0, 2.0, 5.0, 4.0, 3.0, 7.0, 6.0, 9.0];
        let raster = Raster { width: 3, height: 3, values, unit: Unit::Metre };
        let map = HeightMap { file: "a.csv".into(), height_m: None };
        let mut grid = HeightGrid::flat(8.0, 0.1);
        map.raise(&mut grid, &raster);
        for ((x, y), height) in [((-4.0, 4.0), 0.0), ((4.0, 4.0), 2.0), ((0.0, 0.0), 4.0), ((4.0, -4.0), 9.0)] {
            assert!((grid.height(x, y) - height).abs() < 1e-6, "({x}, {y}): {}", grid.height(x, y));
        }
        let mut grid = HeightGrid::flat(8.0, 0.1);
        HeightMap { height_m: Some(0.9), ..map.clone() }.raise(&mut grid, &raster);
        assert!((grid.height(4.0, -4.0) - 0.9).abs() < 1e-6);
        let picture = Raster { unit: Unit::Brightness, ..raster };
        assert!(map.check_map(&picture).expect_err("no metres").to_string().contains("height_m"));
    }
}
