"""Islands that follow a change from where they lie: to the map at E, or not at all if they cannot."""

import dataclasses

import koebe
import numpy as np
import pytest
from addon_support import named_module

live, surfaces, outcomes = (named_module(name) for name in ("live", "surface", "outcomes"))


def strip(turn=0.0, across=4, along=40, width=0.8):
    """A strip of quadrilaterals round an axis, turned by so many radians along it and rising, as a `Task`; its UVs are
    those of the strip laid round a point, true to size."""
    angle, radius = np.meshgrid(np.linspace(0, turn, along + 1), np.linspace(1, 1 + width, across + 1), indexing="ij")
    flat = np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=-1).reshape(-1, 2)
    positions = np.concatenate([flat, 0.01 * angle.reshape(-1, 1)], axis=1)
    at = np.arange(len(flat)).reshape(along + 1, across + 1)
    faces = np.stack([at[:-1, :-1], at[:-1, 1:], at[1:, 1:], at[1:, :-1]], axis=-1).reshape(-1, 4)[:, ::-1].copy()
    corner = faces.ravel()
    pairs = np.sort(np.stack([corner, np.roll(faces, -1, axis=1).ravel()], axis=1), axis=1)
    edges, corner_edge = np.unique(pairs, axis=0, return_inverse=True)
    start = 4 * np.arange(len(faces), dtype=np.int32)
    triangles = (start[:, None] + [[0, 1, 2, 0, 2, 3]]).reshape(-1, 3).astype(np.int32)
    surface = surfaces.Surface(
        positions, corner.astype(np.int32), corner_edge.ravel().astype(np.int32), start,
        np.full(len(faces), 4, np.int32), np.zeros(len(edges), bool), np.ones(len(faces), bool), triangles,
        np.repeat(np.arange(len(faces)), 2),
    )  # fmt: skip
    uv = flat[corner]
    if np.cross(uv[1] - uv[0], uv[2] - uv[0]) < 0:
        uv = uv * [1, -1]
    return outcomes.Task("Strip", surface, old_uv=uv.astype(np.float32)), edges


def test_a_strip_follows_to_the_map_true_to_size():
    task, _ = strip(turn=3.0)
    bent = task.old_uv * np.array([1.15, 1.0], np.float32)
    corners, uv = live.follow(koebe, task, bent, 1.0)
    assert np.array_equal(corners, np.arange(len(bent))) and uv.dtype == np.float32
    lengths = [np.linalg.norm(points[1::4] - points[::4], axis=1) for points in (uv, task.old_uv)]
    ratio = lengths[0] / lengths[1]
    assert np.ptp(ratio) / ratio.mean() < 0.01 < np.ptp(np.linalg.norm(bent[1::4] - bent[::4], axis=1) / lengths[1])
    assert np.allclose(uv.mean(axis=0), bent.mean(axis=0), atol=0.02)


def test_islands_that_grow_together_follow_from_where_the_larger_lay():
    task, edges = strip(turn=2.0)
    surface, vertex = task.surface, task.surface.corner_vertex
    cut = (edges // 5 == 25).all(axis=1)  # across, nearer to one end
    beyond = np.repeat(np.arange(160), 4) >= 100
    apart = task.old_uv.copy()
    apart[beyond] = 0.5 * apart[beyond] @ np.array([[0.6, 0.8], [-0.8, 0.6]], np.float32) + np.float32(7)
    start = live.joined(surface, cut, apart)
    assert np.abs(start - task.old_uv).max() < 1e-5  # by a similarity, as they were
    corners, uv = live.follow(koebe, task, start, 1.0)
    assert len(corners) == len(vertex) and np.abs(uv - task.old_uv).max() < 0.01
    apart[beyond] += np.float32(0.02) * np.sin(vertex[beyond, None].astype(np.float32))  # they do not fit any more
    rough = live.joined(surface, cut, apart)
    for one in np.unique(vertex[beyond]):
        assert np.ptp(rough[vertex == one], axis=0).max() < 1e-5  # and meet nevertheless
    apart[beyond] = 7.0
    assert live.joined(surface, cut, apart) is None


def test_the_islands_are_as_even_as_asked():
    task, _ = strip(turn=3.0)
    positions = task.surface.positions.copy()
    positions[:, 2] += (positions[:, :2] ** 2).sum(axis=1)  # a bowl, which no map lays flat true to size
    task = dataclasses.replace(task, surface=dataclasses.replace(task.surface, positions=positions))
    spread = []
    for even in (0.0, 1.0):
        _, uv = live.follow(koebe, task, task.old_uv, even)
        report = koebe.distortion(positions, task.surface.corner_vertex[task.surface.triangle_corners], uv=uv[
            np.array([np.flatnonzero(task.surface.corner_vertex == k)[0] for k in range(len(positions))])])
        spread.append(report["area_distortion"]["log_sd"])
    assert spread[1] < 0.7 * spread[0]


@pytest.mark.parametrize("spoil", [
    lambda uv: uv * np.array([-1, 1], np.float32),  # turned over
    lambda uv: np.full_like(uv, np.nan), lambda uv: np.zeros_like(uv),
])  # fmt: skip
def test_islands_that_have_no_map_do_not_follow(spoil):
    task, _ = strip(turn=3.0)
    assert live.follow(koebe, task, spoil(task.old_uv), 0.5) is None


@pytest.mark.parametrize("turn, follows", [(6.0, True), (7.0, False)])
def test_a_strip_that_would_lie_over_itself_does_not_follow(turn, follows):
    task, _ = strip(turn)
    assert (live.follow(koebe, task, task.old_uv, 1.0) is not None) == follows


def test_a_new_seam_cuts_and_pins_stay_in_their_places():
    task, edges = strip(turn=2.0)
    surface = task.surface
    cut = (edges // 5 == 20).all(axis=1)  # across the middle
    pins = np.full_like(task.old_uv, np.nan)
    vertex = surface.corner_vertex
    for number, way in ((0, 0.0), (4, 0.05), (57, 0.0)):
        pins[vertex == number] = task.old_uv[vertex == number][0] + np.float32(way)
    task = dataclasses.replace(task, surface=dataclasses.replace(surface, seam=cut), pins=pins)
    corners, uv = live.follow(koebe, task, task.old_uv, 0.5)
    pinned = np.isfinite(pins).all(axis=1)
    assert np.array_equal(uv[pinned], pins[pinned])
    whole = np.zeros_like(task.old_uv)
    whole[corners] = uv
    sides = [whole[(vertex == 102) & (np.repeat(np.arange(160), 4) // 80 == side)] for side in (0, 1)]
    assert np.abs(sides[0][0] - sides[1][0]).max() > 1e-3  # the island with the pins has moved away
    pins[vertex == 4] = pins[vertex == 0][0]
    with pytest.raises(Exception, match="two pins are at one place"):
        live.follow(koebe, dataclasses.replace(task, pins=pins), task.old_uv, 0.5)
