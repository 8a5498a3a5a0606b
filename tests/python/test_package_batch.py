"""koebe.batch and the command that comes with the package."""

import json
import os
import signal
import subprocess
import sys
import threading
import time

import koebe
import numpy as np
import pytest
from cli_support import COMMAND, obj_text, perforated
from koebe import _command
from koebe._progress import Run


@pytest.fixture
def library(tmp_path):
    folder = tmp_path / "library"
    (folder / "masks").mkdir(parents=True)
    (folder / "a.obj").write_text(obj_text(*perforated(10)))
    (folder / "masks" / "b.obj").write_text(obj_text(*perforated(11)))
    (folder / "bad.obj").write_text("v 1 2\n")
    return folder


def test_the_rows_are_those_of_the_table(library, tmp_path):
    out = tmp_path / "out"
    rows = koebe.batch(library, out, workers=2, time_limit=60, method="ck", max_sweeps=30, polish=True)
    assert [row["name"] for row in rows] == ["a.obj", "bad.obj", "masks/b.obj"]
    assert [row["exit_code"] for row in rows] == [0, 3, 0]
    assert rows[1]["error"] == "InputError"
    assert rows == json.loads((out / "summary.json").read_text())["files"]
    assert {key: rows[0]["options"][key] for key in ("method", "max_sweeps", "polish")} == {
        "method": "ck", "max_sweeps": 30, "polish": True}  # fmt: skip
    again = koebe.batch([library / "a.obj"], out, method="ck", max_sweeps=30, polish=True)
    assert again == rows[:1]
    assert koebe.batch([], out) == []


def test_progress_names_the_files_that_are_done(library, tmp_path):
    seen = []
    koebe.batch(library, tmp_path / "out", progress=lambda *told: seen.append(told))
    assert [fraction for fraction, _ in seen] == [0.0, *(np.arange(1, 4) / 3).tolist(), 1.0]
    assert seen[0][1] == "list" and seen[-1][1] == "table"
    assert {name for _, name in seen[1:-1]} == {"a.obj", "bad.obj", "masks/b.obj"}


def test_a_cancel_ends_the_command_and_the_next_call_goes_on(library, tmp_path):
    (library / "large.obj").write_text(obj_text(*perforated(500)))
    token, seen = koebe.CancelToken(), []

    def first_done(fraction, name):
        seen.append(name)
        if fraction > 0.0:
            token.cancel()

    with pytest.raises(koebe.Cancelled):
        koebe.batch(library, tmp_path / "out", workers=1, progress=first_done, cancel=token)
    assert seen == ["list", "a.obj"] and not (tmp_path / "out" / "large.obj").exists()
    threading.Timer(0.5, (later := koebe.CancelToken()).cancel).start()
    with pytest.raises(koebe.Cancelled):
        koebe.batch(library, tmp_path / "out", workers=1, cancel=later)
    (library / "large.obj").unlink()
    assert [row["exit_code"] for row in koebe.batch(library, tmp_path / "out")] == [0, 3, 0]

    def fail(fraction, name):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        koebe.batch(library, tmp_path / "out", progress=fail)


def test_a_wrong_call_is_an_option_error(library, tmp_path):
    with pytest.raises(koebe.OptionError, match="--method"):
        koebe.batch(library, tmp_path / "out", method="none")
    with pytest.raises(koebe.OptionError, match="--colour"):
        koebe.batch(library, tmp_path / "out", colour="red")
    with pytest.raises(koebe.OptionError, match="does not exist"):
        koebe.batch(tmp_path / "nowhere", tmp_path / "out")
    assert not (tmp_path / "out").exists()


