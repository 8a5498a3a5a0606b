"""The koebe command when something fails: the k-th allocation, a file, a folder, or its process at any moment.

Whatever fails, the command ends with an exit code that its help names and a line that says why, and a file is whole or
absent. The allocations fail in build/tests/native/libfailing_malloc.so, which is loaded before other libraries.
"""

import ctypes
import json
import os
import random
import re
import resource
import signal
import subprocess
import time
from functools import partial

import pytest
from cli_support import CANNOT_BE_MAPPED, COMMAND, INTERRUPTED, ROOT, koebe, names, obj_text, perforated

FAILING_MALLOC = ROOT / "build" / "tests" / "native" / "libfailing_malloc.so"
COMMANDS = {
    "uniformize": ("uniformize", "in.obj", "out.obj", "--json", "out.json", "--svg", "out.svg"),
    "mesh engine": ("uniformize", "in.obj", "out.ply", "--engine", "mesh", "--balance", "area"),
    "fill": ("fill", "in.obj", "out.obj"),
    "ricci": ("ricci", "in.obj", "out.obj"),
}
OUTPUTS = {name: {word for word in words if word.startswith("out.")} for name, words in COMMANDS.items()}


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "in.obj").write_text(obj_text(*perforated(8, ((0.3, 0.3, 0.15), (0.7, 0.6, 0.15)))))
    return tmp_path


def contents(folder):
    """Of all files but the mesh; a report without what is measured anew in each run."""
    found = {name: (folder / name).read_bytes() for name in names(folder) - {"in.obj"}}
    if "out.json" in found:
        found["out.json"] = json.loads(found["out.json"])
        del found["out.json"]["seconds"], found["out.json"]["peak_memory_mb"]
    return found


def is_part(found, expected):
    return all(name in expected and content == expected[name] for name, content in found.items())


def without_outputs(folder):
    for name in names(folder) - {"in.obj"}:
        (folder / name).unlink()


# ---------------------------------------------------------------- memory


def with_failing_malloc(folder, command, **environment):
    settings = {"LD_PRELOAD": str(FAILING_MALLOC)}
    environment = {name: str(value) for name, value in environment.items()}
    return koebe(*COMMANDS[command], cwd=folder, env={**os.environ, **settings, **environment})


def moments(count):
    """Of so many allocations: the first ones, the last ones, and some of each part between."""
    chance = random.Random(1)
    step = max(count // 60, 1)
    between = [chance.randrange(i, i + step) + 1 for i in range(0, count, step)]
    return sorted({*range(1, 41), *between, *range(count - 10, count + 1)})


@pytest.mark.parametrize("which", ["KOEBE_FAIL_AT", "KOEBE_FAIL_FROM"])
@pytest.mark.parametrize("command", COMMANDS)
def test_an_allocation_that_fails_is_an_error_or_makes_no_difference(folder, command, which):
    assert with_failing_malloc(folder, command, KOEBE_COUNT_FILE=folder / "count").returncode == 0
    count = int((folder / "count").read_text())
    (folder / "count").unlink()
    expected = contents(folder)
    assert set(expected) == OUTPUTS[command] and count > 1000
    codes = []
    for k in moments(count):
        without_outputs(folder)
        run = with_failing_malloc(folder, command, **{which: k})
        codes.append(run.returncode)
        found = contents(folder)
        assert is_part(found, expected), (k, run, set(found))
        if run.returncode == 0:
            assert found == expected and run.stdout.count("\n") == 1, (k, run)
        else:
            assert run.returncode == CANNOT_BE_MAPPED, (k, run)
            assert re.fullmatch(r"(OutOfMemory|SolverError): \S.*\n", run.stderr), (k, run)
    assert codes.count(CANNOT_BE_MAPPED) > len(codes) / 2


# ---------------------------------------------------------------- files


def test_a_full_disk_leaves_each_file_whole_or_absent(folder):
    assert koebe(*COMMANDS["uniformize"], cwd=folder).returncode == 0
    expected = contents(folder)
    sizes = sorted((folder / name).stat().st_size for name in expected)
    codes = set()
    for limit in (0, 1, 4096, *(size + more for size in sizes for more in (-1, 0)), sizes[1] // 2, 1 << 20):
        without_outputs(folder)
        set_limit = partial(resource.setrlimit, resource.RLIMIT_FSIZE, (limit, limit))
        run = koebe(*COMMANDS["uniformize"], cwd=folder, preexec_fn=set_limit)
        codes.add(run.returncode)
        assert is_part(contents(folder), expected), (limit, run)
        if run.returncode == 0:
            assert contents(folder) == expected, limit
        else:
            assert run.returncode == CANNOT_BE_MAPPED, run
            assert re.fullmatch(r"FileError: cannot write out\.\w+ .*\n", run.stderr), run
    assert codes == {0, CANNOT_BE_MAPPED}


def as_anybody():
    """Root may write everywhere; without this capability it is bound by permissions as all others are."""
    drop_of_the_bounding_set, dac_override = 24, 1
    if os.geteuid() == 0 and ctypes.CDLL(None).prctl(drop_of_the_bounding_set, dac_override, 0, 0, 0) != 0:
        os._exit(99)


@pytest.mark.parametrize("command", COMMANDS)
def test_a_read_only_folder_is_found_before_the_mesh_is_read(folder, command):
    (folder / "closed").mkdir()
    (folder / "closed" / "out.obj").write_text("old")
    (folder / "closed").chmod(0o555)
    words = [f"closed/{word}" if word.startswith("out.") else word for word in COMMANDS[command]]
    words[1] = "missing.obj"
    run = koebe(*words, cwd=folder, preexec_fn=as_anybody)
    if run.returncode == 99:
        pytest.skip("root, and no right to give up its rights")
    assert run.returncode == CANNOT_BE_MAPPED and run.stdout == ""
    assert re.fullmatch(r"FileError: cannot write closed/out\.\w+ \(Permission denied\)\n", run.stderr), run
    assert names(folder / "closed") == {"out.obj"} and (folder / "closed" / "out.obj").read_text() == "old"


# ---------------------------------------------------------------- moments


@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGTERM, signal.SIGINT])
def test_ended_at_any_moment_each_file_is_whole_or_the_old_one(folder, number):
    words = COMMANDS["uniformize"]
    start = time.monotonic()
    assert koebe(*words, cwd=folder).returncode == 0
    whole = time.monotonic() - start
    expected = contents(folder)
    codes = []
    for i in range(30):
        without_outputs(folder)
        (folder / "out.obj").write_text("old")
        run = subprocess.Popen(
            [COMMAND, *words],
            cwd=folder,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            preexec_fn=lambda: signal.signal(number, signal.SIG_DFL) if number != signal.SIGKILL else None,
        )
        time.sleep(1.1 * whole * i / 29)
        run.send_signal(number)
        run.communicate(timeout=60)
        codes.append(run.returncode)
        found = contents(folder)
        left = {name for name in found if re.fullmatch(r"\.koebe-\d+-\d+\.tmp", name)}
        for name in set(found) - left:
            assert found[name] == expected[name] or (name, found[name]) == ("out.obj", b"old"), (i, name)
        if run.returncode == INTERRUPTED:
            assert found == {"out.obj": b"old"}, i
        elif run.returncode == 0:
            assert found == expected, i
        else:  # before the command listens, a signal ends it as it ends any program
            assert run.returncode == -number and (number == signal.SIGKILL or found == {"out.obj": b"old"}), i
    assert any(code != 0 for code in codes)
