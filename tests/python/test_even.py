"""The dial from conformal to true to size: laws of every map that has it, on surfaces seen and unseen."""

import contextlib
import json
from itertools import pairwise

import koebe
import numpy as np
import promises
import pytest
import random_surfaces
from cli_support import USAGE, obj_text
from cli_support import koebe as command
from domain_surfaces import holed_ring, holed_torus
from test_domains import HOLES, assert_tile
from test_parts import TRIANGLES, VERTICES
from uv_measures import signed_areas

DIAL = (0.0, 0.1, 0.5, 1.0)


def bump(steps=24, hole=0.25):
    """A hill with a round hole in its side."""
    x, y = np.meshgrid(*[np.linspace(-1, 1, steps + 1)] * 2, indexing="ij")
    points = np.column_stack([x.ravel(), y.ravel(), 1.5 * np.exp(-3 * (x**2 + y**2)).ravel()])
    at = np.arange((steps + 1) ** 2).reshape(steps + 1, -1)
    a, b, c, d = at[:-1, :-1].ravel(), at[1:, :-1].ravel(), at[1:, 1:].ravel(), at[:-1, 1:].ravel()
    faces = np.concatenate([np.column_stack([a, b, c]), np.column_stack([a, c, d])])
    middle = points[faces].mean(axis=1)
    return points, faces[np.hypot(middle[:, 0] - 0.4, middle[:, 1]) > hole]


def log_density(uv, vertices, faces):
    """(F,) 1/2 log of UV area over area, of corners (F, 3, 2), and the areas."""
    a, b = vertices[faces[:, 1]] - vertices[faces[:, 0]], vertices[faces[:, 2]] - vertices[faces[:, 0]]
    area = 0.5 * np.linalg.norm(np.cross(a, b), axis=1)
    return 0.5 * np.log(signed_areas(uv) / area), area


def spread(uv, vertices, faces):
    u, area = log_density(uv, vertices, faces)
    mean = np.average(u, weights=area)
    return np.sqrt(np.average((u - mean) ** 2, weights=area))


def covered_at_most_once(corners, seed=0, count=200):
    """Points inside of faces lie in no other: a sample of them, each against all faces."""
    rng = np.random.default_rng(seed)
    face, share = rng.integers(0, len(corners), count), rng.dirichlet([1, 1, 1], count)
    for point in (corners[face] * share[:, :, None]).sum(axis=1):
        arm = corners - point
        sides = [arm[:, k, 0] * arm[:, (k + 1) % 3, 1] - arm[:, k, 1] * arm[:, (k + 1) % 3, 0] for k in range(3)]
        if (np.min(sides, axis=0) > 1e-12).sum() > 1:
            return False
    return True


@pytest.mark.parametrize("loops", ["round", "free"])
def test_the_dial_trades_angles_for_sizes(loops):
    vertices, faces = bump()
    dial = DIAL if loops == "round" else DIAL[1:]  # free loops unbend what lay on a circle: more angles than at 0
    maps = [koebe.uniformize(vertices, faces, even=even, loops=loops) for even in dial]
    spreads = [spread(one.uv[faces], vertices, faces) for one in maps]
    angles = [one.angle_error_deg["mean"] for one in maps]
    assert spreads == sorted(spreads, reverse=True) and spreads[-1] < 0.4 * spreads[0]
    assert angles == sorted(angles)
    for one, even in zip(maps, dial, strict=True):
        assert one.converged and one.even == even and one.overlaps == 0 and one.flipped == 0
        assert np.hypot(*one.uv.T).max() <= 1 + 1e-12
        assert (signed_areas(one.uv[faces].astype(np.float32).astype(float)) > 0).all()
        assert covered_at_most_once(one.uv[faces])


def test_round_loops_are_round_and_free_ones_less_bent():
    vertices, faces = bump()
    for even in DIAL[1:]:
        one = koebe.uniformize(vertices, faces, even=even)
        for loop, center, radius, said in zip(one.loops, one.centers, one.radii, one.to_dict()["loops"], strict=True):
            on_circle = np.setdiff1d(loop, said["off_circle"])  # but for the corners of faces that hang on an edge
            assert len(on_circle) >= len(loop) - 1
            assert np.abs(np.hypot(*(one.uv[on_circle] - center).T) - radius).max() < 1e-9
        assert np.allclose(one.centers[0], 0) and one.radii[0] == 1
        free = koebe.uniformize(vertices, faces, even=even, loops="free")
        assert free.angle_error_deg["mean"] < one.angle_error_deg["mean"]


def test_a_developable_surface_is_true_to_size_at_the_end():
    """A sheet rolled up: every edge has its length, up to one scale."""
    x, y = np.meshgrid(np.linspace(0, 2, 21), np.linspace(0, 1, 11), indexing="ij")
    vertices = np.column_stack([np.sin(x.ravel()), y.ravel(), np.cos(x.ravel())])
    at = np.arange(x.size).reshape(x.shape)
    a, b, c, d = at[:-1, :-1].ravel(), at[1:, :-1].ravel(), at[1:, 1:].ravel(), at[:-1, 1:].ravel()
    faces = np.concatenate([np.column_stack([a, b, c]), np.column_stack([a, c, d])])
    uv = koebe.uniformize(vertices, faces, even=1, loops="free").uv
    edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    ratio = np.linalg.norm(np.diff(uv[edges], axis=1), axis=2) / np.linalg.norm(
        np.diff(vertices[edges], axis=1), axis=2
    )
    assert ratio.max() / ratio.min() - 1 < 1e-6


