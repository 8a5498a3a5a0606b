# SPDX-License-Identifier: GPL-3.0-or-later
"""Theorem 4.1 of the paper, measured: the maps f_n of a domain without a disk D_n to a ring converge to its Riemann map
f as D_n shrinks to a point p. All maps by koebe.planar, so that the errors are the theorem's and not a mesh's.

Usage: shrinking_disks.py        prints docs/data/shrinking_disks.csv
"""

import koebe
import numpy as np

SQUARE = np.array([-1 - 1j, 1 - 1j, 1 + 1j, -1 + 1j])
L_SHAPE = np.array([-1 - 1j, 1 - 1j, 1, 0, 1j, -1 + 1j])
ELLIPSE = {"ellipse": {"center": [0, 0], "half_axes": [1, 0.5]}}
DOMAINS = {  # rim, p, radius of D_0, places to compare at
    "ellipse, p in the middle": (ELLIPSE, 0j, 0.4, np.exp(2j * np.pi * np.arange(64) / 64)),
    "square, p off the middle": (SQUARE, 0.3 + 0.2j, 0.4, None),
    "L with a reentrant corner": (L_SHAPE, -0.5 - 0.4j, 0.4, None),
}
HALVINGS = range(8)


def places_of(rim, angles):
    """Places of a rim, corners as well."""
    if angles is not None:
        return angles.real + 0.5j * angles.imag
    t = np.arange(16) / 16
    return (rim[:, None] * (1 - t) + np.roll(rim, -1)[:, None] * t).ravel()


def riemann_map(rim, p, z):
    """Images of places z, p to 0 and the first place to 1."""
    found = koebe.planar([rim])
    w, origin = (found(np.atleast_1d(place)) @ [1, 1j] for place in (z, p))
    w = (w - origin) / (1 - np.conj(origin) * w)
    return w / w[0]


def ring_map(rim, p, radius, z):
    """The same of the map of the domain without a disk round p."""
    hole = {"circle": {"center": [p.real, p.imag], "radius": radius}}
    w = koebe.planar([rim, hole])(z) @ [1, 1j]
    return w / w[0]


def errors(name):
    """The greatest |f_n - f| on the rim for each halving of the disk."""
    rim, p, radius, angles = DOMAINS[name]
    z = places_of(rim, angles)
    f = riemann_map(rim, p, z)
    return [float(abs(ring_map(rim, p, radius * 2.0**-n, z) - f).max()) for n in HALVINGS]


def main():
    print("domain," + ",".join(f"error with {n} halvings" for n in HALVINGS) + ",factor at last")
    for name in DOMAINS:
        found = errors(name)
        print(f'"{name}",' + ",".join(f"{error:.1e}" for error in found) + f",{found[-2] / found[-1]:.2f}", flush=True)


if __name__ == "__main__":
    main()
