# SPDX-License-Identifier: GPL-3.0-or-later
"""The paper's Table 1, row for row: Ricci flow (RF) against the generalized Koebe iteration (GK), printed and ours, on
surfaces of exactly the printed sizes (bench/table_surfaces.py). GK on triangles also with the choices of the print, for
as many steps as it prints: they do not converge."""

import json
import tempfile
from functools import cache
from pathlib import Path

import table_surfaces
from printed import TABLE_1
from processor_time import minutes, run_timed

KOEBE = Path(__file__).resolve().parent.parent / "build" / "koebe"
LIMIT = 1800  # seconds per run
RUNS = {
    "RF": ("ricci",),
    "GK on triangles": ("uniformize", "--engine", "mesh"),
    "GK reflected": ("uniformize", "--engine", "mesh", "--metric", "reflected", "--partners", "changing"),
    "GK on boundary angles": ("uniformize",),
}
HEAD = [
    "size of", "holes", "vertices", "faces", "boundary vertices", "RF, printed", "RF, ours", "GK, printed",
    "GK on triangles, ours", "reflected, changing partners, ours", "all at once on boundary angles, ours",
]  # fmt: skip
ROWS = {row.figure: row for row in TABLE_1}


@cache
def measure(figure, method):
    """The report of one run on the surface of that figure's size, with "processor_seconds"; None if it was stopped."""
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder)
        command = [KOEBE, RUNS[method][0], table_surfaces.file_of(ROWS[figure]), out / "mapped.obj", *RUNS[method][1:]]
        if method == "GK reflected":
            command += ["--max-sweeps", str(printed_sweeps(ROWS[figure]))]
        done, seconds = run_timed([*command, "--json", out / "report.json", "--quiet"], LIMIT)
        if done is None:
            return None
        if done.returncode not in (0, 4):
            raise SystemExit(f"{figure}, {method}: {done.stderr.strip()}")
        return json.loads((out / "report.json").read_text(encoding="utf-8")) | {"processor_seconds": seconds}


def printed_sweeps(row):
    """The printed steps are whole sweeps: half as many as there are loops, which are even in number, in each."""
    return 2 * row.gk_steps // (row.holes + 1)


def printed_run(steps, time, roundness):
    """What the paper says of a run: steps, minutes and R."""
    if time is None:
        return "did not converge"
    return ", ".join([f"{steps} steps"] * (steps is not None) + [f"{time}:00", f"R {roundness:.4f}"])


def our_run(found, with_steps):
    """The same of ours; e is the mean over all loops, as R is."""
    if found is None:
        return f"stopped after {LIMIT} s"
    words = [f"{found['steps']} steps"] * with_steps
    words += [minutes(found["processor_seconds"]), f"e {in_digits(found['mean_roundness']['all'])}"]
    words += ["not converged"] * (not found["converged"])
    words += [f"{found['flipped']} flipped"] * (found["flipped"] > 0)
    return ", ".join(words)


def in_digits(value):
    return f"{value:.4f}" if value >= 1e-3 else f"{value:.1e}"


def cells(figure):
    """A row."""
    row = ROWS[figure]
    found = {method: measure(figure, method) for method in RUNS}
    size = [row.holes, row.vertices, row.faces, row.boundary]
    made = next(report for report in found.values() if report)
    if (made["vertices"], made["faces"]) != (row.vertices, row.faces):
        raise SystemExit(f"{figure}: the surface has another size than the table")
    return [
        *(f"{number:,}" for number in size),
        printed_run(None, row.rf_minutes, row.rf_roundness),
        our_run(found["RF"], with_steps=False),
        printed_run(row.gk_steps, row.gk_minutes, row.gk_roundness),
        our_run(found["GK on triangles"], with_steps=True),
        our_run(found["GK reflected"], with_steps=True),
        our_run(found["GK on boundary angles"], with_steps=True),
    ]
