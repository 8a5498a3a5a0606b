#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What becomes of random surfaces (`make reliability`): out/reliability/, and the tables of docs/reliability.md.

    bench/reliability.py [--surfaces N] [--kinds KIND,...] [--commands NAME,...] [--write]

Of each kind of random_surfaces.py N surfaces are mapped by each command that takes it (commands.py), the one map with
options that change from one to the next. Every answer is checked here by code that shares nothing with the library;
then every fourth surface comes again renumbered, turned and scaled, every tenth with one thread and with several calls
at once, and all of them with each set of dense kernels that the processor can run. A kind runs in a process of its own,
so that a crash is counted, not suffered. --write puts the tables into docs/figures.json and the page. Exit 1 if an
answer was wrong.
"""

import argparse
import hashlib
import itertools
import json
import os
import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "build" / "python"))

import commands  # noqa: E402
import koebe  # noqa: E402
import numpy as np  # noqa: E402

OUT = ROOT / "out" / "reliability"
OPTIONS = ({}, {"balance": "area"}, {}, {"method": "ck"}, {}, {"engine": "mesh"}, {"polish": True})
SMALL = 400  # faces; larger ones are mapped as by default, since the mesh engine takes long
SAME = 1e-6  # of the unit disk, up to a rotation
OUTCOMES = ("right", "error", "not converged", "wrong")
VARIANTS = ("renumbered", "turned", "scaled")
KERNELS = ("sse2", "avx2")  # beside those that fit the processor; a larger set than it has is that one
EVERY_CHANGED, EVERY_REPEATED = 4, 10  # surfaces
AT_ONCE = 8  # calls
LIMIT = 60.0  # seconds a surface may take on the mean of its kind


def bits(result):
    """All that may not change by a bit."""
    if isinstance(result, str):
        return result
    arrays = (result.uv, getattr(result, "centers", None), getattr(result, "radii", None))
    return hashlib.sha256(b"".join(a.tobytes() for a in arrays if a is not None)).hexdigest()


def examine(command, kind, seed, again=True):
    """One surface: what came of it. @param again whether it comes again in other ways"""
    surface = commands.surface(command, kind, seed)
    if surface is None:
        return {"outcome": "nothing"}
    vertices, triangles = surface
    options = OPTIONS[seed % len(OPTIONS)] if command == "uniformize" and len(triangles) <= SMALL else {}
    result = commands.answer(command, vertices, triangles, **options)
    found = {"faces": len(triangles), "seed": seed, "options": options, "digest": bits(result)}
    if isinstance(result, str):
        found |= {"outcome": "error", "error": result}
    else:
        broken = commands.COMMANDS[command].broken(triangles, result)
        converged = getattr(result, "converged", True)
        found |= {"outcome": "wrong" if broken else "right" if converged else "not converged", "broken": broken}
    if command == "uniformize" and not isinstance(result, str):
        found |= {
            "loop_vertices": sum(map(len, result.loops)),
            "off_circle": sum(map(len, result.off_circle)),
            "below": result.below_resolution,
        }
    if again and seed % EVERY_CHANGED == 0:
        found["change"] = {
            other.name: commands.difference(
                command, result, commands.answer(command, other.vertices, other.triangles, **options), other
            )
            for other in commands.variants(vertices, triangles, np.random.default_rng(seed))
        }
    if again and command == "uniformize" and seed % EVERY_REPEATED == 0:
        with ThreadPoolExecutor(AT_ONCE) as pool:
            calls = [
                pool.submit(commands.answer, command, vertices, triangles, threads=1 + k % 2, **options)
                for k in range(AT_ONCE)
            ]
        found["bits"] = all(bits(call.result()) == bits(result) for call in calls)
    return found


def survey(command, kind, count, kernels=None):
    """All surfaces of a kind, each process going on behind the surface that ended the one before.

    kernels    a set of dense kernels, with which each surface comes once; None: those that fit, in all ways
    """
    rows = []
    environment = {**os.environ, "KOEBE_KERNELS": kernels} if kernels else None
    while len(rows) < count:
        words = [sys.executable, __file__, "--kinds", kind, "--from", str(len(rows)), "--surfaces", str(count)]
        words += ["--commands", command] + ["--once"] * bool(kernels)
        with subprocess.Popen(words, stdout=subprocess.PIPE, text=True, env=environment) as process:
            watch = threading.Timer(LIMIT * (count - len(rows)), process.kill)
            watch.start()
            rows += [json.loads(line) for line in process.stdout]
            watch.cancel()
        if len(rows) < count:
            how = f"the process ended with {process.returncode}"
            row = {"outcome": "wrong", "broken": [how], "seed": len(rows), "options": {}, "faces": 0}
            rows.append(row)
    return rows


def surveys(command, kinds, count, pool):
    """All surfaces of some kinds, of each whether other kernels give other bits."""
    sets = (None, *KERNELS)
    jobs = [pool.submit(survey, command, kind, count, kernels) for kind in kinds for kernels in sets]
    found = {}
    for k, kind in enumerate(kinds):
        rows, *others = (job.result() for job in jobs[k * len(sets) : (k + 1) * len(sets)])
        for row, *same in zip(rows, *others):
            if "digest" in row:
                row["kernels"] = all(other.get("digest") == row["digest"] for other in same)
        found[kind] = rows
    return found


def by_command(rows):
    """Counts of some rows, as they stand in the table of commands."""
    whole = summary(rows)
    compared = [row["kernels"] for row in rows if "kernels" in row]
    return [*whole[:5], *whole[6:9], f"{compared.count(False)} of {len(compared)}"]


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
COMMANDS_HEAD = ["command", *HEAD[1:6], *HEAD[7:10], "other bits by other kernels"]


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
    parser.add_argument("--kinds", default="", help="of random_surfaces.py; none: all that a command takes")
    parser.add_argument("--commands", default=",".join(commands.COMMANDS))
    parser.add_argument("--once", action="store_true", help="with --from: in no other way again")
    parser.add_argument("--from", dest="first", type=int, help="print each surface from this one on, as JSON")
    parser.add_argument("--write", action="store_true", help="into docs/")
    return parser.parse_args()


def main():
    options = parse()
    kinds = [kind for kind in options.kinds.split(",") if kind]
    names = options.commands.split(",")
    if options.first is not None:
        for kind, seed in itertools.product(kinds, range(options.first, options.surfaces)):
            print(json.dumps(examine(names[0], kind, seed, not options.once)), flush=True)
        return 0
    OUT.mkdir(parents=True, exist_ok=True)
    found, table, by_name = {}, {}, {}
    with ThreadPoolExecutor(os.cpu_count() or 1) as pool:
        for name in names:
            own = [kind for kind in kinds or commands.COMMANDS[name].kinds if kind in commands.COMMANDS[name].kinds]
            found[name] = surveys(name, own, options.surfaces, pool)
            by_name[name] = by_command([row for rows in found[name].values() for row in rows])
            print("|", name, "|", " | ".join(by_name[name]), "|", flush=True)
    if "uniformize" in found:
        table = {kind: summary(rows) for kind, rows in found["uniformize"].items()}
        table["all"] = summary([row for rows in found["uniformize"].values() for row in rows])
        for kind, row in table.items():
            print("|", kind, "|", " | ".join(row), "|")
    every = [(name, kind, row) for name in found for kind in found[name] for row in found[name][kind]]
    bad = [(name, kind, row) for name, kind, row in every if not kept(row)]
    for name, kind, row in bad[:40]:
        changes = {way: change for way, change in row.get("change", {}).items() if change > SAME}
        changes |= {"kernels": "other bits"} if row.get("kernels") is False else {}
        print(f"{name} {kind} {row['seed']}, {row['faces']} faces, {row['options']}:", row.get("broken") or "", changes)
    (OUT / "surfaces.json").write_text(json.dumps(found) + "\n", encoding="utf-8")
    faces, delays = cancel_delays()
    cancel = [f"{faces:,}", str(len(delays)), f"{np.median(delays):.3f}", f"{max(delays):.3f}"] if delays else []
    print(f"cancel: {cancel}")
    if options.write:
        write(table, by_name, cancel)
    return int(any(row["outcome"] == "wrong" for _, _, row in every))


def kept(row):
    """Whether nothing is to be told of a surface."""
    same = all(change <= SAME for change in row.get("change", {}).values())
    return row["outcome"] != "wrong" and same and row.get("bits", True) and row.get("kernels", True)


def write(table, by_name, cancel):
    """The tables into docs/figures.json and the page."""
    import doc_figures

    figures = doc_figures.load()
    figures["reliability"] = {"command": "make reliability", "head": HEAD, "rows": table}
    figures["commands"] = {"command": "make reliability", "head": COMMANDS_HEAD, "rows": by_name}
    head = ["a surface of", "faces", "cancels", "median s", "longest s"]
    figures["cancel"] = {"command": "make reliability", "head": head, "rows": {"a plate, four holes": cancel}}
    doc_figures.save(figures)
    doc_figures.write()


if __name__ == "__main__":
    sys.exit(main())
