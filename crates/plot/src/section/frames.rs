//! The frames of a section, their quantities, the near field and the wave fronts.

use crate::error::PlotError;
use crate::request::Request;
use crate::series::{end_s, waves_of};
use crate::words::{axis, of_quantity};
use contact::{Choice, WaveSpeeds};
use figure::{Axis, ColourMap, Image, Layer, Panel, Scale, Style};
use formats::SceneError;
use formats::quantities::{Described, FIELD_QUANTITIES};
use formats::stored::{StoredImpact, StoredSection};
use std::f64::consts::FRAC_PI_2;
use std::path::Path;

/// A section with the data for its pictures.
pub(super) struct SectionView<'a> {
    pub(super) impact: &'a StoredImpact,
    pub(super) stored: StoredSection,
    pub(super) speeds: WaveSpeeds,
    pub(super) disc_radius_m: f64,
    /// Onset of the force in s.
    pub(super) start_s: f64,
    /// Duration of the force in s.
    pub(super) pulse_s: f64,
}

/// Distance of the S front, relative to the width of the section, above which fronts have names.
const NAMED_FRONTS_APART: f64 = 0.12;

impl<'a> SectionView<'a> {
    /// The section of a results file.
    pub(super) fn of(impact: &'a StoredImpact) -> Result<Self, PlotError> {
        let hint = "add a [map] with r_max_m, z_max_m, points and frames to the scene";
        let stored = impact.section()?;
        let stored = stored.ok_or_else(|| PlotError::absent(impact.path(), "section", hint))?;
        let (speeds, start_s) = waves_of(impact)?;
        Ok(Self {
            impact,
            speeds,
            disc_radius_m: impact.number("disc_radius_m").unwrap_or(0.0),
            start_s,
            pulse_s: end_s(&impact.series) - start_s,
            stored,
        })
    }

    /// The requested quantity, or the usual one.
    pub(super) fn quantity(
        &self,
        request: &Request,
        usual: &str,
    ) -> Result<SectionQuantity, PlotError> {
        let name = request.quantities.first().map_or(usual, String::as_str);
        SectionQuantity::named(name, &self.stored.quantities(), self.impact.path())
    }

