//! `ensonify preview`: a contact sheet of a few frames.

use std::path::{Path, PathBuf};

use anyhow::Context as _;
use clap::Args;

use super::{Code, RecipeArgs};
use crate::label::{View, ViewLabels};
use crate::plan::{Header, Plan, Raw};
use crate::run::render::{Frame, Picture, Renderer};
use crate::run::{Project, World, spread};
use crate::store::png;
use crate::view::{GreyImage, SheetFrame, contact_sheet};

/// Draws a contact sheet of a few frames of a recipe or a plan
///
/// Each row is one frame in one look: the polar and the fan image, each without and with its masks and boxes. The frames are those
/// that `run` would make, taken evenly from all of them.
#[derive(Debug, Args)]
pub struct Preview {
    #[command(flatten)]
    recipe: RecipeArgs,
    /// The picture [default: out/NAME-preview.png]
    #[arg(short, long, value_name = "PNG")]
    output: Option<PathBuf>,
    /// How many frames
    #[arg(short = 'n', long, value_name = "N", default_value_t = 6, value_parser = clap::value_parser!(u32).range(1..=60))]
    frames: u32,
}

impl Preview {
    pub(super) fn run(&self) -> anyhow::Result<Code> {
        let path = draw(&self.recipe.load()?, self.output.as_deref(), self.frames)?;
        say!("{}", path.display());
        Ok(Code::Done)
    }
}

/// Draws the contact sheet of a project, into `out/NAME-preview.png` where no file is given; gives the file.
pub(super) fn draw(project: &Project, output: Option<&Path>, frames: u32) -> anyhow::Result<PathBuf> {
    let plan = &project.plan;
    let mut header = plan.header.clone();
    header.output.views = vec![View::Polar, View::Fan];
    header.output.raw = Raw::None;
    let ids = spread(plan.jobs.len() as u64, u64::from(frames));
    let rows = ids.iter().map(|&id| Row::render(project, &header, id)).collect::<anyhow::Result<Vec<_>>>()?;
    let frames: Vec<SheetFrame> = rows.iter().flat_map(Row::on_sheet).collect();
    let sheet = contact_sheet(&frames);

    let usual = || PathBuf::from(format!("out/{}-preview.png", header.name));
    let path = output.map_or_else(usual, Path::to_owned);
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder).with_context(|| format!("cannot create {}", folder.display()))?;
    }
    std::fs::write(&path, png::rgb8(sheet.width(), sheet.height(), sheet.as_raw()))
        .with_context(|| format!("cannot write {}; choose another file with -o", path.display()))?;
    Ok(path)
}

struct Row {
    /// One a look.
    titles: Vec<String>,
    frame: Frame,
    names: Vec<String>,
}

impl Row {
    fn render(project: &Project, header: &Header, id: u64) -> anyhow::Result<Self> {
        let plan: &Plan = &project.plan;
        let job = &plan.jobs[id as usize];
        let world = World::build(plan, plan.world_of(job), &project.assets)?;
        let frame = Renderer::default().render(header, job, &world)?;
        let device = job.sonar.device.as_deref().unwrap_or("sonar");
        let [near, far] = job.sonar.range_m;
        let variant = job.variant.as_ref().map(|id| format!("  {id}")).unwrap_or_default();
        let title = format!(
            "{id:06}{variant}  scene {}  frame {}  {}  {device} {near}-{far} m",
            job.scene, job.frame, job.split
        );
        let titles = job.looks.iter().map(|look| match &look.name {
            Some(name) => format!("{title}  look {name}"),
            None => title.clone(),
        });
        let titles = titles.collect();
        let names = world.scene().bodies.iter().map(|body| body.label.clone()).collect();
        Ok(Self { titles, frame, names })
    }

    /// A row of the sheet for each look.
    fn on_sheet(&self) -> Vec<SheetFrame<'_>> {
        let [polar, fan] = &self.frame.pictures[..] else { unreachable!("both views were asked for") };
        let row = |(look, title)| SheetFrame {
            title,
            polar: on_sheet(polar, look),
            fan: on_sheet(fan, look),
            names: &self.names,
        };
        self.titles.iter().map(String::as_str).enumerate().map(row).collect()
    }
}

fn on_sheet(picture: &Picture, look: usize) -> (GreyImage<'_>, &ViewLabels) {
    let (width, height) = (picture.labels.width, picture.labels.height);
    (GreyImage { width, height, pixels: &picture.looks[look] }, &picture.labels)
}
