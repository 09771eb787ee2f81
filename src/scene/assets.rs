//! Models and environments as meshes, each loaded once however many scenes and threads ask for it.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use super::environment::{Environment, EnvironmentSpec};
use super::mesh::Mesh;
use super::placement::Shape;
use super::seabed::{Raster, SeabedError};
use crate::catalog::{Asset, Catalog, CatalogError, Pick, find_catalog};
use crate::vehicle::{Track, TrackError};

/// A model of a catalog as a mesh: the middle of its base at the origin, metres.
#[derive(Debug)]
pub struct Solid {
    /// The surface.
    pub mesh: Arc<Mesh>,
    /// For each material slot of the mesh, a name in the table of materials.
    pub materials: Vec<String>,
    shape: OnceLock<Arc<Shape>>,
}

impl Solid {
    /// What placing needs to know of it; made on first use.
    pub(super) fn shape(&self) -> &Arc<Shape> {
        self.shape.get_or_init(|| Arc::new(Shape::new(&self.mesh)))
    }
}

/// What scenes are built from, and files of poses beside it.
#[derive(Debug)]
pub struct AssetCache {
    recipe_dir: PathBuf,
    catalogs: Slots<String, Catalog>,
    picks: Slots<String, Vec<Asset>>,
    solids: Slots<(String, String), Solid>,
    environments: Slots<(String, String, String), Environment>,
    rasters: Slots<String, Raster>,
    tracks: Tracks,
}

/// Files of poses, each read once; a copy shares what was read.
#[derive(Clone, Debug)]
pub struct Tracks {
    recipe_dir: PathBuf,
    slots: Arc<Slots<String, Track>>,
}

impl AssetCache {
    /// A cache that resolves catalogs and files from the recipe's folder.
    #[must_use]
    pub fn new(recipe_dir: &Path) -> Self {
        Self {
            recipe_dir: recipe_dir.to_path_buf(),
            catalogs: Slots::default(),
            picks: Slots::default(),
            solids: Slots::default(),
            environments: Slots::default(),
            rasters: Slots::default(),
            tracks: Tracks { recipe_dir: recipe_dir.to_path_buf(), slots: Arc::default() },
        }
    }

    /// The catalog of that name or folder.
    ///
    /// # Errors
    /// If there is none or its index is wrong.
    pub fn catalog(&self, name: &str) -> Result<Arc<Catalog>, CatalogError> {
        self.catalogs.get(name.into(), || Catalog::open(&find_catalog(name, &self.recipe_dir)?))
    }

    /// The models that a pick names.
    ///
    /// # Errors
    /// If the catalog is wrong or has no such model.
    pub fn pick(&self, pick: &Pick) -> Result<Arc<Vec<Asset>>, CatalogError> {
        self.picks.get(format!("{pick:?}"), || self.catalog(&pick.catalog)?.pick(pick))
    }

    /// A model of a catalog, scaled to its size.
    ///
    /// # Errors
    /// If the catalog, the uid or the model file is wrong or missing.
    pub fn solid(&self, catalog: &str, uid: &str) -> Result<Arc<Solid>, CatalogError> {
        self.solids.get((catalog.into(), uid.into()), || {
            let index = self.catalog(catalog)?;
            let asset = index.pick_uid(catalog, uid)?;
            let mesh = Mesh::from_parts(&asset.scaled_model()?.parts);
            let materials = mesh.materials.iter().map(|name| asset.material_of(name).into());
            Ok(Solid { materials: materials.collect(), mesh: Arc::new(mesh), shape: OnceLock::new() })
        })
    }

    /// The environment in a file, which is found from the recipe's folder.
    ///
    /// # Errors
    /// If the file or the sediment is wrong or missing.
    pub fn environment(&self, spec: &EnvironmentSpec, glb: &str) -> Result<Arc<Environment>, CatalogError> {
        let key = (glb.to_owned(), format!("{:?}", spec.labels), spec.sediment.clone());
        self.environments.get(key, || Environment::load(spec, &self.recipe_dir.join(glb)))
    }

    /// A height map; its file is found from the recipe's folder.
    ///
    /// # Errors
    /// If the file is missing or odd.
    pub fn raster(&self, file: &str) -> Result<Arc<Raster>, SeabedError> {
        self.rasters.get(file.into(), || Raster::load(&self.recipe_dir.join(file)))
    }

    /// The files of poses.
    #[must_use]
    pub fn tracks(&self) -> &Tracks {
        &self.tracks
    }
}

impl Tracks {
    /// The poses in a file, which is found from the recipe's folder.
    ///
    /// # Errors
    /// If the file is missing or odd.
    pub fn get(&self, file: &str) -> Result<Arc<Track>, TrackError> {
        self.slots.get(file.into(), || Track::load(&self.recipe_dir.join(file)))
    }
}

/// Values made on first use; while one is made, only those who want the same wait.
#[derive(Debug)]
struct Slots<K, V>(Mutex<BTreeMap<K, Slot<V>>>);

type Slot<V> = Arc<Mutex<Option<Arc<V>>>>;

impl<K, V> Default for Slots<K, V> {
    fn default() -> Self {
        Self(Mutex::new(BTreeMap::new()))
    }
}

impl<K: Ord, V> Slots<K, V> {
    fn get<E>(&self, key: K, make: impl FnOnce() -> Result<V, E>) -> Result<Arc<V>, E> {
        // A thread that panicked left its slot empty or full, never half: the locks stay usable.
        let slot = self.0.lock().unwrap_or_else(PoisonError::into_inner).entry(key).or_default().clone();
        let mut held = slot.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(value) = &*held {
            return Ok(value.clone());
        }
        let value = Arc::new(make()?);
        *held = Some(value.clone());
        Ok(value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_is_made_once_and_an_error_is_tried_again() {
        let slots: Slots<u8, u32> = Slots::default();
        assert_eq!(slots.get(1, || Err::<u32, _>("no")), Err("no"));
        let first = slots.get(1, || Ok::<_, &str>(7)).expect("made");
        let again = slots.get(1, || Err::<u32, _>("not asked")).expect("kept");
        assert!(Arc::ptr_eq(&first, &again));
    }
}
