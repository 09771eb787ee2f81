//! A wish in one line, for tests: "300 images; 2 tire; 1 anchor; sand; 12 m deep; turbid".

use std::fs;

use crate::draft::wish::{Amount, Count, LookChange, Said, Stand, Wish};
use crate::draft::{Known, Options, Prompt};

/// Labels and tags of the catalog that the tests read prompts against.
const MODELS: [(&str, &str, &str); 34] = [
    ("aircraft", "aircraft", "plane;wreck"),
    ("amphora", "amphora", "jar;archaeology"),
    ("anchor", "anchor", "mooring"),
    ("auv", "auv", "glider;underwater vehicle"),
    ("beer-bottle", "bottle", "glass bottle;beer bottle;debris"),
    ("bicycle", "bicycle", "bike;debris"),
    ("bottle", "bottle", "glass bottle;wine bottle;debris"),
    ("bottom-mine", "bottom-mine", "ground mine;ordnance"),
    ("bucket", "bucket", "debris"),
    ("can", "can", "drink can;debris"),
    ("cannon", "cannon", "archaeology"),
    ("chain", "chain", "mooring"),
    ("crate", "crate", "wooden crate;debris"),
    ("cylinder", "cylinder", "shape"),
    ("diver", "diver", "person"),
    ("fish-crate", "crate", "fish box;debris"),
    ("ladder", "ladder", "aluminium ladder;debris"),
    ("ladder-wooden", "ladder", "wooden ladder;debris"),
    ("lobster-pot", "lobster-pot", "fishing gear"),
    ("moored-mine", "moored-mine", "contact mine;ordnance"),
    ("mooring-buoy", "buoy", "float"),
    ("oil-drum", "oil-drum", "barrel;debris"),
    ("oyster", "oyster", "shell"),
    ("pipe", "pipe", "steel pipe"),
    ("rock-1", "rock", "stone;small"),
    ("rock-3", "rock", "stone;large"),
    ("salmon", "fish", "fish"),
    ("shipping-container", "shipping-container", "container"),
    ("shipwreck", "shipwreck", "wreck"),
    ("shopping-trolley", "shopping-trolley", "debris"),
    ("tire", "tire", "car tire;debris"),
    ("torpedo", "torpedo", "ordnance"),
    ("truck-tire", "tire", "truck tire;debris"),
    ("valve", "valve", "gate valve"),
];

/// Such a catalog; its folder goes with it.
pub(in crate::draft) fn known() -> (tempfile::TempDir, Known) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mut rows = "uid,name,label,tags,path,size_m,up,material,licence,attribution,source\n".to_owned();
    for (uid, label, tags) in MODELS {
        rows += &format!("{uid},{},{label},{tags},{uid}.glb,1,y,,CC0-1.0,a,s\n", uid.replace('-', " "));
    }
    fs::write(folder.path().join("catalog.csv"), rows).expect("write");
    let known = Known::open(folder.path(), &[folder.path().to_string_lossy().into_owned()]).expect("the catalog");
    (folder, known)
}

