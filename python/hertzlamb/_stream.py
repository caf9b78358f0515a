"""Outputs of sensors as an ObsPy Stream."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from hertzlamb._sensors import Sensor


def stream(sensors: Sequence[Sensor]) -> Any:
    try:
        from obspy import Stream, Trace, UTCDateTime  # type: ignore[import-not-found, import-untyped, unused-ignore]
    except ImportError:
        message = "to_stream needs ObsPy: install it with \"pip install obspy\""
        raise ImportError(message) from None
    found = Stream()
    for i, sensor in enumerate(sensors, 1):
        own = {name: getattr(sensor, name) for name in ("r", "z", "face_radius", "quantity", "output_unit", "valid_until")}
        own.update(zip(("arrival_p", "arrival_s", "arrival_r"), map(float, sensor.arrival), strict=True))
        step = float((sensor.time[-1] - sensor.time[0]) / (len(sensor.time) - 1))
        header = {"station": f"S{i:04d}", "delta": step, "starttime": UTCDateTime(0) + float(sensor.time[0]), "hertzlamb": own}
        found.append(Trace(np.array(sensor.output), header=header))
    return found
