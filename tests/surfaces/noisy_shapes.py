"""Error bars under noise, and the power of the permutation test, on made populations: the tables of docs/shapes.md.

    PYTHONPATH=build/python python3 bench/noisy_shapes.py [bars] [power]

The surfaces are plates with three holes, bent at random. The noise is normal and independent at all vertices. The
effect is a larger third hole.
"""

import sys
from pathlib import Path

import koebe
import numpy as np

sys.path.append(str(Path(__file__).resolve().parents[1] / "python"))

from cli_support import perforated, triangles_of  # noqa: E402

HOLES = ((0.30, 0.30, 0.11), (0.70, 0.34, 0.13), (0.48, 0.72, 0.12))
PER_GROUP = 10
EFFECTS = (0.0, 0.025, 0.05, 0.1, 0.2, 0.4)


def plate(cells):
    """Vertices (V, 2) and triangles of the unit square without the holes; the rims are round."""
    vertices, quads = perforated(cells, HOLES)
    return vertices[:, :2], triangles_of(quads)


def bent(points, random, spread=0.02, effect=0.0):
    """Positions (V, 3) of a random member of the population."""
    x, y = points.T
    away = points - HOLES[2][:2]
    places = points + effect * away * np.exp(-(away**2).sum(axis=1) / (2 * 0.15**2))[:, None]
    waves = [np.sin(np.pi * (a * x + b * y) + phase) for a, b in ((1, 0), (0, 1), (1, 1), (2, 1), (1, 2))
             for phase in (0.0, 1.5)]  # fmt: skip
    moves = spread * np.tensordot(random.normal(size=(3, len(waves))), waves, axes=1) / np.sqrt(len(waves) / 2)
    return np.column_stack([places, 0.2 * np.sin(2.5 * x) * np.cos(2.0 * y)]) + moves.T


def mean_edge(positions, triangles):
    return np.linalg.norm(positions[triangles] - positions[np.roll(triangles, 1, axis=1)], axis=2).mean()


def bars(surfaces=10, cells=26):
    """A row for each level of noise: the noise found over the noise, errors within their bar, bar over error."""
    points, triangles = plate(cells)
    print("| noise, of an edge | noise found / noise | errors within their bar | median of bar / error | no bars |")
    print("| --- | --- | --- | --- | --- |")
    for level in (0.003, 0.01, 0.03, 0.1, 0.2, 0.3):
        random, found, inside, ratio, refused = np.random.default_rng(7), [], [], [], 0
        for _ in range(surfaces):
            true = bent(points, random)
            sigma = level * mean_edge(true, triangles)
            noisy = true + sigma * random.normal(size=true.shape)
            outer = int(koebe.uniformize(true, triangles).loops[0][0])
            try:
                exact, result = (koebe.uniformize(place, triangles, outer=outer) for place in (true, noisy))
                order = [next(k for k, loop in enumerate(result.loops) if one[0] in loop) for one in exact.loops]
                error = np.abs(koebe.conformal_module(result, order=order) - koebe.conformal_module(exact))
                bar = koebe.noise_error(result, order=order)
            except koebe.KoebeError:
                refused += 1
                continue
            found.append(koebe.vertex_noise(noisy, triangles) / sigma)
            inside += (error <= bar).tolist()
            ratio += (bar / error).tolist()
        cells_of = [f"{np.median(found):.2f}", f"{100 * np.mean(inside):.0f} %", f"{np.median(ratio):.1f}"]
        middle = " | ".join(cells_of if found else ["", "", ""])
        print(f"| {level} | {middle} | {refused} of {surfaces} |", flush=True)


def two_groups(points, triangles, random, effect):
    """The groups (N,) of a sample, and its distances (N, N), of modules and of separations."""
    groups = np.arange(2 * PER_GROUP) >= PER_GROUP
    maps = [koebe.uniformize(bent(points, random, 0.01, effect * other), triangles) for other in groups]
    orders = [by_vertex(one, maps[0]) for one in maps]
    tables = np.array([koebe.separations(one)[np.ix_(k, k)] for one, k in zip(maps, orders)])
    apart = np.sqrt(((tables[:, None] - tables[None]) ** 2).mean(axis=(2, 3)))
    return groups, {"modules": koebe.family(maps, orders=orders).distances, "separations": 0.5 * (apart + apart.T)}


def power(experiments=100, cells=20):
    """By effect: how often p is at most 0.05, by the kind of distance, and of how many experiments."""
    points, triangles = plate(cells)
    print(f"| third hole larger by | modules, p <= 0.05 | separations, p <= 0.05 | experiments of 2 x {PER_GROUP} |")
    print("| --- | --- | --- | --- |")
    found = {}
    for effect in EFFECTS:
        random, runs = np.random.default_rng(int(1000 * effect) + 3), experiments if effect else 2 * experiments
        hits = {"modules": 0, "separations": 0}
        for _ in range(runs):
            groups, distances = two_groups(points, triangles, random, effect)
            for kind in hits:
                hits[kind] += koebe.permutation_test(distances[kind], groups, permutations=999).p <= 0.05
        found[effect] = {kind: hit / runs for kind, hit in hits.items()}, runs
        rates = " | ".join(f"{100 * rate:.1f} %" for rate in found[effect][0].values())
        print(f"| {100 * effect:g} % | {rates} | {runs} |", flush=True)
    return found


def by_vertex(one, first):
    """The loops of a map in the order of the first map's, by a vertex of each."""
    return [next(k for k, loop in enumerate(one.loops) if wanted[0] in loop) for wanted in first.loops]


if __name__ == "__main__":
    chosen = sys.argv[1:] or ["bars", "power"]
    for name in chosen:
        {"bars": bars, "power": power}[name]()
