//! The thermodynamic equation of sea water (TEOS-10): sound speed, density, and the viscosity that goes with them.
//!
//! The Gibbs function g(S, T, p) is a table of coefficients of `x^i·y^j·z^k`; what a sonar needs are its derivatives. Terms
//! whose derivatives all vanish (k = 0 with j < 2, and the logarithm of salinity) are left out.

use super::numeric::polynomial;
use super::stated::Stated;
use crate::math::real::{radians, sin};

/// A state of sea water.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seawater {
    /// Temperature in place, °C (1990 scale).
    pub temperature_c: f64,
    /// Practical salinity, ppt.
    pub salinity_ppt: f64,
    /// Pressure above the atmosphere's, dbar.
    pub pressure_dbar: f64,
}

impl Seawater {
    /// Speed of sound, m/s: `c = g_p·√(g_tt / (g_tp² − g_tt·g_pp))`. Temperature −6–40 °C, salinity 0–42 ppt, 0–10 000 dbar.
    ///
    /// Source: IOC, SCOR & IAPSO (2010), TEOS-10 manual, eq. 2.17.1; coefficients IAPWS R13-08 and SR7-09 (Feistel 2003, 2008).
    pub fn sound_speed_m_s(&self) -> Stated<f64> {
        let g_p = self.derivative(0, 1);
        let (g_tt, g_tp, g_pp) = (self.derivative(2, 0), self.derivative(1, 1), self.derivative(0, 2));
        self.stated(g_p * (g_tt / (g_tp * g_tp - g_tt * g_pp)).sqrt())
    }

    /// Density, kg/m³: `1 / g_p`. Range and source as [`Self::sound_speed_m_s`], eq. 2.8.1.
    pub fn density_kg_m3(&self) -> Stated<f64> {
        self.stated(1.0 / self.derivative(0, 1))
    }

    /// Kinematic viscosity, m²/s, at 1 atm: temperature 0–180 °C, salinity 0–150 g/kg, within 1.5 %. Pressure changes it by
    /// some per cent at full ocean depth and is left out.
    ///
    /// Source: Sharqawy, Lienhard & Zubair (2010), Desalination and Water Treatment 16:354–380, eqs. 22–23.
    pub fn kinematic_viscosity_m2_s(&self) -> Stated<f64> {
        let (t, s) = (self.temperature_c, self.absolute_salinity_g_kg() / 1000.0);
        let pure = 4.2844e-5 + 1.0 / (0.157 * (t + 64.993) * (t + 64.993) - 91.296);
        let a = polynomial(&[1.541, 1.998e-2, -9.52e-5], t);
        let b = polynomial(&[7.974, -7.561e-2, 4.724e-4], t);
        let surface = Self { pressure_dbar: 0.0, ..*self };
        let value = pure * (1.0 + a * s + b * s * s) / surface.density_kg_m3().value;
        Stated::new(value, &[("temperature, °C", t, 0.0, 180.0), ("salinity, g/kg", 1000.0 * s, 0.0, 150.0)])
    }

    /// Mass of salt, g/kg, in water of the reference composition. Source: Millero et al. (2008), Deep-Sea Res. I 55:50–72.
    fn absolute_salinity_g_kg(&self) -> f64 {
        self.salinity_ppt * 35.165_04 / 35.0
    }

    /// ∂^(j+k) g / ∂T^j ∂p^k in SI units, at least one of them a derivative that the tables keep: (0,1), (2,0), (1,1) or (0,2).
    fn derivative(&self, by_t: usize, by_p: usize) -> f64 {
        let x = powers((self.absolute_salinity_g_kg() / SALINITY_UNIT_G_KG).sqrt());
        let (y, z) = (powers(self.temperature_c / 40.0), powers(self.pressure_dbar / 1e4));
        let sum: f64 = TERMS
            .iter()
            .filter(|&&(_, j, k, _)| j >= by_t && k >= by_p)
            .map(|&(i, j, k, g)| g * falling(j, by_t) * falling(k, by_p) * x[i] * y[j - by_t] * z[k - by_p])
            .sum();
        (0..by_p).fold((0..by_t).fold(sum, |sum, _| sum / 40.0), |sum, _| sum / 1e8)
    }

