"""Circles moved by Möbius maps: the UVs, the report, undo, and everything else as it was."""

import cmath

import bpy
import fingerprint
import numpy as np
import pytest
import scenes
import states
from test_islands import add_seamed_panel

RING = 2.0 * np.pi * np.arange(24) / 24


def mapped(**options):
    """A panel with three holes and its map."""
    obj = scenes.add_panel(**options)
    scenes.select(obj)
    bpy.ops.uv.koebe_uniformize(checker=False)
    return obj


def report():
    """The only island of the report."""
    (entry,) = bpy.context.window_manager.koebe_uv.islands
    return entry


def uv_of(obj, layer="Koebe"):
    """UVs (C, 2) of the layer, in any mode."""
    if obj.mode == "EDIT":
        obj.update_from_editmode()
        mesh = obj.to_mesh()
        values = scenes.corner_uv(mesh, layer).copy()
        obj.to_mesh_clear()
        return values
    return scenes.corner_uv(obj.data, layer)


def assert_report_is_true(obj):
    """Whether every circle of the report is where the vertices of its loop are."""
    for loop in report().loops:
        points = scenes.loop_uv(obj.data, "Koebe", eval(loop.vertices))  # noqa: S307
        away = np.linalg.norm(points - np.array(loop.uv_center), axis=1)
        assert np.abs(away - loop.uv_radius).max() < 2e-6


@pytest.mark.alike
def test_a_point_comes_into_the_middle_and_circles_stay_circles():
    obj = mapped()
    bpy.context.view_layer.update()
    before, mesh = uv_of(obj).astype(np.float64), scenes.mesh_state(obj.data, but_layer="Koebe")
    assert bpy.ops.uv.koebe_moebius(center=(0.3, -0.2), rotation=0.5) == {"FINISHED"}
    scenes.assert_circle_domain(obj)
    assert_report_is_true(obj)
    z, a = (2.0 * before - 1.0) @ [1, 1j], 0.3 - 0.2j
    expected = cmath.rect(1.0, 0.5) * (z - a) / (1.0 - a.conjugate() * z)
    assert np.abs((2.0 * uv_of(obj) - 1.0) @ [1, 1j] - expected).max() < 1e-6
    assert str(scenes.mesh_state(obj.data, but_layer="Koebe")) == str(mesh)
    assert report().moved == "moved by hand" and report().flipped == 0


@pytest.mark.alike
@pytest.mark.parametrize("rim", [1, 2, 3])
def test_a_hole_becomes_the_rim(rim):
    obj = mapped()
    wanted = report().loops[rim].vertices
    others = [loop.vertices for loop in report().loops]
    assert bpy.ops.uv.koebe_moebius(rim=rim) == {"FINISHED"}
    scenes.assert_circle_domain(obj)
    assert_report_is_true(obj)
    assert report().loops[0].vertices == wanted and report().loops[0].radius == pytest.approx(1.0)
    others[0], others[rim] = others[rim], others[0]
    assert [loop.vertices for loop in report().loops] == others
    assert bpy.ops.uv.koebe_moebius(rim=rim) == {"FINISHED"}  # and back
    assert report().loops[rim].vertices == wanted
    scenes.assert_circle_domain(obj)


@pytest.mark.alike
def test_a_hole_comes_into_the_middle_by_its_number_in_the_report():
    mapped()
    assert bpy.ops.uv.koebe_moebius(hole=2) == {"FINISHED"}
    assert np.abs(np.array(report().loops[2].uv_center) - 0.5).max() < 1e-6


@pytest.mark.alike
def test_the_report_tells_how_even_the_moved_map_is():
    obj = mapped()
    obj.data.calc_loop_triangles()
    triangles = np.array([triangle.loops for triangle in obj.data.loop_triangles])
    in_space = np.array([triangle.area for triangle in obj.data.loop_triangles])
    for center in (0.0, 0.0), (0.5, 0.2), (-0.5, -0.2):
        assert bpy.ops.uv.koebe_moebius(center=center) == {"FINISHED"}
        a, b, c = uv_of(obj).astype(np.float64)[triangles].transpose(1, 2, 0)
        in_uv = 0.5 * np.abs((b - a)[0] * (c - a)[1] - (b - a)[1] * (c - a)[0])
        order = np.argsort(in_uv / in_space)
        low, high = np.searchsorted(in_space[order].cumsum() / in_space.sum(), (0.05, 0.95))
        density = np.sqrt((in_uv / in_space)[order])
        assert report().density == pytest.approx(density[high] / density[low], rel=1e-3)
        assert report().coverage == pytest.approx(in_uv.sum(), rel=1e-5)
    assert report().moved != ""


@pytest.mark.alike
def test_without_a_change_every_bit_stays():
    obj = mapped()
    before = uv_of(obj)
    assert bpy.ops.uv.koebe_moebius() == {"FINISHED"}
    assert np.array_equal(uv_of(obj).view(np.int32), before.view(np.int32))


def test_in_edit_mode_with_another_island_left_alone():
    obj = add_seamed_panel()
    bpy.ops.uv.koebe_uniformize(checker=False)
    before = uv_of(obj)
    bpy.ops.object.mode_set(mode="EDIT")
    assert bpy.ops.uv.koebe_moebius(island=1, center=(0.1, 0.1)) == {"FINISHED"}
    assert bpy.context.mode == "EDIT_MESH"
    changed = (uv_of(obj) != before).any(axis=1)
    of_island = [np.array(eval(loop.vertices)) for loop in bpy.context.window_manager.koebe_uv.islands[1].loops]  # noqa: S307
    assert 0 < changed.sum() < len(changed)
    bpy.ops.object.mode_set(mode="OBJECT")
    vertex = scenes.read(obj.data.loops, "vertex_index", np.int32)
    assert changed[np.isin(vertex, of_island[0])].any()
    assert bpy.context.window_manager.koebe_uv.islands[0].moved == ""
    assert bpy.context.window_manager.koebe_uv.islands[1].moved != ""


