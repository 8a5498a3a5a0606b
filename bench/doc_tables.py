# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tables of README.md and docs/ say, each row from one or a few runs of a command.

A table has a head, the rows' names and a function from a name to its cells, all as they are printed. `own` rows need
nothing but this repository; the others scans that are not in it, in ../shared/meshes/good.
"""

import json
import re
import subprocess
import sys
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
KOEBE = ROOT / "build" / "koebe"
BENCH = ROOT / "build" / "bench" / "koebe_bench"
SAMPLES = ROOT / "blend_samples"
SCANS = ROOT.parent / "shared" / "meshes" / "good"
LIMIT = 900  # seconds for a command


@dataclass
class Table:
    """`rows` are names that `cells` understands; `measured` is the command for the page's reader."""

    head: list[str]
    rows: list[str]
    cells: Callable[[str], list[str]]
    needs: Callable[[str], list[Path]]
    worth: Callable[[list[str]], bool] = lambda cells: True

    def available(self) -> list[str]:
        return [row for row in self.rows if all(path.exists() for path in self.needs(row))]


def mesh_file(name: str) -> Path:
    """A sample of this repository, or a scan beside it."""
    own = SAMPLES / f"{name}.obj"
    return own if own.exists() else SCANS / f"{name}.obj"


def mesh_files(row: str) -> list[Path]:
    return [mesh_file(name) for name in row.split(", ")]


def run(*words: object) -> str:
    """Standard output of a command; exit 4 (not converged) is an answer too."""
    done = subprocess.run(list(map(str, words)), capture_output=True, text=True, timeout=LIMIT)
    if done.returncode not in (0, 4):
        sys.exit(f"{' '.join(map(str, words))}: {done.stderr.strip()}")
    return done.stdout


@cache
def report(name: str, *options: str) -> dict:
    """The report of `koebe uniformize`."""
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder)
        run(KOEBE, "uniformize", mesh_file(name), out / "out.obj", "--json", out / "out.json", "--quiet", *options)
        return json.loads((out / "out.json").read_text(encoding="utf-8"))


def count(number: int) -> str:
    return f"{number:,}"


def worst_roundness(found: dict) -> float:
    """As the command prints it: of the worst loop, before its vertices were put on its circle."""
    return max(loop["roundness"] for loop in found["loops"])


def made_smaller(found: dict) -> int:
    """Circles that had to be made smaller, as the warning counts them."""
    told = [re.search(r"made smaller[^:]*: (\d+)", warning) for warning in found["warnings"]]
    return sum(int(match[1]) for match in told if match)


# ---------------------------------------------------------------- the tables


def quality(name: str) -> list[str]:
    plain, polished = report(name), report(name, "--polish")
    return [
        count(plain["faces"]),
        str(len(plain["loops"])),
        f"{plain['angle_error_deg']['mean']:.2f}",
        f"{polished['angle_error_deg']['mean']:.2f}",
        f"{worst_roundness(plain):.1e}",
        str(plain["sweeps"]),
        str(plain["flipped"]),
    ]


def domain_error(row: str) -> list[str]:
    lift, engine = row.split(", ")
    errors = []
    for faces in (1000, 4000, 16000, 36000):
        found = json.loads(run(BENCH, f"{lift}:{faces}", 1, engine, "gk"))[-1]
        errors.append(f"{found['circle_error']:.1e}")
    return errors


def repairs(name: str) -> list[str]:
    found = report(name)
    return [
        count(len(found["loops"])),
        str(found["sweeps"]),
        count(found["flipped"] - found["below_resolution"]),
        count(found["below_resolution"]),
        count(sum(len(loop["off_circle"]) for loop in found["loops"])),
        str(made_smaller(found)),
        f"{found['angle_error_deg']['mean']:.2f}",
    ]


def needed_repair(cells: list[str]) -> bool:
    return any(cell != "0" for cell in cells[2:6])


def polish(name: str) -> list[str]:
    plain, polished = (found["angle_error_deg"] for found in (report(name), report(name, "--polish")))
    return [f"{plain['mean']:.2f}", f"{polished['mean']:.2f}", f"{plain['max']:.0f}", f"{polished['max']:.0f}"]


def balance(name: str) -> list[str]:
    plain, balanced = (found["area_distortion"] for found in (report(name), report(name, "--balance", "area")))
    return [f"{plain['log_sd']:.2f}", f"{balanced['log_sd']:.2f}"]


def module_distance(row: str) -> list[str]:
    said = run(KOEBE, "compare", *mesh_files(row))
    return [f"{float(said.split()[1]):.1e}"]


def scans() -> list[str]:
    return sorted(path.stem for path in SCANS.glob("*.obj"))


THREE_SCANS = ["choi_alex3", "choi_lion5", "choi_sophie1"]
OWN = ["face", "surprised"]
TABLES = {
    "quality": Table(
        ["mesh", "faces", "loops", "angle error", "polished", "roundness", "sweeps", "flipped"],
        OWN + THREE_SCANS,
        quality,
        mesh_files,
    ),
    "exact": Table(
        ["lift, engine", "978 faces", "4,042", "16,340", "36,675"],
        [f"{lift}, {engine}" for engine in ("condensed", "mesh") for lift in ("polynomial", "sphere", "enneper")],
        domain_error,
        lambda row: [BENCH],
    ),
    "repairs": Table(
        ["mesh", "loops", "sweeps", "flipped", "below resolution", "off circle", "circles made smaller", "degrees"],
        scans(),
        repairs,
        mesh_files,
        needed_repair,
    ),
    "polish": Table(
        ["mesh", "mean", "mean, polished", "largest", "largest, polished"],
        OWN + THREE_SCANS + ["fig1_nefertiti_20k_15", "mountain_40lakes", "nefertiti_40tight"],
        polish,
        mesh_files,
    ),
    "balance": Table(
        ["mesh", "none", "area"],
        OWN + ["choi_sophie1", "fig12_nefertiti_74k_9"],
        balance,
        mesh_files,
    ),
    "distances": Table(
        ["meshes", "distance"],
        [
            "face, surprised",
            "panel_featuretype, panel_featuretype_rolled",
            "ict_head_neutral, ict_head_neutral_sub45k",
            "fig2_nefertiti_13k_3, fig8_nefertiti_37k_3",
            "fig10_nefertiti_18k_5, fig11_nefertiti_40k_5",
        ],
        module_distance,
        mesh_files,
    ),
}
