# SPDX-License-Identifier: GPL-3.0-or-later
"""The paper's figures of surfaces and their circle domains, as SVG from real runs: 1 (15 holes), 8 (a surface and its
filled twin), 11 and 12 (5 and 9 holes, on surfaces of the printed sizes), 14 (the Schwarz reflection) and 15 (the
Schottky picture)."""

import mesh_regions
import numpy as np
import process_figures
import strips
import table_surfaces
from process_figures import TILE, mask
from strips import gamma
from table_one import ROWS
from table_surfaces import Curve

# Paper and tile of a domain, and of its copies by the number of reflections: red, green, blue; then as the domain.
LEVELS = (
    (strips.PAPER, strips.TILE),
    ("#f6dcd5", "#c8553d"),
    ("#dcebdc", "#3f8f5f"),
    ("#d9e4f2", "#35639f"),
)
FROM_BELOW = -20.0  # degrees: no part of the chin turns away
SMALLEST = 0.7  # units of the picture: tiles in a copy whose circle is smaller than ten times this are not drawn
# A face with large holes, so that there is something to see in their reflections.
WIDE = [
    Curve((0.0, -0.22), (0.86, 0.90)),
    Curve((0.0, -0.66), (0.36, 0.19)),
    *table_surfaces.both(0.36, 0.08, (0.25, 0.19), 0.1, 0.0, 4.0),
]


def domain_of(koebe, points, triangles, tile=TILE, **options):
    """The circle domain, upright: the result, its image (V, 2), its circles (center, radius) and the mesh to draw."""
    result = koebe.uniformize(points, triangles, balance="area", **options)
    upright = strips.turned_like(result.uv, strips.seen(points)[:, :2])
    turn = complex(*upright[0]) / complex(*result.uv[0])
    circles = [(complex(*center) * turn, radius) for center, radius in zip(result.centers, result.radii)]
    mesh = strips.Mesh(triangles, result.loops, upright, tile)
    return result, upright, circles, mesh


def figure_1(koebe, size=360.0, vertices=9000, boundary=900):
    """A face with 15 holes and its circle domain."""
    points, triangles = mask(15, vertices, boundary)
    result, upright, _, mesh = domain_of(koebe, points, triangles)
    ranks = range(len(result.loops))
    error = result.angle_error_deg["mean"]
    frames = [
        strips.surface_frame("a face with 15 holes", mesh, points, size, ranks),
        strips.image_frame(f"its circle domain; mean angle error {error:.1f}°", mesh, upright, size, ranks),
    ]
    return strips.strip(frames, 2)


def of_printed_size(koebe, row, size=420.0):
    """A face with as many holes, vertices and faces as a row of Table 1 prints, and its circle domain."""
    points, triangles = table_surfaces.read_obj(table_surfaces.file_of(row))
    result, upright, _, mesh = domain_of(koebe, points, triangles, 0.75 * TILE)
    ranks, error = range(len(result.loops)), result.angle_error_deg["mean"]
    surface = f"a face with {len(ranks) - 1} holes\n{len(points):,} vertices, {len(triangles):,} faces"
    domain = f"its circle domain\nmean angle error {error:.2f}°"
    frames = [
        strips.surface_frame(surface, mesh, points, size, ranks, tilt=FROM_BELOW),
        strips.image_frame(domain, mesh, upright, size, ranks),
    ]
    return strips.strip(frames, 2)


# ---------------------------------------------------------------- Fig. 8


def filled_twin(koebe, points, triangles, fair=False):
    """The surface with all loops but the longest filled: points, triangles."""
    loops = koebe.boundary_loops(triangles, vertex_count=len(points))
    lengths = [np.linalg.norm(points[np.roll(loop, -1)] - points[loop], axis=1).sum() for loop in loops]
    inner = [rank for rank in range(len(loops)) if rank != int(np.argmax(lengths))]
    filled, faces, _ = koebe.fill_holes(points, triangles, loops=inner, fair=fair)
    return filled, faces


def image_in_twin(koebe, points, triangles, fair=False):
    """Where the Riemann map of the filled twin takes the surface (V, 2); and how many vertices the patches added."""
    filled, faces = filled_twin(koebe, points, triangles, fair)
    return koebe.disk_map(filled, faces)[: len(points)], len(filled) - len(points)


