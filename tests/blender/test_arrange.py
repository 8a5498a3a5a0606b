"""Islands that are mapped already: in a line, in sorted rows, in the rectangles of a trim sheet, on mirror images."""

import bpy
import numpy as np
import pytest
import scenes
from test_pack import scattered_cube

pytestmark = pytest.mark.alike


def boxes(obj):
    """Lower and upper corners (6, 2), (6, 2) of the faces of a cube in the UVs."""
    uv = scenes.corner_uv(obj.data, "Old").reshape(6, 4, 2).astype(float)
    return uv.min(axis=1), uv.max(axis=1)


def trims():
    """The scene's trim sheet."""
    return bpy.context.scene.koebe_trims


@pytest.mark.parametrize("mode, axis, of", [
    ("LEFT", 0, lambda low, high: low), ("COLUMN", 0, lambda low, high: (low + high) / 2),
    ("RIGHT", 0, lambda low, high: high), ("TOP", 1, lambda low, high: high),
    ("ROW", 1, lambda low, high: (low + high) / 2), ("BOTTOM", 1, lambda low, high: low),
])  # fmt: skip
@pytest.mark.parametrize("in_square", [False, True])
def test_islands_come_to_one_line_and_move_along_one_axis(mode, axis, of, in_square):
    obj = scattered_cube()
    low, high = boxes(obj)
    whole = np.array([0.0, 1.0]) if in_square else np.array([low[:, axis].min(), high[:, axis].max()])
    assert bpy.ops.uv.koebe_arrange(mode=mode, in_square=in_square) == {"FINISHED"}
    after = boxes(obj)
    assert np.allclose(of(*after)[:, axis], of(*whole), atol=1e-5)
    assert np.array_equal(after[0][:, 1 - axis], low[:, 1 - axis])
    assert np.allclose(after[1] - after[0], high - low, atol=1e-5)


def rows_of(obj):
    """The faces from the top row to the bottom row, each from left to right."""
    low, high = boxes(obj)
    return [[int(k) for k in np.flatnonzero(high[:, 1] == top)[np.argsort(low[high[:, 1] == top, 0])]]
            for top in sorted(set(high[:, 1]), reverse=True)]  # fmt: skip


def test_sorted_by_size_by_material_and_by_part():
    obj = scattered_cube()  # squares with sides from 1 to 6, in a box with sides of 56
    low, high = boxes(obj)
    assert bpy.ops.uv.koebe_arrange(mode="SIZE", margin=512, pixels=1024) == {"FINISHED"}
    after = boxes(obj)
    assert rows_of(obj) == [[5], [4, 3], [2, 1, 0]]  # no wider than a square with all their area
    assert np.allclose(after[0][[5, 4, 3, 2, 1]], [[0, 50], [0, 44.5], [5.5, 45.5], [0, 41], [3.5, 42]])
    for name in ("Wood", "Iron"):
        obj.data.materials.append(bpy.data.materials.new(name))
    obj.data.polygons.foreach_set("material_index", [1, 0, 1, 0, 1, 0])
    assert bpy.ops.uv.koebe_arrange(mode="MATERIAL") == {"FINISHED"}
    assert rows_of(obj) == [[4, 2, 0], [5], [3, 1]]
    assert bpy.ops.uv.koebe_arrange(mode="PART") == {"FINISHED"}
    assert rows_of(obj) == [[5], [4, 3], [2, 1, 0]]
    scenes.edit_all()
    bpy.ops.mesh.edge_split(type="EDGE")
    assert bpy.ops.uv.koebe_arrange(mode="PART") == {"FINISHED"}
    bpy.ops.object.mode_set(mode="OBJECT")
    assert rows_of(obj) == [[0], [1], [2], [3], [4], [5]]


def test_a_grid_of_trims_takes_the_selected_islands():
    obj = scattered_cube()
    before = boxes(obj)
    with pytest.raises(RuntimeError, match="the trim sheet has no rectangle: press Make Grid"):
        bpy.ops.uv.koebe_arrange(mode="TRIM")
    assert bpy.ops.uv.koebe_trims(action="GRID", columns=2, rows=4) == {"FINISHED"}
    assert [item.name for item in trims().items] == ["A1", "B1", "A2", "B2", "A3", "B3", "A4", "B4"]
    assert np.allclose([*trims().items[3].lower, *trims().items[3].upper], [0.5, 0.5, 1.0, 0.75])
    scenes.select_faces(obj, [1])
    assert bpy.ops.uv.koebe_arrange(mode="TRIM", trim="B2", fit="INSIDE") == {"FINISHED"}
    bpy.ops.object.mode_set(mode="OBJECT")
    after = boxes(obj)
    assert np.allclose([after[0][1], after[1][1]], [[0.625, 0.5], [0.875, 0.75]], atol=1e-6)
    assert np.array_equal(after[0][[0, 2, 3, 4, 5]], before[0][[0, 2, 3, 4, 5]])
    with pytest.raises(RuntimeError, match="the trim sheet has no rectangle 'B9'"):
        bpy.ops.uv.koebe_arrange(mode="TRIM", trim="B9")


