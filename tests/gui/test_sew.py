"""Sew and Live by hand: a cut is closed by a button, and seams that are marked and cleared are followed at once."""

from window import in_view

SHEET = """
for obj in list(bpy.data.objects): bpy.data.objects.remove(obj)
bpy.ops.mesh.primitive_grid_add(x_subdivisions=12, y_subdivisions=12)
obj = bpy.context.object
while obj.data.uv_layers: obj.data.uv_layers.remove(obj.data.uv_layers[0])
for vertex in obj.data.vertices: vertex.co.z = 0.5 * vertex.co.x ** 2 + 0.3 * vertex.co.x * vertex.co.y
for edge in obj.data.edges: edge.use_seam = all(abs(obj.data.vertices[v].co.x - 1 / 3) < 0.01 for v in edge.vertices)
bpy.ops.uv.koebe_parts(seams="only", checker=False)
bpy.context.window_manager.koebe_uv.islands.clear()
"""
EDIT = """
bpy.ops.object.mode_set(mode="EDIT")
bpy.context.tool_settings.mesh_select_mode = (False, True, False)
bpy.ops.mesh.select_all(action="DESELECT")
import bmesh
mesh = bmesh.from_edit_mesh(bpy.context.object.data)
for edge in mesh.edges: edge.select_set(edge.seam)
bmesh.update_edit_mesh(bpy.context.object.data)
bpy.ops.ed.undo_push(message="selected")
"""
PLACES = """
import bmesh
mesh = bmesh.from_edit_mesh(bpy.context.view_layer.objects.active.data)
layer = mesh.loops.layers.uv.active
result = sum(len({tuple(c[layer].uv) for c in v.link_loops}) > 1 for v in mesh.verts)
"""


def test_a_cut_is_sewn_by_the_button(window):
    window.prepare(SHEET)
    window.open_part("parts")
    window.run(in_view(EDIT))
    window.settle()
    assert window.run(PLACES) > 10
    window.scroll_down()
    window.picture("80_before_sewing")
    window.click(*window.find_button("VIEW_3D", "koebe_sew"))
    window.settle()
    window.wait("not heart.computing", 60.0)
    window.settle()
    assert window.run(PLACES) == 0
    window.picture_of_uvs("81_sewn")
    window.move(*window.middle("VIEW_3D"))
    window.key("ctrl+z")
    assert window.run(PLACES) > 10


def test_live_follows_a_seam_and_undo_goes_back(window):
    window.prepare(SHEET)
    window.run(in_view(EDIT))
    window.settle()
    before = window.run(PLACES)
    assert before > 10
    window.scroll_down()
    x, y = window.find_button("VIEW_3D", "koebe_sew")  # in the part that is open from the test before
    window.click(x, y + 22)
    window.settle()
    assert window.ask("bpy.context.window_manager.koebe_live")
    window.run(in_view("bpy.ops.mesh.mark_seam('EXEC_DEFAULT', True, clear=True)"))
    for _ in range(100):
        window.settle()
        if window.run(PLACES) == 0:
            break
    assert window.run(PLACES) == 0
    at_rest = "not next(bpy.app.timers.is_registered(m._tick) for n, m in __import__('sys').modules.items() " \
              "if n.endswith('operators.live'))"  # fmt: skip
    window.wait(at_rest, 10.0)  # looking at the mesh is no change of it
    window.picture_of_uvs("82_live")
    window.move(*window.middle("VIEW_3D"))
    window.key("ctrl+z")  # the new map
    window.settle()
    assert window.run(PLACES) == before
    window.key("ctrl+z")  # the seam
    window.settle()
    assert window.run(PLACES) == before
    window.key("ctrl+shift+z", "ctrl+shift+z")
    window.settle()
    assert window.run(PLACES) == 0
    window.run("bpy.context.window_manager.koebe_live = False")
    handlers = "[f for h in (bpy.app.handlers.depsgraph_update_post, bpy.app.handlers.undo_post) for f in h]"
    assert not window.ask(f"any('operators.live' in f.__module__ for f in {handlers})")
