"""Patterned Copy: holes and reliefs on surfaces, as new objects. The original is never changed."""

import importlib

import bpy
import library
import numpy as np
import pytest
import scenes
import states
from tori import torus_arrays

FEW = {"size": 0.4}  # a pattern of a few outlines, which is fast
SQUARE = '<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0H10V10H0ZM3 3V7H7V3Z"/></svg>'


def sleeve(around=24, rows=8):
    """A tube that is open at both ends."""
    turn = 2.0 * np.pi * np.arange(around) / around
    vertices = [(np.cos(a), np.sin(a), 0.25 * j) for j in range(rows + 1) for a in turn]
    at = lambda i, j: j * around + i % around  # noqa: E731
    faces = [(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)) for j in range(rows) for i in range(around)]
    return vertices, faces


def lift(**options):
    return bpy.ops.object.koebe_lift(**{**FEW, **options})


def made():
    """The new object, which is selected and active."""
    obj = bpy.context.view_layer.objects.active
    assert bpy.context.selected_objects == [obj] and " Pattern" in obj.name
    return obj


def points(obj):
    return scenes.read(obj.data.vertices, "co", np.float32, 3)


def euler(mesh):
    return len(mesh.vertices) - len(mesh.edges) + len(mesh.polygons)


def is_closed(mesh):
    """Whether each edge has two faces that run along it in opposite directions."""
    faces = scenes.triangles(mesh)[0]
    loops = np.concatenate([faces[:, [i, (i + 1) % 3]] for i in range(3)])
    along, against = {tuple(edge) for edge in loops.tolist()}, {tuple(edge) for edge in loops[:, ::-1].tolist()}
    return len(along) == len(loops) and along == against


def volume(mesh):
    place = scenes.read(mesh.vertices, "co", np.float32, 3).astype(np.float64)[scenes.triangles(mesh)[0]]
    return float(np.einsum("ij,ij->i", place[:, 0], np.cross(place[:, 1], place[:, 2])).sum() / 6.0)


def test_circles_are_cut_out_and_the_original_stays(capfd):
    obj = scenes.add_panel()
    before, names = scenes.mesh_state(obj.data), len(bpy.data.meshes)
    assert lift(pattern="circles") == {"FINISHED"}
    found = made()
    assert found.name == "Panel Pattern" and len(bpy.data.meshes) == names + 1
    assert str(scenes.mesh_state(obj.data)) == str(before)
    holes = len(scenes.boundary_loops(found.data)) - 4
    assert holes > 5 and euler(found.data) == euler(obj.data) - holes
    assert f"Panel: {holes} outlines cut out" in capfd.readouterr().out
    assert obj.hide_get() and obj.hide_render and not found.hide_get()
    assert (scenes.signed_areas(found.data, "Koebe") > 0.0).all()
    assert not found.data.validate()


def test_vertices_that_stay_keep_their_bits_under_any_transform():
    obj = scenes.add_panel()
    obj.location, obj.rotation_euler, obj.scale = (5.0, 6.0, 7.0), (0.1, 0.2, 0.3), (0.3, 0.7, 0.9)
    bpy.context.view_layer.update()
    assert lift(size=0.2) == {"FINISHED"}
    found = made()
    assert np.allclose(found.matrix_basis, obj.matrix_basis, atol=1e-6)
    own, new = ({tuple(point) for point in points(one).tolist()} for one in (obj, found))
    assert len(own & new) > len(own) / 3


def test_a_sheared_object_is_lifted_where_it_is():
    parent, obj = bpy.data.objects.new("Parent", None), scenes.add_panel()
    bpy.context.collection.objects.link(parent)
    parent.scale, obj.parent, obj.rotation_euler = (1.0, 3.0, 1.0), parent, (0.0, 0.3, 0.7)
    bpy.context.view_layer.update()
    assert lift(size=0.6) == {"FINISHED"}
    bpy.context.view_layer.update()
    rims = [np.array(one.matrix_world)[:3, :3] @ points(one)[np.concatenate(scenes.boundary_loops(one.data))].T
            for one in (obj, made())]  # fmt: skip
    assert np.abs(rims[0].max(axis=1) - rims[1].max(axis=1)).max() < 1e-5


