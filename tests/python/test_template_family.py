"""Families of surfaces with holes: corresponding points, mean shape and matrices of fields, over one template."""

import pickle
import warnings

import koebe
import numpy as np
import pytest
from cli_support import perforated, triangles_of, triangulated_plate
from domain_surfaces import renumbered
from noisy_shapes import bent

HOLES = ((0.3, 0.3, 0.17), (0.75, 0.35, 0.08), (0.4, 0.72, 0.12))  # no symmetry to mistake
VERTICES, FACES = triangulated_plate(20, HOLES)
RANDOM = np.random.default_rng(11)
POINTS = [bent(VERTICES[:, :2], RANDOM, 0.05) for _ in range(4)]
SHAPES = [koebe.uniformize(points, FACES) for points in POINTS]
FOUND = koebe.family(SHAPES, labels="abcd")
HEIGHTS = [points[:, 2] for points in POINTS]


def at_its_vertices(found, number, points):
    """The points that correspond to the reference's vertices, before they are laid over the mean."""
    one = found.correspondences[number]
    return points if one is None else one.points


def test_a_copy_in_other_triangles_has_the_same_points():
    vertices, faces, number, turn = renumbered(POINTS[0], FACES)
    found = koebe.family([SHAPES[0], koebe.uniformize(1e-5 * vertices, faces)])
    size = np.linalg.norm(np.ptp(POINTS[0], axis=0))
    assert np.abs(at_its_vertices(found, 1, None) - POINTS[0] @ turn.T).max() < 1e-4 * size
    assert found.point_distances.max() < 1e-5 * size and np.abs(found.points[1] - found.mean).max() < 1e-4 * size
    values = np.arange(len(number), dtype=float)
    carried = found.matrix([values, values[np.argsort(number)]])
    assert carried.shape == (2, len(VERTICES)) and np.abs(carried[1] - carried[0]).mean() < 0.5
    labels = (POINTS[0][:, 0] > 0.5).astype(int)
    assert (found.matrix([labels, labels[np.argsort(number)]])[1] == labels).mean() > 0.999


def test_rolled_plates_correspond_by_their_flat_places():
    """Rolling keeps all lengths, so a point of one mesh must lie where its flat place is on another one, rolled."""

    def rolled(places, radius):
        turn = places[:, 0] / radius
        return np.column_stack([radius * np.sin(turn), places[:, 1], radius * np.cos(turn)])

    meshes = [perforated(cells, HOLES) for cells in (20, 26, 32)]
    radii = (0.3, 0.5, 2.0)
    shapes = [koebe.uniformize(rolled(places, radius), triangles_of(quads).astype(np.int32))
              for (places, quads), radius in zip(meshes, radii, strict=True)]  # fmt: skip
    found, flat = koebe.family(shapes), meshes[0][0]
    for number in (1, 2):
        mine, expected = found.correspondences[number].points, rolled(flat, radii[number])
        error = np.linalg.norm(mine - expected, axis=1)
        assert found.weights @ error < 0.005 and error.max() < 0.025  # a tenth of a cell, and half a cell
        nearest = np.linalg.norm(shapes[number].vertices[None] - shapes[0].vertices[:, None], axis=2).argmin(axis=1)
        by_place = np.linalg.norm(shapes[number].vertices[nearest] - expected, axis=1)
        assert found.weights @ error < 0.1 * (found.weights @ by_place)


