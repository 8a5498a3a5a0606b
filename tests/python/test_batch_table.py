"""koebe batch: the results and the table, and what is done again."""

import csv
import hashlib
import json
import os

import numpy as np
import pytest
from batch_support import TETRAHEDRON, batch, rows
from cli_support import CANNOT_BE_MAPPED, NOT_CONVERGED, USAGE, contents, koebe, obj_text, perforated
from domain_surfaces import holed_ring, holed_torus

pytestmark = pytest.mark.slow


# ---------------------------------------------------------------- the table


@pytest.fixture
def tiles(tmp_path):
    """A torus with three holes, an annulus with two, and a tetrahedron."""
    folder = tmp_path / "tiles"
    folder.mkdir()
    for name, surface in (("torus", holed_torus(4)), ("ring", holed_ring(4, holes={(1, 0): ((0.5, 0.5), 0.3)}))):
        (folder / f"{name}.obj").write_text(obj_text(*surface[:2]))
    (folder / "closed.off").write_text(TETRAHEDRON)
    return folder


@pytest.mark.parametrize("words", [["torus"], ["ring"], ["ring", "--holes", "radial"], ["ring", "--tolerance", "1e-3"]],
                         ids=" ".join)  # fmt: skip
def test_other_domains_are_those_of_their_commands(tiles, tmp_path, words):
    domain, *options = words
    out = tmp_path / "out"
    done = batch(tiles, "--output", out, "--domain", domain, *options)
    assert done.returncode == CANNOT_BE_MAPPED and done.stdout.startswith("3 files: 1 done, 2 failed;")
    table = rows(out)
    assert table["closed.off"]["error"] in ("TopologyError(genus)", "TopologyError(closed)")
    row = table[f"{domain}.obj"]
    assert row["options"]["domain"] == domain and row["flipped"] == 0 and row["faces"] > 0
    koebe(domain, tiles / f"{domain}.obj", tmp_path / "alone.obj", *options)
    assert (tmp_path / "alone.obj").read_bytes() == (out / f"{domain}.obj").read_bytes()
    again = batch(tiles, "--output", out, "--domain", domain, *options)
    assert "(3 unchanged)" in again.stdout
    other = batch(tiles, "--output", out, "--domain", domain, "--max-sweeps", "40", *options)
    assert "unchanged" not in other.stdout


# Of a domain: its option and the words of this, whose surfaces are mapped, and whose have the wrong number of handles.
WORDS = {
    "sphere": ("layout", ["equirectangular", "octahedral"], ["ring.obj", "closed.off"], ["torus.obj"]),
    "schottky": ("normalization", ["area", "circles"], ["torus.obj"], ["ring.obj", "closed.off"]),
}


@pytest.mark.parametrize("chosen", [0, 1])
@pytest.mark.parametrize("domain", WORDS)
def test_spheres_and_handles_are_those_of_the_command(tiles, tmp_path, domain, chosen):
    """The word of the option is a part of the recipe."""
    option, words, fitting, others = WORDS[domain]
    asked, other = (["--domain", domain, f"--{option}", words[k]] for k in (chosen, 1 - chosen))
    out = tmp_path / "out"
    done = batch(tiles, "--output", out, *asked)
    counts = f"3 files: {len(fitting)} done, {len(others)} failed;"
    if words[chosen] == "octahedral":  # a tetrahedron has no layout on the octahedron
        counts = "3 files: 1 done, 1 not converged, 1 failed;"
    assert done.returncode == CANNOT_BE_MAPPED and done.stdout.startswith(counts)
    table = rows(out)
    assert {table[source]["error"] for source in others} == {"TopologyError(genus)"}
    for source in fitting:
        row = table[source]
        assert row["options"] == {
            "domain": domain, option: words[chosen], "tolerance": 1e-6, "max_sweeps": 50, "most_lost": 0.01,
            "weld": None, **({"even": 0.0} if domain == "sphere" else {}),
        }  # fmt: skip
        assert (row["exit_code"] == 0) is (row["flipped"] == 0) and row["faces"] > 0 and row["angle_error_deg"] > 0
        koebe(domain, tiles / source, tmp_path / "alone.obj", f"--{option}", words[chosen])
        assert (tmp_path / "alone.obj").read_bytes() == (out / source).with_suffix(".obj").read_bytes()
    assert "(3 unchanged)" in batch(tiles, "--output", out, *asked).stdout
    assert "unchanged" not in batch(tiles, "--output", out, *other).stdout


