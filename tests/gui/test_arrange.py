"""Islands are arranged by the mouse in the UV Editor: aligned, sorted, and taken to the rectangles of a trim sheet."""

ISLANDS = """
for obj in list(bpy.data.objects): bpy.data.objects.remove(obj)
bpy.ops.mesh.primitive_cube_add()
obj = bpy.context.object
layer = obj.data.uv_layers.active
for face in obj.data.polygons:
    k = face.index
    for place, loop in zip(((0, 0), (1, 0), (1, 1), (0, 1)), face.loop_indices):
        size = (0.05 + 0.02 * k, 0.05 + 0.03 * (5 - k))
        layer.data[loop].uv = (0.04 + 0.15 * k + size[0] * place[0], 0.1 + 0.15 * (k % 3) + size[1] * place[1])
bpy.ops.object.mode_set(mode="EDIT")
bpy.ops.mesh.select_all(action="SELECT")
"""
BOXES = """
import bmesh
mesh = bmesh.from_edit_mesh(bpy.context.view_layer.objects.active.data)
layer = mesh.loops.layers.uv.active
result = []
for face in mesh.faces:
    us, vs = zip(*(tuple(corner[layer].uv) for corner in face.loops))
    result.append([min(us), min(vs), max(us), max(vs)])
"""


ROWS = "[(trim.name, [*trim.lower, *trim.upper]) for trim in bpy.context.scene.koebe_trims.items]"


def press(window, text, fraction=0.5):
    """Click the button with this Python command."""
    window.click(*window.find_button("IMAGE_EDITOR", text, fraction))
    window.settle()


def test_islands_are_aligned_and_sorted_and_undone(window):
    window.prepare(ISLANDS)
    window.open_tab("IMAGE_EDITOR")
    window.open_part("arrange", "IMAGE_EDITOR")
    window.scroll_down("IMAGE_EDITOR")
    before = window.run(BOXES)
    x, y = window.find_button("IMAGE_EDITOR", "mode='RIGHT'", 66)
    window.click(x, y)
    after = window.run(BOXES)
    assert len({round(box[2], 4) for box in after}) == 1 and len({round(box[2], 4) for box in before}) == 6
    assert [box[1] for box in after] == [box[1] for box in before]
    window.picture("90_aligned")
    window.key("ctrl+z")
    assert window.run(BOXES) == before
    press(window, "mode='SIZE'", 0.18)
    heights = [(box[2] - box[0]) * (box[3] - box[1]) for box in window.run(BOXES)]
    lefts = [box[0] for box in window.run(BOXES)]
    assert sorted(range(6), key=lambda k: lefts[k]) == sorted(range(6), key=lambda k: -heights[k])
    window.picture("91_sorted")
    window.key("ctrl+z")
    assert window.run(BOXES) == before


def test_a_grid_of_trims_takes_islands_by_the_mouse(window):
    before = window.run(BOXES)
    press(window, "action='GRID'", -48)
    assert [name for name, _ in window.ask(ROWS)] == ["A1", "A2", "A3", "A4"]
    window.scroll_down("IMAGE_EDITOR")
    window.picture("92_beside_the_trims")
    press(window, "mode='TRIM'", 0.25)
    after = window.run(BOXES)
    assert after != before
    for left, bottom, right, top in after:
        row = (bottom + top) // 0.5 / 4  # where the middle is
        assert left > -1e-5 and right < 1 + 1e-5 and bottom > row - 1e-5 and top < row + 0.25 + 1e-5
    window.move(*window.middle("IMAGE_EDITOR"))
    window.key("n", "Home")  # the panel would lie over the sheet
    window.picture("93_in_the_trims")
    window.key("n")
    window.key("ctrl+z")
    assert window.run(BOXES) == before
    window.key("ctrl+z")
    assert window.ask(ROWS) == []
