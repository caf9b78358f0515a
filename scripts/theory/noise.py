"""Noise of many impacts: the response as a function of frequency times distance, and Campbell's theorem."""

import numpy as np

from theory.attenuation import response


def check(report):
    """(T81) and (T82)."""
    r, z, omega, quality = 1.3, 0.6, 2.1, 8.0
    g = np.arctan(1 / quality) / np.pi
    worst = 0
    for frequency in (0.4, 2.1, 5.0):
        factor = (1j * frequency / 0.7) ** (2 * g)
        size = abs(factor)
        unit = frequency / np.sqrt(size)
        scaled = unit / size * response(unit * r, unit * z, 1.0, factor / size)[:2]
        worst = max(worst, np.max(abs(scaled / response(r, z, frequency, factor)[:2] - 1)))
    report.row("T81", "damped response at three frequencies by the function of omega r/c and omega z/c", worst, 1e-9)

    # pulses sin^(3/2) of random height and duration, at random times, through an oscillator
    random = np.random.default_rng(1)
    count, step, rate = 1 << 20, 0.02, 0.5
    duration = count * step
    events = random.poisson(rate * duration)
    times, heights, lengths = random.uniform(0, duration, events), random.exponential(size=events), random.uniform(1, 2, events)
    force = np.zeros(count)
    inside = np.arange(int(2 / step) + 2)
    for time, height, length in zip(times, heights, lengths):
        first = int(np.ceil(time / step))
        phase = ((first + inside) * step - time) / length
        force[(first + inside) % count] += height * np.sin(np.pi * np.clip(phase, 0, 1)).clip(0) ** 1.5
    frequency = np.fft.rfftfreq(count, step)[1:]
    green = 1 / ((2 * np.pi * 0.3) ** 2 - (2 * np.pi * frequency) ** 2 + 2j * frequency)
    found = 2 / duration * abs(green * step * np.fft.rfft(force)[1:]) ** 2
    nodes, weights = np.polynomial.legendre.leggauss(200)
    own = 0.5 + 0.5 * nodes
    band = np.linspace(0.02, 0.8, 40)
    mean = 0
    for length in np.linspace(1, 2, 101):
        pulse = length * np.sum(0.5 * weights * np.sin(np.pi * own) ** 1.5 * np.exp(-2j * np.pi * np.outer(band, length * own)), axis=1)
        mean = mean + (0.5 if length in (1, 2) else 1) * abs(pulse) ** 2 / 100
    # the mean square of an exponential height is two
    density = 2 * rate * 2 * mean * np.interp(band, frequency, abs(green) ** 2)
    averaged = [found[abs(frequency - f) < 0.01].mean() for f in band]
    report.row("T82", "Campbell's spectrum against superposed pulses, in bands", np.sqrt(np.mean((averaged / density - 1) ** 2)), 0.1)
