//! A comparison as text, for people.

use std::fmt::Write as _;

use super::compare::{Comparison, Distance, Group};

/// Columns: figure, real, ours, distance; a verdict under each group.
#[must_use]
pub fn table(comparison: &Comparison) -> String {
    let names = comparison.groups.iter().flat_map(|group| &group.lines).filter(|line| line.real.is_some());
    let width = names.map(|line| line.name.chars().count()).max().unwrap_or(0);
    let mut text = String::new();
    for group in &comparison.groups {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{:width$}  {:>9}  {:>9}  distance", group.name, "real", "ours", width = width + 2);
        rows(&mut text, group, width);
        let _ = writeln!(text, "  -> {}\n", group.verdict);
    }
    text
}

fn rows(text: &mut String, group: &Group, width: usize) {
    for line in &group.lines {
        if let (None, None, Distance::NotComparable(why)) = (line.real, line.ours, &line.distance) {
            let _ = writeln!(text, "  {}: not comparable: {why}", line.name);
            continue;
        }
        let [real, ours] = [line.real, line.ours].map(|value| value.map_or_else(|| "-".to_owned(), number));
        let distance = match &line.distance {
            Distance::Relative(distance) => format!("{:+.0} %", 100.0 * distance),
            Distance::Difference(distance) => format!("{} apart", signed(*distance)),
            Distance::NotComparable(why) => format!("not comparable: {why}"),
        };
        let _ = writeln!(text, "  {:width$}  {real:>9}  {ours:>9}  {distance}", line.name);
    }
}

/// Three or four digits that count.
fn number(value: f64) -> String {
    match value.abs() {
        0.0 => "0".to_owned(),
        size if size < 0.001 => format!("{value:.1e}"),
        size if size < 1.0 => format!("{value:.3}"),
        size if size < 10.0 => format!("{value:.2}"),
        _ => format!("{value:.1}"),
    }
}

fn signed(value: f64) -> String {
    let number = number(value);
    if value > 0.0 { format!("+{number}") } else { number }
}

#[cfg(test)]
mod tests {
    use super::super::compare::Line;
    use super::*;

    #[test]
    fn columns_line_up_and_every_line_has_its_distance() {
        let line = |name: &str, ours: f64, distance| Line {
            name: name.to_owned(),
            real: Some(71.0),
            ours: Some(ours),
            distance,
        };
        let why = Distance::NotComparable("no such class".to_owned());
        let lines = vec![
            line("50 %", 64.0, Distance::Relative(64.0 / 71.0 - 1.0)),
            line("skewness, median", -0.25, Distance::Difference(-71.25)),
            Line { real: None, ours: None, ..line("a name that is much longer than all others", 0.0, why) },
        ];
        let group = Group { name: "quantiles", lines, verdict: "within 10 %".to_owned() };
        let expected = "\
quantiles                real       ours  distance
  50 %                   71.0       64.0  -10 %
  skewness, median       71.0     -0.250  -71.2 apart
  a name that is much longer than all others: not comparable: no such class
  -> within 10 %

";
        assert_eq!(table(&Comparison { groups: vec![group] }), expected);
    }

    #[test]
    fn numbers_keep_the_digits_that_count() {
        let shown = [0.0, 8.077e-7, 0.0312, 4.977, 71.04, -0.5].map(number);
        assert_eq!(shown, ["0", "8.1e-7", "0.031", "4.98", "71.0", "-0.500"]);
    }
}
