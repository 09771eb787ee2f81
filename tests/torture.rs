//! Odd and broken glTF files, each with what it must give.

mod support;

use std::time::{Duration, Instant};

use ensonify::catalog::read_model;

#[test]
fn look() {
    let Some(folder) = support::shared("gltf-torture") else { return };
    let mut table = csv::Reader::from_path(folder.join("torture.csv")).expect("the table");
    for row in table.records() {
        let row = row.expect("a row");
        let (file, expect) = (&row[0], &row[2]);
        let begun = Instant::now();
        let result = read_model(&folder.join(file), Some(&folder));
        let took = begun.elapsed();
        assert!(took < Duration::from_secs(20));
        let text = match &result { Ok(r) => format!("OK {} kept {}", r.triangles, r.model.parts.iter().map(|p| p.triangles.len()).sum::<usize>()), Err(e) => e.to_string().replace(folder.to_str().unwrap(), "") };
        println!("{:6}us | {} | {} | {} | {}", took.as_micros(), file, &expect[..expect.len().min(12)], &row[4], text);
    }
}
