# SPDX-License-Identifier: GPL-3.0-or-later
"""Time and memory of every command on surfaces made to be slow, over four sizes, against the bounds that hold for all.

Usage: time_bounds.py [--commands A,B] [--kinds A,B] [--sizes N,N] [--cancel]

For each command and kind: processor seconds and peak memory at each size, and the exponent of the time between the two
largest sizes that take longer than SHORT. `!` marks what is over a bound: SECONDS, the memory of `most_memory`, GROWTH.
--cancel interrupts the largest size half-way and times the end. Exit 1 if a bound is broken.
"""

import argparse
import os
import resource
import signal
import subprocess
import sys
import tempfile
import threading
import time
from itertools import pairwise
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
KOEBE = ROOT / "build" / "koebe"
SIZES = (1500, 4900, 15500, 49000)  # faces
SECONDS = ((5000, 1.0), (50000, 5.0))  # of the processor, below so many faces
BASE_MB, MB_A_FACE = 300, 0.004
GROWTH = 1.3  # exponent of the time
SHORT = 0.1  # seconds: below it the start of the process hides the growth
ENDED = 0.1  # seconds from an interrupt to the end
LIMIT = 20  # processor seconds until a run is stopped


def strip(first, second, closed):
    """Faces between two rows of vertices of one length."""
    ahead, beside = np.roll(first, -1), np.roll(second, -1)
    faces = np.stack([np.stack([first, ahead, beside], 1), np.stack([first, beside, second], 1)], 1)
    return (faces if closed else faces[:-1]).reshape(-1, 3)


def circle(n, radius=1.0, height=0.0):
    angle = 2 * np.pi * np.arange(n) / n
    return np.column_stack([radius * np.cos(angle), radius * np.sin(angle), np.broadcast_to(height, n)])


def grid(m, n, round_m=False, round_n=False):
    """Faces of m rows of n vertices, perhaps closed round."""
    rows = np.arange(m * n).reshape(m, n)
    return np.concatenate([strip(rows[i], rows[(i + 1) % m], round_n) for i in range(m if round_m else m - 1)])


def fan(n):
    """All faces round one vertex, flat."""
    return cone(n, height=0.0)


def cone(n, height=3.0, star=1.0):
    """All faces round one apex. @param star radius of every second vertex of the rim"""
    i = np.arange(n)
    rim = circle(n, np.where(i % 2, star, 1.0))
    return np.vstack([rim, [[0, 0, height]]]), np.column_stack([i, np.roll(i, -1), np.full(n, n)])


def star_cone(n):
    return cone(n + n % 2, star=0.3)


def two_stars(n):
    """A closed surface of two vertices that are joined to all others."""
    n //= 2
    vertices, faces = cone(n, 1.0)
    return np.vstack([vertices, [[0, 0, -1]]]), np.vstack([faces, np.where(faces == n, n + 1, faces)[:, ::-1]])


def soup(n):
    """A ball, no face of which is joined to another."""
    vertices, faces = ball(n)
    return vertices[faces].reshape(-1, 3), np.arange(3 * len(faces)).reshape(-1, 3)


