"""koebe batch: what stays whole when processes are killed, stopped or compete."""

import contextlib
import hashlib
import json
import os
import random
import signal
import socket
import subprocess
import time

import pytest
from batch_support import TETRAHEDRON, batch, is_alive, rows, start, until
from cli_support import CANNOT_BE_MAPPED, COMMAND, INTERRUPTED, contents, obj_text, perforated

pytestmark = pytest.mark.slow


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