    /// The stored quantity that shows waves best: a velocity, if the scene requested it.
    pub(super) fn usual(&self) -> &'static str {
        let mut names = self.stored.quantities().into_iter().map(|q| q.name);
        match names.any(|name| name == "velocity_z") {
            true => "velocity_z",
            false => "displacement_z",
        }
    }

    /// Its shorter side in m.
    pub(super) fn side_m(&self) -> f64 {
        let [r, z] = self.extent_m();
        r.min(z)
    }

    /// Time in s that the longitudinal wave needs to cross the section.
    pub(super) fn crossing_s(&self) -> f64 {
        self.side_m() / self.speeds.p
    }

    /// Whether the whole section is near field: the pulse is longer than the section.
    pub(super) fn is_near(&self) -> bool {
        self.pulse_s > self.crossing_s()
    }

    /// The frames nearest to the requested times.
    pub(super) fn asked(&self, times_s: &[f64]) -> Result<Vec<usize>, PlotError> {
        let known = &self.stored.time_s;
        let (first_s, last_s) = (known[0], known[known.len() - 1]);
        // a frame at a time in the scene is the nearest sample of the output
        let samples_s = &self.impact.series.time_s;
        let step_s = samples_s[1] - samples_s[0];
        let frame = |&time_s: &f64| {
            if (first_s - step_s..=last_s + step_s).contains(&time_s) {
                return Ok(self.nearest(time_s));
            }
            let [time, first, last] = [time_s, first_s, last_s].map(fault::number);
            let sentence = format!(
                "there is no frame at {time} s: the frames of the section are from {first} to {last} s"
            );
            Err(PlotError::refused(None, sentence))
        };
        times_s.iter().map(frame).collect()
    }

    /// The frame nearest to a time.
    pub(super) fn nearest(&self, time_s: f64) -> usize {
        let known = &self.stored.time_s;
        let after = known.partition_point(|&t| t < time_s).min(known.len() - 1);
        let before = after.saturating_sub(1);
        let is_before = time_s - known[before] < known[after] - time_s;
        if is_before { before } else { after }
    }

    /// Colour scale of a quantity: its end exceeds nearly all values outside the near field, for some rows of values at
    /// the same places. If all is near field, it extends to the largest values, in decades for unsigned quantities.
    pub(super) fn colours(
        &self,
        quantity: &SectionQuantity,
        rows: &[Vec<f64>],
        is_far: &[bool],
    ) -> (Axis, ColourMap) {
        let near = self.is_near();
        let shown = rows.iter().flat_map(|row| {
            let pairs = row.iter().zip(is_far).filter(|(_, far)| near || **far);
            pairs.map(|(value, _)| *value)
        });
        let largest = quantile_of_sizes(shown, if near { 0.999 } else { 0.985 });
        let (scale, low, map) = match (quantity.has_sign(), near) {
            (true, _) => (Scale::Linear, -largest, ColourMap::Diverging),
            (false, true) => (Scale::Logarithmic, 1e-3 * largest, ColourMap::Sequential),
            (false, false) => (Scale::Linear, 0.0, ColourMap::Sequential),
        };
        let axis = axis(&of_quantity(&quantity.name), &quantity.unit, scale);
        (axis.range(low, largest), map)
    }

    /// Extents along r and z in m.
    pub(super) fn extent_m(&self) -> [f64; 2] {
        let last = |x: &[f64]| x.iter().copied().fold(0.0, f64::max);
        [last(&self.stored.r_m), last(&self.stored.z_m)]
    }

    /// Depths in m, ascending, as images require them.
    pub(super) fn depths_m(&self) -> Vec<f64> {
        self.stored.z_m.iter().rev().copied().collect()
    }

    /// The values of a frame in the order of ascending depths; r varies fastest.
    pub(super) fn turned(&self, frame: &[f64]) -> Vec<f64> {
        let rows = frame.chunks(self.stored.r_m.len()).rev();
        rows.flatten().copied().collect()
    }

    /// A quantity in a frame, [turned](Self::turned).
    pub(super) fn values(
        &self,
        quantity: &SectionQuantity,
        frame: usize,
    ) -> Result<Vec<f64>, PlotError> {
        Ok(self.turned(&quantity.at(&self.stored, frame)?))
    }

    /// Radius of the near field in m, in which values grow without bound on the scale of the picture: an eighth of the
    /// extent, and at least three radii of the disc.
    pub(super) fn near_m(&self, extent_m: f64) -> f64 {
        (0.125 * extent_m)
            .max(3.0 * self.disc_radius_m)
            .min(0.5 * extent_m)
    }

    /// Whether each place of [`Self::values`] is outside the near field.
    pub(super) fn is_far(&self) -> Vec<bool> {
        let near_m = self.near_m(self.side_m());
        let depths = self.depths_m().into_iter();
        let row = |z: f64| self.stored.r_m.iter().map(move |r| r.hypot(z) > near_m);
        depths.flat_map(row).collect()
    }

    /// The values of a quantity over the section, at its nodes and interpolated between them.
    ///
    /// Near a contact stresses fall with the square of the distance and displacements with the distance. Therefore the
    /// value times that power of the distance is interpolated, so that a contact much smaller than a cell does not fill
    /// the cell.
    pub(super) fn finer(&self, quantity: &SectionQuantity, values: &[f64]) -> SectionGrid {
        let (r_m, z_m) = (&self.stored.r_m, self.depths_m());
        let (fine_r, fine_z) = (between(r_m), between(&z_m));
        let weight = |r: f64, z: f64| {
            let square = r * r + z * z + self.disc_radius_m.powi(2);
            square.powf(0.5 * quantity.near_power())
        };
        let width = r_m.len();
        let weighed: Vec<f64> = (values.iter().enumerate())
            .map(|(i, value)| value * weight(r_m[i % width], z_m[i / width]))
            .collect();
        let row = |k: usize, &(i, a): &(usize, f64)| {
            let at = |i: usize| weighed[k * width + i.min(width - 1)];
            at(i) + a * (at(i + 1) - at(i))
        };
        let place = |nodes: &[f64], &(i, a): &(usize, f64)| {
            let next = nodes[(i + 1).min(nodes.len() - 1)];
            nodes[i] + a * (next - nodes[i])
        };
        let mut grid = SectionGrid {
            r_m: fine_r.iter().map(|at| place(r_m, at)).collect(),
            z_m: fine_z.iter().map(|at| place(&z_m, at)).collect(),
            values: Vec::with_capacity(fine_r.len() * fine_z.len()),
        };
        for (&(k, b), &z) in fine_z.iter().zip(&grid.z_m) {
            let next = (k + 1).min(z_m.len() - 1);
            for (at, &r) in fine_r.iter().zip(&grid.r_m) {
                let value = row(k, at) + b * (row(next, at) - row(k, at));
                grid.values.push(value / weight(r, z));
            }
        }
        grid
    }

    /// Values over the section, mirrored at the axis.
    pub(super) fn map(&self, grid: SectionGrid, colours: Axis, map: ColourMap) -> Panel {
        let [r_max_m, z_max_m] = self.extent_m();
        let image = Image::new(grid.r_m, grid.z_m, grid.values, colours, map);
        let distance = Axis::linear("distance from the axis").si("m");
        let depth = Axis::linear("depth").si("m").reversed();
        let panel = Panel::new(distance.range(0.0, r_max_m), depth.range(0.0, z_max_m));
        Panel {
            has_equal_lengths: true,
            is_mirrored: true,
            ..panel.layer(Layer::Image(image))
        }
    }

    /// Fronts between the faces of a plate that stay longitudinal or shear: circles about the images of the load, the first of each
    /// kind with its name.
    fn echoes(&self, since_s: f64) -> Vec<Layer> {
        const DEPTHS: u32 = 60;
        let Some(plate) = self.impact.target.echoing() else {
            return Vec::new();
        };
        let thickness_m = plate.thickness_m;
        let mut layers = Vec::new();
        for (name, speed) in [("PP", self.speeds.p), ("SS", self.speeds.s)] {
            for legs in 1..=plate.legs {
                let point = |i: u32| {
                    let z_m = thickness_m * f64::from(i) / f64::from(DEPTHS);
                    let last_m = if legs % 2 == 1 {
                        thickness_m - z_m
                    } else {
                        z_m
                    };
                    let down_m = legs as f64 * thickness_m + last_m;
                    let across_m = ((speed * since_s).powi(2) - down_m * down_m).sqrt();
                    (across_m > 0.0).then_some((self.disc_radius_m + across_m, z_m))
                };
                let mut line: Vec<(f64, f64)> = (0..=DEPTHS).filter_map(point).collect();
                // where it crosses the axis
                let run_m = speed * since_s - legs as f64 * thickness_m;
                if run_m > 0.0 && run_m < thickness_m {
                    match legs % 2 {
                        1 => line.insert(0, (0.0, thickness_m - run_m)),
                        _ => line.push((0.0, run_m)),
                    }
                }
                if line.len() < 2 {
                    continue;
                }
                if legs == 1 && line.len() > DEPTHS as usize / 2 {
                    layers.push(Layer::text(line[line.len() / 2], name));
                }
                layers.push(Layer::line("", Style::Rimmed, line));
            }
        }
        layers
    }

    /// The fronts at a time as thin lines with their names, in a mirrored panel.
    pub(super) fn fronts(&self, time_s: f64) -> Vec<Layer> {
        let since = time_s - self.start_s;
        if since <= 0.0 {
            return Vec::new();
        }
        let [p, s, rayleigh] =
            [self.speeds.p, self.speeds.s, self.speeds.rayleigh].map(|c| c * since);
        // a Rayleigh wave is as deep as it is long
        let depth = (self.speeds.rayleigh * self.pulse_s).min(0.9 * rayleigh);
        let edge = self.disc_radius_m + rayleigh;
        let [of_p, of_s] = [p, s].map(|radius| capsule(self.disc_radius_m, radius));
        let lines = [of_p, of_s, vec![(edge, 0.0), (edge, depth)]];
        let mut layers = lines
            .map(|line| Layer::line("", Style::Rimmed, line))
            .to_vec();
        let on = |radius: f64, angle: f64| {
            let across = self.disc_radius_m + radius * angle.sin();
            (across, radius * angle.cos())
        };
        layers.extend(self.echoes(since));
        // names of fronts that have not separated yet would overlap
        if s < NAMED_FRONTS_APART * self.extent_m()[0] {
            return layers;
        }
        let named = [
            (on(p, 0.75), "P"),
            (on(s, 0.5), "S"),
            ((edge, 0.6 * depth), "R"),
        ];
        layers.extend(named.map(|(at, name)| Layer::text(at, name)));
        layers
    }
}

