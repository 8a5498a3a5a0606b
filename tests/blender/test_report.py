"""The report for the panel, and the operators that select what it speaks of."""

import contextlib
import errno
import json
import os

import balls
import bpy
import fingerprint
import handles
import numpy as np
import pytest
import runs
import scenes
import tori
from test_bad_meshes import FAN, selected
from test_islands import add_seamed_panel


def islands():
    """Entries of the report."""
    return list(bpy.context.window_manager.koebe_uv.islands)


def test_every_island_is_reported_with_its_figures(koebe):
    obj = add_seamed_panel()
    bad = scenes.add_cube("Bad")
    scenes.select(obj, bad)
    bpy.ops.uv.koebe_uniformize(cut=False)
    inner, outer, closed = islands()
    assert [entry.object_name for entry in (inner, outer, closed)] == ["Panel", "Panel", "Bad"]
    assert [entry.mapped for entry in (inner, outer, closed)] == [True, True, False]
    assert [len(entry.loops) for entry in (inner, outer, closed)] == [4, 2, 0]
    assert "closed" in closed.message
    assert bpy.context.window_manager.koebe_uv.active == 0  # of the active object
    assert inner.converged and inner.flipped == 0 and inner.seconds > 0 and inner.angle_error > 0
    assert inner.loops[0].radius == pytest.approx(1.0) and 0 < inner.loops[1].radius < 1


def test_a_new_run_replaces_the_report():
    scenes.add_panel()
    bpy.ops.uv.koebe_uniformize()
    bpy.ops.uv.koebe_uniformize()
    assert len(islands()) == 1


def test_the_report_is_that_of_the_active_object(addon):
    state, report = addon("state.run_report"), bpy.context.window_manager.koebe_uv
    first, second, bad = scenes.add_panel("First"), add_seamed_panel("Second"), scenes.add_cube("Bad")
    scenes.select(first)
    bpy.ops.uv.koebe_uniformize(placement="together")
    scenes.select(second, bad)
    bpy.ops.uv.koebe_uniformize(cut=False, placement="together")
    assert [entry.object_name for entry in report.islands] == ["Second", "Second", "Bad", "First"]
    assert state.failed_beside(bpy.context) == ["Bad"]
    shared = addon("ui.report_panel").shared_coverage
    for obj, expected in ((first, [3]), (second, [0, 1]), (bad, [2])):
        scenes.select(obj)
        assert state.active_index(bpy.context) == expected[0]
        shown = [entry for entry in report.islands if entry.object_name in state.names_of_active(bpy.context)]
        assert shown == [report.islands[index] for index in expected] == state.entries_of_object(bpy.context)
        if obj is not bad:  # islands of one run share the square, and no other ones
            coverage = sum(report.islands[index].coverage for index in expected)
            assert shared(bpy.context, shown[0], shown) == pytest.approx(coverage)
    assert state.failed_beside(bpy.context) == []
    scenes.select(second)
    report.active = 1
    assert state.active_index(bpy.context) == 1
    twin = bpy.data.objects.new("Twin", first.data)
    bpy.context.collection.objects.link(twin)
    scenes.select(twin)
    assert state.active_index(bpy.context) == 3
    scenes.select(scenes.add_cube("New"))
    assert state.active_entry(bpy.context) is None
    bpy.data.objects.remove(second)
    scenes.select(bad)
    bpy.ops.uv.koebe_uniformize()
    assert [entry.object_name for entry in report.islands] == ["Bad", "First"]


def test_loops_are_selected_edge_by_edge_in_edit_mode():
    obj = add_seamed_panel()
    bpy.ops.uv.koebe_uniformize()
    report = bpy.context.window_manager.koebe_uv
    holes = {frozenset(loop) for loop in scenes.boundary_loops(obj.data)}
    report.active = 0
    found = set()
    for index in range(4):
        assert bpy.ops.uv.koebe_select_loop(loop=index) == {"FINISHED"}
        assert bpy.context.mode == "EDIT_MESH"
        vertices, edges, _ = selected(obj)
        assert len(edges) == len(vertices)
        if index == 0:
            assert all(obj.data.edges[e].use_seam for e in edges) and len(edges) == 52
        else:
            found.add(frozenset(vertices))
    assert found == {loop for loop in holes if len(loop) != 52}
    with pytest.raises(RuntimeError, match="4 loops"):
        bpy.ops.uv.koebe_select_loop(loop=4)


