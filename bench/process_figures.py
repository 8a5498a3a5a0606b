# SPDX-License-Identifier: GPL-3.0-or-later
"""The paper's process figures from real runs of the mesh engine: Figs. 2 and 3 (the conventional method), 4 and 10 (the
generalized one) and 9 (the first algorithm of section 4.4). Each frame is the image of the same mask; its checker is
that of the final circle domain, carried back, so that squares are squares where the map so far is conformal."""

import numpy as np
import strips
import table_surfaces
from printed import FIG_2_FRAMES, FIG_2_ORDER, FIG_4_ORDER
from strips import gamma

VERTICES, BOUNDARY = 6000, 620  # of the masks drawn
TILE = 0.08  # side of a checker's square in the unit disk
FIG_3_CIRCLE = 0.6  # of the largest circle about the hole's centre that fits into it


def mask(holes, vertices=VERTICES, boundary=BOUNDARY):
    """A small mask of Table 1's kind: points and triangles."""
    return table_surfaces.make(holes, vertices, boundary)


def run(koebe, points, triangles, **options):
    """The result on the mesh engine with the image of each step, and the mesh to draw."""
    result = koebe.uniformize(points, triangles, engine="mesh", record_steps=True, balance="area", **options)
    upright = strips.turned_like(result.uv, strips.seen(points)[:, :2])
    return result, upright, strips.Mesh(triangles, result.loops, upright, TILE)


def others(result, opened):
    return [rank for rank in range(len(result.loops)) if rank not in opened]


def e_of(step):
    return f"mean e = {step['mean_roundness']:.4f}"


def step_frames(result, mesh, upright, steps, size):
    """One frame a step, each turned to lie like the end."""
    frames = []
    for number, (step, image) in enumerate(zip(result.history[:steps], result.step_maps[:steps]), 1):
        opened = list(dict.fromkeys(step["pair"]))
        names = ", ".join(map(gamma, opened))
        caption = f"step {number}: {names}\n{e_of(step)}"
        turned = strips.turned_like(image, upright)
        frames.append(strips.image_frame(caption, mesh, turned, size, opened, others(result, opened)))
    return frames


def figure_2(koebe, size=230.0, **small):
    """CK: the surface and eight steps."""
    points, triangles = mask(3, **small)
    result, upright, mesh = run(koebe, points, triangles, method="ck", schedule=FIG_2_ORDER)
    first = strips.surface_frame("the surface\n", mesh, points, size, opened=range(4))
    return strips.strip([first, *step_frames(result, mesh, upright, FIG_2_FRAMES - 1, size)], 3)


def figure_4(koebe, size=230.0, **small):
    """GK with partners that change: the surface and the printed five steps."""
    points, triangles = mask(3, **small)
    result, upright, mesh = run(koebe, points, triangles, method="gk", schedule=FIG_4_ORDER)
    first = strips.surface_frame("the surface\n", mesh, points, size, opened=range(4))
    return strips.strip([first, *step_frames(result, mesh, upright, len(FIG_4_ORDER), size)], 3)


def figure_10(koebe, size=190.0, **small):
    """GK on five holes: the surface, two iterations, and the circle domain after a Moebius map."""
    points, triangles = mask(5, **small)
    result, upright, mesh = run(koebe, points, triangles, method="gk")
    frames = [strips.surface_frame("the surface\n", mesh, points, size, opened=range(6))]
    frames += step_frames(result, mesh, upright, 6, size)
    frames.append(strips.image_frame("the circle domain,\nafter a Möbius map", mesh, upright, size, opened=range(6)))
    return strips.strip(frames, 4)


