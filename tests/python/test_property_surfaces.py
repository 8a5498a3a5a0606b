"""Random surfaces of genus 0 with holes, damaged arrays, circle domains (Hypothesis), and what the functions that make
no map promise for them. KOEBE_EXAMPLES asks for more examples of each.
"""

import os
from collections import defaultdict

import koebe
import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

settings.register_profile(
    "koebe",
    derandomize=True,
    database=None,
    deadline=None,
    max_examples=int(os.environ.get("KOEBE_EXAMPLES", "25")),
    suppress_health_check=list(HealthCheck),
)
settings.load_profile("koebe")


# ---------------------------------------------------------------- surfaces


def one_surface(vertices, faces):
    """The largest part that is connected over edges, a vertex where parts only touch made one for each of them."""
    parent = list(range(4 * len(faces)))  # three corners a face, then the faces

    def root(i):
        while parent[i] != i:
            parent[i] = parent[parent[i]]
            i = parent[i]
        return i

    edges = defaultdict(list)
    for f, face in enumerate(faces.tolist()):
        for k in range(3):
            edges[frozenset((face[k], face[k - 2]))].append((f, k))
    for sides in edges.values():
        if len(sides) == 2:
            (f, k), (g, j) = sides
            for a, b in ((3 * f + k, 3 * g + (j + 1) % 3), (3 * f + (k + 1) % 3, 3 * g + j)):
                parent[root(a)] = root(b)
            parent[root(3 * len(faces) + f)] = root(3 * len(faces) + g)
    part = np.array([root(3 * len(faces) + f) for f in range(len(faces))])
    corner = np.array([root(i) for i in range(3 * len(faces))]).reshape(-1, 3)
    names, sizes = np.unique(part, return_counts=True)
    chosen = part == names[sizes.argmax()]
    names, first, faces_of_part = np.unique(corner[chosen], return_index=True, return_inverse=True)
    origin = faces[chosen].ravel()[first]
    return vertices[origin], faces_of_part.reshape(-1, 3).astype(np.int32)


def grid_faces(rows, columns, cells):
    """Two triangles for each cell (k, 2) of a grid of rows x columns vertices."""
    corner = cells[:, 0] * columns + cells[:, 1]
    a, b, c, d = corner, corner + columns, corner + columns + 1, corner + 1
    return np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])


def grid(random, size, roughness):
    """Cells of a grid, some taken out; uneven steps and heights."""
    rows, columns = size, int(random.integers(2, size + 2))
    kept = random.random((rows - 1, columns - 1)) > random.choice([0.0, 0.1, 0.3])
    if not kept.any():
        kept[0, 0] = True
    steps = [np.cumsum(10.0 ** -random.uniform(0, 2 * roughness, n)) for n in (rows, columns)]
    x, y = (a.ravel() for a in np.meshgrid(*steps, indexing="ij"))
    heights = roughness * random.normal(size=x.size) * min(np.ptp(x) + 0.1, np.ptp(y) + 0.1) / size
    return np.stack([x, y, heights], axis=1), grid_faces(rows, columns, np.argwhere(kept))


def comb(random, size, roughness):
    """A band with teeth of random lengths on one side."""
    lengths = random.integers(1, size, size=2 * size)
    lengths[1::2] = 1
    cells = np.array([(i, j) for i, length in enumerate(lengths) for j in range(length)])
    i, j = (a.ravel() for a in np.meshgrid(np.arange(2 * size + 1), np.arange(size), indexing="ij"))
    vertices = np.stack([i, j * (0.2 + roughness), 0.3 * roughness * random.normal(size=i.size)], axis=1)
    return vertices, grid_faces(2 * size + 1, size, cells)


