"""Loops Around Holes: edges along circles around the holes of a map."""

import bpy
import numpy as np
import pytest
import scenes


def rings(**options):
    return bpy.ops.mesh.koebe_loops_around_holes(**options)


def chosen(obj):
    """Vertices (e, 2) of the selected edges."""
    bpy.ops.object.mode_set(mode="OBJECT")
    ends = scenes.read(obj.data.edges, "vertices", np.int32, 2)
    return ends[scenes.read(obj.data.edges, "select", bool)]


def annulus(rows=12, around=40, inner=0.25):
    """A round annulus, whose own places are its map. Rows are circles whose radii grow by a ratio."""
    ratio = inner ** (-1.0 / rows)
    turn = 2 * np.pi * np.arange(around) / around
    radius = inner * ratio ** np.arange(rows + 1)
    vertices = [(r * np.cos(a), r * np.sin(a), 0.0) for r in radius for a in turn]
    at = lambda i, j: i * around + j % around  # noqa: E731
    faces = [(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)) for i in range(rows) for j in range(around)]
    return scenes.add_object("Annulus", vertices, faces), ratio


def test_loops_of_a_round_annulus_are_its_rows():
    obj, ratio = annulus()
    scenes.select(obj)
    bpy.ops.uv.koebe_uniformize(tube="annulus", checker=False)
    assert rings(rings=3, ratio=ratio**2) == {"FINISHED"}
    assert bpy.context.mode == "EDIT_MESH"
    ends = chosen(obj)
    assert len(ends) == 3 * 40
    row = ends // 40
    assert (row[:, 0] == row[:, 1]).all() and set(row[:, 0].tolist()) == {2, 4, 6}


def test_loops_are_closed_and_go_around_the_hole_asked_for():
    obj = scenes.add_panel()
    bpy.ops.uv.koebe_uniformize(checker=False)
    counts = []
    for hole in (0, 1, 2, 3):
        assert rings(hole=hole, rings=1, ratio=1.3) == {"FINISHED"}
        ends = chosen(obj)
        uses = np.bincount(ends.ravel(), minlength=len(obj.data.vertices))
        boundary = np.zeros(len(uses), bool)
        boundary[np.concatenate(scenes.boundary_loops(obj.data))] = True
        assert hole == 0 or (uses[~boundary] % 2 == 0).all()  # they end nowhere inside
        counts.append(len(ends))
    assert counts[0] > max(counts[1:]) and min(counts) > 10


def test_what_cannot_be_done_is_said(koebe):
    obj = scenes.add_panel()
    with pytest.raises(RuntimeError, match="it has no UVs: map it first"):
        rings()
    bpy.ops.uv.koebe_uniformize(checker=False)
    with pytest.raises(RuntimeError, match="there is no such hole"):
        rings(hole=9)
    assert bpy.context.mode == "OBJECT" and obj.select_get()


def test_undo_brings_the_selection_back():
    obj = scenes.add_panel()
    bpy.ops.uv.koebe_uniformize(checker=False)
    scenes.select_faces(obj, range(5))
    bpy.ops.ed.undo_push(message="before")
    bpy.ops.mesh.koebe_loops_around_holes("EXEC_DEFAULT", True)
    bpy.ops.ed.undo()
    bpy.ops.object.mode_set(mode="OBJECT")
    assert scenes.read(bpy.data.objects["Panel"].data.polygons, "select", bool).sum() == 5
    del obj
