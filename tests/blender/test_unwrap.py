"""The main button: each shape is that of its own operator, and Automatic takes the one that serves."""

import re

import bpy
import numpy as np
import pytest
import scenes
from test_even import add_tube
from test_tube import SAMPLES
from tori import torus_arrays

MODELS = {
    "DISK": ("uniformize", scenes.add_panel),
    "PARTS": ("parts", lambda: add_bump(0.8)),
    "RING": ("ring", add_tube),
    "TORUS": ("torus", lambda: scenes.add_object("Torus", *torus_arrays(16, 12))),
    "SPHERE": ("sphere", scenes.add_panel),
    "HANDLES": ("schottky", lambda: scenes.add_object("Torus", *torus_arrays(16, 12))),
}


def add_bump(height):
    """A panel with three holes and a bump in its middle: the higher it is, the less even its disk."""
    return scenes.add_panel(size=20, height=lambda x, y: 3.0 * height * np.exp(-4.0 * (x * x + y * y)))


@pytest.mark.parametrize("shape", MODELS)
def test_each_shape_is_that_of_its_own_operator(shape):
    of, make = MODELS[shape]
    obj = make()
    scenes.select(obj)
    assert getattr(bpy.ops.uv, f"koebe_{of}")(layer="Own") == {"FINISHED"}
    assert bpy.ops.uv.koebe_unwrap(shape=shape) == {"FINISHED"}
    assert np.array_equal(scenes.corner_uv(obj.data, "Koebe"), scenes.corner_uv(obj.data, "Own"))
    assert not scenes.last_run().note.startswith("Automatic")


@pytest.mark.parametrize("options", [{"shape": "DISK", "outer": "longest", "margin": 0.1},
                                     {"shape": "PARTS", "evenness": 1.0, "write_seams": True},
                                     {"shape": "RING", "fit": "square", "holes": "radial"}], ids=str)  # fmt: skip
def test_the_options_of_a_shape_reach_its_map(options):
    of, make = MODELS[options["shape"]]
    obj = make()
    scenes.select(obj)
    own = {name: value for name, value in options.items() if name not in ("shape", "write_seams")}  # seams are cuts
    getattr(bpy.ops.uv, f"koebe_{of}")(layer="Own", **own)
    bpy.ops.uv.koebe_unwrap(**options)
    assert np.array_equal(scenes.corner_uv(obj.data, "Koebe"), scenes.corner_uv(obj.data, "Own"))
    assert any(edge.use_seam for edge in obj.data.edges) == options.get("write_seams", False)


SAMPLE_SHAPES = [
    ("face_five_holes", "Disk"), ("bowl", "Parts"), ("perforated_panel", "Disk"), ("closed_head", "Parts"),
    ("character", "Parts"), ("mug", "Parts"), ("hand", "Parts"), ("suzanne_mask", "Parts"),
]  # fmt: skip
REASONS = {"bowl": "there is no hole to make round", "closed_head": "the surface is closed",
           "character": "the surface is closed",
           "mug": "the surface has a handle", "hand": "the texels of a disk are uneven, 1 : more than 1,000",
           "suzanne_mask": "uneven, 1 : 5.9"}  # fmt: skip


@pytest.mark.alike
@pytest.mark.parametrize("sample, shape", SAMPLE_SHAPES)
def test_automatic_takes_the_shape_that_serves_and_says_why(sample, shape, addon):
    bpy.ops.wm.open_mainfile(filepath=str(SAMPLES / f"{sample}.blend"))
    obj = next(obj for obj in bpy.data.objects if obj.type == "MESH")
    scenes.select(obj)
    assert bpy.ops.uv.koebe_unwrap() == {"FINISHED"}
    entry = scenes.last_run()
    assert entry.mapped and entry.flipped == 0 and (entry.parts > 0) == (shape == "Parts")
    assert entry.note.startswith(f"Automatic took {shape}: ")
    assert re.search(REASONS.get(sample, "its texels are even, 1 : [1-3]"), entry.note)
    figures = addon("maps.verdicts").figures(entry)
    assert [one for one in figures if one.name != "Coverage" and one.advice] == []
    if shape == "Parts":  # few faces must not take the square from the others
        uv = scenes.polygon_areas(obj)
        density = uv / [face.area for face in obj.data.polygons]
        assert uv[density > 9.0 * np.median(density)].sum() < 0.05 * uv.sum()


@pytest.mark.alike
def test_automatic_has_no_fault_that_parts_have_not(addon):
    """On both sides of the report's limit."""
    verdicts, chosen = addon("maps.verdicts"), set()

    def faults(shape):
        bpy.ops.uv.koebe_unwrap(shape=shape, checker=False)
        return {one.name for one in verdicts.figures(scenes.last_run(), 1.0) if one.advice}

    for height in (0.2, 0.25, 0.3, 0.8):
        scenes.select(add_bump(height))
        assert faults("AUTO") <= faults("PARTS")
        bpy.ops.uv.koebe_unwrap(checker=False)
        chosen.add(scenes.last_run().parts > 0)
    assert chosen == {True, False}


