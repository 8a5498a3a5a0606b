"""Maps to circles at given places: laws, and the command."""

import json

import koebe
import numpy as np
import pytest
from cli_support import CANNOT_BE_MAPPED, USAGE, obj_text, succeeded
from cli_support import koebe as command
from domain_surfaces import cell, merged, patchwork
from uv_measures import signed_areas

HOLED = {(0, 0): 0.3, (1, 1): 0.2, (2, 0): 0.25}
SPOTS = 0.5 * np.array([[np.cos(a), np.sin(a)] for a in 2 * np.pi * np.arange(3) / 3])


def plate(steps, bulge=0.0):
    """A plate of 3 x 2 cells with three round holes, bent."""

    def make(i, j, corner):
        hole = (corner + 1 / 6, HOLED[i, j] / 3) if (i, j) in HOLED else None
        points, faces = cell(corner, 1 / 3, steps, hole)
        return points, faces, np.zeros(len(points))

    points, faces, _ = patchwork(3, 2, make)
    points, faces, _ = merged(points, faces)
    x, y = points.T
    return np.column_stack([x, y, bulge * np.sin(5 * x) * np.cos(4 * y)]), faces.astype(np.int32)


PLATE = plate(8, 0.2)
CONFORMAL = koebe.uniformize(PLATE)
FIT = koebe.fit_circles(PLATE, SPOTS, [0.2, 0.3, 0.1], names=["a", "b", "c"])


def mu_of(vertices, faces, uv):
    """|mu| of each face, from its singular values."""
    e = vertices[faces[:, 1:]] - vertices[faces[:, :1]]
    first = e[:, 0] / np.linalg.norm(e[:, 0], axis=1, keepdims=True)
    normal = np.cross(e[:, 0], e[:, 1])
    second = np.cross(normal / np.linalg.norm(normal, axis=1, keepdims=True), first)
    flat = np.stack([np.einsum("fkd,fd->fk", e, first), np.einsum("fkd,fd->fk", e, second)], axis=1)
    image = np.swapaxes(uv[faces[:, 1:]] - uv[faces[:, :1]], 1, 2)
    large, small = np.linalg.svd(image @ np.linalg.inv(flat), compute_uv=False).T
    return (large - small) / (large + small)


def test_rims_lie_on_the_circles_and_no_face_turns_over():
    assert FIT.flipped == 0 and FIT.converged and FIT.fit["residual"] < 1e-9
    assert np.array_equal(FIT.centers[1:], SPOTS) and np.array_equal(FIT.radii, [1, 0.2, 0.3, 0.1])
    for loop, center, radius in zip(FIT.loops, FIT.centers, FIT.radii, strict=True):
        assert np.allclose(np.linalg.norm(FIT.uv[loop] - center, axis=1), radius, atol=1e-9)
    stored = np.float32(0.5 + 0.5 * FIT.uv).astype(float)
    assert signed_areas(stored[PLATE[1]]).min() > 0


def test_holes_are_round():
    # Vertices that gather on an arc would close a hole, and its rim would still lie on the circle.
    for loop, radius in zip(FIT.loops, FIT.radii, strict=True):
        x, y = FIT.uv[loop].T
        area = abs(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))) / 2
        assert area > 0.8 * np.pi * radius**2


def test_mu_is_that_of_the_map():
    assert np.allclose(FIT.mu, mu_of(*PLATE, FIT.uv), atol=1e-6)
    assert FIT.fit["mu"]["max"] == pytest.approx(FIT.mu.max())
    assert FIT.fit["mu"]["dilatation"] == pytest.approx((1 + FIT.mu.max()) / (1 - FIT.mu.max()))


