"""A mask leaves out faces: what is left is mapped as if it were a mesh of its own, under the input's numbers."""

import koebe
import numpy as np
import pytest

VERTICES, TRIANGLES = (lambda r: r.surface)(koebe.uniformize("blend_samples/face.obj"))
# A hole inside, away from eyes and mouth: all vertices near one of them.
MASK = np.linalg.norm(VERTICES - VERTICES[946], axis=1) < 0.08 * np.ptp(VERTICES, axis=0).max()
LEFT = ~MASK[TRIANGLES].any(axis=1)
USED = np.unique(TRIANGLES[LEFT])
ALONE = VERTICES[USED], np.searchsorted(USED, TRIANGLES[LEFT])


def test_the_mask_is_a_hole():
    assert 3 <= MASK.sum() < 200
    loops = koebe.boundary_loops((VERTICES, TRIANGLES), mask=MASK)
    assert [loop.tolist() for loop in loops] == [USED[loop].tolist() for loop in koebe.boundary_loops(ALONE)]
    assert len(loops) == 5
    again = koebe.boundary_loops(TRIANGLES, mask=MASK)
    assert [loop.tolist() for loop in loops] == [loop.tolist() for loop in again]


@pytest.mark.parametrize(
    "options", [{}, {"even": 0.5, "loops": "free"}, {"engine": "mesh", "max_sweeps": 2}, {"balance": "area"}]
)
def test_a_masked_surface_has_the_map_of_what_is_left(options):
    result, alone = koebe.uniformize(VERTICES, TRIANGLES, mask=MASK, **options), koebe.uniformize(*ALONE, **options)
    assert result.uv.shape == (len(VERTICES), 2) and np.array_equal(result.uv[USED], alone.uv)
    outside = np.setdiff1d(np.arange(len(VERTICES)), USED)
    assert len(outside) and np.isnan(result.uv[outside]).all() and np.isnan(result.log_scale[outside]).all()
    assert [loop.tolist() for loop in result.loops] == [USED[loop].tolist() for loop in alone.loops]
    assert np.array_equal(result.source_face, np.flatnonzero(LEFT))
    assert np.array_equal(result.surface[1], TRIANGLES[LEFT]) and np.array_equal(result.surface[0], VERTICES)
    assert np.array_equal(result.face_angle_error_deg, alone.face_angle_error_deg)


def test_all_maps_and_functions_take_a_mask():
    whole = VERTICES, TRIANGLES
    for function in (koebe.parts, koebe.ring_map, koebe.sphere_map, koebe.flatten):
        result, alone = function(*whole, mask=MASK), function(*ALONE)
        assert np.array_equal(result.uv, alone.uv) and np.array_equal(result.source_face, np.flatnonzero(LEFT))
    sphere = koebe.sphere_map(*whole, mask=MASK)
    assert np.array_equal(np.isfinite(sphere.points[:, 0]), np.isin(np.arange(len(VERTICES)), USED))
    cut = koebe.uniformize(*whole, mask=MASK, cut=True)
    assert np.array_equal(cut.uv, koebe.uniformize(*ALONE, cut=True).uv)
    filled, faces, label = koebe.fill_holes(*whole, mask=MASK, loops=[1, 2, 3, 4])
    assert (label == -1).sum() == LEFT.sum() and len(koebe.boundary_loops(faces)) == 1
    kept = np.zeros(len(filled), bool)
    kept[np.setdiff1d(np.arange(len(VERTICES)), USED)] = True
    disk = koebe.disk_map(filled, faces, mask=kept)
    assert np.array_equal(np.isnan(disk[:, 0]), kept)
    first = koebe.uniformize(*whole, mask=MASK)
    rims = np.concatenate(first.loops)
    flat = koebe.harmonic_map(*whole, fixed=rims, values=first.uv[rims], mask=MASK)
    assert np.allclose(flat[USED], first.uv[USED], atol=0.1) and np.isnan(flat[MASK]).all()
    assert koebe.distortion(*whole, uv=first.uv, mask=MASK)["flipped"] == first.flipped
    assert koebe.distortion(*first.surface, uv=first.uv)["angle_error_deg"] == pytest.approx(first.angle_error_deg)
    dial = koebe.EvenDial(*whole, uv=first.uv, mask=MASK)
    moved, other = dial.move(0.4), koebe.EvenDial(*ALONE, uv=first.uv[USED]).move(0.4)
    assert np.array_equal(moved[USED], other) and np.isnan(moved[MASK]).all()
    fitted = koebe.fit_circles(whole, first.centers, first.radii, mask=MASK)
    assert np.allclose(fitted.uv[USED], koebe.fit_circles(ALONE, first.centers, first.radii).uv)
    surface = koebe.Surface(*whole, mask=MASK)
    assert np.array_equal(surface.uniformize(VERTICES).uv[USED], koebe.Surface(*ALONE).uniformize(ALONE[0]).uv)
    pieces = koebe.open_surface(*whole, mask=MASK).pieces
    assert np.array_equal(np.sort(pieces[0].source_face), np.flatnonzero(LEFT))
    sheet = koebe.lift(*whole, perforate=True, mask=MASK)
    assert sheet.outlines == koebe.lift(*ALONE, perforate=True).outlines
    ring = koebe.fill_holes(*ALONE, loops=[2, 3, 4])
    assert koebe.certified_moduli(*ring[:2], mask=np.zeros(len(ring[0]), bool)).modulus


