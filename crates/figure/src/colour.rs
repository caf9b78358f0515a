//! Colours, which are numbers 0xRRGGBB in sRGB, and colour maps.

/// Red, green and blue of a colour, 0 to 255.
pub(crate) fn rgb(colour: u32) -> [u8; 3] {
    let [_, rgb @ ..] = colour.to_be_bytes();
    rgb
}

pub(crate) const BLACK: u32 = 0x11_11_11;
pub(crate) const WHITE: u32 = 0xff_ff_ff;
pub(crate) const GRID: u32 = 0xe3_e3_e3;
pub(crate) const MARK: u32 = 0x55_55_55;

/// A map from the values between two limits to colours.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ColourMap {
    /// From dark blue to yellow with uniformly increasing lightness (viridis): for magnitudes.
    Sequential,
    /// From blue through white to red: for signed numbers. Zero is white.
    Diverging,
}

/// Viridis by Smith and van der Walt (CC0), eleven stations.
const SEQUENTIAL: [u32; 11] = [
    0x44_01_54, 0x48_24_75, 0x41_44_87, 0x35_5f_8d, 0x2a_78_8e, 0x21_91_8c, 0x22_a8_84, 0x44_bf_70,
    0x7a_d1_51, 0xbd_df_26, 0xfd_e7_25,
];

/// Blue to red with pure white in the middle; both ends are equally dark.
const DIVERGING: [u32; 11] = [
    0x05_30_61, 0x21_66_ac, 0x43_93_c3, 0x92_c5_de, 0xd1_e5_f0, 0xff_ff_ff, 0xfd_db_c7, 0xf4_a5_82,
    0xd6_60_4d, 0xb2_18_2b, 0x67_00_1f,
];

impl ColourMap {
    /// The colour at a fraction of the way from the lower to the upper limit; beyond the limits, the colour of the
    /// nearer end.
    pub(crate) fn at(self, fraction: f64) -> u32 {
        let stations = match self {
            Self::Sequential => &SEQUENTIAL,
            Self::Diverging => &DIVERGING,
        };
        let place = fraction.clamp(0.0, 1.0) * (stations.len() - 1) as f64;
        let lower = (place as usize).min(stations.len() - 2);
        let part = place - lower as f64;
        let [from, to] = [lower, lower + 1].map(|i| stations[i].to_be_bytes().map(f64::from));
        let mixed = |i: usize| (from[i] + part * (to[i] - from[i])).round() as u8;
        u32::from_be_bytes(std::array::from_fn(mixed))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    impl ColourMap {
        /// Relative luminance after Rec. 709: 0 is black, 1 is white.
        ///
        /// It corresponds to a print in grey.
        pub(crate) fn luminance(colour: u32) -> f64 {
            let linear = |channel: u8| {
                let x = f64::from(channel) / 255.0;
                if x <= 0.04045 {
                    x / 12.92
                } else {
                    ((x + 0.055) / 1.055).powf(2.4)
                }
            };
            let [red, green, blue] = rgb(colour).map(linear);
            0.2126 * red + 0.7152 * green + 0.0722 * blue
        }
    }

    #[test]
    fn zero_is_white_and_signs_are_told_apart() {
        assert_eq!(ColourMap::Diverging.at(0.5), WHITE);
        let [low, high] = [0.1, 0.9].map(|at| rgb(ColourMap::Diverging.at(at)));
        assert!(low[2] > low[0] && high[0] > high[2]);
        // values beyond the limits have the colours of the ends
        assert_eq!(ColourMap::Diverging.at(7.0), ColourMap::Diverging.at(1.0));
    }

    #[test]
    fn the_sequential_map_grows_lighter_all_the_way() {
        let lightness: Vec<f64> = (0..=100)
            .map(|i| ColourMap::luminance(ColourMap::Sequential.at(f64::from(i) / 100.0)))
            .collect();
        assert!(lightness.windows(2).all(|pair| pair[1] > pair[0]));
    }

    #[test]
    fn a_colour_has_three_parts() {
        assert_eq!(rgb(0x0b_53_94), [0x0b, 0x53, 0x94]);
        let [black, white] = [BLACK, WHITE].map(ColourMap::luminance);
        assert!(black < 0.01 && (white - 1.0).abs() < 1e-12);
    }
}
