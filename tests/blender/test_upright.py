"""The option "upright": which way is up in the UV Editor."""

import bpy
import numpy as np
import pytest
import scenes

pytestmark = pytest.mark.alike

AROUND, RINGS = 48, 8


def add_annulus(name="Annulus", normal=1):
    """A flat annulus around the origin, in the plane across axis 1 (standing, seen from -Y) or 2 (lying)."""
    turn = 2 * np.pi * np.arange(AROUND) / AROUND
    radius = np.linspace(0.4, 1.0, RINGS)
    x, y = (np.outer(radius, f(turn)).ravel() for f in (np.cos, np.sin))
    flat = np.zeros_like(x)
    vertices = np.stack([x, flat, y] if normal == 1 else [x, y, flat], axis=1)
    at = lambda i, j: i * AROUND + j % AROUND  # noqa: E731
    faces = [(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)) for i in range(RINGS - 1) for j in range(AROUND)]
    obj = scenes.add_object(name, vertices, faces)
    scenes.select(obj)
    return obj


def seen(obj):
    """Vertices in the world."""
    to_world = np.array(obj.matrix_world)[:3, :3]
    return scenes.read(obj.data.vertices, "co", np.float32, 3) @ to_world.T


@pytest.mark.parametrize("turn", [0.0, 0.7, 2.5, -1.6])
def test_the_worlds_up_is_up_however_the_object_is_turned(turn):
    obj = add_annulus()
    obj.rotation_euler = (0, turn, 0)
    bpy.ops.uv.koebe_uniformize()
    x, _, z = seen(obj).T
    assert np.abs(scenes.vertex_uv(obj) - 0.5 - 0.5 * np.stack([x, z], axis=1)).max() < 2e-3


def test_what_lies_flat_has_y_up():
    obj = add_annulus(normal=2)
    obj.rotation_euler = (0, 0, 1.0)
    bpy.ops.uv.koebe_uniformize()
    assert np.abs(scenes.vertex_uv(obj) - 0.5 - 0.5 * seen(obj)[:, :2]).max() < 2e-3


def test_a_mirrored_surface_is_upright_too_and_not_flipped():
    obj = add_annulus()
    obj.scale, obj.rotation_euler = (-1, 1, 1), (0, 0.7, 0)
    bpy.ops.uv.koebe_uniformize()
    x, _, z = seen(obj).T
    assert np.abs(scenes.vertex_uv(obj) - 0.5 - 0.5 * np.stack([-x, z], axis=1)).max() < 2e-3
    assert (scenes.signed_areas(obj.data, "Koebe") > 0).all()


def test_every_island_has_no_up_to_the_side():
    """Least squares: the pushed up directions, weighted with area, add up to a vector along +v."""
    obj = scenes.add_panel()
    obj.rotation_euler = (1.2, 0.3, 0.4)
    bpy.ops.uv.koebe_uniformize()
    corners, uv, total = scenes.triangles(obj.data)[0], scenes.vertex_uv(obj), np.zeros(2)
    for p, q in zip(seen(obj).astype(float)[corners], uv[corners]):
        space, plane = (p[1:] - p[0]).T, (q[1:] - q[0]).T
        up = np.linalg.lstsq(space, [0.0, 0.0, 1.0], rcond=None)[0]  # in the edges: the part in the triangle's plane
        area = 0.5 * np.linalg.norm(np.cross(*space.T))
        total += area * plane @ up * np.sqrt(area / (0.5 * abs(np.linalg.det(plane))))
    assert abs(total[0]) < 2e-3 * total[1]  # the map of a mesh is conformal up to its resolution


def test_without_it_the_map_is_as_the_native_package_computes_it(koebe):
    obj = scenes.add_panel()
    bpy.ops.uv.koebe_uniformize(upright=False)
    vertices = scenes.read(obj.data.vertices, "co", np.float32, 3)
    uv = koebe.uniformize(vertices, scenes.triangles(obj.data)[0], balance="area").uv
    used = scenes.read(obj.data.loops, "vertex_index", np.int32)
    assert np.array_equal(scenes.corner_uv(obj.data, "Koebe"), ((1 + uv) / 2).astype(np.float32)[used])


def test_the_reported_circles_are_those_of_the_uvs(addon):
    obj = scenes.add_panel()
    obj.rotation_euler = (1.2, 0.3, 0.4)
    bpy.context.view_layer.update()
    job = addon("jobs.map_job").Job([obj], addon("maps.options").Options())
    job.compute()
    job.write()
    ((entry,),) = [outcome.entries() for outcome in job.outcomes]
    for loop in entry["loops"]:
        center, radius, _ = scenes.fit_circle(scenes.vertex_uv(obj)[loop["vertices"]])
        assert (1 + np.array(loop["center"])) / 2 == pytest.approx(center, abs=1e-6)
        assert loop["radius"] / 2 == pytest.approx(radius, abs=1e-6)
