//! How fast sound travels in water: the equations in use, each with the range that its source states.
//!
//! Knows nothing of profiles: a body of water is alike everywhere. `seawater` has the equation of state of TEOS-10.

use super::numeric::polynomial;
use super::stated::Stated;

/// Sound speed after Mackenzie, m/s: the ocean's nine-term equation.
///
/// Temperature °C (−2–30), salinity ppt (30–40), depth m (0–8000); standard error 0.07 m/s.
/// Source: Mackenzie (1981), J. Acoust. Soc. Am. 70:807–812.
pub fn mackenzie_m_s(temperature_c: f64, salinity_ppt: f64, depth_m: f64) -> Stated<f64> {
    let (t, s, d) = (temperature_c, salinity_ppt - 35.0, depth_m);
    let at_surface = polynomial(&[1448.96, 4.591, -5.304e-2, 2.374e-4], t) + 1.340 * s - 1.025e-2 * t * s;
    let value = at_surface + 1.630e-2 * d + 1.675e-7 * d * d - 7.139e-13 * t * d * d * d;
    Stated::new(value, &limits(temperature_c, (-2.0, 30.0), salinity_ppt, (30.0, 40.0), depth_m, 8000.0))
}

/// Sound speed after Medwin, m/s: a short equation for realistic mixtures in shallow water.
///
/// Temperature °C (0–35), salinity ppt (0–45), depth m (0–1000); within some 0.2 m/s.
/// Source: Medwin (1975), J. Acoust. Soc. Am. 58:1318–1319.
pub fn medwin_m_s(temperature_c: f64, salinity_ppt: f64, depth_m: f64) -> Stated<f64> {
    let t = temperature_c;
    let value =
        polynomial(&[1449.2, 4.6, -0.055, 0.000_29], t) + (1.34 - 0.010 * t) * (salinity_ppt - 35.0) + 0.016 * depth_m;
    Stated::new(value, &limits(temperature_c, (0.0, 35.0), salinity_ppt, (0.0, 45.0), depth_m, 1000.0))
}

/// Sound speed in pure water at 1 atm after Marczak, m/s; temperature °C (0–95), standard error 0.02 m/s.
///
/// Source: Marczak (1997), J. Acoust. Soc. Am. 102:2776–2779.
pub fn marczak_m_s(temperature_c: f64) -> Stated<f64> {
    let value =
        polynomial(&[1.402_385e3, 5.038_813, -5.799_136e-2, 3.287_156e-4, -1.398_845e-6, 2.787_860e-9], temperature_c);
    Stated::new(value, &[("temperature, °C", temperature_c, 0.0, 95.0)])
}

/// Sound speed after Chen & Millero, m/s: the UNESCO standard before TEOS-10.
///
/// Temperature °C on the scale of 1968 (0–40; T68 = 1.00024·T90), salinity ppt (0–40), gauge pressure bar (0–1000).
/// Source: Chen & Millero (1977), J. Acoust. Soc. Am. 62:1129–1135, as in Fofonoff & Millard (1983), UNESCO Technical
/// Papers in Marine Science 44, eqs. 33–38.
pub fn chen_millero_m_s(temperature_68_c: f64, salinity_ppt: f64, pressure_bar: f64) -> Stated<f64> {
    let (t, s, p) = (temperature_68_c, salinity_ppt, pressure_bar);
    let table = |rows: &[&[f64]]| rows.iter().rev().fold(0.0, |sum, row| sum * p + polynomial(row, t));
    let pure = table(&[
        &[1402.388, 5.03711, -5.808_52e-2, 3.3420e-4, -1.478_00e-6, 3.1464e-9],
        &[0.153_563, 6.8982e-4, -8.1788e-6, 1.3621e-7, -6.1185e-10],
        &[3.1260e-5, -1.7107e-6, 2.5974e-8, -2.5335e-10, 1.0405e-12],
        &[-9.7729e-9, 3.8504e-10, -2.3643e-12],
    ]);
    let salt = table(&[
        &[1.389, -1.262e-2, 7.164e-5, 2.006e-6, -3.21e-8],
        &[9.4742e-5, -1.2580e-5, -6.4885e-8, 1.0507e-8, -2.0122e-10],
        &[-3.9064e-7, 9.1041e-9, -1.6002e-10, 7.988e-12],
        &[1.100e-10, 6.649e-12, -3.389e-13],
    ]);
    let salt_3_2 = table(&[&[-1.922e-2, -4.42e-5], &[7.3637e-5, 1.7945e-7]]);
    let salt_2 = 1.727e-3 - 7.9836e-6 * p;
    let value = pure + (salt + salt_3_2 * s.sqrt() + salt_2 * s) * s;
    let limits =
        [("temperature, °C", t, 0.0, 40.0), ("salinity, ppt", s, 0.0, 40.0), ("pressure, bar", p, 0.0, 1000.0)];
    Stated::new(value, &limits)
}

/// Temperature on the scale of 1968, °C, of one on the scale of 1990.
///
/// Source: Saunders (1990), WOCE Newsletter 10.
#[must_use]
pub fn temperature_68_c(temperature_c: f64) -> f64 {
    1.000_24 * temperature_c
}

type Limit = (&'static str, f64, f64, f64);

fn limits(t: f64, t_range: (f64, f64), s: f64, s_range: (f64, f64), depth_m: f64, deepest_m: f64) -> [Limit; 3] {
    [
        ("temperature, °C", t, t_range.0, t_range.1),
        ("salinity, ppt", s, s_range.0, s_range.1),
        ("depth, m", depth_m, 0.0, deepest_m),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn check_values_of_the_sources() {
        assert!((mackenzie_m_s(25.0, 35.0, 1000.0).value - 1550.744).abs() < 1e-3);
        assert!((chen_millero_m_s(40.0, 40.0, 1000.0).value - 1731.995).abs() < 1e-3);
        assert!((marczak_m_s(20.0).value - 1482.38).abs() < 1e-2);
    }

    #[test]
    fn the_equations_agree_where_their_ranges_meet() {
        let (t, s, d) = (15.0, 35.0, 10.0);
        let unesco = chen_millero_m_s(temperature_68_c(t), s, 1.0).value;
        for other in [mackenzie_m_s(t, s, d), medwin_m_s(t, s, d)] {
            assert!(other.is_within());
            assert!((other.value - unesco).abs() < 0.25, "{} {unesco}", other.value);
        }
        assert!((chen_millero_m_s(15.0, 0.0, 0.0).value - marczak_m_s(15.0).value).abs() < 0.03);
    }

    #[test]
    fn fresh_water_is_outside_of_mackenzie_and_says_so() {
        let fresh = mackenzie_m_s(15.0, 0.0, 0.0);
        assert_eq!(fresh.outside[0].quantity, "salinity, ppt");
        assert!(!medwin_m_s(15.0, 35.0, 2000.0).is_within());
        assert!(!marczak_m_s(-1.0).is_within());
    }
}
