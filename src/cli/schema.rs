//! `ensonify schema`: the JSON Schema of recipes.

use std::io::Write as _;

use clap::Args;

use super::Code;
use crate::plan::schema;

/// Prints the JSON Schema of recipes, for completion in editors
///
/// A recipe whose first line is `# yaml-language-server: $schema=PATH` is completed and checked while it is written, in
/// every editor with a YAML language server.
#[derive(Debug, Args)]
#[command(after_help = "Example:\n  ensonify schema > recipe.schema.json")]
pub struct Schema {}

impl Schema {
    pub(super) fn run(&self) -> anyhow::Result<Code> {
        // Whoever reads may stop reading: that is no error.
        let _ = std::io::stdout().write_all(schema().as_bytes());
        Ok(Code::Done)
    }
}
