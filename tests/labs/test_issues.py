"""docs/data/issues_answered.csv: each line of code runs, and what the last column says of its value `_` is true."""

import csv
from pathlib import Path

import koebe
import nibabel
import numpy as np
import pyvista
import trimesh
from nilearn.datasets import fetch_surf_fsaverage

ROOT = Path(__file__).resolve().parents[2]
ASKED = {"nilearn", "pycortex", "mne-python", "trimesh", "pyvista", "SlicerSALT", "libigl", "scikit-bio"}


def signed(corners):
    (ux, uy), (vx, vy) = (corners[:, 1] - corners[:, 0]).T, (corners[:, 2] - corners[:, 0]).T
    return 0.5 * (ux * vy - uy * vx)


def area(result):
    a, b, c = result.vertices[result.triangles].transpose(1, 0, 2)
    return 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1).sum()


def half_cylinder():
    angle, height = np.meshgrid(np.linspace(0, np.pi, 9), np.linspace(0, 1, 5))
    corner = np.arange(4)[:, None] * 9 + np.arange(8)
    quads = np.stack([corner, corner + 1, corner + 10, corner + 9], axis=-1).reshape(-1, 4)
    points = np.stack([np.cos(angle), np.sin(angle), height], axis=-1).reshape(-1, 3)
    return points, np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])


def test_the_lines_run_and_give_what_they_say(tmp_path, monkeypatch):
    with open(ROOT / "docs" / "data" / "issues_answered.csv", encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 25 and {row["issue"].partition("#")[0].partition("/")[2] for row in rows} >= ASKED
    assert len({row["issue"] for row in rows}) == 25
    files = fetch_surf_fsaverage("fsaverage5")
    flat, faces = (array.data for array in nibabel.load(files["flat_left"]).darrays)
    white = nibabel.load(files["white_left"]).darrays
    inside = np.zeros(len(flat), bool)
    inside[faces] = True
    for _ in range(2):  # over FreeSurfer's cuts
        inside[white[1].data[inside[white[1].data].any(axis=1)]] = True
    face = koebe.example("face")
    points, triangles = koebe.uniformize(face).surface
    closed = koebe.fill_holes(points, triangles, fair=True)[:2]
    random = np.random.default_rng(1).normal(size=(12, 3)) + np.repeat([[0, 0, 0], [1, 0, 0]], 6, axis=0)
    names = {
        "koebe": koebe, "np": np, "Path": Path, "trimesh": trimesh, "signed": signed, "area": area,
        "SUBJECT": Path(files["flat_left"]).parent, "FLAT": files["flat_left"], "CORTEX": inside,
        "FRONT": white[0].data[:, 1] > 40, "DEPTH": nibabel.load(files["sulc_left"]).darrays[0].data,
        "MESH": trimesh.Trimesh(points, triangles, process=False), "FACE": (points, triangles), "CLOSED": closed,
        "PLANE": pyvista.Plane(i_resolution=4, j_resolution=4).triangulate().clean(),
        "LINK": str(ROOT / "docs" / "link.obj"), "HALF_CYLINDER": half_cylinder(),
        "DISTANCES": np.linalg.norm(random[:, None] - random, axis=2), "GROUPS": np.repeat([0, 1], 6),
    }  # fmt: skip
    monkeypatch.chdir(tmp_path)
    for row in rows:
        if " = " in row["line"]:
            exec(row["line"], names)
        else:
            names["_"] = eval(row["line"], names)
        assert eval(row["then"], names), row