def test_no_face_could_bend_less_by_moving_a_vertex():
    # At the minimum a small move of inner vertices changes the sum only in second order.
    vertices, faces = PLATE
    flat = np.column_stack([CONFORMAL.uv, np.zeros(len(vertices))])
    own = koebe.fit_circles(PLATE, CONFORMAL.centers, CONFORMAL.radii)
    fit = koebe.fit_circles(PLATE, own.centers[1:], own.radii[1:] * 0.6, loops=own.ranks[1:])
    e = vertices[faces[:, 1:]] - vertices[faces[:, :1]]
    weight = np.linalg.norm(np.cross(e[:, 0], e[:, 1]), axis=1)
    weight = np.maximum(weight, 1e-3 * weight.mean())

    def energy(uv):
        mu = mu_of(flat, faces, uv)
        return weight @ (mu**2 / (1 - mu**2)) / weight.sum()

    inner = np.ones(len(vertices), bool)
    inner[np.concatenate(fit.loops)] = False
    random = np.random.default_rng(1)
    for _ in range(5):
        way = random.normal(size=fit.uv.shape) * inner[:, None]
        slope = (energy(fit.uv + 1e-6 * way) - energy(fit.uv - 1e-6 * way)) / 2e-6
        bent = (energy(fit.uv + 1e-5 * way) + energy(fit.uv - 1e-5 * way) - 2 * energy(fit.uv)) / 1e-10
        assert abs(slope) < 1e-3 * bent


def test_the_order_of_circles_does_not_matter():
    turned = koebe.fit_circles(PLATE, SPOTS[[2, 0, 1]], [0.1, 0.2, 0.3], loops=FIT.ranks[[3, 1, 2]])
    assert np.allclose(turned.uv, FIT.uv, atol=1e-6)


def test_the_unit_circle_may_come_first():
    again = koebe.fit_circles(PLATE, FIT.centers, FIT.radii, FIT.ranks[1:])
    assert np.array_equal(again.uv, FIT.uv)


def test_the_loop_that_is_left_over_is_the_outer_one():
    ranks = FIT.ranks.tolist()
    inside_out = koebe.fit_circles(PLATE, SPOTS, [0.1, 0.1, 0.1], loops=[ranks[0], *ranks[2:]])
    assert inside_out.flipped == 0 and inside_out.outer_loop == ranks[1]
    assert inside_out.ranks.tolist() == [ranks[1], ranks[0], *ranks[2:]]


def test_pins():
    vertices = [int(FIT.loops[0][3]), int(FIT.loops[1][5])]
    pinned = koebe.fit_circles(
        PLATE, SPOTS, [0.2, 0.3, 0.1], FIT.ranks[1:], pins={-1: (vertices[0], 30.0), 0: (vertices[1], -100.0)}
    )
    assert np.allclose(pinned.uv[vertices[0]], [np.cos(np.pi / 6), 0.5], atol=1e-9)
    angle = np.radians(-100)
    assert np.allclose(pinned.uv[vertices[1]], SPOTS[0] + 0.2 * np.array([np.cos(angle), np.sin(angle)]), atol=1e-9)
    assert pinned.flipped == 0


def test_fits_to_one_template_correspond():
    finer = plate(16, 0.2)
    other = koebe.fit_circles(finer, SPOTS, [0.2, 0.3, 0.1])
    there, back = koebe.transfer(FIT, other), koebe.transfer(other, FIT)
    field = np.column_stack([finer[0], np.ones(len(finer[0]))])
    again = there.carry(back.carry(field))
    assert np.linalg.norm(again[:, :3] - finer[0], axis=1).mean() < 0.01
    assert np.linalg.norm(there.points - finer[0], axis=1).mean() < 0.03


def test_labels_stay_labels_and_come_back():
    other = koebe.fit_circles(plate(16, 0.2), SPOTS, [0.2, 0.3, 0.1])
    there, back = koebe.transfer(FIT, other), koebe.transfer(other, FIT)
    labels = np.where(PLATE[0][:, 0] > 0.5, 7, 3).astype(np.int16)
    carried = there.carry(labels)
    assert carried.dtype == np.int16 and set(carried) == {3, 7}
    assert np.mean(back.carry(carried) == labels) > 0.95
    words = np.array(["left", "right"])[(labels == 7).astype(int)]
    assert set(koebe.transfer(FIT, other, words)) == {"left", "right"}
    with pytest.raises(TypeError):
        there.carry(labels, labels=1)


def test_a_field_comes_back_from_the_template_exactly():
    times = PLATE[0] @ [3.0, -2.0, 0.5]
    assert np.allclose(koebe.transfer(FIT, FIT).carry(times), times, atol=1e-9)