def test_a_family_has_what_families_of_closed_surfaces_have():
    assert FOUND.points.shape == (4, len(VERTICES), 3) and np.array_equal(FOUND.triangles, SHAPES[0].triangles)
    assert np.allclose(FOUND.mean, FOUND.points.mean(axis=0)) and FOUND.spread.shape == (len(VERTICES),)
    assert np.isclose(FOUND.weights.sum(), 1.0) and FOUND.correspondences[0] is None and len(FOUND.maps) == 4
    for row, found in zip(FOUND.points[1:], FOUND.correspondences[1:], strict=True):  # moved and turned only
        away, before = (np.linalg.norm(points - points[0], axis=1) for points in (row, found.points))
        assert np.allclose(away, before)
    distances = FOUND.point_distances
    assert np.allclose(distances, distances.T) and (distances[~np.eye(4, dtype=bool)] > 0.005).all()
    matrix = FOUND.matrix(HEIGHTS)
    assert np.array_equal(matrix[0], HEIGHTS[0]) and matrix.shape == (4, len(VERTICES))
    rows = [found.carry(heights) for found, heights in zip(FOUND.correspondences[1:], HEIGHTS[1:], strict=True)]
    assert np.array_equal(matrix[1:], rows) and np.corrcoef(matrix[1], HEIGHTS[1])[0, 1] > 0.8
    assert FOUND.matrix(POINTS).shape == (4, len(VERTICES), 3)
    again = pickle.loads(pickle.dumps(FOUND))
    assert np.array_equal(again.points, FOUND.points, equal_nan=True)


def test_images_lie_over_each_other():
    images = FOUND.images(HEIGHTS, 64)
    assert images.shape == (4, 64, 64) and np.isnan(images[:, 0, 0]).all()
    known = np.isfinite(images).all(axis=0)
    assert known.mean() > 0.5
    fit = FOUND.maps[0]
    assert all(np.allclose(one.centers, fit.centers) and np.allclose(one.radii, fit.radii) for one in FOUND.maps)
    # A pixel of an image is the field at the points that correspond.
    there = koebe.from_image(np.nan_to_num(images[2]), fit)
    inside = np.hypot(*fit.uv.T) < 0.9
    for center, radius in zip(fit.centers[1:], fit.radii[1:], strict=True):
        inside &= np.hypot(*(fit.uv - center).T) > radius + 0.1
    assert np.abs(there - FOUND.matrix(HEIGHTS)[2])[inside].mean() < 0.01


def test_the_template_is_the_users():
    centers, radii = [(-0.4, 0.2), (0.4, 0.3), (0.0, -0.5)], [0.2, 0.15, 0.1]
    told = []
    found = koebe.family(SHAPES[:2], template=(centers, radii), progress=lambda share, stage: told.append(share))
    assert np.allclose(found.maps[1].radii, [1.0, *radii]) and np.allclose(found.maps[0].centers[1:], centers)
    assert told == sorted(told) and told[-1] == 1.0
    again = koebe.family(found.maps)  # fits to one template stay as they are
    assert again.maps[1] is found.maps[1] and np.isnan(again.margins).all()
    assert np.allclose(again.points, found.points)
    same = koebe.family(SHAPES[:2], template=found.maps[0])
    assert np.allclose(same.points, found.points)
    order = [0, 2, 1, 3]
    turned = koebe.family(SHAPES[:2], order=order, template=(np.array(centers)[[1, 0, 2]], np.array(radii)[[1, 0, 2]]))
    assert np.allclose(turned.points, found.points, atol=1e-6)


def test_surfaces_are_mapped():
    found = koebe.family([(POINTS[0], FACES), SHAPES[1]])
    assert np.allclose(found.modules, FOUND.modules[:2])
    ball = koebe.fill_holes(*SHAPES[0].surface)[:2]
    assert isinstance(koebe.family([ball, ball], landmarks=[[0, 5, 9]] * 2), koebe.SphereFamily)


