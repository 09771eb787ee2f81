//! The index of a catalog: `catalog.csv`, one line a model.

use std::fs;
use std::path::{Component, Path, PathBuf};

use csv::StringRecord;
use serde::{Deserialize, Serialize};

use super::error::CatalogError;
use super::glb::load_model_in;
use super::materials;
use super::model::Model;

/// File name of the index.
pub(crate) const INDEX: &str = "catalog.csv";

/// Columns of the index, in the order in which they are written.
pub const COLUMNS: [&str; 11] =
    ["uid", "name", "label", "tags", "path", "size_m", "up", "material", "licence", "attribution", "source"];

/// Largest side that a model may have, metres.
const MAX_SIZE_M: f64 = 1000.0;

/// A catalog: its models in file order.
#[derive(Clone, Debug, PartialEq)]
pub struct Catalog {
    /// The folder.
    pub dir: PathBuf,
    /// In file order.
    pub assets: Vec<Asset>,
}

/// One model of a catalog.
#[derive(Clone, Debug, PartialEq)]
pub struct Asset {
    /// Unique in its catalog.
    pub uid: String,
    /// For people.
    pub name: String,
    /// Category that it is annotated with unless the recipe says otherwise.
    pub label: String,
    /// Words to pick it by.
    pub tags: Vec<String>,
    /// The catalog's folder, which the model and its buffers must lie in.
    pub dir: PathBuf,
    /// The model file, the catalog's folder included.
    pub path: PathBuf,
    /// Longest side of the bounding box, metres.
    pub size_m: f64,
    /// Which axis of the file's frame points up.
    pub up: Up,
    /// Material where the file's own material names say nothing; empty if not given.
    pub material: String,
    /// Licence, as its source states it.
    pub licence: String,
    /// Whom to name.
    pub attribution: String,
    /// Where it comes from.
    pub source: String,
    /// Line in the index, from 1.
    pub line: u64,
}

/// Which axis of a model file's frame points up.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Up {
    /// As glTF wants it.
    #[default]
    Y,
    /// As many converters leave it.
    Z,
}

impl Catalog {
    /// Reads `catalog.csv` of a folder. Model files are not touched: see [`Catalog::check`].
    ///
    /// # Errors
    /// A missing file or column, or the first wrong row, with file and line.
    pub fn open(dir: &Path) -> Result<Self, CatalogError> {
        let index = dir.join(INDEX);
        let unreadable = |problem: String| CatalogError::Unreadable { path: index.clone(), problem };
        let text = fs::read(&index).map_err(|e| unreadable(e.to_string()))?;
        let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(text.as_slice());
        let header = reader.headers().map_err(|e| unreadable(e.to_string()))?.clone();
        let columns = Columns::of(&header, &index)?;
        let mut assets: Vec<Asset> = Vec::new();
        for record in reader.records() {
            let record = record.map_err(|e| unreadable(e.to_string()))?;
            let line = record.position().map_or(0, csv::Position::line);
            let wrong = |problem: String| CatalogError::Row { path: index.clone(), line, problem };
            let asset = columns.asset(&record, dir, line).map_err(wrong)?;
            if let Some(earlier) = assets.iter().find(|earlier| earlier.uid == asset.uid) {
                return Err(wrong(format!(
                    "uid `{}` is already on line {}; give each its own",
                    asset.uid, earlier.line
                )));
            }
            assets.push(asset);
        }
        Ok(Self { dir: dir.to_path_buf(), assets })
    }

    /// Whether every model file is there.
    ///
    /// # Errors
    /// [`CatalogError::Row`] for the first that is not.
    pub fn check(&self) -> Result<(), CatalogError> {
        match self.assets.iter().find(|asset| !asset.path.is_file()) {
            None => Ok(()),
            Some(asset) => Err(CatalogError::Row {
                path: self.dir.join(INDEX),
                line: asset.line,
                problem: format!(
                    "`{}`: there is no {}; put the model there or take the line out",
                    asset.uid,
                    asset.path.display()
                ),
            }),
        }
    }

