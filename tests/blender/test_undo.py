"""Undo brings back the file as it was before each operator, and redo as it was after it, however often.

The reports are the window manager's, which no undo changes. So is the 3D Views' shading.
More often: KOEBE_UNDO_TIMES=30 in the environment.
"""

import os

import bpy
import fingerprint
import pytest
import scenes
import states
from runs import RUNS, operator

TIMES = int(os.environ.get("KOEBE_UNDO_TIMES", "3"))
NOT_UNDONE = ("file: report", "file: shapes")
NO_STEP = ("compare",)  # changes nothing, and leaves no undo step
# Everything in one row: an operator's name, its options, and whether in Edit Mode.
ROW = [
    ("uv.koebe_uniformize", {"checker_size": 9.0}, False), ("uv.koebe_distortion", {"kind": "area"}, False),
    ("uv.koebe_checker", {}, False), ("uv.koebe_uniformize", {"tube": "unroll", "layer": "First"}, True),
    ("uv.koebe_select_loop", {"loop": 1}, True), ("uv.koebe_checker", {}, True),
    ("uv.koebe_distortion", {"kind": "angle"}, True), ("mesh.koebe_fill_holes", {"which": "holes"}, True),
    ("uv.koebe_distortion", {"kind": "none"}, False), ("uv.koebe_checker", {}, False),
    ("uv.koebe_reset", {}, False), ("uv.koebe_uniformize", {"placement": "keep"}, False),
]  # fmt: skip


def seen():
    """The file as an undo can bring it back."""
    return {name: value for name, value in fingerprint.fingerprint().items() if not of_the_window(name)}


def of_the_window(name):
    """Whether that belongs to the window: reports, and what the screens show."""
    if name.endswith(" select mode") and name.startswith("file: ") and bpy.context.mode == "OBJECT":
        return True  # only Edit Mode shows it, and Blender's undo leaves it there
    return name in NOT_UNDONE or name.startswith("file: ") and name.endswith((" shading", " custom"))


def with_step(name, options):
    """Call an operator as the interface does: with an undo step."""
    assert operator(name)("EXEC_DEFAULT", True, **options) == {"FINISHED"}


@pytest.mark.parametrize("run", [name for name in RUNS if name not in NO_STEP])
def test_undo_and_redo(run):
    build, name, options = RUNS[run]
    build()
    bpy.ops.ed.undo_push(message="before")
    before = seen()
    with_step(name, options)
    after = seen()
    assert fingerprint.differences(before, after) != []
    for _ in range(TIMES):
        bpy.ops.ed.undo()
        assert ", ".join(fingerprint.differences(before, seen())) == ""
        bpy.ops.ed.redo()
        assert ", ".join(fingerprint.differences(after, seen())) == ""
    bpy.ops.ed.undo()
    with_step(name, options)
    assert fingerprint.differences(after, seen()) == []


@pytest.mark.parametrize("name, options", [
    ("uv.koebe_uniformize", {"checker": False, "upright": False}), ("uv.koebe_moebius", {"rim": 1}),
    ("uv.koebe_parts", {"checker": False}), ("uv.koebe_parts", {"checker": False, "write_seams": True}),
    ("uv.koebe_ring", {"checker": False}), ("uv.koebe_sphere", {"checker": False}),
])  # fmt: skip
def test_a_layer_that_is_written_again_comes_back_unseen(name, options):
    """Nothing reads the UVs between the undo step and the operator: that would part what they share."""
    states.new_file()
    obj = scenes.add_panel()
    bpy.ops.uv.koebe_uniformize(checker=False)
    before = scenes.corner_uv(obj.data, "Koebe").copy()
    bpy.ops.ed.undo_push(message="mapped")
    with_step(name, options)
    bpy.ops.ed.undo()
    after = scenes.corner_uv(bpy.data.objects["Panel"].data, "Koebe").copy()
    assert (after == before).all()
    bpy.ops.ed.redo()
    assert (scenes.corner_uv(bpy.data.objects["Panel"].data, "Koebe") != before).any()


def test_what_an_error_has_selected_can_be_undone():
    states.new_file()
    bad = states.broken()
    states.consistent([bad])
    scenes.select(bad)
    scenes.edit_all()
    bpy.ops.ed.undo_push(message="before")
    before = seen()
    with pytest.raises(RuntimeError, match="NaN"):
        bpy.ops.uv.koebe_uniformize("EXEC_DEFAULT", True)
    after = seen()
    assert fingerprint.differences(before, after) != []
    bpy.ops.ed.undo()
    assert ", ".join(fingerprint.differences(before, seen())) == ""
    bpy.ops.ed.redo()
    assert ", ".join(fingerprint.differences(after, seen())) == ""


def test_a_row_of_operators_back_and_forth():
    states.edited_in_sight()
    bpy.ops.object.mode_set(mode="OBJECT")
    bpy.context.scene.koebe_uv.margin = 0.1
    bpy.ops.ed.undo_push(message="before")
    steps = [seen()]
    for name, options, in_edit_mode in ROW:
        if in_edit_mode != (bpy.context.mode == "EDIT_MESH"):
            bpy.ops.object.mode_set("EXEC_DEFAULT", True, mode="EDIT" if in_edit_mode else "OBJECT")
            steps.append(seen())
        with_step(name, options)
        steps.append(seen())
    for _ in range(TIMES):
        for index in reversed(range(len(steps) - 1)):
            bpy.ops.ed.undo()
            assert ", ".join(fingerprint.differences(steps[index], seen())) == "", index
        for index in range(1, len(steps)):
            bpy.ops.ed.redo()
            assert ", ".join(fingerprint.differences(steps[index], seen())) == "", index