def test_loops_of_an_island_are_selected_in_the_numbers_of_the_mesh():
    obj = add_seamed_panel()
    bpy.ops.uv.koebe_uniformize()
    bpy.context.window_manager.koebe_uv.active = 1
    found = []
    for index in range(2):
        bpy.ops.uv.koebe_select_loop(loop=index)
        found.append([obj.data.edges[e].use_seam for e in selected(obj)[1]])
    assert sorted(found) == [[False] * 52, [True] * 52]


def test_offenders_are_selected_from_object_mode():
    obj = scenes.add_object("Bad", FAN, [(0, 1, 2), (1, 0, 3), (0, 1, 4)])
    good = scenes.add_panel("Good")
    scenes.select(good, obj)
    bpy.ops.uv.koebe_uniformize(cut=False)
    assert not bpy.ops.uv.koebe_select_offenders.poll()  # it is the report of the active object
    assert bpy.ops.object.koebe_show(object_name="Bad") == {"FINISHED"}
    assert bpy.ops.uv.koebe_select_offenders() == {"FINISHED"}
    assert bpy.context.active_object is obj and not good.select_get()
    vertices, edges, faces = selected(obj)
    assert vertices == [0, 1] and len(edges) == 1 and faces == []


def test_flipped_faces_are_selected(koebe, monkeypatch):
    """The map with one vertex pulled across the disk."""
    obj = scenes.add_panel()
    original = koebe.uniformize

    def tangled(*arguments, **options):
        result = original(*arguments, **options)
        uv = result.uv.copy()
        uv[70] = -uv[70]
        vars(result)["uv"] = uv
        return result

    monkeypatch.setattr(koebe, "uniformize", tangled)
    bpy.ops.uv.koebe_uniformize()
    areas = scenes.signed_areas(obj.data, "Koebe")
    triangle_face = scenes.read(obj.data.loop_triangles, "polygon_index", np.int32)
    expected = sorted(set(triangle_face[areas <= 0].tolist()))
    assert expected
    assert bpy.ops.uv.koebe_select_flipped() == {"FINISHED"}
    assert selected(obj)[2] == expected


def test_a_report_of_an_object_that_is_gone_selects_nothing():
    obj = scenes.add_panel()
    bpy.ops.uv.koebe_uniformize()
    assert bpy.ops.uv.koebe_select_loop.poll()
    bpy.data.objects.remove(obj)
    assert not bpy.ops.uv.koebe_select_loop.poll()


def other_than_the_default(prop):
    """Another value than a property's default."""
    if prop.type == "ENUM":
        return next(item.identifier for item in prop.enum_items if item.identifier != prop.default)
    if prop.type in {"BOOLEAN", "STRING"}:
        return not prop.default if prop.type == "BOOLEAN" else f"{prop.default}2"
    return 2 * prop.default if prop.type == "INT" else prop.default / 2 or prop.hard_max / 2


def chosen_options():
    """The panel's options, by their names."""
    settings = bpy.context.scene.koebe_uv
    names = [prop.identifier for prop in settings.bl_rna.properties if prop.identifier not in {"rna_type", "name"}]
    return {name: getattr(settings, name) for name in names}


def choose_others():
    """Give every option of the panel another value than its default; returns them."""
    settings = bpy.context.scene.koebe_uv
    for prop in settings.bl_rna.properties:
        if prop.identifier not in {"rna_type", "name"}:
            value = other_than_the_default(prop)
            setattr(settings, prop.identifier, value)
    return chosen_options()


def test_reset_gives_all_defaults_back():
    defaults = chosen_options()
    others = choose_others()
    assert all(others[name] != value for name, value in defaults.items())
    bpy.ops.uv.koebe_reset()
    assert chosen_options() == defaults


