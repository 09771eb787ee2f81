//! How each thing stands: what was said of it, put into one of the recipe's kinds of pose.

use super::asked::{Asked, assumed};
use crate::catalog::concepts::concepts;
use crate::draft::infer::room;
use crate::draft::wish::{Amount, Count, Said, Side, Source, Stand, Thing};

/// Most models of a thing that are opened for their sizes.
const MOST_OPENED: usize = 12;
/// A model is of the size that was asked for within this ratio.
const SAME_SIZE: f64 = 1.15;
/// Of a model that cannot be opened, metres of height for each of its longest side.
const HEIGHT: f64 = 0.6;
/// A model that has its own chain to the ground.
const HAS_A_CHAIN: &str = "moored-mine";

/// Sides of the models of a thing, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Bulk {
    /// Longest side of the smallest and of the largest.
    pub longest_m: [f64; 2],
    /// Of the largest, as it stands in its file.
    pub height_m: f64,
    /// The larger side in plan.
    pub wide_m: f64,
}

/// A thing, ready to be written.
pub(super) struct Placing<'a> {
    pub thing: &'a Thing,
    /// Those of its models that may be picked.
    pub uids: Vec<String>,
    pub bulk: Bulk,
    pub count: Count,
    pub count_why: String,
    pub manner: Manner<'a>,
}

/// What was said of how a thing stands; of what contradicts each other, the last.
#[derive(Default)]
pub(super) struct Manner<'a> {
    pub kind: Kind<'a>,
    pub tip_deg: Option<f64>,
    pub burial: Option<&'a Amount>,
    pub clear_m: Option<&'a Amount>,
    pub place: Place<'a>,
    /// What all of them together are near.
    pub beside: Option<Kind<'a>>,
    /// The words for all of it.
    pub words: Vec<&'a Source>,
}

