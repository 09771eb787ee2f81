//! A rendered frame as files and a record; a project as the words of its dataset card.

use std::collections::BTreeMap;

use super::Project;
use super::render::{Frame, pose_numbers};
use super::world::World;
use crate::export::{Attribution, FinishInput};
use crate::plan::{Job, Packing, Plan, Split};
use crate::scene::{Built, asset_name};
use crate::store::{Fate, FrameRecord, Misplaced, NewFile, ViewRecord, exr, layout, png};

/// The record of a frame and the files that it brings.
pub(super) fn of_frame(plan: &Plan, job: &Job, world: &World, frame: Frame) -> (FrameRecord, Vec<NewFile>) {
    let name = layout::frame_name(job.id, job.variant.as_deref());
    let mut files = Vec::new();
    let mut views = BTreeMap::new();
    for picture in frame.pictures {
        let (width, height) = (picture.labels.width, picture.labels.height);
        let mask = png::grey16(width, height, &picture.labels.mask);
        for (look, grey) in job.looks.iter().zip(&picture.looks) {
            let path = layout::image(picture.view, &name, look.name.as_deref());
            files.push(NewFile { path, bytes: png::grey8(width, height, grey) });
        }
        files.push(NewFile { path: layout::mask(picture.view, &name), bytes: mask });
        views.insert(picture.view, ViewRecord::new(&picture.labels, &world.scene().bodies));
    }
    if let Some(raw) = frame.raw {
        files.push(NewFile { path: layout::raw(&name), bytes: exr::encode(raw) });
    }
    let mut values = plan.scene_of(job).drawn.clone();
    values.extend(job.drawn.clone());
    let record = FrameRecord {
        id: job.id,
        name,
        variant: job.variant.clone(),
        scene: job.scene,
        frame: job.frame,
        split: job.split.name().to_owned(),
        pose: pose_numbers(&frame.world_from_sonar),
        time_s: frame.time_s,
        moved_m: frame.moved_m,
        values,
        looks: job.looks.iter().filter_map(|look| look.name.clone()).collect(),
        views,
        misplaced: if job.frame == 0 { misplaced(world) } else { Vec::new() },
        files: Vec::new(),
    };
    (record, files)
}

/// What finishing needs beside the frames' records, as the store keeps it.
///
/// # Panics
/// Never: it is plain data.
#[must_use]
pub fn finish_facts(project: &Project) -> Vec<u8> {
    let mut text = serde_json::to_vec_pretty(&finish_input(project)).expect("plain data");
    text.push(b'\n');
    text
}

/// Objects that the scene does not have, or not as it should.
fn misplaced(world: &World) -> Vec<Misplaced> {
    let Built { dropped, overlaps, .. } = world.built();
    let left_out = dropped.iter().map(|object| Misplaced {
        label: object.label.clone(),
        asset: object.asset.clone(),
        fate: Fate::LeftOut,
        reason: object.reason.clone(),
    });
    let through = overlaps.iter().map(|object| Misplaced {
        label: object.label.clone(),
        asset: object.asset.clone(),
        fate: Fate::Overlaps,
        reason: object.with.clone(),
    });
    left_out.chain(through).collect()
}

/// What annotations, card and attributions say beside the frames.
pub(super) fn finish_input(project: &Project) -> FinishInput {
    let plan = &project.plan;
    let attribution = |(key, lock): (&String, &crate::plan::AssetLock)| Attribution {
        uid: key.rsplit_once('/').map_or_else(|| key.clone(), |(catalog, uid)| asset_name(catalog, uid)),
        name: lock.name.clone(),
        attribution: lock.attribution.clone(),
        licence: lock.licence.clone(),
        source: lock.source.clone(),
    };
    let mut attributions: Vec<Attribution> = plan.assets.iter().map(attribution).collect();
    attributions.sort();
    attributions.dedup();
    FinishInput {
        description: format!("Synthetic forward-looking sonar: {}", plan.header.name),
        seed: plan.header.seed,
        views: plan.header.output.views.clone(),
        splits: Split::ALL.map(|split| split.name().to_owned()).to_vec(),
        categories: categories(project),
        objects: plan.scenes.iter().map(|scene| scene.spec.bodies.len() as u64).sum(),
        facts: facts(plan),
        attributions,
    }
}

/// Labels of the objects, and of the environments' parts.
fn categories(project: &Project) -> Vec<String> {
    let mut labels: std::collections::BTreeSet<String> = project.plan.planned_labels().into_iter().collect();
    for spec in project.plan.scenes.iter().filter_map(|scene| scene.spec.environment.as_ref()) {
        labels.extend(spec.part_labels(&project.assets));
    }
    labels.into_iter().collect()
}

/// Rows about the sonars and ranges of a plan.
fn facts(plan: &Plan) -> Vec<(String, String)> {
    let mut sonars: Vec<String> = Vec::new();
    for job in &plan.jobs {
        let sonar = &job.sonar;
        let [near, far] = sonar.range_m;
        let name = sonar.device.as_deref().unwrap_or("written out in the recipe");
        let text = format!(
            "{name}: {} kHz, {} beams over {}°, {} bins over {near}–{far} m",
            sonar.frequency_khz, sonar.beams, sonar.azimuth_deg, sonar.range_bins
        );
        if !sonars.contains(&text) {
            sonars.push(text);
        }
        if sonars.len() > 8 {
            sonars.push("…".to_owned());
            break;
        }
    }
    let mut facts =
        vec![("Sonar".to_owned(), sonars.join("; ")), ("Scenes".to_owned(), plan.header.scenes.to_string())];
    let output = &plan.header.output;
    if output.pack == Packing::Tar {
        let frame = layout::frame_name(0, plan.variants.first().map(|variant| variant.id.as_str()));
        let path = layout::image(output.views[0], &frame, None);
        let text =
            format!("{} frames a tar file: `{path}` is `{}` there", output.tar_frames, layout::member(&frame, &path));
        facts.push(("Files".to_owned(), format!("in `{}/`, {text}", layout::TARS)));
    }
    facts.extend(plan.variants.iter().map(|variant| (format!("Variant {}", variant.id), variant.description.clone())));
    facts
}
