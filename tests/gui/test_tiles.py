"""Unwrap to Torus Tile and Unwrap to Cylinder, by their buttons, and the button that helps where there is no handle."""

from window import DONE, ENTRY, only

MODEL = only("primitive_torus_add(major_segments=48, minor_segments=24, major_radius=1.0, minor_radius=0.45)")
TUBE = only('primitive_cylinder_add(vertices=48, depth=2.5, end_fill_type="NOTHING")',
            'obj.modifiers.new("Finer", "SUBSURF").levels = 2', 'obj.modifiers["Finer"].subdivision_type = "SIMPLE"',
            'bpy.ops.object.modifier_apply(modifier="Finer")')  # fmt: skip


def test_a_torus_by_its_button(window):
    window.prepare(MODEL)
    window.open_part("domains")
    window.picture("70_other_domains")
    window.click(*window.find_button("VIEW_3D", "shape='TORUS'"))
    window.wait(DONE, 240.0)
    window.show_textures()
    window.picture_of_uvs("71_torus")
    assert window.ask(f"[{ENTRY}.domain, {ENTRY}.mapped, {ENTRY}.flipped]") == ["torus", True, 0]
    window.undo()


def test_a_tube_is_no_torus_and_the_report_has_the_button(window):
    window.prepare(TUBE)
    assert window.follow_offer("torus", "ring", "72_no_torus") == "ring"
    window.picture_of_uvs("73_cylinder")
    assert window.ask(f"[{ENTRY}.mapped, {ENTRY}.flipped, len({ENTRY}.loops)]") == [True, 0, 2]
