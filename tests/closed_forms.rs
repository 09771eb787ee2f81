//! Scenes whose answer is known in closed form.

mod support;

use ensonify::math::Pose;
use ensonify::sonar::{Bearing, Echoes, Keep, Sonar, Tracer, trace};
use glam::Vec3;
use serde_json::Value;
use support::{Builder, cuboid, floor, looking, reference_rows, sonar, sphere};

fn number(row: &Value, key: &str) -> f64 {
    row["inputs"][key].as_f64().or_else(|| row["expected"][key].as_f64()).unwrap_or_else(|| panic!("{key} in {row}"))
}

#[test]
fn a_sphere_appears_in_the_bins_of_the_table() {
    let Some(rows) = reference_rows("sphere_bins") else { return };
    for row in rows {
        let centre: Vec<f32> =
            row["inputs"]["center_xyz_m"].as_array().unwrap().iter().map(|v| v.as_f64().unwrap() as f32).collect();
        let ball = sphere(Vec3::new(centre[0], centre[1], centre[2]), number(&row, "radius_m") as f32, 180);
        let scene = Builder::new().body(ball).scene();
        let range_m = [number(&row, "r_min"), number(&row, "r_max")];
        for (bearing, key) in [(Bearing::Azimuth, "az_bin_geometric"), (Bearing::Cone, "az_bin_line_array")] {
            let sonar = Sonar {
                bearing,
                ..sonar(
                    number(&row, "n_beams") as u32,
                    number(&row, "fov_deg"),
                    range_m,
                    number(&row, "n_range") as u32,
                )
            };
            let echoes = trace(&scene, &sonar, &Pose::IDENTITY);
            let (beams, bins) = extent(&echoes);
            let id = &row["id"];
            let first = number(&row, "range_bin_first") as u32;
            let limb = number(&row, "range_bin_limb") as u32;
            assert!(bins.0.abs_diff(first) <= 1, "{id}: first range bin {} is not {first}", bins.0);
            assert!(bins.1.abs_diff(limb) <= 1, "{id}: limb range bin {} is not {limb}", bins.1);
            let middle = f64::from(beams.0 + beams.1) / 2.0;
            let expected = number(&row, key);
            assert!((middle - expected).abs() <= 1.0, "{id}: {bearing:?} beam {middle} is not {expected}");
        }
    }
}

/// First and last beam and bin with a body's echo.
fn extent(echoes: &Echoes) -> ((u32, u32), (u32, u32)) {
    let bins = echoes.grid.bins;
    let cells = || echoes.bodies.iter().map(|echo| echo.cell);
    let span = |values: Vec<u32>| (*values.iter().min().unwrap(), *values.iter().max().unwrap());
    (span(cells().map(|c| c / bins).collect()), span(cells().map(|c| c % bins).collect()))
}

#[test]
fn the_shadow_behind_a_box_has_the_length_of_the_table() {
    let Some(rows) = reference_rows("shadow") else { return };
    for row in rows {
        let (altitude, height, far_edge) =
            (number(&row, "altitude_m"), number(&row, "box_height_m"), number(&row, "ground_range_far_top_edge_m"));
        let edge = far_edge as f32;
        let block = cuboid(Vec3::new(edge - 0.5, -1.0, 0.0), Vec3::new(edge, 1.0, height as f32));
        let scene = Builder::new().background(floor(400.0, 0.0)).body(block).scene();
        let far = 45.0;
        // The aperture must hold both edges of the shadow.
        let sonar = Sonar { elevation_deg: 80.0, ..sonar(1, 1.0, [0.5, far], 2000) };
        let echoes = trace(&scene, &sonar, &looking([0.0, 0.0, altitude], 0.0, 0.0));
        let dark = |range: f64| echoes.energy[echoes.grid.bin_of(range).unwrap() as usize] == 0.0;
        let bin = echoes.grid.bin_m();
        let expected = &row["expected"];
        let start = (altitude - height).hypot(far_edge);
        if expected.is_null() {
            assert!(dark(start + 2.0 * bin) && dark(far - bin), "{}: the shadow has no end", row["id"]);
            continue;
        }
        let end = number(&row, "slant_shadow_end_m");
        assert!(dark(start + 2.0 * bin) && !dark(start - bin), "{}: the shadow begins behind the edge", row["id"]);
        assert!(dark(end - 1.5 * bin), "{}: still dark a bin before its end", row["id"]);
        assert!(!dark(end + 0.5 * bin), "{}: lit within a bin of its end", row["id"]);
    }
}

