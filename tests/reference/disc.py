"""Impacts on a disc of fixed radius by superposition in time, with all contacts and the energy that they radiate.

    d(t) = u(t) + sigma [e p(t) - int_0^t V((t - t') /theta) p'(t') dt'],   p = u^(3/2),   d'' = -(5/4) p

in collision units (README); e is 1 for the full static share and 0 for the dynamic one.  u is a polynomial on each
element of a mesh that shrinks geometrically toward both ends of a contact; the integral is taken as it stands, split
where a wave front passes; each element is solved by Newton's method.  After a contact the gap between striker and
surface is followed until the surface is at rest, and a contact that it finds is solved in the same way.
V comes from Kausel's closed form (disc_kernel.py).

The radiated energy is not taken from the motion but from the spectrum of the force (Parseval),

    E = (1/pi) int_0^inf w |P(w)|^2 (-Im C(w)) dw,     C the mean compliance of the disc

whatever deflection is in the contact law.  Every row is solved on two meshes; the finer one is written, and the
differences between the two beside it.

    python disc.py            writes rows of disc.csv that are missing
"""

import sys
from pathlib import Path

import numpy as np

from disc_kernel import Admittance, disc

DEGREE = 8
FILE = Path(__file__).parent / "disc.csv"
RESULTS = (
    "peak_force,peak_force_time,contact_time,restitution,loss,peak_displacement,peak_deflection,impulse,"
    "again_time,again_force,radiated"
).split(",")
COLUMNS = ["kind", "nu", "sigma", "theta", "share", "deflection", *RESULTS, "contacts", *("d_" + r for r in RESULTS)]
POLY = np.polynomial.polynomial
G_X, G_W = np.polynomial.legendre.leggauss(12)
FINE_X, FINE_W = np.polynomial.legendre.leggauss(24)


def lobatto(n):
    """Nodes of the Lobatto rule of degree n on [-1, 1]."""
    inner = np.polynomial.legendre.Legendre.basis(n).deriv().roots()
    return np.array([-1.0, *np.sort(inner.real), 1.0])


X = lobatto(DEGREE)
TO_POWERS = np.linalg.inv(POLY.polyvander(X, DEGREE))


def at_places(x):
    """Matrices from the values at the nodes to value and slope at places."""
    value = POLY.polyvander(x, DEGREE) @ TO_POWERS
    powers = np.arange(1, DEGREE + 1)
    slope = (POLY.polyvander(x, DEGREE - 1) * powers) @ TO_POWERS[1:]
    return value, slope


def integrals():
    """First and second integrals from -1 to each node of the polynomial through the nodes."""
    first, second = np.zeros((2, DEGREE + 1, DEGREE + 1))
    for j in range(DEGREE + 1):
        once = POLY.polyint(TO_POWERS[:, j], lbnd=-1)
        first[:, j] = POLY.polyval(X, once)
        second[:, j] = POLY.polyval(X, POLY.polyint(once, lbnd=-1))
    return first, second


FIRST, SECOND = integrals()
OF_GAUSS = at_places(G_X)
SLOPES = at_places(X)[1]


def own_places():
    """Places and weights of int_{-1}^{x_i}, Gauss panels that shrink toward x_i, where V begins; for each node."""
    places = []
    for x in X[1:]:
        ends = x - (x + 1.0) * np.array([1.0, 0.3, 0.09, 0.027, 0.0])
        half = 0.5 * np.diff(ends)[:, None]
        middle = 0.5 * (ends[1:] + ends[:-1])[:, None]
        places.append(((middle + half * G_X).ravel(), (half * G_W).ravel()))
    return places


OWN = own_places()
OWN_MATRICES = [at_places(x) for x, _ in OWN]