def test_a_preset_keeps_all_options(tmp_path):
    others = choose_others()
    assert bpy.ops.uv.koebe_preset_add(name="Koebe test") == {"FINISHED"}
    try:
        bpy.ops.uv.koebe_reset()
        path = bpy.utils.preset_find("Koebe_test", "koebe_uv") or bpy.utils.preset_find("Koebe test", "koebe_uv")
        bpy.ops.script.execute_preset(filepath=path, menu_idname="KOEBE_MT_presets")
        assert chosen_options() == others
    finally:
        bpy.ops.uv.koebe_preset_add(name="Koebe test", remove_name=True, remove_active=True)


def test_a_preset_that_cannot_be_written_leaves_the_older_one(monkeypatch):
    bpy.ops.uv.koebe_preset_add(name="Koebe test")
    path = bpy.utils.preset_find("Koebe_test", "koebe_uv")
    try:
        with open(path, encoding="utf-8") as file:
            older = file.read()
        bpy.context.scene.koebe_uv.margin = 0.2

        def full(temporary, target):
            raise OSError(errno.ENOSPC, "No space left on device")

        monkeypatch.setattr(os, "replace", full)
        with pytest.raises(RuntimeError, match="preset cannot be written or removed: No space"):
            bpy.ops.uv.koebe_preset_add(name="Koebe other")
        with contextlib.suppress(RuntimeError):  # 5.0 writes over none
            bpy.ops.uv.koebe_preset_add(name="Koebe test")
        with open(path, encoding="utf-8") as file:
            assert file.read() == older
        assert {*os.listdir(os.path.dirname(path))} - {"__pycache__"} == {os.path.basename(path)}
    finally:
        bpy.ops.uv.koebe_preset_add(name="Koebe test", remove_name=True, remove_active=True)


@pytest.mark.alike
def test_a_warning_is_one_sentence_and_selects_what_it_speaks_of():
    runs.flipped()
    (entry,) = islands()
    lost, warning, *_ = entry.warnings  # and polygons that are concave there
    assert "% of its area is lost" in lost.text and lost.of == "faces"
    assert "below the resolution" in entry.message and "Shape: Parts" in warning.text
    faces = json.loads(warning.elements)
    assert warning.of == "faces" and warning.text.startswith(f"{len(faces)} faces are too small ")
    assert bpy.ops.uv.koebe_select_warning(warning=1) == {"FINISHED"}
    assert sorted(selected(bpy.data.objects["Long"])[2]) == faces
    count = len(entry.warnings)
    with pytest.raises(RuntimeError, match=f"no warning {count}"):
        bpy.ops.uv.koebe_select_warning(warning=count)


@pytest.mark.alike
@pytest.mark.parametrize("shape", ["DISK", "PARTS"])
def test_the_coverage_is_the_share_of_the_square_that_the_uvs_take(shape):
    obj = scenes.add_panel()
    bpy.ops.uv.koebe_unwrap(shape=shape)
    (entry,) = islands()
    assert entry.coverage == pytest.approx(scenes.signed_areas(obj.data, "Koebe").sum(), rel=1e-5)
    assert 1.0 < entry.density < 4.0


def test_the_shortcut_is_off_until_asked_for(addon_name):
    preferences = bpy.context.preferences.addons[addon_name].preferences
    assert preferences.shortcut is False
    preferences.shortcut = True
    preferences.shortcut = False


def test_an_error_about_many_objects_is_a_few_lines_and_the_report_has_all():
    cubes = [scenes.add_cube(f"Cube {index}") for index in range(40)]
    scenes.select(*cubes)
    with pytest.raises(RuntimeError) as caught:
        bpy.ops.uv.koebe_uniformize(cut=False)
    lines = str(caught.value).strip().splitlines()
    assert len(lines) <= 8 and max(map(len, lines)) < 160 and "34 more" in lines[-1]
    assert [entry.object_name for entry in islands()] == [cube.name for cube in cubes]