def test_a_relief_rises_along_the_normals_and_sinks_below_0():
    flat = scenes.add_panel("Flat", height=lambda x, y: 0 * x)
    for height in (0.1, -0.1):
        scenes.select(flat)
        assert lift(pattern="hexagons", way="raise", height=height, hide=False) == {"FINISHED"}
        z = points(made())[:, 2]
        assert set(np.round(np.unique(z), 5).tolist()) == {0.0, np.round(np.float32(height), 5).item()}
    assert not flat.hide_get()


def test_a_mirrored_object_has_its_relief_and_solid_on_the_same_side():
    flat = scenes.add_panel("Flat", height=lambda x, y: 0 * x)
    flat.scale = (-1.0, 1.0, 1.0)
    bpy.context.view_layer.update()
    assert lift(way="raise", height=0.1, hide=False) == {"FINISHED"}
    assert points(made())[:, 2].max() == pytest.approx(0.1)
    scenes.select(flat)
    assert lift(thickness=0.1) == {"FINISHED"}
    assert is_closed(made().data) and volume(made().data) > 0.0


def test_outlines_are_clipped_at_rims_and_bridges_are_checked(capfd):
    obj = scenes.add_panel()
    loops = len(scenes.boundary_loops(obj.data))
    assert lift(pattern="hexagons", size=0.3, rim="clip", bridge=0.14, hide=False) == {"FINISHED"}
    clipped = len(scenes.boundary_loops(made().data)) - loops
    said = capfd.readouterr().out
    outlines = int(said.split(" outlines cut out")[0].split()[-1])
    assert clipped < outlines and "thinner than asked for" in said
    scenes.select(obj)
    assert lift(pattern="hexagons", size=0.3, rim="clip", thickness=0.05) == {"FINISHED"}
    assert is_closed(made().data)


def test_sizes_follow_a_vertex_group():
    obj = scenes.add_panel(holes=())
    group = obj.vertex_groups.new(name="Sizes")
    x = points(obj)[:, 0]
    for vertex in np.flatnonzero(x > 0.0).tolist():
        group.add([vertex], 1.0, "REPLACE")
    assert lift(pattern="circles", size=0.2, graded="Sizes", hide=False) == {"FINISHED"}
    holes = scenes.boundary_loops(made().data)
    new = points(made())
    middles = [new[loop][:, 0].mean() for loop in holes]
    assert len(holes) > 5 and sum(middle < -0.15 for middle in middles) == 0
    scenes.select(obj)
    with pytest.raises(RuntimeError, match="it has no vertex group 'None', which Weights names"):
        lift(graded="None")


def test_a_solid_is_closed_and_has_no_uvs():
    scenes.add_panel()
    assert lift(pattern="diamonds", thickness=0.05) == {"FINISHED"}
    mesh = made().data
    assert is_closed(mesh) and volume(mesh) > 0.0 and not mesh.uv_layers and not mesh.validate()


def test_an_svg_file_a_png_file_and_a_text_are_patterns(tmp_path):
    obj = scenes.add_panel(holes=())
    drawing, picture = tmp_path / "square.svg", str(tmp_path / "grey.png")
    drawing.write_text(SQUARE)
    assert lift(pattern="file", file=str(drawing), way="raise", size=0.0, hide=False) == {"FINISHED"}
    assert euler(made().data) == euler(obj.data)
    image = bpy.data.images.new("grey", 8, 8)
    image.pixels = np.repeat(np.linspace(0.0, 1.0, 64), 4).tolist()
    image.filepath_raw, image.file_format = picture, "PNG"
    image.save()
    scenes.select(obj)
    with pytest.raises(RuntimeError, match="an image is a relief: set Make to Relief"):
        lift(pattern="file", file=picture)
    assert lift(pattern="file", file=picture, way="raise", height=0.1, size=0.0, hide=False) == {"FINISHED"}
    assert len(made().data.polygons) >= 64
    text = bpy.data.curves.new("Text", "FONT")
    text.body, text.extrude, text.bevel_depth = "80", 0.1, 0.01
    bpy.context.collection.objects.link(bpy.data.objects.new("Text", text))
    before = [len(bpy.data.curves), len(bpy.data.objects)]
    scenes.select(obj)
    assert lift(pattern="object", drawing="Text", size=0.0, way="raise") == {"FINISHED"}
    assert len(bpy.data.curves) == before[0] and len(bpy.data.objects) == before[1] + 1
    assert len(scenes.boundary_loops(made().data)) == len(scenes.boundary_loops(obj.data))


