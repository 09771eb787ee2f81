//! Phrases that name things: "three rusty car tires", "a few small rocks", "轮胎", "a unicorn".

use std::ops::Range;

use super::determiner::{count_behind, determiner, is_definite};
use super::measures::StandCue;
use super::reading::Reading;
use super::stand::{Relation, StandWord, stand_word};
use super::token::{Kind, Language};
use super::vocabulary::{Cue, Word, vocabulary};
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
            next += usize::from(reading.text.form(next) == "的");
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
    // `bateau coulé`: behind the noun in other languages.
    while vocabulary().wrecked.contains(reading.text.form(next))
        && matches!(reading.text.language, Language::Spanish | Language::French)
        && reading.is_free(next)
    {
        noun.name = format!("{} {}", reading.text.form(next), noun.name);
        next += 1;
        noun.named.end = next;
    }
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

/// Relations are said by words that are no adjectives.
impl StandWord {
    fn is_adjective(self) -> bool {
        !matches!(
            self,
            Self::Relation(Relation::Leaning | Relation::On | Relation::Near(_)) | Self::Middle | Self::Resting
        )
    }
}
