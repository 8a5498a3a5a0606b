"""Shapes by their conformal modules: invariances, comparison, alignment; in Python and by the command."""

import json
from pathlib import Path

import exact_surfaces
import koebe
import numpy as np
import pytest
from cli_support import succeeded
from test_cli import CANNOT_BE_MAPPED, NOT_CONVERGED, USAGE, obj_text, perforated, triangles_of
from test_cli import koebe as command

SHARED = Path(__file__).resolve().parents[3] / "shared" / "meshes" / "good"
HOLES = ((0.3, 0.3, 0.12), (0.7, 0.35, 0.1), (0.5, 0.72, 0.14))


class Domain:
    """Circles as a result has them."""

    def __init__(self, *circles):
        self.centers = np.array([[0.0, 0.0], *(c[:2] for c in circles)])
        self.radii = np.array([1.0, *(c[2] for c in circles)])


def plate(n=32, holes=HOLES):
    """A flat square with round holes."""
    vertices, quads = perforated(n, holes)
    vertices[:, 2] = 0.0
    return vertices, triangles_of(quads)


def mirrored(vertices, faces):
    """The mirror image, its faces turned so that they are seen from the same side."""
    return vertices * [-1.0, 1.0, 1.0], faces[:, ::-1].copy()


def write(path, vertices, faces):
    path.write_text(obj_text(vertices, faces))
    return path


FLAT = plate()
RESULT = koebe.uniformize(*FLAT)


# ---------------------------------------------------------------- the module


def test_the_module_has_3n_minus_3_numbers_or_one_or_none():
    for holes, count in ((0, 0), (1, 1), (2, 3), (3, 6)):
        result = koebe.uniformize(*plate(16, HOLES[:holes]))
        assert koebe.conformal_module(result).shape == (count,)
        assert len(koebe.module_names(holes + 1)) == count
    assert koebe.module_names(4) == ["r_1", "y_2", "r_2", "x_3", "y_3", "r_3"]


def test_a_domain_in_normal_position_is_read_off():
    domain = Domain((0.0, 0.0, 0.25), (0.0, 0.6, 0.125), (0.4, -0.3, 0.2))
    assert koebe.conformal_module(domain) == pytest.approx([0.25, 0.6, 0.125, 0.4, -0.3, 0.2], abs=1e-15)
    assert koebe.conformal_module(domain, order=[0, 2, 1, 3])[0] > 0.125


def test_one_hole_gives_the_radius_of_the_annulus():
    domain = Domain((0.3, -0.2, 0.2))
    result = koebe.uniformize(*plate(32, HOLES[:1]))
    assert koebe.conformal_module(result) == pytest.approx([result.radii[1]], abs=1e-12)
    x = 1.0 + 0.2**2 - 0.3**2 - 0.2**2
    assert koebe.conformal_module(domain)[0] == pytest.approx((x - np.sqrt(x * x - 4 * 0.04)) / 0.4, abs=1e-12)


def test_the_end_of_a_limb_is_found_until_rounding_takes_it():
    vertices, triangles, radius = exact_surfaces.limb(20, 24)
    assert koebe.conformal_module(koebe.uniformize(vertices, triangles)) == pytest.approx([radius], rel=0.1)
    lost = koebe.uniformize(*exact_surfaces.limb(60, 24)[:2])
    assert [(w.kind, w.elements) for w in lost.warnings if w.kind == "lost_circles"] == [("lost_circles", [1])]
    with pytest.raises(koebe.InputError) as refused:
        koebe.conformal_module(lost)
    assert list(refused.value.elements) == [1]


def test_a_fold_that_stretches_nothing_changes_nothing():
    vertices, faces = FLAT
    folded = vertices.copy()
    right = folded[:, 0] > 0.5  # no edge crosses the line x = 1/2 of the grid away from the holes' rims
    crossing = right[faces].any(axis=1) & (vertices[faces][:, :, 0] < 0.5 - 1e-12).any(axis=1)
    assert not crossing.any()
    arm = folded[right, 0] - 0.5
    folded[right, 0], folded[right, 2] = 0.5 + 0.6 * arm, 0.8 * arm
    assert koebe.module_distance(koebe.uniformize(folded, faces), RESULT) < 1e-9