class Impact:
    """An impact in the groups sigma and theta (r0/c1 in collision times)."""

    def __init__(self, nu, sigma, theta, share, deflection, grading, longest):
        self.sigma, self.share = sigma, 1.0 if share == "full" else 0.0
        self.kernel = kernel(nu, deflection)
        self.unit = theta / self.kernel.load.kappa  # r0/c2
        self.memory = self.kernel.ends[-1] * self.unit
        self.fronts = self.kernel.fronts * self.unit
        self.grading = grading
        # elements so short that no front lies in the newest one
        self.longest = min(longest, 0.45 * self.fronts[0])
        self.start, self.half, self.u = [], [], []
        self.points, self.rates = [], []  # Gauss points of each element and p' with its weights
        self.contacts = []  # first and last element
        self.time, self.velocity, self.displacement = 0.0, 1.0, 0.0
        self.states = []

    def left(self, times, elements):
        """int V((t - t')/theta) p'(t') dt' over elements, at some times after them."""
        times = np.atleast_1d(times)
        total = np.zeros(len(times))
        if not elements:
            return total
        near = np.array(self.start)[elements]
        far = near + 2 * np.array(self.half)[elements]
        live = [e for e, f in zip(elements, far) if times[0] - f < self.memory]
        if not live:
            return total
        near, far = np.array(self.start)[live], np.array(self.start)[live] + 2 * np.array(self.half)[live]
        lag = times[:, None] - np.array([self.points[e] for e in live]).ravel()
        parts = self.kernel(np.maximum(lag, 0.0) / self.unit) * np.array([self.rates[e] for e in live]).ravel()
        parts = parts.reshape(len(times), len(live), -1).sum(axis=2)
        # elements in which a front has arrived are integrated piece by piece
        for i, t in enumerate(times):
            for k in np.unique(np.concatenate([np.nonzero((t - far < f) & (f < t - near))[0] for f in self.fronts])):
                parts[i, k] = self.split(live[k], t)
        return parts.sum(axis=1)

    def split(self, e, t):
        """The same over one element with fronts in it."""
        start, half = self.start[e], self.half[e]
        places = sorted((t - f - start) / half - 1.0 for f in self.fronts)
        places = [-1.0, *[x for x in places if -1.0 < x < 1.0], 1.0]
        ends = []
        for low, high in zip(places, places[1:]):
            width = 0.5 * (high - low)
            steps = width * 0.15 ** np.arange(8, -1, -1)
            ends += [low, *(low + steps), *(high - steps[-2::-1])]
        ends = np.array(sorted({*ends, 1.0}))
        h = 0.5 * np.diff(ends)[:, None]
        x = (0.5 * (ends[1:] + ends[:-1])[:, None] + h * G_X).ravel()
        value, slope = at_places(x)
        u = np.maximum(value @ self.u[e], 0.0)
        rate = 1.5 * np.sqrt(u) * (slope @ self.u[e])
        lag = np.maximum(t - start - half * (1 + x), 0.0)
        return np.sum((h * G_W).ravel() * rate * self.kernel(lag / self.unit))

    def element(self, h, rate, before):
        """Solves the next element of half length h; u starts from the last value with a rate."""
        t = self.time + h * (1 + X)
        u0 = before
        past = self.left(t[1:], list(range(len(self.start))))
        known = self.displacement + self.velocity * (t - self.time)
        u = np.maximum(u0 + rate * h * (1 + X), 0.01 * u0)
        delays = [self.kernel(h * (x_i - x) / self.unit) * w for x_i, (x, w) in zip(X[1:], OWN)]
        n = DEGREE
        for _ in range(60):
            root = np.sqrt(np.maximum(u, 0.0))
            p = u * root
            d = known - 1.25 * h * h * (SECOND @ p)
            own, by = np.zeros(n), np.zeros((n, n + 1))
            for i, (v, (value, slope)) in enumerate(zip(delays, OWN_MATRICES)):
                at, rise = np.maximum(value @ u, 1e-300), slope @ u
                r = np.sqrt(at)
                own[i] = np.sum(v * 1.5 * r * rise)
                by[i] = (v * 0.75 * rise / r) @ value + (v * 1.5 * r) @ slope
            s = self.sigma
            residual = u[1:] + s * (self.share * p[1:] - past - own) - d[1:]
            matrix = -s * by[:, 1:] + 1.25 * h * h * 1.5 * SECOND[1:, 1:] * root[1:]
            matrix += np.diag(1.0 + s * self.share * 1.5 * root[1:])
            change = np.linalg.solve(matrix, residual)
            over = change > 0.9 * u[1:]
            factor = min(1.0, np.min(0.9 * u[1:][over] / change[over])) if over.any() else 1.0
            u[1:] -= factor * change
            size = np.max(np.abs(change))
            if factor == 1.0 and size < 1e-13 * max(u[n], u0) + 1e-18:
                break
        else:
            if not size < 1e-9 * max(u[n], u0) + 1e-14:
                return None
        return u

    def accept(self, h, u):
        p = np.maximum(u, 0.0) ** 1.5
        self.states.append((self.velocity, self.displacement))
        self.start.append(self.time)
        self.half.append(h)
        self.u.append(u)
        value, slope = OF_GAUSS
        self.points.append(self.time + h * (1 + G_X))
        self.rates.append(G_W * 1.5 * np.sqrt(np.maximum(value @ u, 0.0)) * (slope @ u))
        self.displacement += 2 * h * self.velocity - 1.25 * h * h * (SECOND @ p)[-1]
        self.velocity -= 1.25 * h * (FIRST @ p)[-1]
        self.time += 2 * h

    def contact(self, rate):
        """One contact from a touch with a rate of indentation on; false where it has no solution."""
        first = len(self.start)
        began = self.time
        h, before, top = 5e-11, 0.0, 0.0
        while True:
            u = self.element(h, rate, before)
            if u is None or len(self.start) > 8000:
                return False
            self.accept(h, u)
            before, rate = u[-1], (SLOPES @ u)[-1] / h
            top = max(top, before)
            if before < 1e-11 * top or (rate < 0 and -before / rate < 1e-12):
                break
            h = 0.5 * min(self.longest, self.grading * (self.time - began))
            if rate < 0:
                h = min(h, 0.5 * self.grading * before / -rate)
        rest = before / -rate
        self.time += rest
        self.displacement += rest * self.velocity
        self.contacts.append((first, len(self.start), began, self.time))
        return True

    def surface(self, t):
        """Deflection of the unloaded surface."""
        return -self.sigma * self.left(t, list(range(len(self.start))))

    def next_touch(self):
        """Time at which the surface meets the striker again, and the rate of indentation there."""
        t0, v, d = self.time, self.velocity, self.displacement

        def gap(t):
            return d + v * (t - t0) - self.surface(np.array([t]))[0]

        quiet = self.time - self.contacts[-1][3] + self.memory
        times = t0 + quiet * np.concatenate([np.geomspace(1e-5, 0.02, 40), np.linspace(0.02, 1.0, 300)[1:]])
        opened = False
        low = t0
        for t in times:
            if gap(t) > 0.0 and opened:
                high = t
                for _ in range(200):
                    middle = 0.5 * (low + high)
                    low, high = (middle, high) if gap(middle) <= 0 else (low, middle)
                at = 0.5 * (low + high)
                step = 1e-6 * self.memory
                rate = (gap(at + step) - gap(at - step)) / (2 * step)
                return at, rate
            opened |= gap(t) < 0.0
            low = t
        if v > 0:
            return t0 - d / v, v
        return None

    def run(self):
        rate = 1.0
        while True:
            if not self.contact(rate):
                return False
            found = self.next_touch()
            if found is None:
                return True
            at, rate = found
            self.displacement += self.velocity * (at - self.time)
            self.time = at

    def solution(self):
        """Places of all elements in time, with u and the displacement, by a fine rule."""
        value, _ = at_places(FINE_X)
        half = np.array(self.half)
        t = np.array(self.start)[:, None] + half[:, None] * (1 + FINE_X)
        u = np.maximum(np.array(self.u) @ value.T, 0.0)
        return t, half[:, None] * FINE_W, u**1.5

    def results(self, admittance, theta, sigma_mean):
        """In the order of RESULTS, and the number of contacts."""
        peaks = [self.largest(*span[:2]) for span in self.contacts]
        top = max(force for force, _, _, _ in peaks)
        real = [i for i, peak in enumerate(peaks) if peak[0] > 1e-6 * top]
        again = self.contacts[real[1]][2] if len(real) > 1 else 0.0
        again_force = peaks[real[1]][0] if len(real) > 1 else 0.0
        force, force_time = max((peak[0], peak[1]) for peak in peaks)
        v = self.velocity
        first = self.contacts[0]
        values = [force, force_time, first[3] - first[2], -v, (1 - v) * (1 + v)]
        values += [max(p[2] for p in peaks), max(*(p[3] for p in peaks), self.free_deflection())]
        values += [(1 - v) / 1.25, again, again_force, self.radiated(admittance, theta, sigma_mean)]
        return np.array(values), len(real)

    def free_deflection(self):
        """Largest deflection of the surface in the time after the first contact."""
        end = self.contacts[0][3]
        stop = self.contacts[1][2] if len(self.contacts) > 1 else end + self.memory
        return np.max(self.surface(np.linspace(end, stop, 400)[1:-1]))

    def largest(self, first, last):
        """Largest force, its time, largest displacement and deflection over a contact."""
        found = []
        fine = np.linspace(-1, 1, 65)
        value, _ = at_places(fine)
        for e in range(first, last):
            u = self.u[e]
            p = np.maximum(u, 0.0) ** 1.5
            v, d = self.states[e]
            h = self.half[e]
            d_nodes = d + v * h * (1 + X) - 1.25 * h * h * (SECOND @ p)
            rows = [u, d_nodes, d_nodes - u]
            maxima = []
            for row in rows:
                k = int(np.argmax(value @ row))
                low, high = fine[max(k - 1, 0)], fine[min(k + 1, 64)]
                c = TO_POWERS @ row
                dc = POLY.polyder(c)
                if POLY.polyval(low, dc) > 0 > POLY.polyval(high, dc):
                    for _ in range(100):
                        middle = 0.5 * (low + high)
                        low, high = (middle, high) if POLY.polyval(middle, dc) > 0 else (low, middle)
                    place = 0.5 * (low + high)
                else:
                    place = fine[k]
                maxima.append((POLY.polyval(place, c), self.start[e] + h * (1 + place)))
            found.append(maxima)
        u = max(m[0] for m in found)
        return u[0] ** 1.5, u[1], max(m[1][0] for m in found), max(m[2][0] for m in found)

    def radiated(self, admittance, theta, sigma_mean):
        """Energy over the kinetic energy before, from the spectrum of the force."""
        t, weights, p = self.solution()
        t, parts = t.ravel(), (weights * p).ravel()
        duration = t[-1]
        total, panel = 0.0, 2 * np.pi / duration
        # the integrand falls with the fifth power beyond the first few panels
        for k in range(400):
            omega = panel * (k + 0.5 + 0.5 * FINE_X)
            spectrum = np.abs(np.exp(-1j * np.outer(omega, t)) @ parts) ** 2
            part = 0.5 * panel * np.sum(FINE_W * omega * spectrum * admittance(omega * theta))
            total += part
            if k > 40 and part * (k + 1) / 4 < 1e-10 * total:
                break
        # in units of sigma: the compliance over its static value
        return 2.5 * sigma_mean / admittance.static * total / np.pi


