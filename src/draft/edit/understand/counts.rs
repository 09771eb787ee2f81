//! Numbers and articles before a thing: "two more", "the", "three to five", "a heap of".

use super::Reader;
use super::words::{Manner, lexicon};
use crate::draft::read::number::number_at;
use crate::draft::read::quantity::Measure;
use crate::draft::read::vocabulary::{Vague, vocabulary};
use crate::draft::wish::{Count, Stand};

/// How many are said before a thing.
#[derive(Default)]
pub(super) struct Counted {
    /// Behind the last token of it.
    pub end: usize,
    pub count: Option<Count>,
    /// "two more".
    pub is_more: bool,
    /// "the".
    pub is_definite: bool,
    /// "heap of".
    pub manner: Option<Stand>,
}

impl Reader<'_> {
    /// Numbers and articles at the next token.
    pub(super) fn counted(&self) -> Counted {
        self.counted_from(self.at)
    }

    /// Numbers and articles before a thing.
    pub(super) fn counted_from(&self, from: usize) -> Counted {
        let mut counted = Counted { end: from, ..Counted::default() };
        loop {
            let at = counted.end;
            let form = self.text.form(at);
            // `3 m` counts nothing.
            if self.quantity(at).is_some_and(|found| !matches!(found.measure, Measure::Number | Measure::Share)) {
                return counted;
            }
            if let Some(number) =
                number_at(&self.text, at).filter(|number| counted.count.is_none() && is_count(number.value))
            {
                let upper = self.upper(at + number.tokens);
                let low = number.value as u32;
                counted.count =
                    Some(upper.map_or(Count::Exactly(low), |(_, high)| Count::Between(low.min(high), low.max(high))));
                counted.end = at + number.tokens + upper.map_or(0, |(tokens, _)| tokens);
            } else if let Some((tokens, vague)) =
                self.vague(at).filter(|_| counted.count.is_none() && !counted.is_definite)
            {
                counted.count = Some(vague);
                counted.end = at + tokens;
            } else if let Some((tokens, Manner::Heap)) = self.phrase(&lexicon().stands, at) {
                counted.manner = Some(Stand::Heap);
                counted.end = at + tokens;
            } else if let Some((tokens, Manner::School)) = self.phrase(&lexicon().stands, at) {
                counted.manner = Some(Stand::School);
                counted.end = at + tokens;
            } else if matches!(
                form,
                "more" | "additional" | "further" | "extra" | "mehr" | "weitere" | "más" | "mas" | "plus" | "autre"
            ) || matches!(form, "another" | "noch")
            {
                if form == "another" {
                    counted.count = counted.count.or(Some(Count::Exactly(1)));
                }
                counted.is_more |= counted.count.is_some();
                if !counted.is_more && form != "noch" {
                    return counted;
                }
                counted.end = at + 1;
            } else if counted.is_definite && matches!(form, "number" | "anzahl" | "numero" | "nombre") {
                // `the number of rocks`.
                counted.end = at + 1;
            } else if matches!(form, "a" | "an") && counted.count.is_none() {
                counted.count = Some(Count::Exactly(1));
                counted.end = at + 1;
            } else if matches!(
                form,
                "the"
                    | "all"
                    | "every"
                    | "any"
                    | "of"
                    | "der"
                    | "die"
                    | "das"
                    | "den"
                    | "alle"
                    | "el"
                    | "la"
                    | "los"
                    | "las"
                    | "le"
                    | "les"
                    | "todos"
                    | "todas"
                    | "tous"
                    | "toutes"
                    | "these"
                    | "those"
                    | "那"
                    | "所"
                    | "有"
                    | "个"
                    | "只"
                    | "l"
            ) {
                counted.is_definite |= form != "of";
                counted.end = at + 1;
            } else {
                return counted;
            }
        }
    }

    /// The far end of `three to five`.
    fn upper(&self, at: usize) -> Option<(usize, u32)> {
        let link = matches!(self.text.form(at), "to" | "-" | "bis" | "a" | "or" | "oder" | "到" | "至");
        let number = number_at(&self.text, at + 1).filter(|number| link && is_count(number.value))?;
        Some((1 + number.tokens, number.value as u32))
    }

    fn vague(&self, at: usize) -> Option<(usize, Count)> {
        let (tokens, vague) = vocabulary().vague.at(&self.text, at)?;
        let count = match vague {
            Vague::Couple => Count::Exactly(2),
            Vague::Few | Vague::Some => Count::Between(2, 4),
            Vague::Several => Count::Between(3, 6),
            Vague::Many => Count::Between(8, 15),
            Vague::Dozens => Count::Between(24, 48),
            Vague::Hundreds => Count::Between(100, 300),
        };
        Some((tokens, count))
    }
}

fn is_count(value: f64) -> bool {
    (0.0..=100_000.0).contains(&value) && value.fract() == 0.0
}

/// Whether a number stands at a token, not an article.
pub(super) fn count_is_said(text: &crate::draft::read::text::Text<'_>, at: usize) -> bool {
    !matches!(text.form(at), "a" | "an" | "ein" | "eine" | "einen" | "un" | "une" | "una")
        && number_at(text, at).is_some()
}