def test_a_folder_that_cannot_be_written_is_an_error(library, tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(koebe.KoebeError, match="cannot write"):
        koebe.batch(library, tmp_path / "file")


class Done:
    status = "finished"

    def done(self):
        return True


class Here:
    """Stands in for a client of Dask, and runs each task at once."""

    def __init__(self, threads):
        self.threads, self.calls = threads, []

    def ncores(self):
        return {str(worker): 1 for worker in range(self.threads)}

    def submit(self, function, words, *, pure, key):
        assert not pure and key.startswith("koebe-")
        self.calls.append(words)
        function(words)
        return Done()

    def gather(self, tasks):
        assert len(tasks) == len(self.calls)


def test_a_scheduler_gets_each_file_once_some_files_a_task(library, tmp_path):
    here = koebe.batch(library, tmp_path / "here")
    scheduler = Here(threads=1)
    rows = koebe.batch([library / "masks", library], tmp_path / "there", base=library, scheduler=scheduler)
    assert [{**row, "seconds": 0} for row in rows] == [{**row, "seconds": 0} for row in here]
    assert all("--threads=1" in words for words in scheduler.calls)


@pytest.mark.parametrize("files, threads, tasks", [(3, 1, 3), (40, 1, 8), (40, 100, 40), (40, 0, 40), (200, 2, 20)])
def test_tasks_are_few_but_enough_for_all_threads(monkeypatch, tmp_path, files, threads, tasks):
    listed = [f"/{folder}\t{file}.obj" for file in range(files // 2) for folder in "ab"] + ["/a\tz.obj"] * (files % 2)
    ran = []
    monkeypatch.setattr(koebe._batch, "_run_some", ran.append)
    seen = []
    run = Run(lambda fraction, stage: seen.append((fraction, stage)), None)
    koebe._batch._run_on_workers(Here(threads), listed, ["--output", "/out"], run)
    assert seen == [(1.0, f"{files} of {files} files")]
    assert len(ran) == tasks
    said = [(words[words.index("--base") + 1], words[: words.index("--base")]) for words in ran]
    assert sorted(f"{home}\t{file[len(home) + 1 :]}" for home, some in said for file in some) == sorted(listed)


@pytest.mark.parametrize(
    "options, words",
    [({}, ["--threads=1"]), ({"threads": 3}, []), ({"threads": 0}, []), ({"domain": "torus"}, []),
     ({"domain": "sphere"}, ["--threads=1"])],
)  # fmt: skip
def test_a_file_beside_others_is_mapped_on_one_thread(options, words):
    assert koebe._batch._one_thread(options) == words


@pytest.mark.parametrize("number", [pytest.param(signal.SIGINT, marks=pytest.mark.slow), signal.SIGKILL])
def test_the_command_ends_with_python(tmp_path, number):
    (tmp_path / "large.obj").write_text(obj_text(*perforated(500)))
    call = f"import koebe; koebe.batch({str(tmp_path / 'large.obj')!r}, {str(tmp_path / 'out')!r})"
    python = subprocess.Popen([sys.executable, "-c", call], stderr=subprocess.PIPE)

    def processes():
        found = subprocess.run(["pgrep", "-f", str(tmp_path / "large.obj")], capture_output=True, text=True)
        return {int(line) for line in found.stdout.split()} - {python.pid}

    end = time.monotonic() + 20
    while len(processes()) < 2 and time.monotonic() < end:  # the batch, and the map
        time.sleep(0.05)
    assert len(processes()) == 2
    python.send_signal(number)
    python.wait(timeout=20)
    python.stderr.close()
    end = time.monotonic() + 10
    while processes() and time.monotonic() < end:
        time.sleep(0.05)
    assert not processes()


def test_python_m_koebe_is_the_command(library, tmp_path):
    words = ["uniformize", library / "a.obj", tmp_path / "o.obj"]
    runs = [
        subprocess.run([*front, *words], capture_output=True, text=True, timeout=60)
        for front in ([COMMAND], [sys.executable, "-m", "koebe"])
    ]
    assert [run.returncode for run in runs] == [0, 0]
    assert runs[1].stdout.split(",")[0] == runs[0].stdout.split(",")[0]
    refused = subprocess.run([sys.executable, "-m", "koebe", "nonsense"], capture_output=True, text=True, timeout=60)
    assert refused.returncode == 2 and refused.stderr.startswith("WrongUsage")


def test_the_command_is_found_in_the_package_first(monkeypatch, tmp_path):
    assert os.path.samefile(_command.path(), COMMAND)
    package = tmp_path / "site" / "koebe"
    (package / "bin").mkdir(parents=True)
    monkeypatch.setattr(_command, "_PACKAGE", package)
    with pytest.raises(koebe.KoebeError, match="install the package again"):
        _command.path()
    inside = package / "bin" / "koebe"
    inside.write_text("")
    inside.chmod(0o644)  # as an installer leaves it that knows no such bits
    assert _command.path() == inside and os.access(inside, os.X_OK)
