"""Fixtures for tests that run inside Blender, or under a Python with bpy, on the installed add-on.

The runner installs and enables the zip and names the add-on's module in KOEBE_UV_MODULE.
"""

import importlib
import os
import sys

import bpy
import pytest

pytest.register_assert_rewrite("scenes", "faults", "states", "wild")

if sys.platform == "win32":  # which has no such signals, terminals and limits
    collect_ignore = ["test_batch_ends.py", "test_batch_files.py"]


@pytest.fixture(scope="session")
def addon_name():
    """Name of the installed add-on's package."""
    return os.environ["KOEBE_UV_MODULE"]


@pytest.fixture(scope="session")
def addon(addon_name):
    """A function that imports one of the installed add-on's modules, by its room and name."""
    return lambda module: importlib.import_module(f"{addon_name}.{module}")


@pytest.fixture(scope="session")
def folder(addon_name):
    """The folder of the installed add-on."""
    return os.path.dirname(importlib.import_module(addon_name).__file__)


@pytest.fixture(scope="session")
def koebe(addon):
    """The native package, as the installed add-on finds it."""
    return addon("jobs.native_package").load()


@pytest.fixture(autouse=True)
def empty_scene():
    """Every test starts in Object Mode with nothing in the file; preferences and add-ons stay."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=False)
