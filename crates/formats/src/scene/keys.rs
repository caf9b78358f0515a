//! The keys of a scene, each listed once: section, name, range of a number, hint if it is missing, how it is written in
//! a resolved scene, and how the reader or a sweep sets it in a parsed scene.

use crate::error::SceneError;
use contact::{
    Choice, Echoes, Library, Material, Plasticity, Settings, Shape, Striker, choice,
    fall_velocity_m_s, nearest,
};
use impact::response::Response;
use impact::{ForceRecord, Load, Scene, Sensor, SensorResponse, Strike};
use num_complex::Complex64;
use toml::{Table, Value};

/// A range of numbers.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Range {
    /// In interval notation.
    pub(crate) name: &'static str,
    pub(crate) holds: fn(f64) -> bool,
}

impl Range {
    pub(crate) const fn new(name: &'static str, holds: fn(f64) -> bool) -> Self {
        Self { name, holds }
    }
}

pub(crate) const POSITIVE: Range = Range::new("(0, inf)", |x| x > 0.0 && x < f64::INFINITY);
pub(crate) const FINITE: Range = Range::new("(-inf, inf)", f64::is_finite);
pub(crate) const NOT_NEGATIVE: Range =
    Range::new("[0, inf)", |x| (0.0..f64::INFINITY).contains(&x));
pub(crate) const SIGN: Range = Range::new("{-1, 1}", |x| x == 1.0 || x == -1.0);
pub(crate) const POISSON: Range = Range::new("(-1, 0.5)", |x| x > -1.0 && x < 0.5);
pub(crate) const QUALITY: Range = Range::new("[1, 1e15]", |x| (1.0..=1e15).contains(&x));
pub(crate) const TOLERANCE: Range = Range::new("[1e-9, 0.1]", |x| (1e-9..=0.1).contains(&x));

/// A key of a scene.
pub(crate) struct Key {
    /// Section; `body` for keys of both bodies.
    section: &'static str,
    pub(crate) name: &'static str,
    /// None for words, lists and flags.
    pub(crate) range: Option<Range>,
    /// Hint if the key is required and missing.
    pub(crate) hint: &'static str,
    /// Value in a resolved scene, from the scene and the material of the key's section; none if the key is not written.
    pub(super) get: fn(&Scene, &Material) -> Option<Value>,
    /// How the key is set in a scene.
    pub(crate) set: Option<Set>,
    /// Placeholder for a number that a sweep sets after the scene is parsed.
    pub(crate) stand_in: Option<f64>,
}

/// Target of a value.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Set {
    Settings(fn(&mut Settings, f64)),
    /// A word; the function returns all choices if the word is unknown.
    Choice(fn(&mut Settings, &str) -> Result<(), String>),
    Strike(fn(&mut Strike, f64)),
    Body(fn(&mut Material, Option<&mut Shape>, f64)),
    /// A key that determines the mass of a striker; can be set directly for a ball only.
    Ball(fn(&mut Material, Option<&mut Shape>, f64)),
}
use Set::{Ball, Body, Choice as Choose, Settings as Setting, Strike as Approach};

macro_rules! keys {
    ($($section:ident.$name:ident $(: $range:ident)? $(($hint:literal))?
        $(= |$scene:pat_param, $body:pat_param| $get:expr)? $(, $set:expr $(, stands in: $stand_in:literal)?)?;)*) => {
        &[$(Key {
            section: stringify!($section),
            name: stringify!($name),
            range: keys!(@some $($range)?),
            hint: concat!("", $($hint)?),
            get: keys!(@get $(|$scene, $body| $get)?),
            set: keys!(@some $($set)?),
            stand_in: keys!(@some $($($stand_in)?)?),
        },)*]
    };
    (@some) => { None };
    (@some $value:expr) => { Some($value) };
    (@get) => { |_, _| None };
    (@get |$scene:pat_param, $body:pat_param| $get:expr) => {
        |$scene: &Scene, $body: &Material| Some(Value::from($get))
    };
}

