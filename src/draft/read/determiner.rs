//! Articles and counts before and behind the name of a thing: "three of the", "a few", "x3", "(at least three)".

use super::noun::{Article, Noun};
use super::reading::Reading;
use super::token::Kind;
use super::vocabulary::{Bound, Vague, Word, vocabulary};
use crate::draft::wish::{Amount, Count, Said};

/// Reads the article or count at a token; the token behind it.
pub(super) fn determiner(reading: &Reading<'_>, at: usize, noun: &mut Noun) -> usize {
    let text = &reading.text;
    let mut next = at;
    let vague = vocabulary().vague.at(text, at).filter(|(tokens, _)| (at..at + tokens).all(|at| reading.is_free(at)));
    let number = reading.number_at(at).filter(|number| vague.is_none_or(|(tokens, _)| tokens <= number.tokens.len()));
    if let Some(quantity) = number {
        noun.falls = quantity.falls;
        noun.count =
            count_of(&quantity.amount, quantity.bound).map(|count| reading.said(quantity.tokens.clone(), count));
        noun.article = Article::Indefinite;
        next = quantity.tokens.end;
        if noun.count.is_none() {
            return at;
        }
    } else if let Some((tokens, vague)) =
        vocabulary().vague.at(text, at).filter(|(tokens, _)| (at..at + tokens).all(|at| reading.is_free(at)))
    {
        noun.count = Some(reading.said(at..at + tokens, vague_count(*vague)));
        noun.article = Article::Indefinite;
        next += tokens;
        if *vague == Vague::Some && text.form(at) == "any" {
            noun.count = None;
        }
    } else if matches!(text.form(at), "a" | "an" | "another") && reading.is_free(at) && text.words(at..at + 1) != "à" {
        noun.count = Some(reading.said(at..at + 1, Count::Exactly(1)));
        noun.article = Article::Indefinite;
        next += 1;
    } else if is_definite(text.form(at)) && reading.is_free(at) {
        noun.article = Article::Definite;
        next += 1;
        let mut inner = noun.clone();
        inner.article = Article::None;
        let behind = if is_definite(text.form(next)) { next } else { determiner(reading, next, &mut inner) };
        if behind > next {
            noun.count = inner.count;
            noun.falls = inner.falls;
            next = behind;
        }
    } else if matches!(text.form(at), "same" | "exactly" | "each" | "every" | "either" | "only" | "just" | "单")
        && reading.is_free(at)
    {
        let mut inner = noun.clone();
        let behind = determiner(reading, at + 1, &mut inner);
        if behind > at + 1 {
            *noun = inner;
            return behind;
        }
        return if text.form(at) == "same" { at + 1 } else { at };
    }
    if next > at {
        next = filler(reading, next);
    }
    next
}

/// Words between a count and what is counted: 个, `x`, `pieces of`, `of the`.
fn filler(reading: &Reading<'_>, at: usize) -> usize {
    let mut next = at;
    for _ in 0..3 {
        let form = reading.text.form(next);
        let measure = reading.text.tokens.get(next).is_some_and(|token| token.is_ideograph())
            && vocabulary().measure_words.at(&reading.text, next).is_some()
            && reading.thing_at(next).is_none_or(|count| count == 1);
        let word = matches!(
            form,
            "x" | "of"
                | "piece"
                | "same"
                | "identical"
                | "more"
                | "different"
                | "other"
                | "stuck"
                | "unit"
                | "instance"
                | "specimen"
                | "de"
                | "d"
                | "的"
                | "of the"
                | "separate"
                | "example"
                | "kind"
                | "type"
                | "sort"
                | "pcs"
                | "pc"
                | "distinct"
                | "individual"
                | "exemplar"
                | "verschiedene"
                | "stuck_"
        );
        if (measure || word) && reading.is_free(next) {
            next += 1;
        } else {
            break;
        }
    }
    next
}

pub(super) fn is_definite(form: &str) -> bool {
    matches!(
        form,
        "the"
            | "this"
            | "that"
            | "these"
            | "those"
            | "its"
            | "their"
            | "my"
            | "your"
            | "our"
            | "der"
            | "die"
            | "das"
            | "dem"
            | "den"
            | "el"
            | "la"
            | "los"
            | "las"
            | "le"
            | "l"
            | "this_"
            | "lo"
            | "del"
            | "du"
    )
}

fn count_of(amount: &Amount, bound: Option<Bound>) -> Option<Count> {
    let [low, high] = amount.ends();
    let fits = |value: f64| (0.0..4e9).contains(&value) && value.fract() == 0.0;
    let low = if bound == Some(Bound::AtMost) && low == 0.0 { 1.0_f64.min(high) } else { low };
    if !fits(high) || !fits(low) {
        return None;
    }
    let (low, high) = (low as u32, high as u32);
    Some(if low == high { Count::Exactly(low) } else { Count::Between(low, high) })
}

/// What "some" and "many" come to.
fn vague_count(vague: Vague) -> Count {
    match vague {
        Vague::Couple => Count::Exactly(2),
        Vague::Few => Count::Between(3, 5),
        Vague::Some => Count::Between(2, 5),
        Vague::Several => Count::Between(3, 7),
        Vague::Many => Count::Between(8, 16),
        Vague::Dozens => Count::Between(24, 48),
        Vague::Hundreds => Count::Between(100, 200),
    }
}

/// A count behind the name: `tires x3`, `(15 of them)`, `(at least three)`, `a tire or two`, `one mine or none`.
pub(super) fn count_behind(reading: &Reading<'_>, at: usize, noun: &mut Noun) -> usize {
    let text = &reading.text;
    let whole = |at: usize| {
        let quantity = reading.number_at(at)?;
        Some((quantity.tokens.clone(), count_of(&quantity.amount, quantity.bound)?))
    };
    let one = matches!(noun.count.as_ref().map(|said| said.value), Some(Count::Exactly(1)));
    if let Some((tokens, count)) =
        (text.form(at) == "x" || text.is_mark(at, ':') || text.is_mark(at, '=')).then(|| whole(at + 1)).flatten()
        && !reading.word(tokens.end, Word::Images).is_some_and(|_| true)
    {
        noun.count = Some(reading.said(tokens.clone(), count));
        return tokens.end;
    }
    let bracket = (at..at + 3)
        .take_while(|&next| {
            next == at || reading.text.tokens.get(next).is_some_and(|t| t.kind == Kind::Word || t.is_mark('('))
        })
        .find(|&next| text.is_mark(next, '('));
    if let Some((tokens, count)) = bracket.and_then(|bracket| whole(bracket + 1)) {
        let closed = (tokens.end..tokens.end + 4).find(|&next| text.is_mark(next, ')'));
        if let Some(closed) = closed {
            noun.count = Some(reading.said(tokens, count));
            return closed + 1;
        }
    }
    if matches!(text.form(at), "or" | "oder" | "ou" | "o") {
        if let Some((tokens, Count::Exactly(more))) = whole(at + 1)
            && reading.thing_at(tokens.end).is_none()
            && one
            && reading.word(tokens.end, Word::Images).is_none()
        {
            let low = 1.min(more);
            let count = Count::Between(low, more.max(1));
            noun.count = noun.count.as_ref().map(|said| Said { value: count, ..said.clone() });
            return tokens.end;
        }
        if matches!(text.form(at + 1), "none" | "nothing" | "zero" | "no" | "keine" | "keiner" | "aucun" | "ninguno") {
            let most = noun.count.as_ref().map_or(1, |said| said.value.most());
            noun.count = Some(reading.said(noun.named.start..at + 2, Count::Between(0, most)));
            return at + 2;
        }
    }
    at
}
