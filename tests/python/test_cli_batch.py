"""koebe batch: the table, what is done again, and what stays whole when processes are killed, stopped or compete.

Files of Blender stand for meshes that behave badly: a script in Blender's place does what the file says.
"""

import contextlib
import csv
import hashlib
import json
import os
import random
import signal
import socket
import subprocess
import sys
import time

import pytest
from cli_support import (
    CANNOT_BE_MAPPED,
    COMMAND,
    INTERRUPTED,
    NOT_CONVERGED,
    USAGE,
    contents,
    koebe,
    new_program,
    obj_text,
    off_text,
    perforated,
)
from domain_surfaces import holed_ring, holed_torus

TETRAHEDRON = off_text([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])
# A program in Blender's place: it does what the first word of the file says, and notes that it ran.
STAND_IN = """#!{python}
import json, os, signal, sys, time
words = sys.argv
source, at = words[2], words.index("--")
option = lambda name: words[words.index(name, at) + 1]
with open(source + ".runs", "a") as runs:
    runs.write(f"{{os.getpid()}}\\n")
what, *rest = open(source).read().split()
code = 0
if what == "sleep":
    time.sleep(float(rest[0]))
elif what == "endless":
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
    while True:
        time.sleep(1)
elif what == "wait":  # for the one that started it to end
    sys.stdin.buffer.read()
    sys.exit(130)
elif what == "signal":
    os.kill(os.getpid(), int(rest[0]))
elif what == "exit":
    code = int(rest[0])
elif what == "refuse":  # without a report
    print("koebe: as it says", file=sys.stderr)
    sys.exit(int(rest[0]))
report = {{"objects": [], "exit_code": code}}
if code == 3:
    report["error"] = {{"name": "TransferError", "reason": "as it says"}}
else:
    open(option("--output"), "w").write(f"a result of {{source}}")
open(option("--report"), "w").write(json.dumps(report))
sys.exit(code)
"""

pytestmark = pytest.mark.slow


@pytest.fixture
def library(tmp_path):
    """Four surfaces, two of them in a folder, one that is closed, one that is no mesh."""
    folder = tmp_path / "library"
    (folder / "masks").mkdir(parents=True)
    for i, name in enumerate(("a", "b", "masks/c", "masks/d")):
        (folder / f"{name}.obj").write_text(obj_text(*perforated(10 + i)))
    (folder / "closed.off").write_text(TETRAHEDRON)
    (folder / "broken.ply").write_text("ply\n")
    (folder / "notes.txt").write_text("no mesh")
    (folder / ".hidden.obj").write_text("no mesh")
    return folder


@pytest.fixture
def blends(tmp_path):
    """A maker of .blend files that say what the program in Blender's place does, and that program."""
    program = new_program(tmp_path / "stand_in", STAND_IN.format(python=sys.executable))
    folder = tmp_path / "blends"
    folder.mkdir()

    class Blends:
        path = folder
        words = (folder, "--blender", program)

        def __init__(self, **files):
            for name, text in files.items():
                (folder / f"{name}.blend").write_text(text)

        @staticmethod
        def runs(name):
            file = folder / f"{name}.blend.runs"
            return [int(line) for line in file.read_text().split()] if file.exists() else []

    return Blends


def batch(*words, **options):
    return koebe("batch", *words, **options)


def as_from_a_terminal():
    """A run of the tests in the background, or under nohup, ignores signals, and its children would too."""
    for number in (signal.SIGINT, signal.SIGHUP):
        signal.signal(number, signal.SIG_DFL)


def start(*words, before=as_from_a_terminal):
    """A started batch; `before` is called in it first."""
    return subprocess.Popen([COMMAND, "batch", *map(str, words)], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                            text=True, preexec_fn=before)  # fmt: skip


def rows(folder):
    """The table, by name."""
    return {row["name"]: row for row in json.loads((folder / "summary.json").read_text())["files"]}


def until(condition, seconds=20):
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.01)


