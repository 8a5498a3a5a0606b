"""Time and accuracy tables: out/bench/*.md and *.json, and the same on the terminal.

Every time is a ratio to one cotan Laplacian of the same mesh (assemble, AMD, supernodal factor, two-column solve),
taken turn by turn in the same process; medians of RUNS pairs. The command as a whole is set against Blender's own
conformal unwrap, also turn by turn, and against boundary-first flattening (against_bff.py).
"""

import json
import os
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
BENCH = ROOT / "build" / "bench" / "koebe_bench"
KOEBE = ROOT / "build" / "koebe"
BLENDER = os.environ.get("BLENDER", "blender")
OUT = ROOT / "out" / "bench"
MESHES = ROOT.parent / "shared" / "meshes" / "good"
RUNS = 5
STAGES = ("topology", "metric", "factor", "iterate", "finish")


def run(mesh: str, engine: str = "condensed", method: str = "gk", runs: int = RUNS) -> dict:
    """Medians over the pairs of one mesh."""
    one_thread = {**os.environ, "OMP_NUM_THREADS": "1"}  # in the reference: CHOLMOD opens threads around supernodes
    process = subprocess.run([BENCH, mesh, str(runs), engine, method], capture_output=True, text=True, env=one_thread)
    if process.returncode:
        raise SystemExit(f"{mesh}: {process.stderr.strip()}")
    pairs = json.loads(process.stdout)
    report = pairs[-1]["report"]
    total = statistics.median(p["seconds"] for p in pairs)
    stage = {s: statistics.median(p["report"]["seconds"][s] for p in pairs) for s in STAGES}
    return {
        "mesh": named(mesh),
        "engine": engine,
        "method": method,
        "faces": report["faces"],
        "loops": len(report["loops"]),
        "boundary_vertices": sum(loop["vertices"] for loop in report["loops"]),
        "laplacian_seconds": statistics.median(p["laplacian_seconds"] for p in pairs),
        "seconds": total,
        "ratio": statistics.median(p["seconds"] / p["laplacian_seconds"] for p in pairs),
        "stage_share": {s: stage[s] / total for s in STAGES},
        "sweeps": report["sweeps"],
        "converged": report["converged"],
        "angle_error_deg": report["angle_error_deg"]["mean"],
        "mean_roundness": report["history"][-1]["mean_roundness"] if report["history"] else 0.0,
        "flipped": report["flipped"],
        "peak_memory_mb": report["peak_memory_mb"],
        "circle_error": pairs[-1].get("circle_error"),
    }


def named(mesh: str) -> str:
    """The mesh as the tables call it: a stem, with the number of faces each of the file's is cut into."""
    times, _, path = mesh.rpartition(":")
    return f"{Path(path).stem} x {4 ** int(times)}" if times.isdigit() else Path(mesh).stem


def against_blender(mesh: str, runs: int = RUNS) -> dict:
    """The whole command, file to file, and Blender's unwrap operator alone, turn by turn."""
    script = [BLENDER, "-b", "--factory-startup", "--python-exit-code", "1", "-P", ROOT / "bench" / "blender_unwrap.py"]
    pairs = []
    with tempfile.TemporaryDirectory() as folder, subprocess.Popen(
        [*script, "--", mesh], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    ) as blender:
        for _ in range(runs + 1):
            blender.stdin.write("\n")
            blender.stdin.flush()
            answer = next(line for line in blender.stdout if line.startswith("seconds"))
            start = time.perf_counter()
            subprocess.run([KOEBE, "uniformize", mesh, Path(folder) / "out.obj", "--quiet"], check=True)
            pairs.append((time.perf_counter() - start, float(answer.split()[1])))
        blender.communicate()
    if blender.returncode:
        raise SystemExit(f"{mesh}: Blender ended with {blender.returncode}")
    pairs = pairs[1:]
    return {
        "mesh": named(mesh),
        "command_seconds": statistics.median(ours for ours, _ in pairs),
        "blender_seconds": statistics.median(theirs for _, theirs in pairs),
        "ratio": statistics.median(ours / theirs for ours, theirs in pairs),
    }


