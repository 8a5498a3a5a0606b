# SPDX-License-Identifier: GPL-3.0-or-later
"""The factors by which a sweep lowers the error, predicted from the circles alone and measured (docs/method.md, "How
fast", M12): CK, the first algorithm, GK step after step, and all loops at once."""

import math
import random

import numpy as np
import print_choices

# Of many draws, most of them with the first eigenvalues apart, so that a run shows the first before it ends.
SEEDS = ((2, 1), (2, 4), (2, 13), (3, 2), (3, 4), (3, 142), (4, 52), (4, 87), (5, 8), (5, 313), (6, 11), (7, 18))
DOMAINS = {f"{holes} holes, draw {seed}": (holes, seed) for holes, seed in SEEDS}
GAP = 0.04  # between circles, at least
MODES = 40  # of a loop's error
VERTICES = 8000
RUNS = {"CK": ("condensed", "ck"), "first": ("condensed", "against-outer"), "GK": ("mesh", "gk")}
RUNS["at once"] = ("condensed", "gk")
LAST = 1e-11  # the error, about, at which a run ends; rounding is 1e-14
DIED_OUT = 0.02  # share of the next eigenvalue in a run, at most
HEAD = ["circles", *(f"{name}: predicted, measured" for name in RUNS), "log GK / log CK", "log GK / log first"]


def draw(holes, seed):
    """The unit circle and circles inside it, apart, of random sizes."""
    rnd = random.Random(seed)
    while True:
        circles = [(0j, 1.0)]
        for _ in range(4000):
            r, c = rnd.uniform(0.5, 0.75) / np.sqrt(holes), complex(rnd.uniform(-1, 1), rnd.uniform(-1, 1))
            if abs(c) + r < 1 - GAP and all(abs(c - d) - r - s > GAP for d, s in circles[1:]):
                circles.append((c, r))
            if len(circles) > holes:
                return circles


def turned_out(circles):
    """The circles after 1 / (z - p), p in the domain: all disks are bounded then. p keeps them as far apart, for their
    sizes, as it can."""
    x = np.linspace(-1, 1, 61)
    grid = (x[:, None] + 1j * x).ravel()
    inside = (abs(grid) < 1) & np.all([abs(grid - c) > r for c, r in circles[1:]], axis=0)

    def seen_from(p):
        power = [abs(c - p) ** 2 - r * r for c, r in circles]
        return [(np.conj(c - p) / q, r / abs(q)) for (c, r), q in zip(circles, power)]

    def crowded(p):
        seen = seen_from(p)
        return max((r + s) / abs(c - d) for k, (c, r) in enumerate(seen) for d, s in seen[:k])

    return seen_from(min(grid[inside], key=crowded))


def proved(circles):
    """The factor below which docs/proof.md brings every sweep: 1 / t^4, t as large as P1 allows."""
    seen = turned_out(circles)
    return max((r + s) / abs(c - d) for k, (c, r) in enumerate(seen) for d, s in seen[:k]) ** 4


def interaction(circles):
    """M: what errors of the other loops leave of loop i, opened alone, as a real matrix. Blocks of 2 MODES: real and
    imaginary parts of the modes from 2 on; a takes the conjugate of the others'."""
    orders = range(2, MODES + 2)

    def block(c, r, d, s):
        w = c - d
        m = [[math.comb(p + q - 1, p + 1) * (s / w) ** (q - 1) * (-r / w) ** (p + 1) for q in orders] for p in orders]
        m = s / r * np.array(m)
        return np.block([[m.real, m.imag], [m.imag, -m.real]])

    zero = np.zeros((2 * MODES, 2 * MODES))
    rows = [[zero if i == j else block(*a, *b) for j, b in enumerate(circles)] for i, a in enumerate(circles)]
    return np.block(rows)


