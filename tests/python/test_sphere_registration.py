"""Spheres bent over each other: known deformations are found, landmarks meet, and no face turns over."""

import pickle

import koebe
import numpy as np
import pytest
from koebe.labs import sphere_alignment as alignment
from koebe.labs import sphere_transfer as inner
from test_sphere_transfer import FACES, POINTS, ROUND, SPHERE, TURN, depth, moved, potato


def rich(directions):
    """(n, 2) two fields with many hills: they say which points correspond."""
    waves = np.random.default_rng(11).normal(size=(2, 6, 3)) * 5.0
    return np.stack([np.cos(directions @ each.T + np.arange(6)).sum(axis=1) for each in waves], axis=1)


def flowed(points, size):
    """A diffeomorphism of the sphere: the flow of a smooth vector field."""
    for _ in range(20):
        x, y, z = points.T
        along = np.stack([np.sin(2 * y + 1), np.cos(1.5 * z), np.sin(2 * x - z)], axis=1) * size / 20
        points = points + along - (along * points).sum(axis=1)[:, None] * points
        points = points / np.linalg.norm(points, axis=1)[:, None]
    return points


def degrees(one, other):
    return np.degrees(2 * np.arcsin(np.linalg.norm(one - other, axis=1) / 2))


def assert_one_to_one(places, triangles=FACES):
    a, b, c = places.sphere[triangles].transpose(1, 0, 2)
    volume = np.einsum("fk,fk->f", a, np.cross(b, c))
    assert volume.min() > 0.0 and places.bending["flipped"] == 0
    around = 1 + (a * b + b * c + c * a).sum(axis=1)
    assert np.isclose(2 * np.arctan2(volume, around).sum(), 4 * np.pi)


