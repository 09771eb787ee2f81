//! Every published reference value against the function that computes it.
//!
//! A row is answered by group and by the names of its inputs. A row fails if its group or an input is unknown, if an expected
//! figure is not computed, or if it differs by more than `atol + rtol·|expected|` and by more than the table's own rounding.

#[path = "../support/mod.rs"]
mod support;

mod echoes;
mod geometry;
mod receiver;
mod row;
mod water;

use std::collections::BTreeMap;

use row::Row;
use serde_json::{Value, json};

/// Rows that are not computed: start of their id, and why. None is left out.
const EXEMPT: &[(&str, &str)] = &[];

#[test]
fn every_reference_value_is_computed() {
    let Some(rows) = support::reference_table() else { return };
    let (mut counts, mut failures) = (BTreeMap::new(), Vec::new());
    let mut exempt = vec![0; EXEMPT.len()];
    for row in rows.into_iter().map(Row::new) {
        *counts.entry(row.group.clone()).or_insert(0) += 1;
        match EXEMPT.iter().position(|(start, _)| row.id.starts_with(start)) {
            Some(which) => exempt[which] += 1,
            None => failures.extend(check(&row).err()),
        }
    }
    println!("{counts:?}");
    assert!(failures.is_empty(), "{} rows fail:\n{}", failures.len(), failures.join("\n"));
    for ((start, reason), rows) in EXEMPT.iter().zip(exempt) {
        assert!(rows > 0, "no row `{start}…` is left to leave out because {reason}");
    }
}

/// Computes a row and compares; the error says what is wrong with which row.
fn check(row: &Row) -> Result<(), String> {
    let about = |problem: String| format!("{}: {problem}", row.id);
    let answer = answer(row).map_err(about)?;
    row.all_inputs_used().map_err(about)?;
    same(&row.expected, &answer, row).map_err(about)
}

/// The figures that the library computes for a row, in the shape of its expected figures.
fn answer(row: &Row) -> Result<Value, String> {
    match row.group.as_str() {
        "absorption_AM98" | "absorption_FG82" => water::absorption(row),
        "absorption_anchor" => water::absorption_anchor(row),
        "absorption_factor" => water::absorption_factor(row),
        "deepsonar_error" => water::deepsonar(row),
        "sound_speed" => water::sound_speed(row),
        "turbidity" => water::turbidity(row),
        "impedance" => echoes::impedance(row),
        "reflection" => echoes::reflection(row),
        "target_strength" => echoes::target_strength(row),
        "lambert" => echoes::lambert(row),
        "ray_energy" => echoes::ray_energy(row),
        "speckle" => echoes::speckle(row),
        "beamwidth" => receiver::beam_width(row),
        "array" => receiver::array(row),
        "range_resolution" => receiver::range_resolution(row),
        "ping_rate" => receiver::ping_rate(row),
        "noise" => receiver::noise(row),
        "tvg" => receiver::time_varied_gain(row),
        "sonar_equation" => receiver::sonar_equation(row),
        "shadow" => geometry::shadow(row),
        "sphere_bins" => geometry::sphere_bins(row),
        "multipath" => geometry::multipath(row),
        "footprint" => geometry::footprint(row),
        "refraction" => geometry::refraction(row),
        "motion" => geometry::motion(row),
        "dvl" => geometry::janus(row),
        other => Err(format!("no function for group `{other}`")),
    }
}

/// Compares expected figures with computed ones; every expected one must be there.
fn same(expected: &Value, answer: &Value, row: &Row) -> Result<(), String> {
    match (expected, answer) {
        (Value::Null, Value::Null) => Ok(()),
        (Value::Number(_), Value::Number(_)) => {
            let [e, a] = [expected, answer].map(|v| v.as_f64().expect("a number"));
            let within = (a - e).abs() <= (row.atol + row.rtol * e.abs()).max(rounding(expected));
            within.then_some(()).ok_or_else(|| format!("expected {e}, computed {a}"))
        }
        (Value::Object(figures), Value::Object(computed)) => figures.iter().try_for_each(|(key, figure)| {
            let found = computed.get(key).ok_or_else(|| format!("`{key}` is not computed"))?;
            same(figure, found, row).map_err(|problem| format!("{key}: {problem}"))
        }),
        (Value::Array(figures), Value::Array(computed)) if figures.len() == computed.len() => {
            figures.iter().zip(computed).try_for_each(|(figure, found)| same(figure, found, row))
        }
        _ => Err(format!("expected {expected}, computed {answer}")),
    }
}

/// Half a unit in the last printed place, of figures printed to three decimals or more; 0 for coarser ones, which may be exact.
fn rounding(printed: &Value) -> f64 {
    let text = printed.to_string();
    let (digits, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let decimals = digits.split_once('.').map_or(0, |(_, decimals)| decimals.len() as i32);
    let places = decimals - exponent.parse::<i32>().expect("an exponent");
    // The slack is for a digit that lies half way.
    if places < 3 { 0.0 } else { format!("0.5000001e-{places}").parse().expect("a number") }
}

#[test]
fn rounding_is_that_of_the_printed_digits() {
    for (printed, half) in [(json!(18.4349), 5e-5), (json!(5.8475e-9), 5e-14), (json!(14.5), 0.0), (json!(512), 0.0)] {
        assert!((rounding(&printed) - half).abs() <= 1e-6 * half, "{printed}");
    }
}

#[test]
fn a_row_that_is_wrong_or_unknown_fails() {
    let ping = |group: &str, inputs: Value, expected: Value| {
        let row = json!({"id": "x", "group": group, "inputs": inputs, "expected": expected, "rtol": 1e-6});
        check(&Row::new(row))
    };
    assert_eq!(ping("ping_rate", json!({"R_m": 5, "c": 1500}), json!(150.0)), Ok(()));
    let fails = |group, inputs, expected, why: &str| {
        let problem = ping(group, inputs, expected).unwrap_err();
        assert!(problem.contains(why), "{problem}");
    };
    fails("ping_rate", json!({"R_m": 5, "c": 1500}), json!(150.1), "expected 150.1");
    fails("ping_rate", json!({"R_m": 5, "c": 1500}), json!(null), "expected null");
    fails("ping_rate", json!({"R_m": 5, "c": 1500}), json!({"rate": 150.0}), "expected {");
    fails("ping_rate", json!({"R_m": 5, "c": 1500, "layers": 2}), json!(150.0), "`layers`");
    fails("ping_rate", json!({"R_m": 5}), json!(150.0), "`c`");
    fails("ping_pong", json!({"R_m": 5}), json!(150.0), "ping_pong");
}