def is_alive(process):
    with contextlib.suppress(ProcessLookupError):
        os.kill(process, 0)
        with open(f"/proc/{process}/stat") as status:
            return status.read().rpartition(")")[2].split()[0] != "Z"
    return False


# ---------------------------------------------------------------- the table


@pytest.fixture
def tiles(tmp_path):
    """A torus with three holes, an annulus with two, and a tetrahedron."""
    folder = tmp_path / "tiles"
    folder.mkdir()
    for name, surface in (("torus", holed_torus(4)), ("ring", holed_ring(4, holes={(1, 0): ((0.5, 0.5), 0.3)}))):
        (folder / f"{name}.obj").write_text(obj_text(*surface[:2]))
    (folder / "closed.off").write_text(TETRAHEDRON)
    return folder


@pytest.mark.parametrize("words", [["torus"], ["ring"], ["ring", "--holes", "radial"], ["ring", "--tolerance", "1e-3"]],
                         ids=" ".join)  # fmt: skip
def test_other_domains_are_those_of_their_commands(tiles, tmp_path, words):
    domain, *options = words
    out = tmp_path / "out"
    done = batch(tiles, "--output", out, "--domain", domain, *options)
    assert done.returncode == CANNOT_BE_MAPPED and done.stdout.startswith("3 files: 1 done, 2 failed;")
    table = rows(out)
    assert table["closed.off"]["error"] in ("TopologyError(genus)", "TopologyError(closed)")
    row = table[f"{domain}.obj"]
    assert row["options"]["domain"] == domain and row["flipped"] == 0 and row["faces"] > 0
    koebe(domain, tiles / f"{domain}.obj", tmp_path / "alone.obj", *options)
    assert (tmp_path / "alone.obj").read_bytes() == (out / f"{domain}.obj").read_bytes()
    again = batch(tiles, "--output", out, "--domain", domain, *options)
    assert "(3 unchanged)" in again.stdout
    other = batch(tiles, "--output", out, "--domain", domain, "--max-sweeps", "40", *options)
    assert "unchanged" not in other.stdout


# Of a domain: its option and the words of this, whose surfaces are mapped, and whose have the wrong number of handles.
WORDS = {
    "sphere": ("layout", ["equirectangular", "octahedral"], ["ring.obj", "closed.off"], ["torus.obj"]),
    "schottky": ("normalization", ["area", "circles"], ["torus.obj"], ["ring.obj", "closed.off"]),
}


@pytest.mark.parametrize("chosen", [0, 1])
@pytest.mark.parametrize("domain", WORDS)
def test_spheres_and_handles_are_those_of_the_command(tiles, tmp_path, domain, chosen):
    """The word of the option is a part of the recipe."""
    option, words, fitting, others = WORDS[domain]
    asked, other = (["--domain", domain, f"--{option}", words[k]] for k in (chosen, 1 - chosen))
    out = tmp_path / "out"
    done = batch(tiles, "--output", out, *asked)
    counts = f"3 files: {len(fitting)} done, {len(others)} failed;"
    assert done.returncode == CANNOT_BE_MAPPED and done.stdout.startswith(counts)
    table = rows(out)
    assert {table[source]["error"] for source in others} == {"TopologyError(genus)"}
    for source in fitting:
        row = table[source]
        assert row["options"] == {
            "domain": domain, option: words[chosen], "tolerance": 1e-6, "max_sweeps": 50, "most_lost": 0.01
        }  # fmt: skip
        assert row["flipped"] == 0 and row["faces"] > 0 and row["angle_error_deg"] > 0
        koebe(domain, tiles / source, tmp_path / "alone.obj", f"--{option}", words[chosen])
        assert (tmp_path / "alone.obj").read_bytes() == (out / source).with_suffix(".obj").read_bytes()
    assert "(3 unchanged)" in batch(tiles, "--output", out, *asked).stdout
    assert "unchanged" not in batch(tiles, "--output", out, *other).stdout


