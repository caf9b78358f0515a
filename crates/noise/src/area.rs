//! Where impacts fall: discs, rings and strips on the surface, and the part of a circle that lies in them.

use std::f64::consts::{PI, TAU};

/// An area of the surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Area {
    /// A disc, or a ring around a disc without impacts.
    Disc {
        /// Centre in m.
        centre_m: [f64; 2],
        /// Radius in m.
        radius_m: f64,
        /// Inner radius of a ring in m; 0 for a disc.
        inner_radius_m: f64,
    },
    /// A rectangle, such as a river.
    Strip {
        /// Centre in m.
        centre_m: [f64; 2],
        /// Length in m.
        length_m: f64,
        /// Width in m.
        width_m: f64,
        /// Angle from the x axis to the length, in rad.
        azimuth: f64,
    },
}

impl Area {
    /// Its size in m^2.
    pub fn size_m2(&self) -> f64 {
        match *self {
            Self::Disc {
                radius_m,
                inner_radius_m,
                ..
            } => PI * (radius_m.powi(2) - inner_radius_m.powi(2)),
            Self::Strip {
                length_m, width_m, ..
            } => length_m * width_m,
        }
    }

    /// A place with the frame of the area: its centre is zero, the length of a strip is the first axis.
    fn inside(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let ([cx, cy], azimuth) = match *self {
            Self::Disc { centre_m, .. } => (centre_m, 0.0),
            Self::Strip {
                centre_m, azimuth, ..
            } => (centre_m, azimuth),
        };
        let ((sin, cos), [x, y]) = (f64::sin_cos(azimuth), [x - cx, y - cy]);
        [x * cos + y * sin, y * cos - x * sin]
    }

    /// Whether a place in the frame of the area lies in it.
    fn holds(&self, [x, y]: [f64; 2]) -> bool {
        match *self {
            Self::Disc {
                radius_m,
                inner_radius_m,
                ..
            } => {
                let distance = x.hypot(y);
                distance <= radius_m && distance >= inner_radius_m
            }
            Self::Strip {
                length_m, width_m, ..
            } => x.abs() <= 0.5 * length_m && y.abs() <= 0.5 * width_m,
        }
    }

    /// A place in m, uniform over the area for uniform numbers in [0, 1).
    pub(crate) fn place_m(&self, [u, v]: [f64; 2]) -> [f64; 2] {
        match *self {
            Self::Disc {
                centre_m: [x, y],
                radius_m,
                inner_radius_m,
            } => {
                let [low, high] = [inner_radius_m, radius_m].map(|r| r * r);
                let (r, (sin, cos)) = ((low + u * (high - low)).sqrt(), f64::sin_cos(TAU * v));
                [x + r * cos, y + r * sin]
            }
            Self::Strip {
                centre_m: [x, y],
                length_m,
                width_m,
                azimuth,
            } => {
                let (along, across) = ((u - 0.5) * length_m, (v - 0.5) * width_m);
                let (sin, cos) = f64::sin_cos(azimuth);
                [
                    x + along * cos - across * sin,
                    y + along * sin + across * cos,
                ]
            }
        }
    }

    /// Angle in rad of the part of a circle around a place that lies in the area.
    pub(crate) fn arc(&self, place_m: [f64; 2], radius_m: f64) -> f64 {
        let [x, y] = self.inside(place_m);
        let mut angles = Vec::with_capacity(10);
        let mut add = |middle: f64, cos: f64| {
            if cos.abs() < 1.0 {
                angles
                    .extend([middle - cos.acos(), middle + cos.acos()].map(|a| a.rem_euclid(TAU)));
            }
        };
        match *self {
            Self::Disc {
                radius_m: outer,
                inner_radius_m,
                ..
            } => {
                let distance = x.hypot(y);
                for rim in [outer, inner_radius_m] {
                    let cos = (rim * rim - distance * distance - radius_m * radius_m)
                        / (2.0 * distance * radius_m);
                    add(y.atan2(x), cos);
                }
            }
            Self::Strip {
                length_m, width_m, ..
            } => {
                for side in [-0.5, 0.5] {
                    add(0.0, (side * length_m - x) / radius_m);
                    add(0.5 * PI, (side * width_m - y) / radius_m);
                }
            }
        }
        angles.extend([0.0, TAU]);
        angles.sort_by(f64::total_cmp);
        let inside = |pair: &&[f64]| {
            let (sin, cos) = f64::sin_cos(0.5 * (pair[0] + pair[1]));
            self.holds([x + radius_m * cos, y + radius_m * sin])
        };
        angles
            .windows(2)
            .filter(inside)
            .map(|pair| pair[1] - pair[0])
            .sum()
    }

    /// Distances in m from a place at which its arc is not smooth, ascending: the first and last are the nearest and the
    /// farthest point of the area.
    pub(crate) fn breaks(&self, place_m: [f64; 2]) -> Vec<f64> {
        let [x, y] = self.inside(place_m);
        let mut found = match *self {
            Self::Disc {
                radius_m,
                inner_radius_m,
                ..
            } => {
                let distance = x.hypot(y);
                let rims = [radius_m, inner_radius_m].map(|r| [(distance - r).abs(), distance + r]);
                rims.concat()
            }
            Self::Strip {
                length_m, width_m, ..
            } => {
                let sides = [-0.5, 0.5].map(|s| [s * length_m - x, s * width_m - y]);
                let corners = sides.iter().flat_map(|a| sides.map(|b| a[0].hypot(b[1])));
                corners
                    .chain(sides.concat().into_iter().map(f64::abs))
                    .collect()
            }
        };
        if self.holds([x, y]) {
            found.push(0.0);
        }
        found.sort_by(f64::total_cmp);
        // before the nearest point the arc is zero
        let first = found
            .windows(2)
            .position(|pair| self.arc(place_m, 0.5 * (pair[0] + pair[1])) > 0.0);
        found.split_off(first.unwrap_or(0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use halfspace::gauss::rule;

    /// The integral of the arcs over the distance is the area, and the places drawn have their mean.
    #[test]
    fn arcs_add_up_to_the_area() {
        let disc = |centre_m, radius_m, inner_radius_m| Area::Disc {
            centre_m,
            radius_m,
            inner_radius_m,
        };
        let strip = |azimuth| Area::Strip {
            centre_m: [3.0, -1.0],
            length_m: 10.0,
            width_m: 1.5,
            azimuth,
        };
        for area in [
            disc([0.0, 0.0], 2.0, 0.0),
            disc([1.0, 5.0], 2.0, 0.5),
            disc([0.2, 0.1], 2.0, 0.5),
            strip(0.0),
            strip(0.7),
        ] {
            for place in [[0.0, 0.0], [3.0, -1.0], [0.1, 0.3], [-8.0, 2.0]] {
                let breaks = area.breaks(place);
                let sum: f64 = breaks
                    .windows(2)
                    .map(|ends| {
                        let [middle, half] = [0.5 * (ends[0] + ends[1]), 0.5 * (ends[1] - ends[0])];
                        rule(40)
                            .on(0.0, PI)
                            .map(|(t, weight)| {
                                let r = middle - half * t.cos();
                                weight * half * t.sin() * r * area.arc(place, r)
                            })
                            .sum::<f64>()
                    })
                    .sum();
                assert!(
                    (sum / area.size_m2() - 1.0).abs() < 1e-9,
                    "{area:?} {place:?} {sum}"
                );
                let inside = area.inside(area.place_m([0.3, 0.8]));
                assert!(area.holds(inside));
            }
        }
    }
}
