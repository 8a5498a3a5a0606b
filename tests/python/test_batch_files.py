"""Files told apart by what they are, and written whole or not at all. Without Blender."""

import json
import os
import pty
import random
import resource
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from addon_support import LOAD

LOAD_FILES = f"{LOAD}files = addon_module('headless.files')\n"


@pytest.fixture(scope="module")
def files(addon):
    return addon("headless.files")


@pytest.fixture
def stop(addon):
    return addon("headless.exit_and_signals").Stop


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """The current folder."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


def writer(content):
    return lambda path: Path(path).write_bytes(content)


def fill_and_put(files, **contents):
    files.write_all({files.Target(name.replace("_", ".")): writer(content) for name, content in contents.items()}, int)


def test_a_file_is_the_same_by_all_its_names(files, folder):
    (folder / "a").write_text("a")
    (folder / "b").write_text("a")
    (folder / "link").symlink_to("a")
    (folder / "here").symlink_to(".")
    os.link("a", "hard")
    for name in ("a", "./a", "here/a", "link", "here/link", "hard", str(folder / "a"), f"../{folder.name}/a"):
        assert files.is_same("a", name) and files.is_same(name, "a")
    for name in ("b", "missing", "A", "missing/a", "."):
        assert not files.is_same("a", name) and not files.is_same(name, "a")


def test_files_that_are_not_there_yet_are_the_same_by_folder_and_name(files, folder):
    (folder / "here").symlink_to(".")
    (folder / "link").symlink_to("new.blend")
    for name in ("new.blend", "./new.blend", "here/new.blend", "link", "NEW.blend", str(folder / "new.blend")):
        assert files.is_same("new.blend", name) and files.is_same(name, "new.blend")
    assert files.is_same("caf\u00e9", "cafe\u0301"), "which some systems hold for one name"
    for name in ("new.json", "missing/new.blend", ".", "/"):
        assert not files.is_same("new.blend", name) and not files.is_same(name, "new.blend")


def test_all_is_written_whole_and_nothing_else_is_left(files, folder):
    (folder / "old.json").write_text("older")
    (folder / "old.json").chmod(0o604)
    fill_and_put(files, new_blend=b"new", old_json=b"newer")
    assert {path.name: path.read_bytes() for path in folder.iterdir()} == {"new.blend": b"new", "old.json": b"newer"}
    assert (folder / "old.json").stat().st_mode & 0o777 == 0o604


@pytest.mark.parametrize("error", [OSError(28, "No space left"), RuntimeError("Error: Cannot open"), MemoryError()])
@pytest.mark.parametrize("which", [0, 1])
def test_if_one_cannot_be_written_none_is(files, stop, folder, error, which):
    (folder / "a.blend").write_text("older")

    def fail(path):
        writer(b"half")(path)
        writer(b"half")(f"{path}@")  # as Blender does while it writes
        raise error

    makers = [writer(b"new"), writer(b"new")]
    makers[which] = fail
    with pytest.raises((stop, MemoryError)) as raised:
        files.write_all(dict(zip(map(files.Target, ("a.blend", "b.json")), makers)), int)
    if raised.type is stop:
        assert raised.value.code == 1 and ("a.blend", "b.json")[which] in raised.value.reason
    assert {path.name: path.read_text() for path in folder.iterdir()} == {"a.blend": "older"}


def test_what_says_that_it_wrote_and_did_not_is_found_out(files, stop, folder):
    with pytest.raises(stop, match="a.blend"):
        files.write_all({files.Target("a.blend"): lambda path: None}, int)
    assert list(folder.iterdir()) == []


def test_at_the_last_chance_nothing_has_changed_yet(files, folder):
    def interrupted():
        assert not (folder / "a.blend").exists()
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        files.write_all({files.Target("a.blend"): writer(b"new")}, interrupted)
    assert list(folder.iterdir()) == []


def test_a_link_is_followed_and_stays(files, folder):
    (folder / "store").mkdir()
    (folder / "a.blend").symlink_to("store/b.blend")
    for content in (b"new", b"newer"):
        fill_and_put(files, a_blend=content)
        assert os.readlink("a.blend") == "store/b.blend" and (folder / "store" / "b.blend").read_bytes() == content


def test_devices_and_pipes_are_written_and_not_replaced(files, folder):
    master, terminal = pty.openpty()  # a device in whose folder nothing can be replaced, were it tried
    target = files.Target(os.ttyname(terminal))
    assert target.direct
    files.write_all({target: lambda path: files.save_json(path, {"a": 1})}, int)
    assert json.loads(os.read(master, 1000)) == {"a": 1}
    os.mkfifo("pipe")
    reader = os.open("pipe", os.O_RDONLY | os.O_NONBLOCK)
    files.write_all({files.Target("pipe"): lambda path: files.save_json(path, {"a": 1})}, int)
    assert json.loads(os.read(reader, 1000)) == {"a": 1} and (folder / "pipe").is_fifo()
    for descriptor in (reader, master, terminal):
        os.close(descriptor)


def test_the_file_into_which_the_process_prints_is_continued(folder):
    script = f"{LOAD_FILES}\nprint('first', flush=True)\nreport = files.Target(sys.argv[1])\n"
    script += "files.write_all({report: lambda path: files.save_json(path, {'a': 1})}, int)\nprint('last')"
    for name in ("/dev/fd/1", "log"):
        for mode in "wa":
            with open("log", mode) as log:
                subprocess.run([sys.executable, "-c", script, name], check=True, stdout=log)
        assert (folder / "log").read_text().split() == 2 * ["first", "{", '"a":', "1", "}", "last"]


@pytest.mark.parametrize(
    "name", ["", ".", "folder", "folder/", "new/", "missing/a", "loop", "file/a", "/proc/a", "n" * 256]
)
def test_what_cannot_be_written_is_refused_at_once(files, stop, folder, name):
    (folder / "folder").mkdir()
    (folder / "file").write_text("")
    (folder / "loop").symlink_to("loop")
    before = sorted(os.listdir())
    with pytest.raises(stop) as raised:
        files.Target(name)
    assert raised.value.code == 2 and sorted(os.listdir()) == before


def test_a_path_longer_than_blender_keeps_is_refused(files, stop, folder):
    deep = folder
    while len(str(deep)) < 1100:
        deep = deep / ("d" * 100)
    deep.mkdir(parents=True)
    with pytest.raises(stop, match="too long for Blender"):
        files.Target(str(deep / "a.blend"))


@pytest.mark.skipif(os.geteuid() == 0, reason="root may write everything")
def test_write_protection_is_respected(files, stop, folder):
    (folder / "a.blend").touch(mode=0o444)
    with pytest.raises(stop, match="write-protected"):
        files.Target("a.blend")
    (folder / "closed").mkdir(mode=0o555)
    with pytest.raises(stop):
        files.Target("closed/a.blend")


def test_two_slashes_are_one(files, folder):
    """Blender takes them for the folder of the .blend file that is open."""
    assert files.Target(f"/{folder}/a.blend").path == folder.resolve() / "a.blend"


def test_a_full_disk_is_an_error_and_nothing_is_left(files, stop, folder):
    (folder / "a.json").write_text("older")
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    old = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    try:
        for limit in (0, 1, 1000, 5000):
            resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limits[1]))
            with pytest.raises(stop) as raised:
                content = {"values": list(range(5000))}
                files.write_all({files.Target("a.json"): lambda path, text=content: files.save_json(path, text)}, int)
            assert raised.value.code == 1
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)
        signal.signal(signal.SIGXFSZ, old)
    assert {path.name: path.read_text() for path in folder.iterdir()} == {"a.json": "older"}


def test_json_has_no_number_that_is_none(files, folder):
    nan, infinity = float("nan"), float("inf")
    values = {"a": [1.5, nan, (infinity, -infinity)], "b": {"c": nan, "d": "ö\udcff", "e": None, "f": True}}
    files.save_json("a.json", values)
    content = json.loads((folder / "a.json").read_text(), parse_constant=pytest.fail)
    assert content == {"a": [1.5, None, [None, None]], "b": {"c": None, "d": "ö\udcff", "e": None, "f": True}}


def test_what_killed_runs_left_is_removed_when_it_is_a_day_old(files, folder):
    old, young, others = f".koebe-{'a' * 32}.blend", f".koebe-{'b' * 32}.blend", [".koebe-notes.blend", "a.blend1"]
    for name in (old, f"{old}@", young, *others):
        (folder / name).write_text("")
        if name != young:
            os.utime(name, (1e9, 1e9))
    fill_and_put(files, a_blend=b"new")
    assert sorted(os.listdir()) == sorted([young, *others, "a.blend"])


def test_killed_at_any_moment_both_are_whole_and_the_report_is_last(folder):
    script = f"""{LOAD_FILES}
import os
targets = [files.Target(name) for name in ("a.blend", "a.json")]
for number in range(100000):
    def write(path, content=b"%06d" % number * 30000):
        with open(path, "wb") as file:
            file.write(content)
    print(number, flush=True)
    files.write_all(dict.fromkeys(targets, write), int)
"""
    noise = random.Random(5)
    for _ in range(8):
        process = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE)
        for _ in range(noise.randint(2, 5)):
            process.stdout.readline()
        time.sleep(noise.uniform(0.0, 0.01))
        process.kill()
        process.communicate()
        numbers = []
        for name in ("a.blend", "a.json"):
            content = (folder / name).read_bytes()
            assert len(content) == 180000 and content == content[:6] * 30000
            numbers.append(int(content[:6]))
        assert numbers[0] - numbers[1] in (0, 1)