@pytest.mark.parametrize("words", [
    ["--domain", "ball"], ["--holes", "radial"], ["--layout", "octahedral"], ["--domain", "torus", "--holes", "radial"],
    ["--domain", "torus", "--balance", "area"], ["--domain", "ring", "--cut"], ["--domain", "ring", "--outer", "3"],
    ["--domain", "ring", "--holes", "square"], ["--domain", "ring", "--layout", "octahedral"],
    ["--domain", "sphere", "--layout", "flat"], ["--domain", "sphere", "--polish"],
    ["--normalization", "area"], ["--domain", "schottky", "--normalization", "none"],
    ["--domain", "schottky", "--layout", "octahedral"], ["--domain", "torus", "--normalization", "area"],
], ids=" ".join)  # fmt: skip
def test_options_of_another_domain_are_wrong_usage(tiles, tmp_path, words):
    done = batch(tiles, "--output", tmp_path / "out", *words)
    assert done.returncode == USAGE and not (tmp_path / "out").exists()
    assert done.stderr.startswith("WrongUsage: ") and done.stderr.count("\n") == 1


def test_files_of_blender_are_told_the_domain(blends, tmp_path):
    files = blends(a="exit 0")
    out = tmp_path / "out"
    assert batch(*files.words, "--output", out, "--domain", "ring", "--holes", "radial").returncode == 0
    assert rows(out)["a.blend"]["options"]["arguments"] == ["--domain=ring", "--holes=radial"]
    assert "(1 unchanged)" in batch(*files.words, "--output", out, "--domain", "ring", "--holes", "radial").stdout
    assert "unchanged" not in batch(*files.words, "--output", out, "--domain", "torus").stdout
    assert len(files.runs("a")) == 2
    assert batch(*files.words, "--output", out, "--domain", "sphere", "--layout", "octahedral").returncode == 0
    assert rows(out)["a.blend"]["options"]["arguments"] == ["--domain=sphere", "--layout=octahedral"]
    assert batch(*files.words, "--output", out, "--domain", "schottky", "--normalization", "circles").returncode == 0
    assert rows(out)["a.blend"]["options"]["arguments"] == ["--domain=schottky", "--normalization=circles"]


def test_each_file_has_a_result_a_report_and_a_row(library, tmp_path):
    out = tmp_path / "out"
    done = batch(library, "--output", out)
    assert done.returncode == CANNOT_BE_MAPPED
    assert done.stdout.startswith("6 files: 4 done, 2 failed;")
    table = rows(out)
    assert list(table) == ["a.obj", "b.obj", "broken.ply", "closed.off", "masks/c.obj", "masks/d.obj"]
    assert {name: row["exit_code"] for name, row in table.items() if row["exit_code"]} == {
        "broken.ply": 3, "closed.off": 3}  # fmt: skip
    assert table["closed.off"]["error"] == "TopologyError(closed)" and "closed" in table["closed.off"]["error_text"]
    assert table["broken.ply"]["error"] == "InputError" and table["broken.ply"]["faces"] is None
    for name in ("a.obj", "masks/d.obj"):
        report = json.loads((out / name).with_suffix(".json").read_text())
        row = table[name]
        assert row["input_sha256"] == hashlib.sha256((library / name).read_bytes()).hexdigest()
        assert row["input_sha256"] == report["input_sha256"]
        assert report["output_sha256"] == hashlib.sha256((out / name).read_bytes()).hexdigest()
        assert row["faces"] == report["faces"] > 0 and row["flipped"] == 0 == row["below_resolution"]
        assert row["angle_error_deg"] == report["angle_error_deg"]["mean"]
        assert row["warnings"] == len(report["warnings"]) and row["seconds"] == report["seconds"]["total"]
        assert row["version"] == report["version"] and row["options"]["method"] == "gk"
        assert row["output"] == name
        koebe("uniformize", library / name, tmp_path / "alone.obj")
        assert (tmp_path / "alone.obj").read_bytes() == (out / name).read_bytes()
    with open(out / "summary.csv", newline="") as file:
        as_csv = list(csv.DictReader(file))
    assert [row["name"] for row in as_csv] == list(table) and as_csv[0].keys() == table["a.obj"].keys()
    assert json.loads(as_csv[0]["options"]) == table["a.obj"]["options"]
    assert {p.name for p in out.iterdir()} == {
        "a.obj", "a.json", "b.obj", "b.json", "broken.json", "closed.json", "masks", "summary.json", "summary.csv"
    }  # fmt: skip


