"""koebe.batch on the workers of Dask: the same table, also when a worker is killed half way."""

import os
import signal
import sys
import threading
import time
from pathlib import Path

import koebe
import pytest

distributed = pytest.importorskip("distributed")

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "python"))
from cli_support import new_program, obj_text, perforated  # noqa: E402

FILES = 16
# In the place of Blender: notes that it ran, takes a moment, writes a result.
STAND_IN = """#!{python}
import json, sys, time
words = sys.argv
open(words[2] + ".runs", "a").write("x")
time.sleep(0.3)
open(words[words.index("--output") + 1], "w").write("a result of " + words[2])
open(words[words.index("--report") + 1], "w").write(json.dumps({{"objects": [], "exit_code": 0}}))
"""


@pytest.fixture
def library(tmp_path):
    folder = tmp_path / "library"
    folder.mkdir()
    for i in range(FILES):
        (folder / f"s{i:02}.blend").write_text(str(i))
    for i in range(4):
        (folder / f"m{i}.obj").write_text(obj_text(*perforated(10 + i)))
    (folder / "bad.obj").write_text("v 1 2\n")
    return folder


@pytest.fixture
def blender(tmp_path):
    return new_program(tmp_path / "stand_in", STAND_IN.format(python=sys.executable))


@pytest.fixture
def client(tmp_path):
    with (
        distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None, local_directory=str(tmp_path)
        ) as cluster,
        distributed.Client(cluster) as client,
    ):
        yield client


def lasting(rows):
    return [{key: value for key, value in row.items() if key != "seconds"} for row in rows]


def test_a_worker_killed_half_way_costs_nothing(library, blender, client, tmp_path):
    undisturbed = koebe.batch(library, tmp_path / "here", blender=blender)
    runs = lambda: {path.name: len(path.read_text()) for path in library.glob("*.runs")}  # noqa: E731
    assert set(runs().values()) == {1} and len(runs()) == FILES
    for path in library.glob("*.runs"):
        path.unlink()
    victim = next(iter(client.run(os.getpid).values()))

    def kill_half_way():
        while len(runs()) < FILES // 2:
            time.sleep(0.01)
        os.kill(victim, signal.SIGKILL)

    killer = threading.Thread(target=kill_half_way)
    killer.start()
    seen = []
    tell = lambda fraction, _: seen.append(fraction)  # noqa: E731
    rows = koebe.batch(library, tmp_path / "dask", blender=blender, scheduler=client, progress=tell)
    killer.join()
    assert len(seen) > 3 and seen == sorted(seen) and seen[0] == 0.0 and seen[-1] == 1.0
    assert victim not in client.run(os.getpid).values()
    assert lasting(rows) == lasting(undisturbed) and len(rows) == FILES + 5
    again = sorted(runs().values())
    assert len(again) == FILES and again[:-1] == [1] * (FILES - 1) and again[-1] <= 2  # what it had in hand
    for row in rows:
        if row["output"]:
            assert (tmp_path / "dask" / row["output"]).read_bytes() == (tmp_path / "here" / row["output"]).read_bytes()
    assert not list((tmp_path / "dask").glob(".koebe*"))


def test_an_error_of_the_folder_reaches_the_caller(library, client, tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(koebe.KoebeError, match="cannot write"):
        koebe.batch(library, tmp_path / "file", scheduler=client)