/// All keys, in the order in which messages list them: section, name, range, hint, value in a resolved scene, setter,
/// and placeholder.
const KEYS: &[Key] = keys! {
    target.material = |_, m| known(m)?.name.as_str();
    target.thickness_m: POSITIVE = |s, _| s.target.thickness_m?;
    target.radius_m: POSITIVE = |s, _| s.target.radius_m?;
    target.echoes = |s, _| match s.target.echoes? {
        Echoes::Legs(legs) => legs as i64,
        Echoes::Until(_) => return None,
    };
    target.until_s: POSITIVE = |s, _| match s.target.echoes? {
        Echoes::Legs(_) => return None,
        Echoes::Until(time_s) => time_s,
    };
    target.quality_factor: QUALITY = |s, _| s.target.attenuation?.quality_factor();
    target.reference_frequency_hz: POSITIVE = |s, _| s.target.attenuation?.reference_frequency();
    striker.material = |_, m| known(m)?.name.as_str();
    striker.shape = |s, _| match striker(s)?.shape? {
        Shape::Ball { .. } => Form::Ball,
        Shape::Rod { .. } => Form::Rod,
    }.name();
    striker.diameter_m: POSITIVE ("the diameter of the striker") = |s, _| match striker(s)?.shape? {
        Shape::Ball { diameter_m } | Shape::Rod { diameter_m, .. } => diameter_m,
    }, Ball(|_, shape, x| {
        if let Some(Shape::Ball { diameter_m }) = shape {
            *diameter_m = x;
        }
    }), stands in: 1.0;
    striker.length_m: POSITIVE ("the length of the rod") = |s, _| striker(s)?.length_m?;
    striker.mass_kg: POSITIVE ("the mass of the striker; or shape = \"ball\" with diameter_m")
        = |s, _| striker(s).filter(|striker| striker.shape.is_none())?.mass_kg, Approach(|s, x| s.striker.mass_kg = x), stands in: 1.0;
    striker.tip_radius_m: POSITIVE ("the radius of the striker's tip") = |s, _| match striker(s)?.shape {
        None => striker(s)?.tip_radius_m,
        Some(Shape::Ball { .. }) => return None,
        Some(Shape::Rod { tip_radius_m, .. }) => tip_radius_m?,
    }, Approach(|s, x| s.striker.tip_radius_m = x), stands in: 1.0;
    striker.velocity_m_s: POSITIVE ("the velocity of approach, or drop_height_m for a fall from rest")
        = |s, _| s.strike()?.velocity_m_s, Approach(|s, x| s.velocity_m_s = x), stands in: 1.0;
    striker.drop_height_m: POSITIVE, Approach(|s, x| s.velocity_m_s = fall_velocity_m_s(x)), stands in: 1.0;
    body.youngs_modulus_pa: POSITIVE = |_, m| m.youngs_modulus_pa, Body(|m, _, x| m.youngs_modulus_pa = x), stands in: 1.0;
    body.poisson_ratio: POISSON = |_, m| m.poisson_ratio, Body(|m, _, x| m.poisson_ratio = x), stands in: 0.25;
    body.density_kg_m3: POSITIVE = |_, m| m.density_kg_m3?, Ball(|m, _, x| m.density_kg_m3 = Some(x)), stands in: 1.0;
    body.longitudinal_speed_m_s: POSITIVE;
    body.shear_speed_m_s: POSITIVE;
    body.yield_strength_pa: NOT_NEGATIVE = |_, m| strength(m, |m| m.yield_strength_pa)?,
        Body(|m, _, x| m.yield_strength_pa = Some(x).filter(|&x| x > 0.0));
    body.tensile_strength_pa: NOT_NEGATIVE = |_, m| strength(m, |m| m.tensile_strength_pa)?,
        Body(|m, _, x| m.tensile_strength_pa = Some(x).filter(|&x| x > 0.0));
    body.fracture_toughness_pa_sqrt_m: NOT_NEGATIVE = |_, m| strength(m, |m| m.fracture_toughness_pa_sqrt_m)?,
        Body(|m, _, x| m.fracture_toughness_pa_sqrt_m = Some(x).filter(|&x| x > 0.0));
    contact.disc_radius_m: POSITIVE = |s, _| s.settings.disc_radius_m?, Setting(|s, x| s.disc_radius_m = Some(x)), stands in: 1.0;
    contact.model = |s, _| s.settings.model.name(), Choose(|s, word| named(word).map(|model| s.model = model));
    contact.scheme = |s, _| s.settings.scheme.name(), Choose(|s, word| named(word).map(|scheme| s.scheme = scheme));
    contact.static_share = |s, _| s.settings.static_share.name(), Choose(|s, word| named(word).map(|static_share| s.static_share = static_share));
    contact.deflection = |s, _| s.settings.deflection.name(), Choose(|s, word| named(word).map(|deflection| s.deflection = deflection));
    contact.tolerance: TOLERANCE = |s, _| s.settings.tolerance, Setting(|s, x| s.tolerance = x), stands in: 1e-4;
    contact.loss_tolerance: TOLERANCE = |s, _| s.settings.loss_tolerance?, Setting(|s, x| s.loss_tolerance = Some(x)), stands in: 1e-3;
    contact.step_s: POSITIVE = |s, _| s.settings.step_s?, Setting(|s, x| s.step_s = Some(x));
    contact.plasticity = |s, _| Some(s.settings.plasticity).filter(|&law| law != Plasticity::None)?.name(),
        Choose(|s, word| named(word).map(|plasticity| s.plasticity = plasticity));
    contact.yield_pressure_pa: POSITIVE = |s, _| s.settings.yield_pressure_pa?,
        Setting(|s, x| s.yield_pressure_pa = Some(x)), stands in: 1e9;
    force.file = |s, _| file_of(s.record()?)?;
    force.time_s = |s, _| s.record()?.reading.samples.as_ref()?[0].clone();
    force.force_n = |s, _| s.record()?.reading.samples.as_ref()?[1].clone();
    force.columns = |s, _| s.record()?.reading.columns.clone()?.to_vec();
    force.units = |s, _| s.record()?.reading.units.clone()?.to_vec();
    force.start_s: FINITE = |s, _| s.record()?.reading.start_s?;
    force.end_s: FINITE = |s, _| s.record()?.reading.end_s?;
    force.onset_s: FINITE = |s, _| s.record()?.reading.onset_s?;
    force.sign: SIGN = |s, _| s.record()?.reading.sign?;
    force.sensitivity_v_per_n: POSITIVE = |s, _| s.record()?.reading.sensitivity_v_per_n?;
    force.low_pass_hz: POSITIVE = |s, _| s.record()?.treated?.low_pass_hz?;
    force.baseline_s: POSITIVE = |s, _| s.record()?.treated?.baseline_s?;
    probe.r_m: NOT_NEGATIVE ("the distance from the axis");
    probe.z_m: NOT_NEGATIVE ("the depth below the surface");
    sensor.r_m: NOT_NEGATIVE ("the distance of the sensor's centre from the axis");
    sensor.z_m: NOT_NEGATIVE ("the depth of the sensor: 0 on the surface");
    sensor.face_radius_m: NOT_NEGATIVE;
    sensor.quantity;
    sensor.response;
    response.file;
    response.poles;
    response.zeros;
    response.gain: FINITE ("the factor of the product of poles and zeros");
    response.coefficients;
    response.rate_hz: POSITIVE ("the sampling rate of the coefficients");
    response.unit;
    map.r_max_m: POSITIVE ("the width of the section") = |s, _| s.section.as_ref()?.r_max_m;
    map.z_max_m: POSITIVE ("the depth of the section") = |s, _| s.section.as_ref()?.z_max_m;
    map.points = |s, _| s.section.as_ref()?.points.map(|n| n as i64).to_vec();
    map.frames = |s, _| s.section.as_ref().filter(|section| section.times_s.is_empty())?.frames as i64;
    map.times_s = |s, _| s.section.as_ref().filter(|section| !section.times_s.is_empty())?.times_s.clone();
    output.duration_s: POSITIVE = |s, _| s.duration_s?;
    output.low_pass_hz: POSITIVE = |s, _| s.low_pass_hz?;
    output.quantities = |s, _| Some(&s.quantities).filter(|q| !q.is_empty())?.iter().map(|q| q.name()).collect::<Vec<_>>();
    output.peaks = |s, _| Some(s.peaks).filter(|&peaks| peaks)?;
    materials.file;
};

