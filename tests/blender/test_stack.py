"""Parts on each other and on UDIM tiles."""

import bpy
import numpy as np
import pytest
import scenes
from scenes import last_run

pytestmark = pytest.mark.alike


def seams_of(obj):
    return np.flatnonzero(scenes.read(obj.data.edges, "use_seam", bool))


def mirrored_sheet(n=6):
    """A bent sheet and its mirror image, which meet along a seam on the plane x = 0."""
    x, y = np.meshgrid(np.arange(-n, n + 1) / n, np.arange(n + 1) / n, indexing="ij")
    vertices = np.stack([1.5 * x, y + 0.3 * np.abs(x), 0.3 * np.abs(x) * (x * x + y)], axis=-1).reshape(-1, 3)
    corner = (np.arange(2 * n)[:, None] * (n + 1) + np.arange(n)).ravel()
    quads = np.stack([corner, corner + n + 1, corner + n + 2, corner + 1], axis=-1)
    obj = scenes.add_object("Twins", vertices, quads)
    for edge in obj.data.edges:
        edge.use_seam = all(abs(obj.data.vertices[v].co.x) < 1e-6 for v in edge.vertices)
    scenes.select(obj)
    return obj


@pytest.mark.parametrize("stack", [False, True])
def test_mirrored_twins_lie_on_each_other_and_their_fold_stays_a_cut(stack):
    obj = mirrored_sheet()
    seams = seams_of(obj)
    run = {"checker": False, "seams": "only", "darts": 0.0, "write_seams": True}
    assert bpy.ops.uv.koebe_parts(stack=True, stack_mirrored=stack, **run) == {"FINISHED"}
    assert last_run().parts == 2 and last_run().flipped == 0
    areas = scenes.signed_areas(obj.data, "Koebe")
    assert (np.sign(areas) > 0).mean() == (0.5 if stack else 1.0)
    assert last_run().coverage == pytest.approx(np.abs(areas).sum() * (0.5 if stack else 1.0), rel=1e-4)
    assert (seams_of(obj) == seams).all()


def test_parts_on_tiles():
    obj = scenes.add_panel(size=16)
    copies = [obj, scenes.add_panel("Other", size=12)]
    scenes.select(*copies)
    bpy.ops.object.join()
    joined = bpy.context.view_layer.objects.active
    assert bpy.ops.uv.koebe_parts(checker=False, tiles=2, darts=0.0) == {"FINISHED"}
    uv = scenes.corner_uv(joined.data, "Koebe")
    assert uv[:, 0].max() > 1.0 and uv[:, 0].max() <= 2.0 and uv[:, 1].max() <= 1.0 and uv.min() >= 0.0
    with pytest.raises(RuntimeError, match="0 needs a texel density"):
        bpy.ops.uv.koebe_parts(checker=False, tiles=0)
    assert bpy.ops.uv.koebe_parts(checker=False, tiles=0, texels="number", density=900.0, darts=0.0) == {"FINISHED"}
    assert scenes.corner_uv(joined.data, "Koebe")[:, 0].max() > 1.0