@pytest.mark.parametrize("fit, width, height", [
    ("INSIDE", 0.125, 0.25), ("HEIGHT", 0.125, 0.25), ("WIDTH", 1.0, 2.0), ("STRETCH", 1.0, 0.25),
    ("KEEP", 2.0, 4.0),
])  # fmt: skip
@pytest.mark.parametrize("turn", [False, True])
def test_the_fits_and_the_quarter_turn(fit, width, height, turn):
    """An island of 2 by 4 in a strip of 1 by 1/4: turned it is 4 by 2."""
    obj = scenes.add_object("Quad", [(0, 0, 0), (2, 0, 0), (2, 4, 0), (0, 4, 0)], [(0, 1, 2, 3)])
    layer = obj.data.uv_layers.new(name="Old")
    layer.data.foreach_set("uv", [3, 0.3, 5, 0.3, 5, 4.3, 3, 4.3])
    scenes.select(obj)
    bpy.ops.uv.koebe_trims(action="GRID", columns=1, rows=4)
    assert bpy.ops.uv.koebe_arrange(mode="TRIM", trim="A3", fit=fit, turn=turn) == {"FINISHED"}
    if turn:
        width, height = {"INSIDE": (0.5, 0.25), "HEIGHT": (0.5, 0.25), "WIDTH": (1.0, 0.5), "KEEP": (4.0, 2.0)}.get(
            fit, (1.0, 0.25))  # fmt: skip
    uv = scenes.corner_uv(obj.data, "Old")
    assert np.allclose(np.ptp(uv, axis=0), [width, height], atol=1e-6)
    middle = {"HEIGHT": [1.0, 0.375], "WIDTH": [0.5, 0.5]}.get(fit, [0.5, 0.375])  # as near to (4, 2.3) as may be
    assert np.allclose((uv.min(axis=0) + uv.max(axis=0)) / 2, middle, atol=1e-6)
    assert (scenes.signed_areas(obj.data, "Old") > 0).all()


def test_without_a_name_each_island_goes_to_the_nearest_rectangle():
    obj = scattered_cube()
    values = scenes.corner_uv(obj.data, "Old").reshape(6, 4, 2)
    values = 0.1 * (values - values.min(axis=1, keepdims=True)) / np.arange(1, 7)[:, None, None]
    values += np.array([[0.3, 0.02], [0.3, 0.3], [0.3, 0.55], [0.3, 0.8], [0.3, 3.0], [-4.0, 0.3]])[:, None]
    obj.data.uv_layers["Old"].data.foreach_set("uv", values.astype(np.float32).ravel())
    bpy.ops.uv.koebe_trims(action="GRID", columns=1, rows=4)
    assert bpy.ops.uv.koebe_arrange(mode="TRIM", fit="KEEP") == {"FINISHED"}
    low, high = boxes(obj)
    assert np.allclose((low + high)[:, 1] / 2, [0.125, 0.375, 0.625, 0.875, 0.875, 0.375], atol=1e-6)
    assert np.allclose((low + high)[:, 0] / 2, 0.5, atol=1e-6)


def test_the_trim_sheet_is_changed_and_undone_as_a_whole():
    obj = scattered_cube()
    assert bpy.ops.uv.koebe_trims(action="ADD") == {"FINISHED"}
    assert [*trims().items[0].lower, *trims().items[0].upper] == [0.0, 0.0, 56.0, 56.0]
    scenes.select_faces(obj, [2])
    assert bpy.ops.uv.koebe_trims(action="ADD") == {"FINISHED"}
    assert [*trims().items[1].lower, *trims().items[1].upper] == [20.0, 20.0, 23.0, 23.0] and trims().active == 1
    for left in (1, 0):
        assert bpy.ops.uv.koebe_trims(action="REMOVE") == {"FINISHED"} and len(trims().items) == left
    with pytest.raises(RuntimeError, match="no rectangle of the trim sheet is chosen"):
        bpy.ops.uv.koebe_trims(action="REMOVE")


def two_sides(odd=False):
    """Two squares that are mirror images in x, and one between them that is its own; as UVs three squares.

    odd  the right one has another form, so that nothing is symmetric
    """
    far = 3.5 if odd else 3.0
    vertices = [(-3, 0, 0), (-2, 0, 0), (-2, 1, 0), (-3, 1, 0), (2, 0, 0), (far, 0, 0), (3, 1, 0), (2, 1, 0),
                (-1, 0, 0), (1, 0, 0), (1, 1, 0), (-1, 1, 0)]  # fmt: skip
    obj = scenes.add_object("Sides", vertices, [(0, 1, 2, 3), (4, 5, 6, 7), (8, 9, 10, 11)])
    layer = obj.data.uv_layers.new(name="Old")
    square = np.array([[0, 0], [1, 0], [1, 1], [0, 1]]) / 4
    layer.data.foreach_set("uv", np.concatenate([square, square + 0.5, square + (0, 0.5)]).astype(np.float32).ravel())
    scenes.select(obj)
    return obj