KERNELS = {}


def kernel(nu, deflection):
    if (nu, deflection) not in KERNELS:
        KERNELS[nu, deflection] = disc(nu, deflection)
    return KERNELS[nu, deflection]


def solve(nu, sigma, theta, share, deflection, grading, longest):
    """Results and number of contacts; nothing where the march finds no solution."""
    impact = Impact(nu, sigma, theta, share, deflection, grading, longest)
    if not impact.run():
        return None
    admittance = Admittance(nu)
    admittance.static = 0.3 * (1 - nu)
    of_mean = sigma if deflection == "mean" else 0.8 * sigma
    return impact.results(admittance, theta, of_mean)


def random_case(draw):
    """nu, sigma, theta, share and deflection; the half-space remembers a fiftieth of the contact to all of it."""

    def log(low, high):
        return low * (high / low) ** draw.random()

    nu = 0.48 * draw.random()
    share = "full" if draw.random() < 0.6 else "dynamic"
    deflection = "mean" if draw.random() < 0.6 else "centre"
    sigma = log(0.01, 4.0) if share == "full" else log(0.01, 0.4)
    memory = log(0.02, 1.0) * 3.0
    kappa = np.sqrt((1 - 2 * nu) / (2 - 2 * nu))
    theta = memory * kappa / (2.2 if deflection == "mean" else 1.1)
    return nu, sigma, theta, share, deflection