def tangle(n):
    """Random triangles between few vertices: edges of many faces."""
    rng = np.random.default_rng(n)
    faces = rng.integers(n // 2, size=(n, 3))
    return rng.normal(size=(n // 2, 3)), faces[(faces != np.roll(faces, 1, axis=1)).all(axis=1)]


def comb(n):
    """A strip with a tooth on every second face."""
    m = n // 5 * 2 + 1
    low = np.column_stack([np.arange(m), np.zeros(m), np.zeros(m)])
    high = low[:-1] + [0.5, 1, 0]
    tips = low[1:-1:2] + [0, 4, 0]
    i, j = np.arange(m - 1), np.arange(m - 2)
    t = np.arange(len(tips))
    faces = [np.column_stack([i, i + 1, m + i]), np.column_stack([m + j, j + 1, m + j + 1])]
    faces += [np.column_stack([m + 2 * t + 1, 2 * m - 1 + t, m + 2 * t])]
    return np.vstack([low, high, tips]), np.vstack(faces)


def long_loops(n):
    """All vertices on two loops."""
    m = n // 2
    rows = np.arange(2 * m).reshape(2, m)
    return np.vstack([circle(m, 2.0), circle(m, 1.0, 0.3)]), strip(rows[1], rows[0], True)[:, ::-1]


def long_tube(n, around=8):
    """A tube of many girths, two rims."""
    m = n // (2 * around) + 1
    rings = [circle(around, 1.0, 2 * np.pi * k / around) for k in range(m)]
    return np.vstack(rings), grid(m, around, round_n=True)


def huge_hole(n):
    """A plate whose hole has nearly all vertices: a frame of three rows."""
    m = n // 4
    rows = np.vstack([circle(m, r, 0.2 * np.cos(7 * np.arange(m))) for r in (1.0, 1.0 + 9 / m, 1.0 + 20 / m)])
    return rows, grid(3, m, round_n=True)[:, ::-1]


def plate(n, holes=4):
    """A wavy square with round holes."""
    m = int((n / 1.9) ** 0.5) + 1
    x, y = (part.ravel() for part in np.meshgrid(np.linspace(-1, 1, m), np.linspace(-1, 1, m)))
    faces = grid(m, m)
    middle = np.column_stack([x, y])[faces].mean(axis=1)
    spots = 0.5 * np.array([[-1, -1], [1, -1], [-1, 1], [1, 1]])[:holes]
    away = np.linalg.norm(middle[:, None] - spots, axis=2).min(axis=1)
    return np.column_stack([x, y, 0.3 * np.sin(4 * x) * np.cos(3 * y)]), faces[away > 0.1]


def ball(n):
    """A closed bumpy sphere of rings, with two poles."""
    m = max(3, int((n / 4) ** 0.5))
    height = np.pi * (np.arange(m) + 0.7) / (m + 0.4)
    rings = [circle(2 * m, np.sin(h), -np.cos(h)) * (1 + 0.2 * np.sin(3 * h)) for h in height]
    count, i = 2 * m * m, np.arange(2 * m)
    last = count - 2 * m + i
    caps = [np.column_stack([np.roll(i, -1), i, np.full(2 * m, count)])]
    caps += [np.column_stack([last, np.roll(last, -1), np.full(2 * m, count + 1)])]
    return np.vstack([*rings, [[0, 0, -1.1], [0, 0, 1.1]]]), np.vstack([grid(m, 2 * m, round_n=True), *caps])


def torus(n):
    m = max(3, int((n / 4) ** 0.5))
    u, v = (2 * np.pi * part.ravel() for part in np.meshgrid(np.arange(2 * m) / 2 / m, np.arange(m) / m, indexing="ij"))
    radius = 3 + np.cos(v) * (1 + 0.2 * np.sin(3 * u))
    return np.column_stack([radius * np.cos(u), radius * np.sin(u), np.sin(v)]), grid(2 * m, m, True, True)


def double_torus(n):
    """Two plates with four holes whose loops are joined by walls: four handles."""
    above, faces = plate(n // 2)
    _, used = np.unique(faces, return_inverse=True)
    above, faces = above[np.unique(faces)] + [0, 0, 0.4], used.reshape(-1, 3)
    edges = np.concatenate([faces[:, [k, (k + 1) % 3]] for k in range(3)])
    code, back = edges @ [len(above), 1], edges @ [1, len(above)]
    a, b = edges[~np.isin(code, back)].T
    k = len(above)
    walls = np.concatenate([np.column_stack([b, a, a + k]), np.column_stack([a + k, b + k, b])])
    return np.vstack([above, above * [1, 1, -1]]), np.vstack([faces, faces[:, ::-1] + k, walls])


KINDS = {
    kind.__name__: kind
    for kind in (
        fan, cone, star_cone, two_stars, soup, tangle, comb, long_loops, long_tube, huge_hole, plate, ball, torus,
        double_torus,
    )
}  # fmt: skip
OPEN = ("fan", "cone", "star_cone", "comb", "long_loops", "long_tube", "huge_hole", "plate")
HOLED = ("long_loops", "long_tube", "huge_hole", "plate")
CLOSED = ("two_stars", "ball")
TEMPLATE = '{"circles": [{"center": [0.0, 0.0], "radius": 0.4}]}'
# name: words, with IN, OUT and TEMPLATE for files; kinds
COMMANDS = {
    "uniformize": ("uniformize IN OUT.obj", OPEN),
    "uniformize --cut": ("uniformize --cut IN OUT.obj", tuple(KINDS)),
    "uniformize --even": ("uniformize --even 0.5 IN OUT.obj", HOLED),
    "uniformize --polish": ("uniformize --polish IN OUT.obj", HOLED),
    "uniformize mesh": ("uniformize --engine mesh IN OUT.obj", HOLED),
    "uniformize yamabe": ("uniformize --engine mesh --metric planar --annulus yamabe IN OUT.obj", HOLED),
    "ring": ("ring IN OUT.obj", HOLED),
    "ring radial": ("ring --holes radial IN OUT.obj", HOLED),
    "sphere": ("sphere IN OUT.obj", (*CLOSED, "plate", "long_tube", "fan")),
    "torus": ("torus IN OUT.obj", ("torus",)),
    "schottky": ("schottky IN OUT.obj", ("torus", "double_torus")),
    "ricci": ("ricci IN OUT.obj", HOLED),
    "fill": ("fill IN OUT.obj", HOLED),
    "module": ("module IN", HOLED),
    "module --certified": ("module --certified IN", HOLED),
    "compare": ("compare IN IN", HOLED),
    "compare --teichmueller": ("compare --teichmueller IN IN", ("plate",)),
    "transfer": ("transfer IN IN OUT.obj", HOLED),
    "fit": ("fit IN TEMPLATE OUT.obj", ("long_loops", "huge_hole")),
    "parts": ("parts IN OUT.obj", tuple(KINDS)),
    "flatten": ("flatten --page none IN OUT.svg", tuple(KINDS)),
    "lift": ("lift --perforate IN circles OUT.obj", OPEN),
    "lift ring": ("lift --shape ring --perforate IN circles OUT.obj", HOLED),
}


def write_obj(path, vertices, faces):
    with path.open("w", encoding="utf-8") as file:
        np.savetxt(file, vertices, "v %.9g %.9g %.9g")
        np.savetxt(file, faces + 1, "f %d %d %d")


def words(name, mesh, folder):
    (folder / "template.json").write_text(TEMPLATE, encoding="utf-8")
    files = {
        "IN": mesh,
        "TEMPLATE": folder / "template.json",
        "OUT.obj": folder / "out.obj",
        "OUT.svg": folder / "out.svg",
    }
    return [str(KOEBE), *(str(files.get(word, word)) for word in COMMANDS[name][0].split())]


def run(command, stop_after=None):
    """Exit code, processor seconds, peak MB, and the seconds from an interrupt to the end. None: stopped at LIMIT."""
    most = (resource.RLIMIT_CPU, (LIMIT, LIMIT))
    with subprocess.Popen(
        command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, preexec_fn=lambda: resource.setrlimit(*most)
    ) as process:
        asked = []

        def interrupt():
            asked.append(time.perf_counter())
            process.send_signal(signal.SIGINT)

        timer = threading.Timer(stop_after or 0.0, interrupt)
        if stop_after:
            timer.start()
        _, status, used = os.wait4(process.pid, 0)
        ended = time.perf_counter()
        timer.cancel()
        process.returncode = os.waitstatus_to_exitcode(status)
    seconds = used.ru_utime + used.ru_stime
    return process.returncode, seconds, used.ru_maxrss / 1024, ended - asked[0] if asked else None


def most_seconds(faces):
    return next((bound for most, bound in SECONDS if faces < most), float("inf"))


def most_memory(faces):
    return BASE_MB + MB_A_FACE * faces


def exponent(rows):
    """Of the time, between the last two sizes that took longer than SHORT; None if there are no two."""
    long = [(faces, seconds) for faces, _, seconds, _ in rows if seconds > SHORT]
    steps = [np.log(t / s) / np.log(n / m) for (m, s), (n, t) in pairwise(long)]
    return float(steps[-1]) if steps else None


def measure(name, kind, sizes, folder, cancel):
    """The row of a command and a kind, printed as it grows, and whether it keeps the bounds."""
    rows, good = [], True
    print(f"| {name} | {kind} |", end="", flush=True)
    for size in sizes:
        vertices, faces = KINDS[kind](size)
        mesh = folder / f"{kind}_{size}.obj"
        if not mesh.exists():
            write_obj(mesh, vertices, faces)
        code, seconds, memory, _ = run(words(name, mesh, folder))
        rows.append((len(faces), code, seconds, memory))
        over = seconds > most_seconds(len(faces)) or memory > most_memory(len(faces)) or code < 0
        good &= not over
        print(f" {seconds:.2f} s {memory:.0f} MB ({code}){' !' * over} |", end="", flush=True)
        if code < 0:
            break
    growth = exponent(rows)
    over = growth is not None and growth > GROWTH
    print(f" {growth:.2f}{' !' * over} |" if growth is not None else " |", end="", flush=True)
    if cancel and rows[-1][2] > SHORT:
        late = run(words(name, folder / f"{kind}_{sizes[-1]}.obj", folder), rows[-1][2] / 2)[3]
        over |= late is not None and late > ENDED
        print(f" {late:.2f} s{' !' * (late > ENDED)} |" if late else " ended |", end="")
    print(flush=True)
    return good and not over


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--commands", default=",".join(COMMANDS))
    parser.add_argument("--kinds", default=",".join(KINDS))
    parser.add_argument("--sizes", default=",".join(map(str, SIZES)))
    parser.add_argument("--cancel", action="store_true", help="interrupt the largest half-way too")
    options = parser.parse_args()
    sizes = [int(size) for size in options.sizes.split(",")]
    kept = True
    print("| command | surface |", " | ".join(f"{size:,}" for size in sizes), "| exponent |")
    with tempfile.TemporaryDirectory() as folder:
        for name in options.commands.split(","):
            for kind in COMMANDS[name][1]:
                if kind in options.kinds.split(","):
                    kept &= measure(name, kind, sizes, Path(folder), options.cancel)
    return int(not kept)


if __name__ == "__main__":
    sys.exit(main())
