"""Fields in an elastic half-space under a Hertz pressure whose radius follows its load, for growing_fields.csv.

    f(r, z, t) = (1/2 pi i) int e^(st) ds (1/2 pi) int_0^inf k J_n(kr) F(k, z, s) q(k, s) dk
    q(k, s)    = int_0^T e^(-st) P(t) H(k a(t)) dt,      H(x) = 3 (sin x - x cos x)/x^3

Frequency and wavenumber: both inverse transforms are taken as they stand, nothing is solved in the time domain.
H is the Hankel transform of the Hertz pressure of unit load, p(r) = 3/(2 pi a^2) sqrt(1 - r^2/a^2) = (1/2 pi) int k J0(kr) H(ka) dk.
F is the field under a unit load of one wavenumber, from the two potentials (Achenbach 1973, section 7; Eringen and Suhubi 1975,
volume 2, section 8).

Units: length A, the largest contact radius; velocity c1; time A/c1; displacement P_max/(mu A), stress P_max/A^2;
z into the body, r outward, tension positive.
The force is Hertz's impact, u'' = -(5/4) u^(3/2), u(0) = 0, u'(0) = 1, P = u^(3/2), a = sqrt(u), stretched to the duration T.

    python growing_fields.py                       rows that are missing, every case
    python growing_fields.py --duration 20 60      only these
    python growing_fields.py --check               the load, a disc of fixed radius and a slow contact against other methods
"""

import argparse
import csv
import math
import sys
from pathlib import Path

import mpmath
import numpy as np
from numpy.polynomial.legendre import leggauss
from scipy.special import beta, betainc, erfc, jv

from static_field import field as static_field

HERE = Path(__file__).parent
FILE = HERE / "growing_fields.csv"
FIELDS = ("u_r", "u_z", "s_rr", "s_tt", "s_zz", "s_rz")
COLUMNS = ("poisson_ratio", "contact_time", "r", "z", "t", *FIELDS, *("peak_" + f for f in FIELDS), "error")
RATIOS = (0.25, 0.29, 0.4)
DURATIONS = (20.0, 60.0, 200.0)
PLACES = ((0.0, 0.5), (0.5, 0.3), (1.0, 0.5), (0.3, 1.5), (3.0, 1.0), (0.0, 5.0), (8.0, 4.0))
# rows with a larger error, of the peak of a field, are left out
WORST = 1e-6

PANEL = 32.0
CHEBYSHEV = 48
GAUSS = 24
FORCE_X, FORCE_W = leggauss(20)
# duration of the contact in collision units, 2 int_0^1 du/sqrt(1 - u^(5/2))
COLLISION = 0.8 * beta(0.4, 0.5)


class Settings:
    """Numerical parameters of one inversion; a row is computed with two of them."""

    def __init__(self, bandwidth, stretch, damping, shift, panels):
        # largest angular frequency; the window falls from one to zero in the upper part
        self.bandwidth = bandwidth
        # period of the Fourier series, in lengths of the record
        self.stretch = stretch
        # the damping is exp(-damping) over one period
        self.damping = damping
        # the path of wavenumbers runs this far above the real axis, less far from the load
        self.shift = shift
        # length of a panel of the path in distances from the nearest singularity
        self.panels = panels


# ---- the load

def approach_time(theta):
    """Time at which u^(5/4) = sin(theta), from the first integral u'^2 = 1 - u^(5/2)."""
    sine, cosine = np.sin(theta) ** 2, np.cos(theta) ** 2
    low = betainc(0.4, 0.5, np.minimum(sine, 0.5))
    high = 1 - betainc(0.5, 0.4, np.minimum(cosine, 0.5))
    return 0.5 * COLLISION * np.where(sine < 0.5, low, high)


def approach(t):
    """u(t) of Hertz's impact, 0 <= t <= half the duration, by Newton's method."""
    t = np.asarray(t, float)
    table = np.linspace(0, 1, 4001) ** 2.5 * (math.pi / 2)
    theta = np.maximum(np.interp(t, approach_time(table), table), 1e-200)
    theta = np.where(t < 1e-3, t**1.25, theta)
    for _ in range(6):
        step = (approach_time(theta) - t) * np.sin(theta) ** 0.2 / 0.8
        theta = np.clip(theta - step, 0.5 * theta, math.pi / 2)
    return np.sin(theta) ** 0.8


