//! Seabeds of every kind as grids.

use super::*;

fn spec(shape: &str) -> SeabedSpec {
    let text = format!("{{shape: {shape}, sediment: fine-sand, extent_m: 20, cell_m: 0.05}}");
    read(&text).expect(shape)
}

/// As recipes are read: YAML to a tree, the tree to types.
fn read<T: serde::de::DeserializeOwned>(text: &str) -> Result<T, serde_json::Error> {
    serde_json::from_value(serde_yaml::from_str(text).expect("YAML"))
}

const FRACTAL: &str = "{fractal: {rms_m: 0.12, longest_m: 8, shortest_m: 0.2, hurst: 0.8}}";
const RIPPLES: &str =
    "{ripples: {wavelength_m: 0.4, height_m: 0.05, direction_deg: 30, irregularity: 0.3, rms_m: 0.02}}";

fn build(shape: &str, seed: u64) -> HeightGrid {
    spec(shape).build(&no_files(), &mut Stream::at(seed, "scene", 0, "seabed")).expect(shape)
}

fn no_files() -> AssetCache {
    AssetCache::new(std::path::Path::new("."))
}

fn moments(grid: &HeightGrid) -> (f64, f64) {
    let n = grid.heights().len() as f64;
    let mean = grid.heights().iter().map(|&h| f64::from(h)).sum::<f64>() / n;
    let square = grid.heights().iter().map(|&h| (f64::from(h) - mean) * (f64::from(h) - mean)).sum::<f64>() / n;
    (mean, square.sqrt())
}

#[test]
fn means_are_zero_and_heights_as_asked() {
    let (mean, rms) = moments(&build("{flat: {}}", 1));
    assert_eq!((mean, rms), (0.0, 0.0));
    for seed in 0..4 {
        let (mean, rms) = moments(&build(FRACTAL, seed));
        assert!(mean.abs() < 1e-6 && (rms - 0.12).abs() < 1e-4, "{mean} {rms}");
    }
    let straight = RIPPLES.replace("irregularity: 0.3, rms_m: 0.02", "irregularity: 0, rms_m: 0");
    let grid = build(&straight, 3);
    let (low, high) = grid.heights().iter().fold((f32::MAX, f32::MIN), |(a, b), &h| (a.min(h), b.max(h)));
    assert!(((high - low) - 0.05).abs() < 5e-4, "{low} {high}");
    assert!(moments(&grid).0.abs() < 1e-6);
}

#[test]
fn one_seed_gives_one_seabed() {
    for shape in [FRACTAL, RIPPLES] {
        assert_eq!(build(shape, 5).heights(), build(shape, 5).heights());
        assert_ne!(build(shape, 5).heights(), build(shape, 6).heights());
    }
}

#[test]
fn ripples_run_across_their_direction() {
    let along = |direction: &str| {
        let grid = build(&RIPPLES.replace("direction_deg: 30", direction).replace("rms_m: 0.02", "rms_m: 0"), 2);
        // Steps of half a wavelength along x turn crests into troughs if the ripples travel along x.
        let pairs = (0..300).map(|k| -8.0 + 0.05 * f64::from(k));
        pairs.map(|x| grid.height(x, 1.0) * grid.height(x + 0.2, 1.0)).sum::<f64>()
    };
    assert!(along("direction_deg: 0") < 0.0, "{}", along("direction_deg: 0"));
    assert!(along("direction_deg: 90") > 0.0, "{}", along("direction_deg: 90"));
}

#[test]
fn what_cannot_be_built_is_refused_with_a_remedy() {
    let with = |shape: &str, edit: &dyn Fn(&mut SeabedSpec)| {
        let mut spec = spec(shape);
        edit(&mut spec);
        spec.check(&no_files()).expect_err(shape).to_string()
    };
    assert!(with("{flat: {}}", &|s| s.cell_m = 0.005).contains("take cells of 0.006 m"));
    assert!(with("{flat: {}}", &|s| s.extent_m = -1.0).contains("extent_m is -1"));
    assert!(with("{flat: {}}", &|s| s.cell_m = f64::NAN).contains("cell_m"));
    assert!(with(RIPPLES, &|s| s.cell_m = 0.2).contains("wavelength_m is 0.4 m"));
    assert!(with(FRACTAL, &|s| s.cell_m = 0.15).contains("shortest_m"));
    let backwards = FRACTAL.replace("longest_m: 8", "longest_m: 0.1");
    assert!(with(&backwards, &|_| ()).contains("longest_m"));
    assert!(read::<Shape>("{flat: {rms_m: 1}}").is_err());
}

/// Lowest and highest height.
fn range(grid: &HeightGrid) -> (f64, f64) {
    let (low, high) = grid.heights().iter().fold((f32::MAX, f32::MIN), |(a, b), &h| (a.min(h), b.max(h)));
    (low.into(), high.into())
}

