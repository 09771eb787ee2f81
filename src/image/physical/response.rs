//! The complex field at the aperture, filtered in range and formed into beams: from mean powers to powers of one ping.
//!
//! Blocks of range bins go through the transforms side by side; the pulse's filter works on whole rows between them. A
//! block's order of draws is part of the image's bits.

use super::aperture::{Aperture, Array, Focus};
use super::beams::{BeamTables, TAPS};
use super::fft::{Fft, Rows};
use super::pulse::Sampled;
use super::receiver::Levels;
use crate::image::Channel;
use crate::math::fast::{fill_complex_normals, sin_cos_turn};
use crate::math::rng::Stream;
use crate::math::vectors::{Work, widest};
use crate::sonar::{Echoes, Grid};

/// Range bins that go through a transform together.
const BLOCK: usize = 32;

/// Tables of a device in a water.
#[derive(Clone, Debug)]
pub(super) struct Response {
    grid: Grid,
    tables: BeamTables,
    pulse: Sampled,
    levels: Levels,
    fft: Fft,
    /// Row of the transform and complex weight of each element.
    elements: Vec<(usize, (f32, f32))>,
    /// For each element, turns of phase by defocus times metres of range; none where the array is focused everywhere.
    defocus: Option<Defocus>,
    /// For each bin, the greatest size of a quadrature of an element's signal, in the transform's unit.
    clip: Vec<f32>,
    /// For each bin, what a power is multiplied with: mean over looks, made up at the ends of the grid.
    mean: Vec<f32>,
}

/// Phases of a focus at one range.
#[derive(Clone, Debug)]
struct Defocus {
    /// `x²/2λ` of each element, metres.
    turns_m: Vec<f64>,
    focus_m: f64,
}

/// The parts that a response is made from.
pub(super) struct Parts {
    pub grid: Grid,
    pub aperture: Aperture,
    pub tables: BeamTables,
    pub pulse: Sampled,
    pub levels: Levels,
}

impl Response {
    /// Puts the parts together.
    pub fn new(parts: Parts, array: &Array, channel: &Channel) -> Self {
        let Parts { grid, aperture, tables, pulse, levels } = parts;
        let weights = aperture.weights_with_errors(array);
        let elements =
            weights.into_iter().enumerate().map(|(element, weight)| (aperture.row(element), weight)).collect();
        let defocus = match array.focus {
            Focus::Dynamic => None,
            Focus::Fixed { range_m } => {
                let turns =
                    |element| 0.5 * aperture.position(element) * aperture.position(element) * channel.wavelength_m;
                Some(Defocus { turns_m: (0..aperture.elements()).map(turns).collect(), focus_m: range_m })
            }
        };
        let clip = levels.full_scale.iter().map(|power| (power * aperture.directions as f64).sqrt() as f32).collect();
        let coverage = pulse.coverage(grid.bins as usize);
        let mean = coverage.iter().map(|covered| (1.0 / (covered * f64::from(pulse.looks))) as f32).collect();
        let fft = Fft::new(aperture.directions);
        Self { grid, tables, pulse, levels, fft, elements, defocus, clip, mean }
    }

    #[cfg(test)]
    pub fn tables(&self) -> &BeamTables {
        &self.tables
    }

    /// Powers of one ping in each cell, relative to the source's at 1 m.
    pub fn powers(&self, echoes: &Echoes, stream: &mut Stream) -> Vec<f32> {
        let bins = self.grid.bins as usize;
        let mut powers = vec![0.0; self.grid.len()];
        let mut signals = Rows::zeros(self.elements.len() * bins);
        let room = self.fft.len() * BLOCK.min(bins);
        let (mut rows, mut spare) = (Rows::zeros(room), Rows::zeros(room));
        for _ in 0..self.pulse.looks {
            for start in (0..bins).step_by(BLOCK) {
                let block = Block { start, width: BLOCK.min(bins - start), response: self };
                let normals = self.fft.len() * block.width;
                fill_complex_normals(stream, &mut rows.re[..normals], &mut rows.im[..normals]);
                let (rows, spare, signals) = (&mut rows, &mut spare, &mut signals);
                widest(ToAperture { block, echoes, rows, spare, signals });
            }
            widest(ThroughPulse { response: self, signals: &mut signals, row: &mut vec![0.0; bins] });
            for start in (0..bins).step_by(BLOCK) {
                let block = Block { start, width: BLOCK.min(bins - start), response: self };
                let (rows, spare, powers) = (&mut rows, &mut spare, &mut powers);
                widest(ToBeams { block, signals: &signals, rows, spare, powers });
            }
        }
        powers
    }
}

