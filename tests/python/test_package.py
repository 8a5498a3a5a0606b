"""The Python package: arrays in any legal form, typed errors, progress, cancel and the report."""


import koebe
import numpy as np
import pytest


def ring(sectors=48, rings=12, inner=0.4, bend=0.5):
    """A round annulus bent into space by z + bend z^2 / 4 (conformal), two loops."""
    angle = 2 * np.pi * np.arange(sectors) / sectors
    radius = np.linspace(inner, 1.0, rings)
    z = (radius[:, None] * np.exp(1j * angle)[None, :]).ravel()
    w = z + bend * z * z / 4
    vertices = np.column_stack([w.real, w.imag, np.zeros(len(w))])
    faces = []
    for i in range(rings - 1):
        for j in range(sectors):
            a, b = i * sectors + j, i * sectors + (j + 1) % sectors
            faces += [[a, a + sectors, b], [b, a + sectors, b + sectors]]
    return vertices, np.array(faces, dtype=np.int32)


VERTICES, FACES = ring()


def test_a_bent_round_annulus_gets_its_radius_back():
    result = koebe.uniformize(VERTICES, FACES)
    assert result.converged and result.flipped == 0
    assert result.radii[1] == pytest.approx(0.4, abs=0.01)
    assert np.abs(result.centers).max() < 1e-12
    for loop, center, radius in zip(result.loops, result.centers, result.radii, strict=True):
        assert np.allclose(np.linalg.norm(result.uv[loop] - center, axis=1), radius, atol=1e-12)
    points, radius = koebe.annulus_map(VERTICES, FACES)
    assert radius == pytest.approx(result.radii[1], abs=5e-3)
    assert np.allclose(np.linalg.norm(points[result.loops[0]], axis=1), 1.0)


def test_the_annulus_by_its_flat_cylinder_is_that_by_a_harmonic_function():
    points, radius = koebe.annulus_map(VERTICES, FACES)
    flowed, flowed_radius = koebe.annulus_map(VERTICES, FACES, backend="yamabe")
    assert flowed_radius == pytest.approx(radius, rel=0.01) and flowed_radius != radius
    z, w = (p @ [1, 1j] for p in (points, flowed))
    turn = np.vdot(w, z)
    assert np.abs(z - turn / abs(turn) * w).max() < 0.01
    with pytest.raises(ValueError, match="backend must be one of harmonic, yamabe"):
        koebe.annulus_map(VERTICES, FACES, backend="ricci")


def test_every_legal_array_gives_the_same_result_and_is_left_alone():
    expected = koebe.uniformize(VERTICES, FACES).uv
    fortran = np.asfortranarray(VERTICES)
    frozen = VERTICES.copy()
    frozen.flags.writeable = False
    for vertices in (fortran, frozen, VERTICES.astype(np.float32)):
        for faces in (FACES, FACES.astype(np.int64), np.asfortranarray(FACES)):
            before = vertices.copy(), faces.copy()
            uv = koebe.uniformize(vertices, faces).uv
            assert uv.dtype == np.float64 and uv.shape == (len(VERTICES), 2)
            assert np.allclose(uv, expected, atol=1e-5 if vertices.dtype == np.float32 else 1e-12)
            assert np.array_equal(vertices, before[0]) and np.array_equal(faces, before[1])


def test_topology_errors_have_a_kind_and_elements():
    tetrahedron = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])
    with pytest.raises(koebe.TopologyError) as caught:
        koebe.uniformize(np.random.default_rng(1).random((4, 3)), tetrahedron)
    assert caught.value.kind == "closed"
    with pytest.raises(koebe.TopologyError) as caught:
        koebe.uniformize(np.random.default_rng(1).random((5, 3)), np.array([[0, 1, 2], [1, 0, 3], [0, 1, 4]]))
    assert caught.value.kind == "nonmanifold_edge"
    assert sorted(caught.value.elements) == [0, 1]


def test_polish_lowers_the_angle_error_and_leaves_the_circles():
    vertices, faces = VERTICES, FACES
    plain, polished = (koebe.uniformize(vertices, faces, polish=polish) for polish in (False, True))
    before = polished.to_dict()["angle_error_deg"]["before_polish"]
    assert before == plain.angle_error_deg["mean"] > polished.angle_error_deg["mean"]
    assert "before_polish" not in plain.to_dict()["angle_error_deg"]
    assert np.array_equal(plain.centers, polished.centers) and np.array_equal(plain.radii, polished.radii)


def test_the_report_is_the_contract():
    report = koebe.uniformize(VERTICES, FACES, engine="mesh").to_dict()
    assert set(report) >= {
        "version", "input", "vertices", "faces", "method", "engine", "outer_loop", "converged", "sweeps", "steps",
        "history", "loops", "angle_error_deg", "beltrami", "area_distortion", "conformal_energy", "flipped",
        "below_resolution", "seconds", "peak_memory_mb", "warnings",
    }
    assert report["engine"] == "mesh" and report["vertices"] == len(VERTICES)


