//! Line arrays: beam patterns of weighted elements, and what is read off them.
//!
//! Directions are differences of sines, u = sin θ − sin θₛ: there the pattern is the same whatever the steering.

use super::numeric::crossing;
use super::shading::Shading;
use crate::math::Impossible;
use crate::math::real::{asin, cos, db_from_power, sin};

/// A line of like elements with symmetric weights.
#[derive(Clone, Debug, PartialEq)]
pub struct LineArray {
    weights: Vec<f64>,
    spacing_wavelengths: f64,
}

impl LineArray {
    /// An array of `elements`, their spacing in wavelengths.
    ///
    /// # Errors
    /// A spacing that is not positive, or what [`Shading::weights`] refuses.
    pub fn new(elements: u32, spacing_wavelengths: f64, shading: &Shading) -> Result<Self, Impossible> {
        Impossible::outside("spacing_wavelengths", spacing_wavelengths, 1e-3, 1e3)?;
        Ok(Self { weights: shading.weights(elements)?, spacing_wavelengths })
    }

    /// Array factor, 1 at u = 0: `Σ wₙ·cos((n − (N−1)/2)·ψ) / Σ wₙ`, ψ = 2π·(d/λ)·u. Real, as the weights are symmetric.
    ///
    /// Source: Van Trees (2002), Optimum Array Processing, ch. 2.
    #[must_use]
    pub fn factor(&self, u: f64) -> f64 {
        let phase = 2.0 * std::f64::consts::PI * self.spacing_wavelengths * u;
        let middle = 0.5 * (self.weights.len() as f64 - 1.0);
        let sum: f64 = self.weights.iter().enumerate().map(|(n, w)| w * cos((n as f64 - middle) * phase)).sum();
        sum / self.weights.iter().sum::<f64>()
    }

    /// Where the pattern first falls to half its power, in u; none for an array too short to fall that far.
    #[must_use]
    pub fn half_power_u(&self) -> Option<f64> {
        self.first(|factor| factor * factor < 0.5)
    }

    /// First null of the pattern, in u; none where it has none.
    #[must_use]
    pub fn first_null_u(&self) -> Option<f64> {
        self.first(|factor| factor <= 0.0)
    }

    /// −3 dB width of the one-way beam steered to an angle, both rad: `asin(sin θₛ + u₃) − asin(sin θₛ − u₃)`.
    /// None where the beam reaches beyond the end of the line.
    ///
    /// Source: Van Trees (2002), ch. 2; for long uniform arrays 0.886·λ/(N·d·cos θₛ).
    #[must_use]
    pub fn beam_width_rad(&self, steering_rad: f64) -> Option<f64> {
        let half = self.half_power_u()?;
        let middle = sin(steering_rad).abs();
        (middle + half <= 1.0).then(|| asin(middle + half) - asin(middle - half))
    }

    /// Greatest side lobe, dB relative to the main lobe, over one period of the pattern (grating lobes are no side lobes).
    /// None where there is no null.
    #[must_use]
    pub fn peak_side_lobe_db(&self) -> Option<f64> {
        let (null, step) = (self.first_null_u()?, self.step());
        let samples = ((self.half_period() - null) / step).floor() as u32;
        let size = |u: f64| self.factor(u).abs();
        let best = (0..=samples)
            .map(|i| null + f64::from(i) * step)
            .map(|u| (u, size(u)))
            .fold((null, 0.0), |best, here| if here.1 > best.1 { here } else { best });
        Some(2.0 * db_from_power(top_of_parabola([size(best.0 - step), best.1, size(best.0 + step)])))
    }

    /// Signal-to-noise ratio lost to shading, dB: `10·log(N·Σw²/(Σw)²)`; 0 for uniform weights.
    ///
    /// Source: Harris (1978), Proc. IEEE 66:51–83, equivalent noise bandwidth.
    #[must_use]
    pub fn shading_loss_db(&self) -> f64 {
        let sum: f64 = self.weights.iter().sum();
        let squares: f64 = self.weights.iter().map(|w| w * w).sum();
        db_from_power(self.weights.len() as f64 * squares / (sum * sum))
    }

    /// The first u at which `reached` holds of the factor, looking from 0 to half a period.
    fn first(&self, reached: impl Fn(f64) -> bool) -> Option<f64> {
        let (step, end) = (self.step(), self.half_period());
        let samples = (end / step).ceil() as u32;
        let past = (1..=samples).map(|i| (f64::from(i) * step).min(end)).find(|&u| reached(self.factor(u)))?;
        Some(crossing((past - step).max(0.0), past, |u| !reached(self.factor(u))))
    }

