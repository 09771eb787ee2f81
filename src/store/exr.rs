//! Raw echoes as OpenEXR: linear values without noise, one channel each, uncompressed.

use std::io::Cursor;

use exr::prelude::{
    AnyChannel, AnyChannels, Blocks, Compression, Encoding, FlatSamples, Image, LineOrder, SmallVec, Vec2,
    WritableImage as _,
};

/// What a raw file holds: planes in the orientation of the polar image, `width · height` values each, row by row.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RawImage {
    /// Pixels across: beams.
    pub width: u32,
    /// Pixels down: range bins.
    pub height: u32,
    /// Echo energy, 1/m² (see [`Echoes::energy`](crate::sonar::Echoes::energy)).
    pub intensity: Vec<f32>,
    /// Mean-square pressure at the receiver before gain, µPa², echoes and reverberation alone: `10·log10` of it is a level in
    /// dB re 1 µPa. None from image models that know no pressure.
    pub echo: Option<Vec<f32>>,
    /// The same with the receiver's noise, as the image shows it.
    pub received: Option<Vec<f32>>,
    /// Mean elevation angle, radians.
    pub elevation: Vec<f32>,
    /// Mean angle of incidence, radians.
    pub incidence: Vec<f32>,
    /// Number of the dominant body, 0 where there is none.
    pub instance: Vec<u32>,
    /// Number of the strongest material, from 1; 0 where nothing echoes.
    pub material: Vec<u32>,
}

/// The bytes of an EXR file with the channels `elevation`, `incidence`, `instance`, `intensity`, `material` and, where there
/// are any, `echo` and `received`.
///
/// # Panics
/// If a plane has another length than `width · height`, or none at all.
#[must_use]
pub fn encode(raw: RawImage) -> Vec<u8> {
    let pixels = raw.width as usize * raw.height as usize;
    let planes = [
        ("elevation", FlatSamples::F32(raw.elevation)),
        ("incidence", FlatSamples::F32(raw.incidence)),
        ("instance", FlatSamples::U32(raw.instance)),
        ("intensity", FlatSamples::F32(raw.intensity)),
        ("material", FlatSamples::U32(raw.material)),
    ];
    let levels = [("echo", raw.echo), ("received", raw.received)];
    let levels = levels.into_iter().filter_map(|(name, plane)| Some((name, FlatSamples::F32(plane?))));
    let channels: SmallVec<[AnyChannel<FlatSamples>; 4]> = planes
        .into_iter()
        .chain(levels)
        .map(|(name, samples)| {
            assert_eq!(samples.len(), pixels, "plane {name} has the size of the image");
            AnyChannel::new(name, samples)
        })
        .collect();
    let encoding = Encoding {
        compression: Compression::Uncompressed,
        blocks: Blocks::ScanLines,
        line_order: LineOrder::Increasing,
    };
    let size = Vec2(raw.width as usize, raw.height as usize);
    let image = Image::from_encoded_channels(size, encoding, AnyChannels::sort(channels));
    let mut bytes = Cursor::new(Vec::with_capacity(pixels * 28 + raw.height as usize * 16 + 1024));
    image
        .write()
        .non_parallel()
        .to_buffered(&mut bytes)
        .expect("writing to memory fails only for sizes that the caller must not give");
    bytes.into_inner()
}

#[cfg(test)]
mod tests {
    use exr::prelude::read_first_flat_layer_from_file;

    use super::*;

    #[test]
    fn planes_come_back_as_they_were() {
        let plane = |scale: f32| (0..35u8).map(|i| f32::from(i) * scale).collect::<Vec<_>>();
        let raw = RawImage {
            width: 5,
            height: 7,
            intensity: plane(1e-7),
            echo: Some(plane(1e6)),
            received: None,
            elevation: plane(-0.01),
            incidence: plane(0.04),
            instance: (0..35).map(|i| i * 2000).collect(),
            material: (0..35).rev().collect(),
        };
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("raw.exr");
        let bytes = encode(raw.clone());
        assert_eq!(bytes, encode(raw.clone()));
        std::fs::write(&path, bytes).unwrap();
        let image = read_first_flat_layer_from_file(&path).unwrap();
        assert_eq!(image.layer_data.size, Vec2(5, 7));
        let channels: Vec<_> =
            image.layer_data.channel_data.list.into_iter().map(|c| (c.name.to_string(), c.sample_data)).collect();
        assert_eq!(
            channels,
            [
                ("echo".to_owned(), FlatSamples::F32(raw.echo.unwrap())),
                ("elevation".to_owned(), FlatSamples::F32(raw.elevation)),
                ("incidence".to_owned(), FlatSamples::F32(raw.incidence)),
                ("instance".to_owned(), FlatSamples::U32(raw.instance)),
                ("intensity".to_owned(), FlatSamples::F32(raw.intensity)),
                ("material".to_owned(), FlatSamples::U32(raw.material)),
            ]
        );
    }
}
