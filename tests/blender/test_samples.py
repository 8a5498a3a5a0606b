"""The samples that are kept with the project: each becomes the circle domain, or the parts, declared beside it."""

import json
from pathlib import Path

import bpy
import numpy as np
import pytest
import scenes

pytestmark = pytest.mark.alike

FOLDER = Path(__file__).resolve().parents[2] / "blend_samples"
EXPECTED = json.loads((FOLDER / "expected.json").read_text(encoding="utf-8"))["samples"]
KEPT = [name for name, expected in EXPECTED.items() if not expected["dense"] and "max_parts" not in expected]
IN_PARTS = [name for name, expected in EXPECTED.items() if "max_parts" in expected]


@pytest.mark.parametrize("name", KEPT)
def test_it_becomes_a_circle_domain_and_its_mesh_stays(name):
    bpy.ops.wm.open_mainfile(filepath=str(FOLDER / f"{name}.blend"))
    obj = bpy.data.objects[name]
    scenes.select(obj)
    materials = list(obj.data.materials)
    before = scenes.mesh_state(obj.data, but_layer="Koebe")
    assert bpy.ops.uv.koebe_uniformize() == {"FINISHED"}
    assert scenes.mesh_state(obj.data, but_layer="Koebe") == before
    assert list(obj.data.materials)[: len(materials)] == materials
    scenes.assert_circle_domain(obj, holes=EXPECTED[name]["loops"] - 1)


@pytest.mark.parametrize("name", IN_PARTS)
def test_it_is_unwrapped_to_parts_and_its_mesh_stays(name):
    expected = EXPECTED[name]
    bpy.ops.wm.open_mainfile(filepath=str(FOLDER / f"{name}.blend"))
    obj = bpy.data.objects[name]
    scenes.select(obj)
    before = scenes.mesh_state(obj.data, but_layer="Koebe")
    assert bpy.ops.uv.koebe_parts() == {"FINISHED"}
    assert scenes.mesh_state(obj.data, but_layer="Koebe") == before
    entry = bpy.context.window_manager.koebe_uv.islands[0]
    assert entry.mapped and entry.flipped == expected["flipped"] and 1 < entry.parts <= expected["max_parts"]
    uv = np.empty(2 * len(obj.data.loops), np.float32)
    obj.data.uv_layers["Koebe"].data.foreach_get("uv", uv)
    assert uv.min() >= 0.0 and uv.max() <= 1.0
