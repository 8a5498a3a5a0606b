# SPDX-License-Identifier: GPL-3.0-or-later
"""Theorems 1.1 and 1.2 of the paper, measured: the error of the circles step by step, CK and GK, on domains whose
circles are known, far apart and close to each other.

The theorems bound the error after k steps by C1 C2^[k/n] for CK and C1 C2^(2 [k/n]) for GK, n the number of holes. So
on a logarithmic scale GK should fall twice as steeply as CK. The slopes are fitted by least squares.
"""

import itertools
import json
import math
import subprocess
from pathlib import Path

from log_plot import log_plot

ROOT = Path(__file__).resolve().parent.parent
RATES = ROOT / "build" / "bench" / "koebe_rates"
DOMAINS = {"apart": "circles far apart", "middle": "closer", "close": "almost touching"}
RUNS = {
    ("mesh", "ck"): ("CK, mesh", "#c8553d", "5 3"),
    ("mesh", "gk"): ("GK, mesh", "#2a7f9e", "5 3"),
    ("condensed", "ck"): ("CK, condensed", "#c8553d", ""),
    ("condensed", "gk"): ("GK, condensed", "#2a7f9e", ""),
}
FACES = 8000
FLOOR = 1e-12  # round-off


def measure(domain, engine, method):
    """One run, with its fitted rate: the factor of the error in n steps."""
    command = [RATES, "steps", domain, str(FACES), engine, method]
    report = json.loads(subprocess.run(command, capture_output=True, text=True, check=True).stdout)
    used = above_floor(report)
    slope = fitted_slope([(k, math.log(error)) for k, error in used])
    report["fitted_steps"] = len(used)
    report["factor_per_n_steps"] = math.exp(report["holes"] * slope)
    report["slope"] = slope
    return report


def above_floor(report):
    """Steps and errors up to the first that is round-off."""
    errors = [(step["step"], step["error"]) for step in report["steps"]]
    return list(itertools.takewhile(lambda point: point[1] > FLOOR, errors))


def fitted_slope(points):
    """Of the least squares line."""
    mean_x = sum(x for x, _ in points) / len(points)
    mean_y = sum(y for _, y in points) / len(points)
    spread = sum((x - mean_x) ** 2 for x, _ in points)
    return sum((x - mean_x) * (y - mean_y) for x, y in points) / spread


def factor_per_sweep(report):
    return math.exp(report["steps_per_sweep"] * report["slope"])


def run():
    """All runs by domain, engine and method."""
    return {
        domain: {f"{engine} {method}": measure(domain, engine, method) for engine, method in RUNS}
        for domain in DOMAINS
    }


def plot(results):
    """The errors against the steps, a panel for each domain."""
    panels = []
    for domain, title in DOMAINS.items():
        lines = []
        for (engine, method), look in RUNS.items():
            lines.append((*look, above_floor(results[domain][f"{engine} {method}"])))
        panels.append((title, lines))
    return log_plot(panels, "steps", "relative error of the circles", lowest=FLOOR)


HEAD = [
    "circles, engine", "CK: factor in n steps", "GK: factor in n steps", "log GK / log CK", "CK: factor in a sweep",
    "GK: factor in a sweep", "error of the limit",
]  # fmt: skip


def cells(ck, gk):
    """A row of the table, from both runs of a domain and an engine."""
    return [
        f"{ck['factor_per_n_steps']:.1e}",
        f"{gk['factor_per_n_steps']:.1e}",
        f"{gk['slope'] / ck['slope']:.2f}",
        f"{factor_per_sweep(ck):.1e}",
        f"{factor_per_sweep(gk):.1e}",
        f"{gk['steps'][-1]['exact_error']:.1e}",
    ]


def markdown(results):
    """One row for each domain and engine."""
    lines = [
        f"Seven holes, about {FACES:,} faces on Enneper's surface; error: the largest relative one of an inversive "
        "distance, against the circles at the end.",
        "",
        "| " + " | ".join(HEAD) + " |",
        "|" + " --- |" * len(HEAD),
    ]
    for domain, title in DOMAINS.items():
        for engine in ("mesh", "condensed"):
            row = cells(*(results[domain][f"{engine} {method}"] for method in ("ck", "gk")))
            lines.append(f"| {title}, {engine} | " + " | ".join(row) + " |")
    return "\n".join(lines) + "\n"
