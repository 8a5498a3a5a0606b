"""What may be compared: an option of `uniformize` leaves the numbers of a shape alone, or the comparison is refused."""

import pickle

import koebe
import numpy as np
import pytest
from cli_support import triangulated_plate
from koebe import _option_table

HOLES = ((0.3, 0.3, 0.14), (0.7, 0.35, 0.1), (0.5, 0.72, 0.12))
VERTICES, FACES = triangulated_plate(16, HOLES)
PLAIN = koebe.uniformize(VERTICES, FACES)
OTHER = koebe.uniformize(VERTICES * [1, 1.4, 1] + 0.1 * np.sin(5 * VERTICES[:, [1, 0, 2]]), FACES)
INSIDE = int(np.setdiff1d(np.arange(len(VERTICES)), np.concatenate(PLAIN.loops))[7])
ERROR = float(np.linalg.norm(koebe.module_error(PLAIN)))  # of the mesh
ROWS = _option_table.rows("uniformize")


def values(row):
    """Values of an option that are not its default."""
    if row.kind in ("choice", "loop"):
        return [word for word in row.words if word != row.default] + [int(PLAIN.loops[1][0])] * (row.kind == "loop")
    if row.kind in ("number", "integer"):
        some = (0.0, 1e-9, 1e-3, 0.3, 1.0) if row.kind == "number" else (1, 2, 200)
        # `weld` joins vertices: what lies farther apart is another surface.
        some = tuple(number for number in some if row.name != "weld" or number < 1e-2)
        return [number for number in some if row.has(number) and number != row.default]
    return {
        "flag": [True], "vertex": [INSIDE if row.name == "center" else int(PLAIN.loops[0][3])],
        "weights": [np.linspace(0, 1, len(VERTICES))], "steps": [[[0, 1], [2, 3]] * 4, [[0, 1]]],
    }[row.kind]  # fmt: skip


NEEDED = {"loops": ({"even": 0.4},), "importance": ({"even": 0.4}, {"balance": "area"})}
CALLS = [
    pytest.param({**more, **({"engine": "mesh"} if row.of_mesh_engine else {}), row.name: value}, id=f"{row.name}-{k}")
    for row in ROWS.values()
    for k, value in enumerate(values(row))
    for more in NEEDED.get(row.name, ({},))
]


@pytest.mark.parametrize("options", CALLS)
def test_an_option_leaves_the_shape_alone_or_is_refused(options):
    try:
        result = koebe.uniformize(VERTICES, FACES, **options)
    except koebe.InputError:  # of options that exclude each other, or a schedule that leaves out a loop
        return
    # Other steps and other disks have another error of the mesh; all else changes no circle.
    rounding = 1e-6 + 10 * options.get("tolerance", 1e-6)
    limit = max(ERROR, rounding) if {"method", "engine", "outer", "balance"} & set(options) else rounding
    try:
        far = koebe.separation_distance(result, OTHER, any_outer=True)
    except koebe.InputError as error:
        assert "cut" in options or ("not converged" in str(error) and not result.converged)
        return
    assert far == pytest.approx(
        koebe.separation_distance(PLAIN, OTHER, any_outer=True), abs=20 * rounding + (limit > rounding) * ERROR
    )
    assert koebe.match_loops(result, PLAIN, any_outer=True).distance < limit
    assert result.conformal.own.all() and result.conformal.converged


def moved_maps():
    fit = koebe.fit_circles((VERTICES, FACES), [(-0.4, -0.2), (0.4, -0.2), (0, 0.4)], [0.2, 0.2, 0.2])
    yield from (koebe.uniformize(VERTICES, FACES, even=0.6, loops=form) for form in ("round", "free"))
    yield fit


