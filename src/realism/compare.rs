//! Two sets of figures side by side, in seven groups.
//!
//! A distance is `ours / real − 1`, or a plain difference where the real value is near zero by its nature. What one side does
//! not have, or what means something else there, is not compared, and the line says why.

use serde::Serialize;

use super::figures::{CorrelationRow, Figures, RangeProfile, Spread};

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
    let groups: [(&'static str, fn(&mut Lines<'_>)); 7] = [
        ("quantiles of grey", quantiles),
        ("patch mean/std and its dependence on the mean", patches),
        ("object and shadow contrast", objects),
        ("lateral and range correlation", correlation),
        ("range profile", profile),
        ("beam ripple", ripple),
        ("patch distribution (median KS distance)", distribution),
    ];
    let group = |(name, fill): (&'static str, fn(&mut Lines<'_>))| {
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

fn quantiles(lines: &mut Lines<'_>) {
    for (name, label) in [
        ("0.01", "1 %"),
        ("0.05", "5 %"),
        ("0.25", "25 %"),
        ("0.5", "50 %"),
        ("0.75", "75 %"),
        ("0.95", "95 %"),
        ("0.99", "99 %"),
        ("0.999", "99.9 %"),
    ] {
        lines.ratio(label, &|figures| figures.pooled()?.pooled_quantiles.get(name).copied());
    }
    lines.ratio("mean", &|figures| Some(figures.pooled()?.pooled_mean));
    lines.ratio("sd of the median from frame to frame", &|figures| {
        figures.pooled()?.per_frame_quantile_sd.get("0.5").copied()
    });
    lines.difference("share of 0", &|figures| Some(figures.pooled()?.zero_fraction));
    lines.difference("share of 255", &|figures| Some(figures.pooled()?.saturated_255_fraction));
}

fn patches(lines: &mut Lines<'_>) {
    lines.ratio("mean/std, median", &|figures| Some(figures.speckle.as_ref()?.mean_over_std.median));
    lines.ratio("mean/std, p10", &|figures| Some(figures.speckle.as_ref()?.mean_over_std.p10));
    lines.ratio("mean/std, p90", &|figures| Some(figures.speckle.as_ref()?.mean_over_std.p90));
    lines.difference("skewness, median", &|figures| Some(figures.speckle.as_ref()?.skewness.median));
    lines.difference("slope of ln std over ln mean", &|figures| {
        Some(figures.speckle.as_ref()?.std_vs_mean.loglog_slope)
    });
    lines.difference("their correlation r", &|figures| Some(figures.speckle.as_ref()?.std_vs_mean.r));
    // The real table's means, every third and the last.
    let table = lines.real.speckle.as_ref().map(|speckle| &speckle.std_vs_mean.table_mean_std_cv_n);
    let means: Vec<f64> = table.into_iter().flatten().map(|row| row.0).collect();
    for (i, &mean) in means.iter().enumerate() {
        if i % 3 == 0 || i + 1 == means.len() {
            let name = format!("std where the mean is {mean:.0}");
            if std_at(lines.ours, mean).is_none() {
                lines.apart(name, "no patch of ours has this mean");
            } else {
                lines.ratio(name, &|figures| std_at(figures, mean));
            }
        }
    }
    let rows = |figures: &Figures| figures.speckle.as_ref().map_or(0, |speckle| speckle.cv_by_range.len());
    if rows(lines.real) == rows(lines.ours) {
        for (i, name) in [(0, "nearest"), (rows(lines.real).saturating_sub(1), "farthest")] {
            lines.ratio(format!("std/mean, {name} fifth of range"), &|figures| {
                Some(figures.speckle.as_ref()?.cv_by_range.get(i)?.1)
            });
        }
    } else {
        lines.apart("std/mean by range", "there are no homogeneous patches at some ranges");
    }
}

/// Standard deviation of patches of a mean, interpolated in the table of [`super::figures::StdVsMean`].
fn std_at(figures: &Figures, mean: f64) -> Option<f64> {
    let table = &figures.speckle.as_ref()?.std_vs_mean.table_mean_std_cv_n;
    if let Some(row) = table.iter().find(|row| row.0 == mean) {
        return Some(row.1);
    }
    table.windows(2).find(|pair| pair[0].0 <= mean && mean <= pair[1].0).map(|pair| {
        let share = (mean - pair[0].0) / (pair[1].0 - pair[0].0);
        pair[0].1 + share * (pair[1].1 - pair[0].1)
    })
}

fn objects(lines: &mut Lines<'_>) {
    spread(lines, "mean in mask / ring", |figures| Some(&figures.objects.as_ref()?.contrast_mean_object_over_ring));
    spread(lines, "95th percentile / ring", |figures| Some(&figures.objects.as_ref()?.contrast_p95_object_over_ring));
    spread(lines, "shadow / beside", |figures| figures.objects.as_ref()?.shadow_over_background.as_ref());
    lines.ratio("shadows below 0.8", &|figures| Some(figures.objects.as_ref()?.shadow_below_08));
    lines.ratio("shadows below 0.6", &|figures| Some(figures.objects.as_ref()?.shadow_below_06));
    lines.ratio("shadow's measure without object, median", &|figures| {
        Some(figures.objects.as_ref()?.shadow_control_without_object.as_ref()?.median)
    });
    let classes = |figures: &Figures| -> Vec<String> {
        figures.objects.iter().flat_map(|objects| objects.per_class.keys().cloned()).collect()
    };
    let ours = classes(lines.ours);
    let mut alone = Vec::new();
    for real in classes(lines.real) {
        let Some(ours) = ours.iter().find(|ours| ours.eq_ignore_ascii_case(&real)) else {
            alone.push(real);
            continue;
        };
        let of = |figures: &Figures| {
            let classes = &figures.objects.as_ref()?.per_class;
            classes.get(&real).or_else(|| classes.get(ours)).cloned()
        };
        lines.ratio(format!("{ours}: mean in mask / ring"), &|figures| Some(of(figures)?.contrast_mean));
        lines.ratio(format!("{ours}: shadow / beside"), &|figures| of(figures)?.shadow_ratio);
    }
    if !alone.is_empty() {
        lines.apart(alone.join(", "), "no object of ours has this label");
    }
}

/// Median and outer twentieths.
fn spread(lines: &mut Lines<'_>, name: &str, of: fn(&Figures) -> Option<&Spread>) {
    lines.ratio(format!("{name}, median"), &|figures| Some(of(figures)?.median));
    lines.ratio(format!("{name}, p05"), &|figures| Some(of(figures)?.p05));
    lines.ratio(format!("{name}, p95"), &|figures| Some(of(figures)?.p95));
}

fn correlation(lines: &mut Lines<'_>) {
    for (name, near, far) in [("near half", 0.0, 0.5), ("third quarter", 0.5, 0.75), ("far quarter", 0.75, 1.01)] {
        let mean = |value: fn(&CorrelationRow) -> Option<f64>| {
            move |figures: &Figures| mean_over_rows(figures, [near, far], value)
        };
        lines.ratio(format!("lateral lag at 1/e, beams, {name}"), &mean(|row| row.lateral_1e_beams));
        lines.ratio(format!("lateral lag at 1/e, degrees, {name}"), &mean(|row| Some(row.lateral_1e_deg)));
        lines.ratio(format!("range lag at 1/e, pixels, {name}"), &mean(|row| Some(row.range_1e_px)));
    }
}

/// Mean over rows within shares of the far range, each weighted by its patches.
fn mean_over_rows(figures: &Figures, shares: [f64; 2], value: fn(&CorrelationRow) -> Option<f64>) -> Option<f64> {
    let (mut sum, mut weight) = (0.0, 0.0);
    for (group, rows) in &figures.correlation {
        let (_, fan) = figures.group(group)?;
        for row in rows.iter().filter(|row| (shares[0]..shares[1]).contains(&(row.range_px / fan.rmax_px))) {
            sum += value(row)? * row.n as f64;
            weight += row.n as f64;
        }
    }
    (weight > 0.0).then(|| sum / weight)
}

fn profile(lines: &mut Lines<'_>) {
    lines.ratio("median grey, farthest / nearest bin", &|figures| {
        mean_over_groups(figures, |profile| {
            let (near, far) = (*profile.median_grey.first()?, *profile.median_grey.last()?);
            (near > 0.0).then(|| far / near)
        })
    });
    for (quarter, name) in ["nearest", "second", "third", "farthest"].into_iter().enumerate() {
        lines.ratio(format!("normalised median, {name} quarter"), &|figures| {
            mean_over_groups(figures, |profile| quarter_mean(&profile.normalised_median, quarter))
        });
    }
    lines.ratio("spread over frames, p90 - p10", &|figures| {
        mean_over_groups(figures, |profile| {
            let widths = profile.normalised_p90.iter().zip(&profile.normalised_p10).map(|(high, low)| high - low);
            let bins = profile.normalised_p10.len();
            (bins > 0).then(|| widths.sum::<f64>() / bins as f64)
        })
    });
}

fn quarter_mean(bins: &[f64], quarter: usize) -> Option<f64> {
    let part = &bins[quarter * bins.len() / 4..(quarter + 1) * bins.len() / 4];
    (!part.is_empty()).then(|| part.iter().sum::<f64>() / part.len() as f64)
}

/// Mean over groups, each weighted by its frames.
fn mean_over_groups(figures: &Figures, value: impl Fn(&RangeProfile) -> Option<f64>) -> Option<f64> {
    let (mut sum, mut weight) = (0.0, 0.0);
    for (group, profile) in &figures.range_profile {
        let frames = figures.group(group)?.0 as f64;
        sum += value(profile)? * frames;
        weight += frames;
    }
    (weight > 0.0).then(|| sum / weight)
}

fn ripple(lines: &mut Lines<'_>) {
    spread(lines, "sd of the gain over beams", |figures| figures.beam_gain_sd.as_ref());
}

fn distribution(lines: &mut Lines<'_>) {
    let fits = |figures: &Figures| figures.speckle.clone().map(|speckle| speckle.fits).unwrap_or_default();
    let ours = fits(lines.ours);
    let mut alone = Vec::new();
    for law in ["normal", "nakagami", "gamma", "rayleigh", "weibull", "lognormal"] {
        lines.ratio(law, &|figures| Some(figures.speckle.as_ref()?.fits.get(law)?.median_ks));
    }
    for law in fits(lines.real).into_keys().filter(|law| !ours.contains_key(law)) {
        alone.push(law);
    }
    for (law, parameter) in [("nakagami", "m"), ("gamma", "shape"), ("weibull", "shape")] {
        lines.ratio(format!("{law}, {parameter}"), &|figures| {
            figures.speckle.as_ref()?.fits.get(law)?.median_params.first().copied()
        });
    }
    lines.difference("patches wider than Rayleigh (K law)", &|figures| {
        Some(figures.speckle.as_ref()?.k_amplitude.patches_with_finite_nu)
    });
    if !alone.is_empty() && lines.ours.speckle.is_some() {
        lines.apart(alone.join(", "), "not fitted here; AIC and wins, which depend on all laws fitted, are left out");
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
