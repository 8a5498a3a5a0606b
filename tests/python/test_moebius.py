"""Möbius maps of circle domains in UV layers: laws of the maps, and what they leave of the UVs. Without Blender."""

import koebe
import numpy as np
import pytest
from addon_support import named_module

POINT, OTHER = 0.3 - 0.5j, -0.2 + 0.6j
RIM = np.exp(2j * np.pi * np.arange(64) / 64)
moebius, domains, surfaces = (named_module(name) for name in ("moebius", "circle_domain", "surface"))
MAPS_TO_TRY = [
    moebius.to_middle(POINT), moebius.dragged(POINT, OTHER), moebius.rotation(0.7), moebius.inside_out(POINT, 0.2),
    moebius.dragged(POINT, OTHER).after(moebius.inside_out(OTHER, 0.1)),
]  # fmt: skip


@pytest.mark.parametrize("moved", MAPS_TO_TRY)
def test_a_map_and_its_inverse_are_the_identity(moved):
    z = np.random.default_rng(1).normal(size=(50, 2)) @ [1, 1j]
    assert np.abs(moved.inverse.apply(moved.apply(z)) - z).max() < 1e-12
    assert np.abs(moved.inverse.after(moved).apply(z) - z).max() < 1e-12


@pytest.mark.parametrize("moved", MAPS_TO_TRY)
def test_the_image_of_a_circle_is_the_circle_that_is_told(moved):
    for center, radius in ((0.1 + 0.2j, 0.15), (0.0, 1.0), (POINT, 0.01), (3.0, 0.5)):
        new_center, new_radius = moved.circle(center, radius)
        assert np.abs(np.abs(moved.apply(center + radius * RIM) - new_center) - new_radius).max() < 1e-12


def test_maps_of_the_disk_do_what_they_say():
    for moved in MAPS_TO_TRY[:3]:
        assert np.abs(np.abs(moved.apply(RIM)) - 1.0).max() < 1e-13
    assert moebius.to_middle(POINT)(POINT) == 0
    moved, step = moebius.dragged(POINT, OTHER), 1e-6
    assert abs(moved(POINT) - OTHER) < 1e-15
    turn = (moved(POINT + step) - moved(POINT - step)) / (2 * step)
    assert turn.real > 0 and abs(turn.imag) < 1e-8  # what is dragged does not turn
    assert moebius.dragged(POINT, POINT).is_identity


def test_centre_and_turn_make_the_map_again():
    moved = moebius.rotation(-2.1).after(moebius.dragged(POINT, OTHER))
    center, angle = moebius.center_and_turn(moved)
    z = 0.9 * RIM
    again = moebius.rotation(angle).after(moebius.to_middle(center))
    assert np.abs(again.apply(z) - moved.apply(z)).max() < 1e-14


def test_a_hole_comes_to_the_middle_with_its_own_centre():
    for center, radius in ((0.5 + 0.3j, 0.2), (0.9j, 0.05), (0.1, 0.6), (0.0, 0.3)):
        moved = moebius.to_middle(moebius.own_center(center, radius))
        assert abs(moved.circle(center, radius)[0]) < 1e-14


def test_the_balance_point_balances():
    random = np.random.default_rng(2)
    z = moebius.to_middle(-0.97j).apply(0.9 * np.sqrt(random.random(2000)) * np.exp(2j * np.pi * random.random(2000)))
    weights = random.random(2000)
    moved = moebius.to_middle(moebius.balance_point(z, weights))
    assert abs((weights * moved.apply(z)).sum() / weights.sum()) < 1e-8


# ---------------------------------------------------------------- domains


