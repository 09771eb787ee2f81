use super::*;

const SEED: u64 = 3;

fn address(scene: u64, level: Level) -> Address {
    Address { seed: SEED, scene, level }
}

fn split(text: &str) -> (Recipe, Lets) {
    Recipe::parse("a", text).unwrap().with_constants().unwrap()
}

/// A section of a recipe in a scene or frame, its shared draws written in.
fn section(text: &str, path: &str, scene: u64, level: Level) -> String {
    let (recipe, lets) = split(text);
    let shared = lets.draw(&address(scene, level)).unwrap();
    let tree = recipe.completed();
    let node = shared.complete_into(tree.at(path).unwrap(), path).unwrap();
    node.draw(path, &address(scene, level)).unwrap().json().to_string()
}

#[test]
fn constants_stand_everywhere_and_may_refer_to_each_other() {
    let text =
        "ensonify: 1\nlet: {far: $near, near: 4, list: [{label: $word}], word: tire}\nscenes: $far\nobjects: $list\n";
    let (recipe, lets) = split(text);
    assert_eq!(lets, Lets::default());
    assert_eq!(recipe.node().json().to_string(), r#"{"ensonify":1,"objects":[{"label":"tire"}],"scenes":4}"#);
}

/// The numbers of a section; its words are left out.
fn numbers(section: &str) -> BTreeMap<String, f64> {
    let all: BTreeMap<String, serde_json::Value> = serde_json::from_str(section).unwrap();
    all.into_iter().filter_map(|(key, value)| Some((key, value.as_f64()?))).collect()
}

#[test]
fn a_shared_draw_is_one_value_wherever_it_stands() {
    let text = "ensonify: 1\nlet: {t: {uniform: [4, 9]}, deep: {uniform: [$t, 10]}}\nwater: {temperature_c: $t, depth_m: $deep, ph: {uniform: [7, 8]}}\nseabed: {cell_m: $t}\n";
    let mut seen = BTreeSet::new();
    for scene in 0..20 {
        let water = numbers(&section(text, "water", scene, Level::Frame(0)));
        let again = numbers(&section(text, "water", scene, Level::Frame(5)));
        assert_eq!(water, again, "once a scene");
        assert!(water["depth_m"] >= water["temperature_c"] && water["depth_m"] <= 10.0);
        let cell = serde_json::json!(water["temperature_c"]).to_string();
        assert!(section(text, "seabed", scene, Level::Scene).contains(&format!("\"cell_m\":{cell}")));
        seen.insert(cell);
    }
    assert_eq!(seen.len(), 20);
    let plain = text.replace("deep: {uniform: [$t, 10]}", "deep: 10");
    let ph = |text: &str| section(text, "water", 1, Level::Frame(0)).split("\"ph\":").nth(1).unwrap().to_owned();
    assert_eq!(ph(text)[..10], ph(&plain)[..10], "other draws stay");
}

#[test]
fn a_draw_for_each_frame_stands_in_frames_alone() {
    let text =
        "ensonify: 1\nlet: {t: {uniform: [4, 9], per: frame}, two: {choice: [$t]}}\nwater: {temperature_c: $two}\n";
    let at = |frame| section(text, "water", 0, Level::Frame(frame));
    assert_ne!(at(0), at(1));
    let (_, lets) = split(text);
    let shared = lets.draw(&address(0, Level::Scene)).unwrap();
    assert!(shared.drawn.is_empty());
    let node = super::super::parse("a", "$two", super::super::Origin::Given).unwrap();
    let error = shared.write_into(&node, "seabed").unwrap_err();
    assert_eq!(error.message, "`$two` is drawn for each frame, but this part once a scene");
}

#[test]
fn a_kind_that_was_drawn_gets_its_defaults() {
    let text = "ensonify: 1\nlet: {shape: {choice: [{ripples: {height_m: 0.2}}]}, w: {choice: [{ph: 7}]}}\nwater: $w\nseabed: {shape: $shape}\n";
    let shape = section(text, "seabed", 0, Level::Scene);
    assert!(shape.contains("\"height_m\":0.2") && shape.contains("\"wavelength_m\":0.4"), "{shape}");
    let water = section(text, "water", 0, Level::Frame(0));
    assert!(water.contains("\"ph\":7") && water.contains("\"salinity_ppt\":35"), "{water}");
}

#[test]
fn two_dollars_are_one() {
    assert_eq!(
        section("ensonify: 1\nobjects: [{label: $$x, count: 2}]\n", "objects[0].label", 0, Level::Scene),
        "\"$x\""
    );
}

#[test]
fn unused_names_are_told() {
    let recipe = Recipe::parse("a", "ensonify: 1\nlet: {a: 1, b: 2}\nwater: {ph: $a}\n").unwrap();
    let unused = recipe.unused_lets(recipe.node());
    assert_eq!(unused.len(), 1);
    assert_eq!((unused[0].message.as_str(), unused[0].column()), ("nothing refers to `b`", Some(13)));
}

#[test]
fn what_cannot_be_is_refused_where_it_stands() {
    for (text, message, line) in [
        ("let: 3", "`let` is a map of names, found the number 3", 2),
        ("let: {uniform: [1, 2]}", "`let` is a map of names, found a map", 2),
        ("let: {1a: 3}", "`1a` cannot be a name", 2),
        ("let: {depth: 3}\nwater: {ph: $detph}", "`let` has no name `detph`", 3),
        ("water: {ph: $x}", "`let` has no name `x`", 2),
        ("let: {a: $b}", "`let` has no name `b`", 2),
        ("let: {a: $a}", "`a` refers to itself: a → a", 2),
        ("let: {x: $b, a: $b, b: [1, {c: $c}], c: {uniform: [$a, 1]}}", "`a` refers to itself: a → b → c → a", 2),
    ] {
        let error = Recipe::parse("a", &format!("ensonify: 1\n{text}\n")).unwrap().with_constants().unwrap_err();
        assert_eq!((error.message.as_str(), error.line()), (message, Some(line)), "{text}");
        assert!(!error.help.is_empty(), "{text}");
    }
    let error = |text: &str| Recipe::parse("a", text).unwrap().with_constants().unwrap_err();
    assert!(error("let: {depth: 3}\nwater: {ph: $detph}").help.contains("did you mean `depth`"));
}

#[test]
fn names_do_not_multiply_or_nest_without_end() {
    let doubling: String = (1..40).map(|i| format!("  a{i}: [$a{0}, $a{0}]\n", i - 1)).collect();
    let text = format!("let:\n  a0: 1\n{doubling}x: $a39\n");
    let error = Recipe::parse("a", &text).unwrap().with_constants().unwrap_err();
    assert!(error.message.contains("more than 200000 values"), "{error}");
    let nested: String = (1..400).map(|i| format!("  a{i}: [[[[$a{}]]]]\n", i - 1)).collect();
    let error = Recipe::parse("a", &format!("let:\n  a0: 1\n{nested}")).unwrap().with_constants().unwrap_err();
    assert!(error.message.contains("deeper than 64"), "{error}");
}

#[test]
fn a_long_way_into_a_circle_is_soon_told() {
    let chain: String = (0..30_000).map(|i| format!("  a{i}: $a{}\n", i + 1)).collect();
    let begun = std::time::Instant::now();
    let error = Recipe::parse("a", &format!("let:\n{chain}  a30000: $a30000\n")).unwrap().with_constants().unwrap_err();
    assert_eq!(error.message, "`a30000` refers to itself: a30000 → a30000");
    assert!(begun.elapsed().as_secs() < 2);
}