    /// A fine fraction of the beam width, in u.
    fn step(&self) -> f64 {
        1.0 / (32.0 * self.weights.len() as f64 * self.spacing_wavelengths)
    }

    /// Half the pattern's period in u: ψ = π.
    fn half_period(&self) -> f64 {
        0.5 / self.spacing_wavelengths
    }
}

/// Array factor of N uniform elements in closed form, `sin(Nψ/2)/(N·sin(ψ/2))`, ψ in rad.
///
/// Source: Urick (1983), ch. 3.
#[must_use]
pub fn uniform_factor(elements: u32, phase_rad: f64) -> f64 {
    let n = f64::from(elements);
    let below = n * sin(0.5 * phase_rad);
    if below.abs() < 1e-9 { 1.0 } else { sin(0.5 * n * phase_rad) / below }
}

/// −3 dB width of a long uniform aperture, rad: `0.886·λ/L` (0.885 893 is twice the root of sinc² = ½).
///
/// Source: Urick (1983), ch. 3.
#[must_use]
pub fn aperture_width_rad(wavelength_m: f64, aperture_m: f64) -> f64 {
    0.885_893 * wavelength_m / aperture_m
}

/// Range beyond which an aperture or a flat target is in the far field, m: `L²/λ`. Source: Urick (1983), ch. 4.
#[must_use]
pub fn far_field_m(extent_m: f64, wavelength_m: f64) -> f64 {
    extent_m * extent_m / wavelength_m
}

/// Greatest spacing without grating lobes for beams steered to an angle (rad, half the field of view): `1/(1 + sin θ)` wavelengths.
///
/// Source: Van Trees (2002), ch. 2.
#[must_use]
pub fn max_spacing_wavelengths(steering_rad: f64) -> f64 {
    1.0 / (1.0 + sin(steering_rad.abs()))
}

/// Height of the parabola through three equidistant samples, the middle one the greatest.
fn top_of_parabola([before, at, after]: [f64; 3]) -> f64 {
    let bend = before - 2.0 * at + after;
    if bend < 0.0 { at - (after - before) * (after - before) / (8.0 * bend) } else { at }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::real::{degrees, radians};

    fn array(elements: u32, shading: Shading) -> LineArray {
        LineArray::new(elements, 0.5, &shading).unwrap()
    }

    #[test]
    fn the_sum_is_the_closed_form() {
        let uniform = array(16, Shading::Uniform);
        for u in [0.0, 0.03, 0.2, 0.77] {
            assert!((uniform.factor(u) - uniform_factor(16, std::f64::consts::PI * u)).abs() < 1e-12);
        }
        assert!((uniform.first_null_u().unwrap() - 0.125).abs() < 1e-12);
    }

    #[test]
    fn widths_and_side_lobes_of_uniform_arrays() {
        let wide = array(16, Shading::Uniform);
        assert!((degrees(wide.beam_width_rad(0.0).unwrap()) / 6.35873 - 1.0).abs() < 1e-5);
        assert!((wide.peak_side_lobe_db().unwrap() + 13.15).abs() < 0.01);
        let narrow = array(256, Shading::Uniform);
        assert!((narrow.peak_side_lobe_db().unwrap() + 13.26).abs() < 0.01);
        let steered = degrees(narrow.beam_width_rad(radians(60.0)).unwrap());
        assert!((steered / 0.793_161 - 1.0).abs() < 1e-5);
        assert_eq!(narrow.beam_width_rad(radians(90.0)), None);
        assert!(narrow.shading_loss_db().abs() < 1e-12);
    }

    #[test]
    fn shadings_hold_their_side_lobes() {
        let level = |shading| array(64, shading).peak_side_lobe_db().unwrap();
        assert!((level(Shading::Chebyshev { side_lobe_db: 40.0 }) + 40.0).abs() < 0.01);
        assert!((level(Shading::Taylor { side_lobe_db: 30.0, near: 5 }) + 30.25).abs() < 0.02);
        assert!((level(Shading::Hamming) + 42.45).abs() < 0.02);
    }

    #[test]
    fn one_element_hears_everywhere() {
        let one = array(1, Shading::Uniform);
        assert_eq!((one.half_power_u(), one.first_null_u(), one.peak_side_lobe_db()), (None, None, None));
    }

    #[test]
    fn apertures_of_imaging_sonars() {
        assert!((degrees(aperture_width_rad(0.00125, 0.105)) - 0.60427).abs() < 1e-4);
        assert!((far_field_m(0.105, 0.00125) - 8.82).abs() < 1e-9);
        assert!((max_spacing_wavelengths(radians(30.0)) - 0.666_667).abs() < 1e-6);
    }
}