def test_the_least_mu_of_a_flat_ring():
    # Radii r -> exp(g(log r)): the sum is least if exp(2 x) (1 - 1 / g'(x)^2) is constant.
    inner, goal, sectors, rings = 0.2, 0.5, 78, 20
    steps = np.exp(np.linspace(0, np.log(inner), rings + 1))
    angle = 2 * np.pi * (np.arange(sectors)[None] + 0.5 * (np.arange(rings + 1)[:, None] % 2)) / sectors
    points = np.stack([steps[:, None] * np.cos(angle), steps[:, None] * np.sin(angle), 0 * angle], 2).reshape(-1, 3)
    number = np.arange(len(points)).reshape(rings + 1, sectors)
    a, b, c, d = number[:-1], np.roll(number[:-1], -1, 1), number[1:], np.roll(number[1:], -1, 1)
    even = (np.arange(rings) % 2 == 0)[:, None, None]
    first = np.where(even, np.stack([a, c, b], 2), np.stack([a, d, b], 2))
    second = np.where(even, np.stack([b, c, d], 2), np.stack([a, c, d], 2))
    fit = koebe.fit_circles((points, np.concatenate([first, second]).reshape(-1, 3)), [(0, 0)], [goal])
    x = np.linspace(np.log(inner), 0, 20001)
    low, high = -1e6, inner**2
    for _ in range(100):
        middle = 0.5 * (low + high)
        slope = (1 - middle * np.exp(-2 * x)) ** -0.5
        low, high = (middle, high) if np.mean(slope) * -np.log(inner) < -np.log(goal) else (low, middle)
    mu = abs(slope - 1) / (slope + 1)
    assert fit.fit["bending"]["mean"] == pytest.approx((np.exp(2 * x) * mu).sum() / np.exp(2 * x).sum(), rel=0.01)
    way = np.concatenate([[0], np.cumsum((slope[1:] + slope[:-1]) / 2 * np.diff(x))])
    exact = np.exp(np.interp(np.log(np.hypot(*points[:, :2].T)), x, way - way[-1]))
    assert np.allclose(np.hypot(*fit.uv.T), exact, atol=5e-4)


def test_saved_and_loaded(tmp_path):
    FIT.save(tmp_path / "fit.npz")
    again = koebe.load(tmp_path / "fit.npz")
    assert type(again) is koebe.FitResult and again.names == ["a", "b", "c"]
    assert np.array_equal(again.uv, FIT.uv) and np.array_equal(again.mu, FIT.mu) and again.fit == FIT.fit


@pytest.mark.parametrize(
    "centers, radii, words",
    [
        (0.5 * SPOTS, [0.3, 0.3, 0.1], "meet"),
        (SPOTS, [0.6, 0.1, 0.1], "not inside the unit circle"),
        (SPOTS, [0.1, 0.1, 0.0], "radius"),
        (SPOTS[:2], [0.1, 0.1], "2 circles, and the surface has 3 holes"),
        (SPOTS * np.nan, [0.1, 0.1, 0.1], "NaN"),
    ],
)
def test_infeasible_templates(centers, radii, words):
    with pytest.raises(koebe.InputError, match=words):
        koebe.fit_circles(PLATE, centers, radii)


def test_the_surface_may_be_two_arrays_or_one_mesh():
    circles = {"centers": SPOTS, "radii": [0.2, 0.3, 0.1]}
    ways = [
        koebe.fit_circles(*PLATE, SPOTS, [0.2, 0.3, 0.1]),
        koebe.fit_circles(*PLATE, **circles),
        koebe.fit_circles(PLATE, SPOTS, radii=[0.2, 0.3, 0.1]),
        koebe.fit_circles(vertices=PLATE, **circles),
        koebe.fit_circles(*PLATE, SPOTS, [0.2, 0.3, 0.1], FIT.ranks[1:]),
    ]
    assert all(np.array_equal(fit.uv, FIT.uv) for fit in ways)
    with pytest.raises(TypeError, match="needs the centers and the radii"):
        koebe.fit_circles(*PLATE)


