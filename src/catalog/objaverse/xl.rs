//! Annotations of Objaverse-XL: Parquet tables of where objects come from, with the places where downloads end up.
//!
//! Only glTF models are kept: nothing else can be read. Source: the `objaverse` package 0.1.7 on PyPI, modules `xl.*`.

use std::fs::File;
use std::path::{Path, PathBuf};

use parquet::file::reader::{FileReader as _, SerializedFileReader};
use parquet::record::{Field, Row};
use parquet::schema::types::Type;
use uuid::Uuid;

use super::super::disk::{Batch, Record};
use super::super::error::CatalogError;
use super::super::licence::Licence;
use super::super::text::clean;
use super::super::{concepts, paths};
use super::{Gathered, object_paths, record};

/// Folders of annotations.
const SOURCES: [&str; 4] = ["github", "sketchfab", "smithsonian", "thingiverse"];

/// Records of one batch.
const BATCH: usize = 20_000;

/// Whether a folder holds annotations of Objaverse-XL.
#[must_use]
pub fn is_in(dir: &Path) -> bool {
    sources(dir).is_ok_and(|files| !files.is_empty())
}

/// The tables of annotations.
///
/// # Errors
/// Never, as a folder that cannot be read holds none.
pub fn sources(dir: &Path) -> Result<Vec<PathBuf>, CatalogError> {
    let folders = SOURCES.iter().filter_map(|source| dir.join(source).read_dir().ok()).flatten().flatten();
    let files = folders.map(|entry| entry.path()).filter(|path| path.extension().is_some_and(|e| e == "parquet"));
    let mut files: Vec<PathBuf> = files.collect();
    files.sort();
    Ok(files)
}

/// Reads all annotations.
///
/// # Errors
/// If a path leads out of the folder; tables that are broken are told of in [`Gathered::problems`].
pub fn gather(dir: &Path) -> Result<Gathered, CatalogError> {
    let mut gathered = Gathered::default();
    let sketchfab = dir.join(super::HOME);
    let known = if sketchfab.join(super::PATHS).is_file() {
        object_paths(&sketchfab, &mut gathered.problems)?
    } else {
        Vec::new()
    };
    for file in sources(dir)? {
        let mut table = Table { dir, known: &known, batch: Batch::default(), left_out: 0, gathered: &mut gathered };
        if let Err(problem) = table.read(&file) {
            let told = format!("{}: cannot be read whole: {problem}; download it again", file.display());
            table.gathered.problems.push(told);
        }
        let left_out = table.left_out;
        table.close();
        if left_out > 0 {
            gathered
                .problems
                .push(format!("{}: {left_out} objects are no glTF models and are left out", file.display()));
        }
    }
    Ok(gathered)
}

struct Table<'a> {
    dir: &'a Path,
    known: &'a [(Box<str>, Box<str>)],
    batch: Batch,
    left_out: u64,
    gathered: &'a mut Gathered,
}