TWIN_HEAD = [
    "vertices, holes filled by", "vertices added", "angle error of the surface's map", "of the twin's",
    "distance of the circle domains",
]  # fmt: skip
TWINS = {
    f"{vertices:,}, {words}": (vertices, boundary, fair)
    for words, fair in (("fans", False), ("triangles as long as those around", True))
    for vertices, boundary in ((6000, 620), (24000, 1240))
}


def twin_cells(koebe, row):
    """Fig. 8 in figures: the angle errors of both maps on the surface; and how far the circle domain of the surface is
    from that of its image in the twin's disk."""
    vertices, boundary, fair = TWINS[row]
    points, triangles = mask(3, vertices, boundary)
    disk, added = image_in_twin(koebe, points, triangles, fair)
    result = koebe.uniformize(points, triangles)
    again = koebe.uniformize(np.column_stack([disk, np.zeros(len(disk))]), triangles)
    error = koebe.distortion(points, triangles, disk)["angle_error_deg"]["mean"]
    distance = koebe.module_distance(result, again)
    return [f"{added:,}", f"{result.angle_error_deg['mean']:.2f}", f"{error:.2f}", f"{distance:.1e}"]


def figure_8(koebe, size=270.0, vertices=process_figures.VERTICES, boundary=process_figures.BOUNDARY):
    """A surface with three holes and its circle domain; its twin without holes and the twin's disk."""
    points, triangles = mask(3, vertices, boundary)
    _, upright, _, mesh = domain_of(koebe, points, triangles)
    disk, _ = image_in_twin(koebe, points, triangles)
    disk, holes = strips.turned_like(disk, upright), (1, 2, 3)
    frames = [
        strips.surface_frame("a surface with 3 holes", mesh, points, size, range(4)),
        strips.image_frame("its circle domain", mesh, upright, size, range(4)),
        strips.surface_frame("its filled twin", mesh, points, size, [0], holes),
        strips.image_frame("the twin's Riemann map", mesh, disk, size, [0], holes),
    ]
    return strips.strip(frames, 4)


# ---------------------------------------------------------------- reflections


def reflect_points(z, circle):
    """Complex points reflected in a circle (center, radius)."""
    center, radius = circle
    return center + radius**2 / np.conj(z - center)


def reflect_circle(circle, mirror):
    """The image of a circle that does not pass through the mirror's centre."""
    (center, radius), (middle, size) = circle, mirror
    away = center - middle
    scale = size**2 / (abs(away) ** 2 - radius**2)
    return middle + scale * away, abs(scale) * radius


def reflect_all(circles, k):
    """All circles reflected in the k-th of them, which stays."""
    return [c if j == k else reflect_circle(c, circles[k]) for j, c in enumerate(circles)]


def copies(circles, depth):
    """The domain and its copies after up to so many reflections: (level, word of circles to reflect in, one after the
    other, and the circles of the copy; the first one bounds it from the rest)."""
    found = [(0, (), list(circles))]
    level = [((), list(circles))]
    for number in range(1, depth + 1):
        after = []
        for word, own in level:
            for k in range(len(own)):
                if word and k == word[-1]:
                    continue  # back to where it came from
                after.append((word + (k,), reflect_all(own, k)))
        found += [(number, word, own) for word, own in after]
        level = after
    return found


def reflected_along(z, word, circles):
    """Points of the domain in the copy of that word: each reflection is in a circle of the copy before it."""
    own = list(circles)
    for k in word:
        z = reflect_points(z, own[k])
        own = reflect_all(own, k)
    return z


