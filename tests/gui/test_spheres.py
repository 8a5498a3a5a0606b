"""Unwrap to Sphere by its button, in both layouts, and the button that helps where there is a handle."""

from test_tiles import MODEL
from window import DONE, ENTRY, only

BODY = "import math\n" + only("primitive_cube_add(size=2.0)", """
obj.modifiers.new("Finer", "SUBSURF").levels = 5
bpy.ops.object.modifier_apply(modifier="Finer")
for vertex in obj.data.vertices:
    x, y, z = vertex.co
    vertex.co = (x * (1.3 + 0.5 * math.sin(2.5 * z)), y * (1.1 + 0.4 * math.cos(2.0 * z)), 1.6 * z + 0.3 * x * x)
""")  # fmt: skip


def test_a_body_by_its_button_in_both_layouts(window):
    window.prepare(BODY)
    window.open_part("domains")
    window.settle()
    window.picture("80_sphere_button")
    for number, layout in enumerate(("equirectangular", "octahedral")):
        window.run(f"bpy.context.scene.koebe_uv.layout = '{layout}'")
        window.run("bpy.context.window_manager.koebe_uv.islands.clear()")
        window.move(*window.middle("VIEW_3D"))
        window.settle()
        window.click(*window.find_button("VIEW_3D", "shape='SPHERE'"))
        window.wait(DONE, 240.0)
        window.show_textures()
        window.picture_of_uvs(f"8{number + 1}_{layout}")
        assert window.ask(f"[{ENTRY}.domain, {ENTRY}.layout, {ENTRY}.mapped, {ENTRY}.converged]") == [
            "sphere", layout, True, True
        ]
        assert window.ask(f"{ENTRY}.flipped") <= (2 if layout == "equirectangular" else 0)  # beside a pole
    window.undo(times=2)


def test_a_torus_is_no_sphere_and_the_report_has_the_button(window):
    window.prepare(MODEL)
    assert window.follow_offer("sphere", "torus", "83_no_sphere") == "torus"
    assert window.ask(f"[{ENTRY}.mapped, {ENTRY}.flipped]") == [True, 0]
