"""Unwrap to Parts: any surface, cut in the UVs alone."""

import bpy
import fingerprint
import numpy as np
import pytest
import scenes


def unwrap(**options):
    return bpy.ops.uv.koebe_parts(**options)


def added(make, **options):
    """The object that an operator of Blender adds, without UVs."""
    make(**options)
    obj = bpy.context.object
    while obj.data.uv_layers:
        obj.data.uv_layers.remove(obj.data.uv_layers[0])
    return obj


def signed_areas(obj):
    """UV areas of the faces, twice over, by the shoelace formula."""
    uv = scenes.corner_uv(obj.data, "Koebe").astype(float)
    return np.array([
        sum(uv[i][0] * uv[j][1] - uv[j][0] * uv[i][1] for i, j in zip(loops, [*loops[1:], loops[0]]))
        for loops in (list(face.loop_indices) for face in obj.data.polygons)
    ])  # fmt: skip


MODELS = {
    "panel": lambda: scenes.add_panel(),
    "sphere": lambda: added(bpy.ops.mesh.primitive_uv_sphere_add, segments=24, ring_count=12),
    "torus": lambda: added(bpy.ops.mesh.primitive_torus_add, major_segments=24, minor_segments=12),
    "monkey": lambda: added(bpy.ops.mesh.primitive_monkey_add),
    "cylinder": lambda: added(bpy.ops.mesh.primitive_cylinder_add, vertices=24, depth=4.0),
}


@pytest.mark.parametrize("model", MODELS)
def test_any_model_gets_uvs_without_flips_in_the_square(model):
    obj = MODELS[model]()
    scenes.select(obj)
    before = fingerprint.fingerprint()
    assert unwrap(checker=False) == {"FINISHED"}
    uv = scenes.corner_uv(obj.data, "Koebe")
    assert np.isfinite(uv).all() and uv.min() >= 0.0 and uv.max() <= 1.0 and np.ptp(uv) > 0.3
    assert (signed_areas(obj) > 0.0).all()
    (entry,) = bpy.context.window_manager.koebe_uv.islands
    assert entry.mapped and entry.flipped == 0 and entry.parts >= 1 and not entry.loops
    changed = fingerprint.differences(before, fingerprint.fingerprint())
    assert all("uv" in name or "attribute Koebe" in name or name == "file: report" for name in changed), changed


def test_a_sphere_is_evener_than_one_map_can_be():
    obj = MODELS["sphere"]()
    scenes.select(obj)
    unwrap()
    (entry,) = bpy.context.window_manager.koebe_uv.islands
    assert entry.density < 4.0 and entry.cut_length > 0.5


def test_the_dial_makes_more_parts():
    obj = MODELS["monkey"]()
    scenes.select(obj)
    counts = []
    for evenness in (0.0, 1.0):
        unwrap(evenness=evenness)
        counts.append(bpy.context.window_manager.koebe_uv.islands[0].parts)
    assert counts[0] < counts[1]


def test_polygons_stay_whole():
    obj = MODELS["torus"]()
    scenes.select(obj)
    unwrap()
    uv, sizes = scenes.corner_uv(obj.data, "Koebe"), []
    for face in obj.data.polygons:
        of_face = uv[list(face.loop_indices)]
        sizes.append(np.linalg.norm(np.ptp(of_face, axis=0)))
    assert max(sizes) < 20.0 * np.median(sizes), "a quadrilateral is torn apart"


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
