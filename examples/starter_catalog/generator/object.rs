//! What an object of the catalog is: named parts, each of one material, and the words it is found by.

use glam::{DVec3, Vec3};

use super::solid::Solid;

/// One entry of the catalog.
#[derive(Clone, Debug)]
pub struct Object {
    /// Unique name, kebab-case; the file is named after it.
    pub uid: &'static str,
    /// What people call it.
    pub name: &'static str,
    /// Category in annotations.
    pub label: &'static str,
    /// Words it is found by besides its label, `;` between them.
    pub tags: &'static str,
    /// The first part's material is the main one.
    pub parts: Vec<Part>,
}

/// Solids of one material under one name. They may overlap.
#[derive(Clone, Debug)]
pub struct Part {
    pub name: &'static str,
    pub material: Material,
    pub solids: Vec<Solid>,
}

/// What a part is made of, for its echo.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Material {
    Steel,
    Aluminium,
    Iron,
    Concrete,
    Rock,
    Wood,
    Rubber,
    Glass,
    Ceramic,
    Plastic,
    Rope,
    Flesh,
    Plant,
}

impl Material {
    /// The acoustic material's name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Steel => "steel",
            Self::Aluminium => "aluminium",
            Self::Iron => "iron",
            Self::Concrete => "concrete",
            Self::Rock => "rock",
            Self::Wood => "wood",
            Self::Rubber => "rubber",
            Self::Glass => "glass",
            Self::Ceramic => "ceramic",
            Self::Plastic => "plastic",
            Self::Rope => "rope",
            Self::Flesh => "flesh",
            Self::Plant => "plant",
        }
    }

    /// Linear red, green, blue, and alpha for viewers.
    #[must_use]
    pub fn colour(self) -> [f32; 4] {
        match self {
            Self::Steel => [0.36, 0.38, 0.40, 1.0],
            Self::Aluminium => [0.66, 0.67, 0.69, 1.0],
            Self::Iron => [0.20, 0.15, 0.12, 1.0],
            Self::Concrete => [0.50, 0.49, 0.46, 1.0],
            Self::Rock => [0.27, 0.25, 0.23, 1.0],
            Self::Wood => [0.34, 0.21, 0.11, 1.0],
            Self::Rubber => [0.03, 0.03, 0.03, 1.0],
            Self::Glass => [0.10, 0.28, 0.14, 1.0],
            Self::Ceramic => [0.58, 0.27, 0.15, 1.0],
            Self::Plastic => [0.85, 0.27, 0.05, 1.0],
            Self::Rope => [0.52, 0.42, 0.26, 1.0],
            Self::Flesh => [0.55, 0.48, 0.45, 1.0],
            Self::Plant => [0.28, 0.33, 0.12, 1.0],
        }
    }

    /// Whether viewers should shade it as bare metal.
    #[must_use]
    pub fn metallic(self) -> f32 {
        match self {
            Self::Steel | Self::Aluminium | Self::Iron => 1.0,
            _ => 0.0,
        }
    }
}

impl Part {
    #[must_use]
    pub fn new(name: &'static str, material: Material, solids: impl Into<Vec<Solid>>) -> Self {
        Self { name, material, solids: solids.into() }
    }

    /// Every vertex of the part sent through `map`, which must not turn it inside out.
    #[must_use]
    pub fn mapped(mut self, map: impl Fn(DVec3) -> DVec3) -> Self {
        self.solids = self.solids.into_iter().map(|solid| solid.mapped(&map)).collect();
        self
    }
}

impl Object {
    /// Name of the model within the catalog's folder.
    #[must_use]
    pub fn file_name(&self) -> String {
        format!("{}.glb", self.uid)
    }

    /// The parts as they are written: glTF axes (x right, y up, z front), metres, the lowest point at height 0 and the
    /// middle of the bounding box above the origin.
    #[must_use]
    pub fn meshes(&self) -> Vec<Mesh> {
        let points = || self.parts.iter().flat_map(|part| &part.solids).flat_map(|solid| &solid.positions);
        let low = points().copied().reduce(DVec3::min).unwrap_or_default();
        let high = points().copied().reduce(DVec3::max).unwrap_or_default();
        let foot = DVec3::new((low.x + high.x) / 2.0, (low.y + high.y) / 2.0, low.z);
        self.parts
            .iter()
            .map(|part| {
                let mut mesh = Mesh { positions: Vec::new(), triangles: Vec::new() };
                for solid in &part.solids {
                    let first = mesh.positions.len() as u32;
                    mesh.triangles.extend(solid.triangles.iter().map(|t| t.map(|v| v + first)));
                    mesh.positions.extend(solid.positions.iter().map(|&p| {
                        let p = (p - foot).as_vec3();
                        Vec3::new(p.x, p.z, 0.0 - p.y)
                    }));
                }
                mesh
            })
            .collect()
    }

    /// Longest side of the bounding box, metres.
    #[must_use]
    pub fn size(&self) -> f32 {
        let meshes = self.meshes();
        let points = || meshes.iter().flat_map(|mesh| &mesh.positions).copied();
        let low = points().reduce(Vec3::min).unwrap_or_default();
        let high = points().reduce(Vec3::max).unwrap_or_default();
        (high - low).max_element()
    }
}

/// A part's triangles, ready to be written.
pub struct Mesh {
    pub positions: Vec<Vec3>,
    pub triangles: Vec<[u32; 3]>,
}