/// A stretch of range bins.
#[derive(Clone, Copy)]
struct Block<'a> {
    start: usize,
    width: usize,
    response: &'a Response,
}

/// Normals in `rows` become a field, and the field the elements' signals.
struct ToAperture<'a> {
    block: Block<'a>,
    echoes: &'a Echoes,
    rows: &'a mut Rows,
    spare: &'a mut Rows,
    signals: &'a mut Rows,
}

impl Work for ToAperture<'_> {
    #[inline(always)]
    fn run(self) {
        let Self { block: Block { start, width, response }, echoes, rows, spare, signals } = self;
        let bins = response.grid.bins as usize;
        for (direction, heard) in response.tables.heard.iter().enumerate() {
            let mut power = [0.0_f32; BLOCK];
            mean_power(&mut power[..width], heard, echoes, (start, response));
            let row = direction * width..(direction + 1) * width;
            let field = rows.re[row.clone()].iter_mut().zip(&mut rows.im[row]);
            for ((re, im), power) in field.zip(&power) {
                let amplitude = (0.5 * power).sqrt();
                *re *= amplitude;
                *im *= amplitude;
            }
        }
        response.fft.forward(rows, spare, width);
        for (element, &(row, _)) in response.elements.iter().enumerate() {
            let to = element * bins + start;
            signals.re[to..to + width].copy_from_slice(&rows.re[row * width..(row + 1) * width]);
            signals.im[to..to + width].copy_from_slice(&rows.im[row * width..(row + 1) * width]);
        }
    }
}

/// Mean power in one direction: echoes, ghosts and open water of the beams that it hears, and noise.
///
/// A complex Gaussian field plus complex Gaussian noise is one complex Gaussian whose mean power is the sum, so one draw
/// serves both. Source: Goodman (2007), Speckle Phenomena in Optics, ch. 3.
#[inline(always)]
fn mean_power(power: &mut [f32], heard: &[(usize, f32)], echoes: &Echoes, at: (usize, &Response)) {
    let (start, response) = at;
    let (bins, end) = (response.grid.bins as usize, start + power.len());
    let Levels { echo, volume, noise, .. } = &response.levels;
    power.copy_from_slice(&noise[start..end]);
    let (echo, volume) = (&echo[start..end], &volume[start..end]);
    for &(beam, share) in heard {
        let energy = &echoes.energy[beam * bins + start..beam * bins + end];
        let water = &echoes.water[beam * bins + start..beam * bins + end];
        for i in 0..power.len() {
            power[i] += share * (energy[i] * echo[i] + water[i] * volume[i]);
        }
        if let Some(ghosts) = &echoes.ghosts {
            let ghosts = &ghosts[beam * bins + start..beam * bins + end];
            power.iter_mut().zip(ghosts).zip(echo).for_each(|((power, ghost), echo)| *power += share * ghost * echo);
        }
    }
}

/// Every element's signal through the pulse's filter.
struct ThroughPulse<'a> {
    response: &'a Response,
    signals: &'a mut Rows,
    row: &'a mut [f32],
}

impl Work for ThroughPulse<'_> {
    #[inline(always)]
    fn run(self) {
        for part in [&mut self.signals.re, &mut self.signals.im] {
            for signal in part.chunks_exact_mut(self.row.len()) {
                self.response.pulse.convolve(signal, self.row);
                signal.copy_from_slice(self.row);
            }
        }
    }
}

