"""An operator that is broken off at any step leaves everything as it was; an object's own failure leaves that object.

All steps instead of a choice: KOEBE_EVERY_STEP=1 in the environment.
"""

import os

import bpy
import faults
import pytest
import scenes
import states

MOST = 50  # steps at which an operator is broken off
RUNS = {
    "uniformize": (states.many, "uv.koebe_uniformize", {}),
    "uniformize what is worn": (states.worn, "uv.koebe_uniformize", {"checker_size": 5.0, "checker_even": False}),
    "uniformize in Edit Mode": (states.edited, "uv.koebe_uniformize", {}),
    "uniformize in Edit Mode, in sight": (states.edited_in_sight, "uv.koebe_uniformize", {"layer": "First"}),
    "uniformize in Edit Mode what is worn": (states.edited_worn, "uv.koebe_uniformize", {"checker": False}),
    "checker on": (states.many, "uv.koebe_checker", {}),
    "checker off": (states.worn, "uv.koebe_checker", {}),
    "checker off in Edit Mode": (states.edited_worn, "uv.koebe_checker", {}),
    "distortion on": (states.many, "uv.koebe_distortion", {"layer": "Koebe"}),
    "distortion changed": (states.worn, "uv.koebe_distortion", {"kind": "angle"}),
    "distortion off": (states.worn, "uv.koebe_distortion", {"kind": "none"}),
    "distortion changed in Edit Mode": (states.edited_worn, "uv.koebe_distortion", {"kind": "angle"}),
    "distortion off in Edit Mode": (states.edited_worn, "uv.koebe_distortion", {"kind": "none"}),
    "fill": (states.many, "mesh.koebe_fill_holes", {"which": "all"}),
    "fill in Edit Mode": (states.edited, "mesh.koebe_fill_holes", {}),
    "reset": (states.many, "uv.koebe_reset", {}),
}


def carried():
    """A mapped and painted source that wears the checker, and targets in several states."""
    states.new_file()
    source = states.dressed("Source")
    bpy.ops.uv.koebe_uniformize(outer="longest")
    targets = [states.plain(), states.keyed(), states.layered(), states.full()]
    scenes.select(targets[0])
    bpy.ops.uv.koebe_uniformize()
    states.consistent([source, *targets])
    scenes.select(source, *targets)


def reported():
    """A report, and another object in Edit Mode."""
    states.new_file()
    obj = states.keyed()
    bpy.ops.uv.koebe_uniformize()
    other, hidden = states.plain("Other"), states.plain("Hidden")
    states.consistent([obj, other, hidden])
    scenes.select(other, hidden)
    bpy.ops.object.mode_set(mode="EDIT")
    hidden.hide_set(True)


RUNS["carry"] = (carried, "uv.koebe_carry_texture", {"fit_holes": True})
RUNS["compare"] = (carried, "uv.koebe_compare_shapes", {})
RUNS["select a loop"] = (reported, "uv.koebe_select_loop", {"loop": 2})


def operator(name):
    """The operator of that name."""
    space, function = name.split(".")
    return getattr(getattr(bpy.ops, space), function)


@pytest.fixture
def folder(addon):
    """The folder of the installed add-on."""
    return os.path.dirname(addon("transaction").__file__)


@pytest.mark.parametrize("run", RUNS)
def test_what_is_broken_off_leaves_everything_as_it_was(folder, run):
    build, name, options = RUNS[run]
    faults.check_all_comes_back(folder, build, operator(name), options, MOST)


@pytest.mark.parametrize("run", ["uniformize", "checker off", "distortion changed", "fill", "carry"])
def test_an_error_is_that_of_one_object(folder, run):
    build, name, options = RUNS[run]
    faults.check_each_for_itself(folder, build, operator(name), options, MOST // 4)
