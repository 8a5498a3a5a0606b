# SPDX-License-Identifier: GPL-3.0-or-later
"""koebe.planar on polygonal domains of the toolbox PlgCirMap (Nasser 2020, examples b2, b4 and b17): error and
processor seconds.

Usage: planar_domains.py        prints a table in Markdown
"""

import time

import koebe
import numpy as np

TOLERANCES = (1e-6, 1e-8, 1e-10)


def box(west, south, east, north):
    return np.array([west + 1j * south, east + 1j * south, east + 1j * north, west + 1j * north])


WINDOWS = [(28, 5, 31, 10), (22, 5, 25, 10), (13, 1, 19, 10), (7, 5, 10, 10), (1, 5, 4, 10), (28, 14, 31, 19),
           (22, 14, 25, 19), (17, 12, 19, 14), (13, 12, 15, 14), (17, 16, 19, 18), (13, 16, 15, 18), (17, 20, 19, 22),
           (13, 20, 15, 22), (7, 14, 10, 19), (1, 14, 4, 19)]  # fmt: skip
DOMAINS = {
    "b2": [np.array([2 + 2j, -3 + 2j, -2 - 2j, 2 - 2j]), box(0.5, 0, 1.5, 1)],
    "b4": [
        box(-2, -2, 2, 2),
        box(0.5, 0, 1.5, 1),
        np.array([-0.5 + 1j, -1.5, -1.5 + 1j]),
        np.array([-0.5j, 0.5 - 1j, 0.5 - 1.5j, -0.5 - 1.5j, -0.5 - 1j]),
    ],
    "b17": [
        np.array([16 + 32j, 22j, 0, 32, 32 + 22j]),
        np.array([16 + 29j, 23 + 24j, 9 + 24j]),
        *(box(*window) for window in WINDOWS),
    ],
}


def main():
    print("| domain | holes | corners | tolerance | error | unknowns | sweeps | seconds |")
    print("| --- " * 8 + "|")
    for name, rims in DOMAINS.items():
        for tolerance in TOLERANCES:
            began = time.process_time()
            found = koebe.planar(rims, tolerance=tolerance)
            seconds = time.process_time() - began
            corners = sum(map(len, rims))
            print(
                f"| {name} | {len(rims) - 1} | {corners} | {tolerance:.0e} | {found.error:.0e} | {found.unknowns:,} "
                f"| {found.sweeps} | {seconds:.2f} |"
            )


if __name__ == "__main__":
    main()
