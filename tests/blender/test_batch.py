"""`batch.py` as a farm runs it: a process of its own, options, exit codes, whole files."""

import importlib
import json
import os
import subprocess
import sys
from pathlib import Path

import balls
import bpy
import handles
import numpy as np
import pytest
import scenes
import tori
from test_sequence import add_waving, vectors
from test_tube import add_tube


@pytest.fixture
def batch(addon_name, tmp_path):
    """A function that runs the installed batch.py on the open file and returns the finished process."""
    script = Path(importlib.import_module(addon_name).__file__).with_name("batch.py")

    def run(*arguments, source=None):
        if source is None:
            source = tmp_path / "in.blend"
            bpy.ops.wm.save_as_mainfile(filepath=str(source), copy=True)
        opened = [source] if source else []
        if bpy.app.binary_path:
            command = [bpy.app.binary_path, "-b", *opened, "--python-exit-code", "1", "-P", script]
        else:
            command = [sys.executable, script, *opened]
        return subprocess.run(
            [*map(str, command), "--", *map(str, arguments)], capture_output=True, text=True, cwd=tmp_path,
            env={**os.environ, "PYTHONDONTWRITEBYTECODE": "1"},
        )  # fmt: skip

    return run


def outputs(folder):
    """Names of all files that a run has left, hidden ones too."""
    return sorted(path.name for path in folder.iterdir() if path.name != "in.blend")


def test_it_writes_what_the_operator_writes(batch, tmp_path, koebe):
    obj = scenes.add_panel()
    obj.scale = (1, 2, 1)
    done = batch("--output", "out.blend", "--report", "out.json", "--balance", "area", "--layer", "Round",
                 "--polish")
    assert done.returncode == 0, done.stderr
    assert outputs(tmp_path) == ["out.blend", "out.json"]
    assert "Panel: 4 loops" in done.stdout
    bpy.ops.uv.koebe_uniformize(balance="area", layer="Round", polish=True)
    expected = scenes.corner_uv(obj.data, "Round").copy()
    state = scenes.mesh_state(obj.data)
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "out.blend"))
    obj = bpy.data.objects["Panel"]
    assert np.array_equal(scenes.corner_uv(obj.data, "Round"), expected)
    assert scenes.mesh_state(obj.data) == state
    assert obj.material_slots[0].material.name == "Koebe Checker"
    content = json.loads((tmp_path / "out.json").read_text())
    (entry,) = content["objects"]
    assert content["exit_code"] == 0
    assert entry["object"] == "Panel" and entry["flipped"] == 0 and entry["converged"] is True
    assert len(entry["loops"]) == 4 and entry["vertices"] == len(obj.data.vertices)
    assert {frozenset(loop["vertices"]) for loop in entry["loops"]} == {
        frozenset(loop) for loop in scenes.boundary_loops(obj.data)
    }


def as_the_operator(batch, tmp_path, obj, words, operator, **options):
    """The output of a run and its report's entry; the run's UVs are those of the operator, without a flip."""
    done = batch("--output", "out.blend", "--report", "out.json", *words.split())
    assert done.returncode == 0, done.stderr
    scenes.select(obj)
    assert getattr(bpy.ops.uv, f"koebe_{operator}")(**options) == {"FINISHED"}
    name, layer = obj.name, options.get("layer", "Koebe")
    expected, flipped = scenes.corner_uv(obj.data, layer).copy(), scenes.last_run().flipped
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "out.blend"))
    assert np.array_equal(scenes.corner_uv(bpy.data.objects[name].data, layer), expected)
    content = json.loads((tmp_path / "out.json").read_text())
    (entry,) = content["objects"]
    assert content["exit_code"] == 0 and entry["object"] == name and entry["flipped"] == flipped
    return done.stdout, entry


