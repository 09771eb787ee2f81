//! Units, and what they measure.

use serde::Deserialize;

/// What a number is measured in.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq, PartialOrd, Ord)]
#[serde(rename_all = "kebab-case")]
pub(in crate::draft) enum Unit {
    /// 1 m.
    Metre,
    /// 0.01 m.
    Centimetre,
    /// 0.001 m.
    Millimetre,
    /// 1000 m.
    Kilometre,
    /// 0.3048 m.
    Foot,
    /// 0.0254 m.
    Inch,
    /// 0.9144 m.
    Yard,
    /// 1.8288 m.
    Fathom,
    /// 1852 m.
    NauticalMile,
    /// 1609.344 m.
    Mile,
    /// 1 m/s.
    MetrePerSecond,
    /// 1852 m in an hour.
    Knot,
    /// 1 km in an hour.
    KilometrePerHour,
    /// °C.
    Celsius,
    /// °F.
    Fahrenheit,
    /// K.
    Kelvin,
    /// 0.001 kHz.
    Hertz,
    /// kHz.
    Kilohertz,
    /// 1000 kHz.
    Megahertz,
    /// Parts per thousand.
    Ppt,
    /// 1°, of an angle or of a temperature.
    Degree,
    /// 180/π degrees.
    Radian,
    /// 0.01.
    Percent,
    /// 1 s.
    Second,
    /// 60 s.
    Minute,
}

/// What an amount is of, and so its unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::draft) enum Measure {
    /// A mere number.
    Number,
    /// A share, 0 to 1: "half", "30 %".
    Share,
    /// Metres.
    Length,
    /// Metres a second.
    Speed,
    /// Degrees Celsius.
    Temperature,
    /// Kilohertz.
    Frequency,
    /// Parts per thousand.
    Salinity,
    /// Degrees; `20 degrees` may be a temperature, too.
    Angle,
    /// Seconds.
    Time,
}

impl Unit {
    /// What it measures, and what a number of it is in the unit of that measure.
    pub(super) fn convert(self) -> (Measure, f64, f64) {
        let length = |metres| (Measure::Length, metres, 0.0);
        match self {
            Self::Metre => length(1.0),
            Self::Centimetre => length(0.01),
            Self::Millimetre => length(0.001),
            Self::Kilometre => length(1000.0),
            Self::Foot => length(0.3048),
            Self::Inch => length(0.0254),
            Self::Yard => length(0.9144),
            Self::Fathom => length(1.8288),
            Self::NauticalMile => length(1852.0),
            Self::Mile => length(1609.344),
            Self::MetrePerSecond => (Measure::Speed, 1.0, 0.0),
            Self::Knot => (Measure::Speed, 1852.0 / 3600.0, 0.0),
            Self::KilometrePerHour => (Measure::Speed, 1.0 / 3.6, 0.0),
            Self::Celsius => (Measure::Temperature, 1.0, 0.0),
            Self::Fahrenheit => (Measure::Temperature, 1.0 / 1.8, -32.0 / 1.8),
            Self::Kelvin => (Measure::Temperature, 1.0, -273.15),
            Self::Hertz => (Measure::Frequency, 0.001, 0.0),
            Self::Kilohertz => (Measure::Frequency, 1.0, 0.0),
            Self::Megahertz => (Measure::Frequency, 1000.0, 0.0),
            Self::Ppt => (Measure::Salinity, 1.0, 0.0),
            Self::Degree => (Measure::Angle, 1.0, 0.0),
            Self::Radian => (Measure::Angle, 180.0 / std::f64::consts::PI, 0.0),
            Self::Percent => (Measure::Share, 0.01, 0.0),
            Self::Second => (Measure::Time, 1.0, 0.0),
            Self::Minute => (Measure::Time, 60.0, 0.0),
        }
    }
}
