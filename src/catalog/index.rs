//! The index of a catalog: `catalog.csv`, one line a model.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use csv::StringRecord;

use super::asset::{Asset, Up};
use super::disk::DiskIndex;
use super::error::CatalogError;
use super::home::Home;
use super::materials;
use super::overrides::Overrides;
use super::paths;
use super::priors::SizeFrom;

/// File name of the index.
pub(crate) const INDEX: &str = "catalog.csv";

/// Columns that every index has, in the order in which they are written.
pub const COLUMNS: [&str; 11] =
    ["uid", "name", "label", "tags", "path", "size_m", "up", "material", "licence", "attribution", "source"];

/// Columns that an index may have besides.
pub const MORE_COLUMNS: [&str; 4] = ["size_from", "triangles", "watertight", "problems"];

/// Largest side that a model may have, metres.
pub(crate) const MAX_SIZE_M: f64 = 1000.0;

/// A catalog: models that are listed in a `catalog.csv`, or a large collection behind an index of its own.
#[derive(Debug)]
pub struct Catalog {
    /// The folder.
    pub dir: PathBuf,
    /// In file order; none of a large collection, see [`Catalog::disk`].
    pub assets: Vec<Asset>,
    /// Places in `assets` by uid.
    by_uid: BTreeMap<String, usize>,
    /// The index of a large collection.
    disk: Option<DiskIndex>,
    overrides: Overrides,
}

impl Catalog {
    /// Reads the index of a folder. Model files are not touched: see [`Catalog::check`].
    ///
    /// # Errors
    /// A missing file or column, or the first wrong row, with file and line.
    pub fn open(dir: &Path) -> Result<Self, CatalogError> {
        let overrides = Overrides::read(dir)?;
        let root = Home::read(dir)?.root;
        let mut catalog =
            Self { dir: dir.to_path_buf(), assets: Vec::new(), by_uid: BTreeMap::new(), disk: None, overrides };
        if !dir.join(INDEX).is_file() && DiskIndex::is_in(dir) {
            catalog.disk = Some(DiskIndex::open(dir, &root)?);
            return Ok(catalog);
        }
        for (line, asset) in rows(&dir.join(INDEX), &root)? {
            let asset = catalog.overrides.applied(asset);
            if let Some(&earlier) = catalog.by_uid.get(&asset.uid) {
                let problem = format!(
                    "uid `{}` is already on line {}; give each its own",
                    asset.uid, catalog.assets[earlier].line
                );
                return Err(CatalogError::Row { path: dir.join(INDEX), line, problem });
            }
            catalog.by_uid.insert(asset.uid.clone(), catalog.assets.len());
            catalog.assets.push(asset);
        }
        catalog.overrides.check(|uid| catalog.by_uid.contains_key(uid))?;
        Ok(catalog)
    }

    /// Whether every listed model file is there, and inside the catalog.
    ///
    /// # Errors
    /// [`CatalogError::Row`] for the first that is not.
    pub fn check(&self) -> Result<(), CatalogError> {
        let wrong = |asset: &Asset, problem: String| CatalogError::Row {
            path: self.dir.join(INDEX),
            line: asset.line,
            problem: format!("`{}`: {problem}", asset.uid),
        };
        for asset in &self.assets {
            if !asset.path.is_file() {
                let file = asset.path.display();
                return Err(wrong(asset, format!("there is no {file}; put the model there or take the line out")));
            }
            asset.file().map_err(|error| wrong(asset, error.to_string()))?;
        }
        Ok(())
    }

    /// The index of a large collection, if this is one.
    #[must_use]
    pub fn disk(&self) -> Option<&DiskIndex> {
        self.disk.as_ref()
    }

    /// How many models there are.
    #[must_use]
    pub fn count(&self) -> u64 {
        self.disk.as_ref().map_or(self.assets.len() as u64, |disk| u64::from(disk.count()))
    }

    /// The model of a number, in the order of the index.
    ///
    /// # Errors
    /// If the index of a large collection cannot be read.
    pub fn asset(&self, number: u32) -> Result<Asset, CatalogError> {
        match &self.disk {
            None => Ok(self.assets[number as usize].clone()),
            Some(disk) => Ok(self.overrides.applied(disk.asset(number)?)),
        }
    }

    /// The model of that uid.
    ///
    /// # Errors
    /// If the index of a large collection cannot be read.
    pub fn get(&self, uid: &str) -> Result<Option<Asset>, CatalogError> {
        match &self.disk {
            None => Ok(self.by_uid.get(uid).map(|&place| self.assets[place].clone())),
            Some(disk) => disk.number(uid)?.map(|number| self.asset(number)).transpose(),
        }
    }
}