@pytest.mark.alike
@pytest.mark.parametrize("domain, options", [
    ("torus", {}), ("torus", {"fit": "square"}), ("ring", {"holes": "radial", "fit": "period"}),
    ("ring", {"even": 0.3, "loops": "free"}),
], ids=str)  # fmt: skip
def test_tiles_are_those_of_the_operators(batch, tmp_path, domain, options):
    obj = (tori.add_torus if domain == "torus" else tori.add_tube)(holes=tori.block(3, 4))
    loops, name = {frozenset(loop) for loop in scenes.boundary_loops(obj.data)}, obj.name
    words = " ".join(f"--{name}={value}" for name, value in options.items())
    said, entry = as_the_operator(batch, tmp_path, obj, f"--domain {domain} --layer Own {words}", domain,
                                  layer="Own", **options)  # fmt: skip
    assert f"{name}: 1 {'torus tile' if domain == 'torus' else 'cylinder'}, " in said
    assert ", texel density 1 : " in said
    assert entry["converged"] is True and entry["flipped"] == 0
    assert entry["domain"] == domain and entry["fit"] == options.get("fit", "inside")
    assert {frozenset(loop["vertices"]) for loop in entry["loops"]} == loops
    if options.get("fit"):
        assert entry["periods"][0] == [1.0, 0.0]


@pytest.mark.alike
@pytest.mark.parametrize("layout", balls.LAYOUTS)
def test_spheres_are_those_of_the_operator(batch, tmp_path, layout):
    said, entry = as_the_operator(batch, tmp_path, balls.add_ball(holes=((3, 4),)),
                                  f"--domain sphere --layout {layout} --layer Own", "sphere",
                                  layer="Own", layout=layout)  # fmt: skip
    assert "Ball: 1 sphere, 1 hole, " in said
    assert entry["domain"] == "sphere" and entry["layout"]["kind"] == layout and entry["converged"] is True
    assert len(entry["loops"]) == 1 and 0 < entry["loops"][0]["radius"] < 1


@pytest.mark.alike
@pytest.mark.parametrize("normalization", ["area", "circles"])
def test_handles_are_those_of_the_operator(batch, tmp_path, normalization):
    said, entry = as_the_operator(batch, tmp_path, handles.add_plate(holes=handles.HOLE),
                                  f"--domain schottky --normalization {normalization} --layer Own", "schottky",
                                  layer="Own", normalization=normalization)  # fmt: skip
    assert "Plate: 1 fundamental domain, 2 handles, 1 hole, cut along " in said
    assert entry["domain"] == "schottky" and entry["options"]["normalization"] == normalization
    assert entry["converged"] is True and entry["flipped"] == 0
    assert (len(entry["handles"]), len(entry["loops"])) == (2, 1)


@pytest.mark.alike
def test_even_parts_are_those_of_the_operator(batch, tmp_path):
    obj = scenes.add_cube("Cube")
    scenes.select(obj)
    bpy.ops.uv.koebe_parts()
    usual = scenes.corner_uv(obj.data, "Koebe").copy()
    _, entry = as_the_operator(batch, tmp_path, obj, "--parts --even 0 --loops free", "parts",
                               keep_angles=False, even=0.0, loops="free")  # fmt: skip
    assert entry["even"] == 0.0
    assert not np.array_equal(scenes.corner_uv(bpy.data.objects["Cube"].data, "Koebe"), usual)


@pytest.mark.alike
def test_parts_are_those_of_the_operator(batch, tmp_path):
    obj = scenes.add_cube("Cube")
    scenes.select(obj)
    bpy.ops.uv.koebe_parts(evenness=0.2, layer="Own", write_seams=True)
    seams = scenes.read(obj.data.edges, "use_seam", bool)
    obj.data.edges.foreach_set("use_seam", np.zeros(len(seams), bool))
    said, entry = as_the_operator(batch, tmp_path, obj, "--parts --evenness 0.2 --layer Own --write-seams", "parts",
                                  evenness=0.2, layer="Own", write_seams=True)  # fmt: skip
    assert said.count("Cube: ") == 1 and "part" in said
    mesh = bpy.data.objects["Cube"].data
    assert np.array_equal(scenes.read(mesh.edges, "use_seam", bool), seams) and seams.any()
    assert sorted(face for part in entry["parts"] for face in part["faces"]) == list(range(len(mesh.polygons)))
    assert entry["flipped"] == 0 and entry["angle_error_deg"]["mean"] < 60.0


