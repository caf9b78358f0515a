//! Colours and the maps that turn a number into one.

/// An opaque colour in sRGB.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) struct Colour {
    /// Red, 0 to 255.
    pub(crate) red: u8,
    /// Green, 0 to 255.
    pub(crate) green: u8,
    /// Blue, 0 to 255.
    pub(crate) blue: u8,
}

impl Colour {
    /// From its hexadecimal number, such as `0x0b5394`.
    pub(crate) const fn new(hex: u32) -> Self {
        let [_, red, green, blue] = hex.to_be_bytes();
        Self { red, green, blue }
    }

    /// As SVG writes it: `#0b5394`.
    pub(crate) fn hex(self) -> String {
        format!("#{:02x}{:02x}{:02x}", self.red, self.green, self.blue)
    }

    fn between(self, other: Self, fraction: f64) -> Self {
        let mix = |a: u8, b: u8| {
            let (a, b) = (f64::from(a), f64::from(b));
            (a + fraction * (b - a)).round() as u8
        };
        Self {
            red: mix(self.red, other.red),
            green: mix(self.green, other.green),
            blue: mix(self.blue, other.blue),
        }
    }
}

pub(crate) const BLACK: Colour = Colour::new(0x11_11_11);
pub(crate) const WHITE: Colour = Colour::new(0xff_ff_ff);
pub(crate) const GRID: Colour = Colour::new(0xe3_e3_e3);
pub(crate) const MARK: Colour = Colour::new(0x55_55_55);

/// A colour for each number between two limits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ColourMap {
    /// From dark blue to yellow, evenly lighter (viridis): for magnitudes.
    Sequential,
    /// From blue through white to red: for numbers with a sign. Zero is white.
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
    /// The colour at a fraction of the way from the lower limit to the upper one; beyond them that of the end.
    pub(crate) fn at(self, fraction: f64) -> Colour {
        let stations = match self {
            Self::Sequential => &SEQUENTIAL,
            Self::Diverging => &DIVERGING,
        };
        let place = fraction.clamp(0.0, 1.0) * (stations.len() - 1) as f64;
        let lower = (place as usize).min(stations.len() - 2);
        let [from, to] = [stations[lower], stations[lower + 1]].map(Colour::new);
        from.between(to, place - lower as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    impl Colour {
        /// Relative luminance after Rec. 709: 0 is black, 1 is white.
        ///
        /// It is what a print in grey shows.
        pub(crate) fn luminance(self) -> f64 {
            let linear = |channel: u8| {
                let x = f64::from(channel) / 255.0;
                if x <= 0.04045 {
                    x / 12.92
                } else {
                    ((x + 0.055) / 1.055).powf(2.4)
                }
            };
            0.2126 * linear(self.red) + 0.7152 * linear(self.green) + 0.0722 * linear(self.blue)
        }
    }

    #[test]
    fn zero_is_white_and_signs_are_told_apart() {
        assert_eq!(ColourMap::Diverging.at(0.5), WHITE);
        let (low, high) = (ColourMap::Diverging.at(0.1), ColourMap::Diverging.at(0.9));
        assert!(low.blue > low.red && high.red > high.blue);
        // beyond the limits the ends go on
        assert_eq!(ColourMap::Diverging.at(7.0), ColourMap::Diverging.at(1.0));
    }

    #[test]
    fn the_sequential_map_grows_lighter_all_the_way() {
        let lightness: Vec<f64> = (0..=100)
            .map(|i| ColourMap::Sequential.at(f64::from(i) / 100.0).luminance())
            .collect();
        assert!(lightness.windows(2).all(|pair| pair[1] > pair[0]));
    }

    #[test]
    fn colours_are_written_in_hexadecimal() {
        assert_eq!(Colour::new(0x0b_53_94).hex(), "#0b5394");
        assert!(BLACK.luminance() < 0.01 && (WHITE.luminance() - 1.0).abs() < 1e-12);
    }
}