/// Shapes of a striker whose mass and tip follow from lengths.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Form {
    Ball,
    Rod,
}

choice!(Form: Ball = "ball", Rod = "rod");

/// The value of a word, or else the list of all words.
pub(super) fn named<T: Choice>(word: &str) -> Result<T, String> {
    T::named(word).ok_or_else(|| {
        let names: Vec<&str> = T::ALL.iter().map(|choice| choice.name()).collect();
        names.join(", ")
    })
}

fn striker(scene: &Scene) -> Option<&Striker> {
    scene.strike().map(|strike| &strike.striker)
}

/// The file of a record, empty for a record made by a program; none if its samples are in the scene.
fn file_of(record: &ForceRecord) -> Option<String> {
    let file = record.file.as_ref();
    let named = file.map_or_else(String::new, |path| path.display().to_string());
    record.reading.samples.is_none().then_some(named)
}

/// The library material whose name a resolved body keeps; the numbers of the body replace all of it.
fn known(material: &Material) -> Option<&'static Material> {
    let named = Library::built_in().get(&material.name);
    named.filter(|_| material.density_kg_m3.is_some())
}

/// A strength of a body. 0 marks a strength that is unknown although the named material has one.
fn strength(material: &Material, of: fn(&Material) -> Option<f64>) -> Option<f64> {
    of(material).or(known(material).and_then(of).map(|_| 0.0))
}