CUT = {"parts": ("--price=0.1", "obj"), "pack": ("--margin=2", "obj"), "flatten": ("--units=cm", "dxf")}


@pytest.mark.parametrize("domain", CUT)
def test_parts_layers_and_patterns_are_those_of_their_commands(tiles, tmp_path, domain):
    """Every option is a part of the recipe, and a domain's own defaults hold."""
    option, ending = CUT[domain]
    for name in ("torus", "ring"):
        koebe("parts", tiles / f"{name}.obj", tiles / f"{name}.obj", "--quiet")
    out = tmp_path / "out"
    done = batch(tiles, "--output", out, "--domain", domain, option)
    failed = {"closed.off"} if domain == "pack" else set()  # it has no UVs
    assert done.returncode == (CANNOT_BE_MAPPED if failed else 0), done.stderr
    table = rows(out)
    assert {name for name, row in table.items() if row["exit_code"]} == failed
    for name in ("torus", "ring"):
        row = table[f"{name}.obj"]
        assert row["options"]["domain"] == domain and row["faces"] > 0 and row["angle_error_deg"] is not None
        koebe(domain, tiles / f"{name}.obj", tmp_path / f"alone.{ending}", option)
        assert (tmp_path / f"alone.{ending}").read_bytes() == (out / f"{name}.{ending}").read_bytes()
    assert "(3 unchanged)" in batch(tiles, "--output", out, "--domain", domain, option).stdout
    assert "unchanged" not in batch(tiles, "--output", out, "--domain", domain).stdout


def test_another_evenness_is_another_recipe(tiles, tmp_path):
    words = (tiles / "ring.obj", "--output", tmp_path / "out", "--domain", "ring")
    assert "unchanged" not in batch(*words).stdout
    assert "unchanged" not in batch(*words, "--even", "0.5").stdout
    assert rows(tmp_path / "out")["ring.obj"]["options"]["even"] == 0.5


@pytest.mark.parametrize("words", [
    ["--domain", "parts", "--holes", "radial"], ["--domain", "parts", "--margin", "-1"], ["--page", "A4"],
    ["--domain", "parts", "--format", "svg"], ["--domain", "flatten", "--format", "obj"], ["--format", "dxf"],
    ["--domain", "flatten", "--format", "svg"], ["--domain", "pack", "--price", "1"],
    ["--domain", "flatten", "--blender", "blender"], ["--domain", "flatten", "--page", "B9"],
    ["--domain", "ball"], ["--holes", "radial"], ["--layout", "octahedral"], ["--domain", "torus", "--holes", "radial"],
    ["--domain", "torus", "--balance", "area"], ["--domain", "ring", "--cut"], ["--domain", "sphere", "--outer", "3"],
    ["--domain", "ring", "--holes", "square"], ["--domain", "ring", "--layout", "octahedral"],
    ["--domain", "sphere", "--layout", "flat"], ["--domain", "sphere", "--polish"],
    ["--normalization", "area"], ["--domain", "schottky", "--normalization", "none"],
    ["--domain", "schottky", "--layout", "octahedral"], ["--domain", "torus", "--normalization", "area"],
], ids=" ".join)  # fmt: skip
def test_options_of_another_domain_are_wrong_usage(tiles, tmp_path, words):
    done = batch(tiles, "--output", tmp_path / "out", *words)
    assert done.returncode == USAGE and not (tmp_path / "out").exists()
    assert done.stderr.startswith("WrongUsage: ") and done.stderr.count("\n") == 1