    /// The asset of that uid.
    #[must_use]
    pub fn get(&self, uid: &str) -> Option<&Asset> {
        self.assets.iter().find(|asset| asset.uid == uid)
    }
}

impl Asset {
    /// The model, up turned to z, scaled so that its longest side is `size_m`, the middle of its base at the origin.
    ///
    /// # Errors
    /// As [`load_model_in`].
    pub fn scaled_model(&self) -> Result<Model, CatalogError> {
        let mut model = load_model_in(&self.dir, &self.path)?;
        if self.up == Up::Z {
            // The loader took y for up: back to the file's own axes.
            model.map(|p| glam::Vec3::new(p.x, p.z, -p.y));
        }
        model.rest_at_origin(self.size_m);
        Ok(model)
    }
}

/// Where each column stands.
struct Columns([usize; COLUMNS.len()]);

impl Columns {
    fn of(header: &StringRecord, index: &Path) -> Result<Self, CatalogError> {
        let mut places = [0; COLUMNS.len()];
        for (place, column) in places.iter_mut().zip(COLUMNS) {
            *place = header.iter().position(|name| name.trim_start_matches('\u{feff}') == column).ok_or_else(|| {
                CatalogError::Column { path: index.to_path_buf(), column, columns: COLUMNS.join(",") }
            })?;
        }
        Ok(Self(places))
    }