def without_search(sphere, **options):
    """transfer without the search for the best rotation, which takes most of the time."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(inner, "by_fields", lambda *_: np.eye(4))
        return koebe.transfer(sphere, sphere, **options)


@pytest.mark.parametrize("size, near", [(0.25, 1.5), (0.45, 4.5)])
def test_a_known_deformation_is_found_again(size, near):
    there = flowed(SPHERE.points, size)
    places = without_search(SPHERE, fields=(rich(SPHERE.points), rich(there)), bend=True, stiffness=0.03)
    before = degrees(koebe.transfer(SPHERE, SPHERE).sphere, there)
    away = degrees(places.sphere, there)
    assert before.mean() > 12 and away.mean() < near and np.percentile(away, 90) < 2 * near
    assert places.similarity > 0.95 > 0.7 > places.bending["similarity_before"]
    assert places.bending["settled"] and places.bending["beltrami"]["max"] < 0.8 and not places.warnings
    assert_one_to_one(places)


def test_without_a_difference_nothing_is_bent():
    places = koebe.transfer(SPHERE, SPHERE, fields=(depth(ROUND), depth(ROUND)), bend=True)
    assert places.bending["beltrami"]["max"] < 0.02 and places.similarity > 0.9999
    assert degrees(places.sphere, SPHERE.points).max() < 0.5


def test_a_turn_is_found_and_not_bent():
    other = moved(SPHERE, alignment._turned(TURN))
    places = koebe.transfer(SPHERE, other, fields=(depth(ROUND), depth(ROUND)), bend=True)
    assert degrees(places.sphere, SPHERE.points).max() < 1.0 and places.bending["beltrami"]["max"] < 0.03


def test_landmarks_meet_exactly():
    pairs = [(3, 50), (90, 100), (200, 210), (400, 420), (222, tuple(POINTS[230]))]
    rigid = koebe.transfer(SPHERE, SPHERE, landmarks=pairs)
    places = koebe.transfer(SPHERE, SPHERE, landmarks=pairs, bend=True)
    assert rigid.misses_deg.max() > 5 and places.misses_deg.max() < 1e-6
    assert np.allclose(places.points[[50, 100, 210, 420, 230]], POINTS[[3, 90, 200, 400, 222]], atol=1e-9)
    assert "bent by" in repr(places) and places.similarity is None
    assert_one_to_one(places)


def test_landmarks_and_fields_together():
    there = flowed(SPHERE.points, 0.25)
    held = [3, 90, 200, 400]
    nearest = [int(((SPHERE.points - there[k]) ** 2).sum(axis=1).argmin()) for k in held]
    fields = depth(SPHERE.points), depth(there)
    places = koebe.transfer(SPHERE, SPHERE, landmarks=list(zip(nearest, held)), fields=fields, bend=True)
    assert places.misses_deg.max() < 1e-6 and places.similarity > max(0.99, places.bending["similarity_before"])
    assert_one_to_one(places)


@pytest.mark.slow
def test_no_face_turns_over_in_200_random_pairs():
    points, faces, _ = potato(2)
    sphere, random, refused = koebe.sphere_map(points, faces), np.random.default_rng(7), 0
    for number in range(200):
        count = int(random.integers(0, 5))
        pairs = list(zip(*(random.choice(len(points), (2, count)).tolist() if count else ([], []))))
        waves = random.normal(size=(2, 4, 3)) * 3
        fields = tuple(np.cos(sphere.points @ each.T).sum(axis=1) for each in waves)
        which = {"landmarks": pairs} if number % 2 and count else {"fields": fields}
        try:
            places = without_search(sphere, bend=True, stiffness=10.0 ** random.uniform(-3, 0), **which)
        except (koebe.SolverError, koebe.InputError) as error:
            assert error.of == "landmarks" and error.elements
            refused += 1
            continue
        assert_one_to_one(places, faces)
        assert places.misses_deg.max(initial=0.0) < 1e-6
    assert refused < 20


def test_even_spheres_correspond():
    points, faces, _ = potato(3)
    sphere = koebe.sphere_map(points, faces, even=0.5)
    places = koebe.transfer(SPHERE, sphere, landmarks=[(k, k) for k in (3, 90, 200, 400)], bend=True)
    assert places.misses_deg.max() < 1e-6


def test_values_may_be_unknown():
    there = flowed(SPHERE.points, 0.25)
    on_a, on_b = rich(SPHERE.points), rich(there)
    on_a[SPHERE.points[:, 2] > 0.8] = np.nan
    on_b[there[:, 2] > 0.8] = np.nan
    places = without_search(SPHERE, fields=(on_a, on_b), bend=True, stiffness=0.03)
    away = degrees(places.sphere, there)
    assert away[there[:, 2] < 0.7].mean() < 2.0
    assert_one_to_one(places)


def test_it_is_saved_pickled_and_called(tmp_path):
    places = koebe.transfer(SPHERE, SPHERE, landmarks=[(3, 30), (90, 100), (200, 210)], bend=True)
    assert np.allclose(places(SPHERE.points), places.sphere, atol=1e-9)
    assert type(koebe.transfer(SPHERE, SPHERE, fields=(depth(ROUND),) * 2, bend=True).similarity) is float
    places.save(tmp_path / "laid.npz")
    for again in (koebe.load(tmp_path / "laid.npz"), pickle.loads(pickle.dumps(places))):
        assert type(again) is koebe.SphereCorrespondence and repr(again) == repr(places)
        assert again.bending == places.bending and again.count == places.count
        assert np.array_equal(again.carry(POINTS[:, 0]), places.carry(POINTS[:, 0]))


def test_turned_faces_and_vertices_without_a_face_do_not_disturb():
    faces = FACES.copy()
    faces[:40] = faces[:40, [0, 2, 1]]
    sphere = koebe.sphere_map(np.concatenate([POINTS, [[9.0, 9.0, 9.0]]]), faces)
    values = np.append(depth(ROUND), np.nan)
    places = koebe.transfer(sphere, SPHERE, values, fields=(values, depth(ROUND)), bend=True)
    assert np.allclose(places, depth(ROUND), atol=0.1)
    back = koebe.transfer(SPHERE, sphere, fields=(depth(ROUND), values), bend=True)
    assert back.faces[-1] == -1 and np.isnan(back.points[-1]).all()
    assert np.linalg.norm(back.points[:-1] - POINTS, axis=1).max() < 0.05


def test_what_cannot_be_bent_is_told_so():
    ones, values = np.full(len(POINTS), 0.1), depth(ROUND)
    for options, says in (
        ({"bend": True}, "needs fields"),
        ({"bend": True, "landmarks": [(0, 5), (5, 5)]}, "landmarks 0 and 1 share"),
        ({"bend": True, "landmarks": [(7, 5), (7, 9)]}, "landmarks 0 and 1 share"),
        ({"bend": True, "fields": (values, ones)}, "field of b is the same everywhere"),
        ({"bend": True, "fields": (np.stack([values] * 2, axis=1), values)}, "columns"),
        ({"bend": True, "fields": (values, values), "stiffness": 0.0}, "stiffness"),
        ({"bend": True, "fields": (values, values), "stiffness": np.nan}, "stiffness"),
    ):
        with pytest.raises(koebe.InputError, match=says):
            koebe.transfer(SPHERE, SPHERE, **options)
    near = SPHERE.triangles[0]
    with pytest.raises(koebe.SolverError, match="block each other") as caught:  # a triangle turned over
        koebe.transfer(SPHERE, SPHERE, landmarks=list(zip(near, near[[1, 0, 2]])), bend=True)
    assert caught.value.of == "landmarks" and caught.value.elements
    with pytest.raises(koebe.InputError, match="bend are for two results of sphere_map"):
        face = koebe.uniformize("blend_samples/face.obj")
        koebe.transfer(face, face, bend=True)