def test_shapes_of_the_map_and_several_objects():
    ring = scenes.add_object("Ring", *sleeve())
    torus = scenes.add_object("Torus", *torus_arrays(16, 10))
    for obj, shape, options in ((ring, "ring", {"pattern": "hexagons", "repeats": 8}), (torus, "torus", {})):
        scenes.select(obj)
        assert lift(shape=shape, **options) == {"FINISHED"}
    panels = [scenes.add_panel("One"), scenes.add_panel("Two")]
    scenes.select(*panels)
    lift()
    assert {obj.name for obj in bpy.context.selected_objects} == {"One Pattern", "Two Pattern"}


def test_parts_of_one_object_are_lifted_each():
    vertices, faces = scenes.panel_arrays(holes=())
    count = len(vertices)
    both = [*faces, *([corner + count for corner in face] for face in faces)]
    obj = scenes.add_object("Pair", np.concatenate([vertices, vertices + [3.0, 0.0, 0.0]]), both)
    scenes.select(obj)
    assert lift() == {"FINISHED"}
    x = points(made())[:, 0]
    assert len(scenes.boundary_loops(made().data)) % 2 == 0 and x.min() < -0.9 and x.max() > 3.9


def test_seams_cut_only_if_asked_for():
    obj = scenes.add_panel(holes=())
    middle = np.abs(points(obj)[:, 0]) < 1e-5
    ends = scenes.read(obj.data.edges, "vertices", np.int32, 2)
    obj.data.edges.foreach_set("use_seam", middle[ends].all(axis=1))
    counts = []
    for seams in (False, True):
        scenes.select(obj)
        lift(seams=seams, hide=False)
        counts.append(euler(made().data) + len(scenes.boundary_loops(made().data)))
    assert counts == [2, 4]


def test_slots_and_shading_come_along():
    obj = states.dressed()
    obj.data.polygons.foreach_set("use_smooth", np.ones(len(obj.data.polygons), bool))
    lift(way="raise", size=0.3)
    mesh = made().data
    assert [slot.material for slot in made().material_slots] == [slot.material for slot in obj.material_slots]
    assert set(scenes.read(mesh.polygons, "material_index", np.int32).tolist()) == {0, 1, 2, 3}
    smooth = scenes.read(mesh.polygons, "use_smooth", bool)
    assert smooth.any() and not smooth.all()  # walls are flat


