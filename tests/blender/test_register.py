"""Enabled, disabled and enabled again: everything is there, nothing is left behind."""

import importlib
import re
import types
from pathlib import Path

import addon_utils
import bpy
import processes
import pytest
import scenes


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


def test_the_tools_come_and_go(addon, addon_name):
    tools = importlib.import_module("bl_ui.space_toolsystem_toolbar").IMAGE_PT_tools_active._tools["UV"]
    count = len(tools)
    here = hasattr(addon("ui.circle_tool").CirclesTool, "_bl_tool")
    assert here == (bpy.context.window_manager.keyconfigs.addon is not None)
    addon_utils.disable(addon_name)
    assert len(tools) == count - 3 * here  # two, and their separator
    addon_utils.enable(addon_name)
    assert len(tools) == count


def test_panels_are_where_artists_look():
    for panel, editor in ((bpy.types.VIEW3D_PT_koebe, "VIEW_3D"), (bpy.types.IMAGE_PT_koebe, "IMAGE_EDITOR")):
        assert (panel.bl_label, panel.bl_category) == ("Koebe UV", "Koebe")
        assert (panel.bl_space_type, panel.bl_region_type) == (editor, "UI")


def operators():
    """All operators of the add-on, by name."""
    names = [f"{space}.{name}" for space in dir(bpy.ops) for name in dir(getattr(bpy.ops, space)) if "koebe_" in name]
    return {name: getattr(getattr(bpy.ops, name.split(".")[0]), name.split(".")[1]) for name in names}


def a_curve():
    """A curve, selected and active."""
    obj = bpy.data.objects.new("Curve", bpy.data.curves.new("Curve", "CURVE"))
    bpy.context.collection.objects.link(obj)
    scenes.select(obj)


def sculpting():
    """A mapped mesh in Sculpt Mode."""
    scenes.add_panel(size=12)
    bpy.ops.uv.koebe_uniformize()
    bpy.ops.object.mode_set(mode="SCULPT")


@pytest.mark.parametrize("state", [lambda: None, a_curve, sculpting, lambda: scenes.add_panel(size=12)])
def test_an_operator_that_refuses_says_why(state):
    state()
    refused = [name for name, operator in operators().items() if not operator.poll()]
    assert refused
    for name in refused:
        with pytest.raises(RuntimeError) as raised:
            operators()[name]()
        said = str(raised.value).partition("poll() ")[2]
        assert len(said) > 10 and "context is incorrect" not in said, name


NOT_IN_MENUS = {  # operators that need a choice which only their button makes
    "uv.koebe_preset_add", "uv.koebe_select_warning", "object.koebe_show", "node.koebe_add_library",
    "node.koebe_remove_library", "uv.koebe_uniformize", "uv.koebe_parts", "uv.koebe_torus", "uv.koebe_ring",
    "uv.koebe_sphere", "uv.koebe_schottky", "uv.koebe_redo",
}  # fmt: skip


def test_the_search_finds_every_operator_in_menus(addon):
    """Blender's search (F3) looks in the menus that can be reached."""

    class Layout:
        """Notes what a menu draws."""

        def __init__(self):
            self.operators, self.words, self.menus = set(), set(), []

        def operator(self, name, text="", icon=""):
            self.words.add(text or operators()[name].get_rna_type().name)
            self.operators.add(name)
            return types.SimpleNamespace()

        def menu(self, name):
            self.menus.append(name)

        def prop(self, owner, name):
            self.words.add(owner.bl_rna.properties[name].name)

        def separator(self):
            pass

    menus, layout = addon("ui.menus"), Layout()
    for draw in menus.MENUS.values():
        draw(types.SimpleNamespace(layout=layout), bpy.context)
    drawn = set()
    while todo := set(layout.menus) - drawn:
        for name in todo:
            drawn.add(name)
            getattr(menus, name).draw(types.SimpleNamespace(layout=layout), bpy.context)
    assert drawn == {"KOEBE_MT_unwrap", "KOEBE_MT_tools"}
    assert operators().keys() - layout.operators == NOT_IN_MENUS
    for words in ("Unwrap", "Pack Only", "Use for Rendering", "Set Texel Density", "Lightmap Preset", "Fill Holes",
                  "Unwrap In Place", "Unwrap Along Seams", "Pack Beside the Rest", "Live", "Arrange: Align Left"):
        assert words in layout.words, words


