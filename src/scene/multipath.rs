//! Mirrors for sound: the sea surface above a scene and a smooth bottom below it.

use glam::{DAffine3, DMat3, DVec3};
use serde::{Deserialize, Serialize};

use crate::math::Impossible;

/// Which mirrors a scene has; ghosts come from one bounce off each.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Multipath {
    /// The sea surface.
    pub surface: Option<Mirror>,
    /// A smooth floor, as tanks have; natural bottoms are too rough for it.
    pub bottom: Option<Mirror>,
}

/// A level plane that reflects.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Mirror {
    /// Height above z = 0, metres.
    pub height_m: f64,
    /// Pressure reflection coefficient where it is smooth, 0 to 1.
    pub reflection: f64,
    /// Rms height of its waves or bumps, metres.
    pub rough_m: f64,
}

impl Multipath {
    /// The mirrors, the surface first.
    pub fn mirrors(&self) -> impl Iterator<Item = Mirror> {
        self.surface.into_iter().chain(self.bottom)
    }

    /// Refuses mirrors that no water has.
    ///
    /// # Errors
    /// The first impossible figure, with its key below `surface` or `bottom`.
    pub fn validate(&self) -> Result<(), Impossible> {
        for mirror in self.mirrors() {
            Impossible::outside("height_m", mirror.height_m, -1000.0, 1000.0)?;
            Impossible::outside("reflection", mirror.reflection, 0.0, 1.0)?;
            Impossible::outside("rough_m", mirror.rough_m, 0.0, 30.0)?;
        }
        let heights = self.surface.zip(self.bottom).map(|(surface, bottom)| (surface.height_m, bottom.height_m));
        let in_order = heights.is_none_or(|(surface, bottom)| surface > bottom);
        Impossible::unless(in_order, "height_m", "the surface is not above the bottom", "swap the heights")
    }
}

impl Mirror {
    /// The world as it stands behind the mirror.
    #[must_use]
    pub fn image(&self) -> DAffine3 {
        DAffine3 {
            matrix3: DMat3::from_diagonal(DVec3::new(1.0, 1.0, -1.0)),
            translation: DVec3::new(0.0, 0.0, 2.0 * self.height_m),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_image_is_as_far_behind_the_mirror_as_its_thing_before_it() {
        let mirror = Mirror { height_m: 3.0, reflection: 1.0, rough_m: 0.0 };
        assert_eq!(mirror.image().transform_point3(DVec3::new(1.0, 2.0, 0.5)), DVec3::new(1.0, 2.0, 5.5));
    }

    #[test]
    fn a_surface_below_the_bottom_is_refused() {
        let mirror = |height_m| Some(Mirror { height_m, reflection: 1.0, rough_m: 0.0 });
        assert!(Multipath { surface: mirror(3.0), bottom: mirror(0.0) }.validate().is_ok());
        assert!(Multipath { surface: mirror(0.0), bottom: mirror(3.0) }.validate().is_err());
    }
}
