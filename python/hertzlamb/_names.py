"""Names of the results as annotations, so that type checkers report misspelt names.

`tests/python/package/test_numbers.py` compares them with the names in the compiled part.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]


class OfRows:
    """Scalar results of many impacts; `Impact` documents each of them."""

    peak_force_n: Floats
    peak_force_time_s: Floats
    contact_time_s: Floats
    rebound_velocity_m_s: Floats
    restitution: Floats
    loss: Floats
    peak_displacement_m: Floats
    peak_deflection_m: Floats
    impulse_n_s: Floats
    initial_energy_j: Floats
    radiated_energy_j: Floats
    energy_residual: Floats
    contact_radius_m: Floats
    disc_radius_m: Floats
    mean_pressure_pa: Floats
    yield_onset: Floats
    pressure_over_yield: Floats
    pressure_over_tensile: Floats
    cone_crack_onset: Floats
    yield_pressure_pa: Floats
    yield_velocity_m_s: Floats
    velocity_over_yield: Floats
    velocity_over_trusted: Floats
    plastic_work_j: Floats
    peak_indentation_m: Floats
    residual_indentation_m: Floats
    dent_radius_m: Floats
    contacts: Floats
    march_steps: Floats
    march_step_s: Floats
    relative_error_estimate: Floats


class OfEnergy:
    """Energies over time in J."""

    kinetic: Floats
    work: Floats
    stored: Floats
    radiated: Floats
    plastic: Floats


class OfFields:
    """Fields, and the additional quantities that a scene can request."""

    displacement_r: Floats
    displacement_z: Floats
    stress_rr: Floats
    stress_tt: Floats
    stress_zz: Floats
    stress_rz: Floats
    velocity_r: Floats
    velocity_z: Floats
    acceleration_r: Floats
    acceleration_z: Floats
    strain_rr: Floats
    strain_tt: Floats
    strain_zz: Floats
    strain_rz: Floats
    von_mises: Floats
    tresca: Floats
    max_shear: Floats
    principal_1: Floats
    principal_2: Floats
    principal_3: Floats


class OfPlaces(OfFields):
    """Fields with their estimated errors, their peaks over time, and the times of the peaks."""

    displacement_r_error: Floats
    displacement_r_peak: Floats
    displacement_r_peak_time: Floats
    displacement_r_peak_error: Floats
    displacement_z_error: Floats
    displacement_z_peak: Floats
    displacement_z_peak_time: Floats
    displacement_z_peak_error: Floats
    stress_rr_error: Floats
    stress_rr_peak: Floats
    stress_rr_peak_time: Floats
    stress_rr_peak_error: Floats
    stress_tt_error: Floats
    stress_tt_peak: Floats
    stress_tt_peak_time: Floats
    stress_tt_peak_error: Floats
    stress_zz_error: Floats
    stress_zz_peak: Floats
    stress_zz_peak_time: Floats
    stress_zz_peak_error: Floats
    stress_rz_error: Floats
    stress_rz_peak: Floats
    stress_rz_peak_time: Floats
    stress_rz_peak_error: Floats
    velocity_r_error: Floats
    velocity_r_peak: Floats
    velocity_r_peak_time: Floats
    velocity_r_peak_error: Floats
    velocity_z_error: Floats
    velocity_z_peak: Floats
    velocity_z_peak_time: Floats
    velocity_z_peak_error: Floats
    acceleration_r_error: Floats
    acceleration_r_peak: Floats
    acceleration_r_peak_time: Floats
    acceleration_r_peak_error: Floats
    acceleration_z_error: Floats
    acceleration_z_peak: Floats
    acceleration_z_peak_time: Floats
    acceleration_z_peak_error: Floats
    strain_rr_error: Floats
    strain_rr_peak: Floats
    strain_rr_peak_time: Floats
    strain_rr_peak_error: Floats
    strain_tt_error: Floats
    strain_tt_peak: Floats
    strain_tt_peak_time: Floats
    strain_tt_peak_error: Floats
    strain_zz_error: Floats
    strain_zz_peak: Floats
    strain_zz_peak_time: Floats
    strain_zz_peak_error: Floats
    strain_rz_error: Floats
    strain_rz_peak: Floats
    strain_rz_peak_time: Floats
    strain_rz_peak_error: Floats
    von_mises_error: Floats
    von_mises_peak: Floats
    von_mises_peak_time: Floats
    von_mises_peak_error: Floats
    tresca_error: Floats
    tresca_peak: Floats
    tresca_peak_time: Floats
    tresca_peak_error: Floats
    max_shear_error: Floats
    max_shear_peak: Floats
    max_shear_peak_time: Floats
    max_shear_peak_error: Floats
    principal_1_error: Floats
    principal_1_peak: Floats
    principal_1_peak_time: Floats
    principal_1_peak_error: Floats
    principal_2_error: Floats
    principal_2_peak: Floats
    principal_2_peak_time: Floats
    principal_2_peak_error: Floats
    principal_3_error: Floats
    principal_3_peak: Floats
    principal_3_peak_time: Floats
    principal_3_peak_error: Floats


class OfProbes(OfPlaces):
    """Fields and places of probes."""

    r: Floats
    z: Floats
    arrival: Floats
    valid_until: Floats
    echo: NDArray[np.str_]
    echo_arrival: Floats


class OfSection(OfPlaces):
    """Fields and axes of a section."""

    time: Floats
    r: Floats
    z: Floats
    arrival: Floats
