# SPDX-License-Identifier: GPL-3.0-or-later
"""The picture of docs/parts.md: docs/images/even.svg, a hill with a hole at three places of the dial. NumPy alone.

Colours: how much denser (blue) or sparser (red) the texels are than in the mean.
"""

import json
import subprocess
import tempfile
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
OUT = ROOT / "docs" / "images" / "even.svg"
SIZE = 300
DIAL = ((0, "0: conformal"), (0.3, "0.3"), (1, "1: true to size"))
LEVELS = np.linspace(-1, 1, 11)  # of log density


def hill():
    angle, out = (k.ravel() for k in np.meshgrid(np.arange(72) * np.pi / 36, np.linspace(0.08, 1, 26), indexing="ij"))
    x, y = out * np.cos(angle), out * np.sin(angle)
    points = np.stack([x, y, 1.2 * np.exp(-4 * ((x - 0.3) ** 2 + y**2))], axis=1)
    i, j = (k.ravel() for k in np.meshgrid(np.arange(72), np.arange(25), indexing="ij"))
    a, b = i * 26 + j, (i + 1) % 72 * 26 + j
    return points, np.concatenate([np.stack([a, a + 1, b + 1], 1), np.stack([a, b + 1, b], 1)])


def mapped(points, faces, *options):
    """UVs (V, 2), and the report."""
    with tempfile.TemporaryDirectory() as folder:
        mesh, out, report = (Path(folder) / name for name in ("in.obj", "out.obj", "out.json"))
        lines = ["v {} {} {}".format(*p) for p in points] + ["f {} {} {}".format(*f) for f in faces + 1]
        mesh.write_text("\n".join(lines) + "\n", encoding="ascii")
        command = [ROOT / "build" / "koebe", "uniformize", mesh, out, *options, "--json", report, "--quiet"]
        subprocess.run(command, check=True)
        places = [line.split()[1:3] for line in out.read_text(encoding="ascii").splitlines() if line.startswith("vt ")]
        return np.array(places, float), json.loads(report.read_text(encoding="ascii"))


def log_density(uv, points, faces):
    a, b = (points[faces[:, k]] - points[faces[:, 0]] for k in (1, 2))
    area = 0.5 * np.linalg.norm(np.cross(a, b), axis=1)
    a, b = (uv[faces[:, k]] - uv[faces[:, 0]] for k in (1, 2))
    u = 0.5 * np.log(0.5 * (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]) / area)
    return u - np.average(u, weights=area)


def colour(level):
    """White in the mean, blue where texels are dense, red where they are few."""
    pale = round(255 * (1 - 0.75 * min(abs(level), 1)))
    return f"rgb({pale},{pale},255)" if level > 0 else f"rgb(255,{pale},{pale})"


def main():
    points, faces = hill()
    svg = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {3 * SIZE} {SIZE + 40}" font-family="sans-serif">']
    for k, (even, words) in enumerate(DIAL):
        uv, report = mapped(points, faces, "--even", str(even))
        u, at = log_density(uv, points, faces), np.round(uv * (SIZE - 20) + 10, 1)
        svg.append(f'<g transform="translate({k * SIZE} 0)">')
        for level in LEVELS:
            chosen = faces[np.abs(u - level) <= 0.1] if abs(level) < 1 else faces[u * level > 0.9]
            path = "".join("M{} {}L{} {}L{} {}z".format(*at[face].ravel()) for face in chosen)
            if path:
                svg.append(f'<path fill="{colour(level)}" stroke="#8892a6" stroke-width="0.3" d="{path}"/>')
        angle, sd = report["angle_error_deg"]["mean"], report["area_distortion"]["log_sd"]
        svg.append(f'<text x="{SIZE / 2}" y="{SIZE + 12}" text-anchor="middle" font-size="15">E = {words}</text>')
        told = f"angle error {angle:.1f}°, sd of log area {sd:.2f}"
        svg.append(f'<text x="{SIZE / 2}" y="{SIZE + 32}" text-anchor="middle" font-size="13">{told}</text></g>')
    OUT.write_text("\n".join([*svg, "</svg>"]) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