@pytest.mark.alike
@pytest.mark.parametrize("words, said", [
    ("--importance Weight --balance none", "--importance: it needs Balance: take --balance area"),
    ("--symmetry auto --center 3", "--symmetry: it does not work with"),
    ("--max-sweeps 0", "--max-sweeps: 0 is not a number from 1 to 2147483647"),
    ("--domain ring --tolerance 0", "--tolerance: 0.0 is not"),
    ("--layer .own", "--layer: Blender keeps"),
    ("--sequence FRAMES --frames 1:9999999", "from -1048574 to 1048574"),
    ("--sequence FRAMES --frames 3:1", "--frames: the last frame is before the first one"),
    ("--sequence SHAPE_KEYS --play", "--play needs --sequence FRAMES"),
    ("--evenness 0.5", "--evenness needs --parts"),
    ("--parts --evenness 2", "--evenness: 2.0 is not a number from 0 to 1"),
    ("--parts --tolerance 1e-3", "--tolerance does not work with --parts"),
    ("--parts --domain torus", "--domain does not work with --parts"),
    ("--parts --sequence FRAMES", "--parts does not work with --sequence"),
])  # fmt: skip
def test_wrong_usage_names_flags_and_limits(addon, words, said):
    ends = addon("headless.exit_and_signals")
    with pytest.raises(ends.Stop) as raised:
        addon("headless.arguments").parse(["--output", "out.blend", *words.split()])
    assert raised.value.code == ends.USAGE and said in raised.value.reason


@pytest.mark.alike
def test_what_is_no_tile_is_told_and_nothing_is_saved(batch, tmp_path):
    tori.add_torus()
    done = batch("--output", "out.blend", "--report", "out.json", "--domain", "ring")
    assert done.returncode == 3 and "this surface has 1 handle: a cylinder must have no handle" in done.stderr
    assert outputs(tmp_path) == ["out.json"]
    (entry,) = json.loads((tmp_path / "out.json").read_text())["objects"]
    assert entry["error"]["name"] == "DomainError"


@pytest.mark.alike
@pytest.mark.parametrize("words, options", [
    ("--tube unroll", {"tube": "unroll"}), ("--no-upright", {"upright": False}),
])  # fmt: skip
def test_shapes_are_those_of_the_operator(batch, tmp_path, words, options):
    _, entry = as_the_operator(batch, tmp_path, add_tube(), words, "uniformize", **options)
    assert entry["unrolled"] is ("tube" in options) and entry["flipped"] == 0


@pytest.mark.alike
def test_loops_are_reported_in_the_numbers_of_the_mesh(batch, tmp_path):
    vertices, faces = scenes.panel_arrays()
    faces = [[v + 10 for v in face] for face in faces]
    obj = scenes.add_object("Late", np.vstack([np.zeros((10, 3)), vertices]), faces)
    scenes.select(obj)
    assert batch("--output", "out.blend", "--report", "out.json").returncode == 0
    (entry,) = json.loads((tmp_path / "out.json").read_text())["objects"]
    assert {frozenset(loop["vertices"]) for loop in entry["loops"]} == {
        frozenset(loop) for loop in scenes.boundary_loops(obj.data)
    }


@pytest.mark.alike
def test_only_the_named_objects_and_no_checker(batch, tmp_path):
    for name in ("A", "B, not C", "C"):
        scenes.add_panel(name, size=12, holes=((0.1, 0.4, 0.4, 0.7),))
    done = batch("--output", "out.blend", "--objects", "A,C", "--no-checker")
    assert done.returncode == 0, done.stderr
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "out.blend"))
    assert {obj.name for obj in bpy.data.objects if obj.data.uv_layers} == {"A", "C"}
    assert len(bpy.data.materials) == 0


