# SPDX-License-Identifier: GPL-3.0-or-later
"""The paper's Fig. 13: faces of two persons, cut alike, compared by their conformal modules. Ours are made: the face of
blend_samples/face_surface.py, and another one with a broader jaw, a longer chin, eyes closer together, a larger nose
and a wider mouth; both also surprised. Each has a mesh of its own.

The loops come in the order of the paper: the outline, the mouth gamma_1, the eyes gamma_2 and gamma_3. gamma_1 is
moved to the middle of the disk, c_2 onto the positive y axis.
"""

from functools import cache

import domain_figures
import face_expression
import numpy as np
import process_figures
import strips
import table_surfaces
from table_surfaces import EYES, MOUTH, OUTLINE

VERTICES, BOUNDARY = 6000, 620
HEAD = ["head", "r₁", "y₂", "r₂", "x₃", "y₃", "r₃", "from the first head", "from the second head"]


def bump(t, center, width):
    return np.exp(-(((t - center) / width) ** 2))


def another_person(p):
    """Points (n, 3) of the first face as those of another one; smooth and one to one."""
    x, y, z = p.T
    below = 1.0 / (1.0 + np.exp((z + 0.55) / 0.12))
    mouth = bump(x, 0.0, 0.35) * bump(z, -0.67, 0.14)
    nose = bump(x, 0.0, 0.16) * bump(z, -0.33, 0.22) * (y < 0.0)
    wide = 1.0 + 0.16 * bump(z, -0.80, 0.45) - 0.13 * bump(z, 0.0, 0.22) * bump(x, 0.0, 0.55) + 0.18 * mouth
    return np.column_stack([x * wide, 0.93 * y - 0.10 * nose, z - 0.10 * below])


def itself(p):
    return p


# Name: vertices and boundary vertices of its mesh, expression, person.
HEADS = {
    "first": (VERTICES, BOUNDARY, itself, itself),
    "first, surprised": (VERTICES + 700, BOUNDARY + 40, face_expression.surprised, itself),
    "second": (VERTICES - 600, BOUNDARY - 40, itself, another_person),
    "second, surprised": (VERTICES + 300, BOUNDARY + 20, face_expression.surprised, another_person),
}


@cache
def head(name):
    """Points (V, 3) and triangles (F, 3)."""
    vertices, boundary, expression, person = HEADS[name]
    points, triangles = table_surfaces.between([OUTLINE, *MOUTH, *EYES], vertices, boundary)
    return person(expression(points)), triangles


@cache
def mapped(koebe, name):
    """The result, and its loops in the paper's order."""
    points, triangles = head(name)
    result = koebe.uniformize(points, triangles)
    middles = np.array([points[loop].mean(axis=0) for loop in result.loops])
    holes = range(1, len(result.loops))
    mouth = min(holes, key=lambda k: middles[k, 2])
    eyes = sorted(set(holes) - {mouth}, key=lambda k: middles[k, 0])
    return result, [0, mouth, *eyes]


def module(koebe, name):
    """(r1, y2, r2, x3, y3, r3)."""
    result, order = mapped(koebe, name)
    return koebe.conformal_module(result, order=order)


def distance(koebe, one, other):
    """L2, in the one order of the loops: that of the paper's Fig. 13."""
    return float(np.linalg.norm(module(koebe, one) - module(koebe, other)))


def cells(koebe, name):
    """A row: the module and the distances from both heads."""
    numbers = [f"{value:.4f}" for value in module(koebe, name)]
    return numbers + [f"{distance(koebe, name, other):.4f}" for other in ("first", "second")]


def normal_position(koebe, name):
    """The domain with gamma_1 in the middle and c_2 on the positive y axis: the image (V, 2) and the circles."""
    result, order = mapped(koebe, name)
    circles = [(complex(*result.centers[k]), result.radii[k]) for k in order]
    image, circles = domain_figures.middle_first(result.uv, circles)
    turn = 1j * abs(circles[2][0]) / circles[2][0]
    z = image @ [1.0, 1j] * turn
    image = np.column_stack([z.real, z.imag])
    return image, [(center * turn, radius) for center, radius in circles]


def figure_13(koebe, size=220.0):
    """Both heads with both expressions, and their circle domains in normal position."""
    surfaces, domains = [], []
    for name in HEADS:
        points, triangles = head(name)
        result, order = mapped(koebe, name)
        image, _ = normal_position(koebe, name)
        loops = [result.loops[k] for k in order]
        mesh = strips.Mesh(triangles, loops, image, process_figures.TILE)
        surfaces.append(strips.surface_frame(name, mesh, points, size, range(4)))
        frame = strips.image_frame(f"{distance(koebe, name, 'first'):.3f} from the first", mesh, image, size, range(4))
        domains.append(draw_axes(frame))
    return strips.strip(surfaces + domains, len(HEADS))


def draw_axes(frame):
    """The axes of the disk, dashed."""
    half = 5 * frame.size
    style = f'fill="none" stroke="{strips.INK}" stroke-width="6" stroke-dasharray="20 24"'
    return frame.add(f'<path {style} d="M{half - 1020:.0f} {half:.0f}h2040M{half:.0f} {half - 1020:.0f}v2040"/>')


FIGURES = {"fig_13_two_heads": figure_13}
