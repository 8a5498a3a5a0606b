#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""How exact is the module of a mesh, and the one extrapolated from it and a finer mesh, and how many errors are within
their bars (koebe.module_error)? Eight domains with known circles (bench/polyhedron_error.py).

Usage: extrapolated_circles.py        prints docs/data/extrapolated_circles.csv
"""

from types import SimpleNamespace

import koebe
import numpy as np
import polyhedron_error

SIZES = (1000, 4000, 16000)


def errors(lift, circles, faces):
    """The greatest error of the module's numbers, as mapped and extrapolated; errors within their bars; the faces."""
    points, triangles, counts = polyhedron_error.meshed(circles, faces)
    result = koebe.uniformize(polyhedron_error.LIFTS[lift][0](points), triangles, tolerance=1e-9)
    rank = {int(v): k for k, loop in enumerate(result.loops) for v in loop}
    order = [rank[int(first)] for first in np.cumsum([0, *counts[:-1]])]
    centers = np.array([[complex(c).real, complex(c).imag] for c, _ in circles])
    exact = koebe.conformal_module(SimpleNamespace(centers=centers, radii=np.array([r for _, r in circles])))
    smooth, extrapolated = (
        abs(koebe.conformal_module(result, order=order, rims=rims) - exact)
        for rims in ("smooth", "extrapolated")
    )
    within = smooth <= koebe.module_error(result, order=order)
    return smooth.max(), extrapolated.max(), f"{within.sum()} of {len(within)}", len(triangles)


def main():
    print("domain,surface,faces,error of the module,extrapolated,errors within their bars")
    for name, circles in polyhedron_error.DOMAINS.items():
        for lift in polyhedron_error.LIFTS:
            for faces in SIZES:
                smooth, extrapolated, within, count = errors(lift, circles, faces)
                print(f'{name},{lift},"{count:,}",{smooth:.1e},{extrapolated:.1e},{within}', flush=True)


if __name__ == "__main__":
    main()
