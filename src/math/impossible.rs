//! A figure of the right type that cannot be.

/// A parameter that no real thing has, found by the module that knows what it means; whoever read it knows where it stood.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{key}: {problem}; {remedy}")]
pub struct Impossible {
    /// Key of the parameter in its section, such as `range_m` or `display.white_db`.
    pub key: &'static str,
    /// What is wrong with it.
    pub problem: String,
    /// What to do.
    pub remedy: String,
}

impl Impossible {
    /// Refuses numbers outside `low..=high`, and what is no number.
    ///
    /// # Errors
    /// The parameter `key`, with its range.
    pub fn outside(key: &'static str, value: f64, low: f64, high: f64) -> Result<(), Self> {
        if (low..=high).contains(&value) {
            return Ok(());
        }
        let problem = format!("{value} is outside {low} to {high}");
        Err(Self { key, problem, remedy: format!("write a number from {low} to {high}") })
    }

    /// Refuses a parameter unless `holds`.
    ///
    /// # Errors
    /// The parameter `key`, with the problem and the remedy given.
    pub fn unless(holds: bool, key: &'static str, problem: impl Into<String>, remedy: &str) -> Result<(), Self> {
        if holds { Ok(()) } else { Err(Self { key, problem: problem.into(), remedy: remedy.to_owned() }) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_number_is_outside_every_range() {
        assert!(Impossible::outside("ph", 8.0, 6.0, 9.0).is_ok());
        assert!(Impossible::outside("ph", f64::NAN, 6.0, 9.0).is_err());
        assert_eq!(
            Impossible::outside("ph", 20.0, 6.0, 9.0).unwrap_err().to_string(),
            "ph: 20 is outside 6 to 9; write a number from 6 to 9"
        );
    }
}
