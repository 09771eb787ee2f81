//! What can be wrong with a catalog or a model, and what to do about it.

use std::path::PathBuf;

use thiserror::Error;

/// A catalog, an entry of it or a model file that cannot be used.
#[derive(Debug, Error)]
pub enum CatalogError {
    /// No catalog of that name or folder.
    #[error(
        "no catalog `{name}`: looked for catalog.csv in {looked}; put the catalog's folder there or give its path, or make one with `ensonify catalog index`"
    )]
    NotFound {
        /// As written in the recipe.
        name: String,
        /// Folders tried, in order, separated by commas.
        looked: String,
    },
    /// The index cannot be read.
    #[error("{path}: {problem}; a catalog is a folder with a catalog.csv whose first line names its columns", path = path.display())]
    Unreadable {
        /// The index file.
        path: PathBuf,
        /// What the system or the CSV reader says.
        problem: String,
    },
    /// A column that every index has is not there.
    #[error("{path}:1: no column `{column}`; the columns are {columns}", path = path.display())]
    Column {
        /// The index file.
        path: PathBuf,
        /// The missing column.
        column: &'static str,
        /// All columns, separated by commas.
        columns: String,
    },
    /// A row of the index is wrong.
    #[error("{path}:{line}: {problem}", path = path.display())]
    Row {
        /// The index file.
        path: PathBuf,
        /// Line in the file, from 1.
        line: u64,
        /// What is wrong, and the remedy.
        problem: String,
    },
    /// A pick names nothing.
    #[error("catalog `{catalog}` has nothing with {wanted}{nearest}")]
    NoMatch {
        /// The catalog's name.
        catalog: String,
        /// What was asked for.
        wanted: String,
        /// `; did you mean …?`, or empty.
        nearest: String,
    },
    /// A name that no table of materials or sediments has.
    #[error("no {kind} `{name}`{nearest}; there are {known}")]
    UnknownName {
        /// `material` or `sediment`.
        kind: &'static str,
        /// As given.
        name: String,
        /// `; did you mean …?`, or empty.
        nearest: String,
        /// All names, separated by commas.
        known: String,
    },
    /// An entry of a table of materials or sediments is wrong.
    #[error("{table}: {problem}")]
    Table {
        /// The table's file name.
        table: &'static str,
        /// What is wrong.
        problem: String,
    },
    /// A link leads out of the catalog.
    #[error(
        "{path} is a link to {target}, outside of the catalog's root {root}; copy the file into it",
        path = path.display(), target = target.display(), root = root.display()
    )]
    Outside {
        /// The link.
        path: PathBuf,
        /// Where it leads.
        target: PathBuf,
        /// Root of the catalog's models.
        root: PathBuf,
    },
    /// A file beside the index, or of a cache, is wrong.
    #[error("{path}: {problem}", path = path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// What is wrong, and the remedy.
        problem: String,
    },
    /// A model file cannot be used.
    #[error("{path} {fault}", path = path.display())]
    Model {
        /// The model file.
        path: PathBuf,
        /// Why not.
        fault: ModelFault,
    },
}

/// Why a model file cannot be used; reads on from the file's name.
#[derive(Debug, Error)]
pub enum ModelFault {
    /// Missing or unreadable.
    #[error("cannot be read: {0}")]
    Io(#[from] std::io::Error),
    /// Beyond what one model may have.
    #[error("has {count} {what}, more than the {limit} that one model may have; simplify it")]
    TooLarge {
        /// Bytes, triangles or vertices, and where if it is one place.
        what: String,
        /// How many there are.
        count: u64,
        /// How many there may be.
        limit: u64,
    },
    /// Not glTF 2.0, or cut off.
    #[error("is not a whole glTF 2.0 file: {0}; export it again as GLB")]
    NotGltf(String),
    /// Required extensions that nothing here knows.
    #[error("needs the glTF extension {0}, which is not supported; export it without")]
    Extension(String),
    /// A part of the file contradicts another.
    #[error("is broken at {place}: {problem}; export it again")]
    Broken {
        /// Where, e.g. `accessors[3]`.
        place: String,
        /// What is wrong there.
        problem: String,
    },
    /// The file itself lies elsewhere, behind a link.
    #[error("is refused: it leads out of {root}; copy the model into that folder", root = root.display())]
    Elsewhere {
        /// The folder that models must lie in.
        root: PathBuf,
    },
    /// A buffer that is not in the model's catalog.
    #[error("is refused at {place}: {uri:?} {problem}; put the data beside the model, or export it as GLB")]
    Outside {
        /// Where, e.g. `buffers[0]`.
        place: String,
        /// As in the file.
        uri: String,
        /// Where it leads.
        problem: &'static str,
    },
    /// A buffer that cannot be read.
    #[error("needs {uri:?} ({place}), which cannot be read: {error}; put that file beside the model")]
    Beside {
        /// Where, e.g. `buffers[0]`.
        place: String,
        /// As in the file.
        uri: String,
        /// What the system says.
        error: std::io::Error,
    },
    /// Nothing that a sonar could see.
    #[error("holds no triangles in its scene; a model needs a surface, not only points, lines or empty nodes")]
    NoTriangles,
    /// Triangles, but none that a sonar could see.
    #[error("holds {0} triangles, none of which has an area; give it an extent")]
    Flat(u64),
    /// A panic while it was read.
    #[error("makes the reader fail, so it must be broken; export it again, without compression if it has any")]
    Crash,
}

impl ModelFault {
    pub(crate) fn broken(place: impl Into<String>, problem: impl Into<String>) -> Self {
        Self::Broken { place: short(&place.into()), problem: short(&problem.into()) }
    }

    /// An error if there are more than one model may have.
    pub(crate) fn limit(what: &str, count: u64, limit: u64) -> Result<(), Self> {
        if count > limit { Err(Self::TooLarge { what: what.into(), count, limit }) } else { Ok(()) }
    }
}

/// Words of a file as a message can hold them: not endless, no control characters.
pub(crate) fn short(text: &str) -> String {
    const MOST: usize = 300;
    let mut letters = text.chars().filter(|letter| !letter.is_control());
    let kept: String = letters.by_ref().take(MOST).collect();
    if letters.next().is_some() { kept + "…" } else { kept }
}

/// `; did you mean X?` for the word nearest to `name`, or nothing if none is near.
pub(crate) fn did_you_mean<'a>(name: &str, words: impl IntoIterator<Item = &'a str>) -> String {
    let best = words
        .into_iter()
        .map(|word| (strsim::normalized_damerau_levenshtein(name, word), word))
        .max_by(|a, b| a.0.total_cmp(&b.0));
    match best {
        Some((likeness, word)) if likeness >= 0.5 => format!("; did you mean `{word}`?"),
        _ => String::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_of_a_file_cannot_flood_or_colour_a_message() {
        let fault = ModelFault::broken("nodes[0]", format!("\u{1b}[31m{}", "x".repeat(1_000_000)));
        let text = fault.to_string();
        assert!(text.len() < 400 && text.contains("[31mxx") && text.contains("…; export") && !text.contains('\u{1b}'));
    }
}
