"""Fixtures of several files of tests."""

import pytest
from addon_support import addon_module
from batch_support import blends, library  # noqa: F401
from cli_support import obj_text, perforated


@pytest.fixture(scope="session")
def addon():
    """A function that imports a module of the add-on that needs no bpy."""
    return addon_module


@pytest.fixture
def mesh(tmp_path):
    """Folder with the perforated square in quadrilaterals as in.obj."""
    vertices, quads = perforated()
    (tmp_path / "in.obj").write_text(obj_text(vertices, quads))
    return tmp_path
