//! Rows about geometry and motion. What has no answer is answered with null.

use ensonify::math::real::{degrees, radians};
use ensonify::physics::bins::{SphereView, bin};
use ensonify::physics::geometry::{self, Obstacle, height_from_shadow_m, refraction_offset_m};
use ensonify::physics::janus::Janus;
use ensonify::physics::motion::{bearing_error_rad, change_during_ping, doppler_hz, two_way_time_s};
use serde_json::{Value, json};

use crate::row::Row;

type Answer = Result<Value, String>;

pub fn shadow(row: &Row) -> Answer {
    let [altitude_m, height_m, ground_range_m] =
        row.numbers(["altitude_m", "box_height_m", "ground_range_far_top_edge_m"])?;
    let Some(shadow) = (Obstacle { altitude_m, height_m, ground_range_m }).shadow() else { return Ok(Value::Null) };
    Ok(json!({
        "shadow_end_ground_m": shadow.end_ground_m,
        "shadow_len_ground_m": shadow.length_ground_m,
        "slant_far_top_edge_m": shadow.edge_slant_m,
        "slant_shadow_end_m": shadow.end_slant_m,
        "shadow_len_slant_m": shadow.length_slant_m,
        "h_recovered_m": height_from_shadow_m(altitude_m, shadow.length_ground_m, shadow.end_ground_m),
    }))
}

pub fn sphere_bins(row: &Row) -> Answer {
    if row.word("frame")? != "x fwd, y port(+az), z up" {
        return Err("the axes are others".to_owned());
    }
    let view = SphereView::new(row.vector("center_xyz_m")?, row.number("radius_m")?);
    let [near, far, field] = row.numbers(["r_min", "r_max", "fov_deg"])?;
    let (ranges, beams) = (row.count("n_range")?, row.count("n_beams")?);
    let Ok(view) = view else { return Ok(Value::Null) };
    let range_bin = |range| bin(range, [near, far], ranges);
    let beam = |angle| bin(angle, [-0.5 * radians(field), 0.5 * radians(field)], beams);
    Ok(json!({
        "range_center_m": view.centre_m,
        "range_first_return_m": view.first_m,
        "range_limb_m": view.limb_m,
        "range_bin_first": range_bin(view.first_m),
        "range_bin_limb": range_bin(view.limb_m),
        "azimuth_deg": degrees(view.azimuth_rad),
        "cone_angle_deg": degrees(view.cone_rad),
        "elevation_deg": degrees(view.elevation_rad),
        "half_extent_deg": degrees(view.half_extent_rad),
        "az_bin_geometric": beam(view.azimuth_rad),
        "az_bin_line_array": beam(view.cone_rad),
    }))
}

/// The mirror is the surface (depths) or the seabed (heights).
pub fn multipath(row: &Row) -> Answer {
    let (keys, angle) = if row.has("sonar_depth_m") {
        (["sonar_depth_m", "target_depth_m", "ground_range_m"], "arrival_elevation_deg")
    } else {
        (["altitude_m", "target_height_m", "ground_range_m"], "arrival_depression_deg")
    };
    let [sonar, target, ground] = row.numbers(keys)?;
    let paths = geometry::multipath(sonar, target, ground);
    Ok(json!({
        "direct_m": paths.direct_m,
        "mixed_apparent_m": paths.mixed_m,
        "double_apparent_m": paths.double_m,
        angle: degrees(paths.arrival_rad),
    }))
}

pub fn footprint(row: &Row) -> Answer {
    let [altitude, tilt, aperture] = row.numbers(["altitude_m", "tilt_down_deg", "vert_aperture_deg"])?;
    let [first, last] = geometry::footprint_m(altitude, radians(tilt), radians(aperture));
    Ok(json!({"first_seabed_slant_m": first, "last_seabed_slant_m": last}))
}

pub fn refraction(row: &Row) -> Answer {
    let [range, gradient, c] = row.numbers(["range_m", "dc_dz_per_s", "c"])?;
    Ok(json!(refraction_offset_m(range, gradient, c).value))
}

/// A ping of a moving sonar, or the bearing error of a wrong sound speed.
pub fn motion(row: &Row) -> Answer {
    if row.has("rel_c_error") {
        let [error, bearing] = row.numbers(["rel_c_error", "true_bearing_deg"])?;
        return Ok(json!(bearing_error_rad(radians(bearing), error).map(degrees)));
    }
    let [range, yaw_rate, speed, c, frequency] = row.numbers(["R_m", "yaw_rate_deg_s", "speed_m_s", "c", "f_Hz"])?;
    Ok(json!({
        "two_way_time_ms": 1000.0 * two_way_time_s(range, c),
        "yaw_during_ping_deg": change_during_ping(yaw_rate, range, c),
        "advance_m": change_during_ping(speed, range, c),
        "doppler_Hz": doppler_hz(speed, frequency, c).value,
    }))
}

pub fn janus(row: &Row) -> Answer {
    let janus = Janus::new(radians(row.number("beam_angle_deg")?)).map_err(|e| e.to_string())?;
    let beams = janus.beams(row.vector("v_sensor")?);
    let [horizontal, vertical] = janus.noise_gains();
    Ok(json!({
        "beam_velocities": beams,
        "recovered": janus.velocity(beams),
        "noise_gain_xy": horizontal,
        "noise_gain_z": vertical,
    }))
}