@pytest.mark.parametrize("run", ["parts", "sphere", "schottky", "torus", "ring"])
def test_warnings_count_and_name_the_faces_of_the_mesh(run, capfd):
    """The solver has two triangles for each quadrilateral."""
    make = {"schottky": handles.plate_arrays, "torus": tori.torus_arrays,
            "ring": tori.tube_arrays}.get(run, balls.ball_arrays)  # fmt: skip
    vertices, faces = make()
    turned = (40, 41, 42)
    faces = [list(face)[::-1] if number in turned else face for number, face in enumerate(faces)]
    scenes.select(scenes.add_object("Turned", vertices, faces))
    assert getattr(bpy.ops.uv, f"koebe_{run}")() == {"FINISHED"}
    said = "3 faces turned to the orientation of the others; the first face is 40"
    assert said in islands()[0].message
    warning, *others = islands()[0].warnings
    assert not any("turned" in other.text for other in others)
    assert "3 faces" in warning.text and warning.text in capfd.readouterr().out
    assert (warning.of, json.loads(warning.elements)) == ("faces", [40, 41, 42])


def test_what_a_warning_counts_beside_its_elements_are_triangles(addon, koebe):
    island = addon("maps.parts").Numbers(np.arange(20) // 2, np.arange(100, 120))
    in_mesh = addon("maps.wording").in_mesh

    def said(kind, elements, text):
        made = in_mesh(island, koebe.maps.result.Warning(kind=kind, elements=elements, text=text))
        return made["elements"], made["text"]

    assert said("flipped", [6, 7, 9], "3 faces flipped, 2 of them too small; the first face is 6") == (
        [3, 4], "2 faces flipped, 2 triangles of them too small; the first face is 3")  # fmt: skip
    assert said("below_resolution", [0, 1], "2 faces around vertex 7, near loop 1, 1 face of them flipped") == (
        [0], "1 face around vertex 107, near loop 1, 1 triangle of them flipped")  # fmt: skip
    assert said("off_circle", [4, 5], "2 vertices taken off the circle; the first vertex is 4") == (
        [104, 105], "2 vertices taken off the circle; the first vertex is 104")  # fmt: skip
    assert said("ears", [1], "joined to a loop by one edge: 1 part with 1 face, the first by the edge 3-12") == (
        [0], "joined to a loop by one edge: 1 part with 1 face, the first by the edge 103-112")  # fmt: skip


# ---------------------------------------------------------------- what is lost


def fingered(run):
    """An object of the right kind, with a limb so long that its end has no area in one map's UVs."""
    points, faces = {"schottky": handles.plate_arrays, "torus": tori.torus_arrays, "ring": tori.tube_arrays}.get(
        run, balls.ball_arrays)()  # fmt: skip
    points, faces = tori.with_finger(np.asarray(points), [list(face) for face in faces], 60, length=60)
    obj = scenes.add_object("Limb", points, faces)
    scenes.select(obj)
    return obj


@pytest.mark.alike
@pytest.mark.parametrize("run", ["schottky", "torus", "ring", "sphere"])
def test_a_map_that_loses_a_limb_is_not_done(run):
    obj = fingered(run)
    operator = getattr(bpy.ops.uv, f"koebe_{run}")
    before = fingerprint.fingerprint()
    with pytest.raises(RuntimeError, match=r"Limb: \d+(\.\d+)? % of its area is lost.*Unwrap to Parts"):
        operator()
    assert fingerprint.differences(before, fingerprint.fingerprint()) == ["file: report"]
    (entry,) = islands()
    assert not entry.mapped and entry.offer == "parts"
    lost = json.loads(entry.offenders)[1]
    assert operator(most_lost=1.0, checker=False) == {"FINISHED"}
    areas = scenes.polygon_areas(obj)
    assert set(np.flatnonzero(areas <= 0.0)) <= set(lost) and islands()[0].flipped >= len(lost) > 0


@pytest.mark.alike
def test_one_map_of_a_limb_is_written_and_says_first_what_is_lost(capfd):
    obj = fingered("ring")
    assert bpy.ops.uv.koebe_uniformize() == {"FINISHED"}
    assert islands()[0].message.split(" ", 1)[1].startswith("% of its area is lost: ")
    out = capfd.readouterr().out
    assert out.index("Warning: Limb: LOST ") < out.index("of its area is lost") and "Koebe" in obj.data.uv_layers


@pytest.mark.alike
def test_parts_that_lose_too_much_are_not_done(koebe, monkeypatch):
    scenes.select(scenes.add_cube())
    parts = koebe.parts

    def losing(*arguments, **options):
        result = parts(*arguments, **options)
        result._set(lost_area=0.5, flipped_faces=np.arange(6, dtype=np.int32))
        return result

    monkeypatch.setattr(koebe, "parts", losing)
    before = fingerprint.fingerprint()
    with pytest.raises(RuntimeError, match="50 % of its area is lost.*use Unwrap to Disk"):
        bpy.ops.uv.koebe_parts()
    assert fingerprint.differences(before, fingerprint.fingerprint()) == ["file: report"]
    assert islands()[0].offer == "uniformize" and not islands()[0].mapped


@pytest.mark.alike
def test_figures_are_those_of_the_stored_uvs(koebe):
    """Of many islands in one square, each of which is small there."""
    vertices, faces = scenes.panel_arrays()
    count, copies = len(vertices), 150
    points = np.concatenate([np.asarray(vertices) + (3.0 * k, 0, 0) for k in range(copies)])
    obj = scenes.add_object("Many", points, [[v + k * count for v in face] for k in range(copies) for face in faces])
    scenes.select(obj)
    bpy.ops.uv.koebe_uniformize(checker=False)
    corner_vertex, corners = scenes.triangles(obj.data)
    chosen = (corner_vertex < count).all(axis=1)
    uv = scenes.corner_uv(obj.data, "Koebe")[corners[chosen]].reshape(-1, 2).astype(float)
    apart = np.arange(len(uv), dtype=np.int32).reshape(-1, 3)
    expected = koebe.distortion(points[corner_vertex[chosen].ravel()], apart, 2.0 * uv - 1.0)
    assert islands()[0].angle_error == pytest.approx(expected["angle_error_stored_deg"]["mean"], rel=1e-5)


# ---------------------------------------------------------------- in the file


def saved_and_opened(path):
    """The report's values before, and after another file was open."""
    before = fingerprint.group(bpy.context.window_manager.koebe_uv)
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=False)
    assert not islands()  # that of a file which has none
    bpy.ops.wm.open_mainfile(filepath=str(path))
    after = fingerprint.group(bpy.context.window_manager.koebe_uv)
    for report in (before, after):
        for entry in report["islands"]:
            del entry["history"], entry["corners"]
    return before, after


