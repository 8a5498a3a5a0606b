"""The asset library of node groups, in the preferences."""

from pathlib import Path

import bpy
import pytest


def ours():
    return [one for one in bpy.context.preferences.filepaths.asset_libraries if one.name == "Koebe UV"]


@pytest.fixture
def without_library():
    yield
    if bpy.ops.node.koebe_remove_library.poll():
        bpy.ops.node.koebe_remove_library()
    assert not ours()


def test_the_groups_are_in_a_library_and_not_in_this_file(without_library):
    before = len(bpy.context.preferences.filepaths.asset_libraries)
    for _ in range(2):
        assert bpy.ops.node.koebe_add_library() == {"FINISHED"}
    (library,) = ours()
    assert len(bpy.context.preferences.filepaths.asset_libraries) == before + 1
    assert not bpy.data.node_groups
    (path,) = Path(library.path).iterdir()
    with bpy.data.libraries.load(str(path), assets_only=True) as (inside, chosen):
        names = set(inside.node_groups)
        chosen.node_groups = ["Koebe Scatter"]
    assert names == {"Koebe Bend onto Surface", "Koebe Scatter", "Koebe Move Circles", "Koebe Moebius",
                     "Koebe UV by Attribute"}
    assert "Koebe Scatter" in bpy.data.node_groups
    assert bpy.ops.node.koebe_remove_library() == {"FINISHED"}
    assert not ours() and not path.exists() and not bpy.ops.node.koebe_remove_library.poll()
    assert len(bpy.context.preferences.filepaths.asset_libraries) == before


def test_groups_of_this_file_stay(without_library):
    bpy.ops.node.koebe_add_groups()
    names = set(bpy.data.node_groups.keys())
    assert bpy.ops.node.koebe_add_library() == {"FINISHED"}
    assert set(bpy.data.node_groups.keys()) == names
    assert bpy.ops.node.koebe_remove_library() == {"FINISHED"}
    assert set(bpy.data.node_groups.keys()) == names


def test_a_folder_that_cannot_be_written_changes_nothing(without_library, addon, monkeypatch, tmp_path):
    blocked = tmp_path / "file"
    blocked.write_text("")
    monkeypatch.setattr(addon("operators.node_groups"), "_library_folder", lambda: blocked / "assets")
    with pytest.raises(RuntimeError, match="could not be written"):
        bpy.ops.node.koebe_add_library()
    assert not ours() and not bpy.data.node_groups
