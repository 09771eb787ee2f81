//! Four slanted beams that measure velocity: a Doppler log's Janus arrangement.
//!
//! Beams point to +x, +y, −x, −y, each tilted off the vertical axis by one angle. Adds no noise: `noise_gains` says what noise
//! in the beams becomes.

use crate::math::Impossible;
use crate::math::real::{cos, sin};

/// A Janus arrangement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Janus {
    sine: f64,
    cosine: f64,
}

impl Janus {
    /// Beams that lean by an angle (rad) off the vertical.
    ///
    /// # Errors
    /// Beams that are vertical or level: velocity could not be solved for.
    pub fn new(beam_angle_rad: f64) -> Result<Self, Impossible> {
        let problem = format!("{beam_angle_rad} rad gives beams that cannot tell all three components");
        let solvable = beam_angle_rad > 1e-6 && beam_angle_rad < std::f64::consts::FRAC_PI_2 - 1e-6;
        Impossible::unless(solvable, "beam_angle_rad", problem, "lean the beams by more than 0 and less than π/2")?;
        Ok(Self { sine: sin(beam_angle_rad), cosine: cos(beam_angle_rad) })
    }

    /// Velocity along each beam: `±v_x·sin + v_z·cos`, `±v_y·sin + v_z·cos`.
    ///
    /// Source: Potokar et al. (2022), HoloOcean, IEEE ICRA, eq. 4; Brokloff (1994), IEEE OCEANS III:378–383.
    #[must_use]
    pub fn beams(&self, [x, y, z]: [f64; 3]) -> [f64; 4] {
        let down = z * self.cosine;
        [x * self.sine + down, y * self.sine + down, -x * self.sine + down, -y * self.sine + down]
    }

    /// Velocity of least squares from the beams'. Source: pseudo-inverse of [`Self::beams`].
    #[must_use]
    pub fn velocity(&self, [a, b, c, d]: [f64; 4]) -> [f64; 3] {
        [(a - c) / (2.0 * self.sine), (b - d) / (2.0 * self.sine), (a + b + c + d) / (4.0 * self.cosine)]
    }

    /// Standard deviation of the components over that of a beam: horizontal `1/(√2·sin)`, vertical `1/(2·cos)`.
    ///
    /// Source: norms of the rows of [`Self::velocity`].
    #[must_use]
    pub fn noise_gains(&self) -> [f64; 2] {
        [std::f64::consts::FRAC_1_SQRT_2 / self.sine, 0.5 / self.cosine]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::real::radians;

    #[test]
    fn beams_turn_back_into_velocity() {
        let janus = Janus::new(radians(22.5)).unwrap();
        let velocity = [1.0, 0.2, -0.1];
        let beams = janus.beams(velocity);
        assert!((beams[0] - 0.290_295).abs() < 1e-6 && (beams[2] + 0.475_071).abs() < 1e-6);
        for (a, b) in janus.velocity(beams).into_iter().zip(velocity) {
            assert!((a - b).abs() < 1e-12);
        }
        assert!((janus.noise_gains()[0] - 1.8478).abs() < 1e-4);
        assert!(Janus::new(0.0).is_err() && Janus::new(f64::NAN).is_err());
    }
}
