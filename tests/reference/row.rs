//! A row of the reference table, and which of its inputs a computation has read.

use std::cell::RefCell;
use std::collections::BTreeSet;

use ensonify::physics::Water;
use serde_json::{Map, Value};

/// A row: inputs, expected figures, tolerance.
pub struct Row {
    pub id: String,
    pub group: String,
    pub unit: String,
    pub expected: Value,
    pub rtol: f64,
    pub atol: f64,
    inputs: Map<String, Value>,
    read: RefCell<BTreeSet<String>>,
}

impl Row {
    /// Reads a row as the table writes it.
    pub fn new(row: Value) -> Self {
        let text = |key: &str| row[key].as_str().unwrap_or_default().to_owned();
        let tolerance = |key: &str| row[key].as_f64().unwrap_or(0.0);
        Self {
            id: text("id"),
            group: text("group"),
            unit: text("unit"),
            expected: row["expected"].clone(),
            rtol: tolerance("rtol"),
            atol: tolerance("atol"),
            inputs: row["inputs"].as_object().expect("inputs").clone(),
            read: RefCell::default(),
        }
    }

    /// Whether the row has an input of this name.
    pub fn has(&self, key: &str) -> bool {
        self.inputs.contains_key(key)
    }

    /// An input that is a number.
    pub fn number(&self, key: &str) -> Result<f64, String> {
        self.value(key)?.as_f64().ok_or_else(|| format!("input `{key}` is no number"))
    }

    /// Inputs that are numbers.
    pub fn numbers<const N: usize>(&self, keys: [&str; N]) -> Result<[f64; N], String> {
        let mut numbers = [0.0; N];
        for (number, key) in numbers.iter_mut().zip(keys) {
            *number = self.number(key)?;
        }
        Ok(numbers)
    }

    /// An input that is a whole number.
    pub fn count(&self, key: &str) -> Result<u32, String> {
        let number = self.value(key)?.as_u64().and_then(|n| u32::try_from(n).ok());
        number.ok_or_else(|| format!("input `{key}` is no count"))
    }

    /// An input that is a word.
    pub fn word(&self, key: &str) -> Result<&str, String> {
        self.value(key)?.as_str().ok_or_else(|| format!("input `{key}` is no word"))
    }

    /// An input that is three numbers.
    pub fn vector(&self, key: &str) -> Result<[f64; 3], String> {
        let vector: Option<Vec<f64>> =
            self.value(key)?.as_array().and_then(|list| list.iter().map(Value::as_f64).collect());
        vector.and_then(|v| v.try_into().ok()).ok_or_else(|| format!("input `{key}` is no vector"))
    }

    /// Inputs that the equation does not depend on; the caller says why.
    pub fn no_matter(&self, keys: &[&str]) {
        self.read.borrow_mut().extend(keys.iter().map(|key| (*key).to_owned()));
    }

    /// The water of the inputs `T_C`, `S_ppt` or `S`, `pH` and `depth_m`.
    pub fn water(&self) -> Result<Water, String> {
        let salinity = if self.has("S_ppt") { "S_ppt" } else { "S" };
        let [temperature_c, salinity_ppt, ph, depth_m] = self.numbers(["T_C", salinity, "pH", "depth_m"])?;
        Ok(Water { temperature_c, salinity_ppt, ph, depth_m })
    }

    /// Fails if an input was not looked at: the row means something else than was computed.
    pub fn all_inputs_used(&self) -> Result<(), String> {
        let read = self.read.borrow();
        match self.inputs.keys().find(|key| !read.contains(*key)) {
            Some(key) => Err(format!("nothing uses the input `{key}`")),
            None => Ok(()),
        }
    }

    fn value(&self, key: &str) -> Result<&Value, String> {
        self.read.borrow_mut().insert(key.to_owned());
        self.inputs.get(key).ok_or_else(|| format!("there is no input `{key}`"))
    }
}
