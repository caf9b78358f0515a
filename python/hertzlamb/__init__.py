"""Impact of a body on an elastic half-space: contact force, rebound, waves, kernel tables.

>>> import hertzlamb as hl
>>> scene = {
...     "target": {"material": "granite"},
...     "striker": {"material": "bearing-steel", "mass_kg": 1.105e-4, "tip_radius_m": 1.5e-3, "velocity_m_s": 1.98},
... }
>>> run = hl.impact(scene)
>>> round(run.restitution, 3)
0.993

Scenes and results are in SI units; the name of each key and scalar result ends with its unit. Kernels and tables are in
reduced units: lengths in disc radii r0, times in r0/c1, where c1 is the speed of the longitudinal wave. z points into
the half-space, compression is negative stress, and time starts at the first contact. All exceptions derive from
`HertzlambError`.

Functions and classes
---------------------
impact : computes one impact of a scene, which is a dictionary, a file or TOML text
collide : computes many impacts; any key of the scene may be an array
sweep : computes a sweep file, or some of its rows
infer : infers a yield pressure or a velocity from a measured rebound
noise : computes the ground motion of many impacts
resolve : returns a scene with every default and material property written out
materials : lists the materials that a scene can name
kernels : module with the exact response of the half-space to a suddenly applied force
Table : kernel table on disk, for fields at many points
tabulate : computes a kernel table
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
from hertzlamb._force import Force, infer_force
from hertzlamb._impact import Impact, Inferred, Probes, Section, impact, infer, resolve
from hertzlamb._materials import Material, Materials, materials
from hertzlamb._noise import Noise, noise
from hertzlamb._sensors import Response, Sensor
from hertzlamb._sweep import Collisions, Sweep, collide, sweep
from hertzlamb._table import Table, Trace, tabulate

__all__ = [
    "BadTable",
    "Collisions",
    "DomainError",
    "Fields",
    "Force",
    "ForkError",
    "HertzlambError",
    "HertzlambWarning",
    "Impact",
    "ImpactError",
    "Inferred",
    "Material",
    "Materials",
    "Noise",
    "OutputError",
    "OutputExists",
    "OutsideTable",
    "Probes",
    "Response",
    "SceneError",
    "Section",
    "Sensor",
    "Sweep",
    "Table",
    "TooMuchMemory",
    "Trace",
    "WorkError",
    "__version__",
    "collide",
    "impact",
    "infer",
    "infer_force",
    "kernels",
    "materials",
    "noise",
    "resolve",
    "sweep",
    "tabulate",
]


def __dir__() -> list[str]:
    return __all__