    fn stated(&self, value: f64) -> Stated<f64> {
        Stated::new(
            value,
            &[
                ("temperature, °C", self.temperature_c, -6.0, 40.0),
                ("salinity, ppt", self.salinity_ppt, 0.0, 42.0),
                ("pressure, dbar", self.pressure_dbar, 0.0, 10_000.0),
            ],
        )
    }
}

/// Pressure above the atmosphere's, dbar, at a depth in m and a latitude in degrees; within 0.1 % of a standard ocean.
///
/// Source: Saunders (1981), J. Phys. Oceanogr. 11:573–574.
#[must_use]
pub fn pressure_dbar(depth_m: f64, latitude_deg: f64) -> f64 {
    let sine = sin(radians(latitude_deg));
    let c1 = (5.92 + 5.25 * sine * sine) * 1e-3;
    let c2 = 2.21e-6;
    let linear = 1.0 - c1;
    // The quadratic's smaller root, in the form that loses no digits near the surface.
    2.0 * depth_m / (linear + (linear * linear - 4.0 * c2 * depth_m).sqrt())
}

/// 1, v, v², … v⁷.
fn powers(v: f64) -> [f64; 8] {
    let mut powers = [1.0; 8];
    for i in 1..8 {
        powers[i] = powers[i - 1] * v;
    }
    powers
}

/// `n·(n − 1)·…`, `times` factors: what deriving xⁿ leaves in front.
fn falling(n: usize, times: usize) -> f64 {
    (0..times).map(|i| (n - i) as f64).product()
}

/// Absolute salinity at x = 1: 40 · 35.16504/35.
const SALINITY_UNIT_G_KG: f64 = 40.0 * 35.165_04 / 35.0;

