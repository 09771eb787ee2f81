//! A scene as it grows: instances, bodies by number, and each material once.

use std::sync::Arc;

use glam::{DAffine3, DVec3};

use super::SceneError;
use crate::catalog::CatalogError;
use crate::catalog::materials::{material, sediment};
use crate::math::real::radians;
use crate::physics::lambert::{MAX_LAMBERT_MU, lambert_mu};
use crate::physics::reflection::normal_incidence;
use crate::scene::environment::Surface;
use crate::scene::{Body, Instance, Material, Mesh, Scene};

/// Specific impedance of sea water, kg/(m²·s).
const SEA_WATER_IMPEDANCE: f64 = 1.539e6;

/// A scene that is being put together.
#[derive(Default)]
pub(super) struct Builder {
    pub scene: Scene,
}

impl Builder {
    /// Adds an instance of a mesh.
    pub fn add(
        &mut self,
        mesh: Arc<Mesh>,
        world_from_mesh: DAffine3,
        body: u16,
        surfaces: &[Surface],
    ) -> Result<(), CatalogError> {
        let materials = surfaces.iter().map(|surface| self.material(surface)).collect::<Result<_, _>>()?;
        self.scene.instances.push(Instance { mesh, world_from_mesh, body, materials });
        Ok(())
    }

    /// Number of a new body.
    pub fn body(
        &mut self,
        label: &str,
        asset: String,
        mesh: &Mesh,
        world_from_mesh: &DAffine3,
    ) -> Result<u16, SceneError> {
        let vertices: Vec<DVec3> = mesh.vertices().map(|v| world_from_mesh.transform_point3(v.as_dvec3())).collect();
        let nothing = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let (low, high) = vertices.iter().fold(nothing, |(low, high), p| (low.min(*p), high.max(*p)));
        let (centre, radius) = (0.5 * (low + high), 0.5 * (high - low).length());
        self.scene.bodies.push(Body { label: label.into(), asset, centre, radius });
        let count = self.scene.bodies.len();
        u16::try_from(count).map_err(|_| SceneError::TooManyBodies { count })
    }

    fn material(&mut self, surface: &Surface) -> Result<u16, CatalogError> {
        let wanted = match surface {
            Surface::Sediment(name) => {
                let sediment = sediment(name)?;
                let facts = Facts { density: sediment.density, speed: sediment.speed, slope_deg: sediment.slope_deg };
                facts.material(name, sediment.lambert_db, Some(sediment.texture_nu))
            }
            Surface::Material(name) => {
                let material = material(name)?;
                let facts = Facts { density: material.density, speed: material.speed, slope_deg: material.slope_deg };
                facts.material(name, material.lambert_db, None)
            }
        };
        let known = self.scene.materials.iter().position(|material| *material == wanted);
        let number = known.unwrap_or_else(|| {
            self.scene.materials.push(wanted);
            self.scene.materials.len() - 1
        });
        // The tables have fewer entries than 16 bits can number.
        Ok(number as u16)
    }
}

/// What sediments and materials have in common.
struct Facts {
    density: f64,
    speed: f64,
    slope_deg: f64,
}

impl Facts {
    /// Reflects what its impedance does against sea water, as far as the diffuse part leaves power for it.
    fn material(&self, name: &str, lambert_db: f64, texture_nu: Option<f64>) -> Material {
        // The tables are checked when they are read, so nothing is cut off here.
        let mu = lambert_mu(lambert_db).unwrap_or(MAX_LAMBERT_MU);
        let r = normal_incidence(SEA_WATER_IMPEDANCE, self.density * self.speed);
        let reflectivity = r * r;
        let reflected = reflectivity.min(1.0 - std::f64::consts::PI * mu).max(0.0);
        let slope_rad = radians(self.slope_deg);
        Material { name: name.into(), lambert_mu: mu, reflected, reflectivity, slope_rad, texture_nu }
    }
}
