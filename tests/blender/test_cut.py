"""Koebe Unwrap to Disk of any mesh: cut in the UVs where it has no map as it is."""

import cmath

import bmesh
import bpy
import numpy as np
import pytest
import scenes
import wild
from test_bad_meshes import FAN, moebius_strip, torus_with_hole
from test_parts import MODELS, added
from touched import only_uvs_change


def bow_tie():
    """Two tents that share their tips and nothing else, and a fin that makes them one for a careless reader."""
    tent = [(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1)]
    ring = [(1, 0, 0), (0, 1, 0), (-1, 0, 0), (0, -1, 0)]
    vertices = [(0, 0, 0), *((x, y, 1) for x, y, _ in ring), *((x, y, -1) for x, y, _ in ring)]
    other = [tuple(0 if v == 0 else v + 4 for v in face) for face in tent]
    return vertices, [*tent, *other, (1, 5, 2), (5, 6, 2)]


def fin():
    """A bent panel with a wall along one of its lines."""
    vertices = [(x, y, 0.2 * x * x) for y in range(5) for x in range(5)]
    faces = [(5 * y + x, 5 * y + x + 1, 5 * y + x + 6, 5 * y + x + 5) for y in range(4) for x in range(4)]
    vertices += [(2, y, 2) for y in range(5)]
    return vertices, faces + [(5 * y + 2, 5 * y + 7, 26 + y, 25 + y) for y in range(4)]


def turned_faces():
    """The bent panel with each third face the other way round."""
    vertices, faces = scenes.panel_arrays(12)
    return vertices, [face[::-1] if number % 3 == 0 else face for number, face in enumerate(faces)]


def doubled():
    """A panel with faces that are there twice."""
    vertices, faces = scenes.panel_arrays(12)
    return vertices, faces + [face[1:] + face[:1] for face in faces[10:13]]


ANY = {
    "cube": lambda: scenes.add_cube(),
    "sphere": MODELS["sphere"],
    "torus": MODELS["torus"],
    "torus with a hole": lambda: scenes.add_object("Bad", *torus_with_hole()),
    "klein": lambda: scenes.add_object("Bad", *wild.closed_grid(24, 12, klein=True)),
    "moebius": lambda: scenes.add_object("Bad", *moebius_strip()),
    "fin": lambda: scenes.add_object("Bad", *fin()),
    "fan": lambda: scenes.add_object("Bad", FAN, [(0, 1, 2), (1, 0, 3), (0, 1, 4)]),
    "bow tie": lambda: scenes.add_object("Bad", *bow_tie()),
    "turned": lambda: scenes.add_object("Bad", *turned_faces()),
    "doubled": lambda: scenes.add_object("Bad", *doubled()),
}
WHY = {
    "cube": "is closed", "sphere": "is closed", "torus": "1 handle", "torus with a hole": "1 handle",
    "klein": "one-sided", "moebius": "one-sided", "fin": "more than two faces",
    "fan": "more than two faces", "bow tie": "", "turned": "", "doubled": "degenerate or double",
}  # fmt: skip


REORIENTED = "turned to the orientation of the others"


def report():
    return bpy.context.window_manager.koebe_uv.islands


def islands_of(obj):
    """Area of each face in the UVs, the sign of each triangle."""
    return np.abs(scenes.signed_areas(obj.data, "Koebe"))


@pytest.mark.alike
@pytest.mark.parametrize("kind", ANY)
def test_any_mesh_gets_uvs_and_its_mesh_stays(kind):
    obj = ANY[kind]()
    scenes.select(obj)
    with only_uvs_change():
        assert bpy.ops.uv.koebe_uniformize(checker=False) == {"FINISHED"}
    scenes.corner_uv_in_square(obj)
    assert all(entry.mapped and entry.converged for entry in report())
    # Of a surface that the solver maps as it is, faces that look the other way than the others count as flipped.
    assert all(entry.flipped == 0 or REORIENTED in entry.message for entry in report())
    assert (islands_of(obj) > 0.0).all()
    assert WHY[kind] in " ".join(entry.note for entry in report())


@pytest.mark.alike
@pytest.mark.parametrize("kind", ["turned", "klein", "moebius", "torus"])
def test_triangles_of_an_island_have_one_direction(kind):
    """Over each edge that the UVs do not cut, both triangles lie on their own side of it."""
    obj = ANY[kind]()
    scenes.select(obj)
    bpy.ops.uv.koebe_uniformize(checker=False)
    uv, (vertices, corners) = scenes.corner_uv(obj.data, "Koebe").astype(float), scenes.triangles(obj.data)
    sides = {}
    for v, c in zip(vertices.tolist(), corners.tolist()):
        for k in range(3):
            a, b, tip = ((v[(k + n) % 3], uv[c[(k + n) % 3]]) for n in range(3))
            low, high = sorted((a, b), key=lambda end: end[0])
            sides.setdefault((low[0], high[0], *low[1], *high[1]), []).append((low[1], high[1], tip[1]))
    joined = [pair for pair in sides.values() if len(pair) == 2]
    assert len(joined) > 20
    for (a, b, tip), (_, _, other) in joined:
        one, two = ((b - a)[0] * (p - a)[1] - (b - a)[1] * (p - a)[0] for p in (tip, other))
        assert one * two < 0


