"""Where the time of a command went, as tools for flame graphs read it."""

import json
import re
import time

import pytest
from cli_support import CANNOT_BE_MAPPED, USAGE, koebe, names, obj_text, perforated


def stages(path):
    """The microseconds of each line's stages."""
    lines = path.read_text(encoding="utf-8").splitlines()
    assert all(re.fullmatch(r"[^;]+(;[^;]+)* [1-9]\d*", line) for line in lines)
    return {tuple(line.rpartition(" ")[0].split(";")): int(line.rpartition(" ")[2]) for line in lines}


@pytest.fixture
def large(mesh):
    (mesh / "large.obj").write_text(obj_text(*perforated(100)))
    return mesh


def test_the_times_are_those_of_the_report(large):
    words = ["large.obj", "out.obj", "--json", "out.json", "--profile", "out.txt", "--threads", "1"]
    begin = time.monotonic()
    assert koebe("uniformize", *words, cwd=large).returncode == 0
    elapsed = time.monotonic() - begin
    found, seconds = stages(large / "out.txt"), json.loads((large / "out.json").read_text())["seconds"]
    assert {names[0] for names in found} == {"koebe uniformize"}
    assert {names[1] for names in found if len(names) > 1} == seconds.keys() - {"total"}
    assert {("factor", "order"), ("factor", "eliminate")} <= {names[1:3] for names in found}
    # One thread works at a time. A busy machine may stop it anywhere, so only the sums are compared.
    inside = sum(time for names, time in found.items() if len(names) > 1)
    assert 0.9e6 * (sum(seconds.values()) - seconds["total"]) <= inside <= sum(found.values()) <= 1e6 * elapsed


def test_parts_tell_their_stages_too(mesh):
    words = ["in.obj", "out.obj", "--json", "out.json", "--profile", "out.txt"]
    assert koebe("parts", *words, cwd=mesh).returncode == 0
    assert {"read", "topology", "even", "pack", "write"} <= {
        name for names in stages(mesh / "out.txt") for name in names
    }
    seconds = json.loads((mesh / "out.json").read_text())["seconds"]
    assert min(seconds[stage] for stage in ("read", "topology", "iterate", "finish", "write")) > 0.0
    assert sum(seconds.values()) - seconds["total"] <= seconds["total"]


@pytest.mark.parametrize("name", ["in.obj", "out.obj", "out.json", "/dev/stdout"])
def test_a_profile_needs_a_file_of_its_own(mesh, name):
    before = names(mesh)
    done = koebe("uniformize", "in.obj", "out.obj", "--json", "out.json", "--profile", name, cwd=mesh)
    assert done.returncode == USAGE and "--profile" in done.stderr, done.stderr
    assert names(mesh) == before


def test_a_profile_is_written_with_the_result_or_not_at_all(mesh):
    (mesh / "closed.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n")
    before = names(mesh)
    done = koebe("uniformize", "closed.obj", "out.obj", "--profile", "out.txt", cwd=mesh)
    assert done.returncode == CANNOT_BE_MAPPED and names(mesh) == before
    done = koebe("uniformize", "in.obj", "out.obj", "--profile", "no/folder/out.txt", cwd=mesh)
    assert done.returncode == CANNOT_BE_MAPPED and "FileError" in done.stderr and names(mesh) == before


def test_commands_without_a_map_have_a_profile(mesh):
    for words in (["module", "in.obj"], ["compare", "in.obj", "in.obj"], ["fill", "in.obj", "out.obj"]):
        assert koebe(*words, "--profile", "out.txt", cwd=mesh).returncode == 0
        assert {names[0] for names in stages(mesh / "out.txt")} == {f"koebe {words[0]}"}