/// Whether every prompt is read as it must be.
pub(super) fn all_are_read_as(cases: &[(&str, &str)]) {
    let (_folder, known) = known();
    let wrong: Vec<String> = cases
        .iter()
        .map(|(words, expected)| (words, expected, summary(words, &known)))
        .filter(|(_, expected, read)| read != *expected)
        .map(|(words, expected, read)| format!("{words}\n  not {expected}\n  but {read}"))
        .collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// What is read of a prompt, or the first problem.
pub(super) fn summary(words: &str, known: &Known) -> String {
    match super::read(&Prompt::new(words, Options::default()), known) {
        Ok(wish) => line(&wish),
        Err(refusal) => format!("refused: {}", refusal.problems[0].what),
    }
}

fn amount(amount: &Amount) -> String {
    let short = |value: &f64| format!("{}", (value * 100.0).round() / 100.0);
    match amount {
        Amount::Exactly(value) => short(value),
        Amount::Between(low, high) => format!("{}..{}", short(low), short(high)),
        Amount::OneOf(values) => values.iter().map(short).collect::<Vec<_>>().join("|"),
        Amount::Steps(first, last, _) => format!("{}→{}", short(first), short(last)),
    }
}

fn count(count: Count) -> String {
    match count {
        Count::Exactly(count) => count.to_string(),
        Count::Between(low, high) => format!("{low}..{high}"),
    }
}

fn stand(stand: &Stand) -> String {
    let opt = |value: &Option<Amount>| value.as_ref().map(|value| format!(" {}", amount(value))).unwrap_or_default();
    match stand {
        Stand::Buried(share) => format!("buried {}", amount(share)),
        Stand::Floating(height) => format!("floating{}", opt(height)),
        Stand::Moored(height) => format!("moored{}", opt(height)),
        Stand::BelowSurface(depth) => format!("below surface {}", amount(depth)),
        Stand::Row(spacing) => format!("row{}", opt(spacing)),
        Stand::Apart(spacing) => format!("apart {}", amount(spacing)),
        Stand::Leaning(of) => format!("leaning {}", of.as_deref().unwrap_or("on anything")),
        Stand::On(of) => format!("on {of}"),
        Stand::Near { of, side, distance_m } => {
            let side = side.map(|side| format!(" {side:?}")).unwrap_or_default();
            format!("near {of}{side}{}", opt(distance_m))
        }
        Stand::FromVehicle { side, distance_m } => format!("{side:?} of vehicle{}", opt(distance_m)),
        Stand::At([x, y], _) => format!("at {x} {y}"),
        Stand::Within([a, b], [c, d]) => format!("within {a} {b} {c} {d}"),
        Stand::Around(radius) => format!("around {}", amount(radius)),
        other => format!("{other:?}").to_lowercase(),
    }
}

/// The wish in one line.
fn line(wish: &Wish) -> String {
    let mut out: Vec<String> = Vec::new();
    let mut put = |text: Option<String>| out.extend(text);
    let measured = |said: &Option<Said<Amount>>, unit: &str| said.as_ref().map(|said| amount(&said.value) + unit);
    put(wish.images.as_ref().map(|said| format!("{} images", said.value)));
    put(wish.scenes.as_ref().map(|said| format!("{} scenes", said.value)));
    put(wish.seed.as_ref().map(|said| format!("seed {}", said.value)));
    put(wish.name.as_ref().map(|said| format!("named {}", said.value)));
    for thing in &wish.things {
        let many = thing.count.as_ref().map_or_else(|| "?".into(), |said| count(said.value));
        let how: Vec<String> = thing.stands.iter().map(|said| stand(&said.value)).collect();
        let size = measured(&thing.size_m, " m ").unwrap_or_default();
        let how = if how.is_empty() { String::new() } else { format!(" ({})", how.join(", ")) };
        put(Some(format!("{many} {size}{}{how}", thing.label)));
    }
    let list = |said: &Option<Said<Vec<String>>>| said.as_ref().map(|said| said.value.join("|"));
    for label in &wish.without {
        put(Some(format!("no {}", label.value)));
    }
    for unknown in &wish.unknown {
        put(Some(format!("unknown {}", unknown.called)));
    }
    put(wish.seabed.shape.as_ref().map(|said| said.value.clone()));
    put(measured(&wish.seabed.slope_deg, "° slope"));
    put(measured(&wish.seabed.wavelength_m, " m waves"));
    put(measured(&wish.seabed.height_m, " m high"));
    put(list(&wish.seabed.sediments).map(|all| all.replace("fine-sand|medium-sand|coarse-sand", "sand")));
    put(wish.environment.as_ref().map(|said| format!("in {}", said.value)));
    put(wish.environment_m.as_ref().map(|said| format!("of {:?} m", said.value)));
    put(measured(&wish.water.depth_m, " m deep"));
    put(measured(&wish.water.temperature_c, " °C"));
    put(measured(&wish.water.salinity_ppt, " ppt"));
    put(measured(&wish.water.ph, " pH"));
    put(list(&wish.water.turbidity));
    put(list(&wish.sonar.devices));
    put(measured(&wish.sonar.frequency_khz, " kHz"));
    put(wish.sonar.beams.as_ref().map(|said| format!("{} beams", said.value)));
    put(measured(&wish.sonar.fov_deg, "° wide"));
    put(measured(&wish.sonar.least_range_m, " m near"));
    put(measured(&wish.sonar.most_range_m, " m far"));
    put(measured(&wish.sonar.pitch_deg, "° pitch"));
    put(wish.path.route.as_ref().map(|said| format!("{:?}", said.value).replace("Some", "").replace("None", "-")));
    put(measured(&wish.path.altitude_m, " m altitude"));
    put(measured(&wish.path.vehicle_depth_m, " m under"));
    put(measured(&wish.path.range_m, " m range"));
    put(measured(&wish.path.speed_m_s, " m/s"));
    put(wish.path.heading_deg.as_ref().map(|said| format!("heading {}", said.value)));
    put(wish.path.position_m.as_ref().map(|said| format!("from {:?}", said.value)));
    put(wish.path.points_m.as_ref().map(|said| format!("{} points", said.value.len())));
    put(wish.splits.as_ref().map(|said| {
        let by = said.value.by.as_deref().map(|by| format!(" by {by}")).unwrap_or_default();
        format!("{}{by}", said.value.shares.map(|share| format!("{}", (share * 100.0).round())).join("/"))
    }));
    put(list(&wish.multipath).map(|mirrors| format!("multipath {mirrors}")));
    put(wish.output.raw.as_ref().map(|said| said.value.clone()));
    put(list(&wish.output.views).map(|views| format!("{views} only")));
    for look in &wish.looks {
        let changes: Vec<String> = look.value.changes.iter().map(change).collect();
        put(Some(format!("look {}", changes.join(" "))));
    }
    out.join("; ")
}

fn change(change: &LookChange) -> String {
    match change {
        LookChange::Speckle(strength) => format!("speckle {strength}"),
        LookChange::Noise(strength) => format!("noise {strength}"),
        LookChange::Turbidity(kind) | LookChange::Model(kind) => kind.clone(),
        LookChange::Temperature(value) => format!("{value} °C"),
    }
}