def test_the_report_of_one_map_has_hash_and_options_too(library, tmp_path):
    report = tmp_path / "report.json"
    assert koebe("uniformize", library / "a.obj", tmp_path / "o.obj", "--json", report, "--method=ck").returncode == 0
    content = json.loads(report.read_text())
    assert content["input_sha256"] == hashlib.sha256((library / "a.obj").read_bytes()).hexdigest()
    assert content["options"] == {
        "method": "ck", "engine": "condensed", "outer": "auto", "center": None, "point": None, "tolerance": 1e-6,
        "max_sweeps": 50, "most_lost": 0.01, "balance": "none", "polish": False,
        "even": 0.0, "loops": "auto",
    }  # fmt: skip


def test_options_reach_each_map_and_the_format_is_of_the_results(library, tmp_path):
    words = ("--method=ck", "--engine", "mesh", "--schedule", "0,1,2,3", "--max-sweeps", 1, "--polish", "--format=ply")
    done = batch(library / "a.obj", "--output", tmp_path / "out", *words)
    assert done.returncode == NOT_CONVERGED, done.stderr
    row = rows(tmp_path / "out")["a.obj"]
    assert row["exit_code"] == NOT_CONVERGED and row["error"] is None and row["output"] == "a.ply"
    assert row["options"]["schedule"] == ["0", "1", "2", "3"] and row["options"]["polish"] is True
    koebe("uniformize", library / "a.obj", tmp_path / "alone.ply", *words[:-1])
    assert (tmp_path / "out" / "a.ply").read_bytes() == (tmp_path / "alone.ply").read_bytes()


def test_bad_meshes_win_over_those_that_did_not_converge(library, tmp_path):
    words = ("--output", tmp_path / "out", "--max-sweeps", 1, "--quiet")
    done = batch(library / "a.obj", library / "closed.off", *words)
    assert (done.returncode, done.stdout, done.stderr) == (CANNOT_BE_MAPPED, "", "")


def test_an_option_that_does_not_fit_one_mesh_fails_that_one(library, tmp_path):
    done = batch(library / "a.obj", "--output", tmp_path / "out", "--center", 100000)
    assert done.returncode == CANNOT_BE_MAPPED
    assert rows(tmp_path / "out")["a.obj"]["error"] == "WrongUsage"