@pytest.mark.alike
def test_of_two_maps_the_one_with_lesser_faults_is_better(addon):
    worth = addon("maps.automatic").Worth
    ordered = [worth(True, 0, 1.0, 1.0), worth(True, 0, 4.0, 5.0), worth(True, 0, 1.0, 5.1), worth(True, 0, 1.0, 9.0),
               worth(True, 0, 4.1, 1.0), worth(True, 0, 9.0, 1.0), worth(True, 0, 4.1, 5.1), worth(True, 1, 1.0, 1.0),
               worth(False, 0, 30.0, 1.0)]  # fmt: skip
    assert sorted(ordered, key=lambda one: one.order) == ordered
    assert [one.fault == "" for one in ordered] == [True] * 2 + [False] * 7


def test_automatic_chooses_for_each_object_and_for_what_is_selected():
    panel, cube = scenes.add_panel(), scenes.add_cube()
    scenes.select(panel, cube)
    assert bpy.ops.uv.koebe_unwrap() == {"FINISHED"}
    parts = {entry.object_name: entry.parts for entry in bpy.context.window_manager.koebe_uv.islands}
    assert parts["Panel"] == 0 and parts["Cube"] > 0
    scenes.select(cube)
    scenes.select_faces(cube, [1])
    assert bpy.ops.uv.koebe_unwrap() == {"FINISHED"}
    assert scenes.last_run().parts == 1 and "no hole to make round" in scenes.last_run().note


def test_automatic_lays_sheets_flat_as_they_are():
    """A plane of 10:1 stays one, also with many faces, and a waved sheet is a rectangle."""
    n, m = 20, 4
    x, y = np.meshgrid(np.linspace(0, 10, n + 1), np.linspace(0, 1, m + 1), indexing="ij")
    at = np.arange((n + 1) * (m + 1)).reshape(n + 1, m + 1)
    quads = np.stack([at[:-1, :-1], at[1:, :-1], at[1:, 1:], at[:-1, 1:]], -1).reshape(-1, 4)
    for height, ratio in ((0.0, 10.0), (0.05, None)):
        points = np.stack([x, y, height * np.sin(2 * x) * np.cos(3 * y)], -1).reshape(-1, 3)
        obj = scenes.add_object("Sheet", points, quads)
        scenes.select(obj)
        assert bpy.ops.uv.koebe_unwrap() == {"FINISHED"}
        uv = scenes.corner_uv(obj.data, "Koebe").reshape(-1, 4, 2).astype(float)
        along = np.abs(np.roll(uv, -1, axis=1) - uv)
        rim = along[np.isin(np.arange(len(uv)), np.arange(m) + 0)][:, 3]  # the first column of faces: their outer sides
        assert scenes.last_run().parts == 1 and (rim.min(axis=1) < 1e-5).all()
        size = np.ptp(uv.reshape(-1, 2), axis=0)
        assert size.max() > 0.99 and (ratio is None or abs(size.max() / size.min() / ratio - 1) < 1e-4)


@pytest.mark.alike
def test_an_even_disk_serves_where_a_conformal_one_does_not():
    scenes.select(add_bump(0.3))
    bpy.ops.uv.koebe_unwrap()
    assert scenes.last_run().parts > 0
    bpy.ops.uv.koebe_unwrap(keep_angles=False, even=0.1)
    assert scenes.last_run().parts == 0 and np.isclose(scenes.last_run().even, 0.1)


@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
def test_it_is_one_undo_step(mode):
    import states

    states.new_file()
    scenes.select(scenes.add_panel())
    scenes.edit_all(mode)
    bpy.ops.ed.undo_push(message="made")
    bpy.ops.uv.koebe_unwrap()
    bpy.ops.ed.undo_push(message="unwrapped")
    assert len(bpy.data.objects["Panel"].data.uv_layers) == 1
    bpy.ops.ed.undo()
    assert len(bpy.data.objects["Panel"].data.uv_layers) == 0


def test_the_redo_panel_has_eight_rows_at_most(addon):
    unwrap = addon("operators.unwrap")
    names = {prop.identifier for prop in bpy.ops.uv.koebe_unwrap.get_rna_type().properties}
    assert {*unwrap.ROWS} == {*unwrap.MAPS, "AUTO"}
    for shape, rows in unwrap.ROWS.items():
        assert len(rows) < 8 and {*rows} < names, shape


@pytest.mark.alike
def test_the_redo_panel_is_short_and_its_labels_have_room(addon):
    """At most eight rows; beside a field there is room for fourteen letters in every version, for checkboxes more."""
    unwrap, run = (addon(f"operators.{name}") for name in ("unwrap", "run_operator"))
    for shape, rows in unwrap.ROWS.items():
        assert len(("shape", *rows)) <= 8, shape
        for name in rows:
            label = run.ROWS[name].blender["label"]
            assert len(label) <= (20 if run.ROWS[name].kind == "flag" or name in run.SLIDERS else 14), label
    for shape in ("AUTO", "PARTS"):
        assert {"evenness", "margin"} < set(unwrap.ROWS[shape])
    assert "cut_hard" in unwrap.ROWS["PARTS"]