/// Part of the cells that are of another sediment than the seabed's.
fn covered(grid: &HeightGrid) -> f64 {
    grid.cover.iter().filter(|&&cover| cover > 0).count() as f64 / (grid.cells * grid.cells) as f64
}

#[test]
fn slopes_rise_as_steeply_as_asked() {
    let grid = build("{slope: {angle_deg: 30, direction_deg: 90, rms_m: 0, longest_m: 5}}", 1);
    assert!((grid.height(1.0, 4.0) - grid.height(1.0, -2.0) - 6.0 / 3f64.sqrt()).abs() < 1e-5);
    assert!((grid.height(-5.0, 3.0) - grid.height(5.0, 3.0)).abs() < 1e-5);
}

#[test]
fn trenches_are_as_deep_as_asked() {
    let grid =
        build("{pipeline-trench: {floor_m: 1, depth_m: 0.8, side_deg: 45, direction_deg: 0, bank_m: 0, rms_m: 0}}", 1);
    let (low, high) = range(&grid);
    assert!((high - low - 0.8).abs() < 1e-5);
    assert!((grid.height(3.0, 0.0) - low).abs() < 1e-5 && (grid.height(3.0, 4.0) - high).abs() < 1e-5);
    let dredged =
        "{trench: {width_m: 2, depth_m: 0.4, spacing_m: 6, direction_deg: 40, bank_m: 0.1, wander_m: 0.3, rms_m: 0}}";
    let (low, high) = range(&build(dredged, 1));
    assert!((0.35..0.75).contains(&(high - low)), "{low} {high}");
}

#[test]
fn stones_stand_on_the_ground_and_have_their_own_sediment() {
    let rocks = |per: u32| {
        let text = format!("{{per_100_m2: {per}, size_m: [0.5, 2], burial: 0.2, sediment: rock, rms_m: 0}}");
        build(&format!("{{rock-field: {text}}}"), 2)
    };
    assert_eq!(covered(&rocks(0)), 0.0);
    let grid = rocks(10);
    // Forty rocks; each covers something between a third and all of the square about it.
    assert!((0.02..0.3).contains(&covered(&grid)), "{}", covered(&grid));
    assert_eq!(grid.sediments(), ["fine-sand", "rock"]);
    let (low, high) = range(&grid);
    assert!((0.3..1.2).contains(&(high - low)), "{low} {high}");
    let on_rock = grid.mesh().clusters.iter().filter(|cluster| cluster.material == 1).flat_map(|c| c.z.clone()).count();
    assert!(on_rock > 1000);
    let rubble = |cover: f64| {
        let text = format!("{{cover: {cover}, size_m: [0.2, 0.6], sediment: cobbles, rms_m: 0}}");
        covered(&build(&format!("{{rubble: {text}}}"), 2))
    };
    // Stones that lie as they fall cover 1 − exp(−cover) of the ground, a little less for what is sunk.
    for cover in [0.3, 1.0] {
        let expected = 1.0 - crate::math::real::exp(-cover);
        assert!((rubble(cover) / expected - 0.9).abs() < 0.15, "{} for {expected}", rubble(cover));
    }
}

#[test]
fn a_reef_is_terraced_and_covers_its_share() {
    let text = "{reef: {relief_m: 1.5, ledges: 3, patch_m: 3, share: 0.4, heads_per_100_m2: 0, head_m: [0.4, 1], \
                sediment: rough-rock, rms_m: 0}}";
    let grid = build(text, 3);
    assert!((covered(&grid) - 0.4).abs() < 0.03, "{}", covered(&grid));
    let (low, _) = range(&grid);
    let on_terrace =
        grid.heights().iter().map(|&h| (f64::from(h) - low) / 0.5).filter(|h| (h - h.round()).abs() < 1e-3);
    let level = on_terrace.count() as f64 / grid.heights().len() as f64;
    assert!(level > 0.9, "{level} of the reef is level");
}

#[test]
fn sand_waves_carry_ripples() {
    let text = |ripple: f64| {
        format!(
            "{{sand-waves: {{wavelength_m: 5, height_m: 0.5, direction_deg: 0, irregularity: 0, ripple_wavelength_m: 0.4, \
             ripple_height_m: {ripple}, ripple_turn_deg: 0, rms_m: 0}}}}"
        )
    };
    let (low, high) = range(&build(&text(0.0), 1));
    assert!((high - low - 0.5).abs() < 1e-3, "{low} {high}");
    let (low, high) = range(&build(&text(0.1), 1));
    assert!((0.52..0.61).contains(&(high - low)), "{low} {high}");
}
