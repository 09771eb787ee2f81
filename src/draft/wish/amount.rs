//! Numbers as people say them.

/// A physical amount in the unit that its field names.
#[derive(Clone, Debug, PartialEq)]
pub enum Amount {
    /// "12 m".
    Exactly(f64),
    /// "10 to 25 m", "up to 5 m": the lower end first.
    Between(f64, f64),
    /// "2 or 4 m".
    OneOf(Vec<f64>),
    /// "from 2 m to 15 m in equal steps", "in five steps": first, last, how many where that is said. May run downwards.
    Steps(f64, f64, Option<u32>),
}

impl Amount {
    /// Smallest and largest value.
    #[must_use]
    pub fn ends(&self) -> [f64; 2] {
        match self {
            Self::Exactly(value) => [*value; 2],
            Self::Between(low, high) => [*low, *high],
            Self::OneOf(values) => [
                values.iter().copied().fold(f64::INFINITY, f64::min),
                values.iter().copied().fold(-f64::INFINITY, f64::max),
            ],
            Self::Steps(first, last, _) => [first.min(*last), first.max(*last)],
        }
    }

    /// The same in another unit.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        match self {
            Self::Exactly(value) => Self::Exactly(value * factor),
            Self::Between(low, high) => Self::Between(low * factor, high * factor),
            Self::OneOf(values) => Self::OneOf(values.iter().map(|value| value * factor).collect()),
            Self::Steps(first, last, count) => Self::Steps(first * factor, last * factor, *count),
        }
    }
}

/// How many of a thing in a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Count {
    /// "two".
    Exactly(u32),
    /// "three to five", "a few", "lots of": the lower end first.
    Between(u32, u32),
}

impl Count {
    /// The most there can be.
    #[must_use]
    pub fn most(self) -> u32 {
        match self {
            Self::Exactly(count) | Self::Between(_, count) => count,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_and_units() {
        assert_eq!(Amount::Steps(15.0, 2.0, None).ends(), [2.0, 15.0]);
        assert_eq!(Amount::OneOf(vec![4.0, 2.0]).ends(), [2.0, 4.0]);
        assert_eq!(Amount::Between(10.0, 20.0).scaled(0.3048).ends(), [3.048, 6.096]);
        assert_eq!(Amount::Exactly(2.0).scaled(1.8288), Amount::Exactly(3.6576));
        assert_eq!((Count::Exactly(2).most(), Count::Between(3, 5).most()), (2, 5));
    }
}
