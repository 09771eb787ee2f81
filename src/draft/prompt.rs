//! What a person typed, and the options that win over it.

/// A prompt, as a drafter gets it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Prompt {
    /// On one line, without anything that a terminal would obey; byte ranges of a wish refer to it.
    text: String,
    /// What options say.
    pub options: Options,
}

/// Explicit options of the command line: each wins over what the prompt says of the same.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// `--images`: frames in all.
    pub images: Option<u64>,
    /// `--seed`.
    pub seed: Option<u64>,
    /// `--name`.
    pub name: Option<String>,
    /// `--sonar`: name of a device file.
    pub sonar: Option<String>,
}

impl Prompt {
    /// Longest prompt that is read, letters: more is no description of a dataset.
    pub const LONGEST: usize = 4000;

    /// A prompt as it was typed.
    #[must_use]
    pub fn new(typed: &str, options: Options) -> Self {
        let cut: String = typed.chars().take(Self::LONGEST).collect();
        let text = cut.split_whitespace().map(visible).collect::<Vec<_>>().join(" ");
        Self { text: text.trim().to_owned(), options }
    }

    /// Its text.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The words of a byte range; nothing for a range that is not of this prompt.
    #[must_use]
    pub fn words(&self, range: &std::ops::Range<usize>) -> &str {
        self.text.get(range.clone()).unwrap_or_default().trim()
    }
}

fn visible(word: &str) -> String {
    word.chars().filter(|letter| !crate::catalog::text::is_unseen(*letter)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_prompt_is_one_line_that_no_terminal_obeys() {
        let prompt = Prompt::new(" two\ttires\n\u{1b}[31mred\u{202e} 锚 ", Options::default());
        assert_eq!(prompt.text(), "two tires [31mred 锚");
        assert_eq!((prompt.words(&(4..9)), prompt.words(&(90..99)), prompt.words(&(22..23))), ("tires", "", ""));
        assert_eq!(Prompt::new(&"x".repeat(9000), Options::default()).text().len(), Prompt::LONGEST);
    }
}
