"""Impact of a body on an elastic half-space: contact force, rebound, waves, kernel tables.

>>> import hertzlamb as hl
>>> scene = {
...     "target": {"material": "granite"},
...     "striker": {"material": "bearing-steel", "mass_kg": 1.105e-4, "tip_radius_m": 1.5e-3, "velocity_m_s": 1.98},
... }
>>> run = hl.impact(scene)
>>> round(run.restitution, 3)
0.993

What there is
-------------
impact : one impact from a scene (a dictionary, a file or TOML text)
infer : yield pressure or velocity from a rebound
resolve : a scene with every default and material spelled out
collide : many impacts, any key of the scene as an array
sweep : a sweep file, or any part of its rows
Table : a kernel table, for fields at many points
tabulate : makes a kernel table
kernels : exact response of the half-space to a suddenly applied force
materials : the materials that scenes can name

Every number of a scene is in SI units and carries its unit in its key; kernels and tables are in reduced units, lengths
in disc radii r0, times in r0/c1. z points into the half-space, compression is negative stress, and the time origin is
the first contact.
"""

from hertzlamb import kernels
from hertzlamb._core import VERSION as __version__
from hertzlamb._errors import (
    BadTable,
    DomainError,
    ForkError,
    HertzlambError,
    HertzlambWarning,
    ImpactError,
    OutputError,
    OutputExists,
    OutsideTable,
    SceneError,
    TooMuchMemory,
    WorkError,
)
from hertzlamb._fields import Fields
from hertzlamb._impact import Impact, Inferred, Probes, Section, impact, infer, resolve
from hertzlamb._materials import Material, Materials, materials
from hertzlamb._sweep import Collisions, Sweep, collide, sweep
from hertzlamb._table import Table, Trace, tabulate

__all__ = [
    "BadTable",
    "Collisions",
    "DomainError",
    "Fields",
    "ForkError",
    "HertzlambError",
    "HertzlambWarning",
    "Impact",
    "ImpactError",
    "Inferred",
    "Material",
    "Materials",
    "OutputError",
    "OutputExists",
    "OutsideTable",
    "Probes",
    "SceneError",
    "Section",
    "Sweep",
    "Table",
    "TooMuchMemory",
    "Trace",
    "WorkError",
    "__version__",
    "collide",
    "impact",
    "infer",
    "kernels",
    "materials",
    "resolve",
    "sweep",
    "tabulate",
]


def __dir__() -> list[str]:
    return __all__
