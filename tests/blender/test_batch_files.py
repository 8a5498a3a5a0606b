"""Which file is which, and what is written where: nothing of the user's is lost, and each file is whole or absent."""

import json
import os
import stat

import bpy
import processes
import pytest
import scenes

pytestmark = pytest.mark.alike

SMALL = {"size": 10, "holes": ((0.1, 0.4, 0.4, 0.7),)}


@pytest.fixture
def batch(addon_name, koebe, tmp_path):
    """A function that runs the installed batch.py in an empty folder on the open file, or on another one.

    By `koebe` the native module is unpacked before.
    """
    scenes.add_panel(**SMALL)
    folder = tmp_path / "farm"
    folder.mkdir()
    return lambda *arguments, **options: processes.run_batch(addon_name, folder, *arguments, **options)


@pytest.fixture
def farm(batch, tmp_path):
    return tmp_path / "farm"


def outputs(folder):
    return sorted(path.name for path in folder.iterdir() if not path.name.startswith("in.blend"))


def is_mapped(path):
    bpy.ops.wm.open_mainfile(filepath=str(path))
    return "Koebe" in bpy.data.objects["Panel"].data.uv_layers


def test_a_report_onto_the_input_or_the_output_is_refused(batch, farm):
    source = farm / "in.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(source), copy=True)
    content = source.read_bytes()
    (farm / "linked.json").symlink_to("in.blend")
    os.link(source, farm / "hard.json")
    (farm / "dir").symlink_to(".")
    for report in ("dir/in.blend", "linked.json", "hard.json", "dir/OUT.blend"):
        code, out, err = batch("--output", "out.blend", "--report", report, source=source)
        assert code == 2 and ["--report" in line for line in processes.own_lines(err)] == [True], (report, err)
        assert source.read_bytes() == content
        assert outputs(farm) == ["dir", "hard.json", "linked.json"]


def test_what_the_input_uses_is_no_place_for_an_output(batch, farm):
    image = bpy.data.images.new("Image", 4, 4)
    image.filepath_raw, image.file_format = str(farm / "image.png"), "PNG"
    image.save()
    image.use_fake_user = True
    content = (farm / "image.png").read_bytes()
    for arguments in (["--output", "image.png"], ["--output", "out.blend", "--report", "image.png"]):
        code, out, err = batch(*arguments)
        assert code == 2 and "image.png" in err, err
        assert (farm / "image.png").read_bytes() == content and outputs(farm) == ["image.png"]


def test_links_are_followed_and_stay(batch, farm, tmp_path):
    (tmp_path / "store").mkdir()
    (farm / "out.blend").symlink_to("../store/whole.blend")  # which is not there yet
    (farm / "out.json").symlink_to("../store/whole.json")
    (tmp_path / "store" / "whole.json").write_text("older, and longer than nothing")
    assert batch("--output", "out.blend", "--report", "out.json")[0] == 0
    assert (farm / "out.blend").is_symlink() and (farm / "out.json").is_symlink()
    assert sorted(path.name for path in (tmp_path / "store").iterdir()) == ["whole.blend", "whole.json"]
    assert json.loads((tmp_path / "store" / "whole.json").read_text())["exit_code"] == 0
    assert is_mapped(tmp_path / "store" / "whole.blend")


def test_permissions_of_what_is_replaced_stay(batch, farm):
    for name in ("out.blend", "out.json"):
        (farm / name).write_text("older")
        (farm / name).chmod(0o640)
    assert batch("--output", "out.blend", "--report", "out.json")[0] == 0
    assert [stat.S_IMODE((farm / name).stat().st_mode) for name in ("out.blend", "out.json")] == [0o640, 0o640]