@pytest.mark.parametrize("selected, mover", [(None, 0), ([1], 1), ([0], 0)])
@pytest.mark.parametrize("tiles", [0, 1])
def test_an_island_goes_onto_its_mirror_image_corner_by_corner(selected, mover, tiles):
    obj = two_sides()
    before = scenes.corner_uv(obj.data, "Old").reshape(3, 4, 2)
    if selected:
        scenes.select_faces(obj, selected)
    assert bpy.ops.uv.koebe_arrange(mode="MIRROR", tiles=tiles) == {"FINISHED"}
    if selected:
        bpy.ops.object.mode_set(mode="OBJECT")
    after = scenes.corner_uv(obj.data, "Old").reshape(3, 4, 2)
    stays = 1 - mover
    assert np.array_equal(after[[stays, 2]], before[[stays, 2]])
    # The mirror images of the corners of one face are those of the other one in this order.
    assert np.allclose(after[mover], before[stays][[1, 0, 3, 2]] + (tiles, 0), atol=1e-6)


def test_what_has_no_mirror_image_is_told_and_stays():
    obj = two_sides(odd=True)
    before = scenes.corner_uv(obj.data, "Old")
    with pytest.raises(RuntimeError, match="nothing was arranged. Sides: the mesh is not symmetric"):
        bpy.ops.uv.koebe_arrange(mode="MIRROR")
    assert np.array_equal(scenes.corner_uv(obj.data, "Old"), before)
    obj = two_sides()
    scenes.select_faces(obj, [2])
    with pytest.raises(RuntimeError, match="no chosen island has another one as its mirror image"):
        bpy.ops.uv.koebe_arrange(mode="MIRROR")


def test_pins_and_uvs_that_are_not_finite_stay():
    obj = scattered_cube()
    scenes.pin(obj.data, "Old", [True] * 4 + [False] * 20)
    uv = scenes.corner_uv(obj.data, "Old")
    uv[4:8] = np.nan
    obj.data.uv_layers["Old"].data.foreach_set("uv", uv.ravel())
    assert bpy.ops.uv.koebe_arrange(mode="RIGHT", in_square=True) == {"FINISHED"}
    after = scenes.corner_uv(obj.data, "Old")
    assert np.array_equal(after[:4], uv[:4]) and np.isnan(after[4:8]).all()
    assert np.isfinite(after[8:]).all() and np.allclose(after[8:].reshape(4, 4, 2).max(axis=1)[:, 0], 1.0, atol=1e-5)
    assert bpy.ops.uv.koebe_arrange(mode="TOP") == {"FINISHED"}
    assert np.ptp(scenes.corner_uv(obj.data, "Old")[12:].reshape(3, 4, 2).max(axis=1)[:, 1]) < 1e-5
    obj.data.uv_layers["Old"].data.foreach_set("uv", np.full(48, np.nan, np.float32))
    with pytest.raises(RuntimeError, match="nothing was arranged. Cube: 1 island with pinned UVs and 5 islands whose"):
        bpy.ops.uv.koebe_arrange(mode="LEFT")
    scenes.select(scenes.add_cube("Bare"))
    with pytest.raises(RuntimeError, match="nothing was arranged. Bare: it has no UVs"):
        bpy.ops.uv.koebe_arrange(mode="LEFT")


def test_random_islands_keep_their_form_in_every_mode():
    """Random layouts: what is moved is congruent, and what is fitted is in its rectangle."""
    random = np.random.default_rng(5)
    modes = [item.identifier for item in bpy.ops.uv.koebe_arrange.get_rna_type().properties["mode"].enum_items]
    bpy.ops.uv.koebe_trims(action="GRID", columns=3, rows=2)
    obj = scattered_cube()
    for trial in range(60):
        mode = modes[trial % len(modes)]
        uv = (random.normal(size=(6, 4, 2)) * 10.0 ** random.integers(-3, 4, size=(6, 1, 1))).astype(np.float32)
        obj.data.uv_layers["Old"].data.foreach_set("uv", uv.ravel())
        assert bpy.ops.uv.koebe_arrange(mode=mode, fit="INSIDE", tiles=0, margin=8, pixels=1024) == {"FINISHED"}, mode
        after = scenes.corner_uv(obj.data, "Old").reshape(6, 4, 2).astype(float)
        assert np.isfinite(after).all()
        if mode == "MIRROR":
            continue
        lengths = [np.linalg.norm(np.diff(one, axis=1), axis=2) for one in (uv.astype(float), after)]
        ratio = lengths[1] / lengths[0]
        big = np.abs(uv).max() + np.abs(after).max()
        slack = 1e-6 * (1 + big / lengths[0].min(axis=1))
        if mode != "TRIM":
            assert (np.abs(ratio - 1.0).max(axis=1) < slack).all(), mode
        else:
            assert after.min() > -1e-6 and after.max() < 1 + 1e-6
