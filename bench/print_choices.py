# SPDX-License-Identifier: GPL-3.0-or-later
"""What the choices of the print cost in accuracy: partners that change, the metric of the last image in the plane, the
reflection tau, the annulus by the Yamabe flow. GK on triangles, on a circle domain of five circles that is lifted to
Enneper's surface, so that the circles are known."""

import numpy as np
import table_surfaces

CIRCLES = ((0.0, 1.0), (0.45 + 0.25j, 0.18), (-0.4 + 0.35j, 0.22), (-0.1 - 0.5j, 0.2), (0.42 - 0.4j, 0.12))
VERTICES = 4000
SWEEPS = (3, 12)  # of at most; the metric of the last image does not come to rest
CHOICES = {
    "ours: first metric, fixed partners, 1-forms": {},
    "partners that change": {"partners": "changing"},
    "metric of the last image": {"metric": "planar"},
    "the same after the reflection τ": {"metric": "reflected"},
    "the same, τ in the hole opened last": {"metric": "reflected-last"},
    "metric of the last image, annulus by the Yamabe flow": {"metric": "planar", "annulus": "yamabe"},
    "as printed: τ, partners that change, 1-forms": {"metric": "reflected", "partners": "changing"},
}
HEAD = [
    "choice", *(f"circles, {sweeps} sweeps" for sweeps in SWEEPS), *(f"degrees, {sweeps} sweeps" for sweeps in SWEEPS),
    "converged",
]  # fmt: skip


def domain(vertices, circles=CIRCLES):
    """Points (V, 3) on Enneper's surface, triangles, and a vertex on each circle."""
    spacing = np.sqrt(2.0 * np.pi / (np.sqrt(3.0) * vertices))
    polygons = []
    for center, radius in circles:
        count = max(12, round(2.0 * np.pi * radius / spacing))
        z = center + radius * np.exp(2j * np.pi * np.arange(count) / count)
        polygons.append(np.column_stack([z.real, z.imag]))
    plane, triangles = table_surfaces.planar_mesh(polygons, vertices)
    u, v = plane.T
    points = np.column_stack([u - u**3 / 3 + u * v**2, v - v**3 / 3 + v * u**2, u**2 - v**2])
    return points, triangles, np.cumsum([0] + [len(polygon) for polygon in polygons[:-1]])


def inversive_distances(circles):
    """Of all pairs: what no Moebius map changes."""
    return np.array(
        [
            abs(r * r + s * s - abs(c - d) ** 2) / (2.0 * r * s)
            for k, (c, r) in enumerate(circles)
            for d, s in circles[k + 1 :]
        ]
    )


def circle_error(result, on_circle):
    """The largest relative error of an inversive distance."""
    rank = [next(k for k, loop in enumerate(result.loops) if vertex in loop) for vertex in on_circle]
    found = inversive_distances([(complex(*result.centers[k]), result.radii[k]) for k in rank])
    exact = inversive_distances(CIRCLES)
    return float(np.max(np.abs(found - exact) / exact))


def cells(koebe, choice):
    """A row."""
    points, triangles, on_circle = domain(VERTICES)
    found = [
        koebe.uniformize(points, triangles, engine="mesh", max_sweeps=sweeps, **CHOICES[choice]) for sweeps in SWEEPS
    ]
    return [
        *(f"{circle_error(result, on_circle):.1e}" for result in found),
        *(f"{result.angle_error_deg['mean']:.2f}" for result in found),
        f"after {found[-1].sweeps} sweeps" if found[-1].converged else "no",
    ]
