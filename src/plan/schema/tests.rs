use super::*;

fn tree() -> Value {
    serde_json::from_str(&schema()).expect("JSON")
}

/// Calls `found` with the path and schema of every key in a schema.
fn keys(schema: &Value, path: &str, found: &mut dyn FnMut(&str, &Value)) {
    if let Some(entries) = schema["properties"].as_object() {
        for (key, value) in entries {
            let path = if path.is_empty() { key.clone() } else { format!("{path}.{key}") };
            found(&path, value);
            keys(value, &path, found);
        }
    }
    schema["anyOf"].as_array().into_iter().flatten().for_each(|form| keys(form, path, found));
    if schema["items"].is_object() {
        keys(&schema["items"], &format!("{path}[]"), found);
    }
}

#[test]
fn the_file_is_the_schema_of_this_program() {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("templates/recipe.schema.json");
    let file = std::fs::read_to_string(path).expect("the file is there");
    assert!(file == schema(), "write it anew: cargo run --release -- schema > templates/recipe.schema.json");
}

#[test]
fn every_key_has_a_title_and_nearly_every_leaf_a_default_or_an_example() {
    let (mut leaves, mut shown, mut untitled) = (0, 0, Vec::new());
    keys(&tree(), "", &mut |path, value| {
        if !value["title"].is_string() {
            untitled.push(path.to_owned());
        }
        leaves += 1;
        shown += u32::from(!value["default"].is_null() || !value["examples"].is_null());
    });
    assert!(untitled.is_empty(), "no title in titles.yaml: {untitled:#?}");
    assert!(leaves > 120 && shown * 10 > leaves * 7, "{shown} of {leaves}");
}

#[test]
fn no_title_is_of_a_key_that_is_none() {
    let mut paths = std::collections::BTreeSet::new();
    keys(&tree(), "", &mut |path, _| {
        paths.insert(path.to_owned());
        paths.insert(path.rsplit('.').next().unwrap_or(path).to_owned());
    });
    let titles = parse("titles", TITLES, Origin::BuiltIn).expect("YAML");
    for (path, words) in titles.entries() {
        assert!(paths.contains(&path.text), "{}", path.text);
        assert!((1..=2).contains(&words.items().len()) && words.items()[0].text().is_some(), "{}", path.text);
    }
}

#[test]
fn types_kinds_units_and_defaults_are_told() {
    let tree = tree();
    let at = |path: &str| {
        let mut found = Value::Null;
        keys(&tree, "", &mut |key, value| {
            if key == path {
                found = value.clone();
            }
        });
        assert!(!found.is_null(), "{path}");
        found
    };
    assert_eq!(at("sonar.beams")["anyOf"][0]["type"], "integer");
    assert_eq!(at("sonar.range_m")["anyOf"][0]["maxItems"], 2);
    assert_eq!(at("water.ph")["default"], 8.0);
    assert_eq!(at("water.temperature_c")["description"], "Unit: degrees Celsius.");
    let kinds = [
        "flat",
        "fractal",
        "ripples",
        "slope",
        "sand-waves",
        "rock-field",
        "rubble",
        "reef",
        "trench",
        "pipeline-trench",
        "height-map",
    ];
    assert_eq!(at("seabed.shape")["anyOf"][0]["anyOf"][0]["enum"], json!(kinds));
    assert_eq!(at("seabed.patches[].share")["default"], 0.3);
    assert_eq!(at("image.model.physical.array.shading.chebyshev.side_lobe_db")["default"], 35);
    assert_eq!(at("water.turbidity.sediment.concentration_kg_m3")["description"], "Unit: kilograms a cubic metre.");
    assert_eq!(at("seabed.shape.ripples.wavelength_m")["default"], 0.4);
    assert_eq!(at("splits.by")["anyOf"][0]["enum"], json!(["scene", "asset", "variant"]));
    assert_eq!(at("objects[].pose.rest.burial")["default"], 0);
    assert_eq!(at("trajectory.views.range_m")["default"]["uniform"], json!([3, 8]));
    assert_eq!(at("trajectory.waypoints.speed_m_s")["description"], "Unit: metres a second.");
    assert_eq!(at("vehicle.ping_s")["description"], "Unit: seconds.");
    assert_eq!(at("image.model")["anyOf"][0]["anyOf"][0]["enum"], json!(["physical", "deepsonar", "holoocean"]));
}

#[test]
fn the_shape_of_no_type_stays_unseen() {
    for shape in [
        shape_of::<Sonar>(),
        shape_of::<TurbidWater>(),
        shape_of::<SeabedSpec>(),
        shape_of::<EnvironmentSpec>(),
        shape_of::<Multipath>(),
        shape_of::<Vehicle>(),
        shape_of::<Trajectory>(),
        shape_of::<ImageModel>(),
        shape_of::<ObjectEntry>(),
        shape_of::<Output>(),
    ] {
        assert!(shape.is_seen(), "{shape:?}");
    }
}