def test_a_moebius_image_has_the_same_module():
    vertices, faces = plate(48)
    z = vertices[:, 0] + 1j * vertices[:, 1]
    w = (z - 0.2) / (1.0 + 0.35 * z - 0.2j * z)
    image = np.column_stack([w.real, w.imag, np.zeros(len(w))])
    assert koebe.module_distance(koebe.uniformize(image, faces), koebe.uniformize(vertices, faces)) < 2e-3


def test_renumbered_loops_are_the_same_shape():
    vertices, faces = FLAT
    new = np.random.default_rng(1).permutation(len(vertices))
    shuffled = np.empty_like(vertices)
    shuffled[new] = vertices
    other = koebe.uniformize(shuffled, new[faces[::-1]].astype(np.int32))
    assert koebe.module_distance(other, RESULT) < 1e-7
    module = koebe.conformal_module(RESULT, order="canonical")
    assert koebe.conformal_module(other, order="canonical") == pytest.approx(module, abs=1e-7)
    order, other_order, _ = koebe.match_loops(RESULT, other)
    for k, j in zip(order, other_order, strict=True):
        assert set(new[RESULT.loops[k]]) == set(other.loops[j])


def test_a_mirror_image_is_another_shape():
    result = koebe.uniformize(*mirrored(*FLAT))
    assert koebe.module_distance(result, RESULT) > 0.01
    order, other_order, _ = koebe.match_loops(RESULT, result)
    module, other = koebe.conformal_module(RESULT, order=order), koebe.conformal_module(result, order=order)
    assert other * [1, 1, 1, -1, 1, 1] == pytest.approx(module, abs=1e-6)


def test_distance_of_modules_is_euclidean_and_of_results_matched():
    assert koebe.module_distance([3.0, 0.0], np.array([0.0, 4.0])) == 5.0
    a = Domain((0.0, 0.0, 0.25), (0.0, 0.6, 0.125), (0.4, -0.3, 0.2))
    b = Domain((0.4, -0.3, 0.2), (0.0, 0.0, 0.25), (0.0, 0.6, 0.125))
    assert koebe.module_distance(a, b) < 1e-12
    assert koebe.module_distance(koebe.conformal_module(a), koebe.conformal_module(b)) > 0.1


@pytest.mark.parametrize(
    "call",
    [
        lambda: koebe.module_distance([1.0], [1.0, 2.0]),
        lambda: koebe.module_distance(RESULT, koebe.uniformize(*plate(16, HOLES[:2]))),
        lambda: koebe.conformal_module(RESULT, order=[0, 1]),
        lambda: koebe.conformal_module(RESULT, order=[0, 1, 1, 2]),
        lambda: koebe.conformal_module(RESULT, order=[]),
        lambda: koebe.conformal_module(RESULT, order="longest"),
        lambda: koebe.conformal_module(np.zeros(3)),
        lambda: koebe.align_domains(RESULT, RESULT, match=[1, 0, 2, 3]),
    ],
)
def test_what_cannot_be_compared_is_refused(call):
    with pytest.raises(koebe.InputError):
        call()


def test_alignment_carries_points_of_one_disk_to_the_other():
    a, turn = 0.3 - 0.4j, np.exp(0.7j)
    z = RESULT.uv[:, 0] + 1j * RESULT.uv[:, 1]
    w = turn * (z - a) / (1 - np.conj(a) * z)
    moved = Domain()
    rims = [np.setdiff1d(loop, off) for loop, off in zip(RESULT.loops, RESULT.off_circle, strict=True)]
    circles = [np.column_stack([w[rim].real, w[rim].imag]) for rim in rims]
    fits = [np.linalg.lstsq(np.column_stack([2 * c, np.ones(len(c))]), (c**2).sum(1), rcond=None)[0] for c in circles]
    moved.centers = np.array([fit[:2] for fit in fits])
    moved.radii = np.array([np.sqrt(fit[2] + fit[0] ** 2 + fit[1] ** 2) for fit in fits])
    found = koebe.align_domains(moved, RESULT)
    assert found.residual < 1e-9 and found.match == [0, 1, 2, 3]
    assert found(RESULT.uv) == pytest.approx(np.column_stack([w.real, w.imag]), abs=1e-8)


# ---------------------------------------------------------------- the command


def test_module_prints_json_that_agrees_with_python(tmp_path):
    run = succeeded("module", write(tmp_path / "plate.obj", *FLAT))
    report = json.loads(run.stdout)
    assert run.stderr == ""
    assert report["module"] == pytest.approx(koebe.conformal_module(RESULT), abs=1e-9)
    assert report["names"] == koebe.module_names(4) and report["input"] == "plate.obj" and report["converged"]
    loops = koebe.boundary_loops(FLAT[1])
    assert [set(loops[rank]) for rank in report["loops"]] == [set(loop) for loop in RESULT.loops]