@pytest.mark.alike
@pytest.mark.parametrize(
    "arguments",
    [
        (), ("--output",), ("--output", "out.blend", "--method", "rf"), ("--output", "out.blend", "--tolerance", "0"),
        ("--output", "out.blend", "--objects", "Nobody"), ("--output", "out.blend", "--outer", "sideways"),
        ("--output", "no/such/folder/out.blend"), ("--output", "out.blend", "--layer", ""), ("--what",),
    ],
    ids=" ".join,
)  # fmt: skip
def test_wrong_usage_is_2_and_leaves_nothing(batch, tmp_path, arguments):
    scenes.add_panel(size=8, holes=())
    done = batch(*arguments)
    assert done.returncode == 2, done.stderr
    assert done.stderr.strip()
    assert outputs(tmp_path) == []


@pytest.mark.alike
def test_no_input_is_2(batch, tmp_path):
    done = batch("--output", "out.blend", source="")
    assert done.returncode == 2 and "IN.blend" in done.stderr
    assert outputs(tmp_path) == []


@pytest.mark.alike
def test_a_bad_mesh_is_3_with_its_reason_and_no_blend(batch, tmp_path):
    scenes.add_panel("Good")
    scenes.add_cube("Bad")
    done = batch("--output", "out.blend", "--report", "out.json", "--no-cut")
    assert done.returncode == 3
    assert "Bad: " in done.stderr and "closed" in done.stderr and "Traceback" not in done.stderr
    assert outputs(tmp_path) == ["out.json"]
    entries = {entry["object"]: entry for entry in json.loads((tmp_path / "out.json").read_text())["objects"]}
    assert entries["Bad"]["error"]["name"] == "TopologyError" and entries["Bad"]["error"]["kind"] == "closed"
    assert "error" not in entries["Good"]


@pytest.mark.alike
def test_not_converged_is_4_and_written(batch, tmp_path):
    scenes.add_panel()
    done = batch("--output", "out.blend", "--report", "out.json", "--max-sweeps", "1", "--tolerance", "1e-14")
    assert done.returncode == 4, done.stderr
    assert "NOT CONVERGED" in done.stdout
    content = json.loads((tmp_path / "out.json").read_text())
    assert content["objects"][0]["converged"] is False
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "out.blend"))
    assert "Koebe" in bpy.data.objects["Panel"].data.uv_layers


@pytest.mark.alike
def test_what_is_lost_is_4_with_its_share_and_keeps_its_layer(batch, tmp_path):
    points, faces = tori.with_finger(*map(np.asarray, handles.plate_arrays()), 30, length=60)
    scenes.add_object("Limb", points, faces)
    done = batch("--output", "out.blend", "--report", "out.json", "--domain", "schottky")
    assert done.returncode == 4, done.stderr
    assert "% of its area is lost" in done.stderr and "use --parts" in done.stderr
    content = json.loads((tmp_path / "out.json").read_text())
    (entry,) = content["objects"]
    assert content["exit_code"] == 4 and entry["converged"] is False and entry["lost_area"] > 0.01
    assert entry["error"]["kind"] == "lost_area" and entry["flipped"] == entry["error"]["count"] > 0
    assert entry["angle_error_stored_deg"]["mean"] > 0.0
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "out.blend"))
    assert not bpy.data.objects["Limb"].data.uv_layers


def test_the_output_may_replace_the_input_and_leaves_no_backup(batch, tmp_path):
    scenes.add_panel()
    source = tmp_path / "in.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(source), copy=True)
    assert batch("--output", source, source=source).returncode == 0
    assert outputs(tmp_path) == []
    bpy.ops.wm.open_mainfile(filepath=str(source))
    assert "Koebe" in bpy.data.objects["Panel"].data.uv_layers


@pytest.mark.alike
def test_a_failed_run_keeps_an_older_output(batch, tmp_path):
    (tmp_path / "out.blend").write_text("older")
    scenes.add_cube()
    assert batch("--output", "out.blend", "--no-cut").returncode == 3
    assert (tmp_path / "out.blend").read_text() == "older"


