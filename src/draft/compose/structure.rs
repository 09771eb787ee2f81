//! The structure of a scene: its sides, what of it is referred to, and how much room it leaves.

use super::asked::Asked;
use super::placing::Kind as Pose;
use crate::draft::Problem;

/// A kind of the recipe's `environment`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Pier,
    Dam,
    Harbour,
    Tank,
    Pipeline,
    NetPen,
}

/// A structure.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Structure {
    pub kind: Kind,
    /// Length, width and height or depth, as far as they were said, metres.
    pub said_m: [Option<f64>; 3],
    /// Who says that it is there.
    pub why: String,
    /// Who says its sides.
    pub sides_why: String,
}

/// Room between a vehicle and a wall, metres.
const ROOM_M: f64 = 0.7;
/// Length, width and depth of a tank where they are not said, metres.
const TANK_M: [f64; 3] = [12.0, 8.0, 5.0];
/// Width of a tank whose length alone is said, in its lengths.
const TANK_WIDTH: f64 = 0.7;

impl Kind {
    const ALL: [(&'static str, Self); 6] = [
        ("pier", Self::Pier),
        ("dam", Self::Dam),
        ("harbour", Self::Harbour),
        ("tank", Self::Tank),
        ("pipeline", Self::Pipeline),
        ("net-pen", Self::NetPen),
    ];

    /// The kind that a word names.
    pub fn named(word: &str) -> Option<Self> {
        Self::ALL.iter().find(|(name, _)| *name == word).map(|(_, kind)| *kind)
    }

    /// Its name in a recipe.
    pub fn name(self) -> &'static str {
        match self {
            Self::Pier => "pier",
            Self::Dam => "dam",
            Self::Harbour => "harbour",
            Self::Tank => "tank",
            Self::Pipeline => "pipeline",
            Self::NetPen => "net-pen",
        }
    }

    /// Whether it has a front that a vehicle passes.
    pub fn is_long(self) -> bool {
        match self {
            Self::Pier | Self::Dam | Self::Harbour | Self::Pipeline => true,
            Self::Tank | Self::NetPen => false,
        }
    }

    /// The part that things lean against and lie beside.
    pub fn part(self) -> &'static str {
        match self {
            Self::Pier => "pile",
            Self::Dam => "dam",
            Self::Harbour => "quay-wall",
            Self::Tank => "wall",
            Self::Pipeline => "pipeline",
            Self::NetPen => "net",
        }
    }

    /// The parts that it has.
    pub fn parts(self) -> &'static [&'static str] {
        match self {
            Self::Pier => &["beam", "brace", "deck", "fender", "ladder", "pile", "quay-wall"],
            Self::Dam => &["dam", "pipe", "trash-rack"],
            Self::Harbour => &["dolphin", "fender", "ladder", "quay-wall"],
            Self::Tank => &["wall"],
            Self::Pipeline => &["field-joint", "mattress", "pipeline"],
            Self::NetPen => &["collar", "mooring", "mooring-block", "net", "sinker-ring"],
        }
    }
}

impl Structure {
    pub fn of(asked: &Asked) -> Result<Option<Self>, Problem> {
        let Some(said) = &asked.wish.environment else { return Ok(None) };
        let Some(kind) = Kind::named(&said.value) else {
            let names: Vec<&str> = Kind::ALL.iter().map(|(name, _)| *name).collect();
            let what = format!("there is no structure `{}`", said.value);
            return Err(asked.problem(&said.source, what, format!("there are {}", names.join(", "))));
        };
        let sides = asked.wish.environment_m.as_ref();
        let side = |k: usize| sides.and_then(|sides| sides.value.get(k).copied());
        let sides_why = sides.map(|sides| asked.why(&sides.source)).unwrap_or_default();
        if let Some(wrong) = sides.filter(|sides| sides.value.iter().any(|side| !(*side > 0.0 && *side <= 500.0))) {
            let what = format!("a {} cannot have sides of {:?} m", kind.name(), wrong.value);
            return Err(asked.problem(&wrong.source, what, "write sides from 1 to 500 m"));
        }
        let said_m = [side(0), side(1), side(2)];
        Ok(Some(Self { kind, said_m, why: asked.why(&said.source), sides_why }))
    }

    /// Length, width and depth of a tank, metres.
    pub fn tank_m(&self) -> [f64; 3] {
        let [length, width, depth] = self.said_m;
        let long = length.unwrap_or(TANK_M[0]);
        let wide =
            width.unwrap_or_else(|| length.map_or(TANK_M[1], |length| (TANK_WIDTH * length * 10.0).round() / 10.0));
        // A small tank is not deep.
        let deep = depth.unwrap_or_else(|| TANK_M[2].min((0.5 * long.min(wide) * 10.0).round() / 10.0));
        [long, wide, deep]
    }

    /// Whether a pose refers to it or to a part of it.
    pub fn is_meant_by(&self, pose: &Pose) -> bool {
        let is_part = |name: &str| name == self.kind.name() || self.kind.parts().contains(&name);
        match pose {
            Pose::Leaning(None) => true,
            Pose::Leaning(Some(of)) | Pose::On(of) | Pose::Near { of, .. } => is_part(of),
            Pose::Rest | Pose::Settle | Pose::Float { .. } | Pose::Heap | Pose::Row(_) => false,
        }
    }

    /// Farthest that a vehicle may be from the middle, metres.
    pub fn room_m(&self) -> f64 {
        let [length, width, _] = self.tank_m();
        match self.kind {
            Kind::Tank => 0.5 * length.min(width) - ROOM_M,
            Kind::Harbour => self.said_m[1].map_or(f64::INFINITY, |width| 0.5 * width - ROOM_M),
            Kind::Pier | Kind::Dam | Kind::Pipeline | Kind::NetPen => f64::INFINITY,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kinds_are_the_recipes() {
        for (name, kind) in Kind::ALL {
            assert_eq!((Kind::named(name), kind.name()), (Some(kind), name));
            assert!(kind.parts().contains(&kind.part()), "{name}");
        }
    }

    #[test]
    fn a_pool_of_10_m() {
        let pool = |said_m| Structure { kind: Kind::Tank, said_m, why: String::new(), sides_why: String::new() };
        assert_eq!(pool([Some(10.0), None, None]).tank_m(), [10.0, 7.0, 3.5]);
        assert_eq!(pool([None; 3]).tank_m(), [12.0, 8.0, 4.0]);
        assert!((pool([Some(10.0), Some(6.0), None]).room_m() - 2.3).abs() < 1e-12);
    }
}
