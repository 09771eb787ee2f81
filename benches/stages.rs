//! What each stage of a frame costs: 512 beams × 1024 bins, polar and fan view.

use std::hint::black_box;
use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};
use ensonify::image::{Channel, Display, ImageModel, Model, form};
use ensonify::label::{LabelSettings, label_fan, label_polar};
use ensonify::math::rng::Stream;
use ensonify::physics::Water;
use ensonify::sonar::{Bearing, FanMap, Keep, Tracer};
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
    let display = Display { white_db: 5.0, dynamic_range_db: 65.0 };
    let model = ImageModel { model: Model::Physical, tvg_db_per_decade: 30.0, display };
    let channel = Channel::new(&sonar, &water);
    let grey = form(&echoes, &model, &channel, &mut Stream::at(1, "bench", 0, "image"));
    group.bench_function("image", |bench| {
        bench.iter(|| black_box(form(&echoes, &model, &channel, &mut Stream::at(1, "bench", 0, "image"))));
    });

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

criterion_group!(benches, stages);
criterion_main!(benches);