/// Values of a section on a grid: distances from the axis and depths, both ascending, and values, in which the distance
/// varies fastest.
pub(super) struct SectionGrid {
    pub(super) r_m: Vec<f64>,
    pub(super) z_m: Vec<f64>,
    pub(super) values: Vec<f64>,
}

/// Points along a side of a picture: more than its pixels on a page.
const PICTURE_PLACES: usize = 400;

/// Points at nodes and uniformly between them, at least [`PICTURE_PLACES`]: the node below each, and the fraction of
/// the way to the next.
pub(super) fn between(nodes: &[f64]) -> Vec<(usize, f64)> {
    let cells = nodes.len() - 1;
    let parts = PICTURE_PLACES.div_ceil(cells);
    let inner = (0..cells * parts).map(|i| (i / parts, (i % parts) as f64 / parts as f64));
    inner.chain([(cells, 0.0)]).collect()
}

/// Points at a distance from a disc: a quarter circle around its edge and the straight part below it.
fn capsule(disc_radius_m: f64, distance_m: f64) -> Vec<(f64, f64)> {
    const QUARTER_POINTS: u32 = 90;
    let arc = (0..=QUARTER_POINTS).map(|i| {
        let angle = FRAC_PI_2 * f64::from(i) / f64::from(QUARTER_POINTS);
        let across = disc_radius_m + distance_m * angle.cos();
        (across, distance_m * angle.sin())
    });
    arc.chain([(0.0, distance_m)]).collect()
}

