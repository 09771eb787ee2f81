//! Rows about what sends sound back: interfaces, bodies, rough surfaces. What the library refuses is answered with null.

use ensonify::math::real::{power_from_db, radians};
use ensonify::physics::lambert::{SeabedBin, lambert_mu, seabed_energy, sphere_energy};
use ensonify::physics::levels::lambert_strength_db;
use ensonify::physics::reflection::{Layer, Medium, normal_incidence, rayleigh, reflection_db};
use ensonify::physics::rigid_sphere::rigid_sphere_exact;
use ensonify::physics::statistics::{KDistribution, Rayleigh, Speckle, exceedance, median_intensity};
use ensonify::physics::target::{
    Cylinder, Plate, infinite_cylinder_db, lambert_disc_db, lambert_sphere_db, rigid_sphere_db,
};
use serde_json::{Value, json};

use crate::row::Row;

type Answer = Result<Value, String>;

fn medium(row: &Row, density: &str, speed: &str, loss: f64) -> Result<Medium, String> {
    let [density_kg_m3, sound_speed_m_s] = row.numbers([density, speed])?;
    Ok(Medium { density_kg_m3, sound_speed_m_s, loss })
}

pub fn impedance(row: &Row) -> Answer {
    // Shear waves take no part at normal incidence.
    row.no_matter(&["cS"]);
    let impedance = medium(row, "rho", "cL", 0.0)?.impedance_rayl();
    let coefficient = normal_incidence(row.number("water_Z")?, impedance);
    Ok(json!({"Z_MRayl": impedance / 1e6, "R": coefficient, "R_dB": reflection_db(coefficient)}))
}

pub fn reflection(row: &Row) -> Answer {
    if row.has("thickness_m") {
        let layer = Layer { medium: medium(row, "rho", "cL", 0.0)?, thickness_m: row.number("thickness_m")? };
        let water = row.number("water_Z")?;
        return Ok(json!(layer.reflection(row.number("f_Hz")?, water, water)));
    }
    let first = medium(row, "rho1", "c1", 0.0)?;
    let second = medium(row, "rho2", "c2", row.number("loss")?)?;
    Ok(json!(rayleigh(&first, &second, radians(row.number("grazing_deg")?))))
}

/// The shapes differ by their inputs' names.
pub fn target_strength(row: &Row) -> Answer {
    if row.has("ka") {
        return Ok(json!(rigid_sphere_exact(row.number("ka")?).value));
    }
    let incidence = if row.has("incidence_deg") { Some(radians(row.number("incidence_deg")?)) } else { None };
    if row.has("a_m") {
        let [a, b] = row.numbers(["a_m", "b_m"])?;
        let [turned_m, along_m] = match row.word("tilt_about")? {
            "b" => [a, b],
            "a" => [b, a],
            other => return Err(format!("a plate has no side `{other}`")),
        };
        let incidence = incidence.ok_or("a plate has an incidence")?;
        return Ok(json!(Plate { turned_m, along_m }.strength_db(wavelength(row)?, incidence).value));
    }
    let radius_m = row.number("radius_m")?;
    Ok(json!(if row.has("mu_dB") {
        let Ok(mu) = lambert_mu(row.number("mu_dB")?) else { return Ok(Value::Null) };
        incidence.map_or_else(|| lambert_sphere_db(mu, radius_m), |angle| lambert_disc_db(mu, radius_m, angle))
    } else if row.has("length_m") {
        let cylinder = Cylinder { radius_m, length_m: row.number("length_m")? };
        cylinder.strength_db(wavelength(row)?, incidence.unwrap_or(0.0)).value
    } else if row.has("range_m") {
        infinite_cylinder_db(radius_m, row.number("range_m")?)
    } else {
        rigid_sphere_db(radius_m)
    }))
}

fn wavelength(row: &Row) -> Result<f64, String> {
    Ok(row.number("c")? / row.number("f_Hz")?)
}

pub fn lambert(row: &Row) -> Answer {
    let [level, grazing] = row.numbers(["ten_log_mu", "grazing_deg"])?;
    let strength = lambert_mu(level).map(|_| lambert_strength_db(level, radians(grazing)));
    Ok(json!(strength.ok()))
}

/// Energies for μ = 1 (more than nature allows, as a unit) times the row's μ; α in dB/m.
pub fn ray_energy(row: &Row) -> Answer {
    let [mu, absorption] = row.numbers(["mu", "alpha"])?;
    let energy = if row.has("center_range_m") {
        let [radius, centre] = row.numbers(["radius_m", "center_range_m"])?;
        let Ok(energy) = sphere_energy(radius, centre, absorption) else { return Ok(Value::Null) };
        energy
    } else {
        let [altitude_m, near_m, far_m] = row.numbers(["altitude_m", "r1_m", "r2_m"])?;
        let azimuth_rad = radians(row.number("azimuth_width_deg")?);
        seabed_energy(&SeabedBin { altitude_m, near_m, far_m, azimuth_rad }, absorption)
    };
    Ok(json!(mu * energy))
}

/// A Rayleigh amplitude (`sigma`), a K intensity (`nu`), or Gamma-distributed speckle (`mean`, `looks`).
pub fn speckle(row: &Row) -> Answer {
    if row.has("sigma") {
        let amplitude = Rayleigh { sigma: row.number("sigma")? };
        return Ok(json!({
            "mean": amplitude.mean(),
            "variance": amplitude.variance(),
            "mean_square": amplitude.mean_square(),
            "median": amplitude.median(),
            "cov": amplitude.variation(),
        }));
    }
    let or_one = |key: &str| if row.has(key) { row.number(key) } else { Ok(1.0) };
    let [mean, looks] = [or_one("mean")?, or_one("looks")?];
    if row.has("nu") {
        let k = KDistribution { shape: row.number("nu")?, looks };
        return Ok(json!({
            "I2_over_I1sq": k.second_moment(),
            "scintillation": k.scintillation(),
            "amp_mean_over_rms": k.amplitude_mean_over_rms(),
        }));
    }
    let speckle = Speckle { mean, looks };
    let mut answer = json!({
        "variance": speckle.variance(),
        "cov": speckle.variation(),
        "skewness": speckle.skewness(),
        "excess_kurtosis": speckle.excess_kurtosis(),
        "mean_of_10log10": speckle.mean_db(),
        "std_of_10log10": speckle.deviation_db(),
    });
    if !row.has("looks") {
        answer["median"] = json!(median_intensity(mean));
        answer["p_gt_3"] = json!(exceedance(3.0, mean));
    }
    // The mean of a power in decibels, turned back, is less than the mean power.
    assert!(power_from_db(speckle.mean_db()) < mean);
    Ok(answer)
}
