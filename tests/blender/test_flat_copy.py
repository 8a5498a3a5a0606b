"""Flat copies of UV layouts: objects and drawings, and what is said of their size."""

import xml.etree.ElementTree as ET

import bpy
import numpy as np
import pytest
import scenes
import states

SVG = "{http://www.w3.org/2000/svg}"


def rolled(name="Rolled", columns=8):
    """A sheet of 2 by 1 that is rolled up by half a turn and unwrapped exactly, cut in the middle in the UVs."""
    obj = scenes.add_object(name, *sheet(columns))
    layer = obj.data.uv_layers.new(name="Flat")
    column = np.repeat(np.arange(columns), 4)
    u = column + np.tile([0, 0, 1, 1], columns) + 0.5 * (column >= columns // 2)
    v = np.tile([0, 1, 1, 0], columns)
    layer.data.foreach_set("uv", np.stack([u / columns, v / 2], axis=1).astype(np.float32).ravel() * 0.5)
    scenes.select(obj)
    return obj


def sheet(columns):
    """Vertices and faces: chords are as long as the flat columns."""
    half = 0.5 * np.pi / columns
    turn, radius = 2 * half * np.arange(columns + 1), (1.0 / columns) / np.sin(half)
    vertices = [(radius * np.cos(a), y, radius * np.sin(a)) for a in turn for y in (0.0, 1.0)]
    return vertices, [(2 * i, 2 * i + 1, 2 * i + 3, 2 * i + 2) for i in range(columns)]


def positions(mesh):
    return scenes.read(mesh.vertices, "co", np.float32, 3)


def said(capfd):
    """What operators have reported on the console."""
    return capfd.readouterr().out


def test_a_flat_copy_has_the_true_size_and_is_cut_where_the_uvs_are(capfd):
    obj = rolled()
    bpy.context.scene.cursor.location = (1.0, 2.0, 3.0)
    before = scenes.mesh_state(obj.data)
    assert bpy.ops.object.koebe_flat_copy() == {"FINISHED"}
    copy = bpy.context.view_layer.objects.active
    assert copy.name == "Rolled Flat" and copy.select_get() and not obj.select_get()
    assert tuple(copy.location) == (1.0, 2.0, 3.0)
    points = positions(copy.data)
    assert np.abs(points[:, 2]).max() == 0.0
    assert np.abs(np.ptp(points, axis=0)[:2] - [2.125, 1.0]).max() < 1e-6  # the gap of half a column is there too
    assert len(copy.data.polygons) == 8 and len(points) == 20
    assert np.abs(scenes.read(copy.data.polygons, "area", np.float32) - 0.25).max() < 1e-6
    assert min(polygon.normal.z for polygon in copy.data.polygons) == pytest.approx(-1.0)  # as the UVs are wound
    assert np.array_equal(scenes.corner_uv(copy.data, "Flat"), scenes.corner_uv(obj.data, "Flat"))
    assert str(scenes.mesh_state(obj.data)) == str(before)
    assert not copy.data.validate()
    assert "Rolled: true to scale: lengths are 100 % to 100 %" in said(capfd)


def test_materials_come_along_and_the_world_size_counts():
    obj = states.dressed()
    bpy.ops.uv.koebe_uniformize(checker=False)
    obj.scale = (2.0, 2.0, 2.0)
    bpy.context.view_layer.update()
    area = 4.0 * scenes.read(obj.data.polygons, "area", np.float32).sum()
    assert bpy.ops.object.koebe_flat_copy() == {"FINISHED"}
    copy = bpy.context.view_layer.objects.active
    assert scenes.read(copy.data.polygons, "area", np.float32).sum() == pytest.approx(area, rel=0.01)
    assert [slot.material for slot in copy.material_slots] == [slot.material for slot in obj.material_slots]
    numbers = [scenes.read(one.data.polygons, "material_index", np.int32) for one in (obj, copy)]
    assert np.array_equal(*numbers)
    assert len(scenes.boundary_loops(copy.data)) == 4


def test_how_much_it_is_off_is_said(capfd):
    scenes.select(scenes.add_panel())
    bpy.ops.uv.koebe_uniformize(checker=False)
    bpy.ops.object.koebe_flat_copy()
    assert "Warning: Panel: not true to scale: lengths are" in said(capfd)


def test_several_objects_lie_beside_each_other_and_one_failure_stops_no_other(capfd):
    first, second, bare = rolled("First"), rolled("Second"), scenes.add_cube("Bare")
    scenes.select(first, second, bare)
    assert bpy.ops.object.koebe_flat_copy() == {"FINISHED"}
    one, two = (bpy.data.objects[f"{name} Flat"] for name in ("First", "Second"))
    assert abs(two.location.x - one.location.x) > 2.125
    assert "Bare: it has no UVs: map it first" in said(capfd)


def test_what_cannot_be_done_is_said_and_nothing_is_added():
    scenes.select(scenes.add_cube("Bare"))
    names = sorted(bpy.data.objects.keys())
    with pytest.raises(RuntimeError, match="nothing was laid flat. Bare: it has no UVs: map it first"):
        bpy.ops.object.koebe_flat_copy()
    rolled()
    with pytest.raises(RuntimeError, match="no UV layer 'None'"):
        bpy.ops.object.koebe_flat_copy(layer="None")
    assert sorted(bpy.data.objects.keys()) == sorted([*names, "Rolled"]) and len(bpy.data.meshes) == 2


def test_undo_takes_the_copy_back():
    rolled()
    bpy.ops.ed.undo_push(message="before")
    bpy.ops.object.koebe_flat_copy("EXEC_DEFAULT", True)
    bpy.ops.ed.undo()
    assert sorted(bpy.data.objects.keys()) == ["Rolled"]
    bpy.ops.ed.redo()
    assert sorted(bpy.data.objects.keys()) == ["Rolled", "Rolled Flat"]


def drawing(path):
    """Size and paths of an SVG."""
    root = ET.parse(path).getroot()
    return root, list(root.iter(f"{SVG}path"))


def test_the_drawing_is_in_true_millimetres(tmp_path, capfd):
    rolled()
    bpy.context.scene.unit_settings.scale_length = 0.01  # a unit is a centimetre
    path = tmp_path / "cut.svg"
    assert bpy.ops.uv.koebe_flat_svg(filepath=str(path)) == {"FINISHED"}
    root, paths = drawing(path)
    assert root.get("width") == "31.25mm" and root.get("height") == "20mm"  # and a border of 5 mm
    assert [one.get("class") for one in paths] == ["outline", "outline"]
    assert "true to scale" in said(capfd)
    assert list(tmp_path.iterdir()) == [path]
    bpy.ops.uv.koebe_flat_svg(filepath=str(path), scale=2.0, edges=True)
    root, paths = drawing(path)
    assert root.get("width") == "52.5mm" and paths[0].get("class") == "engrave"


def test_holes_are_in_the_drawing(tmp_path):
    scenes.select(scenes.add_panel())
    bpy.ops.uv.koebe_uniformize(checker=False)
    bpy.ops.uv.koebe_flat_svg(filepath=str(tmp_path / "cut.svg"))
    assert [one.get("class") for one in drawing(tmp_path / "cut.svg")[1]] == ["hole", "hole", "hole", "outline"]


def test_a_file_that_cannot_be_written_is_said(tmp_path):
    rolled()
    with pytest.raises(RuntimeError, match="No such file"):
        bpy.ops.uv.koebe_flat_svg(filepath=str(tmp_path / "missing" / "cut.svg"))
    assert list(tmp_path.iterdir()) == []
    folder = tmp_path / "cut.svg"
    folder.mkdir()
    with pytest.raises(RuntimeError, match="cut.svg: (Is a directory|Access denied|Permission denied)"):
        bpy.ops.uv.koebe_flat_svg(filepath=str(folder))
    assert list(tmp_path.iterdir()) == [folder]


def test_pieces_true_to_size_lie_beside_the_object(capfd):
    obj = rolled()
    before = scenes.mesh_state(obj.data)
    assert bpy.ops.object.koebe_flat_copy(pieces="TRUE") == {"FINISHED"}
    copy = bpy.context.view_layer.objects.active
    assert copy.name == "Rolled Flat" and copy.location.x > max(v.co.x for v in obj.data.vertices)
    points = positions(copy.data)
    assert np.abs(np.sort(np.ptp(points, axis=0)) - [0.0, 1.0, 2.0]).max() < 1e-4  # without the cut of the UVs
    assert np.abs(scenes.read(copy.data.polygons, "area", np.float32) - 0.25).max() < 1e-4
    assert str(scenes.mesh_state(obj.data)) == str(before)
    assert np.array_equal(scenes.corner_uv(copy.data, "Flat"), scenes.corner_uv(obj.data, "Flat"))
    assert not copy.data.validate()
    assert "Rolled: 1 piece, lengths off by" in said(capfd)


def test_what_has_no_uvs_is_cut_true_to_size_and_undone():
    cube = scenes.add_cube("Bare")
    cube.scale = (3.0, 3.0, 3.0)
    scenes.select(cube)
    bpy.ops.ed.undo_push(message="before")
    bpy.ops.object.koebe_flat_copy("EXEC_DEFAULT", True, pieces="TRUE")
    copy = bpy.data.objects["Bare Flat"]
    area = (3.0 * cube.dimensions.x / cube.scale.x) ** 2
    assert np.allclose(scenes.read(copy.data.polygons, "area", np.float32), area, rtol=1e-4)
    uv = scenes.corner_uv(copy.data, "Koebe")
    assert uv.min() >= 0.0 and uv.max() == pytest.approx(1.0)
    bpy.ops.ed.undo()
    assert sorted(bpy.data.objects.keys()) == ["Bare"]


def test_seams_and_pieces_have_numbers():
    cube = scenes.add_cube("Bare")
    for edge in cube.data.edges:
        edge.use_seam = True
    scenes.select(cube)
    assert bpy.ops.object.koebe_flat_copy(pieces="TRUE", numbers=False) == {"FINISHED"}
    assert not any(obj.type == "FONT" for obj in bpy.data.objects)
    scenes.select(cube)
    assert bpy.ops.object.koebe_flat_copy(pieces="TRUE") == {"FINISHED"}
    copy = bpy.context.view_layer.objects.active
    texts = [obj for obj in bpy.data.objects if obj.type == "FONT"]
    assert all(obj.parent == copy and obj.users_collection == copy.users_collection for obj in texts)
    said = [obj.data.body for obj in texts]
    assert sorted(said) == sorted(["P1", "P2", "P3", "P4", "P5", "P6"] + 2 * [str(k) for k in range(1, 13)])
    points = positions(copy.data)[:, :2]
    squares = [points[list(face.vertices)] for face in copy.data.polygons]
    for obj in texts:
        at = np.array(obj.location[:2])
        inside = [(square.min(axis=0) < at).all() and (at < square.max(axis=0)).all() for square in squares]
        assert sum(inside) == 1 and 0.0 < obj.data.size < 0.15 * np.ptp(squares[0])


def test_pieces_are_cut_along_seams():
    obj = rolled()
    for edge in obj.data.edges:
        edge.use_seam = set(edge.vertices) == {8, 9}
    assert bpy.ops.object.koebe_flat_copy(pieces="TRUE") == {"FINISHED"}
    copy = bpy.context.view_layer.objects.active
    assert len(scenes.boundary_loops(copy.data)) == 2 and len(copy.data.vertices) == 20


@pytest.mark.parametrize("kind", ["SVG", "DXF"])
def test_a_pattern_is_written_in_real_size(tmp_path, capfd, kind):
    rolled()
    bpy.context.scene.unit_settings.scale_length = 0.01  # a unit is a centimetre
    path = tmp_path / f"cut.{kind.lower()}"
    options = {"pieces": "TRUE", "drawing": kind, "page": "none"}
    assert bpy.ops.uv.koebe_flat_svg(filepath=str(path), **options) == {"FINISHED"}
    assert "Rolled: 1 piece" in said(capfd) and list(tmp_path.iterdir()) == [path]
    if kind == "SVG":
        root, _ = drawing(path)
        size = sorted(float(root.get(side).removesuffix("mm")) for side in ("width", "height"))
        assert 10.0 <= size[0] < 80.0 and 20.0 <= size[1] < 100.0
    else:
        assert "EOF" in path.read_text()
