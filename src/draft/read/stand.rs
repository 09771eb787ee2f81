//! Words for how and where a thing is: "half buried", "in a heap", "leaning against".

use super::reading::Reading;
use super::vocabulary::Word;
use crate::draft::wish::{Amount, Side, Stand};

/// A word for how or where a thing is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum StandWord {
    /// On the bottom.
    Resting,
    /// As built.
    Upright,
    /// Overturned.
    OnSide,
    /// As it fell.
    Settled,
    /// Sunk in: from this share to that.
    Buried(f64, f64),
    /// In the water.
    Floating,
    /// On a line.
    Moored,
    /// In a school.
    School,
    /// In a heap.
    Heap,
    /// In a row.
    Row,
    /// Anywhere.
    Scattered,
    /// In the middle of the scene.
    Middle,
    /// Told by another thing, which follows.
    Relation(Relation),
}

/// How a thing stands to another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Relation {
    /// Leaning against it.
    Leaning,
    /// On top of it.
    On,
    /// Beside it.
    Near(Option<Side>),
}

/// The longest such word at a token.
pub(super) fn stand_word(reading: &Reading<'_>, at: usize) -> Option<(usize, StandWord)> {
    use StandWord as S;
    let table = [
        (Word::HalfBuried, S::Buried(0.5, 0.5)),
        (Word::PartlyBuried, S::Buried(0.15, 0.4)),
        (Word::MostlyBuried, S::Buried(0.6, 0.85)),
        (Word::FullyBuried, S::Buried(0.9, 0.95)),
        (Word::Buried, S::Buried(0.2, 0.6)),
        (Word::OnSide, S::OnSide),
        (Word::Upright, S::Upright),
        (Word::Settled, S::Settled),
        (Word::Moored, S::Moored),
        (Word::Floating, S::Floating),
        (Word::School, S::School),
        (Word::Heap, S::Heap),
        (Word::Row, S::Row),
        (Word::Scattered, S::Scattered),
        (Word::Middle, S::Middle),
        (Word::Leaning, S::Relation(Relation::Leaning)),
        (Word::OnTop, S::Relation(Relation::On)),
        (Word::LeftOf, S::Relation(Relation::Near(Some(Side::Left)))),
        (Word::RightOf, S::Relation(Relation::Near(Some(Side::Right)))),
        (Word::FrontOf, S::Relation(Relation::Near(Some(Side::Front)))),
        (Word::BehindOf, S::Relation(Relation::Near(Some(Side::Behind)))),
        (Word::Near, S::Relation(Relation::Near(None))),
        (Word::Resting, S::Resting),
    ];
    let free = |tokens: &usize| (at..at + tokens).all(|at| reading.is_free(at));
    let said = table.into_iter().filter_map(|(word, stand)| Some((reading.word(at, word).filter(free)?, stand)));
    // The first of equally long ones.
    said.fold(None, |best: Option<(usize, StandWord)>, found| match best {
        Some((tokens, _)) if tokens >= found.0 => best,
        _ => Some(found),
    })
}

impl StandWord {
    /// What it says of a thing by itself.
    pub(super) fn stand(self) -> Option<Stand> {
        Some(match self {
            Self::Resting => Stand::Resting,
            Self::Upright => Stand::Upright,
            Self::OnSide => Stand::OnSide,
            Self::Settled => Stand::Settled,
            Self::Buried(low, high) if low == high => Stand::Buried(Amount::Exactly(low)),
            Self::Buried(low, high) => Stand::Buried(Amount::Between(low, high)),
            Self::Floating => Stand::Floating(None),
            Self::Moored => Stand::Moored(None),
            Self::School => Stand::School,
            Self::Heap => Stand::Heap,
            Self::Row => Stand::Row(None),
            Self::Scattered => Stand::Around(Amount::Exactly(8.0)),
            Self::Middle => Stand::At([0.0, 0.0], None),
            Self::Relation(_) => return None,
        })
    }
}

/// Adds what is said of a thing to what was said before: an amount completes a word without one.
pub(super) fn add(stands: &mut Vec<crate::draft::wish::Said<Stand>>, said: crate::draft::wish::Said<Stand>) {
    let completes = |known: &Stand| {
        matches!(
            (known, &said.value),
            (Stand::Floating(None), Stand::Floating(Some(_)) | Stand::BelowSurface(_) | Stand::Moored(_))
                | (Stand::Floating(Some(_)) | Stand::BelowSurface(_), Stand::Floating(None) | Stand::Moored(None))
                | (Stand::Moored(None), Stand::Floating(Some(_)) | Stand::Moored(Some(_)))
                | (Stand::Row(None), Stand::Apart(_))
                | (Stand::Apart(_), Stand::Row(None))
                | (Stand::Buried(_), Stand::Buried(_))
                | (Stand::Around(_), Stand::Around(_) | Stand::Within(..))
        )
    };
    let Some(place) = stands.iter().position(|known| completes(&known.value)) else {
        if !stands.iter().any(|known| known.value == said.value) {
            stands.push(said);
        }
        return;
    };
    let value = match (&stands[place].value, said.value) {
        (Stand::Moored(_), Stand::Floating(amount)) => Stand::Moored(amount),
        (Stand::Floating(amount @ Some(_)), Stand::Moored(None)) => Stand::Moored(amount.clone()),
        (known @ (Stand::Floating(Some(_)) | Stand::BelowSurface(_)), _) => known.clone(),
        (Stand::Row(_), Stand::Apart(amount)) => Stand::Row(Some(amount)),
        (Stand::Apart(amount), Stand::Row(None)) => Stand::Row(Some(amount.clone())),
        (_, other) => other,
    };
    stands[place] = crate::draft::wish::Said { value, source: joined(&stands[place].source, said.source) };
}

fn joined(one: &crate::draft::wish::Source, other: crate::draft::wish::Source) -> crate::draft::wish::Source {
    use crate::draft::wish::Source;
    match (one, other) {
        (Source::Words(one), Source::Words(other)) => Source::Words(one.iter().cloned().chain(other).collect()),
        (_, other) => other,
    }
}