def test_files_of_blender_are_told_the_domain(blends, tmp_path):
    files = blends(a="exit 0")
    out = tmp_path / "out"
    assert batch(*files.words, "--output", out, "--domain", "ring", "--holes", "radial").returncode == 0
    assert rows(out)["a.blend"]["options"]["arguments"] == ["--domain=ring", "--holes=radial"]
    assert "(1 unchanged)" in batch(*files.words, "--output", out, "--domain", "ring", "--holes", "radial").stdout
    assert "unchanged" not in batch(*files.words, "--output", out, "--domain", "torus").stdout
    assert len(files.runs("a")) == 2
    assert batch(*files.words, "--output", out, "--domain", "sphere", "--layout", "octahedral").returncode == 0
    assert rows(out)["a.blend"]["options"]["arguments"] == ["--domain=sphere", "--layout=octahedral"]
    assert batch(*files.words, "--output", out, "--domain", "schottky", "--normalization", "circles").returncode == 0
    assert rows(out)["a.blend"]["options"]["arguments"] == ["--domain=schottky", "--normalization=circles"]
    assert batch(*files.words, "--output", out, "--domain", "parts", "--margin", "4").returncode == 0
    assert rows(out)["a.blend"]["options"]["arguments"] == ["--parts", "--margin=4"]


def test_each_file_has_a_result_a_report_and_a_row(library, tmp_path):
    out = tmp_path / "out"
    done = batch(library, "--output", out)
    assert done.returncode == CANNOT_BE_MAPPED
    assert done.stdout.startswith("6 files: 4 done, 2 failed;")
    table = rows(out)
    assert list(table) == ["a.obj", "b.obj", "broken.ply", "closed.off", "masks/c.obj", "masks/d.obj"]
    assert {name: row["exit_code"] for name, row in table.items() if row["exit_code"]} == {
        "broken.ply": 3, "closed.off": 3}  # fmt: skip
    assert table["closed.off"]["error"] == "TopologyError(closed)" and "closed" in table["closed.off"]["error_text"]
    assert table["broken.ply"]["error"] == "InputError" and table["broken.ply"]["faces"] is None
    for name in ("a.obj", "masks/d.obj"):
        report = json.loads((out / name).with_suffix(".json").read_text())
        row = table[name]
        assert row["input_sha256"] == hashlib.sha256((library / name).read_bytes()).hexdigest()
        assert row["input_sha256"] == report["input_sha256"]
        assert report["output_sha256"] == hashlib.sha256((out / name).read_bytes()).hexdigest()
        assert row["faces"] == report["faces"] > 0 and row["flipped"] == 0 == row["below_resolution"]
        assert row["angle_error_deg"] == report["angle_error_deg"]["mean"]
        assert row["warnings"] == len(report["warnings"]) and row["seconds"] == report["seconds"]["total"]
        assert row["version"] == report["version"] and row["options"]["method"] == "gk"
        assert row["output"] == name
        koebe("uniformize", library / name, tmp_path / "alone.obj")
        assert (tmp_path / "alone.obj").read_bytes() == (out / name).read_bytes()
    with open(out / "summary.csv", newline="") as file:
        as_csv = list(csv.DictReader(file))
    assert [row["name"] for row in as_csv] == list(table) and as_csv[0].keys() == table["a.obj"].keys()
    assert json.loads(as_csv[0]["options"]) == table["a.obj"]["options"]
    assert {p.name for p in out.iterdir()} == {
        "a.obj", "a.json", "b.obj", "b.json", "broken.json", "closed.json", "masks", "summary.json", "summary.csv"
    }  # fmt: skip


def test_the_report_of_one_map_has_hash_and_options_too(library, tmp_path):
    report = tmp_path / "report.json"
    assert koebe("uniformize", library / "a.obj", tmp_path / "o.obj", "--json", report, "--method=ck").returncode == 0
    content = json.loads(report.read_text())
    assert content["input_sha256"] == hashlib.sha256((library / "a.obj").read_bytes()).hexdigest()
    assert content["options"] == {
        "method": "ck", "engine": "condensed", "outer": "auto", "center": None, "point": None, "tolerance": 1e-6,
        "max_sweeps": 50, "most_lost": 0.01, "balance": "none", "polish": False,
        "even": 0.0, "loops": "auto", "weld": None, "margin": 8.0, "pixels": 2048,
    }  # fmt: skip