def ring(random, size, roughness, closed=False):
    """Rings of vertices around an axis, their radii a random walk; closed by a tip at one end."""
    sectors, rings = int(random.integers(3, size + 3)), int(random.integers(2, size + 2))
    angles = 2 * np.pi * (np.arange(sectors) + 0.3 * roughness * random.random(sectors)) / sectors
    radii = np.exp(np.cumsum(roughness * random.normal(size=rings) - 0.3 * roughness))
    heights = np.cumsum(random.exponential(size=rings))
    z = (radii[:, None] * np.exp(1j * angles)).ravel()
    vertices = np.stack([z.real, z.imag, np.repeat(heights, sectors)], axis=1)
    i, j = (a.ravel() for a in np.meshgrid(np.arange(rings - 1), np.arange(sectors), indexing="ij"))
    a, b = i * sectors + j, i * sectors + (j + 1) % sectors
    faces = np.concatenate([np.stack([a, b, b + sectors], axis=1), np.stack([a, b + sectors, a + sectors], axis=1)])
    if closed:
        last = (rings - 1) * sectors + np.arange(sectors)
        tip = np.full(sectors, len(vertices))
        vertices = np.vstack([vertices, [0.0, 0.0, heights[-1] + 1.0]])
        faces = np.vstack([faces, np.stack([last, np.roll(last, -1), tip], axis=1)])
    return vertices, faces


def cone(random, size, roughness):
    return ring(random, size, roughness, closed=True)


def perforated(vertices, faces, random, most):
    """Without some faces, one at least."""
    count = int(random.integers(1, max(2, most)))
    return vertices, np.delete(faces, random.choice(len(faces), min(count, len(faces) - 1), replace=False), axis=0)


def perforated_ring(random, size, roughness):
    return perforated(*ring(random, size, roughness), random, size)


