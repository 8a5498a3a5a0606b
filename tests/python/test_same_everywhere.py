"""The same surface gets the same map on every system, with every processor's kernels: to 1e-9 of the unit disk.

`same_everywhere.json` has circles and points of maps made by a build for Debian 12 (GCC, GNU's C++ library).
`python tests/python/test_same_everywhere.py` alone compares too, without pytest, wherever `koebe` and NumPy are; with
--write it makes the file anew.
"""

import json
import sys
from pathlib import Path

import koebe
import numpy as np

REFERENCE = Path(__file__).with_name("same_everywhere.json")
TOLERANCE = 1e-9  # of the unit disk
SHOWN = 40  # vertices of each map in the file


def plate(columns, rows, holes, bend):
    """A bent plate of triangles with holes. Polynomials alone, so that it has the same bits everywhere."""
    x, y = np.meshgrid(np.linspace(-1.0, 1.0, columns), np.linspace(-0.75, 0.75, rows))
    x, y = (x + 0.01 * y * y).ravel(), (y + 0.013 * x * x * x).ravel()  # no two edges alike
    faces = []
    for j in range(rows - 1):
        for i in range(columns - 1):
            a = j * columns + i
            faces += [[a, a + 1, a + columns + 1], [a, a + columns + 1, a + columns]]
    faces = np.array(faces)
    kept = np.ones(len(faces), dtype=bool)
    for u, v, radius in holes:
        middle_x, middle_y = x[faces].mean(axis=1), y[faces].mean(axis=1)
        kept &= (middle_x - u) ** 2 + (middle_y - v) ** 2 > radius**2
    faces = faces[kept]
    used, faces = np.unique(faces, return_inverse=True)
    vertices = np.column_stack([x, y, bend * (x * x - 0.6 * x * y + 0.4 * y * y * y)])[used]
    return vertices, faces.reshape(-1, 3).astype(np.int32)


THREE = [(-0.5, 0.1, 0.2), (0.31, 0.27, 0.15), (0.4, -0.37, 0.22)]
MANY = [(-0.72 + 0.36 * i, -0.42 + 0.41 * j, 0.07 + 0.012 * (i + j)) for i in range(5) for j in range(3)]
MAPS = {
    "disk": lambda: koebe.uniformize(*plate(33, 25, [], 0.4)),
    "annulus": lambda: koebe.uniformize(*plate(41, 31, THREE[:1], 0.5)),
    "three holes": lambda: koebe.uniformize(*plate(49, 37, THREE, 0.5)),
    "three holes, ck": lambda: koebe.uniformize(*plate(49, 37, THREE, 0.5), method="ck"),
    "three holes, mesh": lambda: koebe.uniformize(*plate(49, 37, THREE, 0.5), engine="mesh"),
    "three holes, even": lambda: koebe.uniformize(*plate(49, 37, THREE, 0.5), balance="area"),
    "fifteen holes": lambda: koebe.uniformize(*plate(101, 76, MANY, 0.9)),
    "coarse": lambda: koebe.uniformize(*plate(17, 13, [(-0.4, 0.0, 0.25), (0.45, 0.1, 0.2)], 0.3)),
}


def facts_of(result):
    chosen = np.linspace(0, len(result.uv) - 1, SHOWN).astype(int)
    off_circle = [vertex for loop in result.to_dict()["loops"] for vertex in loop["off_circle"]]
    return {
        "centers": np.asarray(result.centers).tolist(),
        "radii": np.asarray(result.radii).tolist(),
        "points": result.uv[chosen].tolist(),
        "off circle": result.uv[off_circle].tolist(),
        "flipped": result.flipped,
        "converged": result.converged,
        "steps": result.steps,
    }


def difference(found, expected):
    """The largest difference of a circle or a point, in the unit disk."""
    return max(np.abs(np.array(found[name]) - np.array(expected[name])).max(initial=0.0)
               for name in ("centers", "radii", "points", "off circle"))  # fmt: skip


def pytest_generate_tests(metafunc):
    metafunc.parametrize("name", MAPS)


def test_the_map_is_that_of_every_other_build(name):
    expected, found = json.loads(REFERENCE.read_text(encoding="utf-8"))[name], facts_of(MAPS[name]())
    assert difference(found, expected) < TOLERANCE
    assert {key: found[key] for key in ("flipped", "converged", "steps")} == {
        key: expected[key] for key in ("flipped", "converged", "steps")
    }


def main():
    if "--write" in sys.argv:
        facts = {name: facts_of(run()) for name, run in MAPS.items()}
        REFERENCE.write_text(json.dumps(facts, indent=0) + "\n", encoding="utf-8")
        return
    expected, worst = json.loads(REFERENCE.read_text(encoding="utf-8")), 0.0
    for name, run in MAPS.items():
        found = facts_of(run())
        far = difference(found, expected[name])
        worst = max(worst, far)
        print(f"{name}: {far:.1e}, {found['steps']} steps ({expected[name]['steps']})")
    print(f"{koebe.__file__}: {'the same' if worst < TOLERANCE else 'DIFFERENT'}, {worst:.1e} at most")
    sys.exit(worst >= TOLERANCE)


if __name__ == "__main__":
    main()