@pytest.mark.parametrize("moved", moved_maps(), ids=["even", "even-free", "fit"])
def test_a_moved_map_keeps_its_conformal_domain(moved, tmp_path):
    place = [next(k for k, loop in enumerate(PLAIN.loops) if one[0] in loop) for one in moved.loops]
    back = np.argsort(place)
    assert not moved.own_circle.any() and abs(moved.uv - PLAIN.uv).max() > 0.01
    moved.save(tmp_path / "moved.npz")
    for result in (moved, koebe.load(tmp_path / "moved.npz"), pickle.loads(pickle.dumps(moved))):
        assert np.allclose(result.conformal.uv, PLAIN.uv, atol=1e-9)
        assert np.allclose(koebe.conformal_module(result, order=back), koebe.conformal_module(PLAIN), atol=1e-9)
        assert koebe.module_distance(result, PLAIN) < 1e-9
        assert np.allclose(koebe.separations(result)[np.ix_(back, back)], koebe.separations(PLAIN), atol=1e-9)
        assert koebe.separation_distance(result, OTHER) == pytest.approx(koebe.separation_distance(PLAIN, OTHER))
        assert np.allclose(koebe.module_error(result, order=back), koebe.module_error(PLAIN), atol=1e-9)
        distances = koebe.family([PLAIN, OTHER, result]).distances
        assert distances[0, 2] < 1e-9 and distances[0, 1] == pytest.approx(distances[2, 1])
        assert koebe.align_domains(PLAIN, result).residual < 1e-9
        assert np.allclose(koebe.transfer(result, PLAIN).points, VERTICES, atol=1e-6)
        assert np.allclose(koebe.transfer(PLAIN, result).points, VERTICES, atol=1e-6)
    for goal in (OTHER, PLAIN):  # loops come in another order, which changes no bit
        plain, again = koebe.teichmueller(PLAIN, goal), koebe.teichmueller(moved, goal)
        assert plain.K == again.K and np.array_equal(again.uv, plain.uv)
        assert [again.match[k] for k in back] == list(plain.match)


def test_what_has_not_converged_is_refused():
    early = koebe.uniformize(VERTICES, FACES, max_sweeps=1, tolerance=1e-14)
    for call in (
        lambda: koebe.conformal_module(early),
        lambda: koebe.module_distance(PLAIN, early),
        lambda: koebe.separation_distance(early, PLAIN),
        lambda: koebe.teichmueller(early, PLAIN),
        lambda: koebe.teichmueller(PLAIN, early),
        lambda: koebe.transfer(PLAIN, early),
        lambda: koebe.module_error(early),
        lambda: koebe.family([PLAIN, early]),
    ):
        with pytest.raises(koebe.InputError, match="not converged"):
            call()


def test_a_match_means_one_thing_everywhere():
    match = [0, 2, 3, 1]  # not its own inverse
    a, b = PLAIN, OTHER
    s, t = koebe.separations(a), koebe.separations(b)[np.ix_(match, match)]
    pairs = np.triu_indices(len(s), 1)
    assert koebe.separation_distance(a, b, match=match) == pytest.approx(np.sqrt(((s - t)[pairs] ** 2).mean()))
    assert list(koebe.align_domains(a, b, match=match).match) == match
    carried = koebe.transfer(a, b, match=match)
    assert list(carried.match) == list(carried.alignment.match) == match
    extremal = koebe.teichmueller(a, b, match=match)
    for uv in (carried.uv, extremal.uv):  # a's rims lie on b's circles
        for loop, off, k in zip(a.loops, a.off_circle, match, strict=True):
            away = np.linalg.norm(uv[np.setdiff1d(loop, off)] - b.centers[k], axis=1)
            assert np.allclose(away, b.radii[k], atol=1e-6)
    # The same shape with its loops in another order: what is found has this form too.
    turned = koebe.fit_circles(a.surface, b.centers[match][1:], b.radii[match][1:], loops=_ranks(a)[1:])
    for found in (
        koebe.match_loops(a, turned).match,
        koebe.family([a, turned]).match(0, 1),
        koebe.transfer(a, turned).match,
    ):
        assert list(found) == [0, 1, 2, 3]
    renamed = koebe.fit_circles(a.surface, b.centers[1:], b.radii[1:], loops=[_ranks(a)[k] for k in match[1:]])
    for found in (koebe.match_loops(renamed, a).match, koebe.family([renamed, a]).match(0, 1)):
        assert list(found) == match
    assert koebe.transfer(renamed, a).match == match and koebe.teichmueller(renamed, a).match.tolist() == match


def _ranks(result):
    loops = koebe.boundary_loops(FACES)
    return [next(k for k, loop in enumerate(loops) if one[0] in loop) for one in result.loops]
