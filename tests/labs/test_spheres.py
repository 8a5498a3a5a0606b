"""Spherical harmonics of closed surfaces, and registered spheres in FreeSurfer's files."""

import koebe
import nibabel
import numpy as np
import pytest
from nibabel import freesurfer
from nilearn.datasets import fetch_surf_fsaverage

FILES = fetch_surf_fsaverage("fsaverage5")


def arrays(name, side):
    return [array.data for array in nibabel.load(FILES[f"{name}_{side}"]).darrays]


@pytest.fixture(scope="module")
def hemispheres():
    """White surfaces of both sides, the right one mirrored, and their sulcal depth."""
    left, right = (arrays("white", side) for side in ("left", "right"))
    right = [right[0] * [-1, 1, 1], right[1][:, [0, 2, 1]]]
    return [koebe.sphere_map(*one) for one in (left, right)], [arrays("sulc", side)[0] for side in ("left", "right")]


@pytest.fixture(scope="module")
def bent(hemispheres):
    spheres, depths = hemispheres
    return koebe.transfer(*spheres, fields=tuple(depths), bend=True)


def test_an_ellipsoid_has_degree_1_alone(hemispheres):
    places = hemispheres[0][0].points
    ball = koebe.sphere_map(places * [1.0, 1.0, 1.0], hemispheres[0][0].triangles)
    series = koebe.spharm(ball, 6)
    power = series.power
    assert series.rms < 1e-3 and power[1] == pytest.approx(1.0, rel=1e-3) and power[2:].max() < 1e-5
    assert series.coefficients.shape == (3, 2, 7, 7)
    assert np.allclose(series.points(), ball.vertices, atol=5e-3)


def test_a_series_comes_nearer_with_its_degree_and_does_not_know_turns(hemispheres):
    sphere = hemispheres[0][0]
    series = [koebe.spharm(sphere, degree) for degree in (2, 5, 10, 20)]
    assert all(b.rms < 0.85 * a.rms for a, b in zip(series, series[1:], strict=False))
    turn = np.linalg.qr(np.random.default_rng(1).normal(size=(3, 3)))[0]
    turn *= np.linalg.det(turn)
    moved = koebe.spharm(koebe.sphere_map(sphere.vertices @ turn + 50.0, sphere.triangles), 10)
    assert np.allclose(moved.power[1:], series[2].power[1:], rtol=1e-3)
    at = series[2].points(directions=[[0, 0, 2.0], [np.nan, 0, 0]])
    assert np.isfinite(at[0]).all() and np.isnan(at[1]).all()
    assert np.allclose(series[2].points(5)[7], koebe.spharm(sphere, 5).points()[7], atol=5.0)
    even = koebe.sphere_map(sphere.vertices, sphere.triangles, even=1)
    assert koebe.spharm(even, 20).rms < 0.8 * series[3].rms  # fine parts lie close together on the conformal sphere
    away = np.linalg.norm(series[3].points() - sphere.vertices, axis=1)
    assert np.sqrt((away**2).mean()) < 2 * series[3].rms


def test_what_has_no_series_is_refused(hemispheres):
    with pytest.raises(koebe.InputError, match="holes"):
        koebe.spharm(koebe.sphere_map(koebe.example("face")))
    with pytest.raises(koebe.InputError, match="degree 60 needs"):
        koebe.spharm(hemispheres[0][0], 60)
    with pytest.raises(TypeError, match="sphere_map"):
        koebe.spharm(koebe.uniformize(koebe.example("face")))


def test_a_registered_sphere_is_read_by_freesurfer(bent, tmp_path):
    theirs = arrays("sphere", "left")[0]
    for name, sphere in (("lh.sphere.reg", theirs), ("lh.own.reg", None), ("right.surf.gii", theirs)):
        bent.export(tmp_path / name, sphere=sphere)
        if name.endswith("gii"):
            points, faces = (array.data for array in nibabel.load(tmp_path / name).darrays)
        else:
            points, faces = freesurfer.read_geometry(str(tmp_path / name))
        assert np.array_equal(faces, bent.own_triangles)
        assert np.allclose(np.linalg.norm(points, axis=1), 100.0, atol=1e-3)
        wanted = bent.sphere if sphere is None else bent.carry(theirs)
        wanted = wanted / np.linalg.norm(wanted, axis=1, keepdims=True)
        assert np.allclose(points / 100.0, wanted, atol=1e-5)
    # FreeSurfer's own sphere of the right side, mirrored, lies nearly so, up to a turn of its axes.
    mirrored = arrays("sphere", "right")[0] * [-1, 1, 1] / 100.0
    u, _, v = np.linalg.svd(mirrored.T @ (points / 100.0))
    angle = np.degrees(np.arccos(np.clip((mirrored @ u @ v * points / 100.0).sum(axis=1), -1, 1)))
    assert np.median(angle) < 6.0


def test_spheres_that_no_file_can_hold_are_refused(bent, tmp_path):
    for name in ("a.obj", "lh.flat.patch.3d", "a.shape.gii"):
        with pytest.raises(koebe.InputError, match="sphere is written as"):
            bent.export(tmp_path / name)
    for sphere in (np.zeros((3, 3)), arrays("white", "left")[0] + 400.0, np.full((10242, 3), np.nan)):
        with pytest.raises(koebe.InputError):
            bent.export(tmp_path / "lh.sphere.reg", sphere=sphere)
    assert not list(tmp_path.iterdir())
    with pytest.warns(koebe.Warning, match="turned over") as told:
        bent.export(tmp_path / "lh.sphere.reg", sphere=arrays("sphere", "left")[0] * [-1, 1, 1])
    assert told[0].message.kind == "flipped" and len(told[0].message.elements) == 20480