def in_turn(m, steps):
    """What a sweep makes of the errors: each step solves for the loops that it opens."""
    total = np.eye(len(m))
    for loops in steps:
        opened = np.concatenate([np.arange(2 * MODES) + 2 * MODES * k for k in loops])
        others = np.setdiff1d(np.arange(len(m)), opened)
        given = m[np.ix_(opened, others)] @ total[others]
        total[opened] = np.linalg.solve(np.eye(len(opened)) - m[np.ix_(opened, opened)], given)
    return total


def at_once(m, n):
    """Each loop against loop 0, from the same state."""
    b = 2 * MODES
    s = m[b:, b:] + m[b:, :b] @ m[:b, b:]
    own = np.kron(np.eye(n - 1), np.ones((b, b))) * s
    return np.linalg.solve(np.eye(len(s)) - own, s - own)


def sweeps(n):
    pairs = [(k, k + 1) for k in range(0, n - 1, 2)] + [(0, n - 1)] * (n % 2)
    return {"CK": [(k,) for k in range(n)], "first": [(0, k) for k in range(1, n)], "GK": pairs}


def predicted(circles):
    """The eigenvalues of each sweep, largest first; the first is the factor in the end."""
    m, n = interaction(turned_out(circles)), len(circles)
    matrices = {name: in_turn(m, steps) for name, steps in sweeps(n).items()} | {"at once": at_once(m, n)}
    found = {name: np.linalg.eigvals(matrix) for name, matrix in matrices.items()}
    return {name: values[np.argsort(-np.abs(values))] for name, values in found.items()}


def measured(koebe, mesh, run, values):
    """The first eigenvalue by the circles after late sweeps: the largest root of the recurrence that fits best. The
    first eigenvalues may be pairs, conjugate or of two signs, so it has two terms; all at once has two such pairs.
    None where the next eigenvalue has not died out by then."""
    engine, method = RUNS[run]
    factor, terms = abs(values[0]), 4 if run == "at once" else 2
    last = max(2 * terms + 1, min(18, round(math.log(LAST) / math.log(factor))))
    if (abs(values[terms]) / factor) ** (last - terms) > DIED_OUT:
        return None
    found = []
    for count in range(last - 2 * terms, last + 1):
        result = koebe.uniformize(*mesh, engine=engine, method=method, max_sweeps=count, tolerance=1e-15)
        found.append(print_choices.inversive_distances(list(zip(result.centers @ [1, 1j], result.radii))))
    moved = np.diff(found, axis=0) / found[-1] / factor ** np.arange(2 * terms)[:, None]
    scale = 1.0 / np.linalg.norm(moved[terms:], axis=1).repeat(moved.shape[1])
    before = [moved[terms - k : 2 * terms - k].ravel() * scale for k in range(1, terms + 1)]
    recurrence = np.linalg.lstsq(np.transpose(before), moved[terms:].ravel() * scale, rcond=0.05)[0]
    return factor * float(np.max(np.abs(np.roots([1.0, *-recurrence]))))


def factors(koebe, row):
    """Predicted and measured, and the number of loops."""
    circles = draw(*DOMAINS[row])
    points, triangles, on_circle = print_choices.domain(VERTICES, circles)
    loops = koebe.uniformize(points, triangles).loops
    circles = [circles[next(k for k, v in enumerate(on_circle) if v in loop)] for loop in loops]
    expected = predicted(circles)
    return expected, {run: measured(koebe, (points, triangles), run, expected[run]) for run in RUNS}, len(circles)


def cells(koebe, row):
    """A row; the logarithms are of predicted factors, for equally many steps."""
    expected, found, n = factors(koebe, row)
    both = [f"{abs(expected[run][0]):.3g}, {f'{found[run]:.3g}' if found[run] else '—'}" for run in RUNS]
    a_step = {name: math.log(abs(expected[name][0])) / len(steps) for name, steps in sweeps(n).items()}
    return [*both, *(f"{a_step['GK'] / a_step[other]:.2f}" for other in ("CK", "first"))]
