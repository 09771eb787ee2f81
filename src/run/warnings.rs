//! What can be run, but may not be what was meant: each in one line with its figures and a remedy.

use std::collections::{BTreeMap, BTreeSet};

use serde::Serialize;

use super::survey::{InView, Sight, Survey};
use crate::catalog::solidity::facet_error;
use crate::image::Channel;
use crate::image::reach::REACH_SEABED_DB;
use crate::physics::absorption::francois_garrison;
use crate::plan::{Plan, SplitBy};
use crate::scene::AssetCache;

/// Most warnings on acoustics.
const MOST_ACOUSTIC: usize = 8;
/// The most frequent class has more bodies than so many times those of the least frequent.
const UNBALANCED: u64 = 10;
/// Share of views below which a class is hardly ever in view.
const HARDLY: f64 = 0.05;
/// Most models that are told to be coarse.
const MOST_COARSE: usize = 8;
/// Speed of sound that resolutions are told by, m/s.
const NOMINAL_SPEED: f64 = 1500.0;
/// Most names in a line.
const MOST_NAMES: usize = 5;

/// Something that a person should know before a run.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Warning {
    /// What it is about, a stable word.
    pub kind: &'static str,
    /// One line.
    pub text: String,
}

/// What a plan's numbers tell.
#[must_use]
pub fn of_plan(plan: &Plan) -> Vec<Warning> {
    splits(plan).into_iter().chain(balance(plan)).chain(acoustics(plan)).collect()
}

/// Models that are coarser than the sonars resolve: their facets glint where the thing itself is round.
#[must_use]
pub fn of_models(plan: &Plan, assets: &AssetCache) -> Vec<Warning> {
    let bandwidth = plan.jobs.iter().map(|job| job.sonar.bandwidth_khz).fold(0.0, f64::max);
    let resolution = NOMINAL_SPEED / (2.0 * 1000.0 * bandwidth.max(1e-3));
    let bodies = plan.scenes.iter().flat_map(|scene| &scene.spec.bodies);
    let models: BTreeSet<(&str, &str)> = bodies.map(|body| (body.catalog.as_str(), body.uid.as_str())).collect();
    let coarse = models.into_iter().filter_map(|(catalog, uid)| {
        let solid = assets.solid(catalog, uid).ok()?;
        let error = facet_error(solid.mesh.triangles());
        let text = format!(
            "{catalog}/{uid} is coarse: its facets depart by {:.1} cm from the round shape that they stand for, and the sonar resolves \
             {:.1} cm in range; take a finer model",
            100.0 * error,
            100.0 * resolution
        );
        (error > resolution).then_some(Warning { kind: "coarse", text })
    });
    coarse.take(MOST_COARSE).collect()
}

/// What a look at some of its scenes tells.
#[must_use]
pub fn of_survey(survey: &Survey) -> Vec<Warning> {
    let mut warnings = Vec::new();
    let mut add = |kind, text: String| warnings.push(Warning { kind, text });
    for (label, sight) in &survey.labels {
        if let Some(text) = hardly(label, sight) {
            add("in-view", text);
        }
        if 2 * sight.small > sight.in_view {
            let (small, of) = (sight.small, sight.in_view);
            add(
                "resolution",
                format!(
                    "`{label}` is smaller than a cell of the sonar in {small} of {of} views; go nearer, or take more beams or range_bins"
                ),
            );
        } else if 2 * sight.faint > sight.in_view {
            let (faint, of) = (sight.faint, sight.in_view);
            add(
                "resolution",
                format!(
                    "`{label}` covers fewer than labels.min_pixels in {faint} of {of} views and is not labelled there; go nearer, or \
                 lower min_pixels"
                ),
            );
        }
    }
    if 2 * survey.empty > survey.frames {
        let (empty, of) = (survey.empty, survey.frames);
        add(
            "in-view",
            format!(
                "{empty} of {of} frames that were looked at have no object in view; point trajectory and mount at the objects"
            ),
        );
    }
    if let Some([height, slant]) = survey.first_groundless.filter(|_| 2 * survey.groundless > survey.frames) {
        let (some, of) = (survey.groundless, survey.frames);
        let why = if slant.is_finite() {
            format!("at {height:.1} m above it the lowest ray needs {slant:.1} m")
        } else {
            "no ray goes down".to_owned()
        };
        add(
            "range",
            format!(
                "{some} of {of} frames do not reach the bottom within range_m: {why}; fly lower, raise range_m or lower \
             mount.pitch_deg"
            ),
        );
    }
    if survey.moved > 0 {
        let (moved, of, farthest) = (survey.moved, survey.frames, survey.farthest_moved_m);
        add(
            "moved",
            format!(
                "{moved} of {of} frames are moved, by up to {farthest:.2} m, to keep clear of bottom, objects and structures; \
                 change the trajectory, or `vehicle: {{clear_m: …}}`"
            ),
        );
    }
    survey.overlaps.iter().take(3).for_each(|overlap| add("overlap", overlap.clone()));
    match &survey.dropped[..] {
        [] => {}
        [only] => add("dropped", format!("{only}; let it lie in a larger `within_m`")),
        [first, more @ ..] => add(
            "dropped",
            format!(
                "{first}; and {} more objects of the {} scenes that were looked at: take fewer, or a larger `within_m`",
                more.len(),
                survey.scenes
            ),
        ),
    }
    warnings
}

