use std::fmt::Write as _;

use super::*;
use crate::math::rng::Stream;
use crate::recipe::{Address, Level, Recipe};

/// `line:column message` of the fault in a text.
fn fault(text: &str) -> String {
    let error = parse("a", text, Origin::Given).unwrap_err();
    assert!(!error.help.is_empty(), "{error}");
    format!("{}:{} {}", error.span.line, error.span.column, error.message)
}

/// `line:column` of the value at a path.
fn place(text: &str, path: &str) -> String {
    let tree = parse("a", text, Origin::Given).unwrap();
    let span = &tree.at(path).unwrap().span;
    format!("{}:{}", span.line, span.column)
}

#[test]
fn values_are_read_by_type() {
    let text = "a: 1\nb: 1.5\nc: yes\nd: 'true'\ne: true\nf: ~\ng: [1, two]\nh: {i: \"3\"}\nj: |\n  x\n  y\n";
    let json = parse("a", text, Origin::Given).unwrap().json().to_string();
    assert_eq!(
        json,
        r#"{"a":1,"b":1.5,"c":"yes","d":"true","e":true,"f":null,"g":[1,"two"],"h":{"i":"3"},"j":"x\ny\n"}"#
    );
}

#[test]
fn every_value_has_its_place() {
    let text = "é: {ü: x, y: [1, 2]}\nmap:\n  in: 5\nlist:\n  - a\n  - b: 1\n    c:\nnothing:\nlast: 1\n";
    for (path, expected) in [
        ("é", "1:4"),
        ("é.ü", "1:8"),
        ("é.y[1]", "1:18"),
        ("map", "2:1"),
        ("map.in", "3:7"),
        ("list", "4:1"),
        ("list[0]", "5:5"),
        ("list[1]", "6:5"),
        ("list[1].b", "6:8"),
        ("list[1].c", "7:5"),
        ("nothing", "8:1"),
        ("last", "9:7"),
    ] {
        assert_eq!(place(text, path), expected, "{path}");
    }
    assert_eq!(place("\u{feff}a: 1\r\nb: 2\r\n", "b"), "2:4");
}

#[test]
fn what_is_not_taken_is_refused_by_name() {
    for (text, expected) in [
        ("a: 1\nb: 2\na: 3\n", "3:1 the key `a` stands twice"),
        ("x: {a: 1, \"a\": 3}\n", "1:11 the key `a` stands twice"),
        ("a: &x 1\n", "1:4 anchors (`&name`) are not used in recipes"),
        ("a: &x [1]\n", "1:4 anchors (`&name`) are not used in recipes"),
        ("a: *x\n", "1:4 aliases (`*name`) are not used in recipes"),
        ("<<: {a: 1}\n", "1:1 merge keys (`<<`) are not used in recipes"),
        ("a: !!str 1\n", "1:4 tags (`!name`) are not used in recipes"),
        ("!x a: 1\n", "1:1 tags (`!name`) are not used in recipes"),
        ("a: 1\n---\nb: 2\n", "2:1 a second document begins here"),
        ("? [a]\n: 1\n", "1:3 a list or map cannot be a key"),
        (": 1\n", "1:1 a key is missing before the colon"),
        ("a: .inf\n", "1:4 infinity and not-a-number are no values of a recipe: `.inf`"),
        ("a: 1\nb: 1e999\n", "2:4 the number is too large: `1e999`"),
        ("a: b: c\n", "1:5 not valid YAML: mapping values are not allowed in this context"),
        ("a: [1, 2\n", "2:1 not valid YAML: while parsing a flow sequence, expected ',' or ']'"),
        ("a: 'x\n", "1:4 not valid YAML: while scanning a quoted scalar, found unexpected end of stream"),
        ("a: 1\nb: x\0y\n", "2:5 a control character is not allowed in YAML"),
        ("", "0:0 is empty"),
        ("# only a comment\n", "0:0 is empty"),
        ("---\n...\n", "0:0 is empty"),
    ] {
        assert_eq!(fault(text), expected, "{text:?}");
    }
    let twice = parse("a", "a: 1\nb: 2\na: 3\n", Origin::Given).unwrap_err();
    assert_eq!(twice.help, "it stands first at a:1:1; keep one of the two");
}

#[test]
fn limits_are_kept() {
    let nested = |depth: usize| format!("a: {}1{}", "[".repeat(depth), "]".repeat(depth));
    assert!(parse("a", &nested(MAX_DEPTH - 1), Origin::Given).is_ok());
    assert_eq!(fault(&nested(MAX_DEPTH)), "1:68 nested deeper than 64 levels");
    assert!(fault(&"[".repeat(1_000_000)).ends_with("nested deeper than 64 levels"));
    assert!(fault(&"{a: ".repeat(1_000_000)).ends_with("nested deeper than 64 levels"));
    assert!(fault(&"- ".repeat(1_000_000)).ends_with("nested deeper than 64 levels"));
    assert!(fault(&"? ".repeat(1_000_000)).ends_with("a list or map cannot be a key"));
    assert!(fault(&format!("[{}]", "1,".repeat(MAX_NODES + 1))).ends_with("more than 200000 values"));
    assert_eq!(fault(&" ".repeat(MAX_BYTES + 1)), "0:0 is larger than 4 MiB");
    let wide = (0..50_000).fold(String::new(), |mut text, i| {
        writeln!(text, "k{i}: 1").unwrap();
        text
    });
    assert_eq!(parse("a", &wide, Origin::Given).unwrap().entries().len(), 50_000);
}

