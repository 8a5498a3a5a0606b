# SPDX-License-Identifier: GPL-3.0-or-later
"""The paper's comparison again: Ricci flow (RF), conventional (CK) and generalized Koebe iteration (GK) on six
surfaces of the sizes in its Tables 1 and 2, and the rates of its Theorems 1.1 and 1.2.

    bench/reproduce.py [--quick]

Leaves out/reproduce/*.md, *.json and *.svg and prints the tables. Where the scans of those sizes are not there,
surfaces with as many holes and faces are made. A run that reaches the time limit is stopped, and its row says so.
--quick: the two smallest surfaces, one run each.
"""

import argparse
import json
import statistics
import subprocess
import sys
from pathlib import Path

sys.dont_write_bytecode = True

import convergence  # noqa: E402
import figures  # noqa: E402

ROOT = Path(__file__).resolve().parent.parent
KOEBE = ROOT / "build" / "koebe"
OUT = ROOT / "out" / "reproduce"
MESHES = ROOT.parent / "shared" / "meshes" / "good"
LIMIT = 120  # seconds per run
REPEATED = 4.0  # seconds: shorter runs are taken three times
OF_THE_FLOW = ("not_converged", "packing", "closing_gap", "flow_flips")  # warnings that a comparison tells
SAME = 1.02  # times the final roundness counts as having reached it
# Figure of the paper, file of that size, holes, faces.
SURFACES = (
    ("Fig. 1", "fig1_nefertiti_20k_15", 15, 41029),
    ("Fig. 2", "fig2_nefertiti_13k_3", 3, 26867),
    ("Fig. 8", "fig8_nefertiti_37k_3", 3, 73492),
    ("Fig. 10", "fig10_nefertiti_18k_5", 5, 35519),
    ("Fig. 11", "fig11_nefertiti_40k_5", 5, 80612),
    ("Fig. 12", "fig12_nefertiti_74k_9", 9, 146405),
)
RUNS = {
    "GK condensed": ("uniformize", "--method", "gk"),
    "CK condensed": ("uniformize", "--method", "ck"),
    "GK mesh": ("uniformize", "--method", "gk", "--engine", "mesh"),
    "CK mesh": ("uniformize", "--method", "ck", "--engine", "mesh"),
    "RF": ("ricci",),
    "RF, given": ("ricci", "--triangulation", "given"),
    "RF, acute": ("ricci", "--triangulation", "given", "--packing", "acute", "--target", "proportional"),
}


def surface_file(name, holes, faces):
    """The scan of that name, or a surface of its size made here."""
    scan = MESHES / f"{name}.obj"
    if scan.exists():
        return scan
    made = OUT / f"made_{holes}_holes_{faces}.obj"
    if not made.exists():
        subprocess.run([convergence.RATES, "surface", str(holes), str(faces), made], check=True)
    return made


def run_once(mesh, arguments):
    """The report of one run, or None if it was stopped."""
    report = OUT / "run.json"
    report.unlink(missing_ok=True)
    command = [KOEBE, arguments[0], mesh, OUT / "run.obj", *arguments[1:], "--json", report, "--quiet"]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=LIMIT)
    except subprocess.TimeoutExpired:
        return None
    if done.returncode not in (0, 4):
        raise SystemExit(f"{mesh.stem} {' '.join(arguments)}: {done.stderr.strip()}")
    return json.loads(report.read_text())


def map_seconds(report):
    return report["seconds"]["total"] - report["seconds"]["read"] - report["seconds"]["write"]


def measure(mesh, arguments, runs):
    """One row: the last report, with the median time."""
    reports = [run_once(mesh, arguments)]
    if reports[0] is None:
        return {"stopped": True}
    if map_seconds(reports[0]) < REPEATED:
        reports += [run_once(mesh, arguments) for _ in range(runs - 1)]
    report = reports[-1]
    roundness = [loop["roundness"] for loop in report["loops"]]
    return {
        "stopped": False,
        "vertices": report["vertices"],
        "faces": report["faces"],
        "converged": report["converged"],
        "sweeps": report["sweeps"],
        "steps": report["steps"],
        "steps_to_roundness": steps_to_roundness(report["history"]),
        "mean_roundness": statistics.mean(roundness),
        "max_roundness": max(roundness),
        "angle_error_deg": report["angle_error_deg"]["mean"],
        "flipped": report["flipped"],
        "seconds": statistics.median(map(map_seconds, reports)),
        "warnings": [w["text"] for w in report["warnings"] if w["kind"] in OF_THE_FLOW],
    }


def steps_to_roundness(history):
    """Steps after which the mean roundness stays within 2 % of the last one."""
    last = history[-1]["mean_roundness"]
    above = [step["step"] for step in history if step["mean_roundness"] > SAME * last]
    return max(above, default=0) + 1


def compare(surfaces, runs):
    """All rows, times as ratios to the condensed GK of the same surface."""
    rows = []
    for figure, name, holes, faces in surfaces:
        mesh = surface_file(name, holes, faces)
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


def markdown(rows):
    """The table of all runs, and that of the steps."""
    lines = [
        "| size of | holes | vertices | faces | method | converged | steps | mean e(γ) | largest | angle error | "
        "flipped "
        "| time / GK condensed |",
        "|" + " --- |" * 12,
    ]
    size = {row["figure"]: f"{row['vertices']:,} | {row['faces']:,}" for row in rows if not row["stopped"]}
    for row in rows:
        start = f"| {row['figure']} | {row['holes']} | {size[row['figure']]} | {row['method']} "
        if row["stopped"]:
            lines.append(start + f"| stopped after {LIMIT} s |" + " |" * 6)
            continue
        lines.append(start + "| " + " | ".join([*result_cells(row), f"{row['ratio']:.1f}"]) + " |")
    lines += [
        "",
        "Steps until the mean roundness stays within 2 % of its last value:",
        "",
        "| size of | CK mesh | GK mesh | CK condensed | GK condensed |",
        "|" + " --- |" * 5,
    ]
    for figure in dict.fromkeys(row["figure"] for row in rows):
        found = {row["method"]: row.get("steps_to_roundness", "–") for row in rows if row["figure"] == figure}
        cells = [found[name] for name in ("CK mesh", "GK mesh", "CK condensed", "GK condensed")]
        lines.append(f"| {figure} | " + " | ".join(map(str, cells)) + " |")
    return "\n".join(lines) + "\n"


def write(name, text):
    (OUT / name).write_text(text, encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true")
    quick = parser.parse_args().quick
    OUT.mkdir(parents=True, exist_ok=True)

    rates = convergence.run()
    write("rates.json", json.dumps(rates, indent=1) + "\n")
    write("rates.md", convergence.markdown(rates))
    write("rates.svg", convergence.plot(rates))
    print(convergence.markdown(rates))

    rows = compare([s for s in SURFACES if not quick or s[3] < 36000], 1 if quick else 3)
    write("methods.json", json.dumps(rows, indent=1) + "\n")
    write("methods.md", markdown(rows))
    print(markdown(rows))

    figures.draw(OUT)


if __name__ == "__main__":
    main()
