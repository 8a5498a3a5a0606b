"""The samples that are kept with the project: each becomes the circle domain that is declared beside it."""

import json
from pathlib import Path

import bpy
import pytest
import scenes

FOLDER = Path(__file__).resolve().parents[2] / "blend_samples"
EXPECTED = json.loads((FOLDER / "expected.json").read_text(encoding="utf-8"))["samples"]
KEPT = [name for name, expected in EXPECTED.items() if not expected["dense"]]


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