def test_the_cuts_are_where_the_uvs_differ_and_can_be_selected():
    obj = ANY["torus"]()
    scenes.select(obj)
    bpy.ops.uv.koebe_uniformize(checker=False)
    (entry,) = report()
    assert entry.note.startswith("in the UVs: ") and "cut through 1 handle" in entry.note
    assert bpy.ops.uv.koebe_select_cuts() == {"FINISHED"}
    bpy.ops.object.mode_set(mode="OBJECT")
    edges = set(np.flatnonzero(scenes.read(obj.data.edges, "select", bool)).tolist())
    uv, apart = scenes.corner_uv(obj.data, "Koebe"), {}
    for face in obj.data.polygons:
        loops = list(face.loop_indices)
        for here, there in zip(loops, loops[1:] + loops[:1]):
            ends = sorted((obj.data.loops[c].vertex_index, tuple(uv[c])) for c in (here, there))
            apart.setdefault(obj.data.loops[here].edge_index, []).append(ends)
    assert edges == {edge for edge, (one, two) in apart.items() if one != two}
    assert edges


@pytest.mark.alike
def test_a_surface_that_has_a_map_is_mapped_as_before_to_the_bit():
    one, other = scenes.add_panel("One"), scenes.add_panel("Other")
    scenes.select(one)
    bpy.ops.uv.koebe_uniformize(cut=False, checker=False)
    scenes.select(other)
    bpy.ops.uv.koebe_uniformize(cut=True, checker=False)
    assert np.array_equal(scenes.corner_uv(one.data, "Koebe"), scenes.corner_uv(other.data, "Koebe"))
    assert report()[0].note == "" and report()[0].cuts == ""
    assert not bpy.ops.uv.koebe_select_cuts.poll()


def test_of_a_bow_tie_the_vertices_are_selected():
    obj = ANY["bow tie"]()
    scenes.select(obj)
    bpy.ops.uv.koebe_uniformize(checker=False)
    if any(entry.cuts for entry in report()):
        assert bpy.ops.uv.koebe_select_cuts() == {"FINISHED"}


def test_undo_takes_the_layer_back():
    obj = ANY["sphere"]()
    scenes.select(obj)
    bpy.ops.ed.undo_push(message="before")
    bpy.ops.uv.koebe_uniformize()
    bpy.ops.ed.undo_push(message="after")
    name = obj.name
    bpy.ops.ed.undo()
    assert len(bpy.data.objects[name].data.uv_layers) == 0
    bpy.ops.ed.redo()
    assert "Koebe" in bpy.data.objects[name].data.uv_layers


def test_a_closed_part_that_is_selected_in_edit_mode():
    obj = ANY["cube"]()
    scenes.select(obj)
    scenes.select_faces(obj)
    assert bpy.ops.uv.koebe_uniformize(checker=False) == {"FINISHED"}
    bpy.ops.object.mode_set(mode="OBJECT")
    assert (islands_of(obj) > 0.0).all()


def test_a_torus_becomes_a_tube_and_is_unrolled():
    """Cut through its handle and along nothing else it would be a tube; opened it is a disk: neither breaks."""
    obj = ANY["torus"]()
    scenes.select(obj)
    assert bpy.ops.uv.koebe_uniformize(tube="unroll", checker=False) == {"FINISHED"}
    assert (islands_of(obj) > 0.0).all() and all(entry.flipped == 0 for entry in report())


def test_a_tube_with_turned_faces_is_unrolled():
    vertices, faces = scenes.panel_arrays(12, holes=((0.0, 1.0, 0.0, 0.5),))
    faces = [face for face in faces if 0 not in face]
    used, index = np.unique(np.concatenate(faces), return_inverse=True)
    faces = [part.tolist() for part in np.split(index, np.cumsum([len(face) for face in faces])[:-1])]
    obj = scenes.add_object("Tube", vertices[used], [f[::-1] if n % 4 == 1 else f for n, f in enumerate(faces)])
    scenes.select(obj)
    assert bpy.ops.uv.koebe_uniformize(tube="unroll", checker=False) == {"FINISHED"}
    (entry,) = report()
    assert entry.mapped and REORIENTED in entry.message and entry.loops[1].uv_radius == 0.0
    areas = scenes.signed_areas(obj.data, "Koebe")
    assert (areas != 0.0).all() and (areas < 0).any() and (areas > 0).any()


@pytest.mark.alike
@pytest.mark.parametrize("options", [{"outer": "longest"}, {"placement": "together"}, {"method": "ck"},
                                     {"engine": "mesh"}, {"balance": "none"}, {"upright": False}])  # fmt: skip
def test_the_other_options_work_with_it(options):
    obj, panel = ANY["torus"](), scenes.add_panel()
    scenes.select(obj, panel)
    assert bpy.ops.uv.koebe_uniformize(checker=False, **options) == {"FINISHED"}
    assert all(entry.mapped and entry.flipped == 0 for entry in report())