def test_doubtful_matches_are_told_and_landmarks_settle_them():
    """A plate of two-fold symmetry: turned by half, it fits as well."""
    vertices, quads = perforated(20, ((0.25, 0.35, 0.1), (0.75, 0.65, 0.1), (0.3, 0.7, 0.08), (0.7, 0.3, 0.08)))
    vertices[:, 2] = 0.0
    shape, faces = vertices + 0.01 * np.random.default_rng(2).normal(size=(1, 3)), triangles_of(quads).astype(np.int32)
    pair = [koebe.uniformize(shape, faces), koebe.uniformize(vertices * [1.02, 1.0, 1.0], faces)]
    found = koebe.match_loops(*pair)
    assert found.margin < 0.3 and len(found) == 3
    with pytest.warns(koebe.Warning, match="of shape 1 another match"):
        doubtful = koebe.family(pair)
    assert np.isnan(doubtful.margins[0]) and doubtful.margins[1] < 0.3
    with pytest.warns(koebe.Warning, match="matched wrongly"):
        carried = koebe.transfer(*pair)
    assert carried.alignment.margin == pytest.approx(found.margin)
    assert [one["kind"] for one in carried.warnings] == ["ambiguous_match"]
    marks = [int(np.linalg.norm(vertices[:, :2] - place, axis=1).argmin()) for place in ((0.1, 0.15), (0.5, 0.2))]
    with warnings.catch_warnings():
        warnings.simplefilter("error", koebe.Warning)
        settled = koebe.family(pair, landmarks=[marks] * 2)
        assert (koebe.family(SHAPES).margins[1:] > 0.3).all()  # plates without symmetry
    for mine, other in zip(*settled.orders, strict=True):
        assert set(pair[0].loops[mine].tolist()) == set(pair[1].loops[other].tolist())
    assert np.abs(settled.correspondences[1].points[marks] - pair[1].vertices[marks]).max() < 1e-9


def test_areas_decide_where_circles_leave_a_doubt():
    """exp(z) of the same plate has its circles, so its two ends look alike, but one end is far larger."""
    vertices, quads = perforated(20, ((0.25, 0.35, 0.1), (0.75, 0.65, 0.1), (0.3, 0.7, 0.08), (0.7, 0.3, 0.08)))
    faces, z = triangles_of(quads).astype(np.int32), np.exp(1.5 * (vertices[:, 0] + 1j * vertices[:, 1]))
    turned = z * np.exp(0.05 * np.sin(vertices[:, 1]))
    pair = [koebe.uniformize(np.column_stack([w.real, w.imag, 0 * w.real]), faces) for w in (z, turned)]
    assert koebe.match_loops(*pair).margin < 0.3
    with warnings.catch_warnings():
        warnings.simplefilter("error", koebe.Warning)
        found = koebe.family(pair)
    assert found.margins[1] > 0.3
    for mine, other in zip(*found.orders, strict=True):
        assert set(pair[0].loops[mine].tolist()) == set(pair[1].loops[other].tolist())


def test_errors_name_the_shape():
    fields = [HEIGHTS[0]] * 4
    for act, error, says in (
        (lambda: FOUND.matrix(HEIGHTS[:3]), koebe.InputError, "fields of 3 shapes, not of 4"),
        (lambda: FOUND.matrix([HEIGHTS[0][:5], *HEIGHTS[1:]]), koebe.InputError, "shape 0 has 5 values"),
        (lambda: FOUND.matrix([*fields[:3], POINTS[3]]), koebe.InputError, "columns"),
        (lambda: FOUND.images(HEIGHTS[:1]), koebe.InputError, "fields of 1"),
        (lambda: koebe.family(SHAPES, landmarks=[[0]] * 3), koebe.InputError, "landmarks of 3 shapes"),
        (lambda: koebe.family(SHAPES, landmarks=[[0]] * 3 + [[0, 1]]), koebe.InputError, "shape 3 has 2 landmarks"),
        (lambda: koebe.family(SHAPES, template=3), koebe.InputError, "pair of centers and radii"),
        (lambda: koebe.family(SHAPES, template=([[0, 0]], [0.5])), koebe.InputError, "3|three|loops|holes"),
        (lambda: koebe.family([koebe.parts(POINTS[0], FACES)]), TypeError, "PartsResult"),
        (lambda: koebe.family([SHAPES[0].conformal] * 2).points, TypeError, "shape 0 is a ConformalDomain"),
    ):
        with pytest.raises(error, match=says):
            act()
    ring = koebe.uniformize(*(lambda v, q: (v, triangles_of(q).astype(np.int32)))(*perforated(12, HOLES[:1])))
    with pytest.raises(koebe.InputError, match="fewer than two holes"):
        _ = koebe.family([ring, ring]).points
