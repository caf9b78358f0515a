"""The package with neither an HDF5 library nor anything but numpy."""

import ctypes, os, sys, sysconfig, warnings
for name in ("libhdf5.so", "libhdf5_serial.so", "libhdf5_serial.so.103", "libhdf5_serial.so.310"):
    try:
        ctypes.CDLL(name)
    except OSError:
        continue
    sys.exit(f"{name} is still found: this shows nothing")
warnings.simplefilter("ignore")
import numpy, hertzlamb as hl

scene = {"target": {"material": "steel"},
         "striker": {"material": "copper", "shape": "ball", "diameter_m": 2e-3, "velocity_m_s": 1.0},
         "probe": [{"r_m": 0.0, "z_m": 1e-3}]}
grid = {"poisson_ratios": [0.3], "cell_width": 0.5, "pulse_lengths": [10.0], "tolerance": 1e-6,
        "r": {"max": 0.875, "spacing": 0.125}, "z": {"max": 0.875, "spacing": 0.125}}
run = hl.impact(scene)
run.save("run.h5")
table = hl.tabulate("small.h5", grid)
u = table.trace(0.3, [0.1, 0.5], 0.5)
out = hl.collide({k: scene[k] for k in ("target", "striker")}, velocity_m_s=numpy.linspace(0.1, 1.0, 1000))
assert abs(out.restitution[-1] - run.restitution) == 0 and u.stress_zz.shape[0] == 2
assert not any("libhdf5" in line for line in open("/proc/self/maps")) if os.path.exists("/proc/self/maps") else True
print(f"Python {sysconfig.get_python_version()}, numpy {numpy.__version__}: restitution {run.restitution!r}")