def draw_copies(frame, mesh, image, circles, depth, half, only=None):
    """The domain and its copies, each in the colours of its level, inside one over the other. A hole lies at 0, so no
    copy reaches infinity."""
    scale = (frame.size / 2 - 8.0) / half
    z = image @ [1.0, 1j]
    for level, word, own in copies(circles, depth):
        size = scale * own[word[-1] if word else 0][1]
        if size < SMALLEST or (only is not None and word and word not in only):
            continue
        paper, tile = LEVELS[level]
        copy = reflected_along(z, word, circles)
        places = strips.into_frame(np.column_stack([copy.real, copy.imag]), frame.size, half)
        rims = [places[np.append(loop, loop[0])] for loop in mesh.loops]
        tolerance = 0.12 if size > 40 else 0.25
        frame.add(strips.path_element(rims, f'fill="{paper}" fill-rule="evenodd"', tolerance))
        if size > 10 * SMALLEST:
            tiles = [mesh_regions.place(chain, places) for chain in mesh.tiles]
            frame.add(strips.path_element(tiles, f'fill="{tile}" fill-rule="evenodd"', tolerance))
        else:
            frame.add(strips.path_element(rims, f'fill="{tile}" fill-opacity="0.5" fill-rule="evenodd"', tolerance))
        width = 8 if size > 40 else 4
        frame.add(strips.path_element(rims, f'fill="none" stroke="{strips.INK}" stroke-width="{width}"', tolerance))
    return frame


def wide_domain(koebe, vertices, boundary):
    """The face with large holes: its circle domain with the first hole in the middle, its circles and the mesh."""
    points, triangles = table_surfaces.between(WIDE, vertices, boundary)
    result, upright, circles, mesh = domain_of(koebe, points, triangles)
    return (*middle_first(upright, circles), mesh)


def hyperbolic_center(circle):
    """The point of the unit disk whose move to 0 centres a circle of the disk there."""
    center, radius = circle
    d = abs(center)
    if d == 0.0:
        return 0.0
    near, far = np.arctanh(d - radius), np.arctanh(d + radius)
    return center / d * np.tanh((near + far) / 2.0)


def middle_first(image, circles):
    """Everything moved by the automorphism of the disk that centres the first hole at 0."""
    a = hyperbolic_center(circles[1])
    moved = process_figures.moved_to_middle(image, (np.real(a), np.imag(a)))
    return moved, [circle_through(c, a) for c in circles]


def circle_through(circle, a):
    """The image of a circle under z -> (z - a) / (1 - conj(a) z), from three of its points."""
    center, radius = circle
    z = center + radius * np.exp(2j * np.pi * np.arange(3) / 3)
    p, q, r = (z - a) / (1.0 - np.conj(a) * z)
    u, v = q - p, r - p
    arm = 1j * (u * abs(v) ** 2 - v * abs(u) ** 2) / (2.0 * (np.conj(u) * v).imag)
    return p + arm, abs(arm)


def figure_14(koebe, size=320.0, vertices=process_figures.VERTICES, boundary=process_figures.BOUNDARY):
    """The Schwarz reflection: a circle domain, and the same continued over one of its circles by reflection."""
    image, circles, mesh = wide_domain(koebe, vertices, boundary)
    frames = [
        strips.image_frame("a circle domain", mesh, image, size, range(4)),
        strips.Frame(f"continued over {gamma(1)} by reflection", size),
        strips.Frame(f"and over {gamma(0)}", size),
    ]
    draw_copies(frames[1], mesh, image, circles, 1, 1.0, only=[(1,)])
    draw_copies(frames[2], mesh, image, circles, 1, 2.2, only=[(0,), (1,)])
    return strips.strip(frames, 3)


def figure_15(koebe, size=600.0, half=1.45, vertices=process_figures.VERTICES, boundary=process_figures.BOUNDARY):
    """The Schottky picture: the circle domain and its copies after one, two and three reflections in its circles."""
    image, circles, mesh = wide_domain(koebe, vertices, boundary)
    frame = strips.Frame("after 1, 2, 3 reflections: red, green, blue", size)
    return strips.strip([draw_copies(frame, mesh, image, circles, 3, half)], 1)


FIGURES = {
    "fig_1_fifteen_holes": figure_1,
    "fig_8_filled_twin": figure_8,
    "fig_11_five_holes": lambda koebe: of_printed_size(koebe, ROWS["Fig. 11"]),
    "fig_12_nine_holes": lambda koebe: of_printed_size(koebe, ROWS["Fig. 12"]),
    "fig_14_schwarz_reflection": figure_14,
    "fig_15_schottky": figure_15,
}