@pytest.mark.parametrize(
    ("words", "reason"),
    [
        (["library"], "--output is required"),
        (["nowhere", "--output", "out"], "does not exist"),
        (["library/notes.txt", "--output", "out"], "is not a mesh file"),
        (["library/s.blend", "--output", "out"], "--blender"),
        (["library/a.obj", "other/a.obj", "--output", "out"], "would both get the name a.obj"),
        (["library/a.obj", "other/a.ply", "--output", "out"], "would both write"),
        (["other/summary.obj", "--output", "out"], "the summary's name"),
        (["library/a.obj", "--output", "library"], "would replace the mesh"),
        (["library/a.obj", "--base", "other", "--output", "out"], "is not in --base"),
        (["empty", "--output", "out"], "no mesh file in empty"),
        (["library", "--output", "out", "--workers", "-1"], "--workers"),
        (["library", "--output", "out", "--time-limit", "0"], "--time-limit"),
        (["library", "--output", "out", "--format", "stl"], "--format"),
        (["library", "--output", "out", "--center", "1", "--balance", "area"], "--center"),
    ],
)
def test_wrong_usage_is_told_and_nothing_is_written(library, tmp_path, words, reason):
    for name in ("other/a.obj", "other/a.ply", "other/summary.obj", "library/s.blend"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text("something")
    (tmp_path / "empty").mkdir()
    before = {p.relative_to(tmp_path) for p in tmp_path.rglob("*")}
    done = batch(*words, cwd=tmp_path)
    assert done.returncode == USAGE
    assert reason in done.stderr and done.stderr.count("\n") == 1 and done.stdout == ""
    assert {p.relative_to(tmp_path) for p in tmp_path.rglob("*")} == before


def test_results_may_lie_in_the_library_and_are_no_inputs(library):
    assert batch(library / "a.obj", library / "masks", library / "a.obj", "--output", library / "out").returncode == 0
    assert set(rows(library / "out")) == {"a.obj", "c.obj", "d.obj"}
    batch(library, "--output", library / "out")
    assert not any(name.startswith("out/") for name in rows(library / "out"))


def test_a_base_gives_single_files_the_names_of_a_whole_run(library, tmp_path):
    batch(library, "--output", tmp_path / "whole")
    for path in sorted(library.rglob("*.o*")) + [library / "broken.ply"]:
        if not path.name.startswith("."):
            batch(path, "--base", library, "--output", tmp_path / "single")
    assert contents(tmp_path / "single") == contents(tmp_path / "whole")


def test_runs_on_single_files_leave_the_table_to_one_of_all(library, tmp_path):
    out = tmp_path / "out"
    listed = batch(library, library / "masks" / "c.obj", "--output", out, "--list")
    assert listed.returncode == 0 and not out.exists()
    pairs = [line.split("\t") for line in listed.stdout.splitlines()]
    own = str(library / "masks")
    names = ["a.obj", "b.obj", "broken.ply", "closed.off", "masks/c.obj", "masks/d.obj"]
    assert sorted(pairs) == sorted([[str(library), name] for name in names] + [[own, "c.obj"]])
    for folder, name in pairs:
        batch(f"{folder}/{name}", "--base", folder, "--output", out, "--no-summary")
    assert not (out / "summary.json").exists()
    done = batch(library, "--output", out, "--summary-only")
    assert (done.returncode, done.stdout) == (0, f"the table is {out}/summary.json\n")
    assert list(rows(out)) == sorted([*names, "c.obj"])


# ---------------------------------------------------------------- what is done again


def again(library, out, *words):
    """Runs once more; the names that were mapped."""
    done = batch(library, "--output", out, *words)
    told = dict(line.split("] ", 1)[1].split(": ", 1) for line in done.stderr.splitlines())
    return {name for name, how in told.items() if not how.startswith("unchanged")}


def test_what_is_done_and_unchanged_is_skipped(library, tmp_path):
    out = tmp_path / "out"
    everything = again(library, out)
    assert len(everything) == 6
    first = contents(out)
    assert again(library, out) == set()
    os.utime(library / "a.obj")  # its time is not its content
    assert again(library, out, "--threads", 1) == set()
    assert contents(out) == first

    (library / "a.obj").write_text(obj_text(*perforated(14)))
    assert again(library, out) == {"a.obj"}
    (out / "b.obj").unlink()
    assert again(library, out) == {"b.obj"}
    with open(out / "b.obj", "r+") as damaged:
        damaged.truncate(1000)
    assert again(library, out) == {"b.obj"}
    (out / "masks" / "c.json").write_text("{")
    assert again(library, out) == {"masks/c.obj"}
    assert again(library, out, "--retry") == {"broken.ply", "closed.off"}
    assert again(library, out, "--format", "ply") == {"a.obj", "b.obj", "masks/c.obj", "masks/d.obj"}
    assert again(library, out, "--tolerance", "1e-5") == everything


def test_another_version_maps_again(library, tmp_path):
    out = tmp_path / "out"
    batch(library / "a.obj", "--output", out)
    report = json.loads((out / "a.json").read_text())
    (out / "a.json").write_text(json.dumps({**report, "version": "0.0.1"}))
    assert again(library / "a.obj", out) == {"a.obj"}


def test_a_result_does_not_outlive_the_mesh_it_was_made_of(library, tmp_path):
    out = tmp_path / "out"
    batch(library / "a.obj", "--output", out)
    (library / "a.obj").write_text("v 1 2\n")
    assert batch(library / "a.obj", "--output", out).returncode == CANNOT_BE_MAPPED
    assert not (out / "a.obj").exists() and rows(out)["a.obj"]["error"] == "InputError"


# ---------------------------------------------------------------- processes that end badly


def test_one_bad_file_spoils_itself_alone(blends, library, tmp_path):
    files = blends(
        good="sleep 0", crash=f"signal {signal.SIGSEGV.value}", abort=f"signal {signal.SIGABRT.value}",
        bad="exit 3", slow="exit 4", lost="exit 77", wrong="refuse 2",
    )  # fmt: skip
    out = tmp_path / "out"
    done = batch(*files.words, library / "a.obj", "--output", out)
    assert done.returncode == CANNOT_BE_MAPPED
    assert {name: (row["exit_code"], row["error"]) for name, row in rows(out).items()} == {
        "a.obj": (0, None), "good.blend": (0, None), "slow.blend": (4, None), "crash.blend": (3, "Crash"),
        "abort.blend": (3, "Crash"), "lost.blend": (3, "Crash"),
        "bad.blend": (3, "TransferError"), "wrong.blend": (3, "Refused"),
    }  # fmt: skip
    assert batch(*files.words, "--output", out).returncode == CANNOT_BE_MAPPED
    assert all(len(files.runs(name)) == 1 for name in ("good", "crash", "abort", "bad", "slow", "lost"))


def test_an_endless_file_is_ended_and_tried_again_with_more_time_alone(blends, tmp_path):
    files = blends(endless="endless", good="sleep 0")
    words = (*files.words, "--output", tmp_path / "out", "--workers", 2)
    begin = time.monotonic()
    assert batch(*words, "--time-limit", 1).returncode == CANNOT_BE_MAPPED
    assert time.monotonic() - begin < 10
    row = rows(tmp_path / "out")["endless.blend"]
    assert (row["error"], row["error_text"]) == ("TimeLimit", "it was not done after 1 seconds")
    assert not is_alive(files.runs("endless")[0])
    batch(*words, "--time-limit", 0.5)
    assert len(files.runs("endless")) == 1
    batch(*words, "--time-limit", 1.5)
    assert len(files.runs("endless")) == 2 and len(files.runs("good")) == 1


def test_a_mesh_too_large_for_the_memory_spoils_itself_alone(library, tmp_path):
    (library / "large.obj").write_text(obj_text(*perforated(400)))
    limited = f"ulimit -v 450000; exec {COMMAND} batch {library} --output {tmp_path / 'out'} --workers 1"
    done = subprocess.run(["bash", "-c", limited], capture_output=True, text=True, timeout=120)
    table = rows(tmp_path / "out")
    assert table["large.obj"]["error"] in ("OutOfMemory", "SolverError"), done.stderr
    assert table["a.obj"]["exit_code"] == 0 and table["masks/d.obj"]["exit_code"] == 0


def test_a_killed_process_is_told_and_tried_again(blends, tmp_path):
    files = blends(wait="sleep 30")
    words = (*files.words, "--output", tmp_path / "out")
    run = start(*words)
    until(lambda: files.runs("wait"))
    os.kill(files.runs("wait")[0], signal.SIGKILL)
    assert run.wait(timeout=20) == CANNOT_BE_MAPPED
    assert rows(tmp_path / "out")["wait.blend"]["error"] == "Killed"
    (files.path / "wait.blend").write_text("sleep 30")  # the same bytes
    run = start(*words, "--exit-zero")
    until(lambda: len(files.runs("wait")) == 2)
    os.kill(files.runs("wait")[1], signal.SIGKILL)
    assert run.wait(timeout=20) == CANNOT_BE_MAPPED


def test_a_farm_may_ask_for_zero_where_the_mesh_is_at_fault(blends, library, tmp_path):
    files = blends(bad="exit 3", slow="exit 4")
    words = (*files.words, library, "--output", tmp_path / "out", "--exit-zero")
    assert batch(*words).returncode == 0
    assert batch(*words).returncode == 0
    assert sum(row["exit_code"] == 3 for row in rows(tmp_path / "out").values()) == 3


def test_a_program_that_cannot_be_started_is_an_error_in_one_line(blends, tmp_path):
    files = blends(good="sleep 0")
    done = batch(files.path, "--blender", tmp_path / "nowhere", "--output", tmp_path / "out")
    assert done.returncode == CANNOT_BE_MAPPED and done.stderr.startswith("FileError: cannot start")
    assert not (tmp_path / "out" / ".koebe-batch").exists()


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_an_interrupt_ends_the_processes_and_leaves_what_is_done(blends, library, tmp_path, number):
    out = tmp_path / "out"
    files = blends(z="endless")
    run = start(*files.words, library, "--output", out, "--workers", 2)
    until(lambda: files.runs("z"))
    until(lambda: (out / "masks" / "d.json").exists())
    run.send_signal(number)
    assert run.wait(timeout=20) == INTERRUPTED
    assert "interrupted" in run.stderr.read()
    assert not is_alive(files.runs("z")[0])
    assert set(rows(out)) == {"a.obj", "b.obj", "broken.ply", "closed.off", "masks/c.obj", "masks/d.obj"}
    assert not [p for p in out.rglob("*") if ".koebe" in p.as_posix()]


def test_what_is_ignored_stays_ignored(blends, tmp_path):
    files = blends(z="sleep 1.5")
    run = start(*files.words, "--output", tmp_path / "out",
                before=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))  # fmt: skip
    until(lambda: files.runs("z"))
    run.send_signal(signal.SIGHUP)
    assert run.wait(timeout=20) == 0


