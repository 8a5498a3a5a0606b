"""What all maps to domains beside the disk do alike: what they refuse, Edit Mode, undo, Esc, cuts that are selected."""

import collections

import bpy
import fingerprint
import numpy as np
import pytest
import scenes
from balls import add_ball
from handles import add_plate
from scenes import last_run
from tori import add_torus, add_tube, block, torus_arrays

HOLES = (*block(2, 3), *block(5, 5))
MAKE = {"torus": add_torus, "ring": add_tube, "sphere": add_ball, "schottky": add_plate}


def unwrap(kind, **options):
    return getattr(bpy.ops.uv, f"koebe_{kind}")(**options)


def two_handles():
    """Two tori joined by a tube between two of their faces."""
    vertices, faces = torus_arrays(holes=((0, 0),))
    other = vertices * (-1.0, 1.0, 1.0) + (7.0, 0.0, 0.0)
    count = len(vertices)
    mirrored = [tuple(v + count for v in face[::-1]) for face in faces]
    gap = torus_arrays()[1][0]  # as no vertex is lost with one face
    tube = [(a, b, b + count, a + count) for a, b in zip(gap, [*gap[1:], gap[0]])]
    obj = scenes.add_object("Pretzel", np.concatenate([vertices, other]), [*faces, *mirrored, *tube])
    scenes.select(obj)
    return obj


WRONG = {
    "two handles": ("torus", two_handles, "this surface has 2 handles: a torus tile needs", "schottky parts"),
    "a plate": ("torus", add_plate, "this surface has 2 handles: a torus tile needs", "schottky parts"),
    "a panel": ("torus", scenes.add_panel, "this surface has no handle: a torus tile needs one", "ring"),
    "a cube": ("torus", scenes.add_cube, "this surface has no handle", "parts"),
    "a torus": ("ring", add_torus, "this surface has 1 handle: a cylinder must have no handle", "torus"),
    "a pretzel": ("ring", two_handles, "this surface has 2 handles: a cylinder must have no handle", "schottky parts"),
    "a closed cube": ("ring", scenes.add_cube, "this surface has no boundary loop: a cylinder needs two", "parts"),
    "a cup": ("ring", lambda: scenes.add_cube(closed=False), "this surface has one boundary loop", "parts"),
    "a torus, no sphere": ("sphere", add_torus, "this surface has 1 handle, and a sphere has no handle", "torus"),
    "a pretzel, no sphere":
        ("sphere", two_handles, "this surface has 2 handles, and a sphere has no handle", "schottky parts"),
    "a ball": ("schottky", add_ball, "this surface has no handle: Unwrap Pretzel needs at least one", "sphere"),
    "a panel without handles": ("schottky", scenes.add_panel, "this surface has no handle", "uniformize"),
}


@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
@pytest.mark.parametrize("wrong", WRONG)
def test_what_is_no_such_domain_is_told_and_stays_as_it_is(wrong, mode):
    kind, make, text, offer = WRONG[wrong]
    obj = make()
    scenes.select(obj)
    if mode == "EDIT":
        scenes.select_faces(obj)
    before = fingerprint.fingerprint()
    with pytest.raises(RuntimeError, match=f"Koebe UV: nothing was mapped. {obj.name}: {text}"):
        unwrap(kind)
    changed = fingerprint.differences(before, fingerprint.fingerprint())
    allowed = ("file: report", f"mesh {obj.data.name}: history", f"mesh {obj.data.name}: active face")
    assert [key for key in changed if key not in allowed] == []
    entry = last_run()
    assert not entry.mapped and entry.offer == offer and entry.message.startswith(text)
    assert len(obj.data.uv_layers) == 0


@pytest.mark.parametrize("kind, make_bad", [
    ("torus", scenes.add_panel), ("sphere", add_torus), ("schottky", add_ball)])  # fmt: skip
