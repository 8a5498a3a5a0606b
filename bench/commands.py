# SPDX-License-Identifier: GPL-3.0-or-later
"""The commands beside the one map: what each is tried on, and how two of its answers are compared."""

import koebe
import numpy as np
import promises

COMMANDS = {  # name: the call, the kinds of random_surfaces that it takes
    "cut": (lambda v, f, **o: koebe.uniformize(v, f, cut=True, **o), ("strewn", "doubled", "closed", "limbs", "tube")),
    "sphere": (koebe.sphere_map, ("closed", "sphere", "limbs", "tube")),
    "ring": (koebe.ring_map, ("tube", "ring", "planar", "sphere")),
    "torus": (koebe.torus_map, ("tori",)),
    "schottky": (koebe.schottky_map, ("doubled", "tori")),
    "parts": (koebe.parts, ("strewn", "doubled", "closed", "limbs", "tube", "planar")),
}


def corners(result):
    """(3F, n) that may not change: UVs, and points on the sphere where there are some."""
    return np.asarray(result.uv, float).reshape(-1, 2)


def difference(one, other, corner):
    """The largest distance in the UVs; infinite if one is an error or of another number of parts.

    corner    (3F,) of the other answer for each of the first one's
    """
    if isinstance(one, str) or isinstance(other, str):
        return 0.0 if isinstance(one, str) and one == other else np.inf
    if len(getattr(one, "parts", ())) != len(getattr(other, "parts", ())):
        return np.inf
    return float(np.abs(corners(one) - corners(other)[corner]).max())


def broken(name, triangles, result):
    """Names of the promises that an answer breaks, read from the UVs and the report alone."""
    uv = corners(result)
    if not np.isfinite(uv).all():
        return ["not finite"]
    found = []
    low, high = (-1, 2) if name == "sphere" else (0, 1)
    if uv.min() < low - 1e-12 or uv.max() > high + 1e-12:
        found.append("outside")
    if name == "sphere" and np.abs(np.linalg.norm(result.points, axis=1) - 1).max() > 1e-9:
        found.append("off the sphere")
    apart = np.arange(len(uv)).reshape(-1, 3)
    area, longest = promises.as_stored(2 * uv - 1, apart)
    lost = [f for w in result.warnings if w.kind in ("left_out", "collapsed_faces", "not_mapped") for f in w.elements]
    turned = [f for w in result.warnings if w.kind == "reoriented_faces" for f in w.elements]
    area[turned] *= -1
    there = np.setdiff1d(np.arange(len(apart)), lost)
    flipped = there[~(area[there] > 0) & (longest[there] >= promises.RESOLUTION)]
    if name != "sphere" and result.converged and len(flipped):
        found.append("flipped")
    return found
