"""Fields as images of the domain: there and back, one template for two surfaces, labels, NaN, refusals."""


import koebe
import numpy as np
import pytest
from atrium_templates import TEMPLATE, atrium

MILLIMETRES = 30.0  # radius of the atrium


def fitted(level):
    """The atrium in millimetres, mapped to the picture's template."""
    vertices, faces, rims = atrium(level)
    loops = koebe.boundary_loops(faces)
    ranks = [next(k for k, loop in enumerate(loops) if rim[0] in loop) for rim in rims[:4]]
    centers, radii = zip(*TEMPLATE.values(), strict=True)
    return koebe.fit_circles((MILLIMETRES * vertices, faces), centers, radii, ranks)


ATRIUM, COARSE = fitted(3), fitted(2)


def times(result):
    """Activation times of a wave of 1 mm/ms from a point of the wall: so an error in ms is one in mm."""
    return np.linalg.norm(result.surface[0] - MILLIMETRES * np.array([0.0, 0.9, 0.0]), axis=1)


def centers_of(pixels):
    steps = (np.arange(pixels) + 0.5) * 2 / pixels - 1
    return np.meshgrid(steps, -steps)


def inside(pixels, margin=0.0):
    x, y = centers_of(pixels)
    found = np.hypot(x, y) < 1 - margin
    for (a, b), radius in zip(ATRIUM.centers[1:], ATRIUM.radii[1:], strict=True):
        found &= np.hypot(x - a, y - b) > radius + margin
    return found


def test_activation_times_come_back():
    wanted = times(ATRIUM)
    image, error = koebe.to_image(ATRIUM, wanted, 256)
    back = koebe.from_image(image, ATRIUM)
    assert error == pytest.approx(np.abs(back - wanted).max(), abs=1e-12) and error < 1e-6
    coarse, told = koebe.to_image(ATRIUM, wanted, 64)  # several vertices in a pixel
    assert told == pytest.approx(np.abs(koebe.from_image(coarse, ATRIUM) - wanted).max(), abs=1e-9) and told > 0.1


def test_sampled_pixels_have_the_values_at_their_centres_and_errors_halve():
    wanted = times(ATRIUM)
    means = []
    for pixels in (64, 128, 256):
        image, error = koebe.to_image(ATRIUM, wanted, pixels, exact=False)
        gaps = np.abs(koebe.from_image(image, ATRIUM) - wanted)
        assert error == pytest.approx(gaps.max(), abs=1e-12)
        means.append(gaps.mean())
    assert means[1] == pytest.approx(means[0] / 2, rel=0.15) and means[2] == pytest.approx(means[1] / 2, rel=0.15)
    image, _ = koebe.to_image(ATRIUM, ATRIUM.uv, 200, exact=False)
    x, y = centers_of(200)
    well = inside(200, 0.02)  # not between a rim's chord and its arc
    assert np.allclose(image[well], np.stack([x[well], y[well]], axis=1), atol=1e-12)


def test_an_exact_image_is_near_the_sampled_image():
    wanted = times(ATRIUM)
    sampled, exact = (koebe.to_image(ATRIUM, wanted, 256, exact=how)[0] for how in (False, True))
    gaps = np.abs(sampled - exact)[inside(256)]
    assert 0 < np.sqrt(np.mean(gaps**2)) < 0.06 and np.quantile(gaps, 0.999) < 0.8


def test_pixels_cover_the_circle_domain_and_no_more():
    image, _ = koebe.to_image(ATRIUM, times(ATRIUM), 300)
    known = np.isfinite(image)
    assert known[inside(300)].all() and not known[~inside(300, -0.03)].any()
    corners = ATRIUM.uv[ATRIUM.surface[1]]  # on the faces between an arc and its chord, too
    for places in (corners.mean(axis=1), 0.5 * (corners[:, 0] + corners[:, 1]), 0.5 * (corners[:, 1] + corners[:, 2])):
        column, row = np.floor(150 * (1 + places * [1, -1])).astype(int).T
        assert known[row, column].all()


