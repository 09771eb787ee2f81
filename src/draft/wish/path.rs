//! How the vehicle moves, as somebody asked for it.

use super::{Amount, Said};

/// How the vehicle moves.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Path {
    /// The form of its way.
    pub route: Option<Said<Route>>,
    /// Height over the bottom, metres ("sonar 5 m above the seabed", "at 3 m altitude").
    pub altitude_m: Option<Said<Amount>>,
    /// Depth under the surface, metres ("the vehicle at 7 m").
    pub vehicle_depth_m: Option<Said<Amount>>,
    /// Distance between sonar and objects, metres ("at 3 m range").
    pub range_m: Option<Said<Amount>>,
    /// Metres a second.
    pub speed_m_s: Option<Said<Amount>>,
    /// Where it is: x east, y north, z up, metres.
    pub position_m: Option<Said<[f64; 3]>>,
    /// Places that it passes in this order: x east, y north, z up, metres.
    pub points_m: Option<Said<Vec<[f64; 3]>>>,
    /// How it sways and drifts.
    pub sway: Option<Said<Sway>>,
    /// Where it looks, degrees counter-clockwise from x (east): north is 90.
    pub heading_deg: Option<Said<f64>>,
}

/// How waves and current move the vehicle, root mean squares, as far as they were said.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sway {
    /// Degrees.
    pub roll_deg: Option<f64>,
    /// Degrees.
    pub pitch_deg: Option<f64>,
    /// Degrees.
    pub yaw_deg: Option<f64>,
    /// Metres, up and down.
    pub heave_m: Option<f64>,
    /// Metres, to the sides.
    pub drift_m: Option<f64>,
}

/// The form of a way.
#[derive(Clone, Debug, PartialEq)]
pub enum Route {
    /// Round the objects: over how many degrees, in how many stops ("from three sides"), where that is said.
    Orbit {
        /// Degrees.
        arc_deg: Option<f64>,
        /// Stops.
        sides: Option<u32>,
    },
    /// Parallel lines: sides of the area and distance between lines, metres, and how many lines, where that is said.
    Lawnmower {
        /// Along the lines.
        length_m: Option<f64>,
        /// Across them.
        width_m: Option<f64>,
        /// Between them.
        spacing_m: Option<f64>,
        /// How many.
        lines: Option<u32>,
    },
    /// Along a pipeline, a wall or straight ahead, for so many metres.
    Follow {
        /// The environment it follows, if it is one: `pipeline`, `pier`, `dam` …
        what: Option<String>,
        /// Metres.
        length_m: Option<f64>,
    },
    /// Straight towards the objects, from so far to so near, metres.
    Approach {
        /// Metres.
        from_m: Option<f64>,
        /// Metres.
        to_m: Option<f64>,
    },
    /// Each frame from another random side.
    Views,
    /// At one place.
    Hover,
    /// Down to so many metres under the surface, and back if so.
    Dive {
        /// Metres.
        depth_m: f64,
        /// Back up to where it began, after so many frames where that is said.
        back: Option<Option<u64>>,
    },
}