@pytest.mark.parametrize("options", [{}, {"way": "raise"}, {"thickness": 0.02}, {"way": "raise", "thickness": 0.02}])
def test_uvs_attributes_and_groups_come_along(options):
    obj = scenes.add_panel(height=lambda x, y: 0 * x)
    mesh, own = obj.data, points(obj)
    linear = own @ [0.3, 0.2, 0.0] + 0.5
    corner = scenes.read(mesh.loops, "vertex_index", np.int32)
    layer = mesh.uv_layers.new(name="Own")
    layer.data.foreach_set("uv", np.ascontiguousarray(own[corner, :2] * [1, -1]).ravel())
    for name, kind, domain, values in (
        ("Point", "FLOAT", "POINT", linear),
        ("Vector", "FLOAT_VECTOR", "CORNER", own[corner]),
        ("Color", "BYTE_COLOR", "CORNER", np.tile(linear[corner][:, None], 4)),
        ("Number", "INT", "FACE", np.arange(len(mesh.polygons))),
    ):
        made_one = mesh.attributes.new(name, kind, domain)
        key = {"FLOAT_VECTOR": "vector", "BYTE_COLOR": "color"}.get(kind, "value")
        made_one.data.foreach_set(key, np.ascontiguousarray(values).ravel())
    mesh.color_attributes.active_color_name = "Color"
    group = obj.vertex_groups.new(name="Weights")
    for number, weight in enumerate(linear.tolist()):
        group.add([number], weight, "REPLACE")
    assert lift(**options) == {"FINISHED"}
    found, at = made().data, points(made())
    corner = scenes.read(found.loops, "vertex_index", np.int32)
    uv = np.array([one.uv for one in found.uv_layers["Own"].data])
    assert np.allclose(uv, at[corner, :2] * [1, -1], atol=1e-5)
    expected = at @ [0.3, 0.2, 0.0] + 0.5
    assert np.allclose(scenes.read(found.attributes["Point"].data, "value", np.float32), expected, atol=1e-5)
    vector = scenes.read(found.attributes["Vector"].data, "vector", np.float32, 3)
    assert np.allclose(vector[:, :2], at[corner, :2], atol=1e-5)
    color = scenes.read(found.attributes["Color"].data, "color", np.float32, 4)
    assert np.allclose(color[:, 0], expected[corner], atol=0.01) and found.attributes["Color"].data_type == "BYTE_COLOR"
    assert found.color_attributes.active_color_name == "Color"
    weights = np.array([vertex.groups[0].weight for vertex in found.vertices])
    assert made().vertex_groups[0].name == "Weights" and np.allclose(weights, expected, atol=1e-5)
    number = scenes.read(found.attributes["Number"].data, "value", np.int32)
    faces = scenes.read(mesh.polygons, "center", np.float32, 3)[number]
    middles = scenes.read(found.polygons, "center", np.float32, 3)
    assert np.linalg.norm((faces - middles)[:, :2], axis=1).max() < 0.1
    assert found.uv_layers.active.name == ("Own" if "thickness" in options else "Koebe")
    assert not found.validate()


def test_rows_follow_the_hole_at_the_cursor():
    obj = scenes.add_panel(height=lambda x, y: 0 * x)
    rims = [points(obj)[loop].mean(axis=0) for loop in scenes.boundary_loops(obj.data)]
    sizes = [np.ptp(points(obj)[loop], axis=0).max() for loop in scenes.boundary_loops(obj.data)]
    bpy.context.scene.cursor.location = rims[int(np.argmin(sizes))]
    counts = []
    for around in ("none", "cursor"):
        scenes.select(obj)
        assert lift(pattern="stripes", size=0.1, around=around, rows=1, repeats=5, hide=False) == {"FINISHED"}
        counts.append(len(scenes.boundary_loops(made().data)) - len(rims))
    assert counts[0] > 5 == counts[1]
    bpy.context.scene.cursor.location = (50.0, 50.0, 0.0)
    scenes.select(obj)
    with pytest.raises(RuntimeError, match="is on no hole of the disk"):
        lift(pattern="stripes", size=0.1, around="cursor")


@pytest.mark.parametrize(("build", "options", "said"), [
    (scenes.add_cube, {}, "the surface is closed: set Shape to Sphere, Parts or Torus"),
    (lambda: scenes.add_object("Bare", [(0, 0, 0), (1, 0, 0)], []), {}, "Bare: it has no faces"),
    (states.broken, {}, "coordinate"),
    (states.broken, {"way": "raise", "size": 0.0}, "coordinate"),
    (states.plain, {"size": 50.0}, "no outline of the pattern fits the surface"),
    (states.plain, {"size": 0.3, "bridge": 0.2}, "the bridge must be less than half of the size"),
    (states.plain, {"pattern": "file"}, "choose an SVG or PNG file"),
    (states.plain, {"pattern": "file", "file": "//none.svg"}, "there is no file"),
    (states.plain, {"pattern": "file", "file": __file__}, "choose an SVG or PNG file"),
    (states.plain, {"pattern": "object", "drawing": "None"}, "choose a curve or a text object"),
    (lambda: scenes.add_panel(size=12, height=lambda x, y: 8 * x * x), {"thickness": 3.0}, "faces would turn over"),
], ids=str)  # fmt: skip
def test_what_cannot_be_lifted_is_said_and_nothing_is_added(build, options, said):
    obj = build()
    scenes.select(obj)
    names = sorted(bpy.data.objects.keys())
    with pytest.raises(RuntimeError, match=said):
        lift(**options)
    assert sorted(bpy.data.objects.keys()) == names and not obj.hide_get()
    assert obj.select_get() and len(bpy.data.curves) == 0