/// A kind of pose.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) enum Kind<'a> {
    #[default]
    Rest,
    Settle,
    /// In the water: over the bottom or under the surface, where that is said; on a line or not.
    Float {
        over_m: Option<&'a Amount>,
        under_m: Option<&'a Amount>,
        moored: bool,
        school: bool,
    },
    Heap,
    Row(Option<&'a Amount>),
    Leaning(Option<&'a str>),
    On(&'a str),
    Near {
        of: &'a str,
        side: Option<Side>,
        distance_m: Option<&'a Amount>,
    },
}

impl Kind<'_> {
    /// Whether each stands for itself.
    fn is_single(&self) -> bool {
        !matches!(self, Self::Heap | Self::Row(_) | Self::Float { school: true, .. })
    }

    /// How many there are where nobody says how many.
    fn several(&self) -> [u32; 2] {
        match self {
            Self::Heap => room::IN_HEAP,
            Self::Row(_) => room::IN_ROW,
            Self::Float { school: true, .. } => room::IN_SCHOOL,
            _ => room::SEVERAL,
        }
    }
}

/// Whether a thing is called by the singular of a name of its own, in any language.
fn is_one(thing: &Thing) -> bool {
    if concepts().number(&thing.label).is_some_and(|label| concepts().is_singular_of(&thing.called.value, label)) {
        return thing.label != "fish";
    }
    let last = |text: &str| text.rsplit([' ', '-']).next().unwrap_or_default().to_lowercase();
    let name = last(&thing.label);
    !name.is_empty() && !name.ends_with('s') && name != "fish" && last(&thing.called.value) == name
}

/// Where a thing is, if that is said.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) enum Place<'a> {
    #[default]
    Anywhere,
    FromVehicle(Side, Option<&'a Amount>),
    At([f64; 2], Option<f64>),
    Within([f64; 2], [f64; 2]),
    Around(&'a Amount),
}

impl<'a> Placing<'a> {
    pub fn of(thing: &'a Thing, asked: &Asked, notes: &mut Vec<String>) -> Self {
        let mut manner = Manner::of(&thing.stands);
        let mut sizes = sizes(thing, asked);
        if let Kind::Float { over_m, under_m, .. } = manner.kind {
            // What hangs at a given height hangs on a line as long as that; at any height, on the model's own chain.
            let on_a_chain = over_m.or(under_m).is_none();
            if sizes.iter().any(|(uid, _)| (uid == HAS_A_CHAIN) == on_a_chain)
                && sizes.iter().any(|(uid, _)| uid == HAS_A_CHAIN)
            {
                sizes.retain(|(uid, _)| (uid == HAS_A_CHAIN) == on_a_chain);
            }
        }
        let (uids, bulk) = of_size(thing, sizes, notes);
        if let Kind::Float { over_m, under_m, .. } = manner.kind
            && uids.iter().all(|uid| uid == HAS_A_CHAIN)
        {
            manner.kind = Kind::Rest;
            if over_m.or(under_m).is_some() {
                notes.push(format!("{}: it hangs on a chain of its own, as long as the model's", thing.label));
            }
        }
        let (count, count_why) = match &thing.count {
            Some(Said { value, source }) => (*value, asked.why(source)),
            None if is_one(thing) && manner.kind.is_single() => (Count::Exactly(1), assumed("one, as it is called")),
            None => {
                let [few, many] = manner.kind.several();
                (Count::Between(few, many), assumed("a few"))
            }
        };
        Self { thing, uids, bulk, count, count_why, manner }
    }

    /// Heights between which its middles are, metres over the bottom; the water's depth for what is said from above.
    pub fn heights_m(&self, depth_m: f64, mid_water_m: [f64; 2]) -> [f64; 2] {
        let height = self.height_m();
        match &self.manner.kind {
            Kind::Float { over_m, under_m, .. } => {
                let [low, high] = match (over_m, under_m) {
                    (Some(over), _) => over.ends(),
                    (None, Some(under)) => {
                        let [less, more] = under.ends();
                        [depth_m - more, depth_m - less].map(|over| (over - height).max(0.0))
                    }
                    (None, None) => mid_water_m,
                };
                [low + 0.5 * height, high + 0.5 * height]
            }
            _ => match self.manner.place {
                Place::At(_, Some(z)) => [at_height(z, depth_m) + 0.5 * height; 2],
                _ => [0.25 * height, 0.75 * height],
            },
        }
    }

    /// How high it stands, metres.
    pub fn height_m(&self) -> f64 {
        let sunk = self.manner.burial.map_or(0.0, |burial| burial.ends()[0]);
        let tipped = self.manner.tip_deg.is_some_and(|tip| tip >= 45.0);
        let height = if tipped { self.bulk.wide_m } else { self.bulk.height_m };
        let height = match self.manner.kind {
            Kind::Settle | Kind::Heap => height.min(self.bulk.wide_m),
            Kind::Leaning(_) => self.bulk.longest_m[1],
            _ => height,
        };
        height * (1.0 - sunk)
    }

    /// Whether it is somewhere on the disc about the middle of the objects.
    pub fn is_scattered(&self) -> bool {
        let of_another = matches!(self.manner.kind, Kind::On(_) | Kind::Near { .. } | Kind::Leaning(_));
        !of_another && matches!(self.manner.place, Place::Anywhere | Place::Around(_))
    }

    /// Radius of the ground that one of it takes from the middle of its place, metres.
    pub fn reach_m(&self) -> f64 {
        let size = self.bulk.longest_m[1];
        match self.manner.kind {
            Kind::Heap => room::heap_m(size, self.count.most()) + 0.5 * size,
            Kind::Row(spacing) => room::half_row_m(self.spacing_m(spacing), self.count.most()) + 0.5 * size,
            _ => 0.5 * size,
        }
    }

    /// From thing to thing in a row, metres.
    pub fn spacing_m(&self, said: Option<&Amount>) -> f64 {
        said.map_or_else(
            || super::super::infer::sight::round(room::spacing_m(self.bulk.longest_m[1])),
            |said| said.ends()[1],
        )
    }
}

/// What a heap or a row lies beside is put beside the heap: of the two that one can be.
pub(super) fn beside_heaps<'a>(placings: &mut [Placing<'a>]) {
    for heap in 0..placings.len() {
        let Some(Kind::Near { of, side, distance_m }) = placings[heap].manner.beside.take() else { continue };
        let label = &placings[heap].thing.label;
        let free = |other: &&mut Placing<'a>| {
            other.thing.label == of && other.manner.kind == Kind::Rest && other.manner.place == Place::Anywhere
        };
        let near = Kind::Near { of: label, side: side.map(Side::opposite), distance_m };
        if let Some(other) = placings.iter_mut().find(free) {
            other.manner.kind = near;
        }
    }
}

