//! Side and cells of the seabed.

/// Largest cell, metres: a coarser bottom looks faceted from near.
const COARSEST_M: f64 = 0.08;
/// Cells over the smallest thing.
const CELLS_A_THING: f64 = 6.0;
/// Cells over a wave.
const CELLS_A_WAVE: f64 = 6.0;
/// Cells along a side, at most: 3 million triangles.
const MOST_CELLS: f64 = 1200.0;
/// The same where waves need them.
const MOST_CELLS_OF_WAVES: f64 = 3000.0;
/// Side from which cells are coarser outside of the middle, and that middle's side, metres.
const COARSER_FROM_M: f64 = 100.0;
const MIDDLE: f64 = 0.5;
/// Beyond what is seen, metres.
const MARGIN_M: f64 = 2.0;

/// Side of the square, whole metres: nothing of its edge is seen by what looks `reach_m` far from the middle.
#[must_use]
pub fn extent_m(reach_m: f64) -> f64 {
    (2.0 * (reach_m + MARGIN_M)).ceil()
}

/// Side of a cell, metres, from the smallest thing on it and the shortest wave in it.
#[must_use]
pub fn cell_m(extent_m: f64, smallest_m: Option<f64>, wave_m: Option<f64>) -> f64 {
    let of_thing = smallest_m.map_or(COARSEST_M, |size| size / CELLS_A_THING);
    let fine = of_thing.min(COARSEST_M).max(extent_m / MOST_CELLS);
    let of_wave = wave_m.map_or(fine, |wave| (wave / CELLS_A_WAVE).max(extent_m / MOST_CELLS_OF_WAVES));
    // Rounded up: a cell that is a little larger is never too many.
    (fine.min(of_wave) * 100.0).ceil() / 100.0
}

/// Side of the middle square of fine cells, metres, where the seabed is so wide that the rest may be coarser.
#[must_use]
pub fn fine_m(extent_m: f64) -> Option<f64> {
    (extent_m > COARSER_FROM_M).then(|| (MIDDLE * extent_m).ceil())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_bounded() {
        assert_eq!(extent_m(12.3), 29.0);
        assert_eq!(cell_m(29.0, Some(0.6), None), 0.08);
        assert_eq!(cell_m(29.0, Some(0.115), None), 0.03);
        assert_eq!(cell_m(200.0, Some(0.115), None), 0.17);
        assert_eq!(cell_m(200.0, Some(0.115), Some(0.4)), 0.07);
        assert_eq!((fine_m(60.0), fine_m(200.0)), (None, Some(100.0)));
    }
}