def test_options_reach_each_map_and_the_format_is_of_the_results(library, tmp_path):
    words = ("--method=ck", "--engine", "mesh", "--schedule", "0,1,2,3", "--max-sweeps", 1, "--polish", "--format=ply")
    done = batch(library / "a.obj", "--output", tmp_path / "out", *words)
    assert done.returncode == NOT_CONVERGED, done.stderr
    row = rows(tmp_path / "out")["a.obj"]
    assert row["exit_code"] == NOT_CONVERGED and row["error"] is None and row["output"] == "a.ply"
    assert row["options"]["schedule"] == ["0", "1", "2", "3"] and row["options"]["polish"] is True
    koebe("uniformize", library / "a.obj", tmp_path / "alone.ply", *words[:-1])
    assert (tmp_path / "out" / "a.ply").read_bytes() == (tmp_path / "alone.ply").read_bytes()


def test_bad_meshes_win_over_those_that_did_not_converge(library, tmp_path):
    words = ("--output", tmp_path / "out", "--max-sweeps", 1, "--quiet")
    done = batch(library / "a.obj", library / "closed.off", *words)
    assert (done.returncode, done.stdout, done.stderr) == (CANNOT_BE_MAPPED, "", "")


def test_an_option_that_does_not_fit_one_mesh_fails_that_one(library, tmp_path):
    done = batch(library / "a.obj", "--output", tmp_path / "out", "--center", 100000)
    assert done.returncode == CANNOT_BE_MAPPED
    assert rows(tmp_path / "out")["a.obj"]["error"] == "WrongUsage"


