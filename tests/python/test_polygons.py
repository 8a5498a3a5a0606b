"""A polygon that is convex on the surface is convex in the UVs, or a warning lists it."""

import itertools
import json
import math

import numpy as np
import pytest
from cli_support import koebe as run


def kites(sides, rings):
    """A closed tube: rings of quadrilaterals, its ends covered by kites round a vertex."""
    circle = [(math.cos(2 * math.pi * i / sides), math.sin(2 * math.pi * i / sides)) for i in range(sides)]
    points = [(x, y, 0.3 * z) for z in range(rings + 1) for x, y in circle]
    faces = [
        [j * sides + i, j * sides + (i + 1) % sides, (j + 1) * sides + (i + 1) % sides, (j + 1) * sides + i]
        for j in range(rings)
        for i in range(sides)
    ]
    for ring, height, turn in ((0, -0.2, -1), (rings, 0.3 * rings + 0.2, 1)):
        points.append((0.0, 0.0, height))
        for i in range(0, sides, 2):
            corners = [
                ring * sides + i,
                ring * sides + (i + 1) % sides,
                ring * sides + (i + 2) % sides,
                len(points) - 1,
            ]
            faces.append(corners[::turn])
    return np.array(points), faces


def bumpy(seed, width=14):
    """A jittered grid of quadrilaterals over the plane, with a hole."""
    random = np.random.default_rng(seed)
    at = np.indices((width + 1, width + 1)).reshape(2, -1).T + random.uniform(-0.3, 0.3, ((width + 1) ** 2, 2))
    points = np.column_stack([at / width, 0.3 * np.sin(at / 2).sum(axis=1)])
    faces = [
        [i * (width + 1) + j, (i + 1) * (width + 1) + j, (i + 1) * (width + 1) + j + 1, i * (width + 1) + j + 1]
        for i, j in itertools.product(range(width), repeat=2)
        if not (4 < i < 8 and 5 < j < 8)
    ]
    used, again = np.unique(np.concatenate(faces), return_inverse=True)
    return points[used], again.reshape(-1, 4).tolist()


def cross(a, b, c):
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def is_convex(corners, least=0.0):
    return all(cross(*three) > least for three in itertools.combinations(corners, 3))


def is_convex_in_space(corners):
    """By the projection to the plane of the polygon's area vector."""
    normal = sum(np.cross(a, b) for a, b in zip(corners, np.roll(corners, -1, axis=0), strict=True))
    area = np.linalg.norm(normal)
    across = np.cross(normal, corners[1] - corners[0])
    plane = np.column_stack([across, np.cross(normal, across)]) / np.linalg.norm(across)
    return is_convex((corners @ plane) / [1.0, area], 1e-6 * area)


def written(path):
    uvs, faces = [], []
    for line in path.read_text().splitlines():
        words = line.split()
        if words[:1] == ["vt"]:
            uvs.append([float(np.float32(word)) for word in words[1:3]])
        elif words[:1] == ["f"]:
            faces.append([int(word.split("/")[1]) - 1 for word in words[1:]])
    return [[uvs[i] for i in face] for face in faces]


@pytest.mark.parametrize(
    "surface, arguments, most",
    [
        (kites(32, 3), ["uniformize", "--cut"], 0),
        (kites(16, 3), ["parts"], 0),
        (kites(8, 2), ["uniformize", "--cut", "--even", "1"], 0),
        (bumpy(1), ["uniformize"], 4),  # the corners of the hole
        (bumpy(2), ["ring"], 8),  # the corners of both loops
    ],
    ids=lambda value: value[0] if isinstance(value, list) else "",
)
def test_a_convex_polygon_is_convex_in_the_uvs_or_listed(tmp_path, surface, arguments, most):
    points, faces = surface
    lines = [f"v {x:.9g} {y:.9g} {z:.9g}" for x, y, z in points]
    lines += ["f " + " ".join(str(v + 1) for v in face) for face in faces]
    (tmp_path / "in.obj").write_text("\n".join(lines) + "\n")
    run(arguments[0], tmp_path / "in.obj", tmp_path / "out.obj", "--json", tmp_path / "report.json", *arguments[1:])
    report = json.loads((tmp_path / "report.json").read_text())
    listed = [f for one in report["warnings"] if one["kind"] == "concave_polygons" for f in one["elements"]]
    concave = [
        f
        for f, corners in enumerate(written(tmp_path / "out.obj"))
        if not is_convex(corners) and is_convex_in_space(points[faces[f]])
    ]
    assert sorted(listed) == concave
    assert report["concave_polygons"] == len(listed) <= most and report["flipped"] == 0
