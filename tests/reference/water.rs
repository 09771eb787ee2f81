//! Rows about the water: absorption, sound speed, suspended sediment.

use ensonify::physics::absorption::{ainslie_mccolm, francois_garrison, nepers_from_db, transmission};
use ensonify::physics::deepsonar::{DepthUnit, absorption_as_printed};
use ensonify::physics::seawater::{Seawater, pressure_dbar};
use ensonify::physics::sediment_load::{Carrier, SedimentLoad};
use ensonify::physics::sound_speed::{chen_millero_m_s, mackenzie_m_s, marczak_m_s, medwin_m_s};
use serde_json::{Value, json};

use crate::row::Row;

type Answer = Result<Value, String>;

/// Absorption of the row's water after a model, dB/km.
fn by_model(row: &Row, model: &str) -> Result<f64, String> {
    let (frequency, water) = (row.number("f_kHz")?, row.water()?);
    match model {
        "AM98" => Ok(ainslie_mccolm(frequency, &water).value.total()),
        "FG82" => Ok(francois_garrison(frequency, &water).value.total()),
        other => Err(format!("no absorption model `{other}`")),
    }
}

pub fn absorption(row: &Row) -> Answer {
    Ok(json!(by_model(row, row.group.trim_start_matches("absorption_"))?))
}

pub fn absorption_anchor(row: &Row) -> Answer {
    match row.unit.as_str() {
        "dB/km" => Ok(json!(by_model(row, "FG82")?)),
        "Np/m (pressure)" => Ok(json!(nepers_from_db(by_model(row, "AM98")? / 1000.0))),
        other => Err(format!("no absorption in `{other}`")),
    }
}

pub fn absorption_factor(row: &Row) -> Answer {
    let per_metre = by_model(row, row.word("model")?)? / 1000.0;
    Ok(json!(transmission(per_metre, row.number("path_m")?)))
}

pub fn deepsonar(row: &Row) -> Answer {
    let (frequency, water) = (row.number("f_kHz")?, row.water()?);
    let printed = |unit| absorption_as_printed(frequency, &water, unit).total();
    Ok(json!({
        "correct_AM98": by_model(row, "AM98")?,
        "as_printed": printed(DepthUnit::Kilometres),
        "as_printed_z_in_m": printed(DepthUnit::Metres),
    }))
}

/// The equations differ by their inputs' names: T68_C and p_bar, SP, D_m, z_m, or temperature alone.
pub fn sound_speed(row: &Row) -> Answer {
    if row.has("T68_C") {
        let [t, s, p] = row.numbers(["T68_C", "S", "p_bar"])?;
        return Ok(json!(chen_millero_m_s(t, s, p).value));
    }
    let temperature_c = row.number("T_C")?;
    let speed = if row.has("SP") {
        let [salinity_ppt, depth_m, latitude] = row.numbers(["SP", "D_m", "lat"])?;
        let from_depth = pressure_dbar(depth_m, latitude);
        let pressure_dbar = if row.has("p_dbar") { row.number("p_dbar")? } else { from_depth };
        if (pressure_dbar - from_depth).abs() > 1e-3 * pressure_dbar {
            return Err(format!("{depth_m} m is {from_depth} dbar"));
        }
        Seawater { temperature_c, salinity_ppt, pressure_dbar }.sound_speed_m_s()
    } else if row.has("D_m") {
        mackenzie_m_s(temperature_c, row.number("S")?, row.number("D_m")?)
    } else if row.has("z_m") {
        medwin_m_s(temperature_c, row.number("S")?, row.number("z_m")?)
    } else {
        marczak_m_s(temperature_c)
    };
    Ok(json!(speed.value))
}

pub fn turbidity(row: &Row) -> Answer {
    let [concentration_kg_m3, grain_radius_m, grain_density_kg_m3] = row.numbers(["M_kg_m3", "radius_m", "rho_s"])?;
    let [sound_speed_m_s, density_kg_m3, kinematic_viscosity_m2_s] = row.numbers(["c", "rho_w", "nu"])?;
    let load = SedimentLoad { concentration_kg_m3, grain_radius_m, grain_density_kg_m3 };
    let carrier = Carrier { sound_speed_m_s, density_kg_m3, kinematic_viscosity_m2_s };
    let frequency = row.number("f_Hz")?;
    let effect = load.acoustics(&carrier, frequency).value;
    Ok(json!({
        "alpha_visc_dB_m": effect.viscous_db_per_m,
        "alpha_scat_dB_m": effect.scattering_db_per_m,
        "Sv_dB": effect.volume_strength_db(),
        "ka": load.ka(&carrier, frequency),
    }))
}
