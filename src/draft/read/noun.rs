//! Phrases that name things: "three rusty car tires", "a few small rocks", "轮胎", "a unicorn".

use std::ops::Range;

use super::measures::StandCue;
use super::reading::Reading;
use super::stand::{Relation, StandWord, stand_word};
use super::token::Kind;
use super::vocabulary::{Bound, Cue, Vague, Word, vocabulary};
use crate::catalog::priors::material_of;
use crate::draft::wish::{Amount, Count, Said};

/// A phrase that names a thing.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Noun {
    /// All its tokens.
    pub tokens: Range<usize>,
    /// The name with the adjectives that may choose among models.
    pub name: String,
    /// Tokens of the name, with every adjective.
    pub named: Range<usize>,
    /// How many, where that is said.
    pub count: Option<Said<Count>>,
    /// Which article it has.
    pub article: Article,
    /// Whether the table of things knows it.
    pub is_known: bool,
    /// Whether the numbers of its count run backwards.
    pub falls: bool,
    /// How it is, said by adjectives: "half-buried".
    pub stands: Vec<(Range<usize>, StandWord)>,
    /// Its size.
    pub size_m: Option<Said<Amount>>,
    /// Adjectives that change nothing, with the reason.
    pub ignored: Vec<Said<String>>,
}

/// How a thing is introduced.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Article {
    /// `tires`.
    None,
    /// `a tire`, `three tires`, `some tires`.
    Indefinite,
    /// `the tire`.
    Definite,
}

/// The phrase that begins at a token.
pub(super) fn noun_at(reading: &Reading<'_>, stands: &[StandCue], at: usize) -> Option<Noun> {
    let mut noun = Noun {
        tokens: at..at,
        name: String::new(),
        named: at..at,
        count: None,
        article: Article::None,
        is_known: false,
        falls: false,
        stands: Vec::new(),
        size_m: None,
        ignored: Vec::new(),
    };
    let mut next = determiner(reading, at, &mut noun);
    let mut names: Vec<Range<usize>> = Vec::new();
    let mut begin = None;
    let mut tries = 0;
    loop {
        tries += 1;
        if tries > 12 {
            return None;
        }
        if let Some(cue) = stands.iter().find(|cue| cue.tokens.start == next && cue.cue == Cue::Size) {
            noun.size_m = Some(reading.said(cue.tokens.clone(), cue.amount.clone()));
            next = cue.tokens.end;
            continue;
        }
        if let Some(cue) = stands.iter().find(|cue| cue.tokens.start == next && cue.cue == Cue::Burial) {
            let [low, high] = cue.amount.ends();
            noun.stands.push((cue.tokens.clone(), StandWord::Buried(low, high)));
            next = cue.tokens.end;
            continue;
        }
        if !reading.is_free(next) {
            return None;
        }
        let thing = reading.thing_at(next);
        if let Some((tokens, reason)) = adjective(reading, next, thing) {
            begin.get_or_insert(next);
            if let Some(reason) = reason {
                noun.ignored.push(reading.said(next..next + tokens, reason));
            }
            // Words such as "wooden" and "sunken" may choose among models, colours never do.
            names.push(next..next + tokens);
            next += tokens;
            continue;
        }
        if let Some((tokens, word)) = stand_word(reading, next).filter(|(tokens, word)| {
            word.is_adjective()
                && thing.is_none_or(|count| count <= *tokens)
                && noun_follows(reading, stands, next + tokens, &noun)
        }) {
            noun.stands.push((next..next + tokens, word));
            next += tokens;
            if reading.text.form(next) == "of" || matches!(reading.text.form(next), "von" | "de" | "d") {
                next += 1;
            }
            let mut inner = Noun { count: None, article: Article::None, ..noun.clone() };
            let behind = determiner(reading, next, &mut inner);
            if behind > next || matches!(word, StandWord::Heap | StandWord::Row | StandWord::School) {
                // `a row of six`: the article is the row's.
                noun = Noun { article: Article::Indefinite, ..inner };
                next = behind;
            }
            continue;
        }
        if let Some(count) = thing {
            if is_doubtful(reading, next, count, &noun, names.is_empty()) {
                return None;
            }
            begin.get_or_insert(next);
            let (end, whole) = compound(reading, next, count, noun.article, &mut names);
            noun.is_known = true;
            next = end;
            noun.named = begin.unwrap_or(whole)..end;
            break;
        }
        if is_unknown(reading, next) {
            let end =
                (next..reading.len()).take_while(|&at| is_unknown(reading, at) && reading.is_free(at)).count() + next;
            // An adjective that nobody knows, before a thing.
            if reading.thing_at(end).is_some() && end <= next + 2 && noun.article != Article::None {
                begin.get_or_insert(next);
                names.push(next..end);
                next = end;
                continue;
            }
            // `a Tritech Gemini`: part of a name that was read.
            let goes_on =
                reading.text.tokens.get(end).is_some_and(|token| token.kind == Kind::Word) && !reading.is_free(end);
            if goes_on {
                return None;
            }
            let in_place = noun.article == Article::Indefinite || follows_list_word(reading, at);
            if !in_place || noun.article == Article::Definite {
                return None;
            }
            let end = end.min(next + 2);
            noun.named = begin.unwrap_or(next)..end;
            names.push(next..end);
            next = end;
            break;
        }
        return None;
    }
    // Repaired, as the whole prompt tells the language.
    let forms = names.iter().flat_map(|tokens| tokens.clone());
    noun.name = forms.fold(String::new(), |name, at| {
        let parted = !name.is_empty() && !reading.text.tokens[at].is_ideograph();
        name + if parted { " " } else { "" } + reading.text.form(at)
    });
    next = wreck_of(reading, stands, next, &mut noun);
    // `a debris field`: not one.
    let field = matches!(reading.text.form(next), "field" | "site" | "zone" | "dump" | "collection");
    if field && noun.count.as_ref().is_some_and(|said| said.value == Count::Exactly(1)) {
        noun.count = None;
    }
    next = count_behind(reading, next, &mut noun);
    noun.tokens = at..next;
    Some(noun)
}

