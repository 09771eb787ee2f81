//! Rows about the receiver: beams, pulses, noise, gain, levels.

use ensonify::math::real::{degrees, radians};
use ensonify::physics::array::{LineArray, aperture_width_rad, far_field_m, max_spacing_wavelengths};
use ensonify::physics::levels::{band_level_db, lambert_strength_db, thermal_noise_db, time_varied_gain_db};
use ensonify::physics::noise::wind_noise_db;
use ensonify::physics::response::{
    PulseWindow, half_power_resolution_m, ping_rate_hz, pulse_resolution_m, tone_resolution_m,
};
use ensonify::physics::shading::Shading;
use ensonify::physics::sonar_equation::{
    Levels, seabed_cell_area_m2, seabed_grazing_rad, seabed_strength_db, transmission_loss_db,
};
use serde_json::{Value, json};

use crate::row::Row;

type Answer = Result<Value, String>;

/// `uniform`, `hann`, `hamming`, `cheb40` (side lobes in dB) or `taylor30_nbar5`.
fn shading(name: &str) -> Result<Shading, String> {
    let unknown = || format!("no shading `{name}`");
    let figure = |text: &str| text.parse::<f64>().map_err(|_| unknown());
    match name {
        "uniform" => Ok(Shading::Uniform),
        "hann" => Ok(Shading::Hann),
        "hamming" => Ok(Shading::Hamming),
        _ => {
            if let Some(level) = name.strip_prefix("cheb") {
                return Ok(Shading::Chebyshev { side_lobe_db: figure(level)? });
            }
            let (level, near) =
                name.strip_prefix("taylor").and_then(|rest| rest.split_once("_nbar")).ok_or_else(unknown)?;
            Ok(Shading::Taylor { side_lobe_db: figure(level)?, near: near.parse().map_err(|_| unknown())? })
        }
    }
}

pub fn beam_width(row: &Row) -> Answer {
    let (elements, spacing) = (row.count("N")?, row.number("d_over_lambda")?);
    let steering = radians(row.number("steer_deg")?);
    let array = |shading: &Shading| LineArray::new(elements, spacing, shading).map_err(|error| error.to_string());
    let [shaded, uniform] = [array(&shading(row.word("shading")?)?)?, array(&Shading::Uniform)?];
    let [width, unshaded] = [&shaded, &uniform].map(|array| array.beam_width_rad(steering));
    if !row.expected.is_object() {
        return Ok(json!(width.map(degrees)));
    }
    Ok(json!({
        "bw_deg": width.map(degrees),
        "psl_dB": shaded.peak_side_lobe_db(),
        "broadening": width.zip(unshaded).map(|(shaded, uniform)| shaded / uniform),
        "snr_loss_dB": shaded.shading_loss_db(),
    }))
}

pub fn array(row: &Row) -> Answer {
    if row.has("fov_deg") {
        return Ok(json!(max_spacing_wavelengths(0.5 * radians(row.number("fov_deg")?))));
    }
    let [aperture, frequency, c] = row.numbers(["L_m", "f_Hz", "c"])?;
    let wavelength = c / frequency;
    Ok(json!({
        "lambda_mm": 1000.0 * wavelength,
        "L2_over_lambda_m": far_field_m(aperture, wavelength),
        "bw_deg": degrees(aperture_width_rad(wavelength, aperture)),
    }))
}

pub fn range_resolution(row: &Row) -> Answer {
    let [c, duration, bandwidth] = row.numbers(["c", "tau_s", "B_Hz"])?;
    Ok(json!({
        "cw_m": tone_resolution_m(c, duration),
        "chirp_rayleigh_m": pulse_resolution_m(c, bandwidth),
        "chirp_3dB_m": half_power_resolution_m(c, bandwidth, PulseWindow::Uniform),
        "chirp_hamming_3dB_m": half_power_resolution_m(c, bandwidth, PulseWindow::Hamming),
    }))
}

pub fn ping_rate(row: &Row) -> Answer {
    let [range, c] = row.numbers(["R_m", "c"])?;
    Ok(json!(ping_rate_hz(c, range)))
}

pub fn noise(row: &Row) -> Answer {
    let [frequency_khz, bandwidth] = row.numbers(["f_kHz", "B_Hz"])?;
    let thermal = thermal_noise_db(frequency_khz);
    Ok(json!({
        "NL_spec": thermal,
        "NL_band": band_level_db(thermal, bandwidth),
        "wind10_spec": wind_noise_db(frequency_khz, 10.0).value,
    }))
}

pub fn time_varied_gain(row: &Row) -> Answer {
    let absorption = row.water()?.absorption_db_per_m(row.number("f_kHz")?);
    let range = row.number("R_m")?;
    let gain = |per_decade| time_varied_gain_db(per_decade, absorption, range);
    Ok(json!({"tvg20_dB": gain(20.0), "tvg30_dB": gain(30.0), "tvg40_dB": gain(40.0)}))
}

pub fn sonar_equation(row: &Row) -> Answer {
    let absorption = row.water()?.absorption_db_per_m(row.number("f_Hz")? / 1000.0);
    let [c, altitude, slant, beam, bandwidth_hz] = row.numbers(["c", "altitude_m", "slant_m", "beam_deg", "B_Hz"])?;
    let grazing = seabed_grazing_rad(altitude, slant).ok_or("the seabed is farther than the slant range")?;
    let area = seabed_cell_area_m2(slant, radians(beam), pulse_resolution_m(c, bandwidth_hz), grazing);
    let backscatter = lambert_strength_db(row.number("ten_log_mu")?, grazing);
    let sonar = Levels {
        source_db: row.number("SL_dB")?,
        noise_db: 0.0,
        directivity_db: 0.0,
        bandwidth_hz,
        processing_db: 0.0,
    };
    let loss = transmission_loss_db(slant, absorption);
    Ok(json!({
        "alpha_dB_per_m": absorption,
        "grazing_deg": degrees(grazing),
        "area_m2": area,
        "Sb_dB": backscatter,
        "RL_dB": sonar.echo_db(loss, seabed_strength_db(backscatter, area)),
    }))
}
