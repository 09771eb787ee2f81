//! How far off, how high and how tilted a sonar is held, so that things are in its beam.

use super::asked::Figure;
use crate::draft::infer::sight::{
    LEAST_ALTITUDE_M, STEEPEST_DEG, Sight, USABLE, altitude_m, disc_in_fan_m, fan_distance_m, plan_m, reach_of_tilt_m,
    round,
};
use crate::draft::wish::Amount;
use crate::math::real::{radians, tan};

/// Distance over the radius of the field of things: its near and far edge are then seen in one beam of 20°.
const FIELD: f64 = 2.0;
/// Steepest view down that a distance is chosen for, degrees.
const STEEP_DEG: f64 = 45.0;
/// Part of the distance that the field may take where it has to be smaller.
const CROWDED: f64 = 0.5;
/// Steps outwards, each by a tenth, until everything is in the beam; where these do not suffice the field becomes smaller.
const STEPS: u32 = 4;
const SMALLER: f64 = 0.9;
const SMALLER_STEPS: u32 = 8;
/// What is not said is varied by this part to either side, from scene to scene.
pub(super) const VARIED: f64 = 0.12;

/// What the view of a scene must suit.
#[derive(Clone, Debug)]
pub(super) struct Terms<'a> {
    /// From sonar to things by sound, as somebody said.
    pub range: Option<&'a Amount>,
    /// As somebody said, or as it follows from what was said.
    pub altitude: Option<&'a Figure>,
    /// As somebody said.
    pub tilt: Option<&'a Amount>,
    /// Distance that suits the largest thing.
    pub natural_m: f64,
    /// Half its longest side.
    pub half_m: f64,
    /// Radius of the disc on which things are.
    pub field_m: f64,
    /// Heights of their middles over the bottom.
    pub heights_m: [f64; 2],
    /// Of the sonar's beam.
    pub vertical_deg: f64,
    /// Of its fan.
    pub azimuth_deg: f64,
    /// Farthest that the sonar may be.
    pub most_m: f64,
    /// Highest that it may be.
    pub ceiling_m: f64,
}

/// A view.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct View {
    /// In plan, from the sonar to the middle of the things, metres.
    pub distance_m: Amount,
    /// Over the bottom.
    pub altitude: Figure,
    /// Degrees.
    pub tilt_deg: f64,
    /// Radius of the disc on which things are, metres.
    pub field_m: f64,
    /// Where they are.
    pub sight: Sight,
    /// Whether all of it is in the beam at once.
    pub holds: bool,
}

impl Terms<'_> {
    fn middle_m(&self) -> f64 {
        0.5 * (self.heights_m[0] + self.heights_m[1])
    }

    /// The view, or why there is none: things are farther down than they may be away.
    pub fn view(&self) -> Result<View, String> {
        match self.range {
            Some(range) => self.at_range(range),
            None => Ok(self.anywhere()),
        }
    }

    /// At a distance that was said: exactly so far by sound from the middle of the things.
    fn at_range(&self, range: &Amount) -> Result<View, String> {
        let [near, far] = range.ends();
        let altitude = self.altitude_at(near.min(self.most_m));
        let below = altitude.amount.ends().map(|altitude| altitude - self.middle_m());
        let steepest = if below[1].abs() > below[0].abs() { below[1] } else { below[0] };
        let plan = |slant: f64| plan_m(slant, steepest);
        let (Some(low), Some(high)) = (plan(near), plan(far)) else {
            return Err(format!(
                "things cannot be {near} m from a sonar that is {:.1} m {} them",
                steepest.abs(),
                if steepest > 0.0 { "above" } else { "below" }
            ));
        };
        let distance_m = match range {
            Amount::Exactly(_) => Amount::Exactly(exact(low)),
            _ => Amount::Between(exact(low), exact(high)),
        };
        Ok(self.with(distance_m, altitude))
    }

    /// At a distance that suits the things, farther where they would not be in the beam.
    fn anywhere(&self) -> View {
        let fan_m = fan_distance_m(self.field_m, self.azimuth_deg);
        let mut distance = self.natural_m.max(FIELD * self.field_m + self.half_m).max(fan_m);
        if let Some(altitude) = self.altitude {
            let below = (altitude.amount.ends()[1] - self.middle_m()).abs();
            distance = distance.max(below / tan(radians(STEEP_DEG)));
            let tilted = self.tilt.and_then(|tilt| reach_of_tilt_m(middle(tilt), below));
            distance = tilted.unwrap_or(distance);
        }
        distance = distance.min(self.most_m);
        let fixed = self.tilt.is_some() && self.altitude.is_some();
        let mut view = self.with(Amount::Exactly(round(distance)), self.altitude_at(distance));
        for _ in 0..STEPS {
            let wider = 1.1 * distance;
            if view.holds || fixed || wider > self.most_m {
                break;
            }
            distance = wider;
            view = self.with(Amount::Exactly(round(distance)), self.altitude_at(distance));
        }
        let mut closer = self.clone();
        for _ in 0..SMALLER_STEPS {
            if view.holds || fixed {
                break;
            }
            closer.field_m *= SMALLER;
            view = closer.with(view.distance_m, view.altitude);
        }
        view
    }

    /// The altitude that was said, that a tilt asks for, or that suits a distance.
    fn altitude_at(&self, distance_m: f64) -> Figure {
        if let Some(said) = self.altitude {
            return said.clone();
        }
        let bounded = |altitude: f64| round(altitude.min(self.ceiling_m).max(LEAST_ALTITUDE_M));
        match self.tilt.map(middle).filter(|tilt| *tilt < -1.0) {
            Some(tilt) => {
                let altitude = self.middle_m() + distance_m * tan(radians(-tilt.max(-STEEPEST_DEG)));
                Figure::assumed(Amount::Exactly(bounded(altitude)), "the tilt looks at the objects from there")
            }
            None => {
                let altitude = bounded(0.5 * self.middle_m() + altitude_m(distance_m));
                Figure::assumed(
                    Amount::Exactly(altitude),
                    "sound comes in at 20 degrees or so: bright faces, long shadows",
                )
            }
        }
    }

    fn with(&self, distance_m: Amount, altitude: Figure) -> View {
        let [near, far] = distance_m.ends();
        let field_m = self.field_m.min(CROWDED * near).min(disc_in_fan_m(near, self.azimuth_deg));
        let [low_m, high_m] = self.heights_m;
        let sight = Sight { near_m: (near - field_m).max(0.2), far_m: far + field_m, low_m, high_m };
        let ends = altitude.amount.ends().map(|altitude| sight.elevations_deg(altitude));
        let (low, high) = (ends[0][0].min(ends[1][0]), ends[0][1].max(ends[1][1]));
        let tilt_deg = (0.5 * (low + high)).round().clamp(-STEEPEST_DEG, STEEPEST_DEG);
        let holds = high - low <= USABLE * self.vertical_deg;
        View { distance_m, altitude, tilt_deg, field_m, sight, holds }
    }
}

