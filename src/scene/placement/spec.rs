//! An object as it is asked for.

use serde::{Deserialize, Serialize};

use super::{FAR_M, InView, PoseSpec, outside};

/// An object to place.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BodySpec {
    /// Category in the annotations.
    pub label: String,
    /// Name or folder of a catalog.
    pub catalog: String,
    /// Model of the catalog.
    pub uid: String,
    /// Where it stands.
    pub pose: PoseSpec,
    /// Free water to any other body, metres; those of the same pair that touch on purpose aside.
    pub clear_m: f64,
    /// Places tried before it counts as failed. A fall counts for five.
    pub tries: u32,
    /// What becomes of it then.
    pub on_failure: OnFailure,
    /// From which frames it must be seen.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub in_view: Option<InView>,
    /// Number of its item in the list of objects. With `instance`, the address of its random streams: more of another
    /// item, or more items after it, do not change its draws.
    pub item: u32,
    /// Number among the instances of its item.
    pub instance: u32,
}

/// What becomes of an object that finds no place in its tries.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum OnFailure {
    /// It is left out, and listed.
    Drop,
    /// Its place is sought anew, up to [`OnFailure::ROUNDS`] times, each with random numbers and tries of its own; then it is
    /// left out.
    Resample,
    /// The scene cannot be built.
    Fail,
}

impl OnFailure {
    /// How often [`Self::Resample`] begins again.
    pub const ROUNDS: u32 = 5;

    /// Rounds of tries that an object has.
    pub(super) fn rounds(self) -> u32 {
        match self {
            Self::Drop | Self::Fail => 1,
            Self::Resample => 1 + Self::ROUNDS,
        }
    }
}

impl BodySpec {
    /// What is wrong with the numbers, if anything.
    pub(in crate::scene) fn fault(&self) -> Option<String> {
        let numbers = outside(&[("clear_m", self.clear_m, 0.0, FAR_M), ("tries", self.tries.into(), 1.0, 100_000.0)]);
        self.pose.fault().or(numbers)
    }

    /// Purpose of a random stream of its own.
    pub(super) fn purpose(&self, what: &str) -> String {
        format!("objects[{}]#{}.{what}", self.item, self.instance)
    }
}