def test_the_elements_of_an_error_can_be_selected():
    obj = scenes.add_panel(size=12, height=lambda x, y: 8 * x * x)
    with pytest.raises(RuntimeError, match="turn over"):
        lift(thickness=3.0)
    assert bpy.ops.uv.koebe_select_offenders() == {"FINISHED"}
    bpy.ops.object.mode_set(mode="OBJECT")
    chosen = scenes.read(obj.data.polygons, "select", bool)
    assert chosen.any() and not chosen.all()


def test_a_success_takes_the_failure_of_before_out_of_the_report():
    cube, islands = scenes.add_cube(), bpy.context.window_manager.koebe_uv.islands
    scenes.select(cube)
    with pytest.raises(RuntimeError, match="closed"):
        lift()
    assert [one.object_name for one in islands] == ["Cube"] and not islands[0].mapped
    assert lift(shape="parts") == {"FINISHED"}
    assert len(islands) == 0


def test_one_failure_stops_no_other(capfd):
    good, bad = scenes.add_panel("Good"), scenes.add_cube("Bad")
    scenes.select(good, bad)
    assert lift() == {"FINISHED"}
    assert made().name == "Good Pattern" and not bad.hide_get()
    assert "left out. Bad: the surface is closed" in capfd.readouterr().out


def test_undo_and_redo():
    obj = scenes.add_panel()
    bpy.ops.ed.undo_push(message="before")
    bpy.ops.object.koebe_lift("EXEC_DEFAULT", True, **FEW)
    bpy.ops.ed.undo()
    assert sorted(bpy.data.objects.keys()) == ["Panel"] and not bpy.data.objects["Panel"].hide_get()
    bpy.ops.ed.redo()
    assert sorted(bpy.data.objects.keys()) == ["Panel", "Panel Pattern"]
    del obj


def test_a_linked_object_is_lifted_too(tmp_path):
    path = library.save_away(tmp_path, lambda: states.plain("Far"))
    obj = library.link(path)
    scenes.select(obj)
    assert lift() == {"FINISHED"}
    assert made().library is None and made().data.library is None and obj.hide_get()


def test_it_works_in_object_mode_only():
    scenes.select_faces(scenes.add_panel())
    assert not bpy.ops.object.koebe_lift.poll()


@pytest.mark.alike
def test_switches_turn_automatic_values_into_values_near_them():
    scenes.select(scenes.add_panel())
    settings = bpy.context.scene.koebe_lift
    settings.way = "raise"
    for name in ("size", "bridge", "height", "rows", "repeats"):
        assert getattr(settings, name) == 0 and getattr(settings, f"automatic_{name}")
        setattr(settings, f"automatic_{name}", False)
        assert getattr(settings, name) > 0 and not getattr(settings, f"automatic_{name}")
    assert settings.bridge == pytest.approx(0.2 * settings.size, rel=0.1)
    area = sum(face.area for face in bpy.context.object.data.polygons)
    assert settings.size == pytest.approx(area**0.5 / 12.0, rel=0.05)
    settings.solid = True
    assert 0.0 < settings.thickness < settings.size
    settings.solid = settings.automatic_size = False
    assert settings.thickness == 0.0 and settings.size > 0.0
    settings.automatic_size = True
    assert settings.size == 0.0


@pytest.mark.alike
def test_the_choices_are_the_solvers(addon, koebe):
    properties, table = addon("state.lift_properties"), addon("maps.lifting")
    rows = importlib.import_module("koebe._option_table").rows("lift")
    assert properties.OWN["shape"].words == [*rows["shape"].words]
    assert set(rows) - {"perforate", "weld"} <= set(properties.LIFT_NAMES)
    built_in = [word for word, *_ in properties.PATTERNS if word not in table.DRAWN]
    assert built_in == [*table.SPREAD, *table.LATTICES]
