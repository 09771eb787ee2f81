//! Draws every kind of seabed and environment, as a sonar sees it, on one sheet.
//!
//! `cargo run --release --example gallery -- out/gallery.png`

use std::path::Path;

use anyhow::{Context as _, Result, ensure};
use ensonify::label::View;
use ensonify::plan::compile;
use ensonify::recipe::{DEFAULTS, Origin, Recipe, parse};
use ensonify::run::World;
use ensonify::run::render::Renderer;
use ensonify::scene::AssetCache;
use font8x8::UnicodeFonts as _;
use image::{GrayImage, Luma, imageops};

/// Fans side by side.
const COLUMNS: u32 = 4;
/// Pixels about a fan; its caption stands in those above it.
const MARGIN: u32 = 14;

/// A world and where the sonar hovers in it: x, y, z in metres, then yaw and pitch in degrees.
struct Sight {
    caption: String,
    world: String,
    hover: [f64; 5],
    range_m: f64,
}

fn main() -> Result<()> {
    let path = std::env::args_os().nth(1).context("usage: gallery PICTURE.png")?;
    let folder = tempfile::tempdir()?;
    std::fs::write(folder.path().join("dunes.csv"), "0,1,0,0,1\n0,2,1,0,1\n0,1,2,1,0\n1,0,1,2,0\n0,0,0,1,1\n")?;
    let fans = sights()?.iter().map(|sight| fan(sight, folder.path())).collect::<Result<Vec<_>>>()?;
    let (wide, high) = fans.iter().fold((0, 0), |(w, h), fan| (w.max(fan.width()), h.max(fan.height())));
    let rows = (fans.len() as u32).div_ceil(COLUMNS);
    let mut sheet = GrayImage::from_pixel(COLUMNS * (wide + MARGIN), rows * (high + 2 * MARGIN), Luma([24]));
    for (number, fan) in (0..).zip(&fans) {
        let (left, top) = (number % COLUMNS * (wide + MARGIN), number / COLUMNS * (high + 2 * MARGIN));
        imageops::replace(&mut sheet, fan, i64::from(left + MARGIN / 2), i64::from(top));
    }
    sheet.save(&path).with_context(|| format!("cannot write {}", Path::new(&path).display()))
}

/// Every kind that the defaults list, and patches.
fn sights() -> Result<Vec<Sight>> {
    let mut sights = Vec::new();
    for kind in kinds("seabed.shape")? {
        let shape = match kind.as_str() {
            "height-map" => "{height-map: {file: dunes.csv, height_m: 2}}",
            kind => kind,
        };
        let extent_m = if kind == "height-map" { 18 } else { 40 };
        let world = format!("seabed: {{extent_m: {extent_m}, shape: {shape}}}");
        sights.push(Sight { caption: kind, world, hover: [-7.0, 0.0, 3.0, 20.0, -18.0], range_m: 14.0 });
    }
    let beds = "[{sediment: gravel, share: 0.3, size_m: 2}, {sediment: rock, where: crests, share: 0.05}]";
    let world = format!("seabed: {{extent_m: 40, shape: fractal, sediment: mud, patches: {beds}}}");
    let hover = [-7.0, 0.0, 3.0, 20.0, -18.0];
    sights.push(Sight { caption: "patches".into(), world, hover, range_m: 14.0 });
    for kind in kinds("environment.kind")? {
        let (hover, range_m) = match kind.as_str() {
            "pier" => ([6.0, -9.0, 2.5, 120.0, -10.0], 20.0),
            "dam" => ([-4.0, -8.0, 4.0, 20.0, -5.0], 20.0),
            "harbour" => ([3.0, -3.0, 3.0, 150.0, -8.0], 25.0),
            "tank" => ([-4.0, 0.0, 2.0, 10.0, -10.0], 12.0),
            "net-pen" => ([-16.0, 2.0, 7.0, 0.0, -5.0], 30.0),
            _ => ([-8.0, -4.0, 3.0, 25.0, -18.0], 14.0),
        };
        let shape = if kind == "tank" { "flat" } else { "{fractal: {rms_m: 0.06, longest_m: 5}}" };
        let seabed = format!("seabed: {{extent_m: 80, shape: {shape}, sediment: silt}}");
        let world = format!("{seabed}\nenvironment: {{kind: {kind}, labels: none}}");
        sights.push(Sight { caption: kind, world, hover, range_m });
    }
    let wreck = "objects: [{pick: {catalog: starter, label: boat}, pose: {rest: {within_m: 0, burial: 0.15, tip_deg: 20, yaw_deg: 60}}}]";
    let world = format!("seabed: {{extent_m: 40, shape: ripples, sediment: silt}}\n{wreck}");
    sights.push(Sight { caption: "wreck".into(), world, hover: [-6.0, 0.0, 3.0, 0.0, -18.0], range_m: 12.0 });
    Ok(sights)
}

fn kinds(place: &str) -> Result<Vec<String>> {
    let defaults = parse("defaults", DEFAULTS, Origin::BuiltIn)?;
    let kinds = defaults.get("kinds").and_then(|kinds| kinds.get(place)).context("no such place of kinds")?;
    Ok(kinds.entries().iter().map(|(key, _)| key.text.clone()).collect())
}

/// The fan image of a sight under its caption.
fn fan(sight: &Sight, folder: &Path) -> Result<GrayImage> {
    let Sight { caption, world, hover: [x, y, z, yaw, pitch], range_m } = sight;
    let text = format!(
        "ensonify: 1\nname: gallery\nseed: 3\nframes: 1\n\
         sonar: {{device: oculus-m1200d-lf, range_m: [0.5, {range_m}], mount: {{pitch_deg: {pitch}}}}}\n\
         trajectory: {{hover: {{position_m: [{x}, {y}, {z}], yaw_deg: {yaw}}}}}\n\
         output: {{views: [fan], fan_height_px: 260}}\n{world}\n"
    );
    let assets = AssetCache::new(folder);
    let plan = compile(&Recipe::parse(caption, &text)?, "gallery", folder, &assets)?;
    let built = World::build(&plan.scenes[0], &assets)?;
    let frame = Renderer::default().render(&plan.header, &plan.jobs[0], &built)?;
    let picture = frame.pictures.into_iter().find(|picture| picture.view == View::Fan).context("no fan")?;
    ensure!(!picture.looks.is_empty(), "no look");
    let (width, height) = (picture.labels.width, picture.labels.height);
    let grey = GrayImage::from_raw(width, height, picture.looks[0].clone()).context("another size")?;
    let mut tile = GrayImage::from_pixel(width, height + MARGIN, Luma([24]));
    imageops::replace(&mut tile, &grey, 0, i64::from(MARGIN));
    write_caption(&mut tile, caption);
    Ok(tile)
}

fn write_caption(tile: &mut GrayImage, caption: &str) {
    for (place, letter) in (0..).zip(caption.chars()) {
        let rows = font8x8::BASIC_FONTS.get(letter).unwrap_or_default();
        for (row, column) in (0..8).flat_map(|row| (0..8).map(move |column| (row, column))) {
            if rows[row as usize] & (1 << column) != 0 {
                tile.put_pixel(4 + 8 * place + column, 3 + row, Luma([235]));
            }
        }
    }
}
