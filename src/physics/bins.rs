//! Where a sphere shows in an image: its ranges, its bearings, and the bins that they fall into.
//!
//! Axes: x forward, y to port, z up; bearing positive to port. Casts no rays.

use crate::math::Impossible;
use crate::math::real::{asin, atan2};

/// Ranges and angles of a sphere, as a sonar at the origin sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SphereView {
    /// Slant range of the centre, m.
    pub centre_m: f64,
    /// Slant range of the first return, m.
    pub first_m: f64,
    /// Slant range of the limb, where lines of sight touch the sphere, m.
    pub limb_m: f64,
    /// Azimuth of the centre, `atan2(y, x)`, rad.
    pub azimuth_rad: f64,
    /// Angle that a horizontal line array measures, `asin(y/|C|)`, rad: the cone angle.
    pub cone_rad: f64,
    /// Elevation of the centre, `asin(z/|C|)`, rad.
    pub elevation_rad: f64,
    /// Half the angle that the sphere covers, `asin(a/|C|)`, rad.
    pub half_extent_rad: f64,
}

impl SphereView {
    /// The view of a sphere, centre and radius in m. Source: solid geometry.
    ///
    /// # Errors
    /// A sphere that holds the sonar, or has no positive radius.
    pub fn new(centre: [f64; 3], radius_m: f64) -> Result<Self, Impossible> {
        let [x, y, z] = centre;
        let centre_m = (x * x + y * y + z * z).sqrt();
        let problem = format!("{radius_m} m is no radius of a sphere whose centre is {centre_m} m away");
        let outside = radius_m > 0.0 && radius_m < centre_m;
        Impossible::unless(outside, "radius_m", problem, "keep the sonar outside of the sphere")?;
        Ok(Self {
            centre_m,
            first_m: centre_m - radius_m,
            limb_m: (centre_m * centre_m - radius_m * radius_m).sqrt(),
            azimuth_rad: atan2(y, x),
            cone_rad: asin(y / centre_m),
            elevation_rad: asin(z / centre_m),
            half_extent_rad: asin(radius_m / centre_m),
        })
    }
}

/// The bin of `low..high`, divided in `count`, that holds a value: `floor((v − low)·count/(high − low))`; none outside.
///
/// Source: definition of an even grid.
#[must_use]
pub fn bin(value: f64, [low, high]: [f64; 2], count: u32) -> Option<u32> {
    let position = ((value - low) * f64::from(count) / (high - low)).floor();
    (0.0..f64::from(count)).contains(&position).then_some(position as u32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::real::{degrees, radians};

    #[test]
    fn a_line_array_hears_a_sphere_nearer_to_ahead_than_it_lies() {
        let view = SphereView::new([6.0, 2.0, -1.0], 0.3).unwrap();
        assert!((view.first_m - 6.103_124).abs() < 1e-6 && (view.limb_m - 6.396_093).abs() < 1e-6);
        assert!((degrees(view.azimuth_rad) - 18.4349).abs() < 1e-4);
        assert!((degrees(view.cone_rad) - 18.2008).abs() < 1e-4);
        let field = [-radians(65.0), radians(65.0)];
        assert_eq!([view.azimuth_rad, view.cone_rad].map(|angle| bin(angle, field, 512)), [Some(328), Some(327)]);
        assert!(SphereView::new([0.1, 0.0, 0.0], 0.3).is_err());
    }

    #[test]
    fn bins_end_before_the_far_edge() {
        assert_eq!(bin(0.1, [0.1, 10.0], 1000), Some(0));
        assert_eq!(bin(10.0, [0.1, 10.0], 1000), None);
        assert_eq!(bin(0.0, [0.1, 10.0], 1000), None);
        assert_eq!(bin(f64::NAN, [0.1, 10.0], 1000), None);
    }
}
