"""Unwrap to Parts: any surface, cut in the UVs alone."""

import dataclasses

import bpy
import fingerprint
import numpy as np
import pytest
import scenes
from scenes import last_run
from touched import only_uvs_change


def unwrap(**options):
    return bpy.ops.uv.koebe_parts(**options)


def added(make, **options):
    """The object that an operator of Blender adds, without UVs."""
    make(**options)
    obj = bpy.context.object
    while obj.data.uv_layers:
        obj.data.uv_layers.remove(obj.data.uv_layers[0])
    return obj


MODELS = {
    "panel": lambda: scenes.add_panel(),
    "sphere": lambda: added(bpy.ops.mesh.primitive_uv_sphere_add, segments=24, ring_count=12),
    "torus": lambda: added(bpy.ops.mesh.primitive_torus_add, major_segments=24, minor_segments=12),
    "monkey": lambda: added(bpy.ops.mesh.primitive_monkey_add),
    "cylinder": lambda: added(bpy.ops.mesh.primitive_cylinder_add, vertices=24, depth=4.0),
}


@pytest.mark.alike
@pytest.mark.parametrize("model", MODELS)
def test_any_model_gets_uvs_without_flips_in_the_square(model):
    obj = MODELS[model]()
    scenes.select(obj)
    with only_uvs_change():
        assert unwrap(checker=False) == {"FINISHED"}
    assert np.ptp(scenes.corner_uv_in_square(obj)) > 0.3
    assert (scenes.polygon_areas(obj) > 0.0).all()
    (entry,) = bpy.context.window_manager.koebe_uv.islands
    assert entry.mapped and entry.flipped == 0 and entry.parts >= 1 and not entry.loops


@pytest.mark.alike
def test_a_sphere_is_evener_than_one_map_can_be():
    obj = MODELS["sphere"]()
    scenes.select(obj)
    unwrap()
    (entry,) = bpy.context.window_manager.koebe_uv.islands
    assert entry.density < 4.0 and entry.cut_length > 0.5


@pytest.mark.alike
def test_the_dial_makes_more_parts():
    obj = MODELS["monkey"]()
    scenes.select(obj)
    counts = []
    for evenness in (0.0, 1.0):
        unwrap(evenness=evenness)
        counts.append(bpy.context.window_manager.koebe_uv.islands[0].parts)
    assert counts[0] < counts[1]


@pytest.mark.alike
def test_polygons_stay_whole():
    obj = MODELS["torus"]()
    scenes.select(obj)
    unwrap()
    uv, sizes = scenes.corner_uv(obj.data, "Koebe"), []
    for face in obj.data.polygons:
        of_face = uv[list(face.loop_indices)]
        sizes.append(np.linalg.norm(np.ptp(of_face, axis=0)))
    assert max(sizes) < 20.0 * np.median(sizes), "a quadrilateral is torn apart"


@pytest.mark.alike
def test_seams_stay_cuts():
    """A flat square, cut along its middle, though one part would do: the two sides lie apart."""
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=10, y_subdivisions=10)
    obj = bpy.context.object
    scenes.select(obj)
    middle = {vertex.index for vertex in obj.data.vertices if abs(vertex.co.x) < 1e-6}
    places = []
    for seam in (False, True):
        for edge in obj.data.edges:
            edge.use_seam = seam and set(edge.vertices) <= middle
        assert unwrap(evenness=0.0) == {"FINISHED"}
        uv = scenes.corner_uv(obj.data, "Koebe")
        of_vertex = {v: set() for v in middle}
        for corner, loop in enumerate(obj.data.loops):
            if loop.vertex_index in middle:
                of_vertex[loop.vertex_index].add(tuple(uv[corner]))
        places.append(min(map(len, of_vertex.values())))
    assert places[0] == 1 and places[1] >= 2


def test_in_edit_mode_the_selected_faces():
    obj = MODELS["sphere"]()
    scenes.select_faces(obj, range(0, 100))
    assert unwrap() == {"FINISHED"}
    bpy.ops.object.mode_set(mode="OBJECT")
    uv = scenes.corner_uv(obj.data, "Koebe")
    written = np.array([np.ptp(uv[list(face.loop_indices)], axis=0).max() > 0.0 for face in obj.data.polygons])
    assert written[:100].all() and not written[100:].any()


def test_a_mesh_without_area_is_an_error_and_nothing_changes():
    obj = scenes.add_object("Line", [(0, 0, 0), (1, 0, 0), (2, 0, 0)], [(0, 1, 2)])
    scenes.select(obj)
    before = fingerprint.fingerprint()
    with pytest.raises(RuntimeError, match="Koebe UV: nothing was mapped. Line: "):
        unwrap()
    assert fingerprint.differences(before, fingerprint.fingerprint()) in ([], ["file: report"])
    assert len(obj.data.uv_layers) == 0


