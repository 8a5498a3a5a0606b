"""Live: a seam or a pin that changes in Edit Mode unwraps its islands again, and no others."""

import time

import bmesh
import bpy
import numpy as np
import pytest
import scenes

pytestmark = pytest.mark.alike


@pytest.fixture
def live(addon):
    """Live, switched on. In the background its timer is this call, until nothing is left to do."""
    manager = bpy.context.window_manager
    yield addon("operators.live")
    manager.koebe_live = False


def follow(live):
    """Let Live do its work."""
    bpy.context.view_layer.update()
    end = time.monotonic() + 30.0
    while live.live.step() is not None:
        time.sleep(0.02)
        assert time.monotonic() < end


def edited(seams=(6,)):
    """A sheet in Edit Mode, with its islands."""
    obj = scenes.add_sheet(12, seams)
    assert bpy.ops.uv.koebe_parts(seams="only", checker=False) == {"FINISHED"}
    bpy.ops.object.mode_set(mode="EDIT")
    return obj


def live_sheet(live, seams=(6,)):
    """Such a sheet, with Live switched on."""
    obj = edited(seams)
    bpy.context.window_manager.koebe_live = True
    follow(live)
    return obj


def mark(obj, column, value):
    """Mark or clear the seams of a column of vertices."""
    mesh = bmesh.from_edit_mesh(obj.data)
    for edge in mesh.edges:
        ends = sorted(vertex.index for vertex in edge.verts)
        if ends[0] // 13 == ends[1] // 13 == column:
            edge.seam = value
    bmesh.update_edit_mesh(obj.data)


def uv_of(obj):
    """The UVs (144, 4, 2), read in Edit Mode."""
    mesh = bmesh.from_edit_mesh(obj.data)
    layer = mesh.loops.layers.uv["Koebe"]
    return np.array([[corner[layer].uv[:] for corner in face.loops] for face in mesh.faces])


def cuts(uv):
    """How many of the 13 vertices of each inner column are cut."""
    grid = uv.reshape(12, 12, 4, 2)
    return [int((np.abs(grid[k - 1, :, 1] - grid[k, :, 0]).max(axis=-1) > 1e-5).sum()) for k in range(1, 12)]