@pytest.mark.parametrize("run", ["uniformize", "parts", "schottky", "moebius"])
def test_the_report_comes_back_with_the_file(tmp_path, run):
    obj = handles.add_plate(holes=handles.HOLES) if run == "schottky" else scenes.add_panel()
    scenes.select(obj, scenes.add_cube("Bad") if run == "uniformize" else obj)
    if run == "moebius":
        bpy.ops.uv.koebe_uniformize()
        bpy.ops.uv.koebe_moebius(rim=1)
    else:
        getattr(bpy.ops.uv, f"koebe_{run}")(**({"cut": False} if run == "uniformize" else {}))
    before, after = saved_and_opened(tmp_path / "file.blend")
    assert after == before and len(before["islands"]) == 1 + (run == "uniformize")
    if run != "parts":
        bpy.context.window_manager.koebe_uv.active = 0
        assert bpy.ops.uv.koebe_select_loop(loop=1) == {"FINISHED"}
    if run == "moebius":
        bpy.ops.object.mode_set(mode="OBJECT")
        assert bpy.ops.uv.koebe_moebius(rotation=0.5) == {"FINISHED"}
        assert islands()[0].moved == "moved by hand"


def test_content_that_is_no_report_is_passed_over(addon):
    saved, report = addon("state.saved_report"), bpy.context.window_manager.koebe_uv
    scenes.add_panel()
    bpy.ops.uv.koebe_uniformize()
    text = saved.packed(report)
    content = json.loads(text)

    def changed(name, value, **others):
        return json.dumps({**content, "islands": [{**content["islands"][0], name: value}], **others})

    for damaged in (
        "", "{", "null", "[1]", "7", text[: len(text) // 2], json.dumps({**content, "version": 2}),
        json.dumps({"version": 1}), changed("flipped", "many"), changed("flipped", 2**40), changed("mapped", 1),
        changed("flipped_faces", "[1, -2]"), changed("flipped_faces", "{}"), changed("cuts", "[[1, 2.5]]"),
        changed("flipped_faces", "[[1]]"), changed("cuts", "[1]"), changed("loops", [{"vertices": "[]"}]),
        changed("offenders", '["faces"]'), changed("loops", [{"uv_center": [1.0]}]), changed("loops", [3]),
        changed("object_name", None), changed("flipped", 0, active="first"), "[" * 10**5,
    ):  # fmt: skip
        saved.unpack(damaged, report)
        assert not report.islands and report.active == 0, damaged[:200]
    saved.unpack(changed("unknown", 3), report)
    assert len(report.islands) == 1 and saved.packed(report) == text


@pytest.mark.parametrize("placement", ["pack", "together"])
def test_islands_that_share_the_square_are_judged_together_whatever_is_chosen_later(addon, placement):
    objects = [scenes.add_panel(), scenes.add_panel("Other", size=14)]
    scenes.select(*objects)
    assert bpy.ops.uv.koebe_uniformize(placement=placement) == {"FINISHED"}
    bpy.context.scene.koebe_uv.placement = "together" if placement == "pack" else "pack"
    islands = bpy.context.window_manager.koebe_uv.islands
    shared = addon("ui.report_panel").shared_coverage(bpy.context, islands[0], islands[:1])
    expected = islands[0].coverage + (islands[1].coverage if placement == "together" else 0.0)
    assert shared == pytest.approx(expected) and 0.0 < shared <= 1.0


def test_an_atlas_has_one_coverage(addon):
    objects = [scenes.add_panel(), scenes.add_panel("Other", size=14)]
    scenes.select(*objects)
    assert bpy.ops.uv.koebe_parts(atlas=True, darts=0.0) == {"FINISHED"}
    islands = bpy.context.window_manager.koebe_uv.islands
    assert addon("ui.report_panel").shared_coverage(bpy.context, islands[0], islands[:1]) == islands[0].coverage < 1.0


def test_a_report_says_when_it_is_of_another_mesh_or_of_no_layer(addon, tmp_path):
    outdated, obj = addon("state.run_report").outdated, scenes.add_panel("Panel")
    assert bpy.ops.uv.koebe_unwrap(checker=False) == {"FINISHED"}
    assert [outdated(entry) for entry in islands()] == [""]
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "kept.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "kept.blend"))
    obj = bpy.data.objects["Panel"]
    assert [outdated(entry) for entry in islands()] == [""]
    obj.data.uv_layers["Koebe"].name = "UVMap"
    assert "no UV layer 'Koebe' any more" in outdated(islands()[0])
    obj.data.uv_layers["UVMap"].name = "Koebe"
    obj.data.vertices.add(1)
    assert "has changed" in outdated(islands()[0])
    bpy.data.objects.remove(obj)
    scenes.select(scenes.add_cube("Panel"))  # another object of that name
    assert "has changed" in outdated(islands()[0])
    with pytest.raises(RuntimeError):
        bpy.ops.uv.koebe_uniformize(cut=False)
    assert [outdated(entry) for entry in islands()] == [""]  # why it is not mapped, and it has no layer


def test_the_report_follows_its_object(addon):
    report = addon("state.run_report")
    obj, other = scenes.add_panel("Before"), scenes.add_sheet(4)
    scenes.select(obj)
    bpy.ops.uv.koebe_parts(checker=False)
    obj.name = "After"
    other.name = "Before"  # which has no map
    entry = report.active_entry(bpy.context)
    assert (entry.owner_name, report.outdated(entry)) == ("After", "")
    saved = addon("state.saved_report")
    assert '"object_name": "After"' in saved.packed(bpy.context.window_manager.koebe_uv)
    scenes.select(other)
    assert report.active_entry(bpy.context) is None
    again = bpy.data.objects.new("Linked copy", obj.data)
    bpy.context.collection.objects.link(again)
    bpy.data.objects.remove(obj)
    scenes.select(again)
    assert report.active_entry(bpy.context).owner_name == "Linked copy"
    bpy.ops.uv.koebe_parts(checker=False)
    assert {entry.owner_name for entry in bpy.context.window_manager.koebe_uv.islands} == {"Linked copy"}
