"""Contact times, forces and rebounds: ball drops, benchmarks of particle codes, a measured restitution."""

from __future__ import annotations

import hertzlamb as hl

from .collisions import STEEL, Drop, Solid, fall, mclaskey
from .table import Curve, Row

ALUMINIUM = Solid(70e9, 0.3, 2699.0)
MAGNESIUM = Solid(40e9, 0.35, 1800.0)


def harder(block: Solid) -> Solid:
    """Chung and Ooi's rigid wall: a thousand times as stiff."""
    return Solid(1000 * block.e, block.nu, block.rho)


CASES = [
    (
        "steel ball, 1.58 mm, dropped 31 mm on steel",
        Drop(STEEL, STEEL, 0.79e-3, fall(0.031)),
    ),
    (
        "steel ball, R 1 mm, dropped 0.5 m on rock (4mNonSelfSim_OpenSWPC 8c4395d, source_4m_hertz.dat)",
        Drop(STEEL, Solid(103e9, 0.31, 2980.0), 1e-3, fall(0.5)),
    ),
    (
        "steel ball, R 1.5 mm, the same rock (note_on_Hertzian_impact_source)",
        Drop(Solid(209e9, 0.29, 7781.1), Solid(103e9, 0.31, 2980.0), 1.5e-3, fall(0.5)),
    ),
    (
        "chrome steel ball, 2.5 mm, dropped 0.25 m (assumed) on aluminium (PyCalibrAE aa4ba78)",
        Drop(Solid(190e9, 0.29, 7800.0), Solid(73.08e9, 0.3382, 2787.0), 1.25e-3, fall(0.25)),
    ),
    (
        "Chung and Ooi's test 2, aluminium alloy, R 0.1 m, 0.2 m/s, wall 1000 times as stiff",
        Drop(ALUMINIUM, harder(ALUMINIUM), 0.1, 0.2),
    ),
    (
        "the same on an aluminium block",
        Drop(ALUMINIUM, ALUMINIUM, 0.1, 0.2),
    ),
    (
        "Chung and Ooi's test 2, magnesium alloy, wall 1000 times as stiff",
        Drop(MAGNESIUM, harder(MAGNESIUM), 0.1, 0.2),
    ),
    (
        "alumina ball, 5 mm, 3.9 m/s on soda-lime glass (Kharaz et al. 2001, as in Chung and Ooi's tests 3 and 4)",
        Drop(Solid(380e9, 0.23, 4000.0), Solid(70e9, 0.25, 2500.0), 2.5e-3, 3.9),
    ),
    (
        "rockim vv/P2_sphere: R 20 mm, 1 GPa, 1 m/s on its own material",
        Drop(Solid(1e9, 0.25, 2650.0), Solid(1e9, 0.25, 2650.0), 0.02, 1.0),
    ),
]
GLASS, ROCKIM = CASES[7][1], CASES[8][1]


def ball(drop: Drop) -> dict[str, float]:
    run = hl.impact(drop.scene(model="growing", tolerance=1e-6))
    return {"force": run.peak_force_n, "time": run.contact_time_s, "loss": run.loss, "e": run.restitution}


def impacts() -> list[Row | Curve]:
    """Results of Hertz's law, of first-order radiation, and published measurements or computations."""
    rows: list[Row | Curve] = []
    for name, drop in CASES:
        found = ball(drop)
        _, force, time = drop.dashpot()
        # the bounds of Hertz's numbers are what the loss l explains: 3/10 l, 1/20 l, 13/20 l and a little more (T50, T53)
        room = lambda part: float(f"{1.2 * part * drop.loss + 2e-6:.1e}")
        rows += [
            Row(f"{name}: largest force, N", drop.force, "Hertz", found["force"], room(0.3), "3/10 of the loss below"),
            Row(
                "contact time, us",
                1e6 * drop.time,
                "Hertz",
                1e6 * found["time"],
                room(0.06),
                "1/20 of the loss below, and its next order",
            ),
            Row(
                "1 - e^2",
                drop.loss,
                "first order, Lamb's integral",
                found["loss"],
                room(0.65),
                "second order, 13/20 of the loss",
                digits=4,
            ),
            Row("largest force, N, with the loss", force, "area dashpot, DOP853", found["force"], 2e-4, "third order"),
            Row(
                "contact time, us, with the loss",
                1e6 * time,
                "area dashpot, DOP853",
                1e6 * found["time"],
                1e-4,
                "third order",
            ),
        ]
    return rows


def measured() -> list[Row | Curve]:
    """Formulas that ball drops are evaluated with, measurements, and a finite-element run."""
    rows: list[Row | Curve] = []
    for name, drop in CASES[:4]:
        force, time = mclaskey(drop)
        found = ball(drop)
        why = "constants of three and four digits; radiation"
        rows.append(
            Row(
                f"{name}: largest force, N",
                force,
                "McLaskey and Glaser 2012, eq. 7",
                found["force"],
                0.006,
                why,
                digits=5,
            )
        )
        rows.append(
            Row(
                "contact time, us",
                1e6 * time,
                "McLaskey and Glaser 2012, eq. 7",
                1e6 * found["time"],
                0.002,
                why,
                digits=5,
            )
        )
    time = 1e6 * ball(CASES[0][1])["time"]
    why = "read from a trace of a sensor"
    rows.append(Row("the first of these: contact time, us", 5.5, "measured, McLaskey", time, 0.06, why, digits=3))
    rows.append(Row("the same", 5.0, "measured, McLaskey: about 5", time, 0.2, why, digits=3))
    plate = CASES[3][1].scene()
    plate["target"] = {"longitudinal_speed_m_s": 6330.0, "shear_speed_m_s": 3130.0, "density_kg_m3": 2787.0}
    plate["target"]["thickness_m"] = 0.1016
    echo = hl.impact({**plate, "probe": [{"r_m": 0.105, "z_m": 0.0}]}).probes.valid_until[0]
    path = 2e6 * (0.1016**2 + 0.0525**2) ** 0.5 / 6330.0
    what = "PyCalibrAE's plate, 101.6 mm: first echo from its far side 105 mm from the drop, us"
    rows.append(
        Row(what, path, "two straight rays at 6330 m/s", 1e6 * echo, 1e-3, "the nearer edge of the contact", digits=5)
    )
    glass = ball(GLASS)
    why = (
        "radiation explains 0.025 of the measured loss of 0.040; the anvil's density is assumed, "
        "its far side may answer during the contact, and neither friction nor plasticity is modelled"
    )
    rows.append(
        Row(
            "restitution of alumina on glass at 3.9 m/s",
            0.98,
            "measured, Kharaz et al. 2001",
            glass["e"],
            0.01,
            why,
            digits=4,
        )
    )
    found = ball(ROCKIM)
    why = "finite elements on a coarse mesh"
    rows.append(
        Row(
            "rockim's sphere: largest force, N",
            424.8 * 1.046,
            "rockim vv/P2_sphere",
            found["force"],
            0.06,
            why,
            digits=4,
        )
    )
    why = "their expectation rests on Hunter's 1.04 for the loss"
    rows.append(Row("its restitution", 0.989, "rockim's expectation", found["e"], 0.002, why, digits=4))
    return rows
