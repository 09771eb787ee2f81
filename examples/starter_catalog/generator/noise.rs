//! Smooth random fields in space: what makes rock craggy and bark bumpy.
//!
//! Knows nothing of surfaces.

use ensonify::math::rng::Stream;
use glam::DVec3;

/// Gradient noise with its own table of random directions.
pub struct Noise {
    order: Vec<usize>,
    gradients: Vec<DVec3>,
}

const TABLE: usize = 256;

impl Noise {
    /// The field of one object.
    #[must_use]
    pub fn of(uid: &str) -> Self {
        let mut stream = Stream::at(1, "starter-catalog", 0, uid);
        let gradients =
            (0..TABLE).map(|_| DVec3::new(stream.normal(), stream.normal(), stream.normal()).normalize()).collect();
        let mut order: Vec<usize> = (0..TABLE).collect();
        for i in (1..TABLE).rev() {
            order.swap(i, stream.below(i as u64 + 1) as usize);
        }
        Self { order, gradients }
    }

    /// Smooth noise, about −0.7 to 0.7, features about one unit wide.
    /// Source: Perlin (2002), Improving Noise.
    #[must_use]
    pub fn at(&self, p: DVec3) -> f64 {
        let cell = p.floor();
        let f = p - cell;
        let fade = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
        let mut sum = 0.0;
        for corner in 0..8 {
            let step = DVec3::new(f64::from(corner & 1), f64::from(corner >> 1 & 1), f64::from(corner >> 2 & 1));
            let share = step * fade + (DVec3::ONE - step) * (DVec3::ONE - fade);
            sum += share.x * share.y * share.z * self.gradient(cell + step).dot(f - step);
        }
        sum
    }

    /// `octaves` of noise, each half as wide and half as high as the one before.
    #[must_use]
    pub fn fractal(&self, p: DVec3, octaves: u32) -> f64 {
        (0..octaves).map(|i| f64::from(1u32 << i)).map(|scale| self.at(p * scale) / scale).sum()
    }

    /// As [`Self::fractal`], folded so that it has sharp crests and rounded dales.
    #[must_use]
    pub fn ridged(&self, p: DVec3, octaves: u32) -> f64 {
        (0..octaves).map(|i| f64::from(1u32 << i)).map(|scale| (0.35 - self.at(p * scale).abs()) / scale).sum()
    }

    fn gradient(&self, lattice: DVec3) -> DVec3 {
        let wrap = |x: f64| x as i64 as usize % TABLE;
        let order = |i: usize| self.order[i % TABLE];
        self.gradients[order(wrap(lattice.x) + order(wrap(lattice.y) + order(wrap(lattice.z))))]
    }
}