def figure_9(koebe, size=190.0, iterations=2, **small):
    """The first algorithm of section 4.4: a row for each disk D_k, its columns the surface without it, the image in the
    annulus, and the disk refilled."""
    points, triangles = mask(3, **small)
    result, upright, mesh = run(koebe, points, triangles, method="against-outer")
    frames, before = [], None
    for step, image in list(zip(result.history, result.step_maps))[: 3 * iterations]:
        k = max(step["pair"])
        rest = [rank for rank in (1, 2, 3) if rank != k]
        disk = "D" + gamma(k)[1:]
        now = strips.turned_like(image, upright)
        if before is None:
            frames.append(strips.surface_frame(f"the surface without {disk}\n", mesh, points, size, [0, k], rest))
        else:
            frames.append(strips.image_frame(f"without {disk}\n", mesh, before, size, [0, k], rest))
        frames.append(strips.image_frame(f"in the annulus\n{e_of(step)}", mesh, now, size, [0, k], rest))
        frames.append(strips.image_frame(f"{disk} refilled\n", mesh, now, size, [0], [1, 2, 3]))
        before = now
    return strips.strip(frames, 3, arrows=True)


# ---------------------------------------------------------------- Fig. 3


def figure_3(koebe, size=230.0, **small):
    """A single CK step, that of gamma_3 after gamma_0: a circle inside gamma_3, the reflection in it, the fillings of
    the others, the Riemann map."""
    points, triangles = mask(3, **small)
    result, upright, mesh = run(koebe, points, triangles, method="ck", schedule=FIG_2_ORDER)
    start = strips.turned_like(result.step_maps[0], upright)
    start = moved_to_middle(start, start[mesh.loops[3]].mean(axis=0))
    center, radius = circle_inside(start[mesh.loops[3]])
    first = strips.image_frame(f"a circle inside {gamma(3)}", mesh, start, size, [3])
    draw_circle(first, center, radius)

    mirrored = reflected(start, center, radius)
    second = strips.image_frame("reflected in it", mesh, mirrored, size, [3])

    filled, faces = fill_all_but(koebe, mirrored, triangles[:, ::-1], mesh.loops[3])
    names = ", ".join(gamma(k) for k in (0, 1, 2))
    third = strips.image_frame(f"{names} filled", mesh, mirrored, size, [3], [0, 1, 2])

    image = koebe.disk_map(filled, faces)
    image = strips.turned_like(image[: len(points)], mirrored)
    last = strips.image_frame(f"the Riemann map: {gamma(3)} is a circle", mesh, image, size, [3], [0, 1, 2])
    return strips.strip([first, second, third, last], 4, gap=16.0, arrows=True)


def moved_to_middle(points, place):
    """By the automorphism of the disk that takes a place to 0."""
    z, a = points @ [1.0, 1j], complex(*place)
    z = (z - a) / (1.0 - np.conj(a) * z)
    return np.column_stack([z.real, z.imag])


def circle_inside(polygon):
    """A circle about the mean of a polygon's points, inside it."""
    center = polygon.mean(axis=0)
    return center, FIG_3_CIRCLE * np.hypot(*(polygon - center).T).min()


def reflected(points, center, radius):
    """In a circle, and then so that the circle is the unit circle."""
    away = points - center
    images = away / (away**2).sum(axis=1)[:, None]
    return images / np.hypot(*images.T).max()


def fill_all_but(koebe, plane, triangles, left):
    """A plane mesh with fans in all loops but one: points (V, 3) and triangles (F, 3)."""
    points = np.column_stack([plane, np.zeros(len(plane))])
    loops = koebe.boundary_loops(triangles, vertex_count=len(points))
    ranks = [rank for rank, loop in enumerate(loops) if loop[0] not in left]
    filled, faces, _ = koebe.fill_holes(points, triangles, loops=ranks)
    return filled, faces


def draw_circle(frame, center, radius):
    turn = np.linspace(0.0, 2.0 * np.pi, 97)
    ring = center + radius * np.column_stack([np.cos(turn), np.sin(turn)])
    style = f'fill="#ffffff" stroke="{strips.INK}" stroke-width="12" stroke-dasharray="30 18"'
    frame.add(strips.path_element([strips.into_frame(ring, frame.size)], style))


FIGURES = {
    "fig_2_ck": figure_2,
    "fig_3_ck_step": figure_3,
    "fig_4_gk": figure_4,
    "fig_9_first_algorithm": figure_9,
    "fig_10_gk": figure_10,
}