@pytest.mark.parametrize(
    ("words", "reason"),
    [
        (["library"], "--output is required"),
        (["nowhere", "--output", "out"], "does not exist"),
        (["library/notes.txt", "--output", "out"], "is not a mesh file"),
        (["library/s.blend", "--output", "out"], "--blender"),
        (["library/a.obj", "other/a.obj", "--output", "out"], "would both get the name a.obj"),
        (["library/a.obj", "other/a.ply", "--output", "out"], "would both write"),
        (["other/summary.obj", "--output", "out"], "the summary's name"),
        (["library/a.obj", "--output", "library"], "would replace the mesh"),
        (["library/a.obj", "--base", "other", "--output", "out"], "is not in --base"),
        (["empty", "--output", "out"], "no mesh file in empty"),
        (["library", "--output", "out", "--workers", "-1"], "--workers"),
        (["library", "--output", "out", "--time-limit", "0"], "--time-limit"),
        (["library", "--output", "out", "--format", "stl"], "--format"),
        (["library", "--output", "out", "--center", "1", "--balance", "area"], "--center"),
    ],
)
def test_wrong_usage_is_told_and_nothing_is_written(library, tmp_path, words, reason):
    for name in ("other/a.obj", "other/a.ply", "other/summary.obj", "library/s.blend"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text("something")
    (tmp_path / "empty").mkdir()
    before = {p.relative_to(tmp_path) for p in tmp_path.rglob("*")}
    done = batch(*words, cwd=tmp_path)
    assert done.returncode == USAGE
    assert reason in done.stderr and done.stderr.count("\n") == 1 and done.stdout == ""
    assert {p.relative_to(tmp_path) for p in tmp_path.rglob("*")} == before


def test_results_may_lie_in_the_library_and_are_no_inputs(library):
    assert batch(library / "a.obj", library / "masks", library / "a.obj", "--output", library / "out").returncode == 0
    assert set(rows(library / "out")) == {"a.obj", "c.obj", "d.obj"}
    batch(library, "--output", library / "out")
    assert not any(name.startswith("out/") for name in rows(library / "out"))


def test_a_base_gives_single_files_the_names_of_a_whole_run(library, tmp_path):
    batch(library, "--output", tmp_path / "whole")
    for path in sorted(library.rglob("*.o*")) + [library / "broken.ply"]:
        if not path.name.startswith("."):
            batch(path, "--base", library, "--output", tmp_path / "single")
    assert contents(tmp_path / "single") == contents(tmp_path / "whole")


def test_runs_on_single_files_leave_the_table_to_one_of_all(library, tmp_path):
    out = tmp_path / "out"
    listed = batch(library, library / "masks" / "c.obj", "--output", out, "--list")
    assert listed.returncode == 0 and not out.exists()
    pairs = [line.split("\t") for line in listed.stdout.splitlines()]
    own = str(library / "masks")
    names = ["a.obj", "b.obj", "broken.ply", "closed.off", "masks/c.obj", "masks/d.obj"]
    assert sorted(pairs) == sorted([[str(library), name] for name in names] + [[own, "c.obj"]])
    for folder, name in pairs:
        batch(f"{folder}/{name}", "--base", folder, "--output", out, "--no-summary")
    assert not (out / "summary.json").exists()
    done = batch(library, "--output", out, "--summary-only")
    assert (done.returncode, done.stdout) == (0, f"the table is {out}/summary.json\n")
    assert list(rows(out)) == sorted([*names, "c.obj"])


# ---------------------------------------------------------------- what is done again


def again(library, out, *words):
    """Runs once more; the names that were mapped."""
    done = batch(library, "--output", out, *words)
    told = dict(line.split("] ", 1)[1].split(": ", 1) for line in done.stderr.splitlines())
    return {name for name, how in told.items() if not how.startswith("unchanged")}


def test_what_is_done_and_unchanged_is_skipped(library, tmp_path):
    out = tmp_path / "out"
    everything = again(library, out)
    assert len(everything) == 6
    first = contents(out)
    assert again(library, out) == set()
    os.utime(library / "a.obj")  # its time is not its content
    assert again(library, out, "--threads", 1) == set()
    assert contents(out) == first

    (library / "a.obj").write_text(obj_text(*perforated(14)))
    assert again(library, out) == {"a.obj"}
    (out / "b.obj").unlink()
    assert again(library, out) == {"b.obj"}
    with open(out / "b.obj", "r+") as damaged:
        damaged.truncate(1000)
    assert again(library, out) == {"b.obj"}
    (out / "masks" / "c.json").write_text("{")
    assert again(library, out) == {"masks/c.obj"}
    assert again(library, out, "--retry") == {"broken.ply", "closed.off"}
    assert again(library, out, "--format", "ply") == {"a.obj", "b.obj", "masks/c.obj", "masks/d.obj"}
    assert again(library, out, "--tolerance", "1e-5") == everything


def test_another_version_maps_again(library, tmp_path):
    out = tmp_path / "out"
    batch(library / "a.obj", "--output", out)
    report = json.loads((out / "a.json").read_text())
    (out / "a.json").write_text(json.dumps({**report, "version": "0.0.1"}))
    assert again(library / "a.obj", out) == {"a.obj"}


def test_a_result_does_not_outlive_the_mesh_it_was_made_of(library, tmp_path):
    out = tmp_path / "out"
    batch(library / "a.obj", "--output", out)
    (library / "a.obj").write_text("v 1 2\n")
    assert batch(library / "a.obj", "--output", out).returncode == CANNOT_BE_MAPPED
    assert not (out / "a.obj").exists() and rows(out)["a.obj"]["error"] == "InputError"


def test_a_batch_joins_vertices_and_maps_again_with_another_distance(tmp_path):
    vertices, faces = perforated(8, holes=((0.5, 0.5, 0.2),))
    (tmp_path / "in").mkdir()
    (tmp_path / "in" / "soup.obj").write_text(obj_text(vertices[faces.ravel()], np.arange(faces.size).reshape(-1, 4)))
    out = tmp_path / "out"
    assert "1 failed" in batch(tmp_path / "in", "--output", out).stdout
    for distance in (0, 1e-6):
        assert "1 done;" in batch(tmp_path / "in", "--output", out, "--weld", distance).stdout
        assert rows(out)["soup.obj"]["options"]["weld"] == distance
    assert "unchanged" in batch(tmp_path / "in", "--output", out, "--weld", 1e-6).stdout
