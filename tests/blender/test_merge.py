"""Merge by distance in the UVs only."""

import bpy
import numpy as np
import pytest
import scenes
from touched import only_uvs_change


def soup(n=8):
    """A wavy panel with a hole, each quadrilateral with vertices of its own."""
    t = np.linspace(0.0, 1.0, n + 1)
    x, y = (a.ravel() for a in np.meshgrid(t, t))
    corner = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).ravel()
    quads = np.stack([corner, corner + 1, corner + n + 2, corner + n + 1], axis=1)
    points = np.stack([x, y, 0.1 * np.sin(3.0 * x)], axis=1)
    quads = quads[np.linalg.norm(points[quads, :2].mean(axis=1) - 0.5, axis=1) > 0.2]
    mesh = bpy.data.meshes.new("Soup")
    mesh.from_pydata(points[quads.ravel()].tolist(), [], np.arange(quads.size).reshape(-1, 4).tolist())
    obj = bpy.data.objects.new("Soup", mesh)
    bpy.context.scene.collection.objects.link(obj)
    scenes.select(obj)
    return obj, quads


def places_of_points(obj, quads):
    """The UVs that the corners at each point have."""
    uv = np.zeros(2 * quads.size, np.float32)
    obj.data.uv_layers["Koebe"].data.foreach_get("uv", uv)
    found = {}
    for point, place in zip(quads.ravel(), uv.reshape(-1, 2), strict=True):
        found.setdefault(point, set()).add(tuple(place))
    return found


@pytest.mark.alike
@pytest.mark.parametrize("operator", ["koebe_uniformize", "koebe_parts", "koebe_unwrap"])
def test_loose_faces_are_one_surface_in_the_uvs_and_stay_loose_in_the_mesh(operator):
    obj, quads = soup()
    run = getattr(bpy.ops.uv, operator)
    with only_uvs_change():
        assert run(checker=False, weld=1e-4) == {"FINISHED"}
    assert all(len(places) == 1 for places in places_of_points(obj, quads).values())
    assert len(obj.data.vertices) == quads.size


@pytest.mark.alike
def test_the_report_tells_of_loose_vertices():
    obj, quads = soup()
    assert bpy.ops.uv.koebe_uniformize(checker=False) == {"FINISHED"}
    assert any(len(places) > 1 for places in places_of_points(obj, quads).values())
    rows = bpy.context.window_manager.koebe_uv.islands
    assert len(rows) == len(quads) and all("Merge Distance" in row.message for row in rows)
    assert bpy.ops.uv.koebe_uniformize(checker=False, weld=1e-4) == {"FINISHED"}
    assert "Merge Distance" not in scenes.last_run().message
