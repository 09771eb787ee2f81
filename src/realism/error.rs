//! What can go wrong when images are measured.

use std::path::PathBuf;

use thiserror::Error;

use crate::store::StoreError;

/// Images cannot be measured or figures cannot be read.
#[derive(Debug, Error)]
pub enum RealismError {
    /// The dataset's own records.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// The system refused.
    #[error("cannot read {}: {source}; name a dataset folder, a folder of PNG images, or a file of figures", path.display())]
    Io {
        /// Which file or folder.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
    /// The plan of a dataset does not tell the geometry.
    #[error("{}: {reason}; restore the file, or run the recipe again", path.display())]
    Plan {
        /// The plan.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// A dataset without anything to measure.
    #[error("{} has no finished frame with a fan view; put `fan` among output.views and run the recipe", path.display())]
    NoFan {
        /// The dataset.
        path: PathBuf,
    },
    /// A folder without images.
    #[error("{} holds no dataset (manifest.json) and no PNG image; name a folder that does", path.display())]
    NoImages {
        /// The folder.
        path: PathBuf,
    },
    /// A folder of images of unknown shape.
    #[error("{} is a folder of plain images: say how wide their fan is with --fan-deg, such as --fan-deg 30", path.display())]
    NoGeometry {
        /// The folder.
        path: PathBuf,
    },
    /// A geometry that fits no picture.
    #[error("{}: {problem}; {remedy}", path.display())]
    Geometry {
        /// The image.
        path: PathBuf,
        /// What is wrong.
        problem: String,
        /// What to do.
        remedy: &'static str,
    },
    /// A file that is not the image it should be.
    #[error("{}: {reason}; restore the file or take it out of the folder", path.display())]
    Image {
        /// The image or mask.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// Figures that cannot be understood.
    #[error(
        "{}: {reason}; give a file that `ensonify realism --json` wrote, or published figures of the same shape",
        path.display()
    )]
    Figures {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
}