# ---------------------------------------------------------------- killed half way


def test_no_process_outlives_a_killed_run(blends, tmp_path):
    (tmp_path / "large").mkdir()
    (tmp_path / "large" / "large.obj").write_text(obj_text(*perforated(500)))
    files = blends(wait="wait")
    run = start(*files.words, tmp_path / "large", "--output", tmp_path / "out", "--workers", 2)
    until(lambda: files.runs("wait"))
    children = subprocess.run(["pgrep", "-P", str(run.pid)], capture_output=True, text=True).stdout.split()
    assert len(children) == 2
    run.kill()
    run.wait()
    until(lambda: not any(is_alive(int(child)) for child in children), 5)


def test_killed_at_any_moment_and_resumed_the_results_are_those_of_an_undisturbed_run(tmp_path):
    library, out = tmp_path / "library", tmp_path / "out"
    library.mkdir()
    for i in range(8):
        (library / f"m{i}.obj").write_text(obj_text(*perforated(16 + i)))
    (library / "closed.off").write_text(TETRAHEDRON)
    begin = time.monotonic()
    assert batch(library, "--output", tmp_path / "undisturbed", "--workers", 2).returncode == CANNOT_BE_MAPPED
    length = time.monotonic() - begin
    expected = contents(tmp_path / "undisturbed")
    chance = random.Random(1)
    kills = rounds = 0
    while rounds < 40 or (kills < 10 and rounds < 200):
        rounds += 1
        run = start(library, "--output", out, "--workers", 2)
        time.sleep(chance.uniform(0.0, 0.5 * length))
        if chance.random() < 0.5:
            run.kill()
        else:
            children = subprocess.run(["pgrep", "-P", str(run.pid)], capture_output=True, text=True).stdout.split()
            for child in children[:1]:
                with contextlib.suppress(ProcessLookupError):
                    os.kill(int(child), signal.SIGKILL)
        code = run.wait(timeout=60)
        run.stderr.close()
        kills += code == -signal.SIGKILL
        for path in out.rglob("*.json"):
            json.loads(path.read_text())  # whole
        for path in chance.sample(sorted(out.glob("m*.*")), min(6, len(list(out.glob("m*.*"))))):
            path.unlink()  # so that there is something to do
    assert kills >= 10
    assert batch(library, "--output", out).returncode == CANNOT_BE_MAPPED
    assert contents(out) == expected