def test_several_objects_one_of_them_bad(kind, make_bad):
    good, bad = MAKE[kind](), make_bad()
    scenes.select(good, bad)
    assert unwrap(kind) == {"FINISHED"}
    told = {entry.object_name: entry.mapped for entry in bpy.context.window_manager.koebe_uv.islands}
    assert told == {good.name: True, bad.name: False}
    assert len(good.data.uv_layers) == 1 and len(bad.data.uv_layers) == 0 and len(bad.material_slots) == 0


PARTS = {  # an object, the faces that are selected, and how many loops the map of these has
    "ring": (add_torus, lambda face: face.index // 12 < 5, 2),
    "sphere": (add_ball, lambda face: face.index % 9 < 4 and face.index < 144, 2),
    "schottky": (add_plate, lambda face: face.center.x < 6.0, 1),
}


@pytest.mark.parametrize("kind", PARTS)
def test_in_edit_mode_the_selected_faces(kind):
    """The rest has no UVs, and the artist stays there."""
    make, is_selected, loops = PARTS[kind]
    obj = make()
    chosen = [face.index for face in obj.data.polygons if is_selected(face)]
    scenes.select_faces(obj, chosen)
    assert unwrap(kind) == {"FINISHED"}
    assert bpy.context.mode == "EDIT_MESH"
    bpy.ops.object.mode_set(mode="OBJECT")
    assert scenes.written_faces(obj) == chosen
    assert len(last_run().loops) == loops


def test_one_step_of_undo():
    obj = add_plate()
    bpy.ops.ed.undo_push(message="before")
    assert bpy.ops.uv.koebe_schottky("EXEC_DEFAULT", True) == {"FINISHED"}
    after = scenes.corner_uv(obj.data, "Koebe").copy()
    bpy.ops.ed.undo()
    obj = bpy.data.objects["Plate"]
    assert len(obj.data.uv_layers) == 0 and len(obj.material_slots) == 0
    bpy.ops.ed.redo()
    obj = bpy.data.objects["Plate"]
    assert np.array_equal(scenes.corner_uv(obj.data, "Koebe"), after) and len(obj.material_slots) == 1


@pytest.mark.parametrize("kind", ["torus", "sphere", "schottky"])
def test_cuts_and_loops_can_be_selected(kind):
    obj = MAKE[kind](holes=HOLES)
    unwrap(kind)
    uv = scenes.corner_uv(obj.data, "Koebe")
    assert bpy.ops.uv.koebe_select_cuts() == {"FINISHED"}
    bpy.ops.object.mode_set(mode="OBJECT")
    places = collections.defaultdict(set)
    for face in obj.data.polygons:
        corners = list(face.loop_indices)
        for here, there in zip(corners, [*corners[1:], corners[0]]):
            ends = sorted((obj.data.loops[i].vertex_index, *uv[i].tolist()) for i in (here, there))
            places[obj.data.loops[here].edge_index].add(tuple(ends))
    cut = sorted(edge for edge, sides in places.items() if len(sides) > 1)
    assert len(cut) > 3 and np.flatnonzero(scenes.read(obj.data.edges, "select", bool)).tolist() == cut
    assert bpy.ops.uv.koebe_select_loop(loop=1) == {"FINISHED"}
    bpy.ops.object.mode_set(mode="OBJECT")
    chosen = np.flatnonzero(scenes.read(obj.data.vertices, "select", bool)).tolist()
    assert chosen in [sorted(loop) for loop in scenes.boundary_loops(obj.data)]


@pytest.mark.parametrize("kind", MAKE)
def test_esc_before_the_end_changes_nothing(addon, kind):
    obj = MAKE[kind]()
    choice = addon("maps.domain_table").DOMAINS[kind].choice()
    job = scenes.domain_job(addon, obj, choice)
    job.cancel_token.cancel()
    with pytest.raises(job.koebe.Cancelled):
        job.compute()
    assert len(obj.data.uv_layers) == 0
    heard = []
    job = scenes.domain_job(addon, obj, choice)
    job.compute(lambda fraction, stage: heard.append((fraction, stage)))
    shares = [fraction for fraction, _ in heard]
    assert shares == sorted(shares) and shares[-1] == 1.0
    assert {stage for _, stage in heard} <= addon("operators.modal_run").STAGES.keys()
