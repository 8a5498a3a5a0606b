# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/images/compare_person.jpg: UVs that a person made beside ours, coloured by texel density.

    PYTHONPATH=build/python build/venv-labs/bin/python bench/person_picture.py spot.obj
"""

import sys
import tempfile
from pathlib import Path

import compare_picture
import koebe
import numpy as np

ROOT = Path(__file__).resolve().parent.parent
SETTINGS = {"ours, default": {}, "ours, darts 0": {"darts": 0.0}}


def corners(path):
    """Vertices, triangles and the UVs of their corners of an OBJ file of triangles."""
    words = [line.split() for line in Path(path).read_text(encoding="utf-8").splitlines() if line]
    points, places = (np.array([w[1:] for w in words if w[0] == kind], float) for kind in ("v", "vt"))
    faces = np.array([[corner.split("/")[:2] for corner in w[1:]] for w in words if w[0] == "f"], np.int32) - 1
    return points, np.ascontiguousarray(faces[..., 0]), places[faces[..., 1], :2]


def main():
    points, triangles, person = corners(sys.argv[1])
    layouts = {"a person": person}
    layouts |= {name: koebe.parts(points, triangles, **options).uv for name, options in SETTINGS.items()}
    with tempfile.TemporaryDirectory() as folder:
        files = {name: Path(folder) / f"{name}.npz" for name in layouts}
        for name, uv in layouts.items():
            np.savez(files[name], uv=uv)
        compare_picture.draw((points, triangles), files, ROOT / "docs" / "images" / "compare_person.jpg")


if __name__ == "__main__":
    main()