# ---------------------------------------------------------------- several runs on one folder


def test_runs_at_once_do_each_file_once(blends, tmp_path):
    files = blends(**{f"f{i:02}": "sleep 0.05" for i in range(30)})
    runs = [start(*files.words, "--output", tmp_path / "out", "--workers", 2) for _ in range(3)]
    assert [run.wait(timeout=60) for run in runs] == [0, 0, 0]
    assert all(len(files.runs(f"f{i:02}")) == 1 for i in range(30))
    assert len(rows(tmp_path / "out")) == 30
    told = "".join(run.stderr.read() for run in runs)
    assert told.count(": done, ") == 30
    assert not (tmp_path / "out" / ".koebe-batch").exists()


def test_what_a_killed_run_had_in_hand_is_taken_over_at_once(blends, tmp_path):
    files = blends(a="sleep 2", b="sleep 0")
    words = (*files.words, "--output", tmp_path / "out", "--workers", 1)
    first = start(*words)
    until(lambda: files.runs("a"))
    second = start(*words)
    until(lambda: files.runs("b"))
    first.kill()
    first.wait()
    assert second.wait(timeout=20) == 0
    assert len(files.runs("a")) == 2 and len(files.runs("b")) == 1


def claim_file(out, name, **owner):
    """A claim of another run."""
    folder = out / ".koebe-batch"
    folder.mkdir(parents=True, exist_ok=True)
    file = folder / f"{hashlib.sha256(name.encode()).hexdigest()[:32]}.7"
    file.write_text(json.dumps({"file": name, **owner}) if owner else "")
    return file


