"""Calls that a type checker takes, and calls that it refuses. `make lint` reads this file; nothing runs it.

An ignore that no error needs is itself an error there (warn_unused_ignores), and for Pyright too.
"""

from pathlib import Path
from typing import Any

import koebe
import numpy as np


def taken(vertices: np.ndarray, triangles: np.ndarray, is_cut: bool, kept: dict[str, Any]) -> None:
    one: koebe.UniformizeResult = koebe.uniformize(vertices, triangles, method="ck", tolerance=1e-4, outer=3)
    cut: koebe.CutResult = koebe.uniformize((vertices, triangles), cut=True, balance="area", importance=vertices[:, 0])
    either: koebe.UniformizeResult | koebe.CutResult = koebe.uniformize("face.obj", cut=is_cut)
    koebe.uniformize(*one.surface, **kept)
    koebe.uniformize("lh.white", mask=~koebe.read_region("lh.cortex.label", one.vertex_count))
    koebe.parts(Path("face.obj"), price=0.01)
    koebe.Surface(vertices, triangles, method="ck").uniformize(vertices)
    places: koebe.Correspondence = koebe.transfer(one, one, landmarks=[(0, 0)])
    field: np.ndarray = koebe.transfer(one, one, one.log_scale)
    corners: list[np.ndarray] = [one.corner_uv, cut.corner_uv, koebe.sphere_map(vertices, triangles).corner_uv]
    rims: list[koebe.Loop] = [*one.loops, *koebe.ring_map(vertices, triangles).loops]
    token = koebe.CancelToken()
    stopped: bool = token.cancelled
    again: koebe.PartsResult = koebe.load("face.npz", koebe.PartsResult)
    brain: koebe.FlatCortex = koebe.cortex("sub-01", "lh", cancel=token)
    print(cut, either, places, field, corners, rims, stopped, again, brain.places)


def refused(vertices: np.ndarray, triangles: np.ndarray) -> None:
    koebe.uniformize(vertices, triangles, methd="gk")  # type: ignore[call-overload]
    koebe.uniformize(vertices, triangles, cut=True, methd="gk")  # type: ignore[call-overload]
    koebe.uniformize(vertices, triangles, tolerance="small")  # type: ignore[call-overload]
    koebe.uniformize(vertices, triangles, method=1)  # type: ignore[call-overload]
    koebe.uniformize(vertices, triangles, method="gkk")  # type: ignore[call-overload]
    koebe.uniformize(vertices, triangles, outer="longst")  # type: ignore[call-overload]
    koebe.uniformize(vertices, triangles, cut="yes")  # type: ignore[call-overload]
    koebe.parts(vertices, triangles, prize=0.01)  # type: ignore[call-arg]
    koebe.parts(vertices, triangles, loops="rond")  # type: ignore[arg-type]
    koebe.sphere_map(vertices, triangles, max_sweeps=2.5)  # type: ignore[arg-type]
    koebe.sphere_map(vertices, triangles, layout="octahedron")  # type: ignore[arg-type]
    koebe.ring_map(vertices, triangles, hole="radial")  # type: ignore[call-arg]
    koebe.lift(vertices, triangles, perforated=True)  # type: ignore[call-arg]
    koebe.flatten(vertices, triangles, unit="cm")  # type: ignore[call-arg]
    koebe.Surface(vertices, triangles, metod="ck")  # type: ignore[call-arg]
    koebe.CancelToken(3)  # type: ignore[call-arg]
    print(koebe.CancelToken().canceled)  # type: ignore[attr-defined]
    print(koebe.load("face.npz", koebe.PartsResult).price)  # type: ignore[attr-defined]
    koebe.boundary_loops(triangles, count=3)  # type: ignore[call-arg]
    koebe.family([], eror=True)  # type: ignore[call-overload]
