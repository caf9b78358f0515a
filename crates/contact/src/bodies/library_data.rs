//! The built-in materials.
//!
//! One line each: name, group, Young's modulus (Pa) and Poisson's ratio or both wave speeds (m/s), density (kg/m^3),
//! strengths (Pa) and fracture toughness (Pa m^(1/2)) where they are known, and where the numbers come from.
//! "typical" marks a class whose members scatter; replace it by measured values where they matter.
//! "quoted after" marks numbers that were found in other people's tables under that name, and not in the work itself:
//! Farmer's ranges stand so in tables of rock strengths, those of toughness were not found in a text that is open to
//! read. Of Petrovic the abstract was read; Gercek's abstract says that ranges are given. Handbooks and standards are
//! cited for the kind of value, not page by page.

use crate::bodies::material::{Material, from_wave_speeds};

/// A material from its line; strengths and toughness where they are known.
fn material(
    [name, group, source]: [&str; 3],
    (youngs_modulus_pa, poisson_ratio): (f64, f64),
    density_kg_m3: f64,
    [
        yield_strength_pa,
        tensile_strength_pa,
        fracture_toughness_pa_sqrt_m,
    ]: [Option<f64>; 3],
) -> Material {
    Material {
        name: name.to_owned(),
        youngs_modulus_pa,
        poisson_ratio,
        density_kg_m3: Some(density_kg_m3),
        yield_strength_pa,
        tensile_strength_pa,
        fracture_toughness_pa_sqrt_m,
        group: group.to_owned(),
        source: source.to_owned(),
    }
}

macro_rules! materials {
    ($($name:literal, $group:ident, $kind:ident($a:literal, $b:literal), $density:literal
       $(, yield $yield:literal)? $(, tensile $tensile:literal)? $(, toughness $toughness:literal)? : $source:literal;)*) => {
        [$(material(
            [$name, stringify!($group), $source],
            materials!(@$kind $a $b $density),
            $density,
            [materials!(@optional $($yield)?), materials!(@optional $($tensile)?), materials!(@optional $($toughness)?)],
        ),)*]
    };
    (@moduli $a:literal $b:literal $density:literal) => { ($a, $b) };
    (@speeds $a:literal $b:literal $density:literal) => { from_wave_speeds($a, $b, $density) };
    (@optional) => { None };
    (@optional $value:literal) => { Some($value) };
}

