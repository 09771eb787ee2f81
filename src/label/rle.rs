//! COCO run-length masks: runs down the columns, and the compressed text that annotation files hold.
//!
//! Source: cocoapi (2014–2020), `common/maskApi.c`, `rleEncode`, `rleToString` and `rleFrString`.

use thiserror::Error;

/// A binary mask as lengths of runs over the pixels column by column: zeros first (perhaps none), then ones, in turn.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Rle {
    /// Lengths; they add up to the number of pixels.
    pub counts: Vec<u32>,
}

/// A text that is not a run-length mask.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum RleError {
    /// A byte outside `0` … `o`.
    #[error("run-length text has the byte {byte:#04x} at {at}, which is none of '0' to 'o': the annotation is damaged")]
    Byte {
        /// The byte.
        byte: u8,
        /// Its place in the text.
        at: usize,
    },
    /// The text ends inside a number.
    #[error("run-length text ends in the middle of a number: the annotation is cut off")]
    CutOff,
    /// A run is negative or beyond 32 bits.
    #[error("run {run} of the run-length text has an impossible length: the annotation is damaged")]
    Length {
        /// Number of the run, from 0.
        run: usize,
    },
}

impl Rle {
    /// The mask over `pixels` pixels whose ones are at `runs`: (first pixel, number of pixels), column-major, in order,
    /// not touching each other.
    #[must_use]
    pub fn from_runs(pixels: u32, runs: &[(u32, u32)]) -> Self {
        let mut counts = Vec::with_capacity(2 * runs.len() + 1);
        let mut end = 0;
        for &(start, length) in runs {
            counts.extend([start - end, length]);
            end = start + length;
        }
        if end < pixels || counts.is_empty() {
            counts.push(pixels - end);
        }
        Self { counts }
    }

    /// The runs of ones, as [`Self::from_runs`] takes them.
    pub fn runs(&self) -> impl Iterator<Item = (u32, u32)> + '_ {
        let mut start = 0;
        self.counts.iter().enumerate().filter_map(move |(i, &length)| {
            let run = (start, length);
            start += length;
            (i % 2 == 1).then_some(run)
        })
    }

    /// Number of ones.
    #[must_use]
    pub fn area(&self) -> u32 {
        self.counts.iter().skip(1).step_by(2).sum()
    }

    /// COCO's compressed text: each length (from the fourth on, its difference from the length two before) in groups of
    /// five bits, lowest first, bit 5 set on all but the last group, 48 added to make it printable.
    #[must_use]
    pub fn encode(&self) -> String {
        let mut text = String::with_capacity(2 * self.counts.len());
        for (i, &count) in self.counts.iter().enumerate() {
            let before = if i > 2 { self.counts[i - 2] } else { 0 };
            let mut rest = i64::from(count) - i64::from(before);
            loop {
                let group = (rest & 0x1f) as u8;
                rest >>= 5;
                // The last group's bit 4 is the sign that decoding extends.
                let last = rest == if group & 0x10 == 0 { 0 } else { -1 };
                text.push(char::from(48 + group + if last { 0 } else { 0x20 }));
                if last {
                    break;
                }
            }
        }
        text
    }

    /// Reads [`Self::encode`]'s text back.
    ///
    /// # Errors
    /// [`RleError`] when the text is none of COCO's.
    pub fn decode(text: &str) -> Result<Self, RleError> {
        let mut counts: Vec<u32> = Vec::new();
        let (mut value, mut shift) = (0i64, 0u32);
        for (at, byte) in text.bytes().enumerate() {
            let run = counts.len();
            let group = byte.checked_sub(48).filter(|&g| g < 0x40).ok_or(RleError::Byte { byte, at })?;
            if shift > 40 {
                return Err(RleError::Length { run });
            }
            value |= i64::from(group & 0x1f) << shift;
            shift += 5;
            if group & 0x20 == 0 {
                if group & 0x10 != 0 {
                    value |= -1 << shift;
                }
                let before = if run > 2 { i64::from(counts[run - 2]) } else { 0 };
                counts.push(u32::try_from(value + before).map_err(|_| RleError::Length { run })?);
                (value, shift) = (0, 0);
            }
        }
        if shift == 0 { Ok(Self { counts }) } else { Err(RleError::CutOff) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Runs of a mask given as a function of (column, row).
    fn of(width: u32, height: u32, inside: impl Fn(u32, u32) -> bool) -> Rle {
        let mut runs: Vec<(u32, u32)> = Vec::new();
        for pixel in (0..width * height).filter(|p| inside(p / height, p % height)) {
            match runs.last_mut() {
                Some((start, length)) if *start + *length == pixel => *length += 1,
                _ => runs.push((pixel, 1)),
            }
        }
        Rle::from_runs(width * height, &runs)
    }

    /// Texts that pycocotools 2.0 gives for the same masks.
    #[test]
    fn texts_are_those_of_pycocotools() {
        let known = [
            (of(2, 2, |_, _| false), "4", 0),
            (of(2, 2, |_, _| true), "04", 4),
            (of(3, 2, |c, r| r == 1 || c == 1), "131N", 4),
            (
                of(30, 40, |c, r| (5..25).contains(&c) && (10 + c.abs_diff(14) / 2..30 - c.abs_diff(14)).contains(&r)),
                "f67Q11N2O1N2O1N2O1N2O1OO2N1O2N1O2N1O2N1O2Nj5",
                255,
            ),
            (
                of(512, 1024, |c, r| (c, r) == (3, 1000) || (c, r) == (511, 0) || (c == 100 && (17..900).contains(&r))),
                "Xo31XQP3bk0dRj9^TOSlVC",
                885,
            ),
        ];
        for (rle, text, area) in known {
            assert_eq!(rle.encode(), text);
            assert_eq!(rle.area(), area);
            assert_eq!(Rle::decode(text).as_ref(), Ok(&rle));
            let runs: Vec<_> = rle.runs().collect();
            assert_eq!(Rle::from_runs(rle.counts.iter().sum(), &runs), rle);
        }
    }

    #[test]
    fn damaged_texts_are_refused() {
        assert_eq!(Rle::decode("13 1"), Err(RleError::Byte { byte: b' ', at: 2 }));
        assert_eq!(Rle::decode("Xo"), Err(RleError::CutOff));
        assert_eq!(Rle::decode("131O0000K"), Err(RleError::Length { run: 8 }));
        assert_eq!(Rle::decode("oooooooooooo0"), Err(RleError::Length { run: 0 }));
    }
}
