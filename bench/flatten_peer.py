# SPDX-License-Identifier: GPL-3.0-or-later
"""autoflatten (Visconti di Oleggio Castello and Gallant 2025), a flattening of cortices: its command, on any disk.

It is looked for in AUTOFLATTEN, then in the PATH. It brings JAX, a gigabyte, so it wants an environment of its own:
`pip install autoflatten`.
"""

import os
import shutil
import tempfile
from pathlib import Path

import numpy as np
import processor_time

LIMIT = 1800  # seconds
PATCH = np.dtype([("vertex", ">i4"), ("place", ">f4", 3)])  # FreeSurfer's file, after two whole numbers: -1, count


def command() -> str | None:
    return os.environ.get("AUTOFLATTEN") or shutil.which("autoflatten")


def flat_map(vertices, triangles):
    """Its flat (V, 2) in the unit of the vertices, upright, and the processor seconds of the whole command."""
    import nibabel

    records = np.zeros(len(vertices), PATCH)
    records["vertex"], records["place"] = np.arange(len(vertices)) + 1, vertices
    with tempfile.TemporaryDirectory() as folder:
        surface, patch, flat = (Path(folder) / name for name in ("lh.white", "lh.patch.3d", "lh.flat.patch.3d"))
        nibabel.freesurfer.write_geometry(str(surface), vertices, triangles)
        patch.write_bytes(np.array([-1, len(vertices)], ">i4").tobytes() + records.tobytes())
        words = [command(), "flatten", patch, "--base-surface", surface, "--output", flat, "--print-every", "1000"]
        done, seconds = processor_time.run_timed(words, LIMIT)
        if done is None or done.returncode:
            raise RuntimeError(f"autoflatten: {done.stderr.strip() if done else 'out of time'}")
        made = np.frombuffer(flat.read_bytes(), PATCH, offset=8)
    order = np.argsort(np.abs(made["vertex"]))
    places = made["place"][order][:, :2].astype(float)
    a, b = places[triangles[:, 1]] - places[triangles[:, 0]], places[triangles[:, 2]] - places[triangles[:, 0]]
    if (a[:, 0] * b[:, 1] < a[:, 1] * b[:, 0]).mean() > 0.5:
        places[:, 0] *= -1.0
    return places, seconds
