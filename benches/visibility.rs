//! What a ping sees: scan conversion per beam plane against one ray a sample through a bounding volume hierarchy.

use std::hint::black_box;
use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};
use ensonify::scene::Scene;
use ensonify::sonar::{Bearing, Keep, Tracer};
use glam::{DVec3, Vec3A};
use obvhs::BvhBuildParams;
use obvhs::cwbvh::builder::build_cwbvh_from_tris;
use obvhs::ray::{Ray, RayHit};
use obvhs::triangle::Triangle;

#[path = "reference/mod.rs"]
mod reference;

fn visibility(criterion: &mut Criterion) {
    let (scene, pose) = reference::scene();
    let mut tracer = Tracer::new(&reference::sonar(Bearing::Azimuth));
    let planes = tracer.visibility.planes.clone();
    let mut group = criterion.benchmark_group("ping of 512 x 667 samples");
    group.sample_size(20).measurement_time(Duration::from_secs(5));

    group.bench_function("scan conversion", |bench| bench.iter(|| tracer.visibility.scan(black_box(&scene), &pose)));
    group.bench_function("scan conversion and energy", |bench| {
        bench.iter(|| black_box(tracer.trace(black_box(&scene), &pose, Keep::ENERGY)));
    });

    // The rays of the very same samples, in the order that keeps neighbours together.
    let rays: Vec<Ray> = (0..planes.count())
        .flat_map(|plane| (0..planes.samples()).map(move |sample| (plane, sample)))
        .map(|(plane, sample)| {
            let [x, y, z] = planes.direction(plane, sample);
            let direction = (pose.rotation * DVec3::new(x.into(), y.into(), z.into())).normalize();
            Ray::new(vec3a(pose.position), vec3a(direction), 0.0, 30.0)
        })
        .collect();
    let triangles = triangles(&scene);
    for (name, build) in [("medium", BvhBuildParams::medium_build()), ("very slow", BvhBuildParams::very_slow_build())]
    {
        let tree = build_cwbvh_from_tris(&triangles, build, &mut Duration::default());
        group.bench_function(format!("obvhs closest hits, {name} build"), |bench| {
            bench.iter(|| {
                let meets = |ray: &Ray, place: usize| triangles[tree.primitive_indices[place] as usize].intersect(ray);
                let hits = rays.iter().filter(|ray| {
                    let mut nearest = RayHit::none();
                    tree.ray_traverse(**ray, &mut nearest, meets)
                });
                black_box(hits.count())
            });
        });
    }
    group.finish();
}

fn triangles(scene: &Scene) -> Vec<Triangle> {
    let mut all = Vec::new();
    for instance in &scene.instances {
        let place = |p: glam::Vec3| vec3a(instance.world_from_mesh.transform_point3(p.as_dvec3()));
        all.extend(instance.mesh.triangles().map(|corners| {
            let [v0, v1, v2] = corners.map(place);
            Triangle { v0, v1, v2 }
        }));
    }
    all
}

fn vec3a(v: DVec3) -> Vec3A {
    Vec3A::new(v.x as f32, v.y as f32, v.z as f32)
}

criterion_group!(benches, visibility);
criterion_main!(benches);
