"""Quads of implicit surfaces from a cage: topology, place and orientation, and mirror images."""

import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "blend_samples"))

from cage_mesher import Cage, catmull_clark, edges_of, limb_sections, oval  # noqa: E402
from implicit_shapes import chain, project  # noqa: E402

pytestmark = [pytest.mark.slow, pytest.mark.long]  # of the samples' maker, which no user has


def euler(points, quads):
    return len(points) - len(edges_of(quads)[0]) + len(quads)


def volume(points, quads):
    a, b, c, d = (points[quads[:, k]] for k in range(4))
    return sum(np.sum(np.cross(p, q) * r) for p, q, r in ((a, b, c), (a, c, d))) / 6


def assert_oriented(quads, boundary):
    """Each directed edge once, and so many without a twin."""
    directed = list(map(tuple, np.stack([quads, np.roll(quads, -1, axis=1)], axis=-1).reshape(-1, 2).tolist()))
    assert len(set(directed)) == len(directed)
    assert sum((b, a) not in set(directed) for a, b in directed) == boundary


def test_a_box_becomes_a_sphere():
    cage = Cage()
    cage.box((2, 3, 4), lambda cube: cube)
    points, quads = cage.mesh(lambda p: project(lambda q: np.linalg.norm(q, axis=1) - 1.0, p))
    assert len(quads) == 16 * 2 * (2 * 3 + 3 * 4 + 4 * 2) and euler(points, quads) == 2
    assert_oriented(quads, 0)
    assert np.abs(np.linalg.norm(points, axis=1) - 1.0).max() < 2e-4
    assert volume(points, quads) == pytest.approx(4 / 3 * np.pi, rel=0.01)


@pytest.mark.parametrize("capped, boundary", [(True, 0), (False, 8 * 4)])
def test_a_limb_pulled_out_of_a_box(capped, boundary):
    joints, radii = [(0.8, 0, 0), (1.5, 0, 0.1), (2.2, 0, 0.3)], [0.4, 0.35, 0.3]

    def field(p):
        return np.minimum(np.linalg.norm(p, axis=1) - 1.0, chain(p, joints, radii))

    cage = Cage()
    box = cage.box((4, 4, 4), lambda cube: cube * 0.6)
    ring = cage.open(box["right"][1:4, 1:4])
    widths = [(r, r) for r in radii]
    rings = cage.tube(ring, limb_sections(oval(8, 2, 2), joints, widths, (0, 1, 0), 6))
    if capped:
        cage.cap(rings[-1], 2, 2)
    points, quads = cage.mesh(lambda p: project(field, p))
    assert_oriented(quads, boundary)
    assert euler(points, quads) == (2 if capped else 1)
    assert points[:, 0].max() > 2.1


def test_the_rule_of_catmull_and_clark_on_a_cube():
    cage = Cage()
    cage.box((1, 1, 1), lambda cube: cube)
    points, quads = catmull_clark(np.array(cage.points), np.array(cage.quads))
    assert len(points) == 26 and len(quads) == 24
    # A corner of [-1, 1]^3 goes to 5/9, the middle of an edge to 3/4, that of a face stays.
    assert sorted({round(np.abs(p).max(), 12) for p in points}) == pytest.approx([5 / 9, 3 / 4, 1.0])


def test_mirror_images_are_so_to_the_bit():
    joints, radii = [(0.5, 0, 0), (1.2, 0.2, 0), (1.6, 0.1, 0.5)], [0.3, 0.3, 0.25]

    def field(p):
        sides = (chain(p * (side, 1, 1), joints, radii) for side in (1, -1))
        return np.minimum(np.linalg.norm(p, axis=1) - 1.0, np.minimum(*sides))

    cage = Cage()
    box = cage.box((4, 4, 4), lambda cube: cube * 0.6)
    for side, name in ((1, "right"), (-1, "left")):
        ring = cage.open(box[name][1:4, 1:4])
        sections = limb_sections(oval(8, 2, 2), joints, [(r, r) for r in radii], (0, 1, 0), 5, side)
        cage.cap(cage.tube(ring, sections)[-1], 2, 2)
    points, quads = cage.mesh(lambda p: project(field, p))
    assert_oriented(quads, 0)
    places = set(map(tuple, points.tolist()))
    assert all((-x, y, z) in places for x, y, z in places)