def test_numbers_of_faces_in_errors_are_the_inputs():
    far = VERTICES.copy()
    doubled = np.concatenate([TRIANGLES, TRIANGLES[-1:, [0, 2, 1]] + [0, 0, 0]])  # the last face has a twin
    masked = np.zeros(len(VERTICES), bool)
    masked[TRIANGLES[0, 0]] = True
    with pytest.raises(koebe.TopologyError) as without:
        koebe.uniformize(far, doubled)
    with pytest.raises(koebe.TopologyError) as with_mask:
        koebe.uniformize(far, doubled, mask=masked)
    assert sorted(without.value.elements) == sorted(with_mask.value.elements)
    island = np.concatenate([TRIANGLES, [[len(VERTICES) + k for k in range(3)]]])
    points = np.concatenate([VERTICES, 9.0 + np.eye(3)])
    out = np.concatenate([masked, [False] * 3])
    with pytest.raises(koebe.TopologyError) as error:
        koebe.uniformize(points, island, mask=out)
    assert error.value.kind == "disconnected" and error.value.of == "faces"
    assert list(error.value.elements) == [len(TRIANGLES)]


def test_a_masked_result_is_saved_carried_and_made_again(tmp_path):
    result = koebe.uniformize(VERTICES, TRIANGLES, mask=MASK)
    result.save(tmp_path / "masked.npz")
    again = koebe.load(tmp_path / "masked.npz")
    assert np.array_equal(again.uv, result.uv, equal_nan=True) and np.array_equal(again.source_face, result.source_face)
    repeated = koebe.uniformize(*result.surface, **result.options)
    assert np.array_equal(repeated.uv[USED], result.uv[USED])
    places = koebe.transfer(result, result)
    inside = np.isin(np.arange(len(VERTICES)), USED)
    assert np.allclose(places.points[inside], VERTICES[inside], atol=1e-6)
    assert np.isnan(places.points[~inside]).all() and (places.faces[~inside] == -1).all()
    assert np.isnan(places.carry(VERTICES[:, 0])[~inside]).all()


@pytest.mark.parametrize(
    "mask",
    [2 * MASK, np.flatnonzero(MASK), MASK[1:], np.ones(len(VERTICES), bool), "lh.cortex.label", MASK[:, None]],
)
def test_another_mask_is_an_error(mask):
    with pytest.raises(koebe.InputError, match="mask"):
        koebe.uniformize(VERTICES, TRIANGLES, mask=mask)


def test_a_mask_of_nothing_changes_nothing():
    none = np.zeros(len(VERTICES), bool)
    assert np.array_equal(koebe.uniformize(VERTICES, TRIANGLES, mask=none).uv, koebe.uniformize(VERTICES, TRIANGLES).uv)
