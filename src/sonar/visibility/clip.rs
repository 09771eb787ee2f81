//! Clipping of triangles that reach behind the sonar.

/// Triangles are cut off this far ahead of the sonar, metres: nearer than any sonar listens, far enough for `1/ρ` to be finite.
pub const NEAR_M: f32 = 1e-3;

/// Calls `draw` with the part of a triangle that lies ahead (`x ≥ NEAR_M`): nothing, one triangle or two.
///
/// The cut of an edge is computed from its vertex ahead to its vertex behind, so neighbours share its bits.
pub fn in_front(corners: [[f32; 3]; 3], mut draw: impl FnMut([[f32; 3]; 3])) {
    let mut kept = [[0.0; 3]; 4];
    let mut count = 0;
    for (i, &here) in corners.iter().enumerate() {
        let next = corners[(i + 1) % 3];
        let (here_ahead, next_ahead) = (here[0] >= NEAR_M, next[0] >= NEAR_M);
        if here_ahead {
            kept[count] = here;
            count += 1;
        }
        if here_ahead != next_ahead {
            kept[count] = if here_ahead { edge_cut(here, next) } else { edge_cut(next, here) };
            count += 1;
        }
    }
    if count >= 3 {
        draw([kept[0], kept[1], kept[2]]);
    }
    if count == 4 {
        draw([kept[0], kept[2], kept[3]]);
    }
}

fn edge_cut(ahead: [f32; 3], behind: [f32; 3]) -> [f32; 3] {
    let share = (ahead[0] - NEAR_M) / (ahead[0] - behind[0]);
    [NEAR_M, ahead[1] + share * (behind[1] - ahead[1]), ahead[2] + share * (behind[2] - ahead[2])]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pieces(corners: [[f32; 3]; 3]) -> Vec<[[f32; 3]; 3]> {
        let mut out = Vec::new();
        in_front(corners, |t| out.push(t));
        out
    }

    #[test]
    fn one_corner_behind_gives_two_triangles_two_give_one_three_none() {
        let (ahead, behind) = ([1.0, 0.0, 0.0], [-1.0, 1.0, 0.0]);
        assert_eq!(pieces([ahead, [1.0, 1.0, 0.0], behind]).len(), 2);
        assert_eq!(pieces([ahead, behind, [-2.0, -1.0, 1.0]]).len(), 1);
        assert!(pieces([behind, [-2.0, 0.0, 0.0], [-3.0, 0.0, 1.0]]).is_empty());
        assert!(pieces([ahead, [1.0, 1.0, 0.0], behind]).iter().flatten().all(|p| p[0] >= NEAR_M));
    }
}