def test_two_surfaces_share_an_image():
    there = koebe.from_image(koebe.to_image(ATRIUM, times(ATRIUM), 256)[0], COARSE)
    assert np.isfinite(there).all()
    gaps = np.abs(there - koebe.transfer(ATRIUM, COARSE, times(ATRIUM)))
    assert gaps.mean() < 0.1 and np.quantile(gaps, 0.95) < 0.4
    columns = koebe.to_image(ATRIUM, ATRIUM.surface[0], 128)
    assert columns[0].shape == (128, 128, 3) and koebe.from_image(columns[0], COARSE).shape == (COARSE.vertex_count, 3)


def test_a_place_comes_back_to_itself():
    there = koebe.transfer(COARSE, ATRIUM)  # of each vertex of the atrium a place on the coarse one, and back
    uv = np.einsum("vk,vkc->vc", there.weights, COARSE.uv[COARSE.surface[1][there.faces]])
    well = there.distances < 1e-12
    assert well.mean() > 0.8 and np.allclose(uv[well], ATRIUM.uv[well], atol=1e-12)


def test_labels():
    region = np.arange(ATRIUM.vertex_count) % 3
    image, share = koebe.to_image(ATRIUM, region, 128)
    back = koebe.from_image(image, ATRIUM)
    assert set(np.unique(image)) == {-1, 0, 1, 2} and image[0, 0] == -1
    assert share == np.mean(back != region) and share < 0.05
    words = np.array(["wall", "roof", "vein"])[region]
    assert (koebe.from_image(koebe.to_image(ATRIUM, words, 128)[0], ATRIUM) != words).mean() == share
    floats = koebe.to_image(ATRIUM, region.astype(float), 128, labels=True)
    assert floats[1] == share and set(np.unique(koebe.from_image(floats[0], ATRIUM, labels=True))) <= {0.0, 1.0, 2.0}
    assert koebe.to_image(ATRIUM, region, 128, labels=False)[1] < 1e-5


def test_what_is_unknown_stays_unknown():
    field = times(ATRIUM)
    field[100] = np.nan
    image, error = koebe.to_image(ATRIUM, field, 256)
    back = koebe.from_image(image, ATRIUM)
    unknown = np.isnan(back)
    assert unknown[100] and unknown.sum() < 20 and error < 1e-6
    assert np.abs(back - field)[~unknown].max() == pytest.approx(error, abs=1e-12)
    mask = ATRIUM.surface[0][:, 1] > 0.8 * MILLIMETRES
    part = koebe.uniformize(*ATRIUM.surface, mask=mask)
    back = koebe.from_image(koebe.to_image(part, times(ATRIUM), 128)[0], part)
    assert np.array_equal(np.isnan(back), np.isnan(part.uv[:, 0])) and np.isnan(back).any()


def test_refusals():
    field = times(ATRIUM)
    for call in (
        lambda: koebe.to_image(ATRIUM, field[:-1]),
        lambda: koebe.to_image(ATRIUM, field, 1),
        lambda: koebe.to_image(ATRIUM, field, 10**6),
        lambda: koebe.to_image(ATRIUM, np.array(["a"] * len(field)), labels=False),
        lambda: koebe.from_image(np.zeros((4, 5)), ATRIUM),
        lambda: koebe.from_image(np.zeros(4), ATRIUM),
        lambda: koebe.from_image(np.full((4, 4), None), ATRIUM),
        lambda: koebe.from_image(np.full((4, 4), "a"), ATRIUM, labels=False),
    ):
        with pytest.raises(koebe.InputError):
            call()
    for call in (lambda: koebe.to_image(ATRIUM.surface, field), lambda: koebe.from_image(np.zeros((4, 4)), "face")):
        with pytest.raises(TypeError):
            call()
