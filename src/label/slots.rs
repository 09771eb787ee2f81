//! Cells → slots: a small table of the distinct sets of visible bodies, and for each cell its row in the table.
//!
//! Most cells see nothing and neighbours see the same, so a view needs to look at one number a pixel.

use std::collections::BTreeMap;

use super::LabelSettings;
use crate::sonar::{BodyEcho, Echoes};

/// What is seen in each cell; see the [module](crate::label) for the rules.
pub(super) struct Slots {
    /// For each cell, an index into `sets`; 0 where no body is visible.
    pub of_cell: Vec<u32>,
    /// Distinct sets; the first is empty.
    pub sets: Vec<Seen>,
    /// Bodies visible somewhere, in order.
    pub bodies: Vec<u16>,
}

/// The bodies that cells of one slot see.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Seen {
    /// Body number of the dominant body, or 0.
    pub dominant: u16,
    /// Indices into [`Slots::bodies`] of the visible bodies, in order.
    pub visible: Vec<usize>,
}

impl Slots {
    pub fn new(echoes: &Echoes, settings: &LabelSettings) -> Self {
        let mut of_cell = vec![0; echoes.grid.len()];
        // Keys: the dominant body, then the visible ones. A set's slot is its place by first appearance, from 1.
        let mut keys: Vec<Vec<u16>> = vec![vec![0]];
        let mut slots: BTreeMap<Vec<u16>, u32> = BTreeMap::new();
        let (mut key, mut slot) = (vec![0], 0);
        for group in echoes.bodies.chunk_by(|a, b| a.cell == b.cell) {
            let cell = group[0].cell as usize;
            see(group, echoes.energy[cell], settings, &mut key);
            if key.len() > 1 {
                if keys[slot as usize] != key {
                    slot = slots.get(&key).copied().unwrap_or_else(|| {
                        keys.push(key.clone());
                        let next = (keys.len() - 1) as u32;
                        slots.insert(key.clone(), next);
                        next
                    });
                }
                of_cell[cell] = slot;
            }
        }
        Self::with_dense_bodies(of_cell, &keys)
    }

    fn with_dense_bodies(of_cell: Vec<u32>, keys: &[Vec<u16>]) -> Self {
        let mut bodies: Vec<u16> = keys.iter().flat_map(|key| &key[1..]).copied().collect();
        bodies.sort_unstable();
        bodies.dedup();
        let place = |body| bodies.partition_point(|&b| b < body);
        let sets = keys
            .iter()
            .map(|key| Seen { dominant: key[0], visible: key[1..].iter().map(|&body| place(body)).collect() })
            .collect();
        Self { of_cell, sets, bodies }
    }
}

/// Fills `key` with the dominant body of one cell (or 0) and its visible bodies.
fn see(group: &[BodyEcho], total: f32, settings: &LabelSettings, key: &mut Vec<u16>) {
    let total = f64::from(total);
    key.clear();
    key.push(0);
    let (mut strongest, mut strongest_energy, mut all_bodies) = (0, 0.0, 0.0);
    for echo in group {
        let energy = f64::from(echo.energy);
        all_bodies += energy;
        if energy >= settings.min_share * total {
            key.push(echo.body);
            if energy > strongest_energy {
                (strongest, strongest_energy) = (echo.body, energy);
            }
        }
    }
    if strongest_energy >= total - all_bodies {
        key[0] = strongest;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn seen(total: f32, energies: &[(u16, f32)], min_share: f64) -> Vec<u16> {
        let group: Vec<_> = energies.iter().map(|&(body, energy)| BodyEcho { cell: 0, body, energy }).collect();
        let mut key = Vec::new();
        see(&group, total, &LabelSettings { min_pixels: 1, min_share }, &mut key);
        key
    }

    #[test]
    fn a_cell_names_its_visible_and_its_dominant_bodies() {
        assert_eq!(seen(1.0, &[(3, 0.5), (7, 0.4)], 0.2), [3, 3, 7]);
        assert_eq!(seen(1.0, &[(3, 0.1), (7, 0.9)], 0.2), [7, 7], "a share below the limit is not seen");
        assert_eq!(seen(1.0, &[(3, 0.3), (7, 0.2)], 0.2), [0, 3, 7], "half of the energy is background");
        assert_eq!(seen(1.0, &[(3, 0.4), (7, 0.4)], 0.2), [3, 3, 7], "a tie goes to the lower number");
        assert_eq!(seen(1.0, &[(3, 0.19)], 0.2), [0]);
        assert_eq!(seen(1.0, &[(1, 0.3), (2, 0.3), (3, 0.3)], 0.35), [0], "dominant bodies are visible ones");
    }
}
