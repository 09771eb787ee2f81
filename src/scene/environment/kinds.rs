//! Kinds of generated environment.

use serde::{Deserialize, Serialize};

use super::EnvironmentError;
use super::dam::Dam;
use super::harbour::Harbour;
use super::net_pen::NetPen;
use super::pier::Pier;
use super::pipeline::Pipeline;
use super::structure::Structure;
use super::tank::Tank;
use crate::catalog::materials;
use crate::math::rng::Stream;

/// Kinds of generated environment. All but the tank stand on the recipe's seabed, whose mean height is 0.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// A deck on piles before a quay wall.
    Pier(Pier),
    /// A wall with intakes behind racks and with outlet pipes.
    Dam(Dam),
    /// Quay walls on three sides.
    Harbour(Harbour),
    /// A basin of smooth walls with a floor of its own.
    Tank(Tank),
    /// A pipe laid over the seabed.
    Pipeline(Pipeline),
    /// A net that hangs from a floating collar.
    NetPen(NetPen),
}

impl Kind {
    pub(super) fn check(&self) -> Result<(), EnvironmentError> {
        match self {
            Self::Pier(pier) => pier.check(),
            Self::Dam(dam) => dam.check(),
            Self::Harbour(harbour) => harbour.check(),
            Self::Tank(tank) => tank.check(),
            Self::Pipeline(pipeline) => pipeline.check(),
            Self::NetPen(pen) => pen.check(),
        }
    }

    pub(super) fn raise(&self, structure: &mut Structure, stream: &mut Stream) {
        match self {
            Self::Pier(pier) => pier.raise(structure, stream),
            Self::Dam(dam) => dam.raise(structure, stream),
            Self::Harbour(harbour) => harbour.raise(structure, stream),
            Self::Tank(tank) => tank.raise(structure),
            Self::Pipeline(pipeline) => pipeline.raise(structure, stream),
            Self::NetPen(pen) => pen.raise(structure, stream),
        }
    }

    /// Names of the parts that it may have.
    pub(super) fn parts(&self) -> &'static [&'static str] {
        match self {
            Self::Pier(_) => Pier::PARTS,
            Self::Dam(_) => Dam::PARTS,
            Self::Harbour(_) => Harbour::PARTS,
            Self::Tank(_) => Tank::PARTS,
            Self::Pipeline(_) => Pipeline::PARTS,
            Self::NetPen(_) => NetPen::PARTS,
        }
    }

    /// Whether it has a floor of its own.
    pub(in crate::scene) fn has_floor(&self) -> bool {
        matches!(self, Self::Tank(_))
    }
}

/// Refuses what is not within `low..=high`.
pub(super) fn within(name: &'static str, value: f64, [low, high]: [f64; 2]) -> Result<(), EnvironmentError> {
    let fine = value.is_finite() && (low..=high).contains(&value);
    if fine { Ok(()) } else { Err(EnvironmentError::Range { name, value, low, high }) }
}

/// Refuses a material that no table has.
pub(super) fn material(name: &str) -> Result<(), EnvironmentError> {
    materials::material(name).map(|_| ()).map_err(|fault| EnvironmentError::Material(fault.to_string()))
}
