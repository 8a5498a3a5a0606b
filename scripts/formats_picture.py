# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/images/labs_formats.jpg: a made hemisphere in FreeSurfer's files, laid on the disk, and read from GIfTI and VTK.

PYTHONPATH=build/python build/venv-labs/bin/python scripts/formats_picture.py
"""

import contextlib
import sys
import tempfile

import koebe
import matplotlib.pyplot as plt
import meshio
import nibabel
import numpy as np
import saved_figure
from fit_picture import ROOT
from matplotlib.collections import PolyCollection
from matplotlib.colors import Normalize, to_rgb

sys.path.append(str(ROOT / "bench"))

import uv_measures  # noqa: E402
from atrium_templates import ball  # noqa: E402

AXES = np.array([36.0, 82.0, 56.0])  # of the ellipsoid, mm
FLAT = 0.3  # of its inner half
WAVELENGTH, FOLDS = 17.0, 3.0  # of the folds, mm, and their height
COLORS = np.array(
    [to_rgb(c) for c in ("#86a8d6", "#e08a78", "#7fb492", "#e8c36a", "#b497cf", "#6fc0c4", "#d99ac0", "#a9b86a")]
)  # of the areas
WALL, INK = np.array([0.80, 0.81, 0.83]), "#1b2a41"
LIGHT = np.array([-0.36, 0.56, 0.75])
EVEN = 0.8
HEIGHT = 68.0  # half of that of a drawing, mm: the disk is drawn smaller than it is


def hemisphere(random):
    """A left hemisphere, x to the right, y to the front, z up: vertices (V, 3) in mm, triangles (F, 3), and at the
    vertices the depth in mm, whether they are of the wall, and the area."""
    directions, triangles = ball(6)
    inner = directions[:, 0] > 0.0
    axes = np.where(inner[:, None], AXES * [FLAT, 1.0, 1.0], AXES)
    base, normal = directions * axes, directions / axes
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    waves = random.normal(size=(60, 3))
    waves *= 2.0 * np.pi / WAVELENGTH / np.linalg.norm(waves, axis=1, keepdims=True)
    folds = np.tanh(0.3 * np.cos(base @ waves.T + random.uniform(0.0, 2.0 * np.pi, 60)).sum(axis=1))
    _, y, z = directions.T
    along = 0.5 * (0.35 - y) - (z + 0.12)
    fissure = np.exp(-((along / 0.08) ** 2) - ((y - 0.15) / 0.55) ** 4) * ~inner  # above the temporal lobe
    from_wall = np.hypot(base[:, 1] / 30.0, (base[:, 2] + 4.0) / 15.0)
    smooth = np.where(inner, np.clip(3.0 * (from_wall - 1.0), 0.0, 1.0), 1.0)
    height = smooth * (FOLDS * folds * (1.0 - fissure) - 11.0 * fissure)
    bent = base + 4.0 * np.stack([np.cos(0.25 * base @ wave) for wave in waves[:3]], axis=1)
    seeds = [int(np.argmax(y))]
    while len(seeds) < len(COLORS):
        seeds.append(int(np.argmax(np.linalg.norm(base[:, None] - base[seeds], axis=2).min(axis=1))))
    areas = np.linalg.norm(bent[:, None] - bent[seeds], axis=2).argmin(axis=1)
    return base + height[:, None] * normal, triangles, -height, inner & (from_wall < 1.0), areas


def write(points, triangles, depth, wall, areas):
    """As FreeSurfer writes them: lh.white, lh.sulc, lh.areas.annot and lh.cortex.label."""
    nibabel.freesurfer.write_geometry("lh.white", points, triangles)
    koebe.write_field("lh.sulc", depth)
    koebe.write_field("lh.areas.annot", np.where(wall, -1, areas), colors={k: (*c, 1.0) for k, c in enumerate(COLORS)})
    rows = [f"{v} {x:.3f} {y:.3f} {z:.3f} 0.0" for v, (x, y, z) in enumerate(points) if not wall[v]]
    with open("lh.cortex.label", "w", encoding="ascii") as file:
        file.write("\n".join(["#!ascii label", str(len(rows)), *rows, ""]))


def normals(points, triangles):
    """Unit normals (F, 3) of the faces, smoothed at the vertices."""
    a, b, c = points[triangles].transpose(1, 0, 2)
    sums = np.zeros_like(points)
    np.add.at(sums, triangles.ravel(), np.repeat(np.cross(b - a, c - a), 3, axis=0))
    sums = (sums / np.maximum(np.linalg.norm(sums, axis=1, keepdims=True), 1e-300))[triangles].mean(axis=1)
    return sums / np.linalg.norm(sums, axis=1, keepdims=True)


def draw(axes, points, triangles, color, title):
    """Faces in colours (F, 3) from along z, the nearest last."""
    corners = points[triangles]
    order = np.argsort(corners[:, :, 2].mean(axis=1))
    order = order[uv_measures.signed_areas(corners[order, :, :2]) > 0.0]
    color = np.clip(color[order], 0.0, 1.0)
    axes.add_collection(PolyCollection(corners[order, :, :2], facecolors=color, edgecolors=color, linewidths=0.3))
    middle, half = (points[:, :2].max(axis=0) + points[:, :2].min(axis=0)) / 2, np.ptp(points[:, 0]) / 2 + 1.0
    axes.set(xlim=(middle[0] - half, middle[0] + half), ylim=(middle[1] - HEIGHT, middle[1] + HEIGHT))
    axes.set_aspect("equal")
    axes.set_axis_off()
    axes.set_title(title, fontsize=8.5, color=INK, pad=6)


def draw_side(axes, surface, color, side, title):
    """The surface from outside or inside, the light from the upper left."""
    points, triangles = surface
    points = np.stack([side * points[:, 1], points[:, 2], side * points[:, 0]], axis=1)
    light = np.clip(normals(points, triangles) @ LIGHT, 0.0, 1.0)[:, None]
    draw(axes, points, triangles, color * (0.42 + 0.66 * light), title)


def main():
    made = hemisphere(np.random.default_rng(4))
    with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
        write(*made)
        surface, depth = nibabel.freesurfer.read_geometry("lh.white"), koebe.read_field("lh.sulc").values
        region, labels = koebe.read_region("lh.cortex.label", len(depth)), koebe.read_field("lh.areas.annot")
        result = koebe.uniformize("lh.white", mask=~region, even=EVEN)
        result.export("lh.disk.surf.gii")
        result.export("lh.disk.vtu")
        koebe.write_field("lh.areas.label.gii", labels)
        disk, triangles = (array.data for array in nibabel.load("lh.disk.surf.gii").darrays)
        again, vtk = koebe.read_field("lh.areas.label.gii"), meshio.read("lh.disk.vtu")
    assert (region == ~made[3]).all() and (again.values == labels.values).all()
    assert (labels.values[region] == made[4][region]).all() and not result.flipped
    print(result, f"points differ by {np.abs(vtk.points - made[0]).max():.2g} mm")
    whole, scale = surface[1], vtk.point_data["koebe_log_scale"]
    radius = np.linalg.norm(disk, axis=1).max()  # mm: the disk has the surface's area
    area = 2.0 * (scale + np.log(radius)) / np.log(2.0)  # log2 of a vertex's area on the disk over that on the surface
    shades = np.array([again.colors[k][:3] for k in range(len(COLORS))])
    colors = plt.cm.ScalarMappable(Normalize(-1.0, 1.0), "RdBu_r")

    def painted(faces, values):
        """Colours (F, 3) of the areas; grey on the wall."""
        middle = np.sort(values[faces], axis=1)[:, 1]
        return np.where((values[faces] < 0).any(axis=1)[:, None], WALL, shades[middle])

    def scaled(faces):
        value = area[faces].mean(axis=1)
        return np.where(np.isnan(value)[:, None], WALL, colors.to_rgba(np.nan_to_num(value))[:, :3])

    def turned(places):
        """The disk (V, 2), the front to the left, as on the surface."""
        place = places @ [1, 1j]
        place *= -0.97 * HEIGHT / np.nanmax(np.abs(place)) / np.exp(1j * np.angle(place[np.argmax(made[0][:, 1])]))
        return np.stack([place.real, place.imag, 0.0 * place.real], axis=1)[triangles].reshape(-1, 3)

    figure, axes = plt.subplots(2, 3, figsize=(9.6, 5.6), dpi=100, layout="constrained", width_ratios=[1.2, 1, 1.2])
    for row, (side, read, written) in enumerate(((-1.0, "in: lh.white, lh.areas.annot", "out: lh.disk.vtu"),
                                                 (1.0, "in: lh.cortex.label", "out: lh.disk.vtu"))):  # fmt: skip
        draw_side(axes[row, 0], surface, painted(whole, labels.values), side, read)
        draw_side(axes[row, 2], (vtk.points, whole), scaled(whole), side, written)
    low, high = np.percentile(depth, [5, 95])
    deep = np.clip((depth - low) / (high - low), 0.0, 1.0)[triangles].mean(axis=1)[:, None]
    split = np.arange(3 * len(triangles)).reshape(-1, 3)
    draw(axes[0, 1], turned(disk[:, :2]), split, painted(triangles, again.values) * (1.08 - 0.35 * deep),
         "out: lh.disk.surf.gii, lh.areas.label.gii")  # fmt: skip
    draw(axes[1, 1], turned(vtk.point_data["koebe_uv"][:, :2] - 0.5), split, scaled(triangles), "out: lh.disk.vtu")
    bar = figure.colorbar(colors, ax=axes[1, 2], shrink=0.7, aspect=18, ticks=[-1, 0, 1])
    bar.ax.set_yticklabels(["half", "true", "twice"], fontsize=7)
    bar.set_label("area on the disk", fontsize=8)
    figure.savefig(saved_figure.IMAGES / "labs_formats.jpg", pil_kwargs={"quality": 85})


if __name__ == "__main__":
    main()
