"""Fixtures of several files of tests."""

import pytest
from addon_support import addon_module


@pytest.fixture(scope="session")
def addon():
    """A function that imports a module of the add-on that needs no bpy."""
    return addon_module