class HertzForce:
    """Hertz's impact, its contact radius following the force."""

    def __init__(self, duration):
        self.duration = duration

    def at(self, t):
        u = approach(t * (COLLISION / self.duration))
        return u**1.5, np.sqrt(u)

    def breaks(self, wavenumber):
        """Times between which k a(t) grows by at most 16."""
        a = np.linspace(0, 1, int(wavenumber / 16) + 2)
        return approach_time(np.arcsin(np.minimum(a**2.5, 1.0))) * (self.duration / COLLISION)


class FixedDisc:
    """The force sin^4(pi t/T) on a disc of radius one."""

    def __init__(self, duration):
        self.duration = duration

    def at(self, t):
        return np.sin(math.pi * t / self.duration) ** 4, np.ones_like(t)

    def breaks(self, _wavenumber):
        return np.array([0.0, self.duration / 2])


def hertz_transform(x):
    """H(x) = 3 (sin x - x cos x)/x^3, by its series below one."""
    small = np.minimum(x, 1.0) ** 2
    series, term = np.zeros_like(x), np.ones_like(x)
    for n in range(12):
        series += term
        term = term * (-small / ((2 * n + 2) * (2 * n + 5)))
    large = np.maximum(x, 1.0)
    return np.where(x < 1, series, 3 * (np.sin(large) - large * np.cos(large)) / large**3)


