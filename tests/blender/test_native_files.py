"""The native module's files: unpacked where they belong, checked before they are loaded, mended, removed."""

import importlib
import os
import shutil
import sys
import time
import zipfile
from pathlib import Path

import bpy
import processes
import pytest

LEAST_LIBRARY = 100_000  # bytes: what is larger than this is a wheel or a library
LIBRARIES = (".so", ".dll", ".pyd")  # in their names
WINDOWS = sys.platform == "win32"  # which removes no library that is loaded


class Home:
    """A copy of the installed add-on, and a user's folders around it."""

    def __init__(self, installed, folder):
        self.folder = folder
        self.addon = folder / "addon"
        shutil.copytree(installed, self.addon, ignore=shutil.ignore_patterns("__pycache__", "unpacked"))
        self.work, self.temporary = folder / "work", folder / "temporary"
        self.work.mkdir()
        self.temporary.mkdir()
        self.datafiles, self.extensions = folder / "datafiles", folder / "extensions"
        self.script = folder / "load.py"
        self.script.write_text(processes.LOAD)

    def start(self, **changes):
        folders = {"ADDON": self.addon, "TMPDIR": self.temporary, "BLENDER_USER_DATAFILES": self.datafiles,
                   "BLENDER_USER_EXTENSIONS": self.extensions}
        return processes.start(self.script, self.work, **{**folders, **changes})

    def load(self, **changes):
        """The line that a new Blender says about the module, and the module's file if it was loaded."""
        code, out, err = processes.finish(self.start(**changes))
        lines = [line for line in out.splitlines() if line.startswith(("LOADED", "REFUSED"))]
        assert code == 0 and len(lines) == 1, out + err
        return lines[0], Path(lines[0].partition(" ")[2])

    def make_own_folder_unwritable(self):
        (self.addon / "unpacked").write_text("a file is where the folder should be: not even root can make it")

    @property
    def place(self):
        """Where the wheel is unpacked: in the add-on's folder, unless nobody could remove the add-on then."""
        return self.datafiles / "koebe_uv" if WINDOWS else self.addon / "unpacked"

    @property
    def wheel(self):
        return next((self.addon / "wheels").glob("*.whl"))


@pytest.fixture
def home(addon_name, tmp_path):
    return Home(Path(importlib.import_module(addon_name).__file__).parent, tmp_path)


def libraries(folder):
    # By os.walk, which bears with folders that go away meanwhile.
    files = [Path(root) / name for root, _, names in os.walk(folder) for name in names]
    return [path for path in files if any(end in path.name for end in LIBRARIES)]


def native_library(module):
    """The largest of the libraries that belong to the module."""
    return max(libraries(module.parent.parent), key=lambda path: path.stat().st_size)