def test_several_objects_one_of_them_bad():
    good, bad = MODELS["sphere"](), scenes.add_object("Line", [(0, 0, 0), (1, 0, 0), (2, 0, 0)], [(0, 1, 2)])
    scenes.select(good, bad)
    assert unwrap() == {"FINISHED"}
    told = {entry.object_name: entry.mapped for entry in bpy.context.window_manager.koebe_uv.islands}
    assert told == {good.name: True, "Line": False} and "Koebe" in good.data.uv_layers


# ---------------------------------------------------------------- cuts as seams, and seams as cuts


def add_finger(around=16, rings=30):
    """A tube that is open below, with a round tip."""
    angle = 2.0 * np.pi * np.arange(around) / around
    profile = [(1.0, 0.4 * k) for k in range(rings)]
    profile += [(np.cos(t), 0.4 * (rings - 1) + np.sin(t)) for t in np.linspace(0, np.pi / 2, 6)[1:-1]]
    vertices = [(r * np.cos(a), r * np.sin(a), h) for r, h in profile for a in angle]
    faces = [
        (k * around + i, k * around + (i + 1) % around, (k + 1) * around + (i + 1) % around, (k + 1) * around + i)
        for k in range(len(profile) - 1) for i in range(around)
    ]  # fmt: skip
    last = (len(profile) - 1) * around
    vertices.append((0.0, 0.0, 0.4 * (rings - 1) + 1.0))
    faces += [(last + i, last + (i + 1) % around, len(vertices) - 1) for i in range(around)]
    obj = scenes.add_object("Finger", vertices, faces)
    scenes.select(obj)
    return obj


def seams_of(obj):
    return np.flatnonzero(scenes.read(obj.data.edges, "use_seam", bool))


def cuts_of(obj):
    """Edges whose faces lie apart in the UVs."""
    uv, places = scenes.corner_uv(obj.data, "Koebe"), {}
    for face in obj.data.polygons:
        loops = list(face.loop_indices)
        for here, there in zip(loops, [*loops[1:], loops[0]]):
            at = {obj.data.loops[i].vertex_index: tuple(uv[i]) for i in (here, there)}
            places.setdefault(obj.data.loops[here].edge_index, set()).add(tuple(sorted(at.items())))
    return np.array(sorted(edge for edge, sides in places.items() if len(sides) > 1), dtype=int)


@pytest.mark.alike
@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
@pytest.mark.parametrize("model", [*MODELS, "finger"])
def test_cuts_become_seams_and_the_next_run_cuts_along_them(model, mode):
    obj = add_finger() if model == "finger" else MODELS[model]()
    scenes.select(obj)
    scenes.edit_all(mode)
    assert unwrap(checker=False) == {"FINISHED"}
    bpy.ops.object.mode_set(mode="OBJECT")
    assert len(seams_of(obj)) == 0, "the mesh was changed without being asked"
    bpy.ops.object.mode_set(mode=mode)
    assert unwrap(checker=False, write_seams=True) == {"FINISHED"}
    bpy.ops.object.mode_set(mode="OBJECT")
    first, cuts = last_run().parts, cuts_of(obj)
    assert (seams_of(obj) == cuts).all() and len(seams_of(obj)) == len(cuts)
    for seams in ("add", "only"):
        assert unwrap(checker=False, seams=seams) == {"FINISHED"}
        assert set(cuts) <= set(cuts_of(obj)), seams
        assert seams == "add" or (last_run().parts == first and set(cuts) == set(cuts_of(obj)))
        assert (scenes.polygon_areas(obj) > 0.0).all()


@pytest.mark.alike
def test_a_finger_keeps_its_parts_and_its_slit_over_runs():
    obj = add_finger()
    unwrap(write_seams=True, darts=0.0)
    entry = last_run()
    assert entry.parts == 2
    seams, angle = seams_of(obj), entry.angle_error
    for _ in range(3):
        unwrap(write_seams=True, darts=0.0)
        assert (seams_of(obj) == seams).all() and last_run().parts == 2
        assert last_run().angle_error == pytest.approx(angle, abs=0.2), "the tube is no rectangle any more"


def test_a_seam_that_was_deleted_is_no_cut_with_only_these():
    obj = add_finger()
    unwrap(write_seams=True)
    heights = np.array([[obj.data.vertices[v].co.z for v in edge.vertices] for edge in obj.data.edges])
    level = np.flatnonzero(np.ptp(heights, axis=1) < 1e-6)
    removed = set(seams_of(obj)) & set(level)
    assert removed, "the loop between the tube and its tip"
    for edge in removed:
        obj.data.edges[edge].use_seam = False
    kept = set(seams_of(obj))
    assert unwrap(seams="only") == {"FINISHED"}
    assert set(cuts_of(obj)) == kept and last_run().parts == 1
    assert unwrap(seams="add") == {"FINISHED"}
    assert kept <= set(cuts_of(obj))


