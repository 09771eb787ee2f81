//! Which figures each group of a comparison holds.

use super::Lines;
use crate::realism::figures::{CorrelationRow, Figures, RangeProfile, Spread};
use crate::realism::fits::Law;

pub(super) fn quantiles(lines: &mut Lines<'_>) {
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

pub(super) fn patches(lines: &mut Lines<'_>) {
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
    for share in shares_of_range(lines.real) {
        let name = format!("std/mean at {:.0} % of the far range", 100.0 * share);
        if cv_at(lines.ours, share).is_none() {
            lines.apart(name, "no homogeneous patch of ours is there");
        } else {
            lines.ratio(name, &|figures| cv_at(figures, share));
        }
    }
}

/// Far range of the first group, pixels: what ranges of patches are shares of.
fn far_px(figures: &Figures) -> Option<f64> {
    figures.geometry.keys().find_map(|name| figures.group(name)).map(|(_, fan)| fan.rmax_px)
}

/// Shares of the far range in the table of cv by range.
fn shares_of_range(figures: &Figures) -> Vec<f64> {
    let rows = figures.speckle.iter().flat_map(|speckle| &speckle.cv_by_range);
    rows.filter_map(|row| Some(row.0 / far_px(figures)?)).collect()
}

/// The cv at a share of the far range, give or take a thirtieth.
fn cv_at(figures: &Figures, share: f64) -> Option<f64> {
    let row = shares_of_range(figures).iter().position(|other| (other - share).abs() < 1.0 / 30.0)?;
    Some(figures.speckle.as_ref()?.cv_by_range[row].1)
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

pub(super) fn objects(lines: &mut Lines<'_>) {
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

pub(super) fn correlation(lines: &mut Lines<'_>) {
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

pub(super) fn profile(lines: &mut Lines<'_>) {
    let fall = |figures: &Figures| {
        mean_over_groups(figures, |profile| {
            let (near, far) = (*profile.median_grey.first()?, *profile.median_grey.last()?);
            (near > 0.0).then(|| far / near)
        })
    };
    if fall(lines.ours).is_some() {
        lines.ratio("median grey, farthest / nearest bin", &fall);
    } else {
        lines.apart("median grey, farthest / nearest bin", "the nearest bin of ours is black");
    }
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

pub(super) fn ripple(lines: &mut Lines<'_>) {
    spread(lines, "sd of the gain over beams", |figures| figures.beam_gain_sd.as_ref());
}

pub(super) fn distribution(lines: &mut Lines<'_>) {
    let fits = |figures: &Figures| figures.speckle.clone().map(|speckle| speckle.fits).unwrap_or_default();
    let ours = fits(lines.ours);
    let alone: Vec<String> = fits(lines.real).into_keys().filter(|law| !ours.contains_key(law)).collect();
    for law in Law::ALL.map(Law::name) {
        lines.ratio(law, &|figures| Some(figures.speckle.as_ref()?.fits.get(law)?.median_ks));
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
