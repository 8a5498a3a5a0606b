"""Enabled, disabled and enabled again: everything is there, nothing is left behind."""

import importlib

import addon_utils
import bpy
import processes
import pytest


def registered():
    """What the add-on shows to Blender."""
    return (
        hasattr(bpy.types, "UV_OT_koebe_unwrap"),
        hasattr(bpy.types, "KOEBE_MT_unwrap"),
        hasattr(bpy.types, "VIEW3D_PT_koebe"),
        hasattr(bpy.types, "IMAGE_PT_koebe"),
        hasattr(bpy.types.Scene, "koebe_uv"),
        sum(f.__name__ == "draw_menu" for f in bpy.types.VIEW3D_MT_uv_map._dyn_ui_initialize()),
        sum(f.__name__ == "draw_menu" for f in bpy.types.IMAGE_MT_uvs._dyn_ui_initialize()),
    )


def test_it_is_enabled_with_panels_and_menu_entries():
    assert registered() == (True, True, True, True, True, 1, 1)


def test_disabling_leaves_nothing_behind(addon_name):
    addon_utils.disable(addon_name)
    try:
        assert registered() == (False, False, False, False, False, 0, 0)
    finally:
        addon_utils.enable(addon_name)
    assert registered() == (True, True, True, True, True, 1, 1)


@pytest.mark.skipif(not bpy.app.binary_path, reason="the module bpy enables no add-ons by itself")
def test_a_blender_that_starts_with_it_enabled_says_nothing(tmp_path):
    """It is enabled before there are key maps."""
    script = tmp_path / "look.py"
    script.write_text("import bpy\nbpy.ops.uv.koebe_moebius.get_rna_type()\nprint('registered')\n")
    code, out, err = processes.finish(processes.start(script, tmp_path))
    assert code == 0 and "registered" in out and "Traceback" not in out + err


def test_the_tool_comes_and_goes(addon, addon_name):
    tools = importlib.import_module("bl_ui.space_toolsystem_toolbar").IMAGE_PT_tools_active._tools["UV"]
    count = len(tools)
    here = hasattr(addon("ui.circle_tool").CirclesTool, "_bl_tool")
    assert here == (bpy.context.window_manager.keyconfigs.addon is not None)
    addon_utils.disable(addon_name)
    assert len(tools) == count - 2 * here  # and its separator
    addon_utils.enable(addon_name)
    assert len(tools) == count


def test_panels_are_where_artists_look():
    for panel, editor in ((bpy.types.VIEW3D_PT_koebe, "VIEW_3D"), (bpy.types.IMAGE_PT_koebe, "IMAGE_EDITOR")):
        assert (panel.bl_label, panel.bl_category) == ("Koebe UV", "Koebe")
        assert (panel.bl_space_type, panel.bl_region_type) == (editor, "UI")


def test_everything_an_artist_meets_has_a_tooltip_that_teaches():
    types = [bpy.ops.uv.koebe_unwrap.get_rna_type(), bpy.ops.uv.koebe_uniformize.get_rna_type(),
             bpy.ops.uv.koebe_checker.get_rna_type(), bpy.ops.uv.koebe_select_loop.get_rna_type(),
             bpy.types.Scene.bl_rna.properties["koebe_uv"].fixed_type]  # fmt: skip
    for owner in types:
        for prop in owner.properties:
            if prop.identifier in {"rna_type", "name"}:
                continue
            assert len(prop.description) > 20, f"{owner.identifier}.{prop.identifier}"
            if prop.type == "ENUM":
                assert all(len(item.description) > 20 for item in prop.enum_items)


def test_tooltips_are_whole_and_without_line_breaks():
    """Blender cuts off what is longer, and shows line breaks where they are."""
    names = [name for name in dir(bpy.types) if "_OT_koebe_" in name]
    assert len(names) > 15
    for name in names:
        space, _, end = name.lower().partition("_ot_")
        shown = getattr(getattr(bpy.ops, space), end).get_rna_type().description
        assert shown == " ".join(getattr(bpy.types, name).__doc__.split()), name


def test_the_operators_defaults_are_the_panels_and_the_batchs(addon):
    options = addon("maps.options").Options()
    operator = bpy.ops.uv.koebe_uniformize.get_rna_type().properties
    settings = bpy.context.scene.koebe_uv
    for name in addon("state.option_properties").OPTION_NAMES:
        default = operator[name].default
        assert getattr(settings, name) == default
        expected = getattr(options, name)
        assert abs(default - expected) < 1e-6 if isinstance(expected, float) else default == expected