def test_module_takes_any_order_of_the_loops(tmp_path):
    file = write(tmp_path / "plate.obj", *FLAT)
    ranks = json.loads(command("module", file).stdout)["loops"]
    order = [2, 0, 3, 1]
    report = json.loads(command("module", file, "--loops", ",".join(str(ranks[k]) for k in order)).stdout)
    assert report["module"] == pytest.approx(koebe.conformal_module(RESULT, order=order), abs=1e-9)
    report = json.loads(command("module", file, "--loops", "canonical").stdout)
    assert report["module"] == pytest.approx(koebe.conformal_module(RESULT, order="canonical"), abs=1e-9)
    assert command("module", file, "--loops", "canonical", "--any-outer").returncode == 0


def test_compare_prints_the_distance_of_the_modules_it_reports(tmp_path):
    a, b = write(tmp_path / "a.obj", *FLAT), write(tmp_path / "b.obj", *mirrored(*FLAT))
    run = succeeded("compare", a, b, "--json", tmp_path / "out.json")
    word, number = run.stdout.split()
    report = json.loads((tmp_path / "out.json").read_text())
    assert word == "distance" and run.stdout.count("\n") == 1
    modules = [np.array(report[key]["module"]) for key in "ab"]
    assert float(number) == pytest.approx(np.linalg.norm(modules[0] - modules[1]), rel=1e-8)
    assert float(command("compare", b, a).stdout.split()[1]) == pytest.approx(float(number), rel=1e-6)
    for words in ([a, b, "--json"], ["--json", a, b]):
        assert json.loads(command("compare", *words).stdout) == report
    assert float(command("compare", a, a).stdout.split()[1]) == 0.0


def test_exit_codes(tmp_path):
    plate_file = write(tmp_path / "plate.obj", *FLAT)
    two = write(tmp_path / "two.obj", *plate(16, HOLES[:2]))
    for words in (
        ["compare", plate_file],
        ["compare"],
        ["module"],
        ["module", plate_file, "--loops", "some"],
        ["module", plate_file, "--loops", "0,canonical"],
        ["module", plate_file, "--any-outer"],
        ["module", plate_file, "--loops", "0,1,2,7"],
        ["compare", plate_file, two, "--loops", "canonical"],
        ["compare", plate_file, two, "--loops", "length", "--any-outer"],
    ):
        run = command(*words)
        assert run.returncode == USAGE and run.stdout == "", words
    for words in (
        ["compare", plate_file, two],
        ["compare", plate_file, two, "--loops", "length"],
        ["compare", plate_file, tmp_path / "absent.obj"],
        ["module", plate_file, "--loops", "0,1"],
        ["module", tmp_path / "absent.obj"],
    ):
        run = command(*words)
        assert run.returncode == CANNOT_BE_MAPPED and run.stdout == "" and run.stderr.count("\n") == 1, words
    assert command("module", plate_file, "--max-sweeps", 1, "--tolerance", 1e-15).returncode == NOT_CONVERGED
    run = command("compare", plate_file, plate_file, "--max-sweeps", 1, "--tolerance", 1e-15)
    assert run.returncode == NOT_CONVERGED and run.stdout.startswith("distance ")


# ---------------------------------------------------------------- scans, where they are


def shared_distance(a, b, *options):
    files = [SHARED / f"{name}.obj" for name in (a, b)]
    if not all(file.is_file() for file in files):
        pytest.skip("the shared meshes are not here")
    return float(command("compare", *files, *options).stdout.split()[1])


@pytest.mark.parametrize(
    ("a", "b", "limit"),
    [
        ("ict_head_neutral", "ict_head_neutral_sub45k", 1e-3),  # subdivided
        ("panel_featuretype", "panel_featuretype_rolled", 1e-3),  # bent without stretching
    ],
)
def test_the_same_shape_meshed_or_bent_otherwise_is_near(a, b, limit):
    assert shared_distance(a, b) < limit


def test_another_expression_is_farther_than_another_mesh():
    near = shared_distance("ict_head_neutral", "ict_head_neutral_sub45k")
    assert shared_distance("ict_head_neutral", "ict_head_jawOpen") > 100.0 * near
