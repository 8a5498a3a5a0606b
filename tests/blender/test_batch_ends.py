"""How a batch run ends: exit codes, one line that says why, a report, and signals."""

import json
import signal

import bpy
import processes
import pytest
import scenes

SMALL = {"size": 10, "holes": ((0.1, 0.4, 0.4, 0.7),)}


@pytest.fixture
def batch(addon_name, koebe, tmp_path):
    """A function that runs the installed batch.py on the open file, or on another one; `koebe` is unpacked before."""
    return lambda *arguments, **options: processes.run_batch(addon_name, tmp_path, *arguments, **options)


def outputs(folder):
    return sorted(path.name for path in folder.iterdir() if not path.name.startswith("in.blend"))


def read_report(folder):
    content = json.loads((folder / "out.json").read_text())
    return content, {entry["object"]: entry for entry in content["objects"]}


# ---------------------------------------------------------------- the input


def saved(path, **options):
    scenes.add_panel(**SMALL)
    bpy.ops.wm.save_as_mainfile(filepath=str(path), copy=True, **{"compress": False, **options})
    return path.read_bytes()


def opened_by_the_script(addon_name, folder, source, *arguments):
    """With the input behind the mark, where also in Blender the script opens it."""
    return processes.run_batch(addon_name, folder, str(source), *arguments, source="")


