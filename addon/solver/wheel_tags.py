# SPDX-License-Identifier: GPL-3.0-or-later
"""Which wheel fits which interpreter: by the tags in its file name (PEP 425), and by its modules.

A release's wheel has the tags py3-none-PLATFORM and a compiled module for each supported Python. A locally built wheel
has the tags of its one Python.
"""

import importlib.machinery
import platform
import sys
from collections.abc import Iterable

# Platform tags by sys.platform and platform.machine(); Blender on Linux needs glibc, so no musllinux.
SYSTEM_PREFIXES = {"linux": ("linux_", "manylinux"), "win32": ("win_",), "darwin": ("macosx_",)}
MACHINE_SUFFIXES = {
    "x86_64": ("x86_64", "amd64", "universal2"),
    "amd64": ("x86_64", "amd64", "universal2"),
    "aarch64": ("aarch64", "arm64"),
    "arm64": ("aarch64", "arm64", "universal2"),
}

MODULE = "koebe/_koebe"  # path of a wheel's compiled modules, without their suffixes


def interpreter_tag() -> str:
    """The tag of this interpreter, "cp311" in CPython 3.11."""
    return f"cp{sys.version_info.major}{sys.version_info.minor}"


def wheel_fits(file_name: str) -> bool:
    """Whether this interpreter on this machine can load the wheel."""
    parts = file_name.removesuffix(".whl").split("-")
    if not file_name.endswith(".whl") or len(parts) < 5:
        return False
    python, abi, systems = parts[-3:]
    tag = interpreter_tag()
    of_python = python == "py3" and abi == "none" or tag in python.split(".") and abi in (tag, "abi3")
    return of_python and any(_serves(system) for system in systems.split("."))


def module_suffixes(members: Iterable[str]) -> list[str]:
    """The suffixes of the compiled modules among a wheel's files: ".cpython-311-x86_64-linux-gnu.so"."""
    return sorted(name.removeprefix(MODULE) for name in members if name.startswith(MODULE) and name.count("/") == 1)


def module_loads(suffixes: Iterable[str]) -> bool:
    """Whether this interpreter can import a module with one of the suffixes."""
    return not set(suffixes).isdisjoint(importlib.machinery.EXTENSION_SUFFIXES)


def _serves(system: str) -> bool:
    machine = platform.machine().lower()
    return system.startswith(SYSTEM_PREFIXES.get(sys.platform, ())) and system.endswith(
        MACHINE_SUFFIXES.get(machine, (machine,))
    )
