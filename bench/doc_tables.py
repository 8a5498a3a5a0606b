# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tables of README.md and docs/ say, each row from one or a few runs of a command.

A table has a head, the rows' names and a function from a name to its cells, all as they are printed. `own` rows need
nothing but this repository; the others scans that are not in it, in ../shared/meshes/good.
"""

import json
import math
import random
import subprocess
import sys
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import atrium_templates
import convergence
import domain_figures
import exact_surfaces
import polyhedron_error
import predicted_rates
import print_choices
import promises
import round_trips
import shape_distances
import stretched_cylinders
import stretched_rectangles
import table_one
import table_surfaces
import table_two
import two_heads

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
    return sum(len(warning["elements"]) for warning in found["warnings"] if warning["kind"] == "shrunk_circles")


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


PARTS = {
    "conformal, `--even 0`": ["--even", "0"],
    "`--darts 0`": ["--darts", "0"],
    "default": [],
    "`--price 0.0037 --darts 0.2`": ["--price", "0.0037", "--darts", "0.2"],
}


def parts(name: str) -> list[str]:
    """Parts, length of all cuts, texel density at 95 % over 5 % of the area and mean angle error, by settings."""
    said = []
    for options in PARTS.values():
        with tempfile.TemporaryDirectory() as folder:
            out = Path(folder)
            run(KOEBE, "parts", mesh_file(name), out / "out.obj", "--json", out / "out.json", "--quiet", *options)
            found = json.loads((out / "out.json").read_text(encoding="utf-8"))
        figures = found["cut_length"], found["density_ratio_5_95"], found["angle_error_deg"]["mean"]
        said.append("{}; {:.1f}; {:.2f}; {:.1f}°".format(len(found["parts"]), *figures))
    return said


def module_distance(row: str) -> list[str]:
    said = run(KOEBE, "compare", *mesh_files(row))
    return [f"{float(said.split()[1]):.1e}"]


@cache
def made_faces() -> dict[str, Path]:
    return {path.stem: path for path in shape_distances.made_faces()}


def face_distances(name: str) -> list[str]:
    """A row of the table of bench/shape_distances.py."""
    options = shape_distances.parse(list(map(str, made_faces().values())))
    faces = made_faces()
    return ["0" if other == name else shape_distances.distance(options, faces[name], faces[other]) for other in faces]


def same_shape(way: str) -> list[str]:
    """The distance of the face from itself, changed in a way that a module must not see; or from its mirror image."""
    mesh = mesh_file("face").read_text(encoding="ascii").splitlines()
    points = [tuple(map(float, line.split()[1:])) for line in mesh if line.startswith("v ")]
    faces = [tuple(int(word) - 1 for word in line.split()[1:]) for line in mesh if line.startswith("f ")]
    points, faces = CHANGES[way](points, faces)
    with tempfile.TemporaryDirectory() as folder:
        other = Path(folder) / "other.obj"
        lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in points]
        lines += ["f " + " ".join(str(v + 1) for v in face) for face in faces]
        other.write_text("\n".join(lines) + "\n", encoding="ascii")
        found = float(run(KOEBE, "compare", mesh_file("face"), other).split()[1])
    return ["below 1e-9" if found < 1e-9 else f"{found:.1e}"]


def renumbered(points, faces):
    number = random.Random(1).sample(range(len(points)), len(points))
    moved = [point for _, point in sorted(zip(number, points))]
    return moved, [tuple(number[v] for v in face) for face in reversed(faces)]


def turned(points, faces):
    c, s = math.cos(1.0), math.sin(1.0)
    return [(c * x - s * y + 3.0, s * x + c * y, z - 1.0) for x, y, z in points], faces


def cut_in_four(points, faces):
    points, middles, finer = list(points), {}, []
    for face in faces:
        halves = []
        for a, b in zip(face, face[1:] + face[:1]):
            key = frozenset((a, b))
            if key not in middles:
                middles[key] = len(points)
                points.append(tuple((x + y) / 2 for x, y in zip(points[a], points[b])))
            halves.append(middles[key])
        (a, b, c), (x, y, z) = face, halves
        finer += [(a, x, z), (x, b, y), (z, y, c), (x, y, z)]
    return points, finer


CHANGES = {
    "turned and moved": turned,
    "1e-8 times as large": lambda points, faces: ([tuple(1e-8 * x for x in p) for p in points], faces),
    "1e8 times as large": lambda points, faces: ([tuple(1e8 * x for x in p) for p in points], faces),
    "vertices and faces renumbered": renumbered,
    "each face cut in four": cut_in_four,
}


def python_package():
    sys.path.insert(0, str(ROOT / "build" / "python"))
    import koebe

    return koebe


def of_package(head: list[str], rows: list[str], cells: Callable[..., list[str]]) -> Table:
    """A table of what the Python package makes of surfaces that are made here."""
    return Table(head, rows, lambda row: cells(python_package(), row), lambda row: [table_surfaces.MESHER])


def annulus(name: str) -> list[str]:
    """The annulus map by a harmonic function and by the Yamabe flow: the radius of its hole and the angle error."""
    import numpy as np

    koebe = python_package()
    lines = [line.split() for line in mesh_file(name).read_text(encoding="utf-8").splitlines()]
    vertices = np.array([line[1:4] for line in lines if line[:1] == ["v"]], float)
    triangles = np.array([[word.split("/")[0] for word in line[1:]] for line in lines if line[:1] == ["f"]], int) - 1
    radii, errors = [], []
    for backend in ("harmonic", "yamabe"):
        uv, radius = koebe.annulus_map(vertices, triangles, backend=backend)
        radii.append(f"{radius:.3g}")
        errors.append(f"{koebe.distortion(vertices, triangles, uv)['angle_error_deg']['mean']:.2f}")
    return radii + errors


LIMITS = {
    "a limb 5 radii deep, a hole at its end": lambda: exact_surfaces.limb(5, 24),
    "a limb 10 radii deep": lambda: exact_surfaces.limb(10, 24),
    "a limb 15 radii deep": lambda: exact_surfaces.limb(15, 24),
    "a limb 30 radii deep": lambda: exact_surfaces.limb(30, 24),
    "a limb 60 radii deep": lambda: exact_surfaces.limb(60, 24),
    "a hole of radius 1e-3 in a flat disk": lambda: exact_surfaces.ring(1e-3, 24),
    "a hole of radius 1e-6": lambda: exact_surfaces.ring(1e-6, 24),
    "a hole of radius 1e-9": lambda: exact_surfaces.ring(1e-9, 24),
    "a hole of radius 1e-12": lambda: exact_surfaces.ring(1e-12, 24),
    "loops 0.1 apart, one face between": lambda: exact_surfaces.ring(0.9, 54, 1),
    "loops 0.1 apart, two faces between": lambda: exact_surfaces.ring(0.9, 108, 2),
    "loops 0.01 apart, one face between": lambda: exact_surfaces.ring(0.99, 544, 1),
    "loops 0.01 apart, two faces between": lambda: exact_surfaces.ring(0.99, 1088, 2),
    "loops 0.01 apart, faces as long as ten such gaps": lambda: exact_surfaces.ring(0.99, 63, 1),
}


def limits(row: str) -> list[str]:
    """A surface whose circle is known: what is found, and what is said."""
    koebe = python_package()
    vertices, triangles, exact = LIMITS[row]()
    result = koebe.uniformize(vertices, triangles)
    if promises.broken(triangles, result):
        sys.exit(f"{row}: {promises.broken(triangles, result)}")
    lost = any(warning.kind == "lost_circles" for warning in result.warnings)
    radius = result.radii[1]
    # What a short gap leaves is told from 1, what a small hole leaves from 0.
    error = abs((1.0 - radius) / (1.0 - exact) - 1.0) if exact > 0.5 else abs(radius / exact - 1.0)
    return [
        count(len(triangles)),
        f"{exact:.3g}",
        "lost, and said so" if lost else f"{error:.0e}",
        count(result.below_resolution),
    ]


def rates(row: str) -> list[str]:
    title, engine = row.rsplit(", ", 1)
    domain = next(key for key, value in convergence.DOMAINS.items() if value == title)
    return convergence.cells(*(convergence.measure(domain, engine, method) for method in convergence.METHODS))


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
        [f"{lift}, {engine}" for engine in ("condensed", "mesh") for lift in ("polynomial", "sphere", "Enneper")],
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
    "parts": Table(
        ["mesh", *PARTS],
        ["bear_14k_10", "cat_8k_2", "choi_alex3", "choi_lion5", "makehuman_body_13k_8", "os_plane_holes"],
        parts,
        mesh_files,
    ),
    "annulus": Table(
        ["mesh", "radius, harmonic", "radius, Yamabe", "degrees, harmonic", "degrees, Yamabe"],
        ["choi_sophie1", "choi_amoeba1", "pmp_suzanne2", "cat_8k_2"],
        annulus,
        mesh_files,
    ),
    "rates": Table(
        convergence.HEAD,
        [f"{title}, {engine}" for title in convergence.DOMAINS.values() for engine in ("mesh", "condensed")],
        rates,
        lambda row: [convergence.RATES],
    ),
    "predicted": Table(
        predicted_rates.HEAD,
        list(predicted_rates.DOMAINS),
        lambda row: predicted_rates.cells(python_package(), row),
        lambda row: [table_surfaces.MESHER],
    ),
    "table_1": Table(table_one.HEAD, list(table_one.ROWS), table_one.cells, lambda row: [KOEBE, table_surfaces.MESHER]),
    "table_2": Table(
        table_two.HEAD,
        table_two.NAMES,
        table_two.cells,
        lambda row: [convergence.RATES, table_surfaces.MESHER],
    ),
    "twin": of_package(domain_figures.TWIN_HEAD, list(domain_figures.TWINS), domain_figures.twin_cells),
    "polyhedron": of_package(polyhedron_error.HEAD, polyhedron_error.ROWS, polyhedron_error.cells),
    "choices": of_package(print_choices.HEAD, list(print_choices.CHOICES), print_choices.cells),
    "heads": of_package(two_heads.HEAD, list(two_heads.HEADS), two_heads.cells),
    "limits": Table(
        ["surface", "faces", "exact radius", "relative error", "faces below resolution"],
        list(LIMITS),
        limits,
        lambda row: [],
    ),
    "same_shape": Table(
        ["the face", "distance from itself"],
        list(CHANGES),
        same_shape,
        lambda row: [SAMPLES / "face.obj"],
    ),
    "faces": Table(
        ["", "face", "face_finer", "surprised", "face_cut"],
        ["face", "face_finer", "surprised", "face_cut"],
        face_distances,
        lambda row: [SAMPLES / "make_obj.py"],
    ),
    "templates": Table(atrium_templates.HEAD, list(atrium_templates.TEMPLATES), atrium_templates.cells, lambda row: []),
    "round_trips": Table(round_trips.HEAD, round_trips.ROWS, round_trips.cells, lambda row: []),
    "teichmueller": Table(
        stretched_cylinders.HEAD, list(stretched_cylinders.ROWS), stretched_cylinders.cells, lambda row: []
    ),
    "quadrilaterals": Table(
        stretched_rectangles.HEAD, list(stretched_rectangles.ROWS), stretched_rectangles.cells, lambda row: []
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
