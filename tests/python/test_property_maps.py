"""What every map promises, on random surfaces (Hypothesis): finite, one to one, inside the disk, true to its report,
and the same for the same surface. KOEBE_EXAMPLES asks for more examples of each.
"""

import koebe
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from test_property_surfaces import KINDS, any_surface, damaged, randoms, surfaces

ON_CIRCLE = 1e-6  # disk units
ROUNDING = 1e-12  # disk units, of a point of the unit circle
SAME = 1e-6  # disk units, of two maps of one surface

options = st.fixed_dictionaries(
    {},
    optional={
        "method": st.sampled_from(["gk", "ck"]),
        "engine": st.sampled_from(["condensed", "condensed", "mesh"]),
        "balance": st.sampled_from(["none", "area"]),
        "outer": st.just("longest"),
        "max_sweeps": st.sampled_from([1, 5, 200]),
        "polish": st.booleans(),
        "threads": st.integers(0, 3),
    },
)


def said(result):
    return " ".join(map(str, result.warnings))


def stored(uv):
    """UVs as Blender stores them."""
    return ((1 + uv) / 2).astype(np.float32).astype(np.float64)


def from_lowest(loop):
    """The vertices in their order, the lowest first."""
    return np.roll(loop, -loop.argmin()).tolist()


def require_promises(result, vertices, faces):
    """All that can be checked of a map of faces of one orientation without knowing how it was made."""
    uv, loops, centers, radii = result.uv, result.loops, result.centers, result.radii
    assert uv.shape == (len(vertices), 2) and uv.dtype == np.float64
    assert np.isfinite(uv).all() and np.isfinite(centers).all() and np.isfinite(radii).all()
    assert np.hypot(*uv.T).max() <= 1 + ROUNDING

    assert tuple(centers[0]) == (0.0, 0.0) and radii[0] == 1.0 and (radii > 0).all()
    z = centers @ [1, 1j]
    assert (abs(z[1:]) + radii[1:] <= 1 + ROUNDING).all()
    gaps = abs(z[1:, None] - z[1:]) - radii[1:, None] - radii[1:]
    assert (gaps[~np.eye(len(gaps), dtype=bool)] >= -ROUNDING).all()

    rims = koebe.boundary_loops(faces, vertex_count=len(vertices))
    assert sorted(map(from_lowest, loops)) == sorted(map(from_lowest, rims))
    for loop, off, center, radius in zip(loops, result.off_circle, centers, radii, strict=True):
        assert set(off) <= set(loop)
        on = uv[np.setdiff1d(loop, off)]
        assert (abs(np.hypot(*(on - center).T) - radius) <= ON_CIRCLE).all()

    a, b, c = (stored(uv)[faces[:, k]] for k in range(3))
    area = (b - a)[:, 0] * (c - a)[:, 1] - (c - a)[:, 0] * (b - a)[:, 1]
    tiny = np.max([np.hypot(*(p - q).T) for p, q in ((a, b), (b, c), (c, a))], axis=0) < 1e-6
    assert result.flipped == (area <= 0).sum() and result.below_resolution == ((area <= 0) & tiny).sum()
    assert result.flipped == result.below_resolution or (not result.converged and "one-to-one" in said(result))
    if result.below_resolution:
        assert "resolution" in said(result)

    report = result.to_dict()
    numbers = [report["conformal_energy"], *report["beltrami"].values(), report["angle_error_deg"]["mean"]]
    assert np.isfinite(numbers).all() and np.isfinite(result.roundness).all()


def require_same_map(first, second, new_number):
    """Equal up to a rotation, unless one says that it need not be."""
    if "last digits" in said(first) + said(second):
        return
    z, w = first.uv @ [1, 1j], (second.uv @ [1, 1j])[new_number]
    turn = np.vdot(w, z)
    turn = turn / abs(turn) if abs(turn) > 1e-9 else 1.0
    assert np.abs(z - turn * w).max() <= SAME
    assert first.converged == second.converged and first.flipped == second.flipped
    assert np.allclose(np.sort(first.radii), np.sort(second.radii), rtol=0, atol=SAME)


