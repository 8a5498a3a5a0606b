"""Mirror symmetry: found on the surface, and made exact in the UVs. Without Blender."""

import koebe
import numpy as np
import pytest
from addon_support import named_module
from test_moebius import domains, surface_of

mirror = named_module("mirror")
EVEN_HOLES = ((4, 8, 4, 9), (4, 8, 22, 27), (12, 16, 13, 18), (20, 25, 8, 23))  # rows and columns of 31 × 31 quads


def masked(turn=None, holes=EVEN_HOLES, height=lambda x, y: 0.4 * x * x + 0.3 * np.sin(2 * y), noise=0.0):
    """A square sheet with holes, symmetric in x; turned by a rotation matrix if given."""
    x, y = np.meshgrid(np.linspace(-1, 1, 32), np.linspace(-1, 1, 32))
    vertices = np.stack([x, y, height(x, y)], axis=-1).reshape(-1, 3)
    vertices += noise * np.random.default_rng(3).normal(size=vertices.shape)
    at = np.arange(32 * 32).reshape(32, 32)
    quads = np.stack([at[:-1, :-1], at[:-1, 1:], at[1:, 1:], at[1:, :-1]], axis=-1)
    keep = np.ones((31, 31), dtype=bool)
    for top, bottom, left, right in holes:
        keep[top:bottom, left:right] = False
    used, quads = np.unique(quads[keep], return_inverse=True)
    vertices = vertices[used] if turn is None else vertices[used] @ turn.T
    return surface_of(vertices, quads.reshape(-1, 4))


def mapped(surface, **options):
    """The circle domain of its map."""
    triangles = surface.corner_vertex[surface.triangle_corners].astype(np.int32)
    result = koebe.uniformize(surface.positions, triangles, **options)
    uv = (0.5 + 0.5 * result.uv[surface.corner_vertex]).astype(np.float32)
    (domain,), _ = domains.read_domains(koebe, surface, uv)
    return domain


def turn(seed=4):
    """Some rotation."""
    q, r = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))
    return q * np.sign(np.linalg.det(q))


def image_of(island):
    return koebe.mirror_image(island.vertices, island.triangles, polygon=island.triangle_face)


@pytest.mark.parametrize("rotated", [None, turn()])
@pytest.mark.parametrize("options", [{}, {"balance": "area"}])
def test_a_symmetric_surface_gets_exactly_symmetric_uvs(rotated, options):
    domain = mapped(masked(rotated), **options)
    found = mirror.symmetric(koebe, domain)
    image, uv = image_of(domain.island), found.image.uv
    assert (image[image] == np.arange(len(image))).all()
    assert (uv[:, 0].astype(np.float64) + uv[image, 0] == 1.0).all()  # to the last bit
    assert (uv[:, 1] == uv[image, 1]).all()
    assert len(found.image.flipped) == 0 and found.pairs == np.count_nonzero(image != np.arange(len(image))) // 2
    assert 0.0 < found.moved < 0.01
    plane = uv.astype(np.float64) @ [1, 1j]
    for loop in found.image.loops:
        center, radius = domain.offset + domain.scale * loop.center, domain.scale * loop.radius
        assert np.abs(np.abs(plane[loop.on] - center) - radius).max() < 2e-7


def test_angles_do_not_suffer():
    domain = mapped(masked())
    found = mirror.symmetric(koebe, domain)
    before, after = (
        koebe.distortion(domain.island.vertices, domain.island.triangles, uv.astype(float))["angle_error_deg"]["mean"]
        for uv in (domain.old_uv, found.image.uv)
    )
    assert after <= before + 0.01


def test_up_stays_up():
    surface = masked(np.array([[1.0, 0, 0], [0, 0, -1.0], [0, 1.0, 0]]))  # upright: y is z now
    domain = mapped(surface)
    uv = mirror.symmetric(koebe, domain).image.uv
    height = domain.island.vertices[:, 2]
    assert np.corrcoef(height, uv[:, 1])[0, 1] > 0.9


def test_what_is_done_twice_stays():
    domain = mapped(masked())
    first = mirror.symmetric(koebe, domain).image.uv
    corners = np.empty((len(domain.island.corners), 2), dtype=np.float32)
    corners[domain.island.corners] = first[domain.island.corner_vertex]
    again = mirror.symmetric(koebe, domains.read_domain(koebe, domain.island, corners))
    assert again.moved < 1e-6 and np.abs(again.image.uv - first).max() < 1e-5


@pytest.mark.parametrize("options, text", [
    ({"noise": 0.02}, "the mesh is not symmetric"), ({"holes": EVEN_HOLES[1:]}, "the mesh is not symmetric"),
    ({"height": lambda x, y: 0.4 * x * x + 0.3 * np.sin(2 * x + y)}, "the mesh is not symmetric"),
    ({"holes": (*EVEN_HOLES, (25, 26, 3, 4))}, "the mesh is not symmetric"),  # one face less, all vertices still there
    ({"holes": EVEN_HOLES[1:], "height": lambda x, y: 0.0 * x}, "the mesh is not symmetric"),  # but its own
])  # fmt: skip
def test_what_is_not_symmetric_is_refused(options, text):
    with pytest.raises(domains.DomainError, match=text):
        mirror.symmetric(koebe, mapped(masked(**options)))


def test_a_rim_that_is_not_its_own_image_is_refused():
    surface = masked()
    eye = mapped(surface)
    left = next(k for k, loop in enumerate(eye.loops) if eye.island.vertices[loop.vertices, 0].max() < 0)
    vertex = int(eye.loops[left].vertices[0])
    with pytest.raises(domains.DomainError, match="its rim is not symmetric"):
        mirror.symmetric(koebe, mapped(surface, outer=vertex))


def test_a_flat_sheet_is_not_mirrored_in_its_own_plane():
    domain = mapped(masked(height=lambda x, y: 0.0 * x))
    image = image_of(domain.island)
    assert (image != np.arange(len(image))).mean() > 0.9  # but across x


@pytest.mark.parametrize("off, found", [(0.5e-4, True), (3e-4, False)])
def test_a_vertex_may_be_off_its_image_by_a_ten_thousandth_of_the_diagonal(off, found):
    surface = masked()
    triangles = surface.corner_vertex[surface.triangle_corners].astype(np.int32)
    vertices = surface.positions.astype(float)
    at = int(np.argmin(np.linalg.norm(vertices[:, :2] - [0.8, 0.8], axis=1)))
    vertices[at, 2] += off * np.linalg.norm(np.ptp(vertices, axis=0))
    image = koebe.mirror_image(vertices, triangles, polygon=surface.triangle_face)
    assert (image is not None) == found
