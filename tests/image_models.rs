//! The image models of two papers: their means, their equations against the reference values, and whole datasets.

mod support;

use std::fs;

use ensonify::image::{DeepSonar, ImageModel};
use ensonify::physics::Water;
use ensonify::recipe::Recipe;
use ensonify::sonar::{Echoes, Keep, RayRange, Sonar, Tracer};
use glam::Vec3;
use support::cli::{Desk, messages, small_recipe};
use support::{Builder, cuboid, floor, looking, sonar};

/// A ping over a flat seabed, its rays counted.
fn over_a_flat_seabed(elevations: u32, range: RayRange) -> Echoes {
    let scene = Builder::new().background(floor(100.0, 0.0)).scene();
    let sonar = Sonar { elevation_deg: 20.0, elevations, ..sonar(16, 60.0, [0.5, 20.0], 512) };
    let keep = Keep { rays: Some(range), ..Keep::ENERGY };
    Tracer::new(&sonar).trace(&scene, &looking([0.0, 0.0, 2.0], 0.0, -15.0), keep)
}

#[test]
fn the_mean_of_a_cell_does_not_depend_on_the_number_of_elevations() {
    let [coarse, fine] = [150, 1201].map(|elevations| over_a_flat_seabed(elevations, RayRange::Slant));
    let [few, many] = [&coarse, &fine].map(|echoes| echoes.rays.as_ref().expect("asked for"));
    let grid = &fine.grid;
    // The lower edge of the aperture meets the seabed at 4.7 m ahead and at 5.2 m in the outermost beams.
    for beam in 0..grid.beams {
        for bin in grid.bin_of(5.3).expect("inside")..grid.bins - 1 {
            let (cell, cosine) = (grid.cell(beam, bin), 2.0 / grid.range_m(bin));
            for (rays, tolerance) in [(few, 0.02), (many, 0.005)] {
                let mean = f64::from(rays.mean()[cell]);
                assert!((mean / cosine - 1.0).abs() < tolerance, "{:.2} m: {mean}, not {cosine}", grid.range_m(bin));
            }
        }
    }
    let total = |rays: &ensonify::sonar::Rays| f64::from(rays.count.iter().sum::<f32>());
    assert!((total(many) / total(few) / (1201.0 / 150.0) - 1.0).abs() < 0.02, "rays are counted as rays");
}

#[test]
fn a_horizontal_range_is_the_slant_range_times_the_cosine_of_elevation() {
    // A plate 8 m ahead fills one slant range after another; in the horizontal plane it is one line.
    let scene = Builder::new().body(cuboid(Vec3::new(8.0, -8.0, -8.0), Vec3::new(8.5, 8.0, 8.0))).scene();
    let sonar = Sonar { elevation_deg: 40.0, ..sonar(1, 0.2, [0.5, 10.0], 950) };
    let bins = |range| {
        let keep = Keep { rays: Some(range), ..Keep::ENERGY };
        let echoes = Tracer::new(&sonar).trace(&scene, &looking([0.0; 3], 0.0, 0.0), keep);
        let rays = echoes.rays.expect("asked for");
        let lit: Vec<f64> =
            (0..950).filter(|&bin| rays.count[bin as usize] > 0.0).map(|bin| echoes.grid.range_m(bin)).collect();
        [lit[0], lit[lit.len() - 1]]
    };
    let [near, far] = bins(RayRange::Slant);
    assert!((near - 8.0).abs() < 0.02 && (far - 8.0 / 20f64.to_radians().cos()).abs() < 0.02, "{near} {far}");
    let [near, far] = bins(RayRange::Horizontal);
    assert!((near - 8.0).abs() < 0.02 && (far - 8.0).abs() < 0.02, "{near} {far}");
}

