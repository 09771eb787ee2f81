use super::*;

#[test]
fn a_recipe_goes_all_the_way() {
    let text = "ensonify: 1\nwater: {temperature_c: {uniform: [4, 22]}}\nseabed: {shape: {choice: {ripples: 1}}}\nobjects:\n  - label: tire\n";
    let mut recipe = Recipe::parse("a.yaml", text).unwrap();
    recipe.set("water.depth_m", "20").unwrap();
    let tree = recipe.completed();
    assert_eq!(tree.version(), Ok(1));
    assert_eq!(tree.section::<u32>("frames"), Ok(Some(10)));
    assert_eq!(tree.section::<u32>("nothing"), Ok(None));
    let address = Address { seed: 1, scene: 0, level: Level::Scene };
    let water = tree.at("water").unwrap().draw("water", &address).unwrap();
    let number = |key| water.at(key).unwrap().number();
    assert!((4.0..22.0).contains(&number("temperature_c").unwrap()));
    assert_eq!((number("depth_m"), number("ph")), (Some(20.0), Some(8.0)));
    let shape = tree.at("seabed.shape").unwrap().draw("seabed.shape", &address).unwrap();
    assert_eq!(shape.at("ripples.height_m").unwrap().number(), Some(0.04));
    let instance = Address { level: Level::Instance(2), ..address };
    let (object, draws) = tree.at("objects[0]").unwrap().draw_recorded("objects[0]", &instance).unwrap();
    assert_eq!(object.at("pose.rest.yaw_deg").unwrap().json(), draws["objects[0].pose.rest.yaw_deg"]);
    assert_eq!(object.get("label").unwrap().text(), Some("tire"));
}

#[test]
fn the_format_version_is_checked() {
    let fault = |text: &str| {
        let error = Recipe::parse("a", text).unwrap().completed().version().unwrap_err();
        format!("{} {}", error.span, error.message)
    };
    assert_eq!(fault("name: x"), "a:1:1 the key `ensonify` is missing");
    assert_eq!(fault("ensonify: 2"), "a:1:11 format version 2 is newer than this program, which reads 1");
    assert_eq!(fault("ensonify: 0"), "a:1:11 the format version cannot be the number 0");
    assert_eq!(fault("ensonify: \"1\""), "a:1:11 the format version cannot be the text `1`");
}

#[test]
fn a_recipe_is_a_map() {
    for (text, found) in [("[1]", "a list"), ("hello", "the text `hello`"), ("null", "nothing")] {
        let error = Recipe::parse("a", text).unwrap_err();
        assert_eq!(error.message, format!("a recipe is a map of sections, found {found}"));
        assert_eq!(error.line(), Some(1));
    }
}

#[test]
fn a_rejected_value_is_located() {
    let tree = Recipe::parse("a", "ensonify: 1\nsonar:\n  range_m: [9, 2]\n").unwrap().completed();
    let error = tree.reject("sonar.range_m", "near must be less than far", "swap them");
    let block = "a:3:12: near must be less than far in sonar.range_m\n  3 |   range_m: [9, 2]\n    |            ^\nhelp: swap them";
    assert_eq!(error.to_string(), block);
    let error = tree.reject("sonar.mount.pitch_deg", "looks up", "");
    assert_eq!(error.span.to_string(), "a:2:1");
    assert_eq!(error.help, "the value comes from the defaults");
}