@pytest.mark.parametrize("gap", [0.1, 0.01, 1e-3, 1e-5])
def test_hard_templates_have_no_flips_or_are_a_typed_error(gap):
    # Three circles in a row, on a mesh with few vertices between the holes.
    radius = (1.0 - 2 * gap) / 3
    try:
        fit = koebe.fit_circles(plate(2), [[0, 0], [2 * radius + gap, 0], [-2 * radius - gap, 0]], [radius - gap] * 3)
    except koebe.SolverError as error:
        assert "no one-to-one map to the template was found" in str(error)
    else:
        assert fit.flipped == 0 and signed_areas(np.float32(0.5 + 0.5 * fit.uv).astype(float)[fit.surface[1]]).min() > 0


def written(tmp_path, template):
    paths = [tmp_path / name for name in ("in.obj", "template.json", "out.obj", "out.json", "out.svg")]
    paths[0].write_text(obj_text(*PLATE))
    paths[1].write_text(template if isinstance(template, str) else json.dumps(template))
    return paths


def circles(**more):
    return [{"center": s.tolist(), "radius": r, **more} for s, r in zip(SPOTS, (0.2, 0.3, 0.1), strict=True)]


def test_the_command_gives_the_same_map(tmp_path):
    listed = [{**c, "name": n} for c, n in zip(circles(), "abc", strict=True)]
    source, template, out, report, svg = written(tmp_path, {"circles": listed, "outer": {"rotates": True}})
    run = succeeded("fit", source, template, out, "--json", report, "--svg", svg)
    assert "3 circles, |mu|" in run.stdout and "0 flipped" in run.stdout
    made = json.loads(report.read_text())
    assert made["fit"]["mu"] == pytest.approx(FIT.fit["mu"]) and [c.get("name") for c in made["loops"]] == [
        None,
        "a",
        "b",
        "c",
    ]
    uv = np.array([line.split()[1:] for line in out.read_text().splitlines() if line.startswith("vt")], float)
    assert np.allclose(2 * uv - 1, FIT.uv, atol=1e-7) and svg.read_text().startswith("<")


@pytest.mark.parametrize(
    "template, words",
    [
        ("{", "is not JSON"),
        ({}, 'has no "circles"'),
        ({"circles": circles(), "size": 3}, 'unknown entry "size"'),
        ({"circles": circles(color="red")}, 'unknown entry "color"'),
        ({"circles": [{"center": [0, 0]}] * 3}, 'has no "radius"'),
        ({"circles": [{"center": [0, "x"], "radius": 0.1}]}, "is not a number"),
        ({"circles": [*circles()[:2], {**circles()[2], "loop": 1}]}, "loops for some circles only"),
        ({"circles": circles(loop=1)}, "name the same loop"),
        ({"circles": circles(), "outer": {"pin": {"vertex": 0.5, "angle": 0}}}, "is not a whole number"),
        ({"circles": circles(rotates=1)}, "neither true nor false"),
    ],
)
def test_damaged_templates(tmp_path, template, words):
    source, path, out, *_ = written(tmp_path, template)
    run = command("fit", source, path, out)
    assert run.returncode == CANNOT_BE_MAPPED and words in run.stderr and "InputError" in run.stderr
    assert not out.exists()


def test_the_template_is_no_output(tmp_path):
    source, path, out, *_ = written(tmp_path, {"circles": circles()})
    assert command("fit", source, path, out, "--json", path).returncode == USAGE


def test_a_needle_does_not_end_a_fit():
    """A made atrium with a face of height 4e-5 of its edge: the steps of the way were too short to arrive."""
    with np.load("tests/surfaces/atrium_with_a_needle.npz") as mesh:
        surface = mesh["vertices"], mesh["triangles"]
    centers = [[0.3564, 0.4736], [0.5849, -0.1209], [-0.5011, 0.2163], [-0.5194, -0.4417]]
    result = koebe.fit_circles(*surface, centers, [0.047, 0.0164, 0.0337, 0.032], loops=[4, 1, 3, 2])
    assert result.flipped == 0 and result.converged