#[test]
fn the_printed_equations_differ_from_the_right_ones_by_the_stated_factors() {
    let Some(rows) = support::reference_rows("deepsonar_error") else { return };
    for row in rows {
        let input = |key: &str| row["inputs"][key].as_f64().expect("a number");
        let expected = |key: &str| row["expected"][key].as_f64().expect("a number");
        let water = Water {
            temperature_c: input("T_C"),
            salinity_ppt: input("S_ppt"),
            ph: input("pH"),
            depth_m: input("depth_m"),
        };
        let model = |as_printed| DeepSonar { as_printed, speckle_sigma: 0.0, noise_sigma: 0.0, white: 1.0 };
        for range_m in [2.0, 15.0] {
            let left = |as_printed| model(as_printed).transmission(input("f_kHz"), &water, range_m);
            let right = (-0.230_258_5 * expected("correct_AM98") * 2.0 * range_m / 1000.0).exp();
            let printed = (-0.023 * expected("as_printed_z_in_m") * range_m / 1000.0).exp();
            for (found, stated) in [(left(false), right), (left(true), printed)] {
                // The rows' tolerance is that of the absorption, which stands in the exponent.
                let tolerance = 1.1e-3 * stated.ln().abs();
                assert!(
                    (found.ln() - stated.ln()).abs() < tolerance,
                    "{} at {range_m} m: {found}, not {stated}",
                    row["id"]
                );
            }
        }
    }
}

#[test]
fn every_model_makes_a_dataset_and_the_same_one_again() {
    let desk = Desk::new();
    desk.file("a.yaml", &small_recipe(1));
    let picture = |model: &str, folder: &str| {
        let set = format!("image.model={model}");
        let output = desk.run(&["run", "a.yaml", "-o", folder, "--set", &set, "--limit", "1"]);
        assert!(output.status.success(), "{model}: {}", messages(&output));
        fs::read(desk.path().join(folder).join("images/polar/000000.png")).expect("a picture")
    };
    let models = ["physical", "deepsonar", "{deepsonar: {as_printed: true, speckle_sigma: 0.2}}", "holoocean"];
    let pictures: Vec<Vec<u8>> =
        models.iter().enumerate().map(|(i, model)| picture(model, &format!("out{i}"))).collect();
    for (i, a) in pictures.iter().enumerate() {
        assert!(pictures[..i].iter().all(|b| a != b), "{} has a picture of its own", models[i]);
        assert!(*a == picture(models[i], &format!("again{i}")), "{}", models[i]);
    }
    // Masks come from the same noise-free echoes, whatever the model.
    let mask = |i| fs::read(desk.path().join(format!("out{i}/masks/polar/000000.png"))).expect("a mask");
    assert!(mask(0) == mask(1) && mask(0) == mask(3));
}

#[test]
fn a_wrong_parameter_is_refused_where_it_stands() {
    for (model, words) in [
        ("{deepsonar: {speckle_sigma: 2}}", "2 is outside 0 to 1"),
        ("{holoocean: {add_sigma: -1}}", "-1 is outside 0 to 10"),
        ("{holoocean: {addsigma: 1}}", "add_sigma"),
        ("deepsona", "deepsonar"),
    ] {
        let desk = Desk::new();
        let recipe = small_recipe(1);
        desk.file("a.yaml", &format!("{recipe}image: {{model: {model}}}\n"));
        let output = desk.run(&["check", "a.yaml"]);
        let message = messages(&output);
        assert_eq!(output.status.code(), Some(2), "{message}");
        let place = format!("error: a.yaml:{}:", recipe.lines().count() + 1);
        assert!(message.starts_with(&place) && message.contains(words), "{message}");
    }
}

#[test]
fn a_model_asks_for_the_rays_that_it_needs() {
    let rays = |model: &str| {
        let recipe = Recipe::parse("a.yaml", &format!("image: {{model: {model}}}")).expect("YAML");
        let image: ImageModel = recipe.completed().section("image").expect("a model").expect("there");
        image.rays()
    };
    assert_eq!(rays("physical"), None);
    assert_eq!(rays("deepsonar"), Some(RayRange::Slant));
    assert_eq!(rays("{deepsonar: {as_printed: true}}"), Some(RayRange::Horizontal));
    assert_eq!(rays("holoocean"), Some(RayRange::Slant));
}
