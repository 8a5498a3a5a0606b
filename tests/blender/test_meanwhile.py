"""What happens to the objects between reading and writing, as a script, a timer or another window could do."""

import bpy
import fingerprint
import numpy as np
import pytest
import scenes
import states
from mathutils import Matrix


@pytest.fixture
def meanwhile(addon, monkeypatch):
    """A function: what it is given happens when the computation has ended."""

    def arrange(module, act):
        kind = getattr(addon(module), {"jobs.map_job": "Job", "jobs.shape_jobs": "CarryJob"}[module])
        compute = kind.compute

        def both(self, progress=None):
            compute(self, progress)
            act()

        monkeypatch.setattr(kind, "compute", both)

    return arrange


def turn_faces(obj):
    obj.data.flip_normals()


def move_a_vertex(obj):
    obj.data.vertices[3].co.x += 0.1


def remove_a_face(obj):
    scenes.select_faces(obj, [5])
    bpy.ops.mesh.delete(type="FACE")
    bpy.ops.object.mode_set(mode="OBJECT")


def give_it_another_mesh(obj):
    other = scenes.add_panel("Somebody", size=14)
    obj.data = other.data
    bpy.data.objects.remove(other)


def fill_its_layers(obj):
    for index in range(8):
        obj.data.uv_layers.new(name=f"Layer {index}")


CHANGES = {
    "turned": (turn_faces, "changed during the run"), "moved": (move_a_vertex, "changed during the run"),
    "fewer faces": (remove_a_face, "changed during the run"),
    "another mesh": (give_it_another_mesh, "changed during the run"), "layers": (fill_its_layers, "8 UV layers"),
    "deleted": (lambda obj: bpy.data.objects.remove(obj), "deleted or renamed"),
    "renamed": (lambda obj: setattr(obj, "name", "Else"), "deleted or renamed"),
}  # fmt: skip


def two():
    objects = states.plain("Changed"), states.plain("Left alone")
    states.consistent(objects)
    scenes.select(*objects)
    return objects


@pytest.mark.parametrize("change", CHANGES)
def test_it_is_said_and_the_others_are_done(meanwhile, change):
    act, words = CHANGES[change]
    changed, other = two()
    states_then = []

    def happen():
        act(bpy.data.objects["Changed"])
        states_then.append(fingerprint.fingerprint())

    meanwhile("jobs.map_job", happen)
    assert bpy.ops.uv.koebe_uniformize() == {"FINISHED"}
    after = fingerprint.fingerprint()
    scenes.assert_circle_domain(other)
    told = {entry.object_name: entry for entry in bpy.context.window_manager.koebe_uv.islands}
    assert words in told["Changed"].message and not told["Changed"].mapped and told["Left alone"].mapped
    differing = fingerprint.differences(states_then[0], after)
    assert all("Left alone" in name or "Koebe" in name or "materials" in name or name == "file: report"
               for name in differing), differing  # fmt: skip


@pytest.mark.parametrize("change", CHANGES)
def test_alone_it_is_an_error_and_nothing_is_written(meanwhile, change):
    act, words = CHANGES[change]
    changed, other = two()
    scenes.select(changed)
    states_then = []

    def happen():
        act(bpy.data.objects["Changed"])
        states_then.append(fingerprint.fingerprint())

    meanwhile("jobs.map_job", happen)
    with pytest.raises(RuntimeError, match=f"Changed: .*{words}"):
        bpy.ops.uv.koebe_uniformize()
    assert fingerprint.differences(states_then[0], fingerprint.fingerprint()) == ["file: report"]


@pytest.mark.parametrize("change", CHANGES)
@pytest.mark.parametrize("who", ["Source", "Changed"])
def test_a_texture_is_carried_to_the_others(meanwhile, change, who):
    """What happens to the source after it was read does not matter."""
    act, words = CHANGES[change]
    source = states.plain("Source")
    scenes.select(source)
    bpy.ops.uv.koebe_uniformize(outer="longest")
    changed, other = two()
    scenes.select(source, changed, other)
    meanwhile("jobs.shape_jobs", lambda: act(bpy.data.objects[who]))
    assert bpy.ops.uv.koebe_carry_texture() == {"FINISHED"}
    assert "Koebe" in other.data.uv_layers
    carried = [entry.name for entry in bpy.context.window_manager.koebe_shapes.carried]
    assert carried == (["Changed", "Left alone"] if who == "Source" else ["Left alone"])


def test_in_edit_mode_too(meanwhile):
    changed, other = two()
    scenes.edit_all()

    def happen():
        bpy.ops.mesh.select_all(action="SELECT")
        bpy.ops.mesh.flip_normals()

    meanwhile("jobs.map_job", happen)
    with pytest.raises(RuntimeError, match="Changed: .*changed during the run"):
        bpy.ops.uv.koebe_uniformize()
    assert bpy.context.mode == "EDIT_MESH" and len(changed.data.uv_layers) == len(other.data.uv_layers) == 0


def test_what_nobody_foresaw_is_that_of_one_object(addon, monkeypatch):
    """An error in the middle of one object's computation."""
    changed, other = two()
    changed.data.transform(Matrix.Translation((0.0, 0.0, 10.0)))  # islands come side by side, in no order
    shape = addon("maps.mapping").upright_turn

    def broken(island, uv):
        if island.vertices[:, 2].min() > 5.0:
            raise ZeroDivisionError("out of the blue")
        return shape(island, uv)

    monkeypatch.setattr(addon("maps.mapping"), "upright_turn", broken)
    assert bpy.ops.uv.koebe_uniformize() == {"FINISHED"}
    told = {entry.object_name: entry for entry in bpy.context.window_manager.koebe_uv.islands}
    assert "out of the blue" in told["Changed"].message and told["Left alone"].mapped
    assert len(changed.data.uv_layers) == 0 and "Koebe" in other.data.uv_layers


def test_a_place_that_is_no_number_is_not_taken_for_a_change():
    obj = states.twins()[0]  # two islands
    obj.data.vertices[np.argmax([v.co.x for v in obj.data.vertices])].co.z = np.nan
    scenes.select(obj)
    assert bpy.ops.uv.koebe_uniformize() == {"FINISHED"}
    assert [entry.mapped for entry in bpy.context.window_manager.koebe_uv.islands].count(True) == 1