def told_of_circles():
    """What the report tells of the circles, and how even the map is."""
    loops = [[tuple(loop.uv_center), loop.uv_radius, loop.vertices] for loop in report().loops]
    return report().density, report().coverage, loops


def test_undo_and_redo_take_the_circles_along():
    mapped()
    bpy.ops.ed.undo_push(message="mapped")
    told = told_of_circles()
    bpy.ops.uv.koebe_moebius("EXEC_DEFAULT", True, rim=2, center=(0.1, 0.0))
    moved = told_of_circles()
    assert moved != told
    for _ in range(3):
        bpy.ops.ed.undo()
        assert told_of_circles() == told
        assert report().moved == ""
        bpy.ops.ed.redo()
        assert told_of_circles() == moved
    assert_report_is_true(bpy.context.view_layer.objects.active)


def test_a_report_of_another_layer_is_left_alone():
    obj = mapped()
    obj.data.uv_layers.new(name="Copy")
    scenes.select(obj)
    before = fingerprint.fingerprint()["file: report"]
    assert bpy.ops.uv.koebe_moebius(layer="Copy", center=(0.2, 0.0)) == {"FINISHED"}
    assert fingerprint.fingerprint()["file: report"] == before
    scenes.assert_circle_domain(obj, "Copy")


@pytest.mark.parametrize("options, text", [
    ({"rim": 9}, "there is no loop 9: the island has 4"), ({"hole": 4}, "there is no hole 4: the island has 3"),
    ({"center": (1.0, 0.0)}, "inside the disk"), ({"layer": "None"}, "no UV layer 'None'"),
    ({"island": 3}, "no island 3"), ({"object_name": "Nobody"}, "no object 'Nobody'"),
    ({"rim": 1, "hole": 1}, "cannot be the hole in the middle"),
])  # fmt: skip
def test_what_cannot_be_done_is_said_and_changes_nothing(options, text):
    mapped()
    before = fingerprint.fingerprint()
    with pytest.raises(RuntimeError, match=text):
        bpy.ops.uv.koebe_moebius(**options)
    assert fingerprint.differences(before, fingerprint.fingerprint()) == []


def test_uvs_that_are_no_circles_are_refused():
    obj = mapped()
    uv = uv_of(obj) * np.array([1.0, 0.8], dtype=np.float32)
    obj.data.uv_layers["Koebe"].data.foreach_set("uv", np.ascontiguousarray(uv).ravel())
    with pytest.raises(RuntimeError, match="Panel: its UVs are not a disk with round holes: unwrap it"):
        bpy.ops.uv.koebe_moebius(center=(0.1, 0.0))
    states.new_file()
    scenes.select(scenes.add_panel())
    with pytest.raises(RuntimeError, match="Panel: it has no UVs: map it first"):
        bpy.ops.uv.koebe_moebius(center=(0.1, 0.0))


@pytest.mark.alike
def test_what_32_bits_cannot_tell_apart_is_said():
    mapped()
    assert bpy.ops.uv.koebe_moebius(center=(0.999999, 0.0)) == {"FINISHED"}
    assert "too small for UVs of 32 bits" in report().moved and "Move less" in report().moved


def test_frames_while_dragging_and_esc_restore_every_bit(addon, koebe):
    """What the tool does between press and release, without a window."""
    obj = mapped()
    job = addon("jobs.moebius_job").MoebiusJob(koebe, obj)
    domain, moebius = job.domains[0], addon("surfaces.moebius")
    before = fingerprint.fingerprint()
    for angle in RING:
        moved = moebius.dragged(0.2j, cmath.rect(0.5, angle))
        job.show(domain, job.image_of(domain, moved))
        assert np.abs(uv_of(obj) - domain.image(moved).uv[domain.island.corner_vertex]).max() < 2e-6
    edges = job.edges(domain)
    assert {frozenset(edge) for edge in domain.island.source_vertex[edges].tolist()} == {
        frozenset(edge.vertices) for edge in obj.data.edges
    }
    job.put_back()
    assert fingerprint.differences(before, fingerprint.fingerprint()) == []


@pytest.mark.alike
@pytest.mark.parametrize("run", [
    lambda: bpy.ops.uv.koebe_moebius(rim=1), lambda: bpy.ops.uv.koebe_moebius(rotation=1.0),
    lambda: bpy.ops.uv.koebe_symmetrize(), lambda: bpy.ops.object.koebe_flat_copy(),
], ids=["rim", "turn", "symmetrize", "flat"])  # fmt: skip
@pytest.mark.parametrize("place", [np.nan, np.inf])
def test_a_vertex_that_is_nowhere_since_the_map_is_told_and_nothing_changes(run, place):
    vertices = mapped().data.vertices
    places = scenes.read(vertices, "co", np.float32, 3)
    places[17, 2] = place  # set alone it would be made a number
    vertices.foreach_set("co", places.ravel())
    before = fingerprint.fingerprint()
    with pytest.raises(RuntimeError, match="a vertex has a coordinate that is not a finite number") as raised:
        run()
    assert "Traceback" not in str(raised.value)
    assert fingerprint.fingerprint() == before
