"""koebe.Surface and `koebe sequence`: one surface whose vertices move."""

import json
import threading

import koebe
import numpy as np
import pytest
from cli_support import CANNOT_BE_MAPPED, USAGE, obj_text, perforated, succeeded, triangles_of
from cli_support import koebe as command

VERTICES, QUADS = perforated(24)
VERTICES = np.asarray(VERTICES, dtype=float)
TRIANGLES = triangles_of(QUADS)


def frame(amount):
    x, y, z = VERTICES.T
    return VERTICES + amount * np.stack([np.sin(3 * y), np.sin(2 * x + 1), np.cos(3 * x + y)], axis=1)


def test_the_first_map_is_that_of_uniformize_to_the_bit():
    surface = koebe.Surface(VERTICES, TRIANGLES)
    assert np.array_equal(surface.uniformize().uv, koebe.uniformize(VERTICES, TRIANGLES).uv)


@pytest.mark.parametrize("options", [{}, {"balance": "area"}, {"method": "ck"}, {"polish": True}, {"outer": "longest"}])
def test_a_moved_map_has_the_module_of_a_fresh_one(options):
    surface = koebe.Surface(VERTICES, TRIANGLES, **options)
    outer = int(surface.uniformize().loops[0][0])
    for amount in (0.01, 0.1):
        again = surface.uniformize(frame(amount))
        fresh = koebe.uniformize(frame(amount), TRIANGLES, **{**options, "outer": outer})
        assert again.converged and again.flipped == 0
        assert koebe.module_distance(again, fresh) < 2e-3
        assert again.options["method"] == options.get("method", "gk")


@pytest.mark.parametrize("holes", [((0.5, 0.5, 0.2),), ((0.3, 0.3, 0.12), (0.7, 0.4, 0.1), (0.5, 0.75, 0.12))])
def test_after_a_large_move_the_circles_are_those_of_a_map_by_itself(holes):
    vertices, quads = perforated(14, holes)
    triangles, noise = triangles_of(quads), np.random.default_rng(4).normal(size=vertices.shape)
    surface = koebe.Surface(vertices, triangles)
    outer = int(surface.uniformize().loops[0][0])
    for amount in (0.3 / 14, -0.3 / 14):
        moved = vertices + amount * noise
        fresh = koebe.uniformize(moved, triangles, outer=outer)
        assert koebe.module_distance(surface.uniformize(moved), fresh) < 1e-12


def test_a_texture_stays_in_its_place():
    surface = koebe.Surface(VERTICES, TRIANGLES)
    first = surface.uniformize()
    moved = surface.uniformize(frame(0.02))
    assert np.abs(moved.uv - first.uv).max() < 0.05


def test_center_and_point_are_held_in_every_map():
    inner = int(np.argmin(np.linalg.norm(VERTICES - VERTICES.mean(axis=0), axis=1)))
    on_loop = {int(v) for loop in koebe.boundary_loops(TRIANGLES) for v in loop}
    inner = inner if inner not in on_loop else next(v for v in range(len(VERTICES)) if v not in on_loop)
    surface = koebe.Surface(VERTICES, TRIANGLES, center=inner)
    for amount in (0.0, 0.03):
        result = surface.uniformize(frame(amount))
        assert np.abs(result.uv[inner]).max() < 1e-12


def test_bad_positions_are_named_and_the_surface_stays_usable():
    surface = koebe.Surface(VERTICES, TRIANGLES)
    first = surface.uniformize()
    with pytest.raises(koebe.InputError, match=f"{len(VERTICES)}"):
        surface.uniformize(VERTICES[:-1])
    torn = VERTICES.copy()
    torn[5, 2] = np.nan
    with pytest.raises(koebe.InputError) as told:
        surface.uniformize(torn)
    assert list(told.value.elements) == [5]
    token = koebe.CancelToken()
    token.cancel()
    with pytest.raises(koebe.Cancelled):
        surface.uniformize(frame(0.1), cancel=token)
    assert np.abs(surface.uniformize().uv - first.uv).max() < 1e-6


def test_options_are_refused_as_uniformize_refuses_them():
    with pytest.raises(koebe.OptionError):
        koebe.Surface(VERTICES, TRIANGLES, method="best")
    with pytest.raises(koebe.OptionError):
        koebe.Surface(VERTICES, TRIANGLES, center=1, balance="area")
    with pytest.raises(koebe.TopologyError):
        koebe.Surface([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])


def test_calls_of_several_threads_wait_for_each_other():
    surface = koebe.Surface(VERTICES, TRIANGLES)
    surface.uniformize()
    results = {}

    def run(amount):
        results[amount] = surface.uniformize(frame(amount))

    threads = [threading.Thread(target=run, args=(0.01 * k,)) for k in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all(results[0.01 * k].flipped == 0 and results[0.01 * k].converged for k in range(4))


@pytest.mark.parametrize("amount", [0.3, 1.0, 3.0])
def test_wild_positions_keep_the_promises(amount):
    random = np.random.default_rng(7)
    surface = koebe.Surface(VERTICES, TRIANGLES)
    surface.uniformize()
    for _ in range(5):
        result = surface.uniformize(VERTICES + amount * random.normal(size=VERTICES.shape) * 0.2)
        assert np.isfinite(result.uv).all() and np.linalg.norm(result.uv, axis=1).max() <= 1 + 1e-9
        assert result.flipped == 0 or not result.converged


def write_frames(folder, amounts):
    names = []
    for k, amount in enumerate(amounts):
        name = folder / f"frame{k:03}.obj"
        name.write_text(obj_text(frame(amount), QUADS))
        names.append(name)
    return names


def test_a_sequence_of_files_is_mapped_and_laid_over_the_first(tmp_path):
    files = write_frames(tmp_path, [0.0, 0.01, 0.02])
    succeeded("sequence", *files, "--output", tmp_path / "out")
    reports = [json.loads((tmp_path / "out" / f"frame{k:03}.json").read_text()) for k in range(3)]
    assert [report["flipped"] for report in reports] == [0, 0, 0]
    assert all(report["options"]["method"] == "gk" for report in reports)
    uvs = [
        np.array([line.split()[1:3] for line in (tmp_path / "out" / f"frame{k:03}.obj").read_text().splitlines()
                  if line.startswith("vt ")], dtype=float)
        for k in range(3)
    ]  # fmt: skip
    assert len(uvs[0]) == len(VERTICES)
    assert np.abs(uvs[2] - uvs[0]).max() < 0.05


def test_a_file_of_another_surface_is_named_and_the_others_are_mapped(tmp_path):
    files = write_frames(tmp_path, [0.0, 0.01])
    other = tmp_path / "other.obj"
    other.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    made = command("sequence", files[0], other, files[1], "--output", tmp_path / "out")
    assert made.returncode == CANNOT_BE_MAPPED
    assert "other.obj" in made.stderr and "other faces" in made.stderr
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == [
        "frame000.json", "frame000.obj", "frame001.json", "frame001.obj"]  # fmt: skip


def test_names_that_meet_and_inputs_that_would_be_replaced_are_wrong_usage(tmp_path):
    files = write_frames(tmp_path, [0.0, 0.01])
    made = command("sequence", *files, "--output", tmp_path)
    assert made.returncode == USAGE
    (tmp_path / "b").mkdir()
    twin = tmp_path / "b" / "frame000.obj"
    twin.write_text(files[0].read_text())
    made = command("sequence", files[0], twin, "--output", tmp_path / "out")
    assert made.returncode == USAGE and "frame000.obj" in made.stderr
    assert not (tmp_path / "out").exists()
