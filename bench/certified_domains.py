# SPDX-License-Identifier: GPL-3.0-or-later
"""Random plates with rectangular holes: how often certified_moduli encloses the module, and whether koebe.planar's
numbers are in the enclosures.

Usage: certified_domains.py [COUNT]        prints a table in Markdown
"""

import sys
import time

import koebe
import numpy as np
from planar_oracle import cells

SIDE = 12  # cells of the plate


def random_plate(random, holes):
    """Rectangles (west, south, east, north) of whole numbers that are a cell apart, the plate first."""
    found = [(0, 0, SIDE, SIDE)]
    while len(found) <= holes:
        west, south = random.integers(1, SIDE - 2, 2)
        east, north = west + random.integers(1, 5), south + random.integers(1, 5)
        inside = east < SIDE and north < SIDE
        if inside and all(
            east < other[0] or other[2] < west or north < other[1] or other[3] < south for other in found[1:]
        ):
            found.append((int(west), int(south), int(east), int(north)))
    return found


def plate_mesh(boxes):
    i, j = (a.ravel() for a in np.meshgrid(np.arange(SIDE + 1), np.arange(SIDE + 1)))
    inside = (i < SIDE) & (j < SIDE)
    for west, south, east, north in boxes[1:]:
        inside &= ~((i >= west) & (i < east) & (j >= south) & (j < north))
    return cells(np.stack([i, j], 1).astype(float), SIDE + 1, inside)


def corners(box):
    west, south, east, north = box
    return [(west, south), (east, south), (east, north), (west, north)]


def lowest_vertex(box):
    """Loops are numbered by their lowest vertices, which run along x first."""
    return box[1] * (SIDE + 1) + box[0]


def main():
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 10
    print("| loops | domains | enclosed | planar's numbers inside | seconds |")
    print("| --- " * 5 + "|")
    for loops in (2, 3, 4):
        random = np.random.default_rng(loops)
        enclosed = inside = 0
        began = time.perf_counter()
        for _ in range(count):
            boxes = random_plate(random, loops - 1)
            proved = koebe.certified_moduli(*plate_mesh(boxes), width=1e-3)
            if not proved.module:
                continue
            enclosed += 1
            boxes.sort(key=lowest_vertex)
            exact = koebe.planar([corners(box) for box in boxes])
            order = [exact.rims.tolist().index(loop) for loop in proved.module_loops]
            numbers = koebe.conformal_module(exact, order=order)
            bounds = proved.module.values()
            inside += all(low <= number <= high for number, (low, high) in zip(numbers, bounds, strict=True))
        print(f"| {loops} | {count} | {enclosed} | {inside} | {time.perf_counter() - began:.1f} |")


if __name__ == "__main__":
    main()