def test_the_cursor_is_the_centre_of_one_piece_only():
    obj, panel = ANY["sphere"](), scenes.add_panel()
    scenes.select(obj, panel)
    bpy.context.scene.cursor.location = (0.0, 0.0, 1.0)
    assert bpy.ops.uv.koebe_uniformize(checker=False, center="cursor") == {"FINISHED"}
    assert all(entry.mapped for entry in report())
    bpy.context.scene.cursor.location = (0.0, 0.0, 0.0)


@pytest.mark.alike
def test_a_soup_of_faces_ends_soon():
    random = np.random.default_rng(5)
    vertices = random.normal(size=(60, 3))
    faces = [random.choice(60, 3, replace=False).tolist() for _ in range(400)]
    obj = scenes.add_object("Soup", vertices, faces)
    scenes.select(obj)
    assert bpy.ops.uv.koebe_uniformize(checker=False) == {"FINISHED"}
    assert all(entry.mapped for entry in report())
    uv = scenes.corner_uv(obj.data, "Koebe")
    assert np.isfinite(uv).all()


@pytest.mark.alike
def test_random_meshes_are_mapped_one_to_one_or_refused():
    """Panels, spheres and tori with faces taken, doubled, turned, glued: UVs without flips or a reason."""
    random = np.random.default_rng(17)
    for _ in range(120):
        vertices, faces = damaged(random)
        obj = scenes.add_object("Random", vertices, faces)
        scenes.select(obj)
        state = scenes.mesh_state(obj.data, but_layer="Koebe")
        try:
            bpy.ops.uv.koebe_uniformize(checker=False, tube=str(random.choice(["annulus", "unroll"])))
        except RuntimeError as error:
            assert "an unexpected error" not in str(error)
        assert "an unexpected error" not in " ".join(entry.message for entry in report())
        assert scenes.mesh_state(obj.data, but_layer="Koebe") == state
        if "Koebe" in obj.data.uv_layers and all(entry.mapped for entry in report()):
            assert np.isfinite(scenes.corner_uv(obj.data, "Koebe")).all()
        bpy.data.objects.remove(obj)


def damaged(random):
    """A mesh with some damage."""
    kind = random.integers(4)
    if kind == 0:
        vertices, faces = scenes.panel_arrays(8)
    elif kind == 1:
        vertices, faces = torus_with_hole(6, 5)
    elif kind == 2:
        vertices, faces = wild.closed_grid(8, 6, klein=True)
    else:
        vertices, faces = moebius_strip(8)
    return wild.damaged(random, vertices, faces)


def test_what_cannot_be_painted_on_is_said():
    obj = added(bpy.ops.mesh.primitive_uv_sphere_add, segments=32, ring_count=64)
    for vertex in obj.data.vertices:  # a ball with a long finger
        if vertex.co.z > 0.3:
            vertex.co *= 0.25
        vertex.co.z *= 1.0 if vertex.co.z < 0 else 12.0
    mesh = bmesh.new()
    mesh.from_mesh(obj.data)
    low = [face for face in mesh.faces if face.calc_center_median().z < -0.99]
    bmesh.ops.delete(mesh, geom=low, context="FACES")  # an opening, so that no slit runs along the finger
    mesh.to_mesh(obj.data)
    mesh.free()
    scenes.select(obj)
    bpy.ops.uv.koebe_uniformize(checker=False)
    assert any(entry.uneven for entry in report())


def test_the_circles_of_a_piece_are_moved_as_any_others():
    obj = ANY["torus"]()
    scenes.select(obj)
    bpy.ops.uv.koebe_uniformize(checker=False)
    before = scenes.corner_uv(obj.data, "Koebe").copy()
    assert bpy.ops.uv.koebe_moebius(rotation=0.5) == {"FINISHED"}
    turned = scenes.corner_uv(obj.data, "Koebe")
    z, w = (uv[:, 0].astype(float) - 0.5 + 1j * (uv[:, 1].astype(float) - 0.5) for uv in (before, turned))
    assert np.abs(w - z * cmath.rect(1.0, 0.5)).max() < 1e-5
    assert report()[0].moved
    bpy.ops.uv.koebe_moebius(center=(0.4, 0.1))
    assert (islands_of(obj) > 0.0).all()


def test_a_part_is_turned_by_hand():
    """Of Unwrap to Parts too, at Even 0: a disk is a circle domain, wherever it lies."""
    obj = added(bpy.ops.mesh.primitive_monkey_add)
    scenes.select(obj)
    bpy.ops.uv.koebe_parts(checker=False, keep_angles=False, even=0)
    before = scenes.corner_uv(obj.data, "Koebe").copy()
    assert bpy.ops.uv.koebe_moebius(rotation=0.5) == {"FINISHED"}
    moved = (scenes.corner_uv(obj.data, "Koebe") != before).any(axis=1)
    assert 0 < moved.sum() < len(moved)
