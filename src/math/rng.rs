//! Random streams by address.
//!
//! Every stream is named by (seed, scope, index, purpose) and nothing else: no stream is shared, none depends on
//! threads or on how many numbers another stream has given. A new draw somewhere moves no other draw.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng as _, SeedableRng as _};
use sha2::{Digest as _, Sha256};

use super::real;

/// A random stream: ChaCha with 8 rounds, keyed by the SHA-256 of its address.
#[derive(Clone, Debug)]
pub struct Stream(ChaCha8Rng);

impl Stream {
    /// The stream at (seed, scope, index, purpose), e.g. `(7, "frame", 12, "speckle")`.
    ///
    /// Parts are length-prefixed before hashing, so that no two addresses run together.
    #[must_use]
    pub fn at(seed: u64, scope: &str, index: u64, purpose: &str) -> Self {
        let mut hash = Sha256::new();
        for part in [&seed.to_le_bytes()[..], scope.as_bytes(), &index.to_le_bytes(), purpose.as_bytes()] {
            hash.update((part.len() as u64).to_le_bytes());
            hash.update(part);
        }
        Self(ChaCha8Rng::from_seed(hash.finalize().into()))
    }

    /// 64 uniform bits.
    pub fn bits(&mut self) -> u64 {
        self.0.next_u64()
    }

    /// Uniform in [0, 1), 53 bits.
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 * (1.0 / (1u64 << 53) as f64)
    }

    /// Uniform in [low, high).
    pub fn uniform(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// Uniform integer in 0..n by widening multiplication (bias below n / 2⁶⁴). `n` must not be 0.
    pub fn below(&mut self, n: u64) -> u64 {
        ((u128::from(self.bits()) * u128::from(n)) >> 64) as u64
    }

    /// Standard normal by Box–Muller (one of the pair; two draws a call, so that calls stay addressable).
    pub fn normal(&mut self) -> f64 {
        let radius = (-2.0 * real::ln(1.0 - self.unit())).sqrt();
        radius * real::cos(std::f64::consts::TAU * self.unit())
    }

    /// Fills `out` with uniform bits, the fast way for whole images.
    pub fn fill_bits(&mut self, out: &mut [u8]) {
        self.0.fill_bytes(out);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_address_names_one_stream() {
        let draw = |seed, scope, index, purpose| Stream::at(seed, scope, index, purpose).bits();
        assert_eq!(draw(7, "frame", 1, "speckle"), draw(7, "frame", 1, "speckle"));
        let all = [
            draw(7, "frame", 1, "speckle"),
            draw(8, "frame", 1, "speckle"),
            draw(7, "scene", 1, "speckle"),
            draw(7, "frame", 2, "speckle"),
            draw(7, "frame", 1, "noise"),
        ];
        for (i, a) in all.iter().enumerate() {
            assert!(all[..i].iter().all(|b| a != b));
        }
    }

    /// The stream is part of every dataset hash: these bits may never change.
    #[test]
    fn the_stream_is_pinned() {
        assert_eq!(Stream::at(7, "scene", 3, "objects[0].count").bits(), PINNED);
    }
    const PINNED: u64 = 6221928427037259669;

    #[test]
    fn moments_of_the_draws() {
        let mut stream = Stream::at(1, "test", 0, "moments");
        let n = 200_000;
        let normals: Vec<f64> = (0..n).map(|_| stream.normal()).collect();
        let mean = normals.iter().sum::<f64>() / f64::from(n);
        let variance = normals.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / f64::from(n);
        assert!(mean.abs() < 0.01 && (variance - 1.0).abs() < 0.015, "{mean} {variance}");
        let mut counts = [0u32; 5];
        (0..50_000).for_each(|_| counts[stream.below(5) as usize] += 1);
        assert!(counts.iter().all(|&c| (9_600..10_400).contains(&c)), "{counts:?}");
    }
}