/// A class that is never in view, or seldom.
fn hardly(label: &str, sight: &Sight) -> Option<String> {
    if sight.in_view as f64 >= HARDLY * sight.views as f64 {
        return None;
    }
    let causes = [
        (sight.far, InView::Far, "go nearer, or raise range_m"),
        (sight.near, InView::Near, "keep off, or let range_m begin nearer"),
        (sight.beside, InView::Beside, "turn trajectory or mount towards it"),
        (sight.off_height, InView::OffHeight, "change the altitude or mount.pitch_deg"),
    ];
    let (count, cause, remedy) = causes.into_iter().max_by_key(|(count, ..)| *count)?;
    let Sight { views, in_view, .. } = sight;
    let what = cause.name();
    Some(format!("`{label}` is in view in {in_view} of {views} views that were looked at, {what} in {count}; {remedy}"))
}

/// Splits without frames, and splits without a class that others have.
fn splits(plan: &Plan) -> Vec<Warning> {
    let mut labels: BTreeMap<_, BTreeSet<&str>> = BTreeMap::new();
    for scene in &plan.scenes {
        labels.entry(scene.split).or_default().extend(scene.spec.bodies.iter().map(|body| body.label.as_str()));
    }
    let all: BTreeSet<&str> = labels.values().flatten().copied().collect();
    let mut warnings = Vec::new();
    for (split, share) in plan.header.splits.shares() {
        if share <= 0.0 {
            continue;
        }
        let Some(there) = labels.get(&split) else {
            let text = format!("no scene falls into the split {split}; more scenes fill it");
            warnings.push(Warning { kind: "splits", text });
            continue;
        };
        let missing: Vec<&str> = all.difference(there).copied().collect();
        if !missing.is_empty() {
            let (some, of) = (missing.len(), all.len());
            let dealt = plan.header.splits.by == SplitBy::Asset;
            let remedy = if dealt { "more scenes or `stratify: label` fill it" } else { "more scenes fill it" };
            let text = format!("the split {split} lacks {some} of {of} classes ({}); {remedy}", some_of(&missing));
            warnings.push(Warning { kind: "splits", text });
        }
    }
    warnings
}

/// Classes that are much rarer than others.
fn balance(plan: &Plan) -> Option<Warning> {
    let mut counts: BTreeMap<&str, u64> = BTreeMap::new();
    for body in plan.scenes.iter().flat_map(|scene| &scene.spec.bodies) {
        *counts.entry(&body.label).or_default() += 1;
    }
    let (most, many) = counts.iter().max_by_key(|(_, count)| **count)?;
    let rare: Vec<&str> =
        counts.iter().filter(|(_, few)| **few * UNBALANCED < *many).map(|(label, _)| *label).collect();
    (!rare.is_empty()).then(|| {
        let text = format!(
            "`{most}` stands {many} times in the scenes, {} classes less than a tenth of that ({}); change `count`, or give \
             rare classes an item of their own",
            rare.len(),
            some_of(&rare)
        );
        Warning { kind: "balance", text }
    })
}

/// What an acoustician would say of a plan's sonars and waters; each thing once.
fn acoustics(plan: &Plan) -> Vec<Warning> {
    let mut texts = BTreeSet::new();
    for job in &plan.jobs {
        let (sonar, far) = (&job.sonar, job.sonar.range_m[1]);
        let name = sonar.device.as_deref().unwrap_or("the sonar");
        for look in &job.looks {
            let reach = Channel::new(sonar, &look.water).reach_m();
            if far > reach {
                texts.insert(format!(
                    "{name} hears a seabed of {REACH_SEABED_DB} dB only to about {reach:.0} m: beyond it, up to its range_m of \
                     {far} m, images show noise"
                ));
            }
            for outside in francois_garrison(sonar.frequency_khz, &look.water.water).outside {
                texts.insert(format!("absorption is carried beyond its stated range: {outside}"));
            }
        }
        if texts.len() >= MOST_ACOUSTIC {
            break;
        }
    }
    texts.into_iter().map(|text| Warning { kind: "acoustics", text }).collect()
}

fn some_of(names: &[&str]) -> String {
    let shown = names[..names.len().min(MOST_NAMES)].join(", ");
    if names.len() > MOST_NAMES { format!("{shown} …") } else { shown }
}