def test_parts_are_more_even_at_no_cost_of_angles():
    vertices, faces = bump()
    conformal, unasked = koebe.parts(vertices, faces, even=0), koebe.parts(vertices, faces)
    assert conformal.even == 0 and unasked.even > 0
    assert unasked.angle_error_deg["mean"] <= conformal.angle_error_deg["mean"] + 1e-9
    assert spread(unasked.uv, vertices, faces) < spread(conformal.uv, vertices, faces)
    at_last = [koebe.parts(VERTICES, TRIANGLES, even=even) for even in DIAL[1:]]
    spreads = [spread(result.uv, VERTICES, TRIANGLES) for result in at_last]
    assert all(after < before for before, after in pairwise(spreads))
    assert at_last[-1].density_ratio_5_95 < 1.1


@pytest.mark.parametrize("even", DIAL[1:])
def test_tiles_still_tile(even):
    for vertices, triangles, rims in ((*holed_torus(6)[:2], 0), (*holed_ring(6, holes=HOLES)[:2], 2)):
        make = koebe.ring_map if rims else koebe.torus_map
        conformal, tile = make(vertices, triangles), make(vertices, triangles, even=even)
        assert tile.even == even and tile.converged and tile.overlaps == 0
        assert_tile(tile, triangles, rims)
        holes = [loop for loop in tile.loops if not loop["rim"]]
        assert len(holes) == len(conformal.loops) - rims > 0
        for hole in holes:
            corners = tile.uv[np.isin(triangles, hole["vertices"])] - hole["center"]  # perhaps in several copies
            assert hole["off_circle"] == [] and np.isclose(np.hypot(*corners.T), hole["radius"], atol=1e-6).any()
        before, after = (spread(one.uv, vertices, triangles) for one in (conformal, tile))
        assert after < before


@pytest.mark.parametrize("seeds", [range(10), pytest.param(range(10, 32), marks=pytest.mark.slow)])
def test_random_surfaces_are_true_to_their_report(seeds):
    kinds = sorted(random_surfaces.KINDS)
    mapped = 0
    for seed in seeds:
        made = random_surfaces.make(kinds[seed % len(kinds)], 5000 + seed)
        if made is None or len(made[1]) > 1500:
            continue
        vertices, faces = np.asarray(made[0], float), np.asarray(made[1], np.int32)
        rng = np.random.default_rng(seed)
        options = {"even": float(rng.choice(DIAL[1:])), "loops": str(rng.choice(["round", "free"]))}
        for one, corners in _both(vertices, faces, options):
            size = signed_areas(corners.astype(np.float32).astype(float))
            assert (size <= 0).sum() == one.flipped, (seed, options)
            assert one.even == options["even"] or "not_even" in {warning.kind for warning in one.warnings}
            if one.converged:
                mapped += 1
                assert one.overlaps == 0 and covered_at_most_once(corners[size > 0], seed, 60), (seed, options)
    assert mapped > 0.6 * len(seeds)


def _both(vertices, faces, options):
    """The disk and the parts, as 32-bit UVs store them; those that are not refused."""
    with contextlib.suppress(koebe.KoebeError):
        one = koebe.uniformize(vertices, faces, **options)
        yield one, 0.5 * (one.uv[faces] + 1)
    with contextlib.suppress(koebe.KoebeError):
        one = koebe.parts(vertices, faces, **options)
        yield one, one.uv[one.part >= 0]


def test_what_cannot_be_is_refused():
    vertices, faces = bump(8)
    for wrong in (-0.1, 1.1, np.nan):
        with pytest.raises(koebe.OptionError):
            koebe.uniformize(vertices, faces, even=wrong)
    with pytest.raises(TypeError):
        koebe.parts(vertices, faces, even="much")
    with pytest.raises(koebe.OptionError):
        koebe.parts(vertices, faces, loops="square")
    with pytest.raises(koebe.InputError, match="centre"):
        koebe.uniformize(vertices, faces, even=0.5, center=int(faces[40, 0]))
    ring = holed_ring(4)
    with pytest.raises(koebe.InputError, match="slits"):
        koebe.ring_map(*ring[:2], even=0.5, holes="radial")


def test_the_command_has_the_dial(tmp_path):
    vertices, faces = bump(10)
    source, target, report = tmp_path / "in.obj", tmp_path / "out.obj", tmp_path / "out.json"
    source.write_text(obj_text(vertices, faces), encoding="utf-8")
    for name in ("uniformize", "parts"):
        assert command(name, source, target, "--even", "0.4", "--loops", "free", "--json", report).returncode == 0
        said = json.loads(report.read_text(encoding="utf-8"))
        assert said["even"] == 0.4 and said["overlaps"] == 0 and said["options"]["loops"] == "free"
        assert command(name, source, target, "--even", "2").returncode == USAGE
        assert command(name, source, target, "--loops", "oval").returncode == USAGE


@pytest.mark.parametrize(("kind", "seed", "even"), [("grid", 15, 0.05), ("ragged", 164, 0.7), ("uneven", 159, 0.1)])
def test_circles_stay_apart_and_in_the_disk(kind, seed, even):
    """Coarse loops lie on short arcs: the circles could meet although the loops do not."""
    vertices, triangles = random_surfaces.make(kind, seed)[:2]
    result = koebe.uniformize(vertices, triangles, even=even)
    assert result.even == even and promises.broken(triangles, result) == []
