//! Room for things beside each other, and how they lie where nobody says so.

use std::f64::consts::PI;

/// Part of the ground that things may cover where they are scattered: with more, places are found late.
const COVER: f64 = 0.35;
/// Water beside a thing, metres.
const BETWEEN_M: f64 = 0.3;
/// Part of a heap's ground that its things cover, one on another: they lie two or three high.
const HEAP_COVER: f64 = 1.6;
/// From thing to thing in a row, in their lengths.
const ROW_LENGTHS: f64 = 2.5;
/// Shares of the height that things are sunk where nobody says so.
pub const BURIAL: [f64; 2] = [0.0, 0.15];
/// How many there are of what is said in the plural.
pub const SEVERAL: [u32; 2] = [2, 4];

/// Part of its distance by which a single thing strays from the middle: it is not always in the same place of a picture.
const STRAY: f64 = 0.15;

/// The same of what lies in a heap or a row, and of fish in a school.
pub const IN_HEAP: [u32; 2] = [5, 8];
/// In a row.
pub const IN_ROW: [u32; 2] = [4, 5];
/// In a school.
pub const IN_SCHOOL: [u32; 2] = [8, 15];

/// Radius of the disc on which a single thing lies that is looked at from a distance, metres.
#[must_use]
pub fn stray_m(distance_m: f64) -> f64 {
    STRAY * distance_m
}

/// Radius of the disc on which things of these sizes and counts find places, metres.
#[must_use]
pub fn disc_m(things: impl Iterator<Item = (f64, u32)>) -> f64 {
    let covered: f64 = things
        .map(|(size, count)| {
            let side = size + BETWEEN_M;
            f64::from(count) * side * side
        })
        .sum();
    (covered / (COVER * PI)).sqrt()
}

/// Radius of a heap of so many things of a size, metres.
#[must_use]
pub fn heap_m(size_m: f64, count: u32) -> f64 {
    (f64::from(count.max(1)) * 0.25 * size_m * size_m / HEAP_COVER).sqrt().max(0.3 * size_m)
}

/// From thing to thing in a row, metres.
#[must_use]
pub fn spacing_m(size_m: f64) -> f64 {
    (ROW_LENGTHS * size_m).max(0.5)
}

/// Half the length of a row, metres.
#[must_use]
pub fn half_row_m(spacing_m: f64, count: u32) -> f64 {
    // The first stands in the middle, the next in turn to either side.
    f64::from(count / 2) * spacing_m
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn discs_hold_what_is_in_them() {
        let disc = disc_m([(1.04, 2), (1.84, 1)].into_iter());
        assert!((2.2..3.0).contains(&disc), "{disc}");
        assert!((disc_m([(0.7, 4)].into_iter()) - (4.0 / (COVER * PI)).sqrt()).abs() < 1e-12);
        assert_eq!(disc_m(std::iter::empty()), 0.0);
    }

    #[test]
    fn heaps_and_rows() {
        assert!((heap_m(0.64, 10) - 0.8).abs() < 1e-12);
        assert_eq!((spacing_m(2.0), half_row_m(2.0, 5), half_row_m(2.0, 1)), (5.0, 4.0, 0.0));
    }
}