    fn asset(&self, record: &StringRecord, dir: &Path, line: u64) -> Result<Asset, String> {
        let [uid, name, label, tags, path, size_m, up, material, licence, attribution, source] =
            self.0.map(|place| record.get(place).unwrap_or(""));
        if uid.is_empty() || label.is_empty() {
            return Err("uid and label must not be empty".into());
        }
        let relative = Path::new(path);
        if path.is_empty()
            || relative.components().any(|part| !matches!(part, Component::Normal(_) | Component::CurDir))
        {
            return Err(format!("path `{path}` leaves the catalog's folder; models live inside it"));
        }
        let size: f64 = size_m.parse().map_err(|_| format!("size_m `{size_m}` is no number"))?;
        if !(size > 0.0 && size <= MAX_SIZE_M) {
            return Err(format!("size_m {size_m} is not above 0 and up to {MAX_SIZE_M} metres"));
        }
        let up = match up {
            "" | "y" => Up::Y,
            "z" => Up::Z,
            other => return Err(format!("up `{other}` is neither y nor z")),
        };
        if !material.is_empty() {
            materials::material(material).map_err(|e| e.to_string())?;
        }
        let tags = tags.split(';').map(str::trim).filter(|tag| !tag.is_empty()).map(String::from).collect();
        let [uid, name, label, material, licence, attribution, source] =
            [uid, name, label, material, licence, attribution, source].map(String::from);
        let (dir, path) = (dir.to_path_buf(), dir.join(relative));
        Ok(Asset { uid, name, label, tags, dir, path, size_m: size, up, material, licence, attribution, source, line })
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use serde_json::json;

    use super::*;
    use crate::catalog::glb::tests::{glb, shared, tire};

    pub(crate) const HEADER: &str = "uid,name,label,tags,path,size_m,up,material,licence,attribution,source\n";

    pub(crate) fn catalog(rows: &str) -> (tempfile::TempDir, Result<Catalog, CatalogError>) {
        let folder = tempfile::tempdir().expect("a temporary folder");
        fs::write(folder.path().join(INDEX), rows).expect("write");
        let opened = Catalog::open(folder.path());
        (folder, opened)
    }

    #[test]
    fn a_tire_gets_its_size_and_stands_on_its_base() {
        let rows = format!(
            "{HEADER}flat,Tire,tire,tire;round,tire.glb,0.65,y,rubber,CC0,nobody,here\n\
             up,Tire,tire,tire,tire.glb,0.65,z,rubber,CC0,nobody,here\n"
        );
        let (folder, opened) = catalog(&rows);
        fs::write(
            folder.path().join("tire.glb"),
            glb(&tire(2.0, 0.3), json!([{"mesh": 0, "translation": [9, 8, 7]}]), |_| ()),
        )
        .expect("write");
        let opened = opened.expect("a sound index");
        opened.check().expect("the file is there");
        // Lying flat with y up: 0.65 across, 0.6 / 2 of that high; with z up it stands on its tread.
        for (uid, size) in [("flat", [0.65, 0.65, 0.195]), ("up", [0.65, 0.195, 0.65])] {
            let model = opened.get(uid).expect("listed").scaled_model().expect("a sound file");
            let (low, high) = model.bounds().expect("triangles");
            let sizes = (high - low).to_array();
            assert!(sizes.iter().zip(size).all(|(a, b)| (a - b).abs() < 1e-4), "{uid}: {sizes:?}");
            assert!(low.z.abs() < 1e-6 && (low.x + high.x).abs() < 1e-6 && (low.y + high.y).abs() < 1e-6);
        }
    }

    #[test]
    fn wrong_rows_name_file_and_line() {
        let good = "a,A,tire,t,a.glb,1,y,,l,a,s\n";
        let cases = [
            (format!("{HEADER}{good}{good}"), "catalog.csv:3: uid `a` is already on line 2"),
            (format!("{HEADER}a,A,tire,t,a.glb,big,y,,l,a,s\n"), "catalog.csv:2: size_m `big`"),
            (format!("{HEADER}a,A,tire,t,a.glb,0,y,,l,a,s\n"), "size_m 0"),
            (format!("{HEADER}a,A,tire,t,a.glb,1001,y,,l,a,s\n"), "size_m 1001"),
            (format!("{HEADER}a,A,tire,t,a.glb,NaN,y,,l,a,s\n"), "size_m NaN"),
            (format!("{HEADER}a,A,tire,t,../a.glb,1,y,,l,a,s\n"), "leaves the catalog's folder"),
            (format!("{HEADER}a,A,tire,t,/a.glb,1,y,,l,a,s\n"), "leaves the catalog's folder"),
            (format!("{HEADER}a,A,tire,t,a.glb,1,x,,l,a,s\n"), "neither y nor z"),
            (format!("{HEADER}a,A,tire,t,a.glb,1,y,rubbr,l,a,s\n"), "did you mean `rubber`"),
            (format!("{HEADER}a,A,tire\n"), "catalog.csv"),
            ("uid,name\n".into(), "no column `label`"),
        ];
        for (rows, expected) in cases {
            let error = catalog(&rows).1.expect_err(expected).to_string();
            assert!(error.contains(expected), "{error}");
        }
        let error = catalog(&format!("{HEADER}{good}")).1.expect("sound").check().expect_err("no file").to_string();
        assert!(error.contains("catalog.csv:2") && error.contains("a.glb"), "{error}");
        let error = Catalog::open(Path::new("nowhere")).expect_err("no folder").to_string();
        assert!(error.contains("a catalog is a folder with a catalog.csv"), "{error}");
    }

    #[test]
    fn the_shared_models_load_through_an_index() {
        let Some(models) = shared("models") else { return };
        let mut rows = String::from(HEADER);
        let folder = tempfile::tempdir().expect("a temporary folder");
        for row in csv::Reader::from_path(models.join("models.csv")).expect("the table").records() {
            let row = row.expect("a row");
            fs::copy(models.join(&row[0]), folder.path().join(&row[0])).expect("copy");
            rows += &format!("{0},{1},{1},{1},{0},1.5,y,,l,a,s\n", &row[0], &row[2]);
        }
        fs::write(folder.path().join(INDEX), rows).expect("write");
        let catalog = Catalog::open(folder.path()).expect("a sound index");
        assert_eq!(catalog.assets.len(), 51);
        for asset in &catalog.assets {
            let (low, high) = asset.scaled_model().expect("a sound file").bounds().expect("triangles");
            assert!(
                ((high - low).max_element() - 1.5).abs() < 1e-4 && low.z.abs() < 1e-5,
                "{}: {low} {high}",
                asset.uid
            );
        }
    }
}