def planar_delaunay(random, size, roughness):
    """Random points of a square, triangulated [Bowyer 1981; Watson 1981], with faces taken out and heights."""
    points = np.vstack([[[-9.0, -9.0], [9.0, -9.0], [0.0, 18.0]], random.random((4 + size * size // 2, 2))])
    faces = np.array([[0, 1, 2]])
    for p in range(3, len(points)):
        a, b, c = (points[faces[:, k]] - points[p] for k in range(3))
        square = [(q * q).sum(axis=1) for q in (a, b, c)]
        inside = (
            square[0] * (b[:, 0] * c[:, 1] - c[:, 0] * b[:, 1])
            - square[1] * (a[:, 0] * c[:, 1] - c[:, 0] * a[:, 1])
            + square[2] * (a[:, 0] * b[:, 1] - b[:, 0] * a[:, 1])
        ) > 0
        edges = {(int(f[k]), int(f[k - 2])) for f in faces[inside] for k in range(3)}
        rim = [(u, v, p) for u, v in edges if (v, u) not in edges]
        faces = np.vstack([faces[~inside], np.array(rim).reshape(-1, 3)])
    faces = faces[(faces > 2).all(axis=1)] - 3
    heights = roughness * random.normal(size=len(points) - 3) / size
    return perforated(np.column_stack([points[3:], heights]), faces, random, size)


def fans(random, size, roughness):
    """Triangles glued to random boundary edges, or into notches: a disk in no position at all."""
    faces, rim = [[0, 1, 2]], [0, 1, 2]
    edges = {frozenset(e) for e in ((0, 1), (1, 2), (2, 0))}
    for _ in range(size * size):
        i = int(random.integers(len(rim)))
        a, b, c = rim[i], rim[(i + 1) % len(rim)], rim[(i + 2) % len(rim)]
        if len(rim) > 3 and random.random() < 0.4 and frozenset((a, c)) not in edges:
            faces.append([c, b, a])
            rim.remove(b)
            edges.add(frozenset((a, c)))
        else:
            new = max(map(max, faces)) + 1
            faces.append([b, a, new])
            rim.insert(i + 1, new)
            edges |= {frozenset((a, new)), frozenset((b, new))}
    return random.normal(size=(max(map(max, faces)) + 1, 3)) ** (1 + 2 * int(roughness > 0.5)), np.array(faces)


def stacked_sphere(random, size, roughness):
    """A tetrahedron with vertices put into random faces again and again, and faces taken out."""
    faces = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]
    vertices = [*np.array([[1.0, 1, 1], [-1, -1, 1], [-1, 1, -1], [1, -1, -1]])]
    for _ in range(size * size // 2):
        a, b, c = faces.pop(int(random.integers(len(faces))))
        middle = (vertices[a] + vertices[b] + vertices[c]) / 3
        vertices.append(middle * (1 + roughness * random.random()))
        faces += [[a, b, len(vertices) - 1], [b, c, len(vertices) - 1], [c, a, len(vertices) - 1]]
    return perforated(np.array(vertices), np.array(faces), random, size)


KINDS = {
    make.__name__: make
    for make in (grid, comb, ring, cone, perforated_ring, planar_delaunay, fans, stacked_sphere)
}


def randoms():
    """Generators of random numbers that Hypothesis can name."""
    return st.integers(0, 2**32 - 1).map(np.random.default_rng)


@st.composite
def surfaces(draw, kind, most=9):
    """Vertices and faces of a surface of genus 0 with at least one boundary loop."""
    size, roughness = draw(st.integers(2, most)), draw(st.sampled_from([0.0, 0.2, 0.5, 1.0]))
    return one_surface(*KINDS[kind](draw(randoms()), size, roughness))


any_surface = st.sampled_from(sorted(KINDS)).flatmap(surfaces)


@st.composite
def damaged(draw):
    """Arrays that a surface became by some accidents; some still are one."""
    vertices, faces = draw(any_surface)
    vertices, faces, random = vertices.copy(), faces.astype(np.int64), draw(randoms())
    for _ in range(draw(st.integers(1, 3))):
        f, v = int(random.integers(len(faces))), int(random.integers(len(vertices)))
        accident = draw(st.integers(0, 11))
        if accident == 0:
            faces[f, random.integers(3)] = random.choice([-1, len(vertices), 2**31, -(2**63), 2**63 - 1])
        elif accident == 1:
            faces[f] = faces[f, ::-1]
        elif accident == 2:
            faces = np.vstack([faces, faces[f]])
        elif accident == 3 and len(faces) > 1:
            faces = np.delete(faces, f, axis=0)
        elif accident == 4:
            faces[faces == v] = random.integers(len(vertices))
        elif accident == 5:
            vertices[v, random.integers(3)] = random.choice([np.nan, np.inf, -np.inf])
        elif accident == 6:
            vertices[v] = vertices[random.integers(len(vertices))]
        elif accident == 7:
            vertices[v] *= random.choice([1e-300, 1e300, 1e12, 0.0])
        elif accident == 8:
            faces[f, 0] = faces[f, 1]
        elif accident == 9:
            faces = np.vstack([faces, faces + (len(vertices) if random.random() < 0.5 else 0)])
            vertices = np.vstack([vertices, vertices])
        elif accident == 10:
            vertices *= random.choice([0.0, 1e-310, 1e-150, 1e150, 1e307])
        else:
            vertices[:, random.integers(3)] = 0.0
    return vertices, faces


# ---------------------------------------------------------------- loops and fillings


@pytest.mark.parametrize("kind", KINDS)
def test_the_generated_surfaces_have_genus_0_and_a_boundary(kind):
    @given(surfaces(kind))
    def check(surface):
        vertices, faces = surface
        edges = {frozenset(e) for f in faces.tolist() for e in zip(f, f[1:] + f[:1], strict=True)}
        loops = koebe.boundary_loops(faces, vertex_count=len(vertices))
        assert len(vertices) - len(edges) + len(faces) == 2 - len(loops) and len(loops) >= 1
        directed = {e for f in faces.tolist() for e in zip(f, f[1:] + f[:1], strict=True)}
        rim = {e for e in directed if e[::-1] not in directed}
        found = {e for loop in loops for e in zip(loop.tolist(), np.roll(loop, -1).tolist(), strict=True)}
        assert found == rim and sum(map(len, loops)) == len(rim)
        assert [loop[0] for loop in loops] == sorted(loop.min() for loop in loops)

    check()


@given(any_surface)
def test_filling_all_loops_closes_a_surface_and_keeps_what_was_there(surface):
    vertices, faces = surface
    before = vertices.copy(), faces.copy()
    loops = koebe.boundary_loops(faces)
    filled, all_faces, label = koebe.fill_holes(vertices, faces)
    assert np.array_equal(vertices, before[0]) and np.array_equal(faces, before[1])
    assert np.isfinite(filled).all() and np.array_equal(filled[: len(vertices)], vertices)
    assert np.array_equal(all_faces[: len(faces)], faces)
    assert np.array_equal(np.unique(label), np.arange(-1, len(loops)))
    assert np.array_equal(np.bincount(label + 1)[1:], [len(loop) for loop in loops])
    assert koebe.boundary_loops(all_faces) == []


@given(any_surface)
def test_a_faired_patch_is_finite_and_keeps_what_was_there(surface):
    vertices, faces = surface
    loops = koebe.boundary_loops(faces)
    rank = min(range(len(loops)), key=lambda k: len(loops[k]))
    try:
        filled, all_faces, label = koebe.fill_holes(vertices, faces, loops=[rank], fair=True)
    except (koebe.InputError, koebe.SolverError) as error:
        assert str(error)
        return
    assert np.isfinite(filled).all() and np.array_equal(filled[: len(vertices)], vertices)
    assert np.array_equal(all_faces[: len(faces)], faces) and set(label) == {-1, rank}
    assert len(koebe.boundary_loops(all_faces)) == len(loops) - 1


# ---------------------------------------------------------------- maps with given values


@given(any_surface, randoms(), st.booleans())
def test_a_harmonic_map_keeps_its_values_and_within_them_with_equal_triangles(surface, random, uniform):
    vertices, faces = surface
    fixed = random.permutation(len(vertices))[: int(random.integers(1, len(vertices) + 1))]
    values = random.normal(size=(len(fixed), 2))
    try:
        points = koebe.harmonic_map(vertices, faces, fixed, values, uniform=uniform)
    except koebe.SolverError:
        assert not uniform
        return
    assert points.shape == (len(vertices), 2) and np.isfinite(points).all()
    assert np.array_equal(points[fixed], values)
    if uniform:
        slack = 1e-9 * np.ptp(values)
        assert (points >= values.min(axis=0) - slack).all() and (points <= values.max(axis=0) + slack).all()


@given(any_surface, randoms())
def test_distortion_counts_flips_as_they_are_stored(surface, random):
    vertices, faces = surface
    uv = random.normal(size=(len(vertices), 2)) * 10.0 ** random.integers(-8, 1)
    report = koebe.distortion(vertices, faces, uv)
    a, b, c = (((1 + uv) / 2).astype(np.float32).astype(np.float64)[faces[:, k]] for k in range(3))
    area = (b - a)[:, 0] * (c - a)[:, 1] - (c - a)[:, 0] * (b - a)[:, 1]
    longest = np.max([np.hypot(*(p - q).T) for p, q in ((a, b), (b, c), (c, a))], axis=0)
    assert report["flipped"] == (area <= 0).sum()
    assert report["below_resolution"] == ((area <= 0) & (longest < 1e-6)).sum()
    assert 0 <= report["angle_error_deg"]["mean"] <= report["angle_error_deg"]["max"] <= 360
    assert report["beltrami"]["mean"] >= 0 and report["area_distortion"]["log_sd"] >= 0


# ---------------------------------------------------------------- damaged arrays


FUNCTIONS = {
    "boundary_loops": lambda v, f: koebe.boundary_loops(f, vertex_count=len(v)),
    "fill_holes": koebe.fill_holes,
    "fill_holes, fair": lambda v, f: koebe.fill_holes(v, f, fair=True),
    "disk_map": koebe.disk_map,
    "annulus_map": koebe.annulus_map,
    "annulus_map, yamabe": lambda v, f: koebe.annulus_map(v, f, backend="yamabe"),
    "harmonic_map": lambda v, f: koebe.harmonic_map(v, f, [0, 1], np.eye(2)),
    "harmonic_map, uniform": lambda v, f: koebe.harmonic_map(v, f, [0, 1], np.eye(2), uniform=True),
    "distortion": lambda v, f: koebe.distortion(v, f, np.clip(np.nan_to_num(v[:, :2]), -1, 1)),
}


@pytest.mark.parametrize("name", FUNCTIONS)
def test_damaged_arrays_give_finite_numbers_or_a_typed_error_and_stay_as_they_are(name):
    @given(damaged())
    def check(arrays):
        vertices, faces = (array.copy() for array in arrays)
        try:
            outcome = FUNCTIONS[name](vertices, faces)
        except koebe.KoebeError as error:
            assert str(error) and "internal" not in str(error)
        else:
            for array in outcome if isinstance(outcome, tuple) else [outcome]:
                if isinstance(array, (np.ndarray, float)):
                    assert np.isfinite(array).all()
        assert np.array_equal(vertices, arrays[0], equal_nan=True) and np.array_equal(faces, arrays[1])

    check()


# ---------------------------------------------------------------- circle domains


class Domain:
    """Circles as a result has them."""

    def __init__(self, centers, radii):
        self.centers = np.column_stack([np.real(centers), np.imag(centers)])
        self.radii = np.array(radii)


@st.composite
def circles(draw):
    """Centres and radii of disjoint circles in the unit disk, which comes first."""
    random = draw(randoms())
    centers, radii = [0j], [1.0]
    for _ in range(draw(st.integers(0, 7))):
        z = 0.95 * np.sqrt(random.random()) * np.exp(2j * np.pi * random.random())
        room = min([1 - abs(z)] + [abs(z - c) - r for c, r in zip(centers[1:], radii[1:], strict=True)])
        if room > 0.01:
            centers.append(z)
            radii.append(room * random.uniform(0.1, 0.9))
    return np.array(centers), np.array(radii), random


def moved(centers, radii, a, turn):
    """The circles under z -> turn (z - a) / (1 - conj(a) z), by the diameters through a's line."""
    ends = []
    for c, r in zip(centers, radii, strict=True):
        # The image's diameter lies on the line through the images of the points nearest to and farthest from 1/conj(a).
        pole = 1 / np.conj(a) if a != 0 else None
        way = 1 if pole is None else (c - pole) / abs(c - pole)
        ends.append([turn * (z - a) / (1 - np.conj(a) * z) for z in (c - r * way, c + r * way)])
    ends = np.array(ends)
    return (ends[:, 0] + ends[:, 1]) / 2, abs(ends[:, 0] - ends[:, 1]) / 2


@given(circles(), st.sampled_from([0.0, 0.1, 0.4, 0.7]), st.floats(0, 6.3), st.floats(0, 6.3))
def test_automorphisms_of_the_disk_and_new_numbers_change_no_shape(domain, distance, direction, turn):
    centers, radii, random = domain
    there, sizes = moved(centers, radii, distance * np.exp(1j * direction), np.exp(1j * turn))
    there[0], sizes[0] = 0.0, 1.0
    order = np.concatenate([[0], 1 + random.permutation(len(radii) - 1)])
    first, second = Domain(centers, radii), Domain(there[order], sizes[order])
    module = koebe.conformal_module(first)
    assert len(module) == len(koebe.module_names(len(radii))) and np.isfinite(module).all()
    back = np.argsort(order)
    assert np.allclose(koebe.conformal_module(second, order=back), module, atol=1e-9)
    assert koebe.module_distance(first, second) < 1e-8
    alignment = koebe.align_domains(first, second)
    assert alignment.residual < 1e-7
    found = alignment(second.centers[1:])
    assert np.isfinite(found).all() and (np.hypot(*found.T) <= 1).all()
