"""Parts, which Automatic takes, by the button on a closed model: the checker on it and the parts in the UV Editor."""

from window import only

MODEL = only("primitive_monkey_add()",
             'obj.modifiers.new("Smooth", "SUBSURF").levels = 2',
             'bpy.ops.object.modifier_apply(modifier="Smooth")')  # fmt: skip


def test_the_button_cuts_a_model_into_parts(window):
    window.run(MODEL)
    window.workspace("UV Editing")
    window.look_at_model()
    window.click(*window.find_button("VIEW_3D", "koebe_unwrap"))
    window.wait("len(bpy.context.window_manager.koebe_uv.islands) == 1 "
                "and bpy.context.window_manager.koebe_uv.islands[0].parts > 1", 240.0)  # fmt: skip
    window.show_textures()
    window.picture_of_uvs("60_parts")
    entry = "bpy.context.window_manager.koebe_uv.islands[0]"
    assert window.ask(f"{entry}.flipped") == 0 and window.ask(f"{entry}.mapped")


def test_a_sample_in_parts_and_one_step_back(window, open_sample):
    open_sample("hand")
    window.workspace("UV Editing")
    in_edit_mode = window.ask("bpy.context.view_layer.objects.active.mode") == "EDIT"
    window.look_at_model(*["Tab"] * in_edit_mode, "KP_1", "KP_Decimal")  # the outlines are shown in Object Mode
    window.click(*window.find_button("VIEW_3D", "koebe_unwrap"))
    window.picture("61_hand_at_work")
    window.wait("len(bpy.context.window_manager.koebe_uv.islands) == 1 "
                "and bpy.context.window_manager.koebe_uv.islands[0].parts > 5", 240.0)  # fmt: skip
    window.move(*window.middle("IMAGE_EDITOR"))
    window.key("Home")
    window.show_textures()
    window.picture("62_hand_in_parts")
    entry = "bpy.context.window_manager.koebe_uv.islands[0]"
    assert window.ask(f"{entry}.flipped") == 0 and window.ask(f"{entry}.mapped")
    window.undo()
