# SPDX-License-Identifier: GPL-3.0-or-later
"""The paper's methods on six scans cut to about the sizes of its figures, where they are there; they are not in the
repository. Beside the rows of Table 1: the other methods, and the variants of the Ricci flow. Roundness is that of the
circles of least squares, since that of section 5 is not 0 for uneven points of a perfect circle."""

import json
import statistics
import sys
import tempfile
from pathlib import Path

from processor_time import run_timed

ROOT = Path(__file__).resolve().parent.parent
KOEBE = ROOT / "build" / "koebe"
MESHES = ROOT.parent / "shared" / "meshes" / "good"
LIMIT = 300  # seconds per run
REPEATED = 4.0  # seconds: shorter runs are taken three times
OF_THE_FLOW = ("not_converged", "packing", "closing_gap", "flow_flips")  # warnings that a comparison tells
# Figure of the paper, file of that size, holes, faces.
SURFACES = (
    ("Fig. 1", "fig1_nefertiti_20k_15", 15, 41029),
    ("Fig. 2", "fig2_nefertiti_13k_3", 3, 26867),
    ("Fig. 8", "fig8_nefertiti_37k_3", 3, 73492),
    ("Fig. 10", "fig10_nefertiti_18k_5", 5, 35519),
    ("Fig. 11", "fig11_nefertiti_40k_5", 5, 80612),
    ("Fig. 12", "fig12_nefertiti_74k_9", 9, 146405),
)
HEAD = ["size of, method", "holes", "vertices", "faces", "converged", "steps", "mean roundness", "largest",
        "angle error", "flipped", "time / condensed"]  # fmt: skip
RUNS = {
    "condensed": ("uniformize", "--method", "gk"),
    "GK mesh": ("uniformize", "--method", "gk", "--engine", "mesh"),
    "first mesh": ("uniformize", "--method", "against-outer", "--engine", "mesh"),
    "RF": ("ricci",),
    "RF, given": ("ricci", "--triangulation", "given"),
    "RF, acute": ("ricci", "--triangulation", "given", "--packing", "acute", "--target", "proportional"),
}


def run_once(mesh, arguments):
    """The report of one run, or None if it was stopped."""
    with tempfile.TemporaryDirectory() as folder:
        report = Path(folder) / "run.json"
        command = [KOEBE, arguments[0], mesh, Path(folder) / "run.obj", *arguments[1:], "--json", report, "--quiet"]
        done, seconds = run_timed(command, LIMIT)
        if done is None:
            return None
        if done.returncode not in (0, 4):
            raise SystemExit(f"{mesh.stem} {' '.join(arguments)}: {done.stderr.strip()}")
        return json.loads(report.read_text()) | {"processor_seconds": seconds}


def measure(mesh, arguments, runs):
    """One row: the last report, with the median time."""
    reports = [run_once(mesh, arguments)]
    if reports[0] is None:
        return {"stopped": True}
    if reports[0]["processor_seconds"] < REPEATED:
        reports += [run_once(mesh, arguments) for _ in range(runs - 1)]
    report = reports[-1]
    roundness = [loop["roundness_least_squares"] for loop in report["loops"]]
    return {
        "stopped": False,
        "vertices": report["vertices"],
        "faces": report["faces"],
        "converged": report["converged"],
        "sweeps": report["sweeps"],
        "steps": report["steps"],
        "mean_roundness": statistics.mean(roundness),
        "max_roundness": max(roundness),
        "angle_error_deg": report["angle_error_deg"]["mean"],
        "flipped": report["flipped"],
        "seconds": statistics.median(found["processor_seconds"] for found in reports),
        "warnings": [w["text"] for w in report["warnings"] if w["kind"] in OF_THE_FLOW],
    }


def compare(surfaces, runs):
    """All rows, times as ratios to the condensed GK of the same surface."""
    rows = []
    for figure, name, holes, _ in surfaces:
        mesh = MESHES / f"{name}.obj"
        if not mesh.exists():
            continue
        unit = None
        for method, arguments in RUNS.items():
            print(f"{mesh.stem}: {method} ...", file=sys.stderr, flush=True)
            row = {"figure": figure, "surface": mesh.stem, "holes": holes, "method": method}
            row |= measure(mesh, arguments, runs)
            unit = unit or row["seconds"]
            row["ratio"] = None if row["stopped"] else row["seconds"] / unit
            rows.append(row)
    return rows


def result_cells(row):
    """What of a row does not depend on the machine's speed."""
    return [
        "yes" if row["converged"] else "no",
        str(row["steps"]),
        f"{row['mean_roundness']:.1e}",
        f"{row['max_roundness']:.1e}",
        f"{row['angle_error_deg']:.2f}°",
        str(row["flipped"]),
    ]


def table(rows):
    """Cells of all runs, by surface and method, for HEAD."""
    cells = {}
    for row in rows:
        name = f"{row['figure']}, {row['method']}"
        if row["stopped"]:
            cells[name] = [str(row["holes"]), "", "", f"stopped after {LIMIT} s", "", "", "", "", "", ""]
        else:
            sizes = [str(row["holes"]), f"{row['vertices']:,}", f"{row['faces']:,}"]
            cells[name] = [*sizes, *result_cells(row), f"{row['ratio']:.1f}"]
    return cells