/// A length to the millimetre.
fn exact(value: f64) -> f64 {
    (value * 1000.0).round() / 1000.0
}

fn middle(amount: &Amount) -> f64 {
    let [low, high] = amount.ends();
    0.5 * (low + high)
}

/// What nobody said, varied from scene to scene.
pub(super) fn varied(amount: &Amount) -> Amount {
    match amount {
        Amount::Exactly(value) => Amount::Between(round(value * (1.0 - VARIED)), round(value * (1.0 + VARIED))),
        other => other.clone(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn terms<'a>() -> Terms<'a> {
        Terms {
            range: None,
            altitude: None,
            tilt: None,
            natural_m: 5.0,
            half_m: 0.3,
            field_m: 1.5,
            heights_m: [0.1, 0.3],
            vertical_deg: 20.0,
            azimuth_deg: 130.0,
            most_m: 30.0,
            ceiling_m: 9.0,
        }
    }

    #[test]
    fn a_said_range_is_the_way_of_sound() {
        let (range, altitude) = (Amount::Exactly(3.0), Figure::assumed(Amount::Exactly(1.2), ""));
        let view = Terms { range: Some(&range), altitude: Some(&altitude), ..terms() }.view().expect("possible");
        let plan = view.distance_m.ends()[0];
        assert!(((plan * plan + 1.0_f64).sqrt() - 3.0).abs() < 1e-3, "{plan}");
        let high = Figure::assumed(Amount::Exactly(5.0), "");
        let why = Terms { range: Some(&range), altitude: Some(&high), ..terms() }.view().expect_err("too high");
        assert_eq!(why, "things cannot be 3 m from a sonar that is 4.8 m above them");
    }

    #[test]
    fn the_field_is_in_the_beam() {
        let view = terms().view().expect("possible");
        assert!(view.holds && view.field_m == 1.5, "{view:?}");
        assert!((-30.0..-15.0).contains(&view.tilt_deg), "{view:?}");
        let narrow = Terms { azimuth_deg: 30.0, ..terms() }.view().expect("possible");
        assert!(narrow.distance_m.ends()[0] >= 6.4, "{narrow:?}");
        // In a small tank the field is smaller.
        let tank = Terms { most_m: 2.0, field_m: 3.0, ..terms() }.view().expect("possible");
        assert!(tank.distance_m == Amount::Exactly(2.0) && tank.field_m == 1.0, "{tank:?}");
    }

    #[test]
    fn a_said_tilt_meets_the_things() {
        let (tilt, altitude) = (Amount::Exactly(-45.0), Figure::assumed(Amount::Exactly(2.2), ""));
        let view = Terms { tilt: Some(&tilt), altitude: Some(&altitude), ..terms() }.view().expect("possible");
        assert_eq!(view.distance_m, Amount::Exactly(2.0));
    }
}