/// `wreck of a small boat`: one thing, of which the wreck tells the state.
fn wreck_of(reading: &Reading<'_>, stands: &[StandCue], at: usize, noun: &mut Noun) -> usize {
    let is_wreck = noun.name.split(' ').next_back().is_some_and(|word| vocabulary().wrecked.contains(word));
    if !is_wreck || !matches!(reading.text.form(at), "of" | "von" | "de" | "d") || noun.tokens.start > at {
        return at;
    }
    let inner = noun_at(reading, stands, at + 1).filter(|inner| inner.is_known);
    inner.map_or(at, |inner| {
        noun.name = format!("{} {}", inner.name, noun.name);
        noun.named.end = inner.named.end;
        inner.tokens.end
    })
}

/// Reads the article or count at a token; the token behind it.
fn determiner(reading: &Reading<'_>, at: usize, noun: &mut Noun) -> usize {
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

fn is_definite(form: &str) -> bool {
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
pub(super) fn vague_count(vague: Vague) -> Count {
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

/// An adjective at a token: its tokens, and why it changes nothing where it does not.
fn adjective(reading: &Reading<'_>, at: usize, thing: Option<usize>) -> Option<(usize, Option<String>)> {
    let text = &reading.text;
    let token = text.tokens.get(at).filter(|token| token.kind == Kind::Word)?;
    if let Some((tokens, reason)) = vocabulary().ignored.at(text, at)
        && thing.is_none_or(|count| count <= tokens && more_follows(reading, at + tokens))
    {
        return Some((tokens, Some(reason.clone())));
    }
    let size = reading.word(at, Word::SizeUp).or_else(|| reading.word(at, Word::SizeDown));
    if let Some(tokens) = size.filter(|_| thing.is_none()) {
        return Some((tokens, None));
    }
    let wrecked = vocabulary().wrecked.contains(&token.form) && thing.is_none();
    let material = thing.is_none() && !token.is_ideograph() && material_of("", &token.form).is_some();
    (wrecked || material).then_some((1, None))
}

/// Whether a noun goes on at a token.
fn more_follows(reading: &Reading<'_>, at: usize) -> bool {
    reading.thing_at(at).is_some() || adjective_word(reading, at)
}

fn adjective_word(reading: &Reading<'_>, at: usize) -> bool {
    vocabulary().ignored.at(&reading.text, at).is_some() && reading.thing_at(at + 1).is_some()
}

fn noun_follows(reading: &Reading<'_>, stands: &[StandCue], at: usize, noun: &Noun) -> bool {
    // Far enough that no phrase is looked at twice.
    let of = usize::from(matches!(reading.text.form(at), "of" | "von" | "de" | "d" | "的"));
    let begin = at + of;
    let is_near = |next: usize| reading.thing_at(next).is_some();
    let mut inner = noun.clone();
    let behind = determiner(reading, begin, &mut inner);
    let counted = behind > begin;
    let of =
        usize::from(of == 1 || matches!(reading.text.form(begin.wrapping_sub(1)), "of" | "von" | "de" | "d" | "的"));
    // `buried in`, `lying on`: what follows an adjective stands right behind it.
    (is_near(begin) || (counted && of == 1 && is_near(behind)) || (counted && (of == 1) && is_near(behind + 1)))
        || (adjective(reading, begin, None).is_some_and(|(tokens, _)| is_near(begin + tokens)))
        || stands.iter().any(|cue| cue.tokens.start == begin && cue.cue == Cue::Size)
}

/// Words that are seldom things: not without an article, a count or an adjective.
fn is_doubtful(reading: &Reading<'_>, at: usize, count: usize, noun: &Noun, is_bare: bool) -> bool {
    if count > 1 {
        return false;
    }
    let form = reading.text.form(at);
    let vehicle = reading.word(at, Word::Vehicle) == Some(1) && noun.article != Article::Indefinite;
    // `and watch the trash rack`: what has an object is a verb.
    let is_verb = is_definite(reading.text.form(at + 1)) || matches!(reading.text.form(at + 1), "a" | "an");
    let listed = follows_thing_list(reading, at) && !is_verb;
    vehicle
        || (vocabulary().doubtful.contains(form)
            && noun.article != Article::Indefinite
            && is_bare
            && !reading.is_plural(at)
            && !listed)
        || (matches!(form, "person" | "people")
            && noun.article == Article::None
            && !matches!(reading.text.form(at.wrapping_sub(1)), "of" | "and" | "with" | "detecting" | "," | ":"))
        || (form == "can" && noun.article == Article::None && !listed && !reading.is_plural(at))
        || reading.word(at, Word::Images) == Some(1)
}

fn follows_thing_list(reading: &Reading<'_>, at: usize) -> bool {
    let before = at.checked_sub(2);
    before.is_some_and(|before| {
        (reading.text.is_mark(before + 1, ',') || reading.text.form(before + 1) == "and")
            && (before.saturating_sub(2)..=before)
                .any(|begin| reading.any_thing_at(begin).is_some_and(|n| begin + n == before + 1))
    })
}

/// Things side by side: a compound if the first tells of the second (`fish crate`), else a list (`crate barrel tire`).
fn compound(
    reading: &Reading<'_>,
    at: usize,
    count: usize,
    article: Article,
    names: &mut Vec<Range<usize>>,
) -> (usize, usize) {
    let mut end = at + count;
    names.push(at..end);
    if reading.text.tokens[at].is_ideograph() {
        return (end, at);
    }
    while let Some(more) = reading.thing_at(end) {
        let whole = reading.text.words(at..end + more);
        let tells = reading.models(whole).is_ok_and(|found| {
            let first = crate::catalog::words::words(reading.text.words(at..end));
            found.narrowed_by.iter().any(|word| first.contains(word))
        });
        let doubtful = vocabulary().doubtful.contains(reading.text.form(end)) && article == Article::None;
        if doubtful || !(tells || article == Article::Indefinite) || reading.word(end, Word::Images).is_some() {
            break;
        }
        names.push(end..end + more);
        end += more;
    }
    (end, at)
}

/// A word that no table knows, so that it may name a thing that nobody has.
fn is_unknown(reading: &Reading<'_>, at: usize) -> bool {
    let Some(token) = reading.text.tokens.get(at).filter(|token| token.kind == Kind::Word && !token.is_ideograph())
    else {
        return false;
    };
    token.form.len() > 2 && !vocabulary().is_said(&token.form) && reading.thing_at(at).is_none()
}

fn follows_list_word(reading: &Reading<'_>, at: usize) -> bool {
    at > 0
        && matches!(
            reading.text.form(at - 1),
            "of" | "with" | "and" | "und" | "mit" | "et" | "avec" | "y" | "con" | "von" | "de" | "detecting"
        )
        && reading.is_plural(at)
}

/// A count behind the name: `tires x3`, `(15 of them)`, `(at least three)`, `a tire or two`, `one mine or none`.
fn count_behind(reading: &Reading<'_>, at: usize, noun: &mut Noun) -> usize {
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

/// Relations are said by words that are no adjectives.
impl StandWord {
    fn is_adjective(self) -> bool {
        !matches!(
            self,
            Self::Relation(Relation::Leaning | Relation::On | Relation::Near(_)) | Self::Middle | Self::Resting
        )
    }
}
