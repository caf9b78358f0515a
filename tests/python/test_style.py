"""The style of the package's pictures is that of the command's: colours, sizes of texts, grid."""

import json
import re

from conftest import ROOT, run

STYLE = (ROOT / "python" / "hertzlamb" / "style.mplstyle").read_text(encoding="utf-8")
SWEEP = """[scene.striker]
shape = "ball"
material = "steel"
diameter_m = 0.01
[scene.contact]
model = "hertz"
[product.target]
material = {}
[product.striker]
velocity_m_s = [1.0, 2.0, 3.0]
"""


def of(key):
    """What the style says, without matplotlib."""
    return re.search(rf"^{re.escape(key)}: *(.*)$", STYLE, re.M)[1]


def test_the_style_is_that_of_the_command(tmp_path):
    listed = run("materials", "metal", "--json")
    names = [row["name"] for row in json.loads(listed.stdout) if row["density_kg_m3"]][:10]
    assert len(names) == 10
    (tmp_path / "sweep.toml").write_text(SWEEP.format(json.dumps(names)))
    for words in (["sweep", "sweep.toml", "-o", "s.h5"], ["plot", "s.h5", "--quantity", "peak_force_n", "-o", "s.svg"]):
        done = run(*words, cwd=tmp_path)
        assert done.returncode == 0, done.stderr
    drawn = (tmp_path / "s.svg").read_text(encoding="utf-8")
    strokes = list(dict.fromkeys(re.findall(r'stroke="#([0-9a-f]{6})"', drawn)))
    colours = re.findall(r'"([0-9a-f]{6})"', of("axes.prop_cycle"))
    curves = [colour for colour in strokes if colour in colours]
    assert curves == colours
    others = set(strokes) - set(colours)
    assert others - {of("legend.edgecolor")} == {of("axes.edgecolor"), of("grid.color")}
    # pixels are 3/4 of a point
    sizes = {float(size) * 1000 for size in re.findall(r'scale\(([0-9.]+)\)"', drawn)}
    told = {float(of(key)) / 0.75 for key in ("font.size", "axes.labelsize", "legend.fontsize", "figure.titlesize")}
    assert all(min(abs(size - other) for other in sizes) < 0.01 for size in told), (sizes, told)
