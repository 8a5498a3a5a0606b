"""The mug: thick walls, rounded edges, a handle: a closed surface of genus 1. It stands on z = 0, 1 high."""

import numpy as np
from cage_mesher import Cage, limb_sections, oval, section
from face_surface import smooth_difference, smooth_union
from implicit_shapes import chain, project

RADIUS, HEIGHT, WALL, FLOOR = 0.42, 1.0, 0.055, 0.075
HANDLE = [(0.36, 0, 0.80), (0.52, 0, 0.82), (0.68, 0, 0.74), (0.725, 0, 0.54), (0.64, 0, 0.33), (0.50, 0, 0.24),
          (0.36, 0, 0.235)]  # fmt: skip
HANDLE_WIDTHS = (0.052, 0.072)  # across the bend, and along y
ROUNDNESS = 0.12


def clay(p):
    """The mug's field."""
    radius = np.hypot(p[:, 0], p[:, 1])
    belly = RADIUS - 0.05 * (1.0 - np.clip(p[:, 2] / HEIGHT, 0, 1)) ** 3
    outer = _both(_both(radius - belly, -p[:, 2], ROUNDNESS), p[:, 2] - HEIGHT, 0.09)
    flat = p * (1.0, HANDLE_WIDTHS[0] / HANDLE_WIDTHS[1], 1.0)
    outer = smooth_union(outer, chain(flat, HANDLE, [HANDLE_WIDTHS[0]] * len(HANDLE)), 0.09)
    inner = _both(radius - belly + WALL, FLOOR - p[:, 2], 0.2)
    return smooth_difference(outer, inner, 0.07)


def _both(a, b, width):
    """The intersection, its edge rounded over width."""
    return -smooth_union(-a, -b, width)


def cage(around=24):
    """Rings from the middle of the foot up the outside, over the rim and down to the middle of the floor."""
    c = Cage()
    side = around // 4
    circle = oval(around, side, side)
    inside, outside = RADIUS - WALL, RADIUS - 0.02

    def ring(radius, z):
        return section(circle, (0, 0, z), (radius, 0, 0), (0, radius, 0))

    first = c.add(ring(0.62 * RADIUS, 0.0))
    up = [ring(RADIUS - 0.06, 0.02), *(ring(outside, z) for z in np.linspace(0.08, 0.95, 10))]
    down = [ring(inside + WALL / 2, HEIGHT), *(ring(inside, z) for z in np.linspace(0.94, 0.14, 8)),
            ring(0.78 * inside, FLOOR + 0.01)]  # fmt: skip
    rings = c.tube(first, up)
    rest = c.tube(rings[-1], down)
    c.cap(rest[-1], side, side)
    c.cap(np.concatenate([first[side::-1], first[:side:-1]]), side, side)
    at = side + side // 2  # the vertex in the middle of the side x > 0
    columns = [at - 1, at, at + 1]
    top, bottom = rings[8:11][:, columns], rings[3:6][:, columns]
    begin, end = c.open(top), c.open(bottom)
    widths = [(HANDLE_WIDTHS[1], HANDLE_WIDTHS[0])] * len(HANDLE)
    sections = limb_sections(oval(8, 2, 2), HANDLE, widths, (0, 1, 0), 15)[1:-2]
    last = c.tube(begin, sections)[-1]
    # The tube ends at the other opening, which runs the other way around.
    target = end[[6, 5, 4, 3, 2, 1, 0, 7]]
    c.quads.extend(np.stack([last, np.roll(last, -1), np.roll(target, -1), target], axis=1).tolist())
    return c


def mug():
    """Points (V, 3) and quads (F, 4)."""
    return cage().mesh(lambda p: project(clay, p), (0, 2, 6))
