#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What becomes of random surfaces (`make reliability`): out/reliability/, and the tables of docs/reliability.md.

    bench/reliability.py [--surfaces N] [--kinds KIND,...] [--write]

Of each kind of random_surfaces.py N surfaces are mapped, with options that change from one to the next. Every answer is
checked here by code that shares nothing with the library; then every fourth surface comes again renumbered, turned and
scaled, every tenth with one thread and with several calls at once. A kind runs in a process of its own, so that a crash
is counted, not suffered. --write puts the tables into docs/figures.json and the page. Exit 1 if an answer was wrong.
"""

import argparse
import itertools
import json
import os
import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

sys.dont_write_bytecode = True
ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "build" / "python"))

import koebe  # noqa: E402
import numpy as np  # noqa: E402
import promises  # noqa: E402
import random_surfaces  # noqa: E402

OUT = ROOT / "out" / "reliability"
OPTIONS = ({}, {"balance": "area"}, {}, {"method": "ck"}, {}, {"engine": "mesh"}, {"polish": True})
SMALL = 400  # faces; larger ones are mapped as by default, since the mesh engine takes long
SAME = 1e-6  # of the unit disk, up to a rotation
OUTCOMES = ("right", "error", "not converged", "wrong")
VARIANTS = ("renumbered", "turned", "scaled")
EVERY_CHANGED, EVERY_REPEATED = 4, 10  # surfaces
AT_ONCE = 8  # calls
LIMIT = 60.0  # seconds a surface may take on the mean of its kind


def mapped(vertices, triangles, **options):
    """The result, or the name of the typed error."""
    try:
        return koebe.uniformize(vertices, triangles, **options)
    except koebe.KoebeError as error:
        return type(error).__name__


def variants(vertices, triangles, rng):
    """The same surface renumbered, turned and moved, scaled: name, vertices, triangles, its number of each vertex."""
    number = rng.permutation(len(vertices))
    shuffled = np.empty_like(vertices)
    shuffled[number] = vertices
    faces = number[triangles[rng.permutation(len(triangles))]]
    faces = np.array([np.roll(face, rng.integers(3)) for face in faces], np.int32)
    turn, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    turn *= np.sign(np.linalg.det(turn))
    own = np.arange(len(vertices))
    yield "renumbered", shuffled, faces, number
    yield "turned", vertices @ turn.T + np.ptp(vertices) * rng.normal(size=3), triangles, own
    yield "scaled", vertices * rng.choice([0.3, 1e-5, 777.7]), triangles, own


def difference(one, other, number):
    """The largest distance of two maps of one surface, after the best rotation; infinite if one of them is an error."""
    if isinstance(one, str) or isinstance(other, str):
        return 0.0 if isinstance(one, str) and one == other else np.inf
    a, b = one.uv @ [1, 1j], other.uv[number] @ [1, 1j]
    turn = np.vdot(a, b)
    return float(np.abs(a * (turn / abs(turn) if abs(turn) > 0 else 1) - b).max())


def bits(result):
    """All that may not change by a bit."""
    if isinstance(result, str):
        return result
    return result.uv.tobytes(), result.centers.tobytes(), result.radii.tobytes()


def examine(kind, seed):
    """One surface: what came of it."""
    surface = random_surfaces.make(kind, seed)
    if surface is None:
        return {"outcome": "nothing"}
    vertices, triangles = surface
    options = OPTIONS[seed % len(OPTIONS)] if len(triangles) <= SMALL else {}
    result = mapped(vertices, triangles, **options)
    found = {"faces": len(triangles), "seed": seed, "options": options}
    if isinstance(result, str):
        found |= {"outcome": "error", "error": result}
    else:
        broken = promises.broken(triangles, result)
        found |= {
            "outcome": "wrong" if broken else "right" if result.converged else "not converged",
            "broken": broken,
            "loop_vertices": sum(map(len, result.loops)),
            "off_circle": sum(map(len, result.off_circle)),
            "below": result.below_resolution,
        }
    if seed % EVERY_CHANGED == 0:
        found["change"] = {
            name: difference(result, mapped(*again, **options), number)
            for name, *again, number in variants(vertices, triangles, np.random.default_rng(seed))
        }
    if seed % EVERY_REPEATED == 0:
        with ThreadPoolExecutor(AT_ONCE) as pool:
            calls = [pool.submit(mapped, vertices, triangles, threads=1 + k % 2, **options) for k in range(AT_ONCE)]
        found["bits"] = all(bits(call.result()) == bits(result) for call in calls)
    return found


def survey(kind, count):
    """All surfaces of a kind, each process going on behind the surface that ended the one before."""
    rows = []
    while len(rows) < count:
        words = [sys.executable, __file__, "--kinds", kind, "--from", str(len(rows)), "--surfaces", str(count)]
        with subprocess.Popen(words, stdout=subprocess.PIPE, text=True) as process:
            watch = threading.Timer(LIMIT * (count - len(rows)), process.kill)
            watch.start()
            rows += [json.loads(line) for line in process.stdout]
            watch.cancel()
        if len(rows) < count:
            how = f"the process ended with {process.returncode}"
            row = {"outcome": "wrong", "broken": [how], "seed": len(rows), "options": {}, "faces": 0}
            rows.append(row)
    return rows


def summary(rows):
    """Counts of some rows, as they stand in the table."""
    there = [row for row in rows if row["outcome"] != "nothing"]
    outcomes = [sum(row["outcome"] == name for row in there) for name in OUTCOMES]
    loop_vertices = sum(row.get("loop_vertices", 0) for row in there)
    off = sum(row.get("off_circle", 0) for row in there)
    again = [row["change"] for row in there if row.get("change")]
    changed = [sum(change[name] > SAME for change in again) for name in VARIANTS]
    asked = [row["bits"] for row in there if row.get("bits") is not None]
    return [
        f"{len(there):,}",
        *(f"{number:,}" for number in outcomes),
        f"{100 * off / max(loop_vertices, 1):.1f} %",
        *(f"{number:,} of {len(again):,}" for number in changed),
        f"{asked.count(False)} of {len(asked)}",
    ]


HEAD = [
    "kind", "surfaces", "right", "error", "not converged", "wrong", "off circle",
    "other map when renumbered", "turned", "scaled", "other bits",
]  # fmt: skip


def cancel_delays(tries=12):
    """Seconds from a cancel to the end of the call, on a plate of 300,000 faces, after waits of all lengths."""
    m = 401
    x, y = (part.ravel() for part in np.meshgrid(np.linspace(-1, 1, m), np.linspace(-1, 1, m)))
    i = (m * np.arange(m - 1)[:, None] + np.arange(m - 1)).ravel()
    faces = np.concatenate([np.column_stack([i, i + 1, i + m]), np.column_stack([i + 1, i + m + 1, i + m])])
    middle = np.column_stack([x, y])[faces].mean(axis=1)
    faces = faces[(np.abs(np.abs(middle) - 0.5).max(axis=1) > 0.1)].astype(np.int32)
    vertices = np.column_stack([x, y, 0.2 * np.sin(4 * x) * np.cos(3 * y)])
    start = time.perf_counter()
    koebe.uniformize(vertices, faces)
    whole = time.perf_counter() - start
    delays = []
    for k in range(tries):
        token, asked = koebe.CancelToken(), []

        def stop(token=token, asked=asked):
            asked.append(time.perf_counter())
            token.cancel()

        waker = threading.Timer(whole * (k + 0.5) / tries, stop)
        waker.start()
        try:
            koebe.uniformize(vertices, faces, cancel=token)
        except koebe.Cancelled:
            delays.append(time.perf_counter() - asked[0])
        waker.join()
    return len(faces), delays


def parse():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--surfaces", type=int, default=100, help="of each kind")
    parser.add_argument("--kinds", default=",".join(random_surfaces.KINDS))
    parser.add_argument("--from", dest="first", type=int, help="print each surface from this one on, as JSON")
    parser.add_argument("--write", action="store_true", help="into docs/")
    return parser.parse_args()


def main():
    options = parse()
    kinds = options.kinds.split(",")
    if options.first is not None:
        for kind, seed in itertools.product(kinds, range(options.first, options.surfaces)):
            print(json.dumps(examine(kind, seed)), flush=True)
        return 0
    OUT.mkdir(parents=True, exist_ok=True)
    found, table = {}, {}
    with ThreadPoolExecutor(os.cpu_count() or 1) as pool:
        for kind, rows in zip(kinds, pool.map(lambda kind: survey(kind, options.surfaces), kinds)):
            found[kind], table[kind] = rows, summary(rows)
            print("|", kind, "|", " | ".join(table[kind]), "|", flush=True)
    table["all"] = summary([row for rows in found.values() for row in rows])
    print("| all |", " | ".join(table["all"]), "|")
    bad = [(kind, row) for kind, rows in found.items() for row in rows if not kept(row)]
    for kind, row in bad[:40]:
        changes = {name: change for name, change in row.get("change", {}).items() if change > SAME}
        print(f"{kind} {row['seed']}, {row['faces']} faces, {row['options']}: {row.get('broken') or ''} {changes}")
    (OUT / "surfaces.json").write_text(json.dumps(found) + "\n", encoding="utf-8")
    faces, delays = cancel_delays()
    cancel = [f"{faces:,}", str(len(delays)), f"{np.median(delays):.3f}", f"{max(delays):.3f}"] if delays else []
    print(f"cancel: {cancel}")
    if options.write:
        write(table, cancel)
    return int(any(row["outcome"] == "wrong" for rows in found.values() for row in rows))


def kept(row):
    """Whether nothing is to be told of a surface."""
    same = all(change <= SAME for change in row.get("change", {}).values())
    return row["outcome"] != "wrong" and same and row.get("bits") is not False


def write(table, cancel):
    """The tables into docs/figures.json and the page."""
    import doc_figures

    figures = doc_figures.load()
    figures["reliability"] = {"command": "make reliability", "head": HEAD, "rows": table}
    head = ["a surface of", "faces", "cancels", "median s", "longest s"]
    figures["cancel"] = {"command": "make reliability", "head": head, "rows": {"a plate, four holes": cancel}}
    doc_figures.save(figures)
    doc_figures.write()


if __name__ == "__main__":
    sys.exit(main())