#[test]
fn files_that_cannot_be_read_say_why() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str, bytes: &[u8]| {
        let path = folder.path().join(name);
        std::fs::write(&path, bytes).unwrap();
        path
    };
    let fault = |path: &Path| {
        let error = read(path).unwrap_err();
        assert_eq!(error.file(), path.display().to_string());
        format!("{}:{} {}", error.span.line, error.span.column, error.message)
    };
    assert_eq!(fault(&folder.path().join("none.yaml")), "0:0 there is no such file");
    assert_eq!(fault(folder.path()), "0:0 is a folder, not a file");
    assert_eq!(fault(&file("latin.yaml", b"a: 1\nb: h\xf6he\n")), "2:5 the text is not UTF-8");
    assert_eq!(fault(&file("utf16.yaml", b"\xff\xfea\0:\0")), "1:1 the text is not UTF-8");
    assert_eq!(fault(&file("large.yaml", &vec![b' '; MAX_BYTES + 1])), "0:0 is larger than 4 MiB");
    assert_eq!(fault(&file("empty.yaml", b"")), "0:0 is empty");
    assert_eq!(read(&file("good.yaml", b"a: 1\n")).unwrap().json().to_string(), r#"{"a":1}"#);
}

const GOOD: &str = "ensonify: 1
name: quickstart
sonar: {device: oculus-m1200d-lf, range_m: [0.5, 10], mount: {pitch_deg: {normal: [-15, 2], min: -20, max: -10}}}
water:
  temperature_c: {uniform: [4, 22], per: dataset}
  turbidity: {choice: {clear: 0.6, coastal: 0.3, 'turbid': 0.1}}
seabed:
  shape: {choice: [flat, {ripples: {wavelength_m: {log_uniform: [0.15, 0.6]}}}], weights: [1, 2]}
objects:
  - label: \"tire\"
    count: {int: [1, 3]}
    pose: {rest: {burial: {uniform: [0, 0.3]}}}
  - label: >
      folded
    count: 0x2
trajectory: orbit
";

/// Reads, completes, checks, draws and types a text: what must never panic, whatever the text.
fn all(text: &str) -> bool {
    let Ok(mut recipe) = Recipe::parse("a", text) else { return false };
    let tree = recipe.completed();
    let _ = tree.version().map_err(|error| error.to_string());
    let address = Address { seed: 1, scene: 2, level: Level::Frame(3) };
    let checked = tree.node().check_distributions("", address.level);
    let drawn = tree.node().draw("", &address);
    assert!(drawn.is_ok() || checked.is_err(), "what is checked can be drawn: {text}");
    let _ = recipe.set("objects[0].pose.rest.burial", text).map_err(|error| error.to_string());
    let _ = recipe.set(text, "1").map_err(|error| error.to_string());
    let typed = drawn.and_then(|node| node.to::<std::collections::BTreeMap<String, Vec<f64>>>(""));
    let _ = typed.map_err(|error| error.to_string());
    checked.is_ok()
}

#[test]
fn no_text_makes_it_panic() {
    assert!(all(GOOD));
    let characters: Vec<char> = GOOD.chars().collect();
    let odd: Vec<char> = "{}[]:,-?&*!|>'\"%@`#\n\t \r~0.eé\u{feff}\0<x\u{2028}\\".chars().collect();
    let mut stream = Stream::at(1, "test", 0, "mutations");
    for _ in 0..2_000 {
        let mut text = characters.clone();
        for _ in 0..=stream.below(4) {
            let at = stream.below(text.len() as u64) as usize;
            let other = stream.below(text.len() as u64) as usize;
            match stream.below(6) {
                0 => text[at] = odd[stream.below(odd.len() as u64) as usize],
                1 => text.insert(at, odd[stream.below(odd.len() as u64) as usize]),
                2 => drop(text.remove(at)),
                3 => text.truncate(at.max(1)),
                4 => drop(text.drain(at.min(other)..at.max(other).min(text.len() - 1))),
                _ => text.splice(at..at, vec!['['; other % 90]).for_each(drop),
            }
            if text.is_empty() {
                text.push('a');
            }
        }
        all(&text.into_iter().collect::<String>());
    }
}

const ODD: &[u8] = b"{}[]:,-?&*!|>'\"%#\n\n\t  ~0.ex<";

#[test]
fn no_garbage_makes_it_panic() {
    let mut stream = Stream::at(1, "test", 0, "garbage");
    for _ in 0..500 {
        let mut bytes = vec![0; stream.below(200) as usize];
        stream.fill_bits(&mut bytes);
        all(&String::from_utf8_lossy(&bytes));
        bytes.iter_mut().for_each(|byte| *byte = ODD[usize::from(*byte) % ODD.len()]);
        all(&String::from_utf8_lossy(&bytes));
    }
}