@pytest.mark.parametrize("kind", KINDS)
def test_every_map_keeps_its_promises(kind):
    @given(surfaces(kind))
    def check(surface):
        vertices, faces = surface
        before = vertices.copy(), faces.copy()
        try:
            result = koebe.uniformize(vertices, faces)
        except koebe.KoebeError as error:
            pytest.fail(f"{type(error).__name__}: {error}")  # there is a map of each of these
        require_promises(result, vertices, faces)
        assert np.array_equal(vertices, before[0]) and np.array_equal(faces, before[1])

    check()


@given(any_surface, options)
def test_every_option_keeps_the_promises(surface, chosen):
    require_promises(koebe.uniformize(*surface, **chosen), *surface)


@given(any_surface, randoms())
def test_every_choice_of_the_outer_loop_keeps_the_promises(surface, random):
    vertices, faces = surface
    loops = koebe.boundary_loops(faces, vertex_count=len(vertices))
    chosen = loops[int(random.integers(len(loops)))]
    result = koebe.uniformize(vertices, faces, outer=int(random.choice(chosen)))
    assert set(result.loops[0]) == set(chosen)
    require_promises(result, vertices, faces)


@given(damaged())
def test_damaged_arrays_give_a_map_or_a_typed_error_and_stay_as_they_are(arrays):
    vertices, faces = (array.copy() for array in arrays)
    try:
        result = koebe.uniformize(vertices, faces)
    except koebe.KoebeError as error:
        assert str(error) and "internal" not in str(error)
    else:
        assert np.isfinite(result.uv).all() and np.hypot(*result.uv.T).max() <= 1 + ROUNDING
        assert (result.radii > 0).all()
        assert result.flipped == result.below_resolution or not result.converged
    assert np.array_equal(vertices, arrays[0], equal_nan=True) and np.array_equal(faces, arrays[1])


@given(any_surface, options, st.integers(0, 4))
def test_a_rerun_gives_the_same_bits_with_any_number_of_threads(surface, chosen, threads):
    first = koebe.uniformize(*surface, **chosen)
    second = koebe.uniformize(*surface, **(chosen | {"threads": threads}))
    assert np.array_equal(first.uv, second.uv) and np.array_equal(first.radii, second.radii)
    varying = {"seconds", "peak_memory_mb", "options"}
    one, other = ({k: v for k, v in r.to_dict().items() if k not in varying} for r in (first, second))
    assert one == other


def rotation(random):
    turn = np.linalg.qr(random.normal(size=(3, 3)))[0]
    return turn * np.linalg.det(turn)


@pytest.mark.parametrize("kind", KINDS)
def test_the_same_surface_gives_the_same_map(kind):
    @given(surfaces(kind), randoms(), st.sampled_from([1e-8, 1e-3, 0.7, 1.0, 1e8]))
    def check(surface, random, scale):
        vertices, faces = surface
        new_number = random.permutation(len(vertices))
        moved = np.empty_like(vertices)
        moved[new_number] = scale * (vertices @ rotation(random).T + random.normal(size=3))
        turned = np.array([np.roll(f, random.integers(3)) for f in new_number[faces]])
        result = koebe.uniformize(vertices, faces)
        require_same_map(result, koebe.uniformize(moved, random.permutation(turned)), new_number)

    check()


@given(any_surface, st.integers(1, 5))
def test_vertices_of_no_face_change_nothing(surface, count):
    vertices, faces = surface
    more = np.vstack([np.full((count, 3), 1e6), vertices])
    with_them = koebe.uniformize(more, faces + count)
    assert np.array_equal(with_them.uv[count:], koebe.uniformize(vertices, faces).uv)
    assert np.array_equal(with_them.uv[:count], np.zeros((count, 2)))
