# SPDX-License-Identifier: GPL-3.0-or-later
"""Theorems 1.1 and 1.2 of the paper, measured: the error of the circles step by step, with CK (section 1.2), the first
algorithm of section 4.4 and GK, on domains whose circles are known, far apart and close to each other.

The theorems bound the error after k steps by C1 C2^[k/n] for CK and C1 C2^(2 [k/n]) for GK, n the number of boundaries.
So on a logarithmic scale GK should fall twice as steeply as CK. The slopes are fitted by least squares.
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
METHODS = {"ck": ("CK", "#c8553d"), "against-outer": ("first", "#7a4f9c"), "gk": ("GK", "#2a7f9e")}
ENGINES = {"mesh": ("triangles", "5 3"), "condensed": ("angles", "")}
FACES = 8000
FLOOR = 1e-12  # round-off


def measure(domain, engine, method):
    """One run, with its fitted rate: the factor of the error in n steps."""
    command = [RATES, "steps", domain, str(FACES), engine, method]
    report = json.loads(subprocess.run(command, capture_output=True, text=True, check=True).stdout)
    used = above_floor(report)
    slope = fitted_slope([(k, math.log(error)) for k, error in used])
    report["fitted_steps"] = len(used)
    report["factor_per_n_steps"] = math.exp(report["boundaries"] * slope)
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


def run():
    """All runs by domain, engine and method."""
    return {
        domain: {engine: {method: measure(domain, engine, method) for method in METHODS} for engine in ENGINES}
        for domain in DOMAINS
    }


def plot(results):
    """The errors against the steps, a panel for each domain."""
    panels = []
    for domain, title in DOMAINS.items():
        lines = []
        for engine, (place, dashes) in ENGINES.items():
            for method, (name, color) in METHODS.items():
                points = above_floor(results[domain][engine][method])
                lines.append((f"{name}, {place}", color, dashes, points))
        panels.append((title, lines))
    return log_plot(panels, "steps", "relative error of the circles", lowest=FLOOR)


HEAD = [
    "circles, engine", "CK: factor in n steps", "first algorithm: factor in n steps", "GK: factor in n steps",
    "log GK / log CK", "log GK / log first", "error of the limit",
]  # fmt: skip


def cells(ck, first, gk):
    """A row of the table, from the three runs of a domain and an engine."""
    return [
        *(f"{found['factor_per_n_steps']:.1e}" for found in (ck, first, gk)),
        f"{gk['slope'] / ck['slope']:.2f}",
        f"{gk['slope'] / first['slope']:.2f}",
        f"{gk['steps'][-1]['exact_error']:.1e}",
    ]
