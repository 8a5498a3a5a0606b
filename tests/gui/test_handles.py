"""Unwrap Pretzel by its button, offered where a torus tile refuses two handles."""

from window import ENTRY

PLATE = """
import numpy as np
for obj in list(bpy.data.objects): bpy.data.objects.remove(obj)
cells = [(i, j) for i in range(11) for j in range(7) if (i, j) not in ((3, 3), (7, 3))]
at = lambda i, j: 8 * i + j
points = [(i / 3 - 2, j / 3 - 1, 0.0) for i in range(12) for j in range(8)]
mesh = bpy.data.meshes.new("Plate")
mesh.from_pydata(points, [], [(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)) for i, j in cells])
obj = bpy.data.objects.new("Plate", mesh)
bpy.context.collection.objects.link(obj)
bpy.context.view_layer.objects.active = obj
obj.select_set(True)
obj.modifiers.new("Thick", "SOLIDIFY").thickness = 0.5
obj.modifiers.new("Finer", "SUBSURF").levels = 2
for name in ("Thick", "Finer"):
    bpy.ops.object.modifier_apply(modifier=name)
bpy.ops.object.shade_smooth()
"""


def test_two_handles_by_the_button_that_the_report_offers(window):
    window.prepare(PLATE)
    assert window.follow_offer("torus", "schottky", "85_two_handles_refused") == "schottky parts"
    window.show_textures()
    window.picture_of_uvs("86_handles")
    assert window.ask(f"[{ENTRY}.mapped, {ENTRY}.converged, {ENTRY}.handles, {ENTRY}.flipped]") == [True, True, 2, 0]
