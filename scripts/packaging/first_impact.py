"""The first scene of README.md with the Python package; the argument is the restitution."""

import sys

import hertzlamb as hl

run = hl.impact({
    "target": {"material": "soda-lime-glass"},
    "striker": {"shape": "ball", "material": "bearing-steel", "diameter_m": 0.003, "drop_height_m": 0.002},
    "probe": [{"r_m": 0.005, "z_m": 0.005}],
})
run.save("impact.h5")
print(hl.__version__, run.restitution)
assert f"{run.restitution:.6f}" == sys.argv[1]
