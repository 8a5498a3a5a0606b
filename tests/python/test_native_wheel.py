"""The wheel's files after any damage: whole again, or an error that names the file. Without Blender."""

import base64
import hashlib
import importlib.util
import random
import shutil
import threading
import zipfile
from pathlib import Path

import pytest

SOURCE = Path(__file__).resolve().parents[2] / "addon" / "solver" / "wheel.py"
NAME = "koebe-1.2.3-cp311-cp311-linux_x86_64"
INFO = "koebe-1.2.3.dist-info"


@pytest.fixture(scope="module")
def native_wheel():
    spec = importlib.util.spec_from_file_location("native_wheel", SOURCE)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture
def files():
    """What the wheel holds: sources, libraries that pack well and badly, a name that a RECORD has to quote."""
    noise = random.Random(1)
    return {
        "koebe/__init__.py": b"from ._koebe import *\n" * 40,
        "koebe/_koebe.cpython-311-x86_64-linux-gnu.so": noise.randbytes(20000),
        "koebe/libOpenMeshCore.so.9.0": b"\0" * 30000 + noise.randbytes(500),
        f"{INFO}/licenses/a, b.txt": b"text",
        f"{INFO}/WHEEL": b"Wheel-Version: 1.0\n",
    }


@pytest.fixture
def wheel(native_wheel, files, tmp_path):
    path = tmp_path / f"{NAME}.whl"
    rows = []
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            archive.writestr(name, content)
            digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).decode().rstrip("=")
            quoted = f'"{name}"' if "," in name else name
            rows.append(f"{quoted},sha256={digest},{len(content)}\n")
        archive.writestr(f"{INFO}/RECORD", "".join(rows) + f"{INFO}/RECORD,,\n")
    return native_wheel.Wheel(path)


def content_of(folder):
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def damage(path, noise):
    """Change some bytes, cut the end off, append, empty, or remove."""
    content = bytearray(path.read_bytes())
    kind = noise.randrange(5)
    if kind == 0:
        for _ in range(noise.randint(1, 20)):
            content[noise.randrange(len(content))] = noise.randrange(256)
    elif kind == 1:
        del content[noise.randrange(len(content)):]
    elif kind == 2:
        content += noise.randbytes(noise.randint(1, 100))
    elif kind == 3:
        content.clear()
    if kind == 4:
        path.unlink()
    else:
        path.write_bytes(content)


def assert_whole(folder, files):
    found = content_of(folder)
    assert {name: found.get(name) for name in files} == files


@pytest.mark.parametrize("seed", range(200))
def test_damaged_files_are_mended_from_the_wheel(wheel, files, tmp_path, seed):
    noise = random.Random(seed)
    folder, known = tmp_path / "place" / wheel.folder_name, tmp_path / "place" / "checked.json"
    assert wheel.ready_in(folder, known) is True
    assert_whole(folder, files)
    for name in noise.sample(sorted([*files, f"{INFO}/RECORD"]), noise.randint(1, 5)):
        damage(folder / name, noise)
    if noise.random() < 0.3:
        damage(known, noise)
    assert wheel.ready_in(folder, known) is False
    assert_whole(folder, files)


@pytest.mark.parametrize("seed", range(300))
def test_with_a_damaged_wheel_too_it_is_whole_or_an_error(native_wheel, wheel, files, tmp_path, seed):
    noise = random.Random(seed)
    folder, known = tmp_path / "place" / wheel.folder_name, tmp_path / "place" / "checked.json"
    if noise.random() < 0.7:
        wheel.ready_in(folder, known)
        if noise.random() < 0.5:
            damage(folder / noise.choice(sorted(files)), noise)
    damage(wheel.path, noise)
    try:
        wheel.ready_in(folder, known)
    except native_wheel.WheelError as error:
        assert str(wheel.path) in str(error) and "install it again" in str(error)
        assert list((tmp_path / "place").glob(".unpacking-*")) == []
    else:
        assert_whole(folder, files)


def test_a_folder_that_cannot_be_written_is_an_oserror(wheel, tmp_path):
    (tmp_path / "place").write_text("a file")
    with pytest.raises(OSError):
        wheel.ready_in(tmp_path / "place" / wheel.folder_name, tmp_path / "checked.json")


def test_threads_unpack_and_mend_at_the_same_time(wheel, files, tmp_path):
    folder, known = tmp_path / "place" / wheel.folder_name, tmp_path / "place" / "checked.json"
    for round_ in range(20):
        if round_ % 2:
            damage(folder / "koebe/libOpenMeshCore.so.9.0", random.Random(round_))
        else:
            shutil.rmtree(folder, ignore_errors=True)
        problems = []

        def ready(problems=problems):
            try:
                wheel.ready_in(folder, known)
                assert_whole(folder, files)
            except BaseException as error:
                problems.append(error)

        threads = [threading.Thread(target=ready) for _ in range(6)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        assert problems == []
    assert sorted(path.name for path in folder.parent.iterdir()) == ["checked.json", folder.name]
