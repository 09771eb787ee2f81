//! What an equation's source states of its range, kept beside the value.
//!
//! Knows no equation: each says its own limits.

use std::fmt;

use serde::Serialize;

/// A quantity that an equation was asked for outside of what its source states.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Outside {
    /// The quantity with its unit, such as `salinity, ppt`.
    pub quantity: &'static str,
    /// Its value.
    pub value: f64,
    /// Least value stated.
    pub low: f64,
    /// Greatest value stated.
    pub high: f64,
}

impl fmt::Display for Outside {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { quantity, value, low, high } = self;
        match (low.is_finite(), high.is_finite()) {
            (true, false) => write!(f, "{quantity}: {value} is below {low}"),
            (false, true) => write!(f, "{quantity}: {value} is above {high}"),
            _ if low == high => write!(f, "{quantity}: {value} is not {low}"),
            _ => write!(f, "{quantity}: {value} is outside {low} to {high}"),
        }
    }
}

/// An equation's value, and where it was carried on beyond its stated range: empty within.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[must_use]
pub struct Stated<T> {
    /// The value; beyond the range, the same equation carried on.
    pub value: T,
    /// The quantities outside of the stated range.
    pub outside: Vec<Outside>,
}

impl<T> Stated<T> {
    /// A value of an equation stated for `limits`: (quantity, value, low, high) each. What is no number is outside.
    pub(crate) fn new(value: T, limits: &[(&'static str, f64, f64, f64)]) -> Self {
        let outside = limits
            .iter()
            .filter(|(_, value, low, high)| !(*low..=*high).contains(value))
            .map(|&(quantity, value, low, high)| Outside { quantity, value, low, high })
            .collect();
        Self { value, outside }
    }

    /// Whether the equation's source covers this value.
    #[must_use]
    pub fn is_within(&self) -> bool {
        self.outside.is_empty()
    }

    /// The same limits with another value made of this one.
    pub fn map<U>(self, f: impl FnOnce(T) -> U) -> Stated<U> {
        Stated { value: f(self.value), outside: self.outside }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_beyond_its_range_says_so_in_words() {
        let fresh = Stated::new(1.0, &[("salinity, ppt", 0.0, 30.0, 40.0), ("depth, m", 5.0, 0.0, 8000.0)]);
        assert!(!fresh.is_within());
        assert_eq!(fresh.outside.len(), 1);
        assert_eq!(fresh.outside[0].to_string(), "salinity, ppt: 0 is outside 30 to 40");
        let small = Stated::new(1.0, &[("ka", 0.2, 10.0, f64::INFINITY)]);
        assert_eq!(small.outside[0].to_string(), "ka: 0.2 is below 10");
        let salty = Stated::new(1.0, &[("salinity, ppt", 35.0, 0.0, 0.0)]);
        assert_eq!(salty.outside[0].to_string(), "salinity, ppt: 35 is not 0");
        assert!(!Stated::new(1.0, &[("ka", f64::NAN, 10.0, f64::INFINITY)]).is_within());
    }
}
