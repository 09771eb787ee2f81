//! The plane.

use serde::{Deserialize, Serialize};

use super::{HeightGrid, SeabedError};

/// A plane at z = 0.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Flat {}

impl Flat {
    pub(super) fn check(&self) -> Result<(), SeabedError> {
        Ok(())
    }

    pub(super) fn raise(&self, _: &mut HeightGrid) {}
}