/// The sections, in the order in which messages list them.
pub(crate) const SECTIONS: [&str; 9] = [
    "target",
    "striker",
    "contact",
    "force",
    "probe",
    "sensor",
    "map",
    "output",
    "materials",
];

/// Sections inside others: of a sensor.
const INNER: [&str; 1] = ["response"];

/// The keys of a section; those of an elastic body come last.
pub(crate) fn keys_of(section: &str) -> impl Iterator<Item = &'static Key> {
    let bodies = ["target", "striker"].contains(&section);
    KEYS.iter()
        .filter(move |key| key.section == section || (bodies && key.section == "body"))
}

/// The full name of a key, with the first section that has it.
pub(super) fn full_name(name: &str) -> Option<String> {
    let has = |section: &&str| keys_of(section).any(|key| key.name == name);
    let section = SECTIONS.into_iter().chain(INNER).find(has)?;
    Some(format!("{section}.{name}"))
}

/// The key of a number; a name has the same meaning in every section.
pub(super) fn number(name: &str) -> Option<&'static Key> {
    KEYS.iter().find(|key| key.name == name)
}

/// The sections of a contact that have a key of this name.
///
/// ```
/// use formats::scene::sections_of;
/// assert_eq!(sections_of("velocity_m_s", &[])?, ["striker"]);
/// assert_eq!(sections_of("poisson_ratio", &[])?, ["target", "striker"]);
/// let unknown = sections_of("poison_ratio", &[]).unwrap_err();
/// assert!(unknown.to_string().contains("did you mean poisson_ratio?"));
/// # Ok::<(), formats::SceneError>(())
/// ```
///
/// # Errors
/// [`SceneError`] if none of them has it, with the nearest name of a key or of `others`, which are also accepted.
pub fn sections_of(key: &str, others: &[&str]) -> Result<Vec<&'static str>, SceneError> {
    let contact = &SECTIONS[..3];
    let has = |section: &&str| keys_of(section).any(|known| known.name == key);
    let found: Vec<&str> = contact.iter().copied().filter(has).collect();
    if found.is_empty() {
        let keys = contact.iter().flat_map(|section| keys_of(section));
        let names = keys.map(|key| key.name).chain(others.iter().copied());
        let near = nearest(key, names);
        let otherwise = "it does not exist in [target], [striker] or [contact]";
        return Err(SceneError::unknown_key(key.to_owned(), near, otherwise));
    }
    Ok(found)
}

/// The scene as TOML with all defaults and materials spelled out.
pub fn resolved(scene: &Scene) -> String {
    resolved_table(scene).to_string()
}

/// The resolved scene as a table.
pub fn resolved_table(scene: &Scene) -> Table {
    let mut root = Table::new();
    for section in SECTIONS {
        let body = match section {
            "striker" => striker(scene).map(|striker| &striker.material),
            _ => Some(scene.target.material()),
        };
        let keys = body.into_iter().flat_map(|body| {
            let written = move |key: &Key| Some((key.name.to_owned(), (key.get)(scene, body)?));
            keys_of(section).filter_map(written)
        });
        let table: Table = keys.collect();
        if !table.is_empty() {
            root.insert(section.to_owned(), table.into());
        }
    }
    let probes = scene.probes.iter().map(|probe| {
        let keys = [("r_m", probe.r_m), ("z_m", probe.z_m)];
        Table::from_iter(keys.map(|(key, place)| (key.to_owned(), place.into())))
    });
    if !scene.probes.is_empty() {
        root.insert("probe".into(), probes.collect::<Vec<_>>().into());
    }
    if !scene.sensors.is_empty() {
        let sensors = scene.sensors.iter().map(resolved_sensor);
        root.insert("sensor".into(), sensors.collect::<Vec<_>>().into());
    }
    root
}

