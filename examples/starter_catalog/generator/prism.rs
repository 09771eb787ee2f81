//! Plates: an outline with holes, given a thickness.
//!
//! The flat faces are triangulated by clipping ears off one loop, into which the holes are cut by slits.

use glam::DVec3;

use super::curve::Point;
use super::solid::Solid;

/// The plate between two heights over a counter-clockwise outline less the holes in it (any direction).
#[must_use]
pub fn prism(outline: &[Point], holes: &[Vec<Point>], heights: [f64; 2]) -> Solid {
    let mut corners = outline.to_vec();
    let mut walls: Vec<Vec<usize>> = vec![(0..outline.len()).collect()];
    for hole in holes {
        // Holes run clockwise, so that the solid lies on the left of every wall.
        let mut wall: Vec<usize> = (corners.len()..corners.len() + hole.len()).collect();
        if area(hole) > 0.0 {
            wall.reverse();
        }
        corners.extend(hole);
        walls.push(wall);
    }
    let n = corners.len();
    let positions = heights.iter().flat_map(|&z| corners.iter().map(move |p| DVec3::new(p[0], p[1], z))).collect();
    let mut triangles = Vec::new();
    for wall in &walls {
        for (a, b) in wall.iter().zip(wall.iter().cycle().skip(1)).map(|(&a, &b)| (a as u32, b as u32)) {
            let top = n as u32;
            triangles.extend([[a, b, b + top], [a, b + top, a + top]]);
        }
    }
    for [a, b, c] in ears(&corners, one_loop(&corners, walls)) {
        triangles.push([a + n, b + n, c + n].map(|v| v as u32));
        triangles.push([a, c, b].map(|v| v as u32));
    }
    Solid::outward(positions, triangles)
}

/// Area inside an outline, square metres: positive if it runs counter-clockwise.
#[must_use]
pub fn area(outline: &[Point]) -> f64 {
    let next = outline.iter().cycle().skip(1);
    outline.iter().zip(next).map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum::<f64>() / 2.0
}

/// Twice the area of the triangle a, b, c; positive if counter-clockwise.
fn side(a: Point, b: Point, c: Point) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// The outline with every hole spliced in along the shortest slit that crosses no wall.
fn one_loop(corners: &[Point], mut walls: Vec<Vec<usize>>) -> Vec<usize> {
    let mut ring = walls.remove(0);
    while !walls.is_empty() {
        let mut best: Option<(f64, usize, usize, usize)> = None;
        for (w, wall) in walls.iter().enumerate() {
            for (i, &from) in ring.iter().enumerate() {
                for (j, &to) in wall.iter().enumerate() {
                    let (p, q) = (corners[from], corners[to]);
                    let length = (p[0] - q[0]) * (p[0] - q[0]) + (p[1] - q[1]) * (p[1] - q[1]);
                    let open = || !std::iter::once(&ring).chain(&walls).any(|wall| crosses(corners, wall, [from, to]));
                    if best.is_none_or(|(shortest, ..)| length < shortest) && open() {
                        best = Some((length, w, i, j));
                    }
                }
            }
        }
        let (_, w, i, j) = best.expect("a hole inside the outline sees some corner of it");
        let wall = walls.remove(w);
        let detour = wall.iter().cycle().skip(j).take(wall.len() + 1).copied().chain([ring[i]]).collect::<Vec<_>>();
        ring.splice(i + 1..i + 1, detour);
    }
    ring
}

/// Whether the slit meets a wall's edge elsewhere than at their common corner.
fn crosses(corners: &[Point], wall: &[usize], [from, to]: [usize; 2]) -> bool {
    let (p, q) = (corners[from], corners[to]);
    wall.iter().zip(wall.iter().cycle().skip(1)).any(|(&a, &b)| {
        let apart = ![from, to].contains(&a) && ![from, to].contains(&b);
        let (a, b) = (corners[a], corners[b]);
        apart && side(p, q, a) * side(p, q, b) <= 0.0 && side(a, b, p) * side(a, b, q) <= 0.0
    })
}

/// Triangles of a counter-clockwise loop that may touch itself along slits.
fn ears(corners: &[Point], mut ring: Vec<usize>) -> Vec<[usize; 3]> {
    let mut triangles = Vec::with_capacity(ring.len());
    while ring.len() > 3 {
        let n = ring.len();
        let ear = (0..n).map(|i| (i, [ring[(i + n - 1) % n], ring[i], ring[(i + 1) % n]])).filter(|(_, ear)| {
            let [a, b, c] = ear.map(|v| corners[v]);
            let blocks = |p: Point| side(a, b, p) >= 0.0 && side(b, c, p) >= 0.0 && side(c, a, p) >= 0.0;
            side(a, b, c) > 1e-12 && !ring.iter().any(|v| !ear.contains(v) && blocks(corners[*v]))
        });
        // The best-shaped ear first: long slivers would look like creases.
        let (i, best) = ear
            .max_by(|(_, a), (_, b)| roundness(corners, *a).total_cmp(&roundness(corners, *b)))
            .expect("a simple polygon has an ear");
        triangles.push(best);
        ring.remove(i);
    }
    triangles.push([ring[0], ring[1], ring[2]]);
    triangles
}

/// Area over the longest side squared: the larger, the nearer to equilateral.
fn roundness(corners: &[Point], triangle: [usize; 3]) -> f64 {
    let [a, b, c] = triangle.map(|v| corners[v]);
    let square = |p: Point, q: Point| (p[0] - q[0]) * (p[0] - q[0]) + (p[1] - q[1]) * (p[1] - q[1]);
    side(a, b, c) / square(a, b).max(square(b, c)).max(square(c, a))
}
