//! What each stage of a frame costs: 512 beams × 1024 bins, polar and fan view.

use std::hint::black_box;
use std::time::Duration;

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, criterion_group, criterion_main};
use ensonify::image::display::Scale;
use ensonify::image::physical::{Array, Chain, Focus, Pulse, Receiver, Ringing, Setup};
use ensonify::image::{Channel, Display, ImageModel, Model, Noise, Physical, form};
use ensonify::label::{LabelSettings, label_fan, label_polar};
use ensonify::math::fast::fill_complex_normals;
use ensonify::math::rng::Stream;
use ensonify::physics::response::PulseWindow;
use ensonify::physics::shading::Shading;
use ensonify::physics::{Load, TurbidWater, Water};
use ensonify::sonar::{Bearing, Echoes, FanMap, Keep, Tracer};
use ensonify::store::png;

#[path = "reference/mod.rs"]
mod reference;

fn stages(criterion: &mut Criterion) {
    let (scene, pose) = reference::scene();
    let sonar = reference::sonar(Bearing::Cone);
    let mut tracer = Tracer::new(&sonar);
    let mut group = criterion.benchmark_group("frame");
    group.sample_size(20).measurement_time(Duration::from_secs(4));

    group.bench_function("trace", |bench| bench.iter(|| black_box(tracer.trace(&scene, &pose, Keep::ENERGY))));
    let echoes = tracer.trace(&scene, &pose, Keep::ENERGY);

    let water = Water { temperature_c: 10.0, salinity_ppt: 35.0, ph: 8.0, depth_m: 10.0 };
    let water = TurbidWater { water, turbidity: Load::Coastal };
    let model = ImageModel {
        model: Model::Physical(PHYSICAL),
        tvg_db_per_decade: 30.0,
        display: Display { white_db: 20.0, dynamic_range_db: 80.0, gamma: 1.0 },
    };
    let channel = Channel::new(&sonar, &water);
    let stream = || Stream::at(1, "bench", 0, "image");
    let grey = form(&echoes, &model, &channel, &mut stream());
    group.bench_function("image", |bench| {
        bench.iter(|| black_box(form(&echoes, &model, &channel, &mut stream())));
    });
    image_steps(&mut group, &echoes, &model, &channel);

    let settings = LabelSettings { min_pixels: 20, min_share: 0.25 };
    let fan = FanMap::new(&echoes.grid, 768);
    group.bench_function("labels, polar", |bench| bench.iter(|| black_box(label_polar(&echoes, &settings))));
    group.bench_function("labels, fan", |bench| bench.iter(|| black_box(label_fan(&echoes, &fan, &settings))));
    group.bench_function("picture, fan", |bench| bench.iter(|| black_box(fan.picture(&grey))));
    let (polar, picture) = (echoes.grid.to_polar_image(&grey), fan.picture(&grey));
    group.bench_function("png, polar", |bench| bench.iter(|| black_box(png::grey8(512, 1024, &polar))));
    group.bench_function("png, fan", |bench| bench.iter(|| black_box(png::grey8(fan.width, fan.height, &picture))));
    let mask = label_fan(&echoes, &fan, &settings).mask;
    group.bench_function("mask png, fan", |bench| {
        bench.iter(|| black_box(png::grey16(fan.width, fan.height, &mask)));
    });
    group.finish();
}

/// The device of the defaults, one look a bin.
const PHYSICAL: Physical = Physical {
    array: Array {
        shading: Shading::Taylor { side_lobe_db: 25.0, near: 4 },
        gain_error_db: 1.0,
        phase_error_deg: 5.0,
        ripple_db: 0.75,
        focus: Focus::Dynamic,
        transmit_width_deg: None,
        unit: 1,
    },
    pulse: Pulse::Chirp { duration_ms: 0.1, window: PulseWindow::Hamming },
    receiver: Receiver {
        most_looks: 1,
        noise_figure_db: 5.0,
        blanking_m: 0.1,
        ringing: Ringing { level_db: 170.0, decay_db_per_m: 100.0 },
        max_gain_db: 80.0,
        gain_step_db: 0.0,
        full_scale_db: 72.0,
    },
};

fn setup(physical: &Physical) -> Setup<'_> {
    Setup { physical, tvg_db_per_decade: 30.0, noise: Noise::Heard }
}

/// The steps of an image: tables, draws, field and response, display; then what a fixed focus and long pulses cost.
fn image_steps(group: &mut BenchmarkGroup<'_, WallTime>, echoes: &Echoes, model: &ImageModel, channel: &Channel) {
    let stream = || Stream::at(1, "bench", 0, "image");
    let chain = |physical: &Physical| Chain::new(&echoes.grid, &setup(physical), channel);
    group.bench_function("image: tables", |bench| bench.iter(|| black_box(chain(&PHYSICAL))));
    let mut normals = (vec![0.0; echoes.grid.len()], vec![0.0; echoes.grid.len()]);
    group.bench_function("image: normals alone", |bench| {
        bench.iter(|| fill_complex_normals(&mut stream(), &mut normals.0, &mut normals.1));
    });
    let usual = chain(&PHYSICAL);
    let powers = usual.powers(echoes, &mut stream());
    group.bench_function("image: field and response", |bench| {
        bench.iter(|| black_box(usual.powers(echoes, &mut stream())));
    });
    let scale = Scale { gain_db: usual.gain_db(), footprint_m2: usual.footprint_m2() };
    group.bench_function("image: display", |bench| bench.iter(|| black_box(model.display.grey(&powers, &scale))));
    let focused = Array { focus: Focus::Fixed { range_m: 5.0 }, ..PHYSICAL.array };
    let focused = chain(&Physical { array: focused, ..PHYSICAL });
    group.bench_function("image: response, fixed focus", |bench| {
        bench.iter(|| black_box(focused.powers(echoes, &mut stream())));
    });
    let long = Channel { pulse_m: 8.0 * channel.pulse_m, bandwidth_hz: channel.bandwidth_hz / 8.0, ..*channel };
    let long = Chain::new(&echoes.grid, &setup(&PHYSICAL), &long);
    group.bench_function("image: response, pulse of two bins", |bench| {
        bench.iter(|| black_box(long.powers(echoes, &mut stream())));
    });
}

criterion_group!(benches, stages);
criterion_main!(benches);
