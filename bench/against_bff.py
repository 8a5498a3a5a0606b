# SPDX-License-Identifier: GPL-3.0-or-later
"""The whole command, file to file, beside that of boundary-first flattening (Sawhney and Crane 2017).

    python bench/against_bff.py [--runs N] [--write] [MESH ...]

Its source, with its submodule deps/rectangle-bin-pack, is looked for in BFF_SOURCE, then in ../peers/: it is built in
out/bench/bff. Where it is not, what was measured last is printed. The meshes are those of ../shared/meshes/good, or the
files named. The two commands run in turn; --write keeps the table in docs/figures.json and writes it into the page.

The peer maps a disk to the plane with free boundary; it fills further loops with fans first, which is what it does on
its own. Both are measured on what they write: the mean over all corners of the difference of angles, in degrees.
"""

import argparse
import datetime
import os
import statistics
import subprocess
import sys
import tempfile
import threading
from pathlib import Path

import doc_figures  # noqa: E402
import numpy as np  # noqa: E402
import uv_measures  # noqa: E402

ROOT = Path(__file__).resolve().parent.parent
KOEBE = ROOT / "build" / "koebe"
OUT = ROOT / "out" / "bench"
MESHES = ROOT.parent / "shared" / "meshes" / "good"
SOURCE = Path(os.environ.get("BFF_SOURCE") or ROOT.parent / "peers" / "boundary-first-flattening")
RUNS = 5
LIMIT = 300  # seconds of a run
HEAD = ["mesh", "faces", "command / peer's", "angle error", "peer's"]


def built() -> Path | None:
    """The peer's command, if its source is here."""
    needed = (SOURCE / "apps" / "command-line", SOURCE / "deps" / "rectangle-bin-pack" / "Rect.h")
    if not all(path.exists() for path in needed):
        return None
    folder = OUT / "bff"
    folder.mkdir(parents=True, exist_ok=True)
    options = ["-DBFF_BUILD_GUI=OFF", "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_POLICY_VERSION_MINIMUM=3.5"]
    with (folder / "log.txt").open("w", encoding="utf-8") as log:
        for words in (["cmake", "-S", SOURCE, "-B", folder, *options], ["cmake", "--build", folder, "--parallel"]):
            if subprocess.run(words, stdout=log, stderr=log, check=False).returncode:
                sys.exit(f"boundary-first flattening was not built: {log.name}")
    return folder / "bff-command-line"


def arrays(path: Path):
    """Points (V, 3), places in the UVs (T, 2), and the numbers of both (F, 3, 2) of an OBJ's faces, cut into fans."""
    points, places, corners = [], [], []
    for line in path.read_text(encoding="utf-8").splitlines():
        words = line.split()
        if words[:1] == ["v"]:
            points.append(words[1:4])
        elif words[:1] == ["vt"]:
            places.append(words[1:3])
        elif words[:1] == ["f"]:
            split = [word.split("/") for word in words[1:]]
            face = [(word[0], (word[1:2] or [""])[0] or word[0]) for word in split]  # without a place, the vertex's
            for second, third in zip(face[1:], face[2:]):
                corners += [face[0], second, third]
    return np.array(points, float), np.array(places, float), np.array(corners, int).reshape(-1, 3, 2) - 1


def angle_error(points, mapped: Path) -> float:
    """The mean over the corners, in degrees. @param points of the input: the peer rounds them to six decimals"""
    _, places, corners = arrays(mapped)
    surface, image = points[corners[..., 0]], places[corners[..., 1]]
    area = uv_measures.triangle_areas(surface)
    real = area > 1e-12 * area.max()
    return float(np.abs(uv_measures.corner_angles(image[real]) - uv_measures.corner_angles(surface[real])).mean())


def cost(*words: object) -> tuple[float, float]:
    """Processor seconds of one run, of all threads, which other work changes less than the time that passed; and the
    most memory, in MB."""
    one_thread = {"OPENBLAS_NUM_THREADS": "1"}  # of the peer: a thread that waits would count
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL, "env": os.environ | one_thread}
    process = subprocess.Popen(list(map(str, words)), **quiet)
    watch = threading.Timer(LIMIT, process.kill)
    watch.start()
    _, status, usage = os.wait4(process.pid, 0)
    watch.cancel()
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode not in (0, 4):
        sys.exit(f"{' '.join(map(str, words))}: ended with {process.returncode}")
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1000


def compare(peer: Path, mesh: Path, runs: int) -> tuple[int, float, float, float]:
    """Triangles, median of the ratios, both angle errors."""
    with tempfile.TemporaryDirectory() as folder:
        ours, theirs = Path(folder) / "ours.obj", Path(folder) / "theirs.obj"
        pairs = [
            (cost(KOEBE, "uniformize", mesh, ours, "--quiet")[0], cost(peer, mesh, theirs)[0]) for _ in range(runs + 1)
        ][1:]
        points, _, corners = arrays(mesh)
        errors = (angle_error(points, mapped) for mapped in (ours, theirs))
        return len(corners), statistics.median(a / b for a, b in pairs), *errors


def cells(faces: int | None, ratio: float, ours: float, theirs: float) -> list[str]:
    return ["" if faces is None else f"{faces:,}", f"{ratio:.2f}", f"{ours:.2f}", f"{theirs:.2f}"]


def measure(peer: Path, meshes: list[Path], runs: int) -> dict[str, list[str]]:
    """The table's rows, printed one by one; the last one is of their medians."""
    found, rows = [], {}
    print("| " + " | ".join(HEAD) + " |\n" + "|" + " --- |" * len(HEAD), flush=True)
    for mesh in meshes:
        found.append(compare(peer, mesh, runs))
        rows[mesh.stem] = cells(*found[-1])
        print(f"| {mesh.stem} | " + " | ".join(rows[mesh.stem]) + " |", flush=True)
    ratio, ours, theirs = (statistics.median(column) for column in list(zip(*found))[1:])
    rows[f"median of {len(found)}"] = cells(None, ratio, ours, theirs)
    print(f"| median of {len(found)} | " + " | ".join(list(rows.values())[-1]) + " |", flush=True)
    return rows


def main() -> None:
    parser = argparse.ArgumentParser(prog="against_bff.py", description=__doc__.splitlines()[0])
    parser.add_argument("meshes", nargs="*", type=Path, metavar="MESH")
    parser.add_argument("--runs", type=int, default=RUNS)
    parser.add_argument("--write", action="store_true")
    options = parser.parse_args()
    print("## The whole command against boundary-first flattening\n")
    meshes = options.meshes or sorted(MESHES.glob("*.obj"))
    peer = built() if meshes else None
    if peer is None:
        last = doc_figures.load()["bff"]
        print(f"Its source is not in {SOURCE}, or no mesh is here. Measured on {last['date']}:\n")
        print(doc_figures.markdown(last))
        return
    print(f"File to file, median of {options.runs} pairs of processor seconds; mean angle error in degrees.\n")
    rows = measure(peer, meshes, options.runs)
    if options.write:
        doc_figures.keep("bff", HEAD, rows, "bench/against_bff.py --write", datetime.date.today().isoformat())
        doc_figures.write()


if __name__ == "__main__":
    main()
