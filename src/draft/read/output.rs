//! What is to be written, and ghosts: "raw EXR files", "fan images only", "multipath from the surface".

use super::reading::Reading;
use super::vocabulary::Word;

/// Finds what is to be written and which mirrors there are.
pub(super) fn spot(reading: &mut Reading<'_>) {
    if let Some(tokens) = reading.find(Word::Raw).filter(|tokens| !reading.is_negated(tokens.start)) {
        reading.take(tokens.clone());
        reading.wish.output.raw = Some(reading.said(tokens, "exr".into()));
    }
    if let Some(tokens) = reading.find(Word::Tar) {
        reading.take(tokens.clone());
        reading.wish.output.pack = Some(reading.said(tokens, "tar".into()));
    }
    let fan = reading.find_all(Word::Fan);
    let polar = reading.find_all(Word::Polar);
    let wanted = |reading: &Reading<'_>, all: &[std::ops::Range<usize>]| {
        all.iter().find(|tokens| !reading.is_negated(tokens.start)).cloned()
    };
    let views: Vec<_> = [(wanted(reading, &fan), "fan"), (wanted(reading, &polar), "polar")]
        .into_iter()
        .filter_map(|(tokens, view)| Some((tokens?, view)))
        .collect();
    for tokens in fan.iter().chain(&polar) {
        reading.take(tokens.clone());
    }
    if let [(tokens, view)] = views.as_slice() {
        reading.wish.output.views = Some(reading.said(tokens.clone(), vec![(*view).to_owned()]));
    }
    if let Some(tokens) = reading.find(Word::Multipath) {
        let off = reading.is_negated(tokens.start);
        reading.take(tokens.clone());
        let bottom = (tokens.start.saturating_sub(3)..(tokens.end + 6).min(reading.len()))
            .any(|at| matches!(reading.text.form(at), "bottom" | "floor" | "boden" | "fondo" | "fond"));
        let surface = reading.text.source.to_lowercase().contains("surface") || !bottom;
        let mirrors = [(surface, "surface"), (bottom, "bottom")];
        let mirrors = mirrors.into_iter().filter(|(is_there, _)| *is_there).map(|(_, name)| name.to_owned()).collect();
        if !off {
            reading.wish.multipath = Some(reading.said(tokens, mirrors));
        }
    }
}