/// Height over the bottom of a place: below 0 it is told from the surface.
pub(super) fn at_height(z: f64, depth_m: f64) -> f64 {
    if z < 0.0 { (depth_m + z).max(0.0) } else { z }
}

impl<'a> Manner<'a> {
    fn of(stands: &'a [Said<Stand>]) -> Self {
        let mut manner = Self::default();
        for Said { value, source } in stands {
            manner.words.push(source);
            manner.hear(value);
        }
        // What fell and lies on its side lies there as is said, not as chance has it.
        if manner.kind == Kind::Settle && manner.tip_deg.is_some() {
            manner.kind = Kind::Rest;
        }
        manner
    }

    fn hear(&mut self, stand: &'a Stand) {
        match stand {
            Stand::Resting => {}
            Stand::Upright => self.tip_deg = Some(0.0),
            Stand::OnSide => self.tip_deg = Some(90.0),
            // What lies heaped or in a row may be dumped too: it is heaped all the same.
            Stand::Settled if self.kind == Kind::Rest => self.kind = Kind::Settle,
            Stand::Settled => {}
            Stand::Buried(share) => self.burial = Some(share),
            Stand::Floating(over) => self.float(over.as_ref(), None, false),
            Stand::Moored(over) => self.float(over.as_ref(), None, true),
            Stand::BelowSurface(under) => self.float(None, Some(under), false),
            Stand::School => {
                self.float(None, None, false);
                if let Kind::Float { school, .. } = &mut self.kind {
                    *school = true;
                }
            }
            Stand::Heap => self.together(Kind::Heap),
            Stand::Row(spacing) => self.together(Kind::Row(spacing.as_ref())),
            Stand::Apart(distance) => match &mut self.kind {
                Kind::Row(spacing) if spacing.is_none() => *spacing = Some(distance),
                _ => self.clear_m = Some(distance),
            },
            Stand::Leaning(against) => self.kind = Kind::Leaning(against.as_deref()),
            Stand::On(of) => self.kind = Kind::On(of),
            Stand::Near { of, side, distance_m } => {
                let near = Kind::Near { of, side: *side, distance_m: distance_m.as_ref() };
                // A heap stays one: what it lies beside is put beside it.
                if self.kind.is_single() { self.kind = near } else { self.beside = Some(near) }
            }
            Stand::FromVehicle { side, distance_m } => {
                self.place = Place::FromVehicle(*side, distance_m.as_ref());
            }
            Stand::At(place, height) => self.place = Place::At(*place, *height),
            Stand::Within(from, to) => self.place = Place::Within(*from, *to),
            Stand::Around(radius) => self.place = Place::Around(radius),
        }
    }

    /// All in one place; what they were said to be near stays said.
    fn together(&mut self, kind: Kind<'a>) {
        let before = std::mem::replace(&mut self.kind, kind);
        if matches!(before, Kind::Near { .. }) {
            self.beside = Some(before);
        }
    }

    /// In the water; keeps what was said of that before.
    fn float(&mut self, over: Option<&'a Amount>, under: Option<&'a Amount>, line: bool) {
        let (before_over, before_under, before_line, school) = match self.kind {
            Kind::Float { over_m, under_m, moored, school } => (over_m, under_m, moored, school),
            _ => (None, None, false, false),
        };
        let (over_m, under_m) = (over.or(before_over), under.or(before_under));
        self.kind = Kind::Float { over_m, under_m, moored: line || before_line, school };
    }
}