#[test]
fn lambert_bodies_return_the_energy_of_the_table() {
    let Some(rows) = reference_rows("ray_energy") else { return };
    for row in rows {
        let expected = row["expected"].as_f64().unwrap();
        let energy = if row["inputs"]["radius_m"].is_number() {
            let centre = Vec3::new(number(&row, "center_range_m") as f32, 0.0, 0.0);
            let scene = Builder::new().body(sphere(centre, number(&row, "radius_m") as f32, 240)).scene();
            let echoes = trace(&scene, &sonar(400, 20.0, [0.5, 20.0], 500), &Pose::IDENTITY);
            echoes.energy.iter().map(|&e| f64::from(e)).sum::<f64>()
        } else {
            let scene = Builder::new().background(floor(100.0, 0.0)).scene();
            let range_m = [number(&row, "r1_m"), number(&row, "r2_m")];
            let sonar = Sonar {
                elevation_deg: 60.0,
                elevations: 2001,
                ..sonar(1, number(&row, "azimuth_width_deg"), range_m, 1)
            };
            f64::from(trace(&scene, &sonar, &looking([0.0, 0.0, number(&row, "altitude_m")], 0.0, 0.0)).energy[0])
        };
        assert!((energy / expected - 1.0).abs() < 0.02, "{}: {energy} is not {expected}", row["id"]);
    }
}

/// A round plate facing the sonar, `distance` ahead.
fn disc(distance: f32, radius: f32) -> ensonify::catalog::Part {
    let rim = (0..360).map(|degree| {
        let angle = (degree as f32).to_radians();
        Vec3::new(distance, radius * angle.cos(), radius * angle.sin())
    });
    let positions = std::iter::once(Vec3::new(distance, 0.0, 0.0)).chain(rim).collect();
    support::part(positions, (0..360).map(|i| [0, 1 + i, 1 + (i + 1) % 360]).collect())
}

#[test]
fn a_disc_facing_the_sonar_returns_its_area_over_the_fourth_power_of_range() {
    let energy = |distance: f32| {
        let scene = Builder::new().body(disc(distance, 0.2)).scene();
        let sonar = Sonar { elevation_deg: 20.0, elevations: 2001, ..sonar(800, 20.0, [0.5, 20.0], 500) };
        trace(&scene, &sonar, &Pose::IDENTITY).energy.iter().map(|&e| f64::from(e)).sum::<f64>()
    };
    // μ·cos²θ·A / R⁴ with μ = 1; the plate is small, so cos θ is 1.
    for distance in [3.0, 6.0, 12.0] {
        let expected = std::f64::consts::PI * 0.04 / f64::from(distance).powi(4);
        assert!(
            (energy(distance) / expected - 1.0).abs() < 0.02,
            "{distance} m: {} is not {expected}",
            energy(distance)
        );
    }
    let weaker_db = 10.0 * (energy(3.0) / energy(6.0)).log10();
    assert!((weaker_db - 12.04).abs() < 0.1, "twice the range is {weaker_db} dB weaker");
}

#[test]
fn twice_the_elevations_hardly_change_the_image() {
    let scene = Builder::new()
        .background(floor(60.0, 0.0))
        .body(cuboid(Vec3::new(6.0, -0.5, 0.0), Vec3::new(6.8, 0.4, 0.7)))
        .body(sphere(Vec3::new(9.0, 2.0, 0.5), 0.5, 60))
        .scene();
    let image = |elevations| {
        let sonar = Sonar { elevations, elevation_deg: 20.0, ..sonar(128, 90.0, [0.5, 20.0], 512) };
        trace(&scene, &sonar, &looking([0.0, 0.0, 2.5], 0.0, -15.0)).energy
    };
    let (coarse, fine) = (image(667), image(1334));
    let total: f32 = fine.iter().sum();
    let change: f32 = coarse.iter().zip(&fine).map(|(a, b)| (a - b).abs()).sum();
    assert!(change / total < 0.01, "{}", change / total);
}

#[test]
fn a_flat_seabed_has_no_holes_at_grazing_incidence() {
    let scene = Builder::new().background(floor(100.0, 0.0)).scene();
    let sonar = Sonar { elevation_deg: 20.0, elevations: 100, ..sonar(32, 60.0, [0.5, 25.0], 2000) };
    let echoes = trace(&scene, &sonar, &looking([0.0, 0.0, 1.0], 0.0, -8.0));
    let lit = |range: f64| echoes.energy[echoes.grid.cell(16, echoes.grid.bin_of(range).unwrap())] > 0.0;
    let (first, last) = (1.0 / 18f64.to_radians().sin(), 24.9);
    let steps = (0..500).map(|i| first + 0.05 + (last - first - 0.05) * f64::from(i) / 499.0);
    assert!(steps.into_iter().all(lit));
    assert!(!lit(first - 0.05));
}

#[test]
fn cone_bearing_moves_energy_between_beams_but_loses_none() {
    let wall = cuboid(Vec3::new(4.0, 2.0, -1.0), Vec3::new(6.0, 5.0, 1.0));
    let scene = Builder::new().body(wall).scene();
    let ideal = sonar(256, 120.0, [0.5, 20.0], 256);
    let energy = |bearing| -> f64 {
        let echoes = trace(&scene, &Sonar { bearing, ..ideal.clone() }, &Pose::IDENTITY);
        let bodies: f64 = echoes.bodies.iter().map(|echo| f64::from(echo.energy)).sum();
        let all: f64 = echoes.energy.iter().map(|&e| f64::from(e)).sum();
        assert!((bodies / all - 1.0).abs() < 1e-5, "all that echoes is the wall");
        all
    };
    let ratio = energy(Bearing::Cone) / energy(Bearing::Azimuth);
    assert!((ratio - 1.0).abs() < 1e-4, "{ratio}");
}

