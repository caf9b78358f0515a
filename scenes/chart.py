"""Draws lines, bands and points as an SVG picture with NumPy alone, for the worked cases.

    chart("picture.svg", "title", dict(x="time [s]", y="force [N]", log="", series=[("line", "force", time, force)]))

Each panel is a dictionary: labels of its axes, logarithmic axes ("", "x", "y" or "xy"), perhaps `limits` of y, and series. A
series has a kind, a name for the legend ("" for none) and its numbers: "line", "dashed" or "points" with x and y, "band" with
x and two ends, "at" with one x.
"""

from html import escape

import numpy as np

WIDTH, HEIGHT, LEFT, RIGHT, GAP = 760, 270, 72, 14, 62
COLOURS = ["#0b5394", "#c1272d", "#e69f00", "#1b7a4b", "#7a3699", "#555555"]


def ticks(low, high, logarithmic):
    """About six round numbers between two limits."""
    if logarithmic:
        decades = range(int(np.floor(np.log10(low))), int(np.ceil(np.log10(high))) + 1)
        steps = (1,) if high > 1e4 * low else (1, 3) if high > 300 * low else (1, 2, 5) if high > 40 * low else (1, 2, 3, 5)
        found = np.array([s * 10.0**d for d in decades for s in steps])
    else:
        step = 10.0 ** np.floor(np.log10((high - low) / 3))
        step *= next(m for m in (1, 2, 5, 10) if (high - low) / (m * step) <= 7)
        found = np.round((np.arange(np.ceil(low / step), np.floor(high / step + 1e-9) + 1)) * step, 12)
    return found[(found >= low * (1 - 1e-9) if low > 0 else found >= low) & (found <= high * (1 + 1e-9))]


def scale(values, limits, logarithmic, start, end):
    low, high, values = (np.log10(v) if logarithmic else np.asarray(v, float) for v in (*limits, values))
    return start + (values - low) / (high - low) * (end - start)


def text(x, y, words, anchor="middle", size=13, more=""):
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" font-size="{size}" {more}>{escape(words)}</text>'


def label(tick):
    return f"{tick + 0.0:.6g}".replace("-", "\N{MINUS SIGN}")


def points(x, y):
    return " ".join(f"{a:.2f},{b:.2f}" for a, b in zip(x, y))


def panel(number, top, spec):
    """The elements of one panel."""
    log, series = spec.get("log", ""), spec["series"]
    ends = [np.concatenate([np.ravel(s[i]) for s in series if s[0] != "at" for i in columns]) for columns in ((2,), (-1, 3))]
    x_limits, y_limits = ((found.min(), found.max()) for found in ends)
    if "y" in log:
        y_limits = y_limits[0] / 1.15, y_limits[1] * 1.15
    else:
        room = 0.06 * (y_limits[1] - y_limits[0])
        y_limits = y_limits[0] - room, y_limits[1] + room
    y_limits = spec.get("limits", y_limits)
    bottom, right = top + HEIGHT, WIDTH - RIGHT
    to_x = lambda v: scale(v, x_limits, "x" in log, LEFT, right)  # noqa: E731
    to_y = lambda v: np.clip(scale(v, y_limits, "y" in log, bottom, top), top - 999, bottom + 999)  # noqa: E731
    out = [f'<clipPath id="panel{number}"><rect x="{LEFT}" y="{top}" width="{right - LEFT}" height="{HEIGHT}"/></clipPath>']
    for tick in ticks(*x_limits, "x" in log):
        out += [f'<path class="grid" d="M{to_x(tick):.1f} {top}V{bottom}"/>', text(to_x(tick), bottom + 18, label(tick))]
    for tick in ticks(*y_limits, "y" in log):
        out += [f'<path class="grid" d="M{LEFT} {to_y(tick):.1f}H{right}"/>', text(LEFT - 8, to_y(tick) + 4.5, label(tick), "end")]
    keys, out = [], [*out, f'<g clip-path="url(#panel{number})">']
    for (kind, name, *data), colour in zip(series, spec.get("colours", COLOURS)):
        line = f'fill="none" stroke="{colour}" stroke-width="1.6"' + (' stroke-dasharray="7 4"' if kind in ("dashed", "at") else "")
        fill = f'fill="{colour}" fill-opacity="0.25"'
        if kind == "at":
            out.append(f'<path {line} d="M{to_x(data[0]):.2f} {top}V{bottom}"/>')
        elif kind == "points":
            out += [f'<circle fill="{colour}" r="2.6" cx="{a:.2f}" cy="{b:.2f}"/>' for a, b in zip(to_x(data[0]), to_y(data[1]))]
        else:
            x, y = to_x(data[0]), [to_y(values) for values in data[1:]]
            if kind == "band":
                out.append(f'<polygon {fill} points="{points([*x, *x[::-1]], [*y[0], *y[1][::-1]])}"/>')
            else:
                out.append(f'<polyline {line} points="{points(x, y[0])}"/>')
        mark = {"band": f'<rect {fill} x="-30" y="-9" width="24" height="10"/>', "points": f'<circle fill="{colour}" r="2.6" cx="-18" cy="-4"/>'}
        if name:
            keys.append((name, mark.get(kind, f'<path {line} d="M-30 -4H-6"/>')))
    out += ["</g>", f'<rect class="frame" x="{LEFT}" y="{top}" width="{right - LEFT}" height="{HEIGHT}"/>']
    wide, corner = 46 + 7.2 * max((len(name) for name, _ in keys), default=0), spec.get("legend", "top right")
    x = right - wide - 8 if "right" in corner else LEFT + 8
    y = top + 8 if "top" in corner else bottom - 8 - 19 * len(keys)
    if keys:
        out.append(f'<rect class="key" x="{x:.1f}" y="{y}" width="{wide:.1f}" height="{19 * len(keys)}"/>')
    for i, (name, mark) in enumerate(keys):
        out.append(f'<g transform="translate({x + 38:.1f} {y + 14 + 19 * i})">{mark}{text(0, 0, name, "start")}</g>')
    middle = (LEFT + right) / 2, top + HEIGHT / 2
    turned = f'transform="rotate(-90 18 {middle[1]})"'
    return [*out, text(middle[0], bottom + 40, spec["x"], size=14), text(18, middle[1], spec["y"], size=14, more=turned)]


def chart(path, title, *panels):
    top, out = 44, []
    for number, spec in enumerate(panels):
        out += panel(number, top, spec)
        top += HEIGHT + GAP
    style = "text{font-family:Ubuntu,Helvetica,Arial,sans-serif;fill:#111}.grid{stroke:#e3e3e3}.frame{fill:none;stroke:#111}.key{fill:#fff;fill-opacity:0.85}"
    head = f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{top}" viewBox="0 0 {WIDTH} {top}"><style>{style}</style>'
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join([head, '<rect width="100%" height="100%" fill="#fff"/>', text(LEFT, 26, title, "start", 17), *out, "</svg>\n"]))