/// The rows of an index with their lines, checked one by one.
pub(crate) fn rows(index: &Path, root: &Path) -> Result<Vec<(u64, Asset)>, CatalogError> {
    let unreadable = |problem: String| CatalogError::Unreadable { path: index.to_path_buf(), problem };
    let text = fs::read(index).map_err(|e| unreadable(e.to_string()))?;
    let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(text.as_slice());
    let header = reader.headers().map_err(|e| unreadable(e.to_string()))?.clone();
    let columns = Columns::of(&header, index)?;
    let mut rows = Vec::new();
    for record in reader.records() {
        let record = record.map_err(|e| unreadable(e.to_string()))?;
        let line = record.position().map_or(0, csv::Position::line);
        let wrong = |problem: String| CatalogError::Row { path: index.to_path_buf(), line, problem };
        rows.push((line, columns.asset(&record, root, line).map_err(wrong)?));
    }
    Ok(rows)
}

/// Where each column stands.
struct Columns {
    needed: [usize; COLUMNS.len()],
    more: [Option<usize>; MORE_COLUMNS.len()],
}

impl Columns {
    fn of(header: &StringRecord, index: &Path) -> Result<Self, CatalogError> {
        let place = |column: &str| header.iter().position(|name| name.trim_start_matches('\u{feff}') == column);
        let mut needed = [0; COLUMNS.len()];
        for (slot, column) in needed.iter_mut().zip(COLUMNS) {
            *slot = place(column).ok_or_else(|| CatalogError::Column {
                path: index.to_path_buf(),
                column,
                columns: COLUMNS.join(","),
            })?;
        }
        Ok(Self { needed, more: MORE_COLUMNS.map(place) })
    }

    fn asset(&self, record: &StringRecord, root: &Path, line: u64) -> Result<Asset, String> {
        let [uid, name, label, tags, path, size_m, up, material, licence, attribution, source] =
            self.needed.map(|place| record.get(place).unwrap_or(""));
        let [size_from, triangles, watertight, problems] =
            self.more.map(|place| place.and_then(|place| record.get(place)).unwrap_or(""));
        if uid.is_empty() || label.is_empty() {
            return Err("uid and label must not be empty".into());
        }
        if !material.is_empty() {
            materials::material(material).map_err(|e| e.to_string())?;
        }
        let triangles = match triangles {
            "" => None,
            text => Some(text.parse().map_err(|_| format!("triangles `{text}` is no whole number"))?),
        };
        let tags = tags.split(';').map(str::trim).filter(|tag| !tag.is_empty()).map(super::text::clean).collect();
        let [uid, name, label, material, licence, attribution, source, problems] =
            [uid, name, label, material, licence, attribution, source, problems].map(super::text::clean);
        Ok(Asset {
            uid,
            name,
            label,
            tags,
            path: paths::inside(root, path)?,
            root: root.to_path_buf(),
            size_m: size(size_m)?,
            size_from: size_from_word(size_from)?,
            up: Up::of(up)?,
            material,
            parts: BTreeMap::new(),
            licence,
            attribution,
            source,
            triangles,
            watertight: watertight_word(watertight)?,
            problems,
            line,
        })
    }
}

/// A size in metres; none if it is left open.
pub(crate) fn size(text: &str) -> Result<Option<f64>, String> {
    if text.is_empty() {
        return Ok(None);
    }
    let size: f64 = text.parse().map_err(|_| format!("size_m `{text}` is no number"))?;
    if size > 0.0 && size <= MAX_SIZE_M {
        Ok(Some(size))
    } else {
        Err(format!("size_m {text} is not above 0 and up to {MAX_SIZE_M} metres"))
    }
}

fn size_from_word(text: &str) -> Result<SizeFrom, String> {
    let known = SizeFrom::ALL.into_iter().find(|from| from.name() == text);
    match (known, text) {
        (Some(from), _) => Ok(from),
        (None, "") => Ok(SizeFrom::Given),
        (None, other) => Err(format!("size_from `{other}` is none of given, file, prior, guessed")),
    }
}

fn watertight_word(text: &str) -> Result<Option<bool>, String> {
    match text {
        "" => Ok(None),
        "yes" => Ok(Some(true)),
        "no" => Ok(Some(false)),
        other => Err(format!("watertight `{other}` is neither yes nor no")),
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
            let model = opened.get(uid).expect("readable").expect("listed").scaled_model().expect("a sound file");
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