@pytest.mark.parametrize("kind", ["no blend", "empty", "cut off", "cut off, compressed", "missing"])
def test_an_input_that_cannot_be_read_is_3(addon_name, koebe, tmp_path, kind):
    source = tmp_path / "in.blend"
    if kind != "missing":
        content = saved(source, compress="compressed" in kind)
        source.write_bytes({"no blend": b"not a blend", "empty": b""}.get(kind, content[: len(content) // 2]))
    arguments = ("--output", "out.blend", "--report", "out.json")
    code, out, err = opened_by_the_script(addon_name, tmp_path, source, *arguments)
    assert code == 3 and str(source) in err and "Traceback" not in err, err
    content, entries = read_report(tmp_path)
    assert content["exit_code"] == 3 and content["error"]["name"] == "FileError" and entries == {}
    assert outputs(tmp_path) == ["out.json"]


def test_a_newer_input_is_3(batch, tmp_path):
    """Blender reads it, with losses: 3.4 loses the vertices of 4.5 and crashes."""
    source = tmp_path / "in.blend"
    content = saved(source)
    version = "{}{:02d}".format(*bpy.app.version[:2]).encode()
    at = content.index(version, 0, 32)
    source.write_bytes(content[:at] + b"%d" % (int(version) + 1) + content[at + len(version):])
    code, out, err = batch("--output", "out.blend", "--report", "out.json", source=source)
    assert code == 3 and "data would be lost" in err, err
    assert read_report(tmp_path)[0]["exit_code"] == 3 and outputs(tmp_path) == ["out.json"]


def test_a_compressed_input_is_as_good(addon_name, koebe, tmp_path):
    saved(tmp_path / "in.blend", compress=True)
    code, out, err = opened_by_the_script(addon_name, tmp_path, tmp_path / "in.blend", "--output", "out.blend")
    assert code == 0, err
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "out.blend"))
    assert "Koebe" in bpy.data.objects["Panel"].data.uv_layers


@pytest.mark.alike
def test_two_inputs_are_2(addon_name, tmp_path):
    saved(tmp_path / "in.blend")
    code, out, err = processes.run_batch(addon_name, tmp_path, "in.blend", "--output", "out.blend")
    assert code == 2 and "more than one IN.blend" in err, err


# ---------------------------------------------------------------- the objects


@pytest.mark.alike
def test_a_report_is_written_where_nothing_could_be_mapped(batch, tmp_path):
    scenes.add_object("Wire", [(0, 0, 0), (1, 0, 0)], [])
    code, out, err = batch("--output", "out.blend", "--report", "out.json")
    assert code == 3 and "Wire: it has no faces" in err
    content, entries = read_report(tmp_path)
    assert content["exit_code"] == 3 and content["output"] is None and "no faces" in entries["Wire"]["error"]["reason"]


@pytest.mark.alike
def test_a_report_is_written_on_a_scene_without_meshes(batch, tmp_path):
    code, out, err = batch("--output", "out.blend", "--report", "out.json")
    assert code == 3 and "no mesh objects" in err
    assert read_report(tmp_path)[0]["error"]["reason"] == "the scene has no mesh objects"


@pytest.mark.alike
def test_every_object_that_cannot_be_written_is_named(batch, tmp_path):
    for name in ("Good", "Full", "Fuller"):
        scenes.add_panel(name, **SMALL)
    for name in ("Full", "Fuller"):
        for _ in range(8):
            bpy.data.objects[name].data.uv_layers.new()
    code, out, err = batch("--output", "out.blend", "--report", "out.json")
    assert code == 3 and "Full: " in err and "Fuller: " in err, err
    assert outputs(tmp_path) == ["out.json"]
    content, entries = read_report(tmp_path)
    assert entries.keys() == {"Full", "Fuller"} and content["error"]["name"] == "TransferError"


@pytest.mark.alike
def test_a_named_object_without_faces_is_not_passed_over(batch, tmp_path):
    scenes.add_panel(**SMALL)
    scenes.add_object("Wire", [(0, 0, 0), (1, 0, 0)], [])
    assert batch("--output", "out.blend")[0] == 0
    code, out, err = batch("--output", "again.blend", "--objects", "Panel,Wire")
    assert code == 3 and "Wire: it has no faces" in err and outputs(tmp_path) == ["out.blend"]


def quoted(name):
    return '"' + name.replace('"', '""') + '"'


def test_names_of_all_kinds(batch, tmp_path):
    longest = 63 if bpy.app.version < (5, 0, 0) else 255  # bytes
    names = ["A", "B, not C", 'He said "no", twice', " spaced ", "two\nlines", "ö" * (longest // 2), "x" * longest,
             "🍳" * (longest // 4)]  # fmt: skip
    for name in [*names, "B", "not C"]:
        obj = scenes.add_panel(**SMALL)
        obj.name = name
        assert obj.name == name
    asked = ["--objects", ",".join(map(quoted, names[:3])), *(word for name in names[3:]
             for word in ("--objects", quoted(name) if "\n" in name else name))]  # fmt: skip
    for locale in ("C.UTF-8", "C"):
        code, out, err = batch("--output", "out.blend", "--report", "out.json", *asked, LC_ALL=locale)
        assert code == 0, err
        assert set(read_report(tmp_path)[1]) == set(names)
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "out.blend"))
    assert {obj.name for obj in bpy.data.objects if obj.data.uv_layers} == set(names)


@pytest.mark.alike
def test_a_missing_name_is_2_with_a_hint_where_commas_are_in_the_way(batch):
    scenes.add_panel("B, not C", **SMALL)
    code, out, err = batch("--output", "out.blend", "--objects", "B, not C")
    assert code == 2 and """--objects '"B, not C"'""" in err, err
    code, out, err = batch("--output", "out.blend", "--objects", "x" * 230)
    assert code == 2 and ["x" * 230 in line for line in processes.own_lines(err)] == [True], err


@pytest.mark.alike
@pytest.mark.parametrize("outer", [99999, 0, 2**31 - 1])
def test_an_outer_vertex_that_is_on_no_face_is_2(batch, tmp_path, outer):
    vertices, faces = scenes.panel_arrays(**SMALL)
    scenes.add_object("Panel", [(0, 0, 0), *vertices], [[v + 1 for v in face] for face in faces])  # 0 is loose
    code, out, err = batch("--output", "out.blend", "--outer", outer)
    (line,) = processes.own_lines(err)
    assert code == 2 and f"--outer {outer}" in line and "Panel" in line, err
    assert outputs(tmp_path) == []


@pytest.mark.alike
def test_an_outer_vertex_that_is_on_no_boundary_is_3(batch, tmp_path):
    scenes.add_panel(**SMALL)
    code, out, err = batch("--output", "out.blend", "--outer", "0", "--report", "out.json")
    assert code == 3 and "no boundary loop" in err, err
    assert read_report(tmp_path)[1]["Panel"]["error"]["name"] == "InputError"


# ---------------------------------------------------------------- streams, faults and signals


@pytest.mark.alike
def test_what_is_printed_does_not_change_what_is_done(batch, tmp_path):
    """Names that the terminal's encoding does not have, a full device, a closed pipe."""
    scenes.add_panel("Küche 🍳", **SMALL)
    for name, options in {
        "ascii": {"PYTHONIOENCODING": "ascii:strict", "LC_ALL": "C", "PYTHONUTF8": "0"},
        "strict": {"patch": "sys.stdout.reconfigure(encoding='ascii', errors='strict')"},
        "full": {"patch": "os.dup2(os.open('/dev/full', os.O_WRONLY), 1)"},
        "closed": {"patch": "reader, writer = os.pipe()\nos.close(reader)\nos.dup2(writer, 1)"},
    }.items():
        code, out, err = batch("--output", f"{name}.blend", **options)
        assert code == 0, (name, err)
    assert outputs(tmp_path) == ["ascii.blend", "closed.blend", "full.blend", "strict.blend"]


@pytest.mark.alike
def test_a_fault_is_1_and_no_memory_is_3(batch, tmp_path):
    scenes.add_panel(**SMALL)
    fault = "def compute(job):\n    raise {}\nbatch.compute = compute"
    code, out, err = batch("--output", "out.blend", "--report", "out.json", patch=fault.format("ZeroDivisionError"))
    assert code == 1 and "ZeroDivisionError" in err and outputs(tmp_path) == []
    code, out, err = batch("--output", "out.blend", "--report", "out.json", patch=fault.format("MemoryError"))
    assert code == 3 and "memory" in err and "Traceback" not in err and outputs(tmp_path) == ["out.json"]


@pytest.mark.alike
def test_what_cannot_be_written_after_all_is_3_with_a_report(batch, tmp_path):
    scenes.add_panel(**SMALL)
    patch = """
def write(job):
    raise batch.TransferError("Panel: it has gone")
batch.Job.write = write
"""
    code, out, err = batch("--output", "out.blend", "--report", "out.json", patch=patch)
    assert code == 3 and "Panel: it has gone" in err and "Traceback" not in err and outputs(tmp_path) == ["out.json"]
    assert read_report(tmp_path)[0]["error"] == {"name": "TransferError", "reason": "Panel: it has gone"}


@pytest.mark.alike
def test_no_native_module_is_1_with_a_report(batch, tmp_path):
    scenes.add_panel(**SMALL)
    patch = """
def load():
    raise batch.NativeError("the native module does not load: really")
from koebe_uv_batch.jobs import native_package
native_package.load = load
"""
    code, out, err = batch("--output", "out.blend", "--report", "out.json", patch=patch)
    assert code == 1 and "does not load: really" in err and outputs(tmp_path) == ["out.json"]
    assert read_report(tmp_path)[0]["error"]["name"] == "NativeError"


MOMENTS = {
    "read": "after(batch, 'new_job', act)",
    "computed": "after(batch.Job, 'compute', act)",
    "mapped": "after(batch, 'map_objects', act)",
    "saved": "after(batch, 'save_blend', act)",
    "report made": "after(batch, 'save_json', act)",
}


@pytest.mark.alike
@pytest.mark.parametrize(
    ("moment", "number"),
    [*((moment, signal.SIGINT) for moment in MOMENTS), ("saved", signal.SIGTERM), ("saved", signal.SIGHUP)],
)
def test_a_signal_at_any_moment_is_130_and_nothing_is_written(batch, tmp_path, moment, number):
    scenes.add_panel(**SMALL)
    (tmp_path / "out.blend").write_text("older")
    patch = f"def act():\n    os.kill(os.getpid(), {int(number)})\n{MOMENTS[moment]}"
    code, out, err = batch("--output", "out.blend", "--report", "out.json", patch=patch)
    assert code == 130 and "interrupted" in err and "Traceback" not in err, err
    assert outputs(tmp_path) == ["out.blend"] and (tmp_path / "out.blend").read_text() == "older"


@pytest.mark.alike
def test_a_signal_between_the_two_files_lets_both_be_written(batch, tmp_path):
    scenes.add_panel(**SMALL)
    patch = "def act():\n    os.kill(os.getpid(), signal.SIGTERM)\nafter(batch.Target, 'put', act)"
    code, out, err = batch("--output", "out.blend", "--report", "out.json", patch=patch)
    assert code == 0, err
    assert outputs(tmp_path) == ["out.blend", "out.json"]


OBEYS = "while not job.cancel_token.cancelled:\n        time.sleep(0.01)"
DOES_NOT_OBEY = "batch.PATIENCE_SECONDS = 0.1\n    while True:\n        time.sleep(0.01)"


@pytest.mark.alike
@pytest.mark.parametrize("conduct", [OBEYS, DOES_NOT_OBEY], ids=["obeys", "does not obey"])
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM], ids=lambda number: number.name)
def test_a_signal_ends_a_computation_that_takes_for_ever(addon_name, koebe, tmp_path, conduct, number):
    scenes.add_panel(**SMALL)
    patch = f"""
def compute(job, progress=None):
    print("COMPUTING", flush=True)
    {conduct}
    raise job.koebe.Cancelled("cancelled")
batch.Job.compute = compute
"""
    process = processes.start_batch(
        addon_name, tmp_path, "--output", "out.blend", patch=patch, before=lambda: signal.signal(number, signal.SIG_DFL)
    )
    while process.stdout.readline().strip() != "COMPUTING":
        assert process.poll() is None
    process.send_signal(number)
    code, out, err = processes.finish(process)
    assert code == 130 and "interrupted" in err, err
    assert outputs(tmp_path) == []
