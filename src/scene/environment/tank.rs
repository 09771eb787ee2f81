//! A test tank: four smooth walls and a floor.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::EnvironmentError;
use super::kinds::{material, within};
use super::solid::Solid;
use super::structure::{Bottom, Structure};

/// A basin about the world's origin, its floor at z = 0; a recipe's seabed takes the floor's place.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Tank {
    /// Inside, along x, metres.
    pub length_m: f64,
    /// Inside, along y, metres.
    pub width_m: f64,
    /// Of the walls above the floor, metres.
    pub depth_m: f64,
    /// What walls and floor are made of.
    pub material: String,
}

impl Tank {
    pub(super) const PARTS: &'static [&'static str] = &["wall"];

    pub(super) fn check(&self) -> Result<(), EnvironmentError> {
        within("length_m", self.length_m, [1.0, 500.0])?;
        within("width_m", self.width_m, [1.0, 500.0])?;
        within("depth_m", self.depth_m, [0.5, 100.0])?;
        material(&self.material)
    }

    pub(super) fn raise(&self, structure: &mut Structure) {
        const THICK: f64 = 0.4;
        let (x, y) = (0.5 * self.length_m, 0.5 * self.width_m);
        let block = |low: [f64; 2], high: [f64; 2]| {
            Solid::block(DVec3::new(low[0], low[1], -THICK), DVec3::new(high[0], high[1], self.depth_m))
        };
        if structure.site.bottom == Bottom::Nothing {
            let floor = Solid::block(DVec3::new(-x, -y, -THICK), DVec3::new(x, y, 0.0));
            structure.floor(&self.material, floor);
        }
        for wall in [
            block([x, -y], [x + THICK, y]),
            block([-x - THICK, -y], [-x, y]),
            block([-x - THICK, y], [x + THICK, y + THICK]),
            block([-x - THICK, -y - THICK], [x + THICK, -y]),
        ] {
            structure.part("wall", &self.material, &[wall]);
        }
    }
}