def test_a_claim_of_another_host_holds_while_it_is_renewed(library, tmp_path):
    out = tmp_path / "out"
    file = claim_file(out, "a.obj", host="elsewhere", process=1)
    begin = time.monotonic()
    run = start(library / "a.obj", "--output", out, "--stale", 2)
    while time.monotonic() - begin < 4:
        os.utime(file)
        time.sleep(0.1)
        assert run.poll() is None
    assert run.wait(timeout=60) == 0
    assert time.monotonic() - begin > 5.7
    assert set(contents(out)) == {"a.obj", "a.json", "summary.json"}


def test_what_a_dead_run_left_of_a_file_that_is_done_is_removed(library, tmp_path):
    out = tmp_path / "out"
    assert batch(library / "a.obj", "--output", out).returncode == 0
    before = contents(out)
    claim_file(out, "a.obj", host=socket.gethostname(), process=2**22 + 1)
    assert batch(library / "a.obj", "--output", out).returncode == 0
    assert contents(out) == before and not (out / ".koebe-batch").exists()


@pytest.mark.parametrize("owner", [{}, {"host": socket.gethostname(), "process": 2**22 + 1}])
def test_a_claim_of_a_dead_process_is_taken_over(library, tmp_path, owner):
    out = tmp_path / "out"
    claim_file(out, "a.obj", **owner)
    begin = time.monotonic()
    assert batch(library / "a.obj", "--output", out).returncode == 0
    assert time.monotonic() - begin < 60  # a claim of another host would hold for 120
    assert not (out / ".koebe-batch").exists()


def test_what_another_run_finishes_is_taken_from_it(library, tmp_path):
    out = tmp_path / "out"
    batch(library / "a.obj", "--output", tmp_path / "other")
    out.mkdir()
    claim = claim_file(out, "a.obj", host=socket.gethostname(), process=os.getpid())
    run = start(library / "a.obj", "--output", out)
    time.sleep(1)
    assert run.poll() is None
    for name in ("a.obj", "a.json"):
        (tmp_path / "other" / name).rename(out / name)
    claim.unlink()
    assert run.wait(timeout=20) == 0
    assert "done by another run" in run.stderr.read()