/// All of them.
pub(crate) fn materials() -> impl IntoIterator<Item = Material> {
    materials! {
    "steel", metal, moduli(209e9, 0.3), 7830.0, yield 1000e6, tensile 1200e6: "anvil steel of the copper-on-steel Taylor test, Table 1 of the paper";
    "copper", metal, moduli(123e9, 0.34), 8960.0, yield 57e6, tensile 227e6: "rod of the copper-on-steel Taylor test, Table 1 of the paper";
    "bearing-steel", metal, moduli(208e9, 0.29), 7800.0, yield 1700e6, tensile 2240e6: "AISI 52100 hardened; elastic constants and strengths typical of handbooks";
    "granite", rock, moduli(55e9, 0.25), 2650.0, tensile 10e6, toughness 1.6e6: "elastic constants typical, of no single source; fracture toughness typical, as quoted after Atkinson and Meredith (1987), Fracture Mechanics of Rock";
    "aluminium", metal, moduli(70.3e9, 0.345), 2700.0, yield 35e6, tensile 90e6: "Kaye and Laby, Tables of Physical and Chemical Constants, elastic constants of solids; strengths typical of handbooks (commercially pure, annealed)";
    "aluminium-6061-t6", metal, moduli(68.9e9, 0.33), 2700.0, yield 276e6, tensile 310e6: "typical of handbooks (minimum strengths of the temper)";
    "brass-70-30", metal, moduli(100.6e9, 0.35), 8530.0, yield 110e6, tensile 325e6: "Kaye and Laby, Tables of Physical and Chemical Constants, elastic constants of solids; strengths typical of handbooks (annealed)";
    "cast-iron-grey", metal, moduli(152.3e9, 0.27), 7150.0, tensile 250e6: "Kaye and Laby, Tables of Physical and Chemical Constants, elastic constants of solids; tensile strength of grade EN-GJL-250";
    "gold", metal, moduli(78.0e9, 0.44), 19300.0, tensile 120e6: "Kaye and Laby, Tables of Physical and Chemical Constants, elastic constants of solids; strengths typical of handbooks (annealed)";
    "iron", metal, moduli(211.4e9, 0.293), 7870.0, yield 130e6, tensile 290e6: "Kaye and Laby, Tables of Physical and Chemical Constants, elastic constants of solids; strengths typical of handbooks (pure, annealed)";
    "lead", metal, moduli(16.1e9, 0.44), 11340.0, yield 5.5e6, tensile 12e6: "Kaye and Laby, Tables of Physical and Chemical Constants, elastic constants of solids; strengths typical of handbooks (rolled)";
    "magnesium", metal, moduli(44.7e9, 0.291), 1740.0, yield 21e6, tensile 90e6: "Kaye and Laby, Tables of Physical and Chemical Constants, elastic constants of solids; strengths typical of handbooks (pure, cast)";
    "mild-steel", metal, moduli(211.9e9, 0.291), 7860.0, yield 235e6, tensile 360e6: "Kaye and Laby, Tables of Physical and Chemical Constants, elastic constants of solids; yield strength of grade S235";
    "nickel", metal, moduli(219.2e9, 0.306), 8900.0, yield 150e6, tensile 460e6: "Kaye and Laby, Tables of Physical and Chemical Constants, elastic constants of solids; strengths typical of handbooks (annealed)";
    "platinum", metal, moduli(168e9, 0.377), 21450.0, tensile 140e6: "Kaye and Laby, Tables of Physical and Chemical Constants, elastic constants of solids; strengths typical of handbooks (annealed)";
    "silver", metal, moduli(82.7e9, 0.367), 10490.0, yield 54e6, tensile 125e6: "Kaye and Laby, Tables of Physical and Chemical Constants, elastic constants of solids; strengths typical of handbooks (annealed)";
    "stainless-steel", metal, moduli(215.3e9, 0.283), 7800.0, yield 215e6, tensile 505e6: "Kaye and Laby, Tables of Physical and Chemical Constants, elastic constants of solids; strengths typical of handbooks (austenitic, annealed)";
    "stainless-steel-304", metal, moduli(193e9, 0.29), 8000.0, yield 215e6, tensile 505e6: "typical of handbooks (annealed)";
    "tool-steel", metal, moduli(211.6e9, 0.287), 7800.0, yield 1500e6, tensile 2000e6: "Kaye and Laby, Tables of Physical and Chemical Constants, elastic constants of solids; strengths typical of handbooks (hardened)";
    "tungsten", metal, moduli(411e9, 0.28), 19300.0, yield 750e6, tensile 980e6: "Kaye and Laby, Tables of Physical and Chemical Constants, elastic constants of solids; strengths typical of handbooks";
    "zinc", metal, moduli(108.4e9, 0.249), 7140.0, tensile 130e6: "Kaye and Laby, Tables of Physical and Chemical Constants, elastic constants of solids; strengths typical of handbooks (rolled)";
    "copper-rolled", metal, speeds(5010.0, 2270.0), 8930.0, yield 310e6, tensile 345e6: "CRC Handbook of Chemistry and Physics, speed of sound in solids; strengths typical of handbooks (hard temper)";
    "beryllium", metal, speeds(12890.0, 8880.0), 1870.0, yield 240e6, tensile 320e6: "CRC Handbook of Chemistry and Physics, speed of sound in solids; strengths typical of handbooks (hot pressed)";
    "duralumin", metal, speeds(6320.0, 3130.0), 2790.0, yield 275e6, tensile 425e6: "CRC Handbook of Chemistry and Physics, speed of sound in solids; strengths typical of handbooks (aged at room temperature)";
    "monel", metal, speeds(5350.0, 2720.0), 8900.0, yield 240e6, tensile 550e6: "CRC Handbook of Chemistry and Physics, speed of sound in solids; strengths typical of handbooks (annealed)";
    "titanium", metal, speeds(6070.0, 3125.0), 4500.0, yield 275e6, tensile 345e6: "CRC Handbook of Chemistry and Physics, speed of sound in solids; strengths typical of handbooks (commercially pure, grade 2)";
    "tin", metal, speeds(3320.0, 1670.0), 7300.0, yield 9e6, tensile 14e6: "CRC Handbook of Chemistry and Physics, speed of sound in solids; strengths typical of handbooks";
    "titanium-6al-4v", metal, moduli(113.8e9, 0.342), 4430.0, yield 880e6, tensile 950e6: "typical of handbooks (annealed)";
    "alumina-99.5", ceramic, moduli(370e9, 0.22), 3890.0, tensile 260e6, toughness 4e6: "typical of handbooks (sintered, 99.5 %); fracture toughness likewise";
    "boron-carbide", ceramic, moduli(460e9, 0.17), 2520.0, tensile 350e6, toughness 3e6: "typical of handbooks (hot pressed); flexural strength and fracture toughness likewise";
    "silicon-carbide", ceramic, moduli(410e9, 0.14), 3100.0, tensile 400e6, toughness 3.5e6: "typical of handbooks (sintered); flexural strength and fracture toughness likewise";
    "silicon-nitride", ceramic, moduli(310e9, 0.27), 3200.0, tensile 800e6, toughness 6e6: "typical of handbooks (bearing balls); flexural strength and fracture toughness likewise";
    "tungsten-carbide", ceramic, moduli(534.4e9, 0.22), 14900.0, tensile 1500e6, toughness 10e6: "Kaye and Laby, Tables of Physical and Chemical Constants, elastic constants of solids; flexural strength and fracture toughness typical of grades with 6 % cobalt";
    "zirconia-y-tzp", ceramic, moduli(210e9, 0.3), 6050.0, tensile 900e6, toughness 8e6: "typical of handbooks (yttria stabilised); flexural strength and fracture toughness likewise";
    "crown-glass", glass, moduli(71.3e9, 0.22), 2500.0, tensile 45e6, toughness 0.8e6: "Kaye and Laby, Tables of Physical and Chemical Constants, elastic constants of solids; bending strength as of float glass, fracture toughness typical of handbooks";
    "flint-glass-heavy", glass, moduli(80.1e9, 0.27), 3900.0, tensile 45e6, toughness 0.7e6: "Kaye and Laby, Tables of Physical and Chemical Constants, elastic constants of solids; bending strength as of float glass, fracture toughness typical of handbooks";
    "fused-quartz", glass, moduli(73.1e9, 0.17), 2200.0, tensile 50e6, toughness 0.75e6: "Kaye and Laby, Tables of Physical and Chemical Constants, elastic constants of solids; tensile strength of makers' data sheets, fracture toughness typical of handbooks";
    "glass-bead", glass, moduli(64e9, 0.2), 2500.0, tensile 45e6, toughness 0.75e6: "soda-lime beads; elastic constants of no single source, below those of handbooks for plate glass; bending strength of float glass, EN 572-1, fracture toughness typical of handbooks";
    "soda-lime-glass", glass, moduli(72e9, 0.22), 2500.0, tensile 45e6, toughness 0.75e6: "typical of handbooks (float glass); bending strength of EN 572-1, which hangs on the state of the surface; fracture toughness typical";
    "pyrex", glass, speeds(5640.0, 3280.0), 2320.0, tensile 45e6, toughness 0.75e6: "CRC Handbook of Chemistry and Physics, speed of sound in solids; bending strength as of float glass, fracture toughness typical of handbooks";
    "epoxy", polymer, moduli(3.5e9, 0.35), 1160.0, yield 60e6, tensile 60e6: "typical of handbooks (unfilled, room temperature); strengths likewise";
    "pmma", polymer, moduli(5.0e9, 0.35), 1180.0, yield 110e6, tensile 75e6: "elastic constants typical of acrylic at impact rates, of no single source; strengths typical of handbooks (yield in compression)";
    "polycarbonate", polymer, moduli(2.4e9, 0.37), 1200.0, yield 62e6, tensile 66e6: "typical of handbooks (room temperature)";
    "ptfe", polymer, moduli(0.5e9, 0.46), 2170.0, yield 10e6, tensile 25e6: "typical of handbooks (room temperature); strengths likewise";
    "natural-rubber", polymer, moduli(0.0015e9, 0.4995), 930.0, tensile 25e6: "typical of handbooks (unfilled; the wave speeds are very sensitive to Poisson's ratio); tensile strength likewise";
    "nylon-6.6", polymer, speeds(2620.0, 1070.0), 1110.0, yield 80e6, tensile 80e6: "CRC Handbook of Chemistry and Physics, speed of sound in solids; strengths typical of handbooks (dry)";
    "polyethylene", polymer, speeds(1950.0, 540.0), 900.0, yield 10e6, tensile 13e6: "CRC Handbook of Chemistry and Physics, speed of sound in solids; strengths typical of handbooks (low density)";
    "polystyrene", polymer, speeds(2350.0, 1120.0), 1060.0, tensile 45e6: "CRC Handbook of Chemistry and Physics, speed of sound in solids; tensile strength typical of handbooks";
    "basalt", rock, moduli(70e9, 0.25), 2900.0, tensile 14e6, toughness 2.2e6: "typical; Poisson's ratio typical, ranges in Gercek (2007), Int. J. Rock Mech. Min. Sci. 44; tensile strength within the 10 to 30 MPa quoted after Farmer (1968), Engineering Properties of Rocks; fracture toughness typical, as quoted after Atkinson and Meredith (1987), Fracture Mechanics of Rock";
    "gabbro", rock, moduli(90e9, 0.26), 2950.0, tensile 17e6, toughness 2.5e6: "typical; Poisson's ratio typical, ranges in Gercek (2007), Int. J. Rock Mech. Min. Sci. 44; tensile strength typical; fracture toughness typical, as quoted after Atkinson and Meredith (1987), Fracture Mechanics of Rock";
    "gneiss", rock, moduli(60e9, 0.22), 2700.0, tensile 8e6, toughness 1.6e6: "typical; Poisson's ratio typical, ranges in Gercek (2007), Int. J. Rock Mech. Min. Sci. 44; tensile strength within the 5 to 20 MPa quoted after Farmer (1968), Engineering Properties of Rocks; fracture toughness typical, as quoted after Atkinson and Meredith (1987), Fracture Mechanics of Rock";
    "limestone", rock, moduli(45e9, 0.27), 2600.0, tensile 8e6, toughness 1.1e6: "typical; Poisson's ratio typical, ranges in Gercek (2007), Int. J. Rock Mech. Min. Sci. 44; tensile strength within the 5 to 25 MPa quoted after Farmer (1968), Engineering Properties of Rocks; fracture toughness typical, as quoted after Atkinson and Meredith (1987), Fracture Mechanics of Rock";
    "marble", rock, moduli(55e9, 0.25), 2700.0, tensile 9e6, toughness 1e6: "typical; Poisson's ratio typical, ranges in Gercek (2007), Int. J. Rock Mech. Min. Sci. 44; tensile strength typical; fracture toughness typical, as quoted after Atkinson and Meredith (1987), Fracture Mechanics of Rock";
    "sandstone", rock, moduli(15e9, 0.2), 2300.0, tensile 6e6, toughness 0.7e6: "typical; Poisson's ratio typical, ranges in Gercek (2007), Int. J. Rock Mech. Min. Sci. 44; tensile strength within the 4 to 25 MPa quoted after Farmer (1968), Engineering Properties of Rocks; fracture toughness typical, as quoted after Atkinson and Meredith (1987), Fracture Mechanics of Rock";
    "shale", rock, moduli(20e9, 0.2), 2500.0, tensile 4e6, toughness 0.9e6: "typical; Poisson's ratio typical, ranges in Gercek (2007), Int. J. Rock Mech. Min. Sci. 44; tensile strength within the 2 to 10 MPa quoted after Farmer (1968), Engineering Properties of Rocks; fracture toughness typical, as quoted after Atkinson and Meredith (1987), Fracture Mechanics of Rock";
    "ice", rock, moduli(9.3e9, 0.33), 917.0, tensile 1.4e6, toughness 0.1e6: "typical of polycrystalline ice near -5 degrees Celsius; tensile strength and fracture toughness within the 0.7 to 3.1 MPa and 0.05 to 0.15 MPa m^(1/2) that Petrovic (2003), J. Mater. Sci. 38, gives for -10 to -20 degrees Celsius";
    "concrete-c20-25", concrete, moduli(30e9, 0.2), 2400.0, tensile 2.2e6: "EN 1992-1-1, table 3.1: Ecm and fctm, Poisson's ratio of uncracked concrete, density of plain concrete";
    "concrete-c30-37", concrete, moduli(33e9, 0.2), 2400.0, tensile 2.9e6: "EN 1992-1-1, table 3.1: Ecm and fctm, Poisson's ratio of uncracked concrete, density of plain concrete";
    "concrete-c40-50", concrete, moduli(35e9, 0.2), 2400.0, tensile 3.5e6: "EN 1992-1-1, table 3.1: Ecm and fctm, Poisson's ratio of uncracked concrete, density of plain concrete";
    "concrete-c50-60", concrete, moduli(37e9, 0.2), 2400.0, tensile 4.1e6: "EN 1992-1-1, table 3.1: Ecm and fctm, Poisson's ratio of uncracked concrete, density of plain concrete";
    "cement-mortar", concrete, moduli(20e9, 0.2), 2100.0, tensile 2.5e6: "typical of handbooks; tensile strength likewise";
    "soil-very-dense", soil, moduli(1.3e9, 0.3), 2000.0: "EN 1998-1 ground type B (shear speed 360 to 800 m/s), small strains";
    "soil-medium-dense", soil, moduli(0.36844e9, 0.33), 1900.0: "EN 1998-1 ground type C (shear speed 180 to 360 m/s), small strains";
    "soil-soft", soil, moduli(0.08044e9, 0.4), 1700.0: "EN 1998-1 ground type D (shear speed below 180 m/s), small strains";
    "clay-saturated", soil, moduli(0.12069e9, 0.49), 1800.0: "typical of soft saturated clay, small strains";
    }
}
