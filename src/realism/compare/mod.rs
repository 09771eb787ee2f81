//! Two sets of figures side by side, in seven groups.
//!
//! A distance is `ours / real − 1`, or a plain difference where the real value is near zero by its nature. What one side does
//! not have, or what means something else there, is not compared, and the line says why.

mod groups;

use serde::Serialize;

use crate::realism::figures::Figures;

/// Figures side by side.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Comparison {
    /// Seven groups, always the same.
    pub groups: Vec<Group>,
}

/// Figures of one kind.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Group {
    /// What they are of.
    pub name: &'static str,
    /// One a figure.
    pub lines: Vec<Line>,
    /// How near all relative distances are, in words: `within 15 %`.
    pub verdict: String,
}

/// One figure.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Line {
    /// Its name.
    pub name: String,
    /// Of the images compared with.
    pub real: Option<f64>,
    /// Of the images measured.
    pub ours: Option<f64>,
    /// How far ours is.
    pub distance: Distance,
}

/// How far a figure is from another.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Distance {
    /// ours / real − 1.
    Relative(f64),
    /// ours − real.
    Difference(f64),
    /// Why there is none.
    NotComparable(String),
}

/// Compares `ours` with `real`.
#[must_use]
pub fn compare(real: &Figures, ours: &Figures) -> Comparison {
    let groups: [(&'static str, Fill); 7] = [
        ("quantiles of grey", groups::quantiles),
        ("patch mean/std and its dependence on the mean", groups::patches),
        ("object and shadow contrast", groups::objects),
        ("lateral and range correlation", groups::correlation),
        ("range profile", groups::profile),
        ("beam ripple", groups::ripple),
        ("patch distribution (median KS distance)", groups::distribution),
    ];
    let group = |(name, fill): (&'static str, Fill)| {
        let mut lines = Lines { real, ours, lines: Vec::new() };
        fill(&mut lines);
        let verdict = verdict(&lines.lines);
        Group { name, lines: lines.lines, verdict }
    };
    Comparison { groups: groups.into_iter().map(group).collect() }
}

/// `within N %` of the farthest figure; where that is beyond 25 %, also how far the middle one is and which is farthest.
fn verdict(lines: &[Line]) -> String {
    let relative = |line: &Line| match line.distance {
        Distance::Relative(distance) => Some((distance.abs() * 100.0, line.name.clone())),
        Distance::Difference(_) | Distance::NotComparable(_) => None,
    };
    let mut distances: Vec<(f64, String)> = lines.iter().filter_map(relative).collect();
    distances.sort_by(|a, b| a.0.total_cmp(&b.0));
    let Some((worst, name)) = distances.last() else { return "not comparable".to_owned() };
    let count = if distances.len() < lines.len() {
        format!(" ({} of {} figures)", distances.len(), lines.len())
    } else {
        String::new()
    };
    if *worst <= 25.0 {
        return format!("within {} %{count}", worst.ceil());
    }
    let middle = distances[distances.len() / 2].0;
    format!("within {} %, half of it within {} %; farthest: {name}{count}", worst.ceil(), middle.ceil())
}

/// Writes the lines of one group.
type Fill = fn(&mut Lines<'_>);

/// Lines of a group in the making.
struct Lines<'a> {
    real: &'a Figures,
    ours: &'a Figures,
    lines: Vec<Line>,
}

/// A value of a set of figures, if the set has it.
type Value<'v> = &'v dyn Fn(&Figures) -> Option<f64>;

impl Lines<'_> {
    /// A figure compared relatively.
    fn ratio(&mut self, name: impl Into<String>, value: Value<'_>) {
        self.add(name.into(), value, |real, ours| {
            if real == ours {
                Distance::Relative(0.0)
            } else if real == 0.0 {
                Distance::NotComparable("the real value is 0".to_owned())
            } else {
                Distance::Relative(ours / real - 1.0)
            }
        });
    }

    /// A figure that may be near zero.
    fn difference(&mut self, name: impl Into<String>, value: Value<'_>) {
        self.add(name.into(), value, |real, ours| Distance::Difference(ours - real));
    }

    fn add(&mut self, name: String, value: Value<'_>, distance: fn(f64, f64) -> Distance) {
        let (real, ours) = (value(self.real), value(self.ours));
        let distance = match (real, ours) {
            (Some(real), Some(ours)) => distance(real, ours),
            (None, Some(_)) => Distance::NotComparable("not among the real figures".to_owned()),
            (Some(_), None) => Distance::NotComparable("nothing to measure it on in ours".to_owned()),
            (None, None) => Distance::NotComparable("in neither".to_owned()),
        };
        self.lines.push(Line { name, real, ours, distance });
    }

    /// A figure that is not compared.
    fn apart(&mut self, name: impl Into<String>, why: &str) {
        let distance = Distance::NotComparable(why.to_owned());
        self.lines.push(Line { name: name.into(), real: None, ours: None, distance });
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;

    fn line(real: f64, ours: f64) -> Line {
        let distance = Distance::Relative(ours / real - 1.0);
        Line { name: format!("{ours}"), real: Some(real), ours: Some(ours), distance }
    }

    #[test]
    fn a_verdict_says_how_far_the_farthest_is() {
        assert_eq!(verdict(&[line(100.0, 85.1), line(100.0, 101.0)]), "within 15 %");
        let far = verdict(&[line(100.0, 300.0), line(100.0, 102.0), line(100.0, 90.5)]);
        assert_eq!(far, "within 200 %, half of it within 10 %; farthest: 300");
        let apart = Line { distance: Distance::NotComparable("x".to_owned()), ..line(1.0, 1.0) };
        assert_eq!(verdict(&[line(100.0, 85.1), apart.clone()]), "within 15 % (1 of 2 figures)");
        assert_eq!(verdict(&[apart]), "not comparable");
    }

    #[test]
    fn published_figures_are_zero_from_themselves_and_summarised_as_their_description_says() {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/real-sonar/aris3000_stats.json");
        if !path.exists() {
            println!("skipped: {} is not there", path.display());
            return;
        }
        let real = Figures::read(&path).unwrap();
        let comparison = compare(&real, &real);
        for line in comparison.groups.iter().flat_map(|group| &group.lines) {
            match line.distance {
                Distance::Relative(distance) | Distance::Difference(distance) => assert_eq!(distance, 0.0, "{line:?}"),
                Distance::NotComparable(_) => panic!("{line:?}"),
            }
        }
        let value = |group: usize, name: &str| {
            let lines = &comparison.groups[group].lines;
            lines.iter().find(|line| line.name == name).unwrap().real.unwrap()
        };
        assert!((value(4, "median grey, farthest / nearest bin") - 0.6).abs() < 0.03);
        assert!((value(3, "lateral lag at 1/e, degrees, far quarter") - 0.19).abs() < 0.015);
        assert_eq!(value(5, "sd of the gain over beams, median"), 0.031);
        assert_eq!(value(2, "Tire: shadow / beside"), 0.516);
    }
}
