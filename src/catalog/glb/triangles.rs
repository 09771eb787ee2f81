//! Corners to triangles, by the mode of a primitive.
//!
//! Source: Khronos Group (2021), glTF 2.0 specification, section 3.7.2.1 (primitive topology types).

use glam::Vec3;

/// Modes that make surfaces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Mode {
    Triangles,
    Strip,
    Fan,
}

impl Mode {
    /// How many triangles so many corners make.
    pub fn count(self, corners: u64) -> u64 {
        match self {
            Self::Triangles => corners / 3,
            Self::Strip | Self::Fan => corners.saturating_sub(2),
        }
    }

    /// The triangles, all wound alike.
    pub fn triangles(self, corners: impl ExactSizeIterator<Item = u32>) -> Vec<[u32; 3]> {
        let mut out = Vec::with_capacity(self.count(corners.len() as u64) as usize);
        let mut held = [0; 2];
        for (k, corner) in corners.enumerate() {
            let [first, second] = held;
            match (self, k) {
                (Self::Triangles, _) if k % 3 == 2 => out.push([first, second, corner]),
                (Self::Triangles, _) => held[k % 3] = corner,
                (_, 0) => held[0] = corner,
                (_, 1) => held[1] = corner,
                (Self::Fan, _) => {
                    out.push([first, second, corner]);
                    held = [first, corner];
                }
                (Self::Strip, _) => {
                    out.push(if k % 2 == 0 { [first, second, corner] } else { [second, first, corner] });
                    held = [second, corner];
                }
            }
        }
        out
    }
}

/// Whether a triangle is wider than 1e-9 of its longest side: a sliver below that is a line.
pub(super) fn has_area(corners: [Vec3; 3]) -> bool {
    let [a, b, c] = corners.map(|corner| corner.as_dvec3());
    let longest = (b - a).length_squared().max((c - b).length_squared()).max((a - c).length_squared());
    (b - a).cross(c - a).length() > 1e-9 * longest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_become_triangles() {
        let of = |mode: Mode, n: u32| {
            let triangles = mode.triangles(0..n);
            assert_eq!(triangles.len() as u64, mode.count(n.into()), "{mode:?} of {n}");
            triangles
        };
        assert_eq!(of(Mode::Triangles, 8), [[0, 1, 2], [3, 4, 5]]);
        assert_eq!(of(Mode::Strip, 5), [[0, 1, 2], [2, 1, 3], [2, 3, 4]]);
        assert_eq!(of(Mode::Fan, 5), [[0, 1, 2], [0, 2, 3], [0, 3, 4]]);
        for mode in [Mode::Triangles, Mode::Strip, Mode::Fan] {
            (0..3).for_each(|n| assert!(of(mode, n).is_empty()));
        }
    }

    #[test]
    fn slivers_have_no_area() {
        let [a, b] = [Vec3::ZERO, Vec3::X];
        assert!(has_area([a, b, Vec3::Y * 1e-6]) && has_area([a, b * 1e-6, Vec3::Y * 1e-6]));
        assert!(!has_area([a, b, b * 2.0]) && !has_area([a, b, b]) && !has_area([a, a, a]));
    }
}