def test_a_file_saved_in_edit_mode(batch, tmp_path):
    obj = scenes.add_panel()
    bpy.ops.uv.koebe_uniformize()
    expected = scenes.corner_uv(obj.data, "Koebe").copy()
    obj.data.uv_layers.remove(obj.data.uv_layers["Koebe"])
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="DESELECT")
    assert batch("--output", "out.blend").returncode == 0
    bpy.ops.object.mode_set(mode="OBJECT")
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "out.blend"))
    assert np.array_equal(scenes.corner_uv(bpy.data.objects["Panel"].data, "Koebe"), expected)


def test_linked_images_are_still_found_from_another_folder(batch, tmp_path):
    (tmp_path / "far" / "away").mkdir(parents=True)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "in.blend"))
    image = bpy.data.images.new("Image", 4, 4)
    image.filepath_raw, image.file_format = str(tmp_path / "image.png"), "PNG"
    image.save()
    image.filepath = "//image.png"
    image.use_fake_user = True
    scenes.add_panel()
    bpy.ops.wm.save_mainfile()
    done = batch("--output", "far/away/out.blend", source=tmp_path / "in.blend")
    assert done.returncode == 0, done.stderr
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "far" / "away" / "out.blend"))
    assert Path(bpy.path.abspath(bpy.data.images["Image"].filepath)).resolve() == (tmp_path / "image.png").resolve()


def test_a_file_that_is_no_blend(batch, tmp_path):
    junk = tmp_path / "in.blend"
    junk.write_text("this is no blend file")
    done = batch("--output", "out.blend", source=junk)
    assert done.returncode == (1 if bpy.app.binary_path else 3)  # Blender itself ends, before it runs a script
    assert outputs(tmp_path) == []


@pytest.mark.alike
@pytest.mark.parametrize("target", ["attribute", "layers"])
def test_sequences_are_those_of_the_operator(batch, tmp_path, target):
    add_waving()
    done = batch("--output", "out.blend", "--report", "out.json", "--sequence", "FRAMES", "--frames", "1:3:2",
                 "--sequence-target", target)  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert "Panel: 2 shapes, 4 loops" in done.stdout
    bpy.ops.uv.koebe_sequence(frame_start=1, frame_end=3, frame_step=2, target=target.upper())
    names = ["Koebe 0001", "Koebe 0003"] if target == "layers" else ["Koebe_0001", "Koebe_0003"]
    read_one = scenes.corner_uv if target == "layers" else lambda mesh, name: vectors(bpy.context.object, name)
    expected = [read_one(bpy.context.object.data, name).copy() for name in names]
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "out.blend"))
    assert bpy.context.scene.frame_current == 7
    for name, uv in zip(names, expected):
        assert np.array_equal(read_one(bpy.context.object.data, name), uv)
    content = json.loads((tmp_path / "out.json").read_text())
    assert [(one["object"], one["shape"], one["written"], one["flipped"]) for one in content["objects"]] == [
        ("Panel", "frame 1", names[0], 0), ("Panel", "frame 3", names[1], 0),
    ]  # fmt: skip


@pytest.mark.alike
def test_a_sequence_that_is_refused_writes_nothing(batch, tmp_path):
    obj = add_waving()
    obj.modifiers.new("Finer", "SUBSURF")
    done = batch("--output", "out.blend", "--report", "out.json", "--sequence", "FRAMES")
    assert done.returncode == 3 and "in frame 1 it has other faces" in done.stderr
    assert not (tmp_path / "out.blend").exists()
    done = batch("--output", "out.blend", "--sequence", "SHAPE_KEYS")
    assert done.returncode == 3 and "it has no shape keys" in done.stderr


def test_the_first_and_the_last_frame_that_blender_has(addon):
    """The limit that --frames names is Blender's."""
    last, scene = addon("headless.arguments").LARGEST_FRAME, bpy.context.scene
    for frame in (-last, last):
        scene.frame_set(frame)
        assert scene.frame_current == frame