def test_filling_both_loops_closes_the_surface():
    vertices, faces, label = koebe.fill_holes(VERTICES, FACES)
    assert len(vertices) == len(VERTICES) + 2
    assert (label == -1).sum() == len(FACES) and set(label) == {-1, 0, 1}
    with pytest.raises(koebe.TopologyError) as caught:
        koebe.uniformize(vertices, faces)
    assert caught.value.kind == "closed"


def test_faired_filling_continues_the_surface():
    squared = (VERTICES**2).sum(axis=1)
    sphere = np.column_stack([2 * VERTICES[:, :2], squared - 1]) / (1 + squared)[:, None]
    before = sphere.copy()
    inner = int(np.abs(VERTICES[koebe.boundary_loops(FACES)[0], :2]).max() > 0.7)
    vertices, faces, label = koebe.fill_holes(sphere, FACES, loops=[inner], fair=True)
    assert np.array_equal(sphere, before) and np.array_equal(vertices[: len(sphere)], sphere)
    assert np.array_equal(faces[: len(FACES)], FACES) and set(label[len(FACES) :]) == {inner}
    assert len(vertices) > len(sphere) + 20
    assert np.abs(np.linalg.norm(vertices, axis=1) - 1).max() < 0.03
    with pytest.raises(koebe.InputError):
        koebe.fill_holes(sphere, FACES, loops=[2], fair=True)


@pytest.mark.parametrize("uniform", [False, True])
def test_a_harmonic_map_of_a_plane_is_linear_only_with_its_lengths(uniform):
    rim = np.concatenate(koebe.boundary_loops(FACES))
    flat = VERTICES[:, :2] @ [[1.0, 0.3], [-0.2, 0.8]]
    points = koebe.harmonic_map(VERTICES, FACES, rim, flat[rim], uniform=uniform)
    assert np.allclose(points[rim], flat[rim])
    assert np.allclose(points, flat, atol=1e-9) != uniform
    with pytest.raises(koebe.InputError):
        koebe.harmonic_map(VERTICES, FACES, rim, flat)


def test_distortion_of_the_surface_itself_is_none():
    flat = VERTICES[:, :2] / 2
    assert koebe.distortion(VERTICES, FACES, flat)["angle_error_deg"]["max"] < 1e-6
    with pytest.raises(koebe.InputError):
        koebe.distortion(VERTICES, FACES, flat[1:])


def test_boundary_loops_and_the_disk_map():
    loops = koebe.boundary_loops(FACES)
    assert sorted(len(loop) for loop in loops) == [48, 48]
    with pytest.raises(koebe.InputError):
        koebe.disk_map(VERTICES, FACES)
    vertices, faces, _ = koebe.fill_holes(VERTICES, FACES, loops=[0])
    points = koebe.disk_map(vertices, faces)
    rim = koebe.boundary_loops(faces)[0]
    assert np.allclose(np.linalg.norm(points[rim], axis=1), 1.0)
    assert koebe.distortion(vertices, faces, points)["angle_error_deg"]["mean"] < 3


def ladder(columns, rows, holes, height):
    """Rectangles one wide and so high, each cut in two, without those in `holes`."""
    x, y = np.meshgrid(np.arange(columns + 1.0), height * np.arange(rows + 1.0), indexing="ij")
    vertices = np.column_stack([x.ravel(), y.ravel(), np.zeros(x.size)])
    faces = []
    for i in range(columns):
        for j in range(rows):
            if (i, j) not in holes:
                a, b = i * (rows + 1) + j, (i + 1) * (rows + 1) + j
                faces += [[a, b, b + 1], [a, b + 1, a + 1]]
    return vertices, np.array(faces, dtype=np.int32)


@pytest.mark.parametrize(
    "columns, rows, holes, height", [(5, 3, {(1, 1), (3, 1)}, 6.0), (3, 9, {(1, 1), (1, 3), (1, 5), (1, 7)}, 0.2)]
)
def test_circles_of_a_mesh_too_coarse_between_them_do_not_meet(columns, rows, holes, height):
    result = koebe.uniformize(*ladder(columns, rows, holes, height))
    center = result.centers @ [1.0, 1.0j]
    for i in range(1, len(center)):
        assert abs(center[i]) + result.radii[i] < 1.0
        for j in range(1, i):
            assert abs(center[i] - center[j]) > result.radii[i] + result.radii[j]
        uv = result.uv[result.loops[i]] @ [1.0, 1.0j]
        assert np.allclose(np.abs(uv - center[i]), result.radii[i], atol=1e-12)
    assert result.flipped == 0
    assert any(warning.kind == "shrunk_circles" for warning in result.warnings)
