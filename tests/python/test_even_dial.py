"""A map made more or less even from where it is, and the drag of the slider in Blender."""

import koebe
import numpy as np
import pytest
from cli_support import triangulated_plate
from uv_measures import signed_areas


def panel(n=20):
    """A bent plate with holes, and its map."""
    vertices, triangles = triangulated_plate(n)
    return vertices, triangles, koebe.uniformize(vertices, triangles)


def spread(vertices, triangles, uv):
    """Ratio of texel densities at 95 % and 5 % of the faces."""
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    in_plane = 2 * signed_areas(uv[triangles])
    assert in_plane.min() > 0
    low, high = np.percentile(np.sqrt(in_plane / np.linalg.norm(np.cross(b - a, c - a), axis=1)), [5, 95])
    return high / low


def energy(vertices, triangles, uv, even):
    """E_t per area, with the map as large as the surface."""
    one, two = (vertices[triangles[:, k]] - vertices[triangles[:, 0]] for k in (1, 2))
    x = np.linalg.norm(one, axis=1)
    along = (one * two).sum(axis=1) / x
    height = np.linalg.norm(np.cross(one, two), axis=1) / x
    area = 0.5 * x * height
    p, q = uv[triangles[:, 1]] - uv[triangles[:, 0]], uv[triangles[:, 2]] - uv[triangles[:, 0]]
    image = 0.5 * (p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0])
    scale = np.sqrt(area.sum() / image.sum())
    first = scale * p / x[:, None]
    second = (scale * q - first * along[:, None]) / height[:, None]
    d = first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]
    squares = (first**2).sum(axis=1) + (second**2).sum(axis=1)
    t = even / (1.1 - even)
    return (area * (squares / d - 2 + t * (d + 1 / d - 2))).sum() / area.sum()


def settled(dial, even, most=60):
    for _ in range(most):
        before = dial.uv
        if np.abs(dial.move(even, steps=5) - before).max() < 1e-9:
            break
    return dial.uv


@pytest.mark.parametrize("round_loops", [True, False])
def test_it_makes_texels_even_and_back(round_loops):
    vertices, triangles, first = panel()
    dial = koebe.EvenDial(vertices, triangles, uv=first.uv, round=round_loops)
    spreads = [spread(vertices, triangles, first.uv)]
    for even in (0.1, 0.4, 1.0):
        spreads.append(spread(vertices, triangles, settled(dial, even)))
    assert spreads == sorted(spreads, reverse=True) and spreads[-1] < 0.5 * spreads[0] + 0.5
    if round_loops:
        for loop, off in zip(first.loops, first.off_circle, strict=True):
            on = dial.uv[np.setdiff1d(loop, off)]
            center, radius = circle(on)
            assert np.abs(np.linalg.norm(on - center, axis=1) / radius - 1).max() < 1e-9
        settled(dial, 0.0)  # of all maps to circles the most even one; with free loops many maps are conformal
        assert spread(vertices, triangles, dial.uv) > 1.5 * spreads[-1]


def circle(points):
    """The circle of least squares, centre and radius."""
    system = np.column_stack([2 * points, np.ones(len(points))])
    x, y, c = np.linalg.lstsq(system, (points**2).sum(axis=1), rcond=None)[0]
    return np.array([x, y]), np.sqrt(c + x * x + y * y)


def test_many_small_moves_end_as_one_cold_run():
    vertices, triangles, first = panel(12)
    dial = koebe.EvenDial(vertices, triangles, uv=first.uv, round=False)
    for even in np.linspace(0.0, 0.4, 9):
        dial.move(even)
    warm = energy(vertices, triangles, settled(dial, 0.4), 0.4)
    cold = energy(vertices, triangles, koebe.uniformize(vertices, triangles, even=0.4, loops="free").uv, 0.4)
    assert warm == pytest.approx(cold, rel=0.02)


def test_wrong_calls_are_refused():
    vertices, triangles, first = panel(8)
    dial = koebe.EvenDial(vertices, triangles, uv=first.uv)
    for wrong in (-0.1, 1.1, float("nan")):
        with pytest.raises(koebe.OptionError, match="even"):
            dial.move(wrong)
    with pytest.raises(koebe.OptionError, match="steps"):
        dial.move(0.5, steps=0)
    with pytest.raises(koebe.InputError, match="turned over"):
        koebe.EvenDial(vertices, triangles, uv=first.uv * [1.0, -1.0])
    with pytest.raises(koebe.InputError, match="rows"):
        koebe.EvenDial(vertices, triangles, uv=first.uv[:-1])
    sphere = [[1, 0, 0], [0, 1, 0], [0, 0, 1], [-1, -1, -1]], [[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]]
    with pytest.raises(koebe.TopologyError, match="closed"):
        koebe.EvenDial(*sphere, uv=np.random.default_rng(1).random((4, 2)))
    token = koebe.CancelToken()
    token.cancel()
    before = dial.uv
    with pytest.raises(koebe.Cancelled):
        dial.move(0.5, cancel=token)
    assert np.array_equal(dial.uv, before)


def test_a_drag_asks_for_one_step_at_a_time_and_ends(addon):
    even_drag = addon("layers.even_drag")
    drag = even_drag.EvenDrag(0.25, 100.0)
    assert drag.next() is None and not drag.has_changed
    drag.pull(100.0 + 0.5 * even_drag.WIDTH)
    assert drag.even == pytest.approx(0.75) and drag.has_changed
    assert drag.next() == drag.even
    drag.done(0.1)
    assert drag.next() == drag.even
    drag.done(0.0)  # nothing moved
    assert drag.next() is None
    drag.pull(100.0 + 5.0 * even_drag.WIDTH)
    assert drag.even == 1.0
    drag.pull(100.0 + 4.9 * even_drag.WIDTH)  # from beyond the end the pointer turns back at once
    assert drag.even == pytest.approx(0.9)
    drag.pull(100.0 + 4.8 * even_drag.WIDTH, fine=True)
    assert drag.even == pytest.approx(0.89)
    steps = 0
    while drag.next() is not None:
        drag.done(1.0)
        steps += 1
    assert steps == even_drag.ENOUGH
    drag.pull(-1e6)
    assert drag.even == 0.0 and drag.next() == 0.0


