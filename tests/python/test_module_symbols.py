"""What the Python module takes of the library, and what it shows of itself: read from what the linker reads."""

import re
import subprocess
import sys
from pathlib import Path

import koebe
import pytest

BUILD = Path(__file__).resolve().parents[2] / "build"
LIBRARY = BUILD / "native" / "libkoebe.a"
OBJECTS = sorted((BUILD / "native" / "python" / "CMakeFiles" / "_koebe.dir").rglob("*.o"))
pytestmark = pytest.mark.skipif(sys.platform != "linux" or not OBJECTS, reason="reads what `make build` has compiled")


def symbols(*command):
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()


def test_the_module_calls_nothing_that_a_release_hides():
    called = {line.split()[0] for path in OBJECTS
              for line in symbols("nm", "--undefined-only", "--no-weak", "--format=posix", path)}  # fmt: skip
    table = (re.fullmatch(r"\s*\d+: \S+ +\d+ \w+ +GLOBAL (\w+) +\d+ (\S+)", line)
             for line in symbols("readelf", "--symbols", "--wide", LIBRARY))  # fmt: skip
    visibility = {found[2]: found[1] for found in table if found}
    taken = called & set(visibility)
    assert len(taken) > 50
    hidden = {name for name in taken if visibility[name] == "HIDDEN"}
    assert not hidden, "without KOEBE_API, `make dist` would not link: " + "; ".join(symbols("c++filt", *hidden))


def test_the_module_shows_nothing_that_another_library_could_take_for_its_own():
    shown = {line.split()[0] for line in symbols("nm", "--dynamic", "--defined-only", "--extern-only", "--format=posix",
                                                 koebe._koebe.__file__)}  # fmt: skip
    assert {name for name in shown if not name.startswith("_Z")} == {"PyInit__koebe"}
    assert not [name for name in symbols("c++filt", *sorted(shown)) if name.startswith("koebe::")]