/// The quantile of the magnitudes for a fraction; 0 without values.
pub(super) fn quantile_of_sizes(values: impl Iterator<Item = f64>, fraction: f64) -> f64 {
    let mut sizes: Vec<f64> = values.map(f64::abs).filter(|v| v.is_finite()).collect();
    sizes.sort_unstable_by(f64::total_cmp);
    lookup::quantile(&sizes, fraction)
}

/// A quantity and its computation from stored ones.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct SectionQuantity {
    /// Name, as in the request.
    pub(super) name: String,
    /// Unit without a prefix.
    pub(super) unit: String,
    /// Stored quantities that it is computed from: itself, the components of a vector, or all stresses.
    parts: Vec<String>,
    /// Function of the stresses, if it is one; it may be stored as well.
    pub(super) stress: Option<impact::Quantity>,
}

/// Stresses from which others are computed.
const STRESSES: [&str; 4] = ["stress_rr", "stress_tt", "stress_zz", "stress_rz"];

/// Quantities that follow from the stresses without the elastic constants.
fn of_stresses() -> impl Iterator<Item = impact::Quantity> {
    let stresses = FIELD_QUANTITIES.into_iter().filter(|row| row.1 == "Pa");
    stresses.map(|row| row.0)
}

impl SectionQuantity {
    /// The quantity with a name, stored or computed.
    pub(super) fn named(name: &str, stored: &[Described], path: &Path) -> Result<Self, PlotError> {
        let find = |name: &str| stored.iter().find(|quantity| quantity.name == name);
        let stress = of_stresses().find(|of| of.name() == name);
        let (unit, parts): (&str, &[&str]) = match (find(name), stress, name) {
            (Some(found), _, _) => (&found.unit, &[name]),
            (None, Some(_), _) => ("Pa", &STRESSES),
            (None, None, "displacement") => ("m", &["displacement_r", "displacement_z"]),
            (None, None, "speed") if find("velocity_r").and(find("velocity_z")).is_some() => {
                ("m/s", &["velocity_r", "velocity_z"])
            }
            (None, None, _) => {
                let known = stored.iter().map(|quantity| quantity.name.as_str());
                let derived = of_stresses().map(|of| -> &str { of.name() });
                let derived = derived.filter(|name| find(name).is_none());
                let all = known.chain(derived).chain(["displacement"]);
                return Err(PlotError::unknown(path, name, name, all));
            }
        };
        Ok(Self {
            name: name.to_owned(),
            unit: unit.to_owned(),
            parts: parts.iter().map(|&part| part.to_owned()).collect(),
            stress,
        })
    }

    /// The power of 1/distance with which it grows towards a contact: that of the static field.
    pub(super) fn near_power(&self) -> f64 {
        match self.unit.as_str() {
            "m" | "m/s" | "m/s^2" => 1.0,
            // stresses and strains
            _ => 2.0,
        }
    }

    /// Whether it is signed.
    pub(super) fn has_sign(&self) -> bool {
        !["von_mises", "tresca", "max_shear", "displacement", "speed"].contains(&self.name.as_str())
    }

    /// Its values in a frame.
    pub(super) fn at(&self, section: &StoredSection, frame: usize) -> Result<Vec<f64>, SceneError> {
        let parts = self.parts.iter().map(|name| section.frame(name, frame));
        let parts: Vec<Vec<f32>> = parts.collect::<Result<_, _>>()?;
        let value = |i: usize| match (parts.as_slice(), self.stress) {
            ([rr, tt, zz, rz], Some(of)) => {
                of.of([rr[i], tt[i], zz[i], rz[i]].map(f64::from), [1.0, 0.0])
            }
            ([a, b], _) => f64::from(a[i]).hypot(f64::from(b[i])),
            (parts, _) => f64::from(parts[0][i]),
        };
        Ok((0..parts[0].len()).map(value).collect())
    }
}