class Load:
    """q(k, s) at Chebyshev points of panels of wavenumbers; it is of exponential type a <= 1 in k."""

    def __init__(self, force, wavenumber, frequency):
        panels = int(wavenumber / PANEL) + 1
        angle = (np.arange(CHEBYSHEV) + 0.5) * (math.pi / CHEBYSHEV)
        self.points = -np.cos(angle)
        self.weights = np.sin(angle) * (-1.0) ** np.arange(CHEBYSHEV)
        self.k = (PANEL * (np.arange(panels)[:, None] + 0.5 + 0.5 * self.points)).ravel()
        half = force.duration / 2
        # the force is symmetric about the middle, and analytic in sqrt(t) from the touch on
        ends = np.concatenate([np.linspace(0, half, int(half * frequency / 14) + 2), force.breaks(PANEL * panels)])
        ends = np.sqrt(np.unique(np.clip(ends, 0, half)))
        ends = ends[np.concatenate([[True], np.diff(ends) > 1e-12])]
        middle, length = 0.5 * (ends[1:] + ends[:-1]), 0.5 * np.diff(ends)
        root = (middle[:, None] + length[:, None] * FORCE_X).ravel()
        weight = (length[:, None] * FORCE_W).ravel() * 2 * root
        self.t = root**2
        p, a = force.at(self.t)
        self.table = hertz_transform(self.k[:, None] * a) * (p * weight)
        self.half = half

    def at(self, s):
        """q at the Chebyshev points, one column for each s."""
        e = np.exp(-s * self.t[:, None])
        # e^(-s (T - t)), the second half of the force
        e += np.exp(-2 * self.half * s) / e
        return self.table @ e.real + 1j * (self.table @ e.imag)

    def interpolation(self, k):
        """For each panel of k: slice of the path, slice of the Chebyshev points, matrix between them."""
        found = []
        panel = np.minimum((k.real / PANEL).astype(int), len(self.k) // CHEBYSHEV - 1)
        for p in np.unique(panel):
            inside = np.flatnonzero(panel == p)
            x = k[inside] / (0.5 * PANEL) - (2 * p + 1)
            terms = self.weights / (x[:, None] - self.points)
            matrix = terms / terms.sum(axis=1, keepdims=True)
            found.append((slice(inside[0], inside[-1] + 1), slice(p * CHEBYSHEV, (p + 1) * CHEBYSHEV), matrix))
        return found


# ---- the half-space

class Solid:
    def __init__(self, nu):
        self.nu = nu
        self.kappa = math.sqrt((1 - 2 * nu) / (2 - 2 * nu))
        self.lame = 2 * nu / (1 - 2 * nu)
        # Rayleigh's equation for x = (c_R/c2)^2
        roots = np.roots([1, -8, 24 - 16 * self.kappa**2, -16 * (1 - self.kappa**2)])
        real = [x.real for x in roots if abs(x.imag) < 1e-9 and 0 < x.real < 1]
        self.rayleigh = self.kappa * math.sqrt(min(real))

    def waves(self, k, s):
        """What the transformed fields at all depths share, for a column k and a row s."""
        m, p2 = k * k, s * s
        s2 = p2 / self.kappa**2
        alpha, beta_ = np.sqrt(m + p2), np.sqrt(m + s2)
        ab = alpha * beta_
        # d = k^2 - alpha beta, small beside either where s is small
        with np.errstate(all="ignore"):
            d = np.where((ab * m.conj()).real > 0, -(m * (p2 + s2) + p2 * s2) / (m + ab), m - ab)
        rayleigh = 4 * m * (d + s2) + s2 * s2
        return k, m, p2, s2, alpha, beta_, ab, d, 1 / rayleigh

    def fields(self, waves, z, q):
        """Transforms of u_r, u_z, s_zz, s_rz and the parts of s_rr and s_tt without 2 u_r/r, times q.

        D = gamma^2 - 4 alpha beta k^2, gamma = 2 k^2 + s^2/c2^2; E1 = e^(-alpha z), E2 = e^(-beta z):
            u_r  = k (gamma E1 - 2 alpha beta E2)/D          u_z = alpha (gamma E1 - 2 k^2 E2)/D
            s_zz = -(gamma^2 E1 - 4 alpha beta k^2 E2)/D     s_rz = -2 alpha gamma k (E1 - E2)/D
            s_rr = [gamma (2 k^2 - (lambda/mu) s^2) E1 - 4 alpha beta k^2 E2]/D - 2 u_r/r
            s_tt = -(lambda/mu) s^2 gamma E1/D + 2 u_r/r
        with E1 - E2 taken out of each, so that nothing cancels at low frequency.  At z = 0 s_zz = -1 and s_rz = 0.
        """
        k, m, p2, s2, alpha, beta_, ab, d, over = waves
        e1, e2 = np.exp(-alpha * z), np.exp(-beta_ * z)
        near = (s2 - p2) / (alpha + beta_) * z
        close = np.abs(near) < 1
        change = e1 - e2
        change[close] = -e1[close] * np.expm1(-near[close])
        gamma = 2 * m + s2
        e1, change = e1 * q, change * q
        scaled = over * change
        first = over * e1
        u_r = k * ((s2 + 2 * d) * first + 2 * ab * scaled)
        u_z = alpha * (s2 * first + 2 * m * scaled)
        bulk = -self.lame * p2 * gamma * first
        shear = 4 * ab * m * scaled
        s_zz = -e1 - shear
        s_rz = -2 * alpha * gamma * k * scaled
        s_rr = 2 * m * (s2 + 2 * d) * first + bulk + shear
        return u_r, u_z, s_zz, s_rz, s_rr, bulk


# ---- the inversion

def path(eta, shift, ratio, end):
    """Nodes and weights on a path of wavenumbers from 0 up to the line Im k = shift and along it.

    Branch points and poles lie on the rays k = -i s/c, no nearer than eta below the real axis.
    Panels grow with the distance from that line.
    """
    corner = 2 * shift
    slope = (corner + 1j * shift) / corner
    ends, x = [0j], 0.0
    while x < corner:
        x = min(corner, x + ratio * (eta + 0.5 * x * 0.5) / abs(slope))
        if corner - x < 0.2 * eta:
            x = corner
        ends.append(x * slope)
    count = math.ceil((end - corner) / (ratio * (eta + shift)))
    ends = np.array(ends + [corner + 1j * shift + (end - corner) * (j + 1) / count for j in range(count)])
    x, w = leggauss(GAUSS)
    half = 0.5 * np.diff(ends)[:, None]
    return (0.5 * (ends[1:] + ends[:-1])[:, None] + half * x).ravel(), (half * w).ravel()


def spectrum(solid, load, r, z, eta, omega, settings):
    """Laplace transforms of the six fields at eta + i omega, by quadrature over the wavenumber."""
    shift = settings.shift / (1 + 0.35 * r)
    reach = lambda w: math.hypot(w / solid.kappa, 38 / z) + 4
    k, weight = path(eta, shift, settings.panels, reach(omega[-1]))
    weight = weight * k / (2 * math.pi)
    j0 = weight * jv(0, k * r)
    j1 = weight * jv(1, k * r)
    over_r = j1 / r if r > 0 else weight * k / 2
    panels = load.interpolation(k)
    found = np.zeros((6, len(omega)), complex)
    block = 32
    for start in range(0, len(omega), block):
        part = slice(start, min(start + block, len(omega)))
        s = (eta + 1j * omega[part])[None, :]
        used = int(np.searchsorted(k.real, reach(omega[part][-1])))
        table = load.cached(part, s)
        q = np.empty((len(k), s.shape[1]), complex)
        for rows, columns, matrix in panels:
            if rows.start < used:
                q[rows] = matrix @ table[columns]
        kk = k[:used, None]
        u_r, u_z, s_zz, s_rz, s_rr, s_tt = solid.fields(solid.waves(kk, s), z, q[:used])
        twice = 2 * (over_r[:used] @ u_r)
        found[0, part] = j1[:used] @ u_r
        found[1, part] = j0[:used] @ u_z
        found[2, part] = j0[:used] @ s_rr - twice
        found[3, part] = j0[:used] @ s_tt + twice
        found[4, part] = j0[:used] @ s_zz
        found[5, part] = j1[:used] @ s_rz
    return found


class Inversion:
    """One force and one solid inverted with one set of parameters."""

    def __init__(self, solid, force, last, settings, wavenumber, loads):
        self.solid, self.settings = solid, settings
        self.period = settings.stretch * last
        self.eta = settings.damping / self.period
        count = int(settings.bandwidth * self.period / (2 * math.pi))
        self.omega = 2 * math.pi / self.period * np.arange(count + 1)
        # one to 1e-12 at rest, 1e-6 at the end, and smooth: a kink of the fields in time is felt
        # at a distance d as exp(-(0.06 bandwidth d)^2)
        width = 0.12 * settings.bandwidth
        self.window = 0.5 * erfc((self.omega - 0.6 * settings.bandwidth) / width)
        self.window[0] *= 0.5
        key = (settings, self.period, wavenumber)
        if key not in loads:
            loads[key] = CachedLoad(force, wavenumber, settings.bandwidth)
        self.load = loads[key]
        self.spectra = {}

    def at(self, r, z, times):
        """The six fields, one row each, at given times."""
        if (r, z) not in self.spectra:
            self.spectra[r, z] = spectrum(self.solid, self.load, r, z, self.eta, self.omega, self.settings)
        terms = self.spectra[r, z] * self.window
        times = np.asarray(times, float)
        found = np.empty((6, len(times)))
        for i, t in enumerate(times):
            found[:, i] = 2 / self.period * math.exp(self.eta * t) * (terms @ np.exp(1j * self.omega * t)).real
        return found


class CachedLoad(Load):
    """Keeps q: every place and solid under one force asks for the same frequencies."""

    def __init__(self, force, wavenumber, bandwidth):
        super().__init__(force, wavenumber, bandwidth)
        self.kept = {}

    def cached(self, part, s):
        key = (part.start, s[0, 0], s.shape[1])
        if key not in self.kept:
            self.kept[key] = self.at(s)
        return self.kept[key]


# ---- rows

def fronts(solid, duration, r, z):
    """Arrivals from the touch and the release: P, S, the head wave and, near the surface, Rayleigh's.

    The edge of the contact is faster than a wave at first and at last: the wave from the near edge comes a little
    before that from the point of touch, and the one from the far edge a little after that from the point of release.
    """
    distance = math.hypot(r, z)
    span = math.sqrt(1 / solid.kappa**2 - 1)
    across = (r / distance) ** 2
    # arrival, speed, squared share of the way that is horizontal
    speeds = [(distance, 1.0, across), (distance / solid.kappa, solid.kappa, across)]
    speeds += [(r + z * span, 1.0, 1.0)] if r * span > z else []
    speeds += [(r / solid.rayleigh, solid.rayleigh, 1.0)] if r > z else []
    touch, release = [], []
    for t, speed, share in speeds:
        # a^2 = (COLLISION/T) t, and the extreme of t - a sqrt(share)/speed
        lead = COLLISION / (4 * duration * speed**2) * share
        touch += [t - lead, t]
        release += [duration + t, duration + t + lead]
    return sorted(touch + release)


def times_of(solid, duration, r, z, clear):
    """From before the first arrival through the waves of touch and release; the middle of the contact between.

    A time that is nearer than `clear` to a front is put off until it is not.
    """
    met = fronts(solid, duration, r, z)
    p = math.hypot(r, z)
    s = p / solid.kappa
    late = max(t for t in met if t < duration)
    early = [max(0.3 * p, met[0] - 1.2 * clear), p + clear, p + 0.8, p + 1.5, s + clear]
    early += [late + clear, late + 1.0, late + 2.5, late + 5.0]
    middle = [0.27 * duration, duration / 2, 0.8 * duration + 1]
    end = [t + duration for t in (0.3 * p, p + clear, p + 1.5, s + clear, late + clear, late + 1.2, late + 4.0)]
    found = []
    for t in early + middle + end:
        for front in met:
            if abs(t - front) < clear and t > p:
                t = front + clear
        found.append(math.ceil(100 * t - 1e-6) / 100)
    found.sort()
    return [t for i, t in enumerate(found) if i == 0 or t - found[i - 1] > 0.12]


def farthest(solid, duration):
    return duration + 6 + max(math.hypot(r, z) / solid.kappa for r, z in PLACES) + 3


def case(solid, duration, places, fine, coarse, loads):
    """Rows of one solid and one duration."""
    force = HertzForce(duration)
    last = max(farthest(Solid(nu), duration) for nu in RATIOS)
    kappa = min(Solid(nu).kappa for nu in RATIOS)
    wavenumber = math.hypot(fine.bandwidth / kappa, 38 / min(z for _, z in PLACES)) + 6
    runs = [Inversion(solid, force, last, x, wavenumber, loads) for x in (fine, coarse)]
    for r, z in places:
        # an error of the coarser run of exp(-16) where kinks are strong
        times = times_of(solid, duration, r, z, 67 / coarse.bandwidth)
        values, other = (run.at(r, z, times) for run in runs)
        record = np.arange(0, last, 0.05)
        peaks = np.abs(runs[1].at(r, z, record)).max(axis=1)
        # on the axis u_r and s_rz vanish
        scale = np.where(peaks > 1e-12, peaks, np.inf)
        errors = (np.abs(values - other) / scale[:, None]).max(axis=0)
        print(f"nu {solid.nu} T {duration:g} r {r} z {z}: median {np.median(errors):.1e}, worst {errors.max():.1e}",
              file=sys.stderr, flush=True)
        for t, row, error in zip(times, values.T, errors):
            if error <= WORST:
                yield [solid.nu, duration, r, z, t, *row, *peaks, error]
            else:
                print(f"  left out: t {t}, error {error:.1e}", file=sys.stderr)


def parameters(duration):
    """Bandwidth by duration: a longer contact starts more gently."""
    wide = {20.0: 320.0, 60.0: 240.0}.get(duration, 120.0)
    return Settings(wide, 1.9, 23.0, 1.0, 2.6), Settings(wide / 1.43, 2.2, 26.0, 0.7, 2.2)


def write(durations):
    done = set()
    if FILE.exists():
        with FILE.open() as file:
            done = {tuple(float(row[c]) for c in COLUMNS[:4]) for row in csv.DictReader(file)}
    else:
        FILE.write_text(",".join(COLUMNS) + "\n")
    for duration in durations:
        fine, coarse = parameters(duration)
        loads = {}
        for nu in RATIOS:
            places = [p for p in PLACES if (nu, duration, *p) not in done]
            for row in case(Solid(nu), duration, places, fine, coarse, loads):
                text = [f"{x:g}" for x in row[:5]] + [f"{x:.14e}" for x in row[5:11]]
                text += [f"{x:.6e}" for x in row[11:17]] + [f"{row[17]:.1e}"]
                with FILE.open("a") as file:
                    file.write(",".join(text) + "\n")


def check_load():
    """q(k, s) of a growing contact against mpmath's quadrature over u^(5/4) = sin(v^5), 25 digits."""
    mpmath.mp.dps = 25
    duration, fifth = 20.0, mpmath.mpf(1) / 5
    load = Load(HertzForce(duration), 100.0, 60.0)
    worst = 0.0
    for k, s in ((0.3 + 0.1j, 0.2 + 0j), (3 + 0.5j, 0.2 + 1j), (20 + 1j, 0.2 + 7j), (70 + 0.7j, 0.3 + 15j)):
        def integrand(v):
            sine = mpmath.sin(v**5)
            t = 2 * fifth * mpmath.betainc(2 * fifth, 0.5, 0, sine**2)
            rate = 4 * v**4 * sine ** (-fifth)
            scale = duration / (4 * fifth * mpmath.beta(2 * fifth, 0.5))
            u = sine ** (4 * fifth)
            x = k * mpmath.sqrt(u)
            hertz = 3 * (mpmath.sin(x) - x * mpmath.cos(x)) / x**3
            both = mpmath.exp(-s * t * scale) + mpmath.exp(-s * (duration - t * scale))
            return u ** mpmath.mpf(1.5) * hertz * both * rate * scale
        end = (mpmath.pi / 2) ** fifth
        expected = complex(mpmath.quad(integrand, [1e-12] + [end * j / 12 for j in range(1, 13)]))
        _, columns, matrix = load.interpolation(np.array([k]))[0]
        error = abs((matrix @ load.at(np.array([[s]]))[columns])[0, 0] - expected)
        worst = max(worst, error)
        print(f"q({k}, {s}): {error:.1e} of {abs(expected):.1e}", flush=True)
    return worst


def check_disc():
    """The same code for a disc of fixed radius under sin^4, against ../golden/fields.csv (1e-10 inside the body)."""
    cases = {}
    with (HERE.parent / "golden" / "fields.csv").open() as file:
        for row in csv.DictReader(line for line in file if not line.startswith("#")):
            row = {name: float(x) for name, x in row.items()}
            if row["z"] > 0:
                cases.setdefault((row["nu"], row["r"], row["z"], row["T0"]), []).append(row)
    worst = 0.0
    for (nu, r, z, duration), rows in cases.items():
        times = [row["t"] for row in rows]
        settings = Settings(40.0 if duration > 15 else 200.0, 2.0, 24.0, 1.0, 2.6)
        wavenumber = math.hypot(settings.bandwidth / Solid(nu).kappa, 38 / z) + 6
        run = Inversion(Solid(nu), FixedDisc(duration), max(max(times), duration), settings, wavenumber, {})
        named = ("u", "w", "srr", "stt", "szz", "srz")
        expected = np.array([[row[name] for row in rows] for name in named])
        error = np.abs(run.at(r, z, times) - expected).max()
        worst = max(worst, error)
        print(f"nu {nu} r {r} z {z} T {duration}: {error:.1e}", flush=True)
    print(f"worst {worst:.1e}")
    return worst


def check_slow():
    """A long contact is static in its middle, but for its acceleration."""
    nu, r, z = 0.25, 0.5, 0.3
    static = np.array([float(x) for x in static_field(mpmath.mpf(nu), mpmath.mpf(r), mpmath.mpf(z))])
    found = []
    for duration in (1000.0, 2000.0):
        settings = Settings(5.0, 1.9, 23.0, 1.0, 2.6)
        wavenumber = math.hypot(settings.bandwidth / Solid(nu).kappa, 38 / z) + 6
        run = Inversion(Solid(nu), HertzForce(duration), duration + 20, settings, wavenumber, {})
        found.append(np.abs(run.at(r, z, [duration / 2])[:, 0] - static).max())
        print(f"duration {duration:g}: {found[-1]:.1e} from the static field", flush=True)
    return found


def checks():
    slow = check_slow()
    return check_load() < 1e-14 and slow[1] < 6e-6 and slow[0] > 3 * slow[1] and check_disc() < 3e-10


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--duration", type=float, nargs="+", default=DURATIONS)
    options = parser.parse_args()
    if options.check:
        sys.exit(0 if checks() else 1)
    write(options.duration)


if __name__ == "__main__":
    main()
