"""What an artist does: panel, button, menu, redo panel, undo, UV Editor. The pictures are for eyes: out/gui/."""

import time

UVS = "[layer.name for layer in bpy.context.view_layer.objects.active.data.uv_layers]"
ISLANDS = "[(i.object_name, i.mapped, len(i.loops)) for i in bpy.context.window_manager.koebe_uv.islands]"
DONE = "not heart.computing and len(bpy.context.window_manager.koebe_uv.islands) > 0"
LAST = "bpy.context.window_manager.operators[-1]"
WORN = "len(bpy.context.view_layer.objects.active.material_slots)"


def run_from_panel(window, area="VIEW_3D", shape="DISK"):
    """Click the button of the panel and wait for the end."""
    window.run("bpy.context.window_manager.koebe_uv.islands.clear()")
    window.choose(shape=shape)
    window.click(*window.find_button(area, "koebe_unwrap"))
    window.wait(DONE)


def test_panel_button_undo_and_redo(window, open_sample):
    open_sample("face_five_holes")
    window.picture("01_panel")
    run_from_panel(window)
    window.picture("02_mapped")
    assert window.ask(UVS) == ["Koebe"]
    assert window.ask(ISLANDS) == [["face_five_holes", True, 6]]
    window.move(*window.middle("VIEW_3D"))
    window.key("ctrl+z")
    window.picture("03_undone")
    assert window.ask(UVS) == []
    window.key("ctrl+shift+z")
    assert window.ask(UVS) == ["Koebe"]


def test_the_redo_panel_runs_again_with_other_options(window, open_sample):
    open_sample("suzanne_mask")
    run_from_panel(window)
    x, top, _, height = window.region("VIEW_3D", "WINDOW")
    window.click(x + 130, top + height - 15)  # its folded title
    window.picture("04_redo_panel")
    before = window.ask(WORN)
    window.click(x + 196, top + height - 43)  # Checker
    time.sleep(1.0)
    window.picture("05_redone")
    assert window.ask(LAST + ".checker") is False
    assert (before, window.ask(WORN)) == (1, 0)


def test_checker_and_distortion(window, open_sample):
    open_sample("suzanne_mask")
    run_from_panel(window)
    assert window.ask("bpy.context.active_object.material_slots[0].name") == "Koebe Checker"
    window.click(*window.find_button("VIEW_3D", "koebe_checker"))
    window.picture("06_checker_off")
    assert window.ask("len(bpy.context.active_object.material_slots)") == 0
    _, y = window.find_button("VIEW_3D", "koebe_distortion", fraction=0.42)
    left, _, width, _ = window.region("VIEW_3D", "UI")
    angle, area, off = (left + int(width * fraction) for fraction in (0.42, 0.57, 0.76))
    window.click(angle, y)
    window.picture("07_angle")
    window.click(area, y)
    window.move(*window.middle("VIEW_3D"))  # away from the button, whose tooltip would cover the report
    window.picture("08_area")
    assert window.ask("bpy.context.active_object.data['koebe_distortion']['kind']") == "area"
    assert window.ask("[a.name for a in bpy.context.active_object.data.color_attributes]") == ["Koebe Distortion"]
    window.click(off, y)
    assert window.ask("len(bpy.context.active_object.data.color_attributes)") == 0


def test_u_menu_in_edit_mode_and_the_uv_editor(window, open_sample):
    open_sample("face_five_holes")
    window.workspace("UV Editing")
    window.move(*window.middle("VIEW_3D"))
    if window.ask("bpy.context.view_layer.objects.active.mode") != "EDIT":
        window.key("Tab")
    window.key("KP_1", "KP_Decimal", "a", "u")
    window.picture("09_u_menu")
    window.key("k")  # the letter that the menu underlines
    window.picture("09_koebe_menu")
    window.key("d")  # Disk
    window.wait(DONE)
    window.open_tab("IMAGE_EDITOR")
    window.move(*window.middle("IMAGE_EDITOR"))
    window.key("Home")
    window.picture("10_uv_editor")
    assert window.ask("bpy.context.view_layer.objects.active.mode") == "EDIT"
    window.key("n", "Home")  # the panel would lie over the disk
    window.press("uv.koebe_select_loop", loop=1)
    window.picture("11_loop_selected")
    data = "bpy.context.view_layer.objects.active.data"
    assert window.ask(f"{data}.total_edge_sel == {data}.total_vert_sel > 10")
    window.press("mesh.koebe_fill_holes", which="selected")
    window.picture("12_filled")
    assert window.ask(f"{data}.total_face_sel") > 10


def test_what_cannot_be_mapped_is_said_and_selected(window, open_sample):
    open_sample("bowl")
    window.choose(cut=False, shape="DISK")
    window.move(*window.middle("VIEW_3D"))
    window.key("Tab", "a")
    window.run("import bmesh\nmesh = bpy.context.view_layer.objects.active.data\nb = bmesh.from_edit_mesh(mesh)\n"
               "b.edges.ensure_lookup_table(); e = b.edges[500]; v = b.verts.new((0, 0, 2))\n"
               "b.faces.new([*e.verts, v]).select_set(True); bmesh.update_edit_mesh(mesh)")  # fmt: skip
    window.click(*window.find_button("VIEW_3D", "koebe_unwrap"))
    window.wait(DONE)
    window.picture("13_refused")
    assert window.ask(ISLANDS) == [["bowl", False, 0]]
    assert window.ask("bpy.context.view_layer.objects.active.data.total_edge_sel") == 1


def test_a_tube_unrolled(window, open_sample):
    open_sample("vase")
    window.choose(tube="unroll")
    run_from_panel(window)
    window.workspace("UV Editing")
    window.move(*window.middle("VIEW_3D"))
    if window.ask("bpy.context.view_layer.objects.active.mode") != "EDIT":
        window.key("Tab")
    window.key("KP_1", "KP_Decimal", "a")
    window.move(*window.middle("IMAGE_EDITOR"))
    if window.region("IMAGE_EDITOR", "UI")[2] > 1:
        window.key("n")
    window.key("Home")
    window.picture("14_unrolled")
    assert window.ask(ISLANDS) == [["vase", True, 2]]
    assert window.ask("bpy.context.window_manager.koebe_uv.islands[0].loops[1].uv_radius") == 0  # no circle any more


def test_the_preferences_show_the_add_on(window, open_sample):
    open_sample("suzanne_mask")
    window.run("""
import addon_utils
bpy.context.preferences.active_section = 'ADDONS'
bpy.context.window_manager.addon_search = 'Koebe'
window = bpy.context.window_manager.windows[0]
area = next(area for area in window.screen.areas if area.type == 'VIEW_3D')
area.type = 'PREFERENCES'
(module,) = (module for module in addon_utils.modules() if module.__name__.endswith('koebe_uv'))
with bpy.context.temp_override(window=window, area=area):
    bpy.ops.preferences.addon_expand(module=module.__name__)
""")
    window.settle()
    window.picture("15_preferences")
    window.run("window = bpy.context.window_manager.windows[0]\n"
               "next(area for area in window.screen.areas if area.type == 'PREFERENCES').type = 'VIEW_3D'")  # fmt: skip
    window.settle()
    assert window.ask("'koebe_uv' in bpy.context.preferences.addons[-1].module")