def markdown(title: str, note: str, columns: dict, rows: list[dict]) -> str:
    """A table; columns maps a heading to a function of the row."""
    lines = [f"## {title}", "", note, "", "| " + " | ".join(columns) + " |", "|" + " --- |" * len(columns)]
    lines += ["| " + " | ".join(str(cell(row)) for cell in columns.values()) + " |" for row in rows]
    return "\n".join(lines) + "\n"


def main() -> None:
    OUT.mkdir(parents=True, exist_ok=True)
    names = (
        "choi_alex3",
        "choi_lion5",
        "choi_sophie1",
        "fig1_nefertiti_20k_15",
        "fig11_nefertiti_40k_5",
        "ict_head_neutral_sub45k",
        "fig12_nefertiti_74k_9",
        "panel_tray",
        "mountain_40lakes",
        "nefertiti_20_triangle_holes",
        "nefertiti_200holes",
    )
    scans = [str(MESHES / f"{name}.obj") for name in names if (MESHES / f"{name}.obj").exists()]
    finer = [f"{times}:{MESHES / 'choi_sophie1.obj'}" for times in (1, 2) if (MESHES / "choi_sophie1.obj").exists()]
    largest = [mesh.replace("2:", "3:", 1) for mesh in finer[1:]]
    unwrapped = [mesh for mesh in scans if "ict_head" in mesh and shutil.which(BLENDER)]
    exact = [f"Enneper:{faces}" for faces in (1000, 4000, 16000, 36000)]

    base = {
        "mesh": lambda r: r["mesh"],
        "faces": lambda r: r["faces"],
        "loops": lambda r: r["loops"],
        "boundary": lambda r: r["boundary_vertices"],
        "Laplacian s": lambda r: f"{r['laplacian_seconds']:.3f}",
        "ratio": lambda r: f"{r['ratio']:.2f}",
    }
    quality = {
        "sweeps": lambda r: r["sweeps"],
        "angle error deg": lambda r: f"{r['angle_error_deg']:.3f}",
        "roundness": lambda r: f"{r['mean_roundness']:.1e}",
        "flipped": lambda r: r["flipped"],
    }
    shares = {s: (lambda r, s=s: f"{100 * r['stage_share'][s]:.0f} %") for s in STAGES}
    error = {"circle error": lambda r: f"{r['circle_error']:.1e}"}

    tables = {
        "condensed": (
            "Condensed engine",
            f"Time of the map over that of one Laplacian solve, median of {RUNS} pairs; share of each stage.",
            base | quality | shares,
            [run(mesh) for mesh in exact[1:] + scans + finer],
        ),
        "large": (
            "The largest",
            "One pair; the peak of memory is that of both.",
            base | {"peak MB": lambda r: f"{r['peak_memory_mb']:,.0f}"} | quality | shares,
            [run(mesh, runs=1) for mesh in largest],
        ),
        "blender": (
            "The whole command against Blender's conformal unwrap",
            f"File to file against the operator alone, median of {RUNS} pairs.",
            {
                "mesh": base["mesh"],
                "command s": lambda r: f"{r['command_seconds']:.2f}",
                "Blender s": lambda r: f"{r['blender_seconds']:.2f}",
                "ratio": base["ratio"],
            },
            [against_blender(mesh) for mesh in unwrapped],
        ),
        "mesh": (
            "Mesh engine",
            "The paper as written, patches re-meshed; median of 1 pair on the scans, 3 on the exact domain.",
            base | quality,
            [run(exact[1], "mesh", runs=3)] + [run(mesh, "mesh", runs=1) for mesh in scans[:3]],
        ),
        "exact": (
            "Five known circles on Enneper's surface",
            "Relative error of the inversive distances.",
            {k: base[k] for k in ("mesh", "faces")} | error | quality,
            [run(mesh, runs=1) for mesh in exact],
        ),
    }
    for name, (title, note, columns, rows) in tables.items():
        text = markdown(title, note, columns, rows)
        (OUT / f"{name}.md").write_text(text)
        (OUT / f"{name}.json").write_text(json.dumps(rows, indent=2) + "\n")
        print(text, flush=True)
    subprocess.run([sys.executable, ROOT / "bench" / "against_bff.py"], check=True)


if __name__ == "__main__":
    sys.exit(main())
