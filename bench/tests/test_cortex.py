"""A cortex beside FreeSurfer's flat map of it, and what measures them (bench/cortex.py)."""


import cortex
import numpy as np


def sheet(n=21, step=4.0):
    """Places (n², 2) of a square grid, and its triangles."""
    x, y = (k.ravel() * step for k in np.meshgrid(np.arange(n), np.arange(n), indexing="ij"))
    i, j = (k.ravel() for k in np.meshgrid(np.arange(n - 1), np.arange(n - 1), indexing="ij"))
    a = i * n + j
    return np.stack([x, y], 1), np.concatenate([np.stack([a, a + n, a + n + 1], 1), np.stack([a, a + n + 1, a + 1], 1)])


def test_distances_of_a_rolled_sheet_are_those_of_the_sheet():
    flat, triangles = sheet()
    bend = 2.0 * 10.0 * np.sin(0.2)  # as wide as a step: a chord of 0.4 on a circle of radius 10
    angle = flat[:, 0] / 4.0 * 0.4
    rolled = np.stack([10.0 * np.cos(angle), 10.0 * np.sin(angle), flat[:, 1]], 1)
    flat[:, 0] *= bend / 4.0
    sources = np.array([0, 47, 220, 300])
    distances = cortex.geodesics(cortex.Surface(rolled, triangles, flat, flat[:, 0]), sources)
    error, scale = cortex.distance_error(3.0 * flat, sources, distances)
    assert error < 1e-12 and np.isclose(3.0 * scale, 1.0)

    stretched = flat * [3.0, 1.0]
    error, _ = cortex.distance_error(stretched, sources, distances)
    chosen = (distances >= 2.0) & (distances <= 40.0)
    apart = np.linalg.norm(stretched[None] - stretched[sources][:, None], axis=2)
    tried = [np.abs(s * apart[chosen] / distances[chosen] - 1.0).mean() for s in np.linspace(0.3, 1.0, 7001)]
    assert error > 0.2 and 0.0 <= min(tried) - error < 1e-4


def test_a_border_that_crosses_itself_is_seen():
    flat, triangles = sheet(5)
    assert cortex.crossings(flat, triangles) == 0
    flat[0] = [-40.0, -20.0]
    assert cortex.crossings(flat, triangles) == 0
    flat[0] = [3.0, 20.0]  # a corner, over the border on the other side
    assert cortex.crossings(flat, triangles) > 0
    flat[0] = [0.0, 10.0]  # on it
    assert cortex.crossings(flat, triangles) > 0


def test_angles_areas_and_distances_are_better_than_freesurfers():
    surface = cortex.read()
    sources = np.random.default_rng(2).choice(len(surface.vertices), 8, replace=False)
    distances = cortex.geodesics(surface, sources)
    flat, _ = cortex.ours(surface, 1, "free")
    ours, published = (
        [float(cell.strip("°% ")) for cell in cortex.cells(surface, places, sources, distances, "0")]
        for places in (flat, surface.flat)
    )
    assert np.isclose(published[0], 12.9, atol=0.05) and np.isclose(published[1], 0.316, atol=5e-4)
    assert ours[0] < 0.5 * published[0] and ours[1] < published[1] and ours[2] < published[2]
    assert ours[3] == ours[4] == 0