#[test]
fn detail_gives_the_elevation_and_incidence_of_a_flat_seabed() {
    let scene = Builder::new().background(floor(100.0, 0.0)).scene();
    let sonar = sonar(8, 20.0, [0.5, 20.0], 400);
    let mut tracer = Tracer::new(&sonar);
    let echoes = tracer.trace(&scene, &looking([0.0, 0.0, 2.0], 0.0, 0.0), Keep { detail: true, ..Keep::ENERGY });
    let detail = echoes.detail.as_ref().unwrap();
    let range = 10.0;
    let cell = echoes.grid.cell(4, echoes.grid.bin_of(range).unwrap());
    let elevation = -(2.0f64 / range).asin();
    assert!((f64::from(detail.elevation_rad[cell]) - elevation).abs() < 0.003);
    assert!((f64::from(detail.incidence_rad[cell]) - (2.0f64 / range).acos()).abs() < 0.003);
    assert_eq!(detail.material[cell], 1);
}

#[test]
fn ghosts_appear_at_the_ranges_of_their_paths_and_in_no_label() {
    let Some(rows) = reference_rows("multipath") else { return };
    for row in rows {
        let given = |key: &str| row["inputs"][key].as_f64();
        // Heights above the mirror, or depths below it.
        let (sonar_m, target_m) = match given("sonar_depth_m") {
            Some(depth) => (-depth, -number(&row, "target_depth_m")),
            None => (number(&row, "altitude_m"), number(&row, "target_height_m")),
        };
        let across = number(&row, "ground_range_m");
        let paths = [number(&row, "mixed_apparent_m"), number(&row, "double_apparent_m")];
        let ball = sphere(Vec3::new(across as f32, 0.0, target_m as f32), 0.02, 40);
        let mut scene = Builder::new().body(ball).scene();
        let far = 1.5 * paths[1];
        let sonar = Sonar { elevation_deg: 110.0, elevations: 8000, ..sonar(9, 9.0, [0.5, far], 4000) };
        let pose = looking([0.0, 0.0, sonar_m], 0.0, 0.0);
        let plain = trace(&scene, &sonar, &pose);
        assert!(plain.ghosts.is_none());
        scene.mirrors = vec![ensonify::scene::Mirror { height_m: 0.0, reflection: 1.0, rough_m: 0.0 }];
        let echoes = trace(&scene, &sonar, &pose);
        assert_eq!(echoes.bodies, plain.bodies, "labels are those without ghosts");
        let ghosts = echoes.ghosts.as_ref().expect("a mirror makes ghosts");
        let lit: Vec<f64> = (0..echoes.grid.bins)
            .filter(|&bin| (0..9).any(|beam| ghosts[echoes.grid.cell(beam, bin)] > 0.0))
            .map(|bin| echoes.grid.range_m(bin))
            .collect();
        for range in paths {
            let nearest = lit.iter().map(|lit| (lit - range).abs()).fold(f64::MAX, f64::min);
            assert!(nearest < 0.025, "{}: no ghost at {range} m, the nearest is {nearest} m off", row["id"]);
        }
        let known = |range: f64| paths.iter().any(|path| (path - range).abs() < 0.06);
        assert!(lit.iter().all(|&range| known(range)), "{}: {lit:?}", row["id"]);
    }
}

#[test]
fn a_turning_array_hears_far_echoes_to_the_side() {
    let turned = |range: f32, rate: f64| {
        let scene = Builder::new().body(sphere(Vec3::new(range, 0.0, 0.0), 0.02, 40)).scene();
        let sonar = Sonar { yaw_rate_deg_s: rate, elevations: 4001, ..sonar(401, 40.1, [0.5, 20.0], 400) };
        let echoes = trace(&scene, &sonar, &Pose::IDENTITY);
        let (sum, weighted) = echoes.bodies.iter().fold((0.0, 0.0), |(sum, weighted), echo| {
            let bearing = echoes.grid.bearing_rad(echo.cell / echoes.grid.bins).to_degrees();
            (sum + f64::from(echo.energy), weighted + f64::from(echo.energy) * bearing)
        });
        weighted / sum
    };
    assert!(turned(10.0, 0.0).abs() < 0.01);
    // 2 · 10 m / (1500 m/s) · 30°/s to port: the target is heard 0.4° to starboard.
    assert!((turned(10.0, 30.0) + 0.4).abs() < 0.02, "{}", turned(10.0, 30.0));
    assert!((turned(5.0, -30.0) - 0.2).abs() < 0.02, "{}", turned(5.0, -30.0));
}