def test_a_cut_that_ends_inside_an_island_opens(live):
    obj = edited(())
    bpy.context.window_manager.koebe_live = True
    follow(live)
    mesh = bmesh.from_edit_mesh(obj.data)
    for edge in mesh.edges:
        edge.seam = all(vertex.index // 13 == 6 and vertex.index % 13 <= 6 for vertex in edge.verts)
    bmesh.update_edit_mesh(obj.data)
    follow(live)
    assert live.live.message == "" and cuts(uv_of(obj)) == [6 * (k == 6) for k in range(1, 12)]


def test_a_marked_and_a_cleared_seam_are_followed(live):
    obj = live_sheet(live)
    before = uv_of(obj)
    mark(obj, 3, True)
    follow(live)
    after = uv_of(obj)
    assert live.live.message == ""
    assert np.array_equal(after[72:], before[72:]) and not np.array_equal(after[:72], before[:72])
    assert [bool(count) for count in cuts(after)] == [k in (3, 6) for k in range(1, 12)]
    mark(obj, 6, False)
    follow(live)
    joined = uv_of(obj)
    assert [bool(count) for count in cuts(joined)] == [k == 3 for k in range(1, 12)]
    # The joined island lies where the larger of the two lay, in its size.
    assert np.allclose(joined[72:].mean(axis=(0, 1)), after[72:].mean(axis=(0, 1)), atol=0.02)
    follow(live)
    assert np.array_equal(uv_of(obj), joined)  # what it wrote itself is no change


def test_a_moved_pin_is_followed(live):
    obj = live_sheet(live)
    before = uv_of(obj)
    mesh = bmesh.from_edit_mesh(obj.data)
    layer = mesh.loops.layers.uv["Koebe"]
    mesh.verts.ensure_lookup_table()
    for corner in mesh.verts[0].link_loops:
        corner[layer].pin_uv = True
        corner[layer].uv = (0.25, -0.5)
    bmesh.update_edit_mesh(obj.data)
    follow(live)
    after = uv_of(obj)
    assert live.live.message == "" and np.array_equal(after[72:], before[72:])
    assert tuple(after[0, 0]) == (0.25, -0.5)
    one, other = after[:72].reshape(-1, 2), before[:72].reshape(-1, 2)
    assert np.allclose(one[1:] - one[1], other[1:] - other[1], atol=1e-3)  # one pin moves the island


def test_a_moved_vertex_is_followed_and_other_islands_stay(live):
    obj = live_sheet(live)
    before = uv_of(obj)
    mesh = bmesh.from_edit_mesh(obj.data)
    mesh.verts.ensure_lookup_table()
    mesh.verts[3 * 13 + 6].co.z += 0.3
    bmesh.update_edit_mesh(obj.data)
    follow(live)
    after = uv_of(obj)
    assert live.live.message == "" and np.array_equal(after[72:], before[72:])
    assert np.abs(after[:72] - before[:72]).max() > 1e-3


def test_of_a_large_island_what_is_near_a_moved_vertex_follows(addon, live, monkeypatch):
    for name in ("LARGE", "PATCH"):
        monkeypatch.setattr(addon("maps.live"), name, 30)  # of 72 faces an island
    settings = bpy.context.scene.koebe_uv
    settings.keep_angles, settings.even = False, 0.5
    obj = live_sheet(live)
    random, near = np.random.default_rng(8), 0
    for _ in range(12):
        before = uv_of(obj)
        mesh = bmesh.from_edit_mesh(obj.data)
        mesh.verts.ensure_lookup_table()
        mesh.verts[random.integers(len(mesh.verts))].co.z += random.normal() * 0.3
        bmesh.update_edit_mesh(obj.data)
        follow(live)
        after = uv_of(obj)
        changed = (after != before).any(axis=(1, 2))
        assert live.live.message == "" and changed.any()
        near += changed.sum() < 60
        x, y = np.moveaxis(after, -1, 0)
        assert ((x[:, 2] - x[:, 0]) * (y[:, 3] - y[:, 1]) > (x[:, 3] - x[:, 1]) * (y[:, 2] - y[:, 0])).all()
    assert near > 8


def test_a_cut_and_a_moved_pin_in_a_large_island_move_what_is_near(addon, live, monkeypatch):
    for name in ("LARGE", "PATCH"):
        monkeypatch.setattr(addon("maps.live"), name, 30)
    settings = bpy.context.scene.koebe_uv
    settings.keep_angles, settings.even = False, 0.5
    obj = live_sheet(live)
    monkeypatch.delattr(addon("jobs.live_job").LiveJob, "_anew")  # no map of a whole island
    states = [uv_of(obj)]
    mesh = bmesh.from_edit_mesh(obj.data)
    layer = mesh.loops.layers.uv["Koebe"]
    for edge in mesh.edges:  # from the border inwards
        edge.seam |= all(vertex.index // 13 == 3 and vertex.index % 13 <= 2 for vertex in edge.verts)
    bmesh.update_edit_mesh(obj.data)
    follow(live)
    states.append(uv_of(obj))
    assert cuts(states[1])[2] > 1
    mesh.verts.ensure_lookup_table()
    for vertex in (0, 12, 5 * 13 + 12, 2 * 13 + 8):  # the last one is dragged
        for corner in mesh.verts[vertex].link_loops:
            corner[layer].pin_uv = True
    follow(live)  # they are where they were: nothing to do
    assert np.array_equal(uv_of(obj), states[1])
    width = np.ptp(states[1][:72].reshape(-1, 2), axis=0).max()
    for corner in mesh.verts[2 * 13 + 8].link_loops:
        corner[layer].uv.x += 0.02 * width
    bmesh.update_edit_mesh(obj.data)
    placed = uv_of(obj)
    follow(live)
    states.append(uv_of(obj))
    assert live.live.message == ""
    for before, after in zip([states[0], placed], states[1:]):
        changed = (after != before).any(axis=(1, 2))
        assert 5 < changed.sum() < 70 and not changed[72:].any()


def warm_and_cold(addon, live, monkeypatch, change):
    """The UVs of the edited sheet after a change, as Live has them from where they were, and mapped anew."""
    found = []
    settings = bpy.context.scene.koebe_uv
    settings.keep_angles, settings.even = False, 0.5  # else a new map looks for an E of its own
    for is_warm in (True, False):
        obj = live_sheet(live)
        change(obj)
        job = addon("jobs.live_job")
        with monkeypatch.context() as patch:
            other = (job.LiveJob, "_anew") if is_warm else (job, "follow")
            patch.setattr(*other, lambda *_: None)  # which would be an error, or lead to a new map
            follow(live)
        assert live.live.message == ""
        found.append(uv_of(obj))
        bpy.context.window_manager.koebe_live = False
        bpy.ops.object.mode_set(mode="OBJECT")
        bpy.data.objects.remove(obj)
    return found


def pinned(obj):
    """Four pins, of which two are moved, so that the island bends."""
    mesh = bmesh.from_edit_mesh(obj.data)
    layer = mesh.loops.layers.uv["Koebe"]
    mesh.verts.ensure_lookup_table()
    for vertex, way in ((0, 0.02), (12, 0.0), (5 * 13, 0.0), (3 * 13 + 6, 0.01)):
        for corner in mesh.verts[vertex].link_loops:
            corner[layer].pin_uv = True
            corner[layer].uv = corner[layer].uv[0] + way, corner[layer].uv[1]
    bmesh.update_edit_mesh(obj.data)


@pytest.mark.parametrize("change, far", [(lambda obj: mark(obj, 3, True), 0.002), (pinned, 0.01)])
def test_what_follows_is_the_map_that_a_new_one_would_be(addon, live, monkeypatch, change, far):
    warm, cold = warm_and_cold(addon, live, monkeypatch, change)
    assert np.abs(warm - cold).max() < far * np.ptp(cold.reshape(-1, 2), axis=0).max()


def test_random_seams_and_pins_leave_islands_one_to_one(live):
    """Each island is one to one after each change, pins are where they were set, and other islands stay."""
    random = np.random.default_rng(3)
    obj = live_sheet(live, (4, 8))
    followed = 0
    for _ in range(25):
        mesh = bmesh.from_edit_mesh(obj.data)
        layer = mesh.loops.layers.uv["Koebe"]
        before = uv_of(obj)
        mesh.edges.ensure_lookup_table()
        mesh.verts.ensure_lookup_table()
        edge, vertex = mesh.edges[random.integers(len(mesh.edges))], mesh.verts[random.integers(len(mesh.verts))]
        if random.random() < 0.5:
            for other in (edge, *(one for vert in edge.verts for one in vert.link_edges)):
                other.seam = bool(random.random() < 0.8)
        else:
            way = random.normal(size=2) * 0.003
            for corner in vertex.link_loops:
                corner[layer].pin_uv = True
                corner[layer].uv = corner[layer].uv[0] + way[0], corner[layer].uv[1] + way[1]
        bmesh.update_edit_mesh(obj.data)
        asked = uv_of(obj)
        follow(live)
        after = uv_of(obj)
        if live.live.message:
            assert np.array_equal(after, asked)
            for face in mesh.faces:
                for corner in face.loops:
                    corner[layer].pin_uv = False
            bmesh.update_edit_mesh(obj.data)
            follow(live)
            continue
        followed += not np.array_equal(after, before)
        x, y = np.moveaxis(after, -1, 0)
        for a, b, c in ((0, 1, 2), (0, 2, 3)):
            area = (x[:, b] - x[:, a]) * (y[:, c] - y[:, a]) - (x[:, c] - x[:, a]) * (y[:, b] - y[:, a])
            other = (x[:, 1] - x[:, 0]) * (y[:, 3] - y[:, 0]) - (x[:, 3] - x[:, 0]) * (y[:, 1] - y[:, 0])
            assert ((area > 0) | (other > 0)).all()  # whichever way Blender cuts a quadrilateral
        pins = np.array([[corner[layer].pin_uv for corner in face.loops] for face in mesh.faces])
        assert np.array_equal(after[pins], asked[pins])
    assert followed > 12


def test_what_cannot_be_mapped_is_told_and_stays(live):
    obj = live_sheet(live)
    mesh = bmesh.from_edit_mesh(obj.data)
    layer = mesh.loops.layers.uv["Koebe"]
    mesh.faces.ensure_lookup_table()
    places = [(0.0, 0.0), (0.0, 0.1), (0.1, 0.1), (0.1, 0.0)]  # the wrong way round
    for vertex, place in zip(list(mesh.faces[40].verts), places):
        for corner in vertex.link_loops:
            corner[layer].pin_uv = True
            corner[layer].uv = place
    bmesh.update_edit_mesh(obj.data)
    before = uv_of(obj)
    follow(live)
    assert "pins turn faces over" in live.live.message and np.array_equal(uv_of(obj), before)


def test_no_handler_is_left(live):
    counts = [len(handlers) for handlers, _ in live.HANDLERS]
    bpy.context.window_manager.koebe_live = True
    assert [len(handlers) for handlers, _ in live.HANDLERS] == [count + 1 for count in counts]
    bpy.context.window_manager.koebe_live = False
    assert [len(handlers) for handlers, _ in live.HANDLERS] == counts


def test_it_gives_up_and_says_so(live, addon, monkeypatch):
    obj = live_sheet(live)
    job = addon("jobs.live_job")
    compute = job.LiveJob._compute

    def slow(self, progress):
        while not self._late:
            sum(range(1000))
        compute(self, progress)

    monkeypatch.setattr(job, "LONGEST", 0.05)
    monkeypatch.setattr(job.LiveJob, "_compute", slow)
    before = uv_of(obj)
    mark(obj, 3, True)
    follow(live)
    assert "its islands did not follow within 0 s: go in smaller steps" in live.live.message
    assert np.array_equal(uv_of(obj), before)
    monkeypatch.undo()
    mark(obj, 9, True)
    follow(live)
    assert live.live.message == ""