/// (i, j, k, g): `g·x^i·y^j·z^k` in J/kg, x = √(S/40.19 g/kg), y = T/40 °C, z = p/100 MPa. First pure water, then salt.
#[rustfmt::skip]
const TERMS: &[(usize, usize, usize, f64)] = &[
    (0, 0, 1, 100_015.695_367_145), (0, 0, 2, -2_544.576_542_036_3), (0, 0, 3, 284.517_778_446_287),
    (0, 0, 4, -33.314_675_425_361_1), (0, 0, 5, 4.202_631_088_030_84), (0, 0, 6, -0.546_428_511_471_039),
    (0, 1, 1, -270.983_805_184_062), (0, 1, 2, 776.153_611_613_101), (0, 1, 3, -196.512_550_881_22),
    (0, 1, 4, 28.979_652_629_417_5), (0, 1, 5, -2.132_900_835_183_27), (0, 2, 0, -12_357.785_933_039),
    (0, 2, 1, 1_455.036_454_046_8), (0, 2, 2, -756.558_385_769_359), (0, 2, 3, 273.479_662_323_528),
    (0, 2, 4, -55.560_406_381_721_8), (0, 2, 5, 4.344_206_719_171_97), (0, 3, 0, 736.741_204_151_612),
    (0, 3, 1, -672.507_783_145_07), (0, 3, 2, 499.360_390_819_152), (0, 3, 3, -239.545_330_654_412),
    (0, 3, 4, 48.801_251_859_387_2), (0, 3, 5, -1.663_071_062_089_05), (0, 4, 0, -148.185_936_433_658),
    (0, 4, 1, 397.968_445_406_972), (0, 4, 2, -301.815_380_621_876), (0, 4, 3, 152.196_371_733_841),
    (0, 4, 4, -26.374_837_723_280_2), (0, 5, 0, 58.025_912_584_257_1), (0, 5, 1, -194.618_310_617_595),
    (0, 5, 2, 120.520_654_902_025), (0, 5, 3, -55.272_305_234_015_2), (0, 5, 4, 6.481_906_680_772_21),
    (0, 6, 0, -18.984_384_651_417_2), (0, 6, 1, 63.511_393_664_178_5), (0, 6, 2, -22.289_731_714_045_9),
    (0, 6, 3, 8.170_605_418_181_12), (0, 7, 0, 3.050_816_464_879_67), (0, 7, 1, -9.631_081_193_930_62),
    (2, 0, 1, -3_310.491_540_448_39), (2, 0, 2, 384.794_152_978_599), (2, 0, 3, -96.532_432_010_745_8),
    (2, 0, 4, 15.840_817_276_682_4), (2, 0, 5, -2.624_801_565_909_92), (2, 1, 1, 729.116_529_735_046),
    (2, 1, 2, -343.956_902_961_561), (2, 1, 3, 124.687_671_116_248), (2, 1, 4, -31.656_964_386_073),
    (2, 1, 5, 7.046_588_033_154_49), (2, 2, 0, 880.031_352_997_204), (2, 2, 1, -860.764_303_783_977),
    (2, 2, 2, 337.409_530_269_367), (2, 2, 3, -178.314_556_207_638), (2, 2, 4, 44.204_035_830_8),
    (2, 2, 5, -7.920_015_472_116_82), (2, 3, 0, -225.267_649_263_401), (2, 3, 1, 694.244_814_133_268),
    (2, 3, 2, -204.889_641_964_903), (2, 3, 3, 113.561_697_840_594), (2, 3, 4, -11.128_273_432_641_3),
    (2, 4, 0, 91.426_044_775_125_9), (2, 4, 1, -297.728_741_987_187), (2, 4, 2, 74.726_141_138_756),
    (2, 4, 3, -36.487_291_900_158_8), (2, 5, 0, -21.660_324_087_531_1), (2, 6, 0, 2.130_169_708_471_83),
    (3, 0, 1, 199.459_603_073_901), (3, 0, 2, -52.294_090_928_133_5), (3, 0, 3, 68.044_494_272_645_9),
    (3, 0, 4, -3.412_519_324_412_82), (3, 1, 1, -175.292_041_186_547), (3, 1, 2, 83.192_392_780_181_9),
    (3, 1, 3, -29.483_064_349_429), (3, 2, 0, -43.066_467_597_804_2), (3, 2, 1, 383.058_066_002_476),
    (3, 2, 2, -54.191_726_251_711_2), (3, 2, 3, 25.639_848_738_991_4), (3, 3, 0, -10.022_737_086_187_5),
    (3, 3, 1, -460.319_931_801_257), (3, 4, 0, 0.875_600_661_808_945), (3, 4, 1, 234.565_187_611_355),
    (4, 0, 1, -54.791_913_353_288_7), (4, 0, 2, -4.081_939_789_122_61), (4, 0, 3, -30.175_511_197_116_1),
    (4, 1, 1, -22.668_355_851_282_9), (4, 2, 0, -68.557_250_920_449_1), (4, 3, 0, 49.366_769_485_625_4),
    (4, 4, 0, -17.139_757_741_978_8), (4, 5, 0, 2.496_970_095_695_08), (5, 0, 1, 36.028_419_561_108_6),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_of_the_gibbs_seawater_toolbox() {
        let speed = |temperature_c, salinity_ppt, pressure_dbar| {
            Seawater { temperature_c, salinity_ppt, pressure_dbar }.sound_speed_m_s().value
        };
        assert!((speed(0.0, 35.0, 0.0) - 1449.025).abs() < 1e-3);
        assert!((speed(15.0, 38.0, 20.1646) - 1510.524).abs() < 1e-3);
        assert!((speed(4.0, 34.7, 2026.13) - 1499.388).abs() < 1e-3);
    }

    #[test]
    fn density_and_viscosity_of_standard_water() {
        let sea = Seawater { temperature_c: 0.0, salinity_ppt: 35.0, pressure_dbar: 0.0 };
        assert!((sea.density_kg_m3().value - 1028.107).abs() < 1e-3);
        let fresh = Seawater { temperature_c: 20.0, salinity_ppt: 0.0, pressure_dbar: 0.0 };
        assert!((fresh.density_kg_m3().value - 998.207).abs() < 2e-3);
        assert!((fresh.kinematic_viscosity_m2_s().value / 1.0034e-6 - 1.0).abs() < 5e-3);
    }

    #[test]
    fn pressure_follows_depth() {
        // Saunders' check value: 7500 dbar at 30° is 7321.45 m.
        assert!((pressure_dbar(7321.45, 30.0) - 7500.0).abs() < 0.5);
        assert!((pressure_dbar(50.0, 45.0) - 50.4153).abs() < 0.03);
        assert_eq!(pressure_dbar(0.0, 45.0), 0.0);
    }

    #[test]
    fn brine_is_outside() {
        assert!(
            !Seawater { temperature_c: 20.0, salinity_ppt: 44.0, pressure_dbar: 0.0 }.sound_speed_m_s().is_within()
        );
    }
}