@pytest.mark.parametrize("kind", ["terminal", "folder", "missing", "long path"])
def test_an_output_that_cannot_be_a_file_is_refused_before_any_work(batch, farm, kind):
    deep = farm / "/".join(["d" * 200] * 6)
    if kind == "folder":
        (farm / "out.blend").mkdir()
    elif kind == "long path":
        os.makedirs(deep)
    # A device in whose folder nothing can be replaced, were it tried: to try it on /dev/null would be rash.
    ends = processes.open_terminal() if kind == "terminal" else ()
    output = {"folder": "out.blend", "missing": "no/out.blend", "long path": deep / "out.blend"}.get(kind)
    output = output or os.ttyname(ends[1])
    before = outputs(farm)
    code, out, err = batch("--output", output, patch="batch.map_objects = None")
    assert code == 2 and [str(output) in line for line in processes.own_lines(err)] == [True], err
    assert outputs(farm) == before
    for end in ends:
        os.close(end)


def test_a_report_goes_into_devices_and_pipes(batch, farm):
    code, out, err = batch("--output", "out.blend", "--report", "/dev/fd/1")
    assert code == 0, err
    assert json.JSONDecoder().raw_decode(out[out.index("{"):])[0]["exit_code"] == 0
    assert outputs(farm) == ["out.blend"]


@pytest.mark.parametrize(
    "name", ["o" * 249 + ".blend", "Küche 厨房 🍳" + "ö" * 100 + "\udcff.blend"], ids=["long", "strange"]
)
def test_names_as_long_and_strange_as_files_can_have(batch, farm, name):
    code, out, err = batch("--output", name, "--report", name[: -len(".blend")] + ".json")
    assert code == 0, err
    assert outputs(farm) == sorted([name, name[: -len(".blend")] + ".json"])
    assert (farm / name).read_bytes().startswith(b"BLENDER")


def test_a_full_disk_leaves_all_as_it_was(batch, farm):
    (farm / "out.blend").write_text("older")
    (farm / "out.json").write_text("older")
    bpy.data.texts.new("Ballast").write("0123456789" * 40000)
    bpy.ops.wm.save_as_mainfile(filepath=str(farm / "in.blend"), copy=True)
    size = (farm / "in.blend").stat().st_size
    for limit in (0, size - 20000):
        code, out, err = batch(
            "--output", "out.blend", "--report", "out.json", source=farm / "in.blend",
            patch=f"import resource\nresource.setrlimit(resource.RLIMIT_FSIZE, ({limit}, resource.RLIM_INFINITY))",
        )  # fmt: skip
        assert code in (1, 2) and "out.blend" in err and "Traceback" not in err, err
        assert outputs(farm) == ["out.blend", "out.json"]
        assert (farm / "out.blend").read_text() == (farm / "out.json").read_text() == "older"


def test_a_report_that_cannot_be_written_leaves_no_output_either(batch, farm):
    patch = """
def fail(path, content):
    raise OSError(28, "No space left on device")
batch.save_json = fail
"""
    code, out, err = batch("--output", "out.blend", "--report", "out.json", patch=patch)
    assert code == 1 and "out.json" in err and "No space left" in err
    assert outputs(farm) == []


MOMENTS = {
    "read": "after(batch, 'new_job', act)",
    "mapped": "after(batch, 'map_objects', act)",
    "saved": "after(batch, 'save_blend', act)",
    "report made": "after(batch, 'save_json', act)",
    "output there": "after(batch.Target, 'put', act)",
}


@pytest.mark.parametrize("moment", MOMENTS)
def test_killed_at_any_moment_each_file_is_whole_or_as_it_was(batch, farm, moment):
    (farm / "out.blend").write_text("older")
    patch = f"def act():\n    os.kill(os.getpid(), signal.SIGKILL)\n{MOMENTS[moment]}"
    code, out, err = batch("--output", "out.blend", "--report", "out.json", patch=patch)
    assert code == -9
    assert not (farm / "out.json").exists()
    if moment == "output there":
        assert is_mapped(farm / "out.blend")
    else:
        assert (farm / "out.blend").read_text() == "older"
    left = [path for path in farm.iterdir() if path.name.startswith(".koebe-")]
    assert len(left) == {"saved": 1, "report made": 2, "output there": 1}.get(moment, 0)
    if moment == "report made":
        for path in left:
            os.utime(path, (1e9, 1e9))
        assert batch("--output", "out.blend", "--report", "out.json")[0] == 0
        assert outputs(farm) == ["out.blend", "out.json"], "what killed runs left is removed when it is a day old"