/// The elements' signals, clipped, weighted and focused, become beams; their powers are added.
struct ToBeams<'a> {
    block: Block<'a>,
    signals: &'a Rows,
    rows: &'a mut Rows,
    spare: &'a mut Rows,
    powers: &'a mut [f32],
}

impl Work for ToBeams<'_> {
    #[inline(always)]
    fn run(self) {
        let Self { block: Block { start, width, response }, signals, rows, spare, powers } = self;
        let bins = response.grid.bins as usize;
        let clip = &response.clip[start..start + width];
        rows.re[..response.fft.len() * width].fill(0.0);
        rows.im[..response.fft.len() * width].fill(0.0);
        for (element, &(row, weight)) in response.elements.iter().enumerate() {
            let from = element * bins + start;
            let signal = (&signals.re[from..from + width], &signals.im[from..from + width]);
            let to = row * width..(row + 1) * width;
            let to = (&mut rows.re[to.clone()], &mut rows.im[to]);
            weigh(signal, clip, weight, (&mut *to.0, &mut *to.1));
            if let Some(defocus) = &response.defocus {
                defocus.turn(element, (start, &response.grid), to);
            }
        }
        response.fft.backward(rows, spare, width);
        for (beam, (first, taps)) in response.tables.taps.iter().enumerate() {
            let to = beam * bins + start;
            let mix = Mix { rows, first: *first, taps, count: response.fft.len() };
            mix.add_power(&response.mean[start..start + width], &mut powers[to..to + width]);
        }
    }
}

/// Clips each quadrature of a signal and multiplies with a complex weight.
#[inline(always)]
fn weigh(signal: (&[f32], &[f32]), clip: &[f32], (wr, wi): (f32, f32), to: (&mut [f32], &mut [f32])) {
    let to = to.0.iter_mut().zip(to.1);
    for ((to, limit), (re, im)) in to.zip(clip).zip(signal.0.iter().zip(signal.1)) {
        let (re, im) = (re.max(-limit).min(*limit), im.max(-limit).min(*limit));
        *to.0 = re * wr - im * wi;
        *to.1 = re * wi + im * wr;
    }
}

impl Defocus {
    /// Turns an element's signal by `π·x²/λ·(1/r − 1/r_focus)`: what focusing at one range leaves at others.
    ///
    /// Fresnel's approximation, straight ahead (x² is x²·cos²θ to the side).
    /// Source: Goodman (2005), Introduction to Fourier Optics, ch. 4; Van Trees (2002), ch. 2.
    #[inline(always)]
    fn turn(&self, element: usize, (start, grid): (usize, &Grid), (re, im): (&mut [f32], &mut [f32])) {
        for (i, (re, im)) in re.iter_mut().zip(im).enumerate() {
            let range = grid.range_m((start + i) as u32);
            let turns = self.turns_m[element] * (1.0 / range - 1.0 / self.focus_m);
            // Below 1 also where the fraction rounds up to it.
            let (sine, cosine) = sin_cos_turn(((turns - turns.floor()) as f32).min(0.999_999_94));
            (*re, *im) = (*re * cosine - *im * sine, *re * sine + *im * cosine);
        }
    }
}

/// A beam as a mix of neighbouring directions.
struct Mix<'a> {
    rows: &'a Rows,
    first: usize,
    taps: &'a [f32; TAPS],
    count: usize,
}

impl Mix<'_> {
    #[inline(always)]
    fn add_power(&self, mean: &[f32], powers: &mut [f32]) {
        let (re, im) = (self.mixed(&self.rows.re, powers.len()), self.mixed(&self.rows.im, powers.len()));
        for (((power, mean), re), im) in powers.iter_mut().zip(mean).zip(&re).zip(&im) {
            *power += (re * re + im * im) * mean;
        }
    }

    #[inline(always)]
    fn mixed(&self, values: &[f32], width: usize) -> [f32; BLOCK] {
        let mut sum = [0.0; BLOCK];
        for (tap, weight) in self.taps.iter().enumerate() {
            let row = (self.first + tap) % self.count * width;
            for (sum, value) in sum.iter_mut().zip(&values[row..row + width]) {
                *sum += weight * value;
            }
        }
        sum
    }
}
