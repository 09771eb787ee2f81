//! Sonars by name: "Oculus M1200d at 2.1 MHz", "gemini 720", "DIDSON in low frequency mode".

use std::ops::Range;

use super::reading::Reading;
use super::vocabulary::Word;
use crate::catalog::sonars::DEVICES;

/// Words of device files that say nothing of which device it is, when they are left out.
const MODES: [&str; 4] = ["lf", "hf", "nav", "insp"];

/// Finds the sonars that a prompt names.
pub(super) fn spot(reading: &mut Reading<'_>) {
    let mut named: Vec<(Range<usize>, Vec<String>)> = Vec::new();
    let mut at = 0;
    while at < reading.len() {
        match device_at(reading, at) {
            Some((tokens, devices)) => {
                reading.take(at..at + tokens);
                named.push((at..at + tokens, devices));
                at += tokens;
            }
            None => at += 1,
        }
    }
    if named.is_empty() {
        return;
    }
    let mode = mode(reading);
    let frequency = frequency_khz(reading);
    let mut words: Vec<Range<usize>> = named.iter().map(|(tokens, _)| tokens.clone()).collect();
    let mut devices: Vec<String> = Vec::new();
    for (_, all) in named {
        let mut fitting = all.clone();
        if let Some((tokens, name)) = &mode
            && all.iter().any(|device| device.ends_with(name))
        {
            fitting.retain(|device| device.ends_with(name));
            words.push(tokens.clone());
        }
        if let Some(khz) = frequency {
            fitting = nearest(&all, khz);
        }
        for device in fitting {
            if !devices.contains(&device) {
                devices.push(device);
            }
        }
    }
    for tokens in &words {
        reading.take(tokens.clone());
    }
    reading.wish.sonar.devices = Some(reading.said_by(&words, devices));
}

/// The devices that a name at a token fits: all modes of it.
fn device_at(reading: &Reading<'_>, at: usize) -> Option<(usize, Vec<String>)> {
    let squeezed = |text: &str| -> String { text.chars().filter(|c| c.is_ascii_alphanumeric()).collect() };
    // Words are looked at as they were written, in any case.
    let written: Vec<String> = (at..reading.len().min(at + 7))
        .map(|next| squeezed(&reading.text.words(next..next + 1).to_lowercase()))
        .collect();
    let mut best: Option<(usize, usize, Vec<String>)> = None;
    for count in 1..=written.len() {
        if written[count - 1].is_empty() && !reading.text.is_mark(at + count - 1, '-') {
            break;
        }
        let joined = written[..count].concat();
        let fitting: Vec<String> =
            DEVICES.iter().map(|(name, _)| *name).filter(|name| fits(name, &joined)).map(str::to_owned).collect();
        let better = best.as_ref().is_none_or(|(letters, ..)| joined.len() > *letters);
        if !fitting.is_empty() && better && !written[count - 1].is_empty() {
            best = Some((joined.len(), count, fitting));
        }
    }
    best.map(|(_, count, devices)| (count, devices))
}

/// Whether a name without blanks means a device: maker and model, or one of them where it tells enough.
fn fits(device: &str, said: &str) -> bool {
    let parts: Vec<&str> = device.split('-').collect();
    let modes: Vec<&str> = parts.iter().copied().filter(|part| MODES.contains(part)).collect();
    let own: Vec<&str> = parts.iter().copied().filter(|part| !MODES.contains(part)).collect();
    let (maker, model) = (own[0], own[1..].concat());
    let number: String = model.chars().filter(char::is_ascii_digit).collect();
    let mut names = vec![maker.to_owned(), format!("{maker}{model}"), model.clone()];
    names.push(format!("{maker}{}", model.trim_end_matches(|c: char| c.is_ascii_alphabetic())));
    // `M1200d` is also called `M1200`; a mere number says nothing.
    names.push(model.trim_end_matches(|c: char| c.is_ascii_alphabetic()).to_owned());
    if let Some(first) = own.get(1) {
        names.extend([format!("{maker}{first}"), (*first).to_owned()]);
        let digits: String = first.chars().filter(char::is_ascii_digit).collect();
        names.push(format!("{maker}{digits}"));
        names.push(format!("{maker}{}", first.trim_end_matches(|c: char| c.is_ascii_alphabetic())));
        names.push(first.trim_end_matches(|c: char| c.is_ascii_alphabetic()).to_owned());
    }
    names.push(format!("{maker}{number}"));
    names.retain(|name| name.chars().any(|c| c.is_ascii_alphabetic()) && name.len() > 2);
    names.retain(|name| name != "3d" && name != "nav");
    names.iter().any(|name| said == name || modes.iter().any(|mode| said == format!("{name}{mode}")))
        || (maker == "waterlinked" && matches!(said, "waterlinked" | "3d15" | "sonar3d15" | "waterlinkedsonar3d15"))
        || (maker == "imagenex"
            && matches!(said, "deltat" | "imagenexdeltat" | "imagenex837" | "deltat837" | "837deltat"))
}

/// The mode that words tell: the end of the names of its device files.
fn mode(reading: &Reading<'_>) -> Option<(Range<usize>, &'static str)> {
    [
        (Word::LowFrequency, "-lf"),
        (Word::HighFrequency, "-hf"),
        (Word::NavigationMode, "-nav"),
        (Word::InspectionMode, "-insp"),
    ]
    .into_iter()
    .find_map(|(word, end)| reading.find(word).map(|tokens| (tokens, end)))
}

/// The frequency that stands somewhere in the prompt, kilohertz.
fn frequency_khz(reading: &Reading<'_>) -> Option<f64> {
    (0..reading.len()).filter(|&at| reading.is_free(at)).find_map(|at| {
        let found = super::quantity::quantity_at(&reading.text, at)?;
        (found.measure == super::quantity::Measure::Frequency).then(|| found.amount.ends()[0])
    })
}

/// Those whose frequency is nearest, where one is near at all.
fn nearest(devices: &[String], khz: f64) -> Vec<String> {
    let of = |device: &String| {
        let text = crate::catalog::sonars::find(device)?;
        let line = text.lines().find_map(|line| line.strip_prefix("frequency_khz: "))?;
        line.trim().parse::<f64>().ok()
    };
    let off = |device: &String| of(device).map_or(f64::INFINITY, |own| (own - khz).abs() / khz.max(1.0));
    let best = devices.iter().map(off).fold(f64::INFINITY, f64::min);
    devices.iter().filter(|device| off(device) <= best + 1e-9).cloned().collect()
}