# found by scanning the groups; each has more than one contact
AGAIN = [
    (0.45, 6.774, 1.431, "full", "mean"),
    (0.45, 8.948, 1.775, "full", "mean"),
    (0.45, 8.049, 1.501, "full", "mean"),
    (0.1, 4.677, 2.58, "full", "centre"),
    (0.1, 3.061, 2.127, "full", "centre"),
    (0.3, 4.892, 2.374, "full", "centre"),
    (0.3, 3.618, 1.98, "full", "centre"),
    (0.45, 3.966, 1.233, "full", "centre"),
    (0.45, 2.859, 1.009, "full", "centre"),
]

# an epoxy tip of 12.6 mg, radius 38.3 mm, on silver at 0.529 m/s with a disc of 1.0007 mm
SCENES = [(0.367, 0.010543399636966464, 0.07887134299306534, "full", "centre")]


def cases():
    draw = np.random.default_rng(5)
    for _ in range(40):
        yield ("random", *random_case(draw))
    for case in AGAIN:
        yield ("again", *case)
    for case in SCENES:
        yield ("scene", *case)


def main():
    known = FILE.read_text().splitlines()[1:] if FILE.exists() else []
    have = {",".join(line.split(",")[:6]) for line in known}
    if not FILE.exists():
        FILE.write_text(",".join(COLUMNS) + "\n")
    for kind, nu, sigma, theta, share, deflection in cases():
        nu, sigma, theta = (float(f"{x:.12g}") for x in (nu, sigma, theta))
        key = f"{kind},{nu!r},{sigma!r},{theta!r},{share},{deflection}"
        if key in have:
            continue
        found = [solve(nu, sigma, theta, share, deflection, *mesh) for mesh in ((0.25, 0.06), (0.18, 0.045))]
        if None in found or found[0][1] != found[1][1]:
            print("not resolved:", key, flush=True)
            continue
        (coarse, _), (fine, contacts) = found
        line = ",".join(
            [key, *(f"{x:.14g}" for x in fine), str(contacts), *(f"{x:.0e}" for x in np.abs(fine - coarse))]
        )
        print(line, flush=True)
        with FILE.open("a") as file:
            file.write(line + "\n")


if __name__ == "__main__":
    main()