/// Sides of each model that can be opened: longest, height, wider in plan.
fn sizes(thing: &Thing, asked: &Asked) -> Vec<(String, [f64; 3])> {
    let open = |uid: &String| {
        let solid = asked.assets.solid(&thing.models.catalog, uid).ok()?;
        let size = (solid.mesh.high - solid.mesh.low).as_dvec3();
        Some((uid.clone(), [size.max_element(), size.z, size.x.max(size.y)]))
    };
    thing.models.uids.iter().take(MOST_OPENED).filter_map(open).collect()
}

/// The models of the size that was asked for, all where none is; with what they measure.
fn of_size(thing: &Thing, sizes: Vec<(String, [f64; 3])>, notes: &mut Vec<String>) -> (Vec<String>, Bulk) {
    let bulk = |sizes: &[(String, [f64; 3])]| {
        let over = |side: usize| sizes.iter().map(|(_, size)| size[side]).fold(0.0, f64::max);
        let least = sizes.iter().map(|(_, size)| size[0]).fold(f64::INFINITY, f64::min);
        let [low, high] = thing.models.size_m;
        let known = Bulk { longest_m: [low, high], height_m: HEIGHT * high, wide_m: high };
        if sizes.is_empty() { known } else { Bulk { longest_m: [least, over(0)], height_m: over(1), wide_m: over(2) } }
    };
    let all = bulk(&sizes);
    let Some(Said { value: wanted, .. }) = &thing.size_m else { return (thing.models.uids.clone(), all) };
    let [low, high] = wanted.ends();
    let is_right = |size: f64| (low / SAME_SIZE..=high * SAME_SIZE).contains(&size);
    let right: Vec<_> = sizes.iter().filter(|(_, size)| is_right(size[0])).cloned().collect();
    if right.is_empty() {
        let [least, most] = all.longest_m;
        let are = if most - least < 0.01 { format!("{most:.2} m") } else { format!("{least:.2} to {most:.2} m") };
        let wanted = if high - low < 0.01 { format!("{low} m") } else { format!("{low} to {high} m") };
        notes.push(format!(
            "{}: {wanted} is asked for; models keep their sizes, and those of `{}` are {are}. For others take a catalog \
             that has them, or state `size_m` in one of your own",
            thing.label, thing.label
        ));
        return (thing.models.uids.clone(), all);
    }
    (right.iter().map(|(uid, _)| uid.clone()).collect(), bulk(&right))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn manner(stands: &[Said<Stand>]) -> (Kind<'_>, Option<f64>, Option<f64>) {
        let Manner { kind, tip_deg, burial, .. } = Manner::of(stands);
        (kind, tip_deg, burial.map(|amount| amount.ends()[1]))
    }

    #[test]
    fn what_is_said_together_is_one_pose() {
        let said = |stands: Vec<Stand>| -> Vec<_> { stands.into_iter().map(|stand| Said::by(0..1, stand)).collect() };
        let half = said(vec![Stand::Buried(Amount::Exactly(0.5)), Stand::OnSide]);
        assert_eq!(manner(&half), (Kind::Rest, Some(90.0), Some(0.5)));
        let school = said(vec![Stand::School, Stand::Floating(Some(Amount::Exactly(2.0)))]);
        let two = Amount::Exactly(2.0);
        let swims = Kind::Float { over_m: Some(&two), under_m: None, moored: false, school: true };
        assert_eq!(manner(&school).0, swims);
        let heap = said(vec![Stand::Heap, Stand::Settled]);
        assert_eq!(manner(&heap).0, Kind::Heap);
        let row = said(vec![Stand::Row(None), Stand::Apart(Amount::Exactly(2.0))]);
        assert_eq!(manner(&row).0, Kind::Row(Some(&two)));
    }
}
