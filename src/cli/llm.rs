//! The options of every verb that may ask a language model.

use std::time::Duration;

use clap::Args;
use clap::builder::RangedU64ValueParser;

use crate::draft::model::{Held, Key, ModelDrafter, ModelError, Server, Settings};

/// Which language model is asked, if one is.
#[derive(Clone, Debug, Args)]
pub(super) struct LlmArgs {
    /// Asks a language model, too: the address of an OpenAI-compatible server, such as http://127.0.0.1:8080. Its key comes
    /// from the environment alone: ENSONIFY_LLM_KEY, else OPENAI_API_KEY
    #[arg(long, value_name = "URL", requires = "model")]
    llm: Option<String>,
    /// Name of the model on that server
    #[arg(long, value_name = "NAME", requires = "llm")]
    model: Option<String>,
    /// Seconds for one answer of the model, waiting and repeating included
    #[arg(long, value_name = "SECONDS", requires = "llm", default_value_t = 180, value_parser = RangedU64ValueParser::<u64>::new().range(1..=86_400))]
    timeout: u64,
    /// Longest answer of the model, tokens
    #[arg(long, value_name = "N", requires = "llm", default_value_t = 600, value_parser = RangedU64ValueParser::<u32>::new().range(16..=100_000))]
    max_tokens: u32,
    /// Takes the model's first answer as it is, without holding it to the prompt's own words: to measure a model
    #[arg(long, requires = "llm")]
    model_alone: bool,
}

impl LlmArgs {
    /// The drafter that these options ask for; none without `--llm`. Tells of ways on which others can read what is sent.
    ///
    /// # Errors
    /// An address or a key that is none.
    pub(super) fn drafter(&self) -> Result<Option<ModelDrafter>, ModelError> {
        let (Some(url), Some(model)) = (&self.llm, &self.model) else { return Ok(None) };
        let server = Server::at(url)?;
        let key = Key::of_environment()?;
        if let Some(warning) = server.warning(key.is_some()) {
            eprintln!("warning: {warning}");
        }
        let timeout = Duration::from_secs(self.timeout);
        let settings = Settings { server, model: model.clone(), key, timeout, max_tokens: self.max_tokens };
        let held = if self.model_alone { Held::ToTheFormAlone } else { Held::ToThePrompt };
        Ok(Some(ModelDrafter::new(settings, held)))
    }
}