impl Table<'_> {
    fn read(&mut self, file: &Path) -> Result<(), String> {
        let text = |e: &dyn std::fmt::Display| e.to_string();
        let reader = SerializedFileReader::new(File::open(file).map_err(|e| text(&e))?).map_err(|e| text(&e))?;
        let wanted = ["fileIdentifier", "source", "license", "fileType", "metadata"];
        let schema = reader.metadata().file_metadata().schema();
        let fields = schema.get_fields().iter().filter(|field| wanted.contains(&field.name())).cloned().collect();
        let projection = Type::group_type_builder(schema.name()).with_fields(fields).build().map_err(|e| text(&e))?;
        for row in reader.get_row_iter(Some(projection)).map_err(|e| text(&e))? {
            self.row(&row.map_err(|e| text(&e))?);
        }
        Ok(())
    }

    fn row(&mut self, row: &Row) {
        let cell = |name: &str| {
            let field = row.get_column_iter().find(|(column, _)| *column == name).map(|(_, field)| field);
            match field {
                Some(Field::Str(text)) => text.clone(),
                _ => String::new(),
            }
        };
        let (identifier, source, kind) = (cell("fileIdentifier"), cell("source"), cell("fileType").to_lowercase());
        let (uid, path) = self.place(&identifier, &source);
        let is_model = matches!(kind.trim_start_matches('.'), "glb" | "gltf");
        if !is_model || paths::inside(self.dir, &path).is_err() {
            self.left_out += 1;
            return;
        }
        let metadata: serde_json::Value = serde_json::from_str(&cell("metadata")).unwrap_or_default();
        let told =
            |keys: &[&str]| keys.iter().find_map(|key| metadata.get(*key)?.as_str()).map(clean).unwrap_or_default();
        let file = identifier.rsplit('/').next().unwrap_or_default();
        let name = Some(told(&["name", "title"])).filter(|name| !name.is_empty());
        let name = name
            .unwrap_or_else(|| clean(&file.rsplit_once('.').map_or(file, |(stem, _)| stem).replace(['_', '-'], " ")));
        let record = Record {
            label: concepts::concepts().label_in(&name).unwrap_or("object").to_owned(),
            licence: Licence::read(&cell("license")).id,
            author: told(&["author", "creator", "user", "authorName"]),
            source: clean(&identifier),
            uid,
            name,
            path,
            ..Record::default()
        };
        self.gathered.counts.described += 1;
        self.gathered.counts.on_disk += u64::from(self.dir.join(&record.path).is_file());
        record::add(&mut self.batch, &record);
        if self.batch.count() >= BATCH {
            self.close();
        }
    }

    /// Uid and path of a download. Other objects than Sketchfab's are named by a UUID of their address.
    fn place(&self, identifier: &str, source: &str) -> (String, String) {
        let named = || Uuid::new_v5(&Uuid::NAMESPACE_DNS, identifier.as_bytes()).to_string();
        match source {
            "sketchfab" => {
                let uid = identifier.trim_end_matches('/').rsplit('/').next().unwrap_or_default().to_owned();
                let place = self.known.binary_search_by(|(known, _)| (**known).cmp(uid.as_str()));
                let below = place.map_or_else(|_| format!("glbs/{uid}.glb"), |place| self.known[place].1.to_string());
                (uid, format!("{}/{below}", super::HOME))
            }
            "smithsonian" => {
                let uid = named();
                let path = format!("smithsonian/objects/{uid}.glb");
                (uid, path)
            }
            "github" => {
                // https://github.com/ORG/REPO/blob/COMMIT/PATH, saved under github/repos/ORG/REPO.
                let parts: Vec<&str> = identifier.trim_start_matches("https://github.com/").splitn(5, '/').collect();
                let path = match parts[..] {
                    [org, repo, _, _, file] => format!("github/repos/{org}/{repo}/{file}"),
                    _ => String::new(),
                };
                (named(), path)
            }
            _ => (named(), format!("{source}/objects/{}.glb", named())),
        }
    }

    fn close(&mut self) {
        let mut batch = std::mem::take(&mut self.batch);
        batch.close();
        self.gathered.batches.push(batch);
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use parquet::data_type::{ByteArray, ByteArrayType};
    use parquet::file::properties::WriterProperties;
    use parquet::file::writer::SerializedFileWriter;
    use parquet::schema::parser::parse_message_type;

    use super::*;
    use crate::catalog::Catalog;
    use crate::catalog::build::{Indexed, index};

    fn table(path: &Path, rows: &[[&str; 5]]) {
        let text = "message m { REQUIRED BYTE_ARRAY fileIdentifier (UTF8); REQUIRED BYTE_ARRAY source (UTF8);
            REQUIRED BYTE_ARRAY license (UTF8); REQUIRED BYTE_ARRAY fileType (UTF8); REQUIRED BYTE_ARRAY metadata (UTF8); }";
        let schema = Arc::new(parse_message_type(text).expect("a schema"));
        std::fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        let file = File::create(path).expect("a file");
        let mut writer =
            SerializedFileWriter::new(file, schema, Arc::new(WriterProperties::builder().build())).expect("a writer");
        let mut group = writer.next_row_group().expect("a group");
        for column in 0..5 {
            let values: Vec<ByteArray> = rows.iter().map(|row| row[column].into()).collect();
            let mut out = group.next_column().expect("readable").expect("a column");
            out.typed::<ByteArrayType>().write_batch(&values, None, None).expect("written");
            out.close().expect("closed");
        }
        group.close().expect("closed");
        writer.close().expect("closed");
    }

    #[test]
    fn annotations_lead_to_downloads() {
        let folder = tempfile::tempdir().expect("a folder");
        let address = "https://3d-api.si.edu/content/document/anchor.glb";
        table(
            &folder.path().join("smithsonian/smithsonian.parquet"),
            &[[address, "smithsonian", "CC0", "glb", r#"{"title": "Iron Anchor"}"#]],
        );
        let hub = "https://github.com/o/r/blob/abc/models/old_tyre.gltf";
        let out = "https://github.com/o/r/blob/abc/../../x.glb";
        table(
            &folder.path().join("github/github.parquet"),
            &[
                [hub, "github", "MIT License", "gltf", ""],
                [out, "github", "", "glb", ""],
                [hub, "github", "", "stl", ""],
            ],
        );
        let into = tempfile::tempdir().expect("a folder");
        let Indexed::Collection(report) = index(folder.path(), Some(into.path())).expect("indexed") else {
            panic!("XL")
        };
        assert_eq!(report.models, 2);
        assert!(report.problems.iter().any(|problem| problem.contains("2 objects")), "{:?}", report.problems);
        let catalog = Catalog::open(into.path()).expect("sound");
        let of = |query: &str| catalog.asset(catalog.find(query, 1).expect("readable")[0].model).expect("sound");
        // As Python's uuid.uuid5(uuid.NAMESPACE_DNS, address) has it.
        let uid = Uuid::new_v5(&Uuid::NAMESPACE_DNS, address.as_bytes()).to_string();
        let anchor = of("anchor");
        assert_eq!((anchor.label.as_str(), anchor.licence.as_str()), ("anchor", "CC0-1.0"));
        assert!(anchor.path.ends_with(format!("smithsonian/objects/{uid}.glb")));
        let tire = of("tire");
        assert!(tire.path.ends_with("github/repos/o/r/models/old_tyre.gltf") && tire.licence == "MIT");
    }
}