def test_a_tube_is_unrolled_along_its_seam():
    """Not along a path of our own: the back, where the artist wants it."""
    bpy.ops.mesh.primitive_cylinder_add(vertices=24, depth=6.0, end_fill_type="NOTHING")
    obj = bpy.context.object
    scenes.select(obj)
    scenes.edit_all()
    bpy.ops.mesh.subdivide(number_cuts=3)
    bpy.ops.object.mode_set(mode="OBJECT")
    sides = [{tuple(np.round(obj.data.vertices[v].co[:2], 4)) for v in edge.vertices} for edge in obj.data.edges]
    for place in (sides[0] if len(sides[0]) == 1 else sides[1]), next(s for s in reversed(sides) if len(s) == 1):
        chosen = [i for i, side in enumerate(sides) if side == place]
        for i, edge in enumerate(obj.data.edges):
            edge.use_seam = i in chosen
        assert unwrap() == {"FINISHED"}
        assert cuts_of(obj).tolist() == sorted(chosen)
        (entry,) = bpy.context.window_manager.koebe_uv.islands
        assert entry.density < 1.5 and entry.angle_error < 1.0


def test_writing_seams_is_one_undo_step():
    import states

    states.new_file()
    obj = add_finger()
    bpy.ops.ed.undo_push(message="made")
    obj.data.edges[5].use_seam = True
    bpy.ops.ed.undo_push(message="marked")
    unwrap(write_seams=True)
    bpy.ops.ed.undo_push(message="unwrapped")
    assert len(seams_of(bpy.data.objects["Finger"])) > 5
    bpy.ops.ed.undo()
    assert seams_of(bpy.data.objects["Finger"]).tolist() == [5]
    bpy.ops.ed.redo()
    assert len(seams_of(bpy.data.objects["Finger"])) > 5


def test_the_cuts_can_be_selected():
    obj = add_finger()
    unwrap()
    assert bpy.ops.uv.koebe_select_cuts() == {"FINISHED"}
    bpy.ops.object.mode_set(mode="OBJECT")
    assert np.flatnonzero(scenes.read(obj.data.edges, "select", bool)).tolist() == cuts_of(obj).tolist()


def weight_group(obj, chosen):
    """A vertex group Front of these vertices."""
    obj.vertex_groups.new(name="Front").add([int(v) for v in chosen], 1.0, "REPLACE")


def cut_edges_in(obj, vertices):
    """The number of seams whose two vertices are among these, and of all seams."""
    seams = [edge for edge in obj.data.edges if edge.use_seam]
    return sum(all(v in vertices for v in edge.vertices) for edge in seams), len(seams)


@pytest.mark.alike
def test_cuts_keep_away_from_the_group_that_is_shown():
    obj = MODELS["monkey"]()
    front = {v.index for v in obj.data.vertices if v.co.y < 0.0}
    weight_group(obj, front)
    scenes.select(obj)
    shares = []
    for show in ("", "Front"):
        assert unwrap(write_seams=True, show=show, checker=False) == {"FINISHED"}
        shown, total = cut_edges_in(obj, front)
        shares.append(shown / total)
        for edge in obj.data.edges:
            edge.use_seam = False
    assert shares[1] < 0.8 * shares[0]


def test_a_group_to_show_that_nobody_has_is_refused():
    obj = MODELS["sphere"]()
    scenes.select(obj)
    state = scenes.mesh_state(obj.data)
    with pytest.raises(RuntimeError, match="Avoid is the vertex group 'Nothing', but no object has this group"):
        unwrap(show="Nothing")
    assert scenes.mesh_state(obj.data) == state


@pytest.mark.alike
@pytest.mark.parametrize("atlas", [False, True])
def test_cuts_are_sketched_where_the_objects_stand(atlas, addon):
    first, second = MODELS["sphere"](), MODELS["torus"]()
    first.location, second.location = (3.0, 0.0, 1.0), (-2.0, 5.0, 0.0)
    bpy.context.view_layer.update()
    options, choice = (getattr(addon("maps.options"), name)() for name in ("Options", "PartsChoice"))
    choice = dataclasses.replace(choice, atlas=atlas)
    job = addon("jobs.parts_job").PartsJob([first, second], options, choice)
    assert len(job.sketched()) == 0, "nothing is decided yet"
    job.compute()
    found = {frozenset(map(tuple, ends)) for ends in job.sketched().round(3).tolist()}
    assert len(job.sketched()) == 0, "nothing is new"
    for obj in (first, second):
        places = [tuple((obj.matrix_world @ v.co)[:]) for v in obj.data.vertices]
        edges = {frozenset(tuple(np.float32(places[v]).round(3).tolist()) for v in e.vertices) for e in obj.data.edges}
        assert len(found & edges) > 5
        found -= edges
    assert not found, "all lie on edges"
