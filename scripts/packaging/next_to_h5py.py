"""The package next to h5py, which reads the files of without_library.py with its own HDF5 library.

The argument says whether h5py is imported before or after the package.
"""

import sys
names = ["h5py", "hertzlamb"] if sys.argv[1] == "before" else ["hertzlamb", "h5py"]
for name in names:
    __import__(name)
import h5py, hertzlamb as hl
with h5py.File("run.h5") as file, h5py.File("new.h5", "w") as new:
    new.create_dataset("x", data=file["force"][()], compression="gzip")
    assert file["force"].attrs["units"] == "N"
    assert (hl.Table.open("small.h5").trace(0.3, 0.1, 0.5).time > 0).all()
print(f"  h5py {h5py.__version__} with HDF5 {h5py.version.hdf5_version}, imported {sys.argv[1]}")