def ring_domain(count=6, size=40):
    """A surface in the plane, a square grid less some blocks, mapped by the native package; and its corners' UVs."""
    x, y = np.meshgrid(np.linspace(-1, 1, size), np.linspace(-1, 1, size))
    height = 0.3 * np.sin(2 * x) + 0.2 * y * y
    vertices = np.stack([x, y, height], axis=-1).reshape(-1, 3)
    at = np.arange(size * size).reshape(size, size)
    quads = np.stack([at[:-1, :-1], at[:-1, 1:], at[1:, 1:], at[1:, :-1]], axis=-1)
    keep = np.ones((size - 1, size - 1), dtype=bool)
    for k in range(count):
        i, j = 4 + 12 * (k // 3), 4 + 11 * (k % 3)
        keep[i : i + 4, j : j + 3 + k % 2] = False
    quads = quads[keep]
    used, quads = np.unique(quads, return_inverse=True)
    vertices, quads = vertices[used], quads.reshape(-1, 4)
    surface = surface_of(vertices, quads)
    triangles = surface.corner_vertex[surface.triangle_corners].astype(np.int32)
    result = koebe.uniformize(vertices, triangles)
    uv = (0.5 + 0.5 * result.uv[surface.corner_vertex]).astype(np.float32)
    return surface, uv, result


def surface_of(vertices, quads):
    """The `Surface` of a mesh of quads, or of faces of another size."""
    count, size = quads.shape
    corner = quads.ravel().astype(np.int32)
    ends = np.sort(np.stack([corner, np.roll(quads, -1, axis=1).ravel()], axis=1), axis=1)
    edges, corner_edge = np.unique(ends, axis=0, return_inverse=True)
    start = size * np.arange(count, dtype=np.int32)
    fan = np.array([[0, k + 1, k + 2] for k in range(size - 2)])
    triangles = (start[:, None, None] + fan).reshape(-1, 3)
    return surfaces.Surface(
        positions=vertices, corner_vertex=corner, corner_edge=corner_edge.reshape(-1).astype(np.int32),
        face_start=start, face_size=np.full(count, size, dtype=np.int32), seam=np.zeros(len(edges), dtype=bool),
        selected=np.ones(count, dtype=bool), triangle_corners=triangles.astype(np.int32),
        triangle_face=np.repeat(np.arange(count, dtype=np.int32), size - 2),
    )  # fmt: skip


@pytest.fixture(scope="module")
def mapped():
    surface, uv, result = ring_domain()
    (domain,), errors = domains.read_domains(koebe, surface, uv)
    assert not errors
    return domain, result


def distances(image):
    """How far each loop's vertices are from the circle that the image tells, in UV units."""
    domain, uv = image.domain, image.uv.astype(np.float64) @ [1, 1j]
    return [
        np.abs(np.abs(uv[loop.on] - domain.offset - domain.scale * loop.center) - domain.scale * loop.radius).max()
        for loop in image.loops
    ]


def test_a_domain_is_read_from_its_uvs(mapped):
    domain, result = mapped
    assert (domain.offset, domain.scale) == (0.5 + 0.5j, 0.5)
    assert len(domain.loops) == 7
    told = {int(loop.min()): (complex(*c), r) for loop, c, r in zip(result.loops, result.centers, result.radii)}
    for loop in domain.loops:
        center, radius = told[int(loop.vertices.min())]
        assert abs(loop.center - center) < 1e-6 and abs(loop.radius - radius) < 1e-6


def test_the_identity_leaves_every_bit(mapped):
    domain, _ = mapped
    image = domain.image(domain.moved(0, 0.0, 0.0))
    assert np.array_equal(image.uv.view(np.int32), domain.old_uv.view(np.int32))


def test_holes_keep_their_numbers(mapped):
    domain, _ = mapped
    keys = [domain.key(loop) for loop in domain.loops]
    order = [keys[0], *reversed(keys[1:])]
    domain = domain.numbered(order)
    assert [domain.key(loop) for loop in domain.loops] == order
    image = domain.image(domain.moved(5, 0.0, 0.0))
    assert [domain.key(loop) for loop in image.loops] == [order[5], *order[1:5], order[0], order[6]]


@pytest.mark.parametrize("rim", range(7))
@pytest.mark.parametrize("center, angle", [(0.0, 0.0), (0.3 - 0.4j, 1.0), (-0.6j, -2.0)])
def test_circles_stay_circles_and_nothing_is_turned_over(mapped, rim, center, angle):
    domain, _ = mapped
    image = domain.image(domain.moved(rim, center, angle))
    assert max(distances(image)) < 2e-7
    assert len(image.flipped) == 0 and image.too_small == 0
    assert image.loops[0].radius == pytest.approx(1.0, abs=1e-12)
    assert set(image.loops[0].vertices) == set(domain.loops[rim].vertices)
    assert sum(len(loop.vertices) - len(loop.on) for loop in image.loops) == (2 if rim else 0)  # corners of the square
    assert np.abs(image.uv - 0.5).max() <= 0.5 + 1e-7


def test_a_change_of_the_rim_is_undone_by_the_way_back(mapped):
    domain, _ = mapped
    there = domain.rim_change(3)
    assert np.abs(there.inverse.after(there).apply(domain.points) - domain.points).max() < 1e-11


def test_a_new_rim_is_balanced_and_upright(mapped):
    domain, _ = mapped
    image = domain.image(domain.moved(2, 0.0, 0.0))
    z = (image.uv.astype(np.float64) @ [1, 1j] - domain.offset) / domain.scale
    weights = domain.weights()
    assert abs((weights * z).sum() / weights.sum()) < 1e-5
    turn = named_module("upright").upright_turn(domain.island, np.stack([z.real, z.imag], axis=1))
    assert abs(turn - 1.0) < 1e-2  # 32 bits leave that much of the thin triangles at the square's corners


def test_a_hole_is_brought_to_the_middle(mapped):
    domain, _ = mapped
    for rim in (0, 2):
        image = domain.image(domain.moved(rim, 0.0, 0.5, hole=4))
        assert set(image.loops[4].vertices) == set(domain.loops[4].vertices)
        assert abs(image.loops[4].center) < 1e-12


@pytest.mark.parametrize("rim", [1, 4])
def test_what_was_moved_is_read_again_as_it_was_told(mapped, rim):
    """Corners of the square are off their circle by then."""
    domain, _ = mapped
    image = domain.image(domain.moved(rim, 0.2j, 0.0))
    corners = image.uv[domain.island.corner_vertex]
    again = domains.read_domain(koebe, domain.island, corners).numbered([domain.key(loop) for loop in image.loops])
    for told, read in zip(image.loops, again.loops, strict=True):
        assert abs(told.center - read.center) < 1e-6 and abs(told.radius - read.radius) < 1e-6
        assert set(told.on) <= set(read.on)
    onward = again.image(again.moved(0, -0.1j, 0.0))
    assert max(distances(onward)) < 1e-5 and len(onward.flipped) == 0
    back = again.image(again.moved(rim, 0.0, 0.0))
    assert max(distances(back)) < 1e-5 and len(back.flipped) == 0


def test_flips_are_counted_as_they_are_in_the_uvs(mapped):
    domain, _ = mapped
    image = domain.image(domain.moved(2, 0.999j, 0.0))  # coarse triangles do not follow so far
    a, b, c = (image.uv.astype(np.float64) @ [1, 1j])[domain.island.triangles].T
    flipped = np.flatnonzero(((b - a).conj() * (c - a)).imag <= 0.0)
    assert len(flipped) > 0 and np.array_equal(image.flipped, flipped)


def test_what_becomes_too_small_is_counted(mapped):
    domain, _ = mapped
    image = domain.image(domain.moved(0, 1.0 - 1e-7, 0.0))
    assert image.too_small > 0


def test_errors_are_typed_and_say_what_is_wrong(mapped):
    domain, _ = mapped
    with pytest.raises(domains.DomainError, match="there is no loop 9: the island has 7"):
        domain.moved(9, 0.0, 0.0)
    with pytest.raises(domains.DomainError, match="inside the disk"):
        domain.moved(0, 1.0, 0.0)
    with pytest.raises(domains.DomainError, match="there is no hole 7: the island has 6"):
        domain.moved(0, 0.0, 0.0, hole=7)
    with pytest.raises(domains.DomainError, match="becomes the rim"):
        domain.moved(3, 0.0, 0.0, hole=3)
    assert issubclass(domains.DomainError, named_module("errors").KnownError)


def test_uvs_that_are_no_circle_domain_are_refused():
    surface, uv, _ = ring_domain()
    squeezed = uv * np.array([1.0, 0.9], dtype=np.float32)
    for wrong, text in ((squeezed, "not a disk with round holes"), (0 * uv, "no UVs"), (np.nan * uv, "not finite")):
        found, errors = domains.read_domains(koebe, surface, wrong)
        assert not found and text in str(errors[0])