def truncate(path):
    """Cut the end off, as a full disk or a lost connection does."""
    content = path.read_bytes()
    path.write_bytes(content[: 2 * len(content) // 3])


def flip(path):
    """Damage a file without another size."""
    content = bytearray(path.read_bytes())
    content[len(content) // 2] ^= 0xFF
    path.write_bytes(content)


def large_files(folder):
    return [path for path in folder.rglob("*") if path.is_file() and path.stat().st_size > LEAST_LIBRARY]


def test_it_is_unpacked_into_its_place_and_nowhere_else(home):
    said, module = home.load()
    assert said.startswith("LOADED") and home.place in module.parents
    assert list(home.work.iterdir()) == [] and list(home.temporary.iterdir()) == []
    other = home.addon / "unpacked" if WINDOWS else home.datafiles
    assert not other.exists() or large_files(other) == []


def test_where_no_folder_can_be_made_it_is_private_and_gone_at_the_end(home):
    home.make_own_folder_unwritable()
    home.datafiles.write_text("no folder either")
    said, module = home.load()
    assert said.startswith("LOADED") and home.temporary in module.parents
    assert list(home.work.iterdir()) == [], "the current folder is not the add-on's"
    assert WINDOWS or list(home.temporary.iterdir()) == []


def test_where_the_addon_is_read_only_it_is_in_the_users_folder(home):
    home.make_own_folder_unwritable()
    said, module = home.load()
    assert said.startswith("LOADED") and home.datafiles in module.parents
    assert home.load()[1] == module


@pytest.mark.alike
@pytest.mark.parametrize(
    ("which", "damage"),
    [("library", truncate), ("library", flip), ("extension", truncate), ("python", Path.unlink)],
    ids=lambda value: getattr(value, "__name__", value),
)
def test_a_damaged_file_is_mended(home, damage, which):
    module = home.load()[1]
    whole = native_library(module) if which == "library" else module
    if which == "extension":
        whole = next(path for path in libraries(module.parent) if path.name.startswith("_koebe"))
    content = whole.read_bytes()
    damage(whole)
    assert home.load() == (f"LOADED {module}", module)
    assert whole.read_bytes() == content


@pytest.mark.alike
def test_what_was_checked_is_not_read_again_until_it_changes(home):
    module = home.load()[1]
    license = next(module.parent.parent.rglob("LICENSE"))
    content, times = license.read_bytes(), (license.stat().st_atime_ns, license.stat().st_mtime_ns)
    flip(license)
    os.utime(license, ns=times)
    home.load()
    assert license.read_bytes() != content
    license.touch()
    home.load()
    assert license.read_bytes() == content


@pytest.mark.alike
@pytest.mark.parametrize("damage", [truncate, flip], ids=lambda f: f.__name__)
def test_a_damaged_wheel_is_an_error_with_path_and_cure(home, damage):
    damage(home.wheel)
    said, _ = home.load()
    assert said.startswith("REFUSED") and str(home.wheel) in said and "install it again" in said
    assert large_files(home.addon) == [home.wheel] and list(home.temporary.iterdir()) == []


@pytest.mark.alike
def test_a_damaged_library_without_a_wheel_to_mend_it_is_an_error_and_no_crash(home):
    module = home.load()[1]
    truncate(home.wheel)
    truncate(native_library(module))
    # The folder's name tells the wheel's size: as if that were damaged without another size.
    module.parent.parent.rename(module.parent.parent.with_name(f"{home.wheel.stem}-{home.wheel.stat().st_size}"))
    said, _ = home.load()
    assert said.startswith("REFUSED") and str(home.wheel) in said and "install it again" in said


@pytest.mark.alike
def test_a_damaged_wheel_does_not_matter_where_what_it_held_is_whole(home):
    module = home.load()[1]
    content = home.wheel.read_bytes()
    home.wheel.write_bytes(bytes(len(content)))
    assert home.load() == (f"LOADED {module}", module)


@pytest.mark.alike
def test_many_blenders_may_start_at_the_same_time(home):
    started = [home.start() for _ in range(4)]
    ended = [processes.finish(process) for process in started]
    assert all("LOADED" in out and code == 0 for code, out, _ in ended), ended
    (folder,) = (path for path in home.place.iterdir() if path.is_dir())
    assert folder.name.startswith("koebe-")


@pytest.mark.alike
def test_many_blenders_may_mend_at_the_same_time(home):
    module = home.load()[1]
    whole = native_library(module).read_bytes()
    truncate(native_library(module))
    ended = [processes.finish(process) for process in [home.start() for _ in range(4)]]
    assert all("LOADED" in out and code == 0 for code, out, _ in ended), ended
    assert native_library(module).read_bytes() == whole


@pytest.mark.alike
def test_killed_at_any_moment_it_is_whole_the_next_time(home):
    unpacked = home.place
    whole = sum(any(end in name for end in LIBRARIES) for name in zipfile.ZipFile(home.wheel).namelist())
    for files in (0, whole - 2):  # killed after so many files
        process = home.start()
        while process.poll() is None and len(libraries(unpacked)) <= files:
            time.sleep(0.001)
        process.kill()
        process.communicate()
        assert [path for path in unpacked.glob("koebe-*") if len(libraries(path)) < whole] == []
        shutil.rmtree(next(unpacked.glob("koebe-*"), unpacked / "none"), ignore_errors=True)
    for abandoned in unpacked.iterdir():
        os.utime(abandoned, (1e9, 1e9))
    module = home.load()[1]
    assert sorted(path.name for path in unpacked.iterdir()) == sorted(["checked.json", module.parent.parent.name])


@pytest.mark.alike
def test_other_versions_for_this_python_are_removed_and_those_for_others_stay(home):
    old_place = home.datafiles / "koebe_uv"
    tags = home.wheel.stem.split("-", 2)[2]
    mine = [home.place / f"koebe-0.0.9-{tags}-123", old_place / f"koebe-0.0.9-{tags}-124"]
    if home.place != old_place:
        mine.append(old_place / f"{home.wheel.stem}-{home.wheel.stat().st_size}")
    others = [old_place / "koebe-0.0.9-cp39-cp39-linux_x86_64-123", old_place / "presets"]
    for folder in mine + others:
        folder.mkdir(parents=True)
    assert home.load()[0].startswith("LOADED")
    assert not any(folder.exists() for folder in mine) and all(folder.is_dir() for folder in others)


@pytest.mark.alike
def test_a_package_of_that_name_from_elsewhere_is_not_taken(home):
    elsewhere = home.folder / "elsewhere"
    (elsewhere / "koebe").mkdir(parents=True)
    (elsewhere / "koebe" / "__init__.py").write_text("raise RuntimeError('not me')")
    script = home.script.read_text()
    home.script.write_text(f"import sys\nsys.path.insert(0, {str(elsewhere)!r})\n{script}")
    said, module = home.load()
    assert said.startswith("LOADED") and home.place in module.parents


@pytest.mark.alike
def test_another_version_in_the_same_session_is_an_error(home):
    script = home.script.read_text()
    loaded = "import sys, types\nkoebe = sys.modules['koebe'] = types.ModuleType('koebe')\n"
    home.script.write_text(f"{loaded}koebe.__file__, koebe.__version__ = 'there', '0'\n{script}")
    said, _ = home.load()
    assert said.startswith("REFUSED") and "restart Blender" in said


@pytest.mark.skipif(bpy.app.version < (4, 2, 0), reason="before 4.2 Blender installs no wheels")
@pytest.mark.parametrize("damage", [truncate, flip], ids=lambda f: f.__name__)
def test_what_blender_installed_is_checked_and_mended(home, damage):
    """As Blender lays a wheel out: all of it in the folder for all extensions' packages."""
    module = home.load()[1]
    version = f"python{os.sys.version_info.major}.{os.sys.version_info.minor}"
    site = home.extensions / ".local" / "lib" / version / "site-packages"
    shutil.copytree(module.parent.parent, site)
    shutil.rmtree(home.place)
    library = native_library(site / "koebe" / "__init__.py")
    content = library.read_bytes()
    damage(library)
    assert home.load()[1] == site / "koebe" / "__init__.py"
    assert library.read_bytes() == content
    assert large_files(home.addon) == [home.wheel]