def test_a_step_for_an_earlier_place_does_not_end_the_drag(addon):
    drag = addon("layers.even_drag").EvenDrag(0.0, 0.0)
    drag.pull(50.0)
    assert drag.next() is not None
    drag.pull(60.0)
    drag.done(0.0)
    assert drag.next() == drag.even


def upright(uv, triangles):
    return bool((signed_areas(uv[triangles]) > 0).all())


def outline_crossings(uv, triangles):
    """How many pairs of boundary edges cross."""
    ends = np.concatenate([triangles[:, [k, (k + 1) % 3]] for k in range(3)])
    inside = {tuple(pair) for pair in ends[:, ::-1].tolist()}
    rim = np.array([pair for pair in ends.tolist() if tuple(pair) not in inside])
    z = uv @ [1, 1j]
    a, b = z[rim[:, 0]], z[rim[:, 1]]

    def side(p, q, r):
        return np.sign((np.conj(q - p) * (r - p)).imag)

    c, d = a[:, None], b[:, None]
    return int(((side(a, b, c) * side(a, b, d) < 0) & (side(c, d, a) * side(c, d, b) < 0)).sum())


def test_one_pin_moves_and_two_pins_turn_and_scale():
    vertices, triangles, first = panel(10)
    z = first.uv @ [1, 1j]
    dial = koebe.EvenDial(vertices, triangles, uv=first.uv)  # round loops stay round
    for pins in ({7: (0.25, 2.0)}, {7: (0.25, 2.0), 30: (-0.5, 1.0)}):
        uv = dial.pin(pins)
        factor = (uv[30] - uv[7]) @ [1, 1j] / (z[30] - z[7])
        assert np.allclose(uv @ [1, 1j], uv[7] @ [1, 1j] + factor * (z - z[7]), atol=1e-12)
        assert all(tuple(uv[vertex]) == place for vertex, place in pins.items())
        assert len(pins) > 1 or factor == pytest.approx(1.0)
    moved = settled(dial, 0.6)
    assert tuple(moved[7]) == (0.25, 2.0) and tuple(moved[30]) == (-0.5, 1.0)
    assert spread(vertices, triangles, moved) < spread(vertices, triangles, first.uv)


@pytest.mark.parametrize("seed", range(12))
def test_pins_bend_the_map_and_it_stays_one_to_one(seed):
    rng = np.random.default_rng(seed)
    vertices, triangles, first = panel(10)
    dial = koebe.EvenDial(vertices, triangles, uv=first.uv, round=False)
    chosen = rng.choice(np.unique(triangles), rng.integers(3, 7), replace=False).tolist()
    places = 0.5 * first.uv[chosen] + rng.normal(scale=10.0 ** rng.uniform(-3, -0.5), size=(len(chosen), 2))
    before = dial.uv
    try:
        uv = dial.pin(dict(zip(chosen, places, strict=True)), even=0.4)
    except koebe.SolverError as error:
        assert "pins" in str(error) and set(error.elements) <= set(chosen) and error.elements
        assert np.array_equal(dial.uv, before)
        return
    for now in (uv, dial.move(0.4, steps=3)):
        assert np.array_equal(now[chosen], places)
        assert upright(now, triangles) and outline_crossings(now, triangles) == 0


def test_pins_that_no_map_can_have_are_refused():
    vertices, triangles, first = panel(8)
    dial = koebe.EvenDial(vertices, triangles, uv=first.uv, round=False)
    before = dial.uv
    a, b, c = triangles[20].tolist()
    places = dict(zip((a, b, c), first.uv[[a, c, b]], strict=True))
    with pytest.raises(koebe.InputError, match="turn faces over") as turned:
        dial.pin(places)
    assert sorted(turned.value.elements) == sorted((a, b, c))
    # Two edges with pinned ends that cross.
    ends = triangles[3, :2].tolist() + triangles[-3, :2].tolist()
    crossing = dict(zip(ends, [(0.0, 0.0), (1.0, 1.0), (0.0, 1.0), (1.0, 0.0)], strict=True))
    with pytest.raises(koebe.SolverError, match="no one-to-one map was found") as error:
        dial.pin(crossing)
    assert set(error.value.elements) <= set(ends) and error.value.elements
    for wrong, text in (
        ({10**6: (0, 0)}, "pins"), ({1: (0, 0), 2: (0, 0)}, "at one place"), ({1: (0, float("nan"))}, "NaN"),
        ({1.5: (0, 0)}, "whole"), ({1: (0, 0, 0)}, "pins"), ({1: (0, 0), 2: (1,)}, "pins"),
    ):  # fmt: skip
        with pytest.raises(koebe.InputError, match=text):
            dial.pin(wrong)
    with pytest.raises(koebe.InputError, match="round loops"):
        koebe.EvenDial(vertices, triangles, uv=first.uv).pin(dict(zip(ends, first.uv[ends], strict=True)))
    assert np.array_equal(dial.uv, before)
    assert np.allclose(dial.pin({}), before, rtol=0.0, atol=1e-14)
    dial.pin(dict(zip(ends, first.uv[ends], strict=True)))