def test_no_handler_is_left_after_disabling(addon, addon_name):
    """Handlers, drawing over editors, properties, key maps, and classes."""

    def left():
        handlers = [f"{name}: {function.__module__}" for name in dir(bpy.app.handlers)
                    if isinstance(getattr(bpy.app.handlers, name), list)
                    for function in getattr(bpy.app.handlers, name)
                    if getattr(function, "__module__", "").startswith(addon_name)]  # fmt: skip
        properties = [f"{owner.__name__}.{name}" for owner in (bpy.types.Scene, bpy.types.WindowManager)
                      for name in dir(owner) if name.startswith("koebe")]  # fmt: skip
        classes = [name for name in dir(bpy.types) if "koebe" in name.lower()]
        return handlers, properties, classes, list(addon("ui.drawing")._handles)

    before = left()
    assert all(before[:3])
    drawing = addon("ui.drawing")
    addon_utils.disable(addon_name)
    try:
        assert left()[:3] == ([], [], []) and not drawing._handles
    finally:
        addon_utils.enable(addon_name)
    assert left() == before


def test_each_part_of_the_panel_opens_the_guide_at_a_heading(addon, folder):
    ids = set(re.findall(r'id="([^"]*)"', Path(folder, "guide.html").read_text(encoding="utf-8")))
    panels = addon("ui.panels").CLASSES
    parts = [panel for panel in panels if issubclass(panel, bpy.types.Panel)]
    assert len(parts) == 2 * 14 and {panel.help_at for panel in parts} <= ids

    class Layout:
        """Notes the buttons that are drawn."""

        def __init__(self):
            self.urls, self.url = [], ""

        def operator(self, name, **_):
            assert name == "wm.url_open"
            self.urls.append(self)
            return self

    layout = Layout()
    addon("ui.help").draw_help(layout, "3-judge")
    assert layout.urls and layout.url == f"{Path(folder, 'guide.html').resolve().as_uri()}#3-judge"
    assert Path(folder, "troubleshooting.html").exists()


# Words that need a manual, and the words for them. Scripts use the names of options, which stay.
GONE = {"Stack Twins", "Stack Copies", "Loops", "Handles", "Caps", "Sweeps", "Truchet", "Prefer", "Period 1",
        "Unit Square", "Outer Loop", "Evenness"}  # fmt: skip


def test_labels_are_words_that_an_artist_knows():
    owners = [getattr(getattr(bpy.ops, name.split("_OT_")[0].lower()), name.split("_OT_")[1]).get_rna_type()
              for name in dir(bpy.types) if "_OT_koebe_" in name]  # fmt: skip
    owners += [bpy.types.Scene.bl_rna.properties[name].fixed_type for name in ("koebe_uv", "koebe_lift")]
    labels = {owner.name for owner in owners}
    for owner in owners:
        for prop in owner.properties:
            labels.add(prop.name)
            labels |= {item.name for item in getattr(prop, "enum_items", ())}
    assert len(labels) > 100 and not labels & GONE
    assert not any("Uniformize" in label for label in labels)


def test_buttons_and_the_guide_have_none_of_the_other_words(folder):
    sources = [path.read_text(encoding="utf-8") for path in Path(folder).rglob("*.py")]
    buttons = {text for source in sources for text in re.findall(r'\btext="([^"]+)"', source)}
    guide = (Path(__file__).resolve().parents[2] / "docs" / "guide.md").read_text(encoding="utf-8")
    labels = set(re.findall(r"\*+([^*\n]+)\*+", guide))
    assert len(buttons) > 30 and len(labels) > 50
    assert not (buttons | labels) & GONE and not any("Uniformize" in text for text in buttons | labels)


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