/// A sensor of a resolved scene.
fn resolved_sensor(sensor: &Sensor) -> Table {
    let keys: [(&str, Value); 4] = [
        ("r_m", sensor.r_m.into()),
        ("z_m", sensor.z_m.into()),
        ("face_radius_m", sensor.face_radius_m.into()),
        ("quantity", sensor.measured.name().into()),
    ];
    let mut table = Table::from_iter(keys.map(|(key, value)| (key.to_owned(), value)));
    if let Some(own) = &sensor.response {
        table.insert("response".to_owned(), resolved_response(own).into());
    }
    table
}

/// A response of a resolved scene: its file, or its numbers.
fn resolved_response(own: &SensorResponse) -> Table {
    let roots = |all: &[Complex64]| -> Value {
        let pair = |root: &Complex64| Value::from(vec![root.re, root.im]);
        all.iter().map(pair).collect::<Vec<_>>().into()
    };
    let mut keys: Vec<(&str, Value)> = vec![("unit", own.unit.clone().into())];
    match (&own.file, &own.response) {
        (Some(file), _) => keys.push(("file", file.display().to_string().into())),
        (None, Response::PolesZeros(own)) => keys.extend([
            ("poles", roots(own.poles())),
            ("zeros", roots(own.zeros())),
            ("gain", own.gain().into()),
        ]),
        (None, Response::Fir(own)) => keys.extend([
            ("coefficients", own.coefficients().to_vec().into()),
            ("rate_hz", own.rate_hz().into()),
        ]),
        // a table has a file
        (None, Response::Tabulated(_)) => {}
    }
    keys.into_iter()
        .map(|(key, value)| (key.to_owned(), value))
        .collect()
}

impl Set {
    /// Sets a number that is in its range; returns false if the body becomes impossible.
    pub(crate) fn apply(self, scene: &mut Scene, section: &str, x: f64) -> bool {
        match (self, section, &mut scene.load) {
            (Self::Body(set) | Self::Ball(set), "target", _) => {
                let changed = scene.target.change(|material| set(material, None, x));
                return changed.is_ok();
            }
            (Self::Settings(set), ..) => set(&mut scene.settings, x),
            (Self::Strike(set), _, Load::Strike(strike)) => set(strike, x),
            (Self::Body(set), _, Load::Strike(strike)) => {
                set(&mut strike.striker.material, None, x);
            }
            (Self::Ball(set), _, Load::Strike(strike)) => {
                let striker = &mut strike.striker;
                let changed = striker.change_shape(|material, shape| set(material, shape, x));
                return changed.is_ok();
            }
            // the first template was checked for a striker, and words are not set this way
            (Self::Strike(_) | Self::Body(_) | Self::Ball(_) | Self::Choice(_), ..) => {}
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every key has a row in its section of the document, with the range of a number.
    #[test]
    fn the_document_has_every_key_with_its_range() {
        let document = include_str!("../../../../data-schema/scene.md");
        for section in SECTIONS.into_iter().chain(INNER) {
            let own = document.split("\n## ").filter(|part| {
                let heading = part.lines().next().unwrap_or_default();
                // the striker shares the elastic keys of the target
                let bodies = section == "striker" && heading.contains("[target]");
                let names = ["[", "."].map(|before| format!("{before}{section}]"));
                names.iter().any(|name| heading.contains(name)) || bodies
            });
            let rows: Vec<&str> = own.flat_map(str::lines).collect();
            for key in keys_of(section) {
                let names =
                    |row: &&&str| row.starts_with('|') && row.contains(&format!("`{}`", key.name));
                let mut found = rows.iter().filter(names).peekable();
                assert!(found.peek().is_some(), "{section}.{}", key.name);
                // the ranges of a record are described in words
                if let Some(range) = key.range.filter(|_| section != "force") {
                    let name = key.name;
                    assert!(
                        found.any(|row| row.contains(range.name)),
                        "{section}.{name}"
                    );
                }
            }
        }
    }
}
