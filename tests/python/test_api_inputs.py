"""What the functions of the package take: an array that is no mesh, an option out of range is a typed error."""

from fractions import Fraction

import koebe
import numpy as np
import pytest
from cli_support import obj_text
from test_package import FACES, VERTICES

COUNT = len(VERTICES)
RIMS = koebe.boundary_loops(FACES)
DISK = koebe.fill_holes(VERTICES, FACES, loops=[0])[:2]
UV = VERTICES[:, :2] / 2


class Domain:
    """The unit circle and two holes."""

    def __init__(self, centers=((0.0, 0.0), (0.5, 0.0), (-0.4, 0.1)), radii=(1.0, 0.2, 0.3)):
        self.centers, self.radii = centers, radii


TAKE_A_SURFACE = {
    "uniformize": koebe.uniformize,
    "boundary_loops": lambda v, f: koebe.boundary_loops(f, vertex_count=COUNT),
    "disk_map": koebe.disk_map,
    "annulus_map": koebe.annulus_map,
    "annulus_map, yamabe": lambda v, f: koebe.annulus_map(v, f, backend="yamabe"),
    "fill_holes": koebe.fill_holes,
    "fill_holes, fair": lambda v, f: koebe.fill_holes(v, f, fair=True),
    "harmonic_map": lambda v, f: koebe.harmonic_map(v, f, [0, 1, 2], np.eye(3, 2)),
    "distortion": lambda v, f: koebe.distortion(v, f, UV),
}


def with_entry(array, place, value):
    array = array.copy()
    array[place] = value
    return array


BAD_FACES = {
    "an index beyond the vertices": with_entry(FACES, (7, 1), COUNT),
    "an index far beyond": with_entry(FACES, (7, 1), 2**31 - 1),
    "a negative index": with_entry(FACES, (7, 1), -1),
    "the most negative index": with_entry(FACES, (7, 1), -(2**31)),
    "beyond 32 bits": with_entry(FACES.astype(np.int64), (7, 1), 2**32 + 1),
    "below 32 bits": with_entry(FACES.astype(np.int64), (7, 1), -(2**32) + 1),
    "a vertex twice": with_entry(FACES, 7, [3, 3, 4]),
    "a vertex three times": with_entry(FACES, 7, 3),
    "floats": FACES.astype(float),
    "bools": FACES.astype(bool),
    "beyond 32 bits, unsigned": with_entry(FACES.astype(np.uint64), (7, 1), 2**32 + 1),
    "beyond 63 bits": with_entry(FACES.astype(np.uint64), (7, 1), 2**64 - 1),
    "beyond the vertices, unsigned": with_entry(FACES.astype(np.uint32), (7, 1), 2**32 - 1),
    "negative, of 16 bits": with_entry(FACES.astype(np.int16), (7, 1), -1),
    "objects": FACES.astype(object),
    "complex": FACES.astype(complex),
    "texts": FACES.astype(str),
    "empty": FACES[:0],
    "flat": FACES.ravel(),
    "transposed": FACES.T,
    "quadrilaterals": np.hstack([FACES, FACES[:, :1]]),
    "stacked": FACES[None],
    "ragged": [[0, 1, 2], [1, 2]],
    "too large for an array": [[0, 1, 2**70]],
    "None": None,
    "a number": 3,
    "a text": "faces",
    "masked": np.ma.masked_array(FACES, FACES == 5),
}
BAD_VERTICES = {
    "NaN": with_entry(VERTICES, (5, 2), np.nan),
    "infinite": with_entry(VERTICES, (5, 0), np.inf),
    "minus infinity of 32 bits": with_entry(VERTICES.astype(np.float32), (5, 1), -np.inf),
    "whole numbers that no float can be": with_entry(VERTICES.astype(np.int64), (5, 1), 2**53 + 1),
    "the most negative whole number": with_entry(VERTICES.astype(np.int64), (5, 1), -(2**63)),
    "unsigned ones": with_entry(VERTICES.astype(np.uint64), (5, 1), 2**64 - 1),
    "bools": VERTICES.astype(bool),
    "more than 64 bits, too large": np.full(VERTICES.shape, np.finfo(np.longdouble).max),
    "complex": VERTICES.astype(complex),
    "objects": VERTICES.astype(object),
    "texts": VERTICES.astype(str),
    "empty": VERTICES[:0],
    "two columns": VERTICES[:, :2],
    "four columns": np.hstack([VERTICES, VERTICES[:, :1]]),
    "flat": VERTICES.ravel(),
    "a number": 1.0,
    "None": None,
    "ragged": [[0.0, 0.0, 0.0], [1.0]],
    "masked": np.ma.masked_array(VERTICES, VERTICES > 0.9),
}


@pytest.mark.parametrize("name", TAKE_A_SURFACE)
def test_faces_that_are_none_are_refused_by_every_function(name):
    for what, faces in BAD_FACES.items():
        with pytest.raises((koebe.InputError, FileNotFoundError)):  # a text may be a file's path
            TAKE_A_SURFACE[name](VERTICES, faces)
            pytest.fail(f"{name} took {what}")


@pytest.mark.parametrize("name", set(TAKE_A_SURFACE) - {"boundary_loops"})
def test_vertices_that_are_none_are_refused_by_every_function(name):
    for what, vertices in BAD_VERTICES.items():
        with pytest.raises(koebe.InputError):
            TAKE_A_SURFACE[name](vertices, FACES)
            pytest.fail(f"{name} took {what}")


@pytest.mark.parametrize("name", TAKE_A_SURFACE)
def test_the_error_names_the_offending_elements(name):
    for place, value in ((([7, 70], 1), -1), (([7, 70], 1), COUNT), ([7, 70], 3)):
        with pytest.raises(koebe.InputError) as caught:
            TAKE_A_SURFACE[name](VERTICES, with_entry(FACES, place, value))
        assert list(caught.value.elements) == [7, 70]
    if name != "boundary_loops":
        with pytest.raises(koebe.InputError) as caught:
            TAKE_A_SURFACE[name](with_entry(VERTICES, (5, 1), np.nan), FACES)
        assert list(caught.value.elements) == [5]


@pytest.mark.parametrize("kind", [np.float16, np.float32, np.longdouble, np.int8, np.uint64])
def test_numbers_of_any_width_are_taken(kind):
    points = np.round((VERTICES - VERTICES.min()) * 32).astype(kind)
    assert np.array_equal(koebe.uniformize(points, FACES).uv, koebe.uniformize(points.astype(float), FACES).uv)


def test_a_circle_through_no_points_or_beyond_floating_point_is_refused():
    with pytest.raises(koebe.InputError, match="no points"):
        koebe.fit_circle(np.zeros((0, 2)))
    with pytest.raises(koebe.SolverError, match="beyond floating point"):
        koebe.fit_circle([[1e308, 0], [-1e308, 0], [0, 1e308]])
    with pytest.raises(koebe.InputError, match="beyond floating point"):
        koebe.uv_to_disk([[1e308, 0]])


@pytest.mark.parametrize("path", [1, True, b"face.obj", "fa\0ce.obj", None, ["face.obj"]])
def test_a_path_is_a_text(path, tmp_path):
    """A number would be the descriptor of an open file, and reading it would close the output."""
    calls = [
        koebe.load, koebe.read_patch, koebe.read_field, lambda one: koebe.read_region(one, 3),
        lambda one: koebe.write_field(one, [0.0]), lambda one: koebe.cortex(one, "lh"),
        lambda one: koebe.batch([one], tmp_path), DISK_MAP.save, DISK_MAP.export,
    ]  # fmt: skip
    for call in calls:
        with pytest.raises((TypeError, koebe.InputError)):
            call(path)


def test_values_that_no_file_can_hold_are_refused(tmp_path):
    with pytest.raises(koebe.InputError, match="beyond floats of 32 bits"):
        koebe.write_field(tmp_path / "lh.curv", [0.0, 1e200])
    for _ in range(100):  # it read freed memory
        assert len(koebe.weld(np.zeros((0, 3)))) == 0 and not list(tmp_path.iterdir())


def test_masks_may_be_0_and_1():
    out = np.zeros(COUNT, np.uint8)
    out[RIMS[1]] = 1
    assert np.array_equal(koebe.uniformize(VERTICES, FACES, mask=out).triangles,
                          koebe.uniformize(VERTICES, FACES, mask=out == 1).triangles)  # fmt: skip
    ragged, masked = [[1], [0, 1]], np.ma.masked_array(out, out == 1)
    for mask in (out * 2, out[1:], out.astype(float), np.where(out)[0], masked, ragged):
        with pytest.raises(koebe.InputError, match="the mask"):
            koebe.uniformize(VERTICES, FACES, mask=mask)


def test_lists_are_arrays_too():
    assert np.array_equal(koebe.uniformize(VERTICES.tolist(), FACES.tolist()).uv, koebe.uniformize(VERTICES, FACES).uv)


# ---------------------------------------------------------------- arrays in any form


def forms(array):
    """The same numbers as arrays lie in memory elsewhere."""
    frozen = array.copy()
    frozen.flags.writeable = False
    wide = np.repeat(array, 2, axis=1)
    return {
        "Fortran order": np.asfortranarray(array),
        "read-only": frozen,
        "every other column": wide[:, ::2],
        "backwards": array[::-1].copy()[::-1],
        "the other byte order": array.astype(array.dtype.newbyteorder()),
        "unaligned": np.frombuffer(b"x" + array.tobytes(), dtype=array.dtype, offset=1).reshape(array.shape),
        "a subclass": array.view(np.ma.MaskedArray),
    }


@pytest.mark.parametrize("name", set(TAKE_A_SURFACE) - {"disk_map"})
def test_every_form_of_the_arrays_gives_the_same_and_is_left_alone(name):
    def run(vertices, faces):
        outcome = TAKE_A_SURFACE[name](vertices, faces)
        return outcome.uv if name == "uniformize" else outcome

    expected = run(VERTICES, FACES)
    single = run(VERTICES.astype(np.float32).astype(np.float64), FACES)
    for what, vertices in forms(VERTICES).items():
        before = vertices.copy()
        assert same(run(vertices, FACES), expected), what
        assert np.array_equal(vertices, before)
    for what, vertices in forms(VERTICES.astype(np.float32)).items():
        assert same(run(vertices, FACES), single), what
    for what, faces in (forms(FACES) | forms(FACES.astype(np.int64))).items():
        before = faces.copy()
        assert same(run(VERTICES, faces), expected), what
        assert np.array_equal(faces, before)


def test_whole_numbers_of_any_width_are_faces_and_vertices():
    grid = np.round(1000 * (VERTICES - VERTICES.min(axis=0))).astype(np.int64)
    expected = koebe.uniformize(grid.astype(float), FACES).uv
    assert len(VERTICES) < 2**15
    for kind in ("int16", "uint16", "int32", "uint32", "int64", "uint64", ">u8"):
        assert np.array_equal(koebe.uniformize(grid.astype(float), FACES.astype(kind)).uv, expected), kind
        assert np.array_equal(koebe.uniformize(grid.astype(kind), FACES).uv, expected), kind


def same(a, b):
    """Whether two results are equal to the last bit."""
    if isinstance(a, dict):
        return a == b
    if isinstance(a, (tuple, list)):
        return len(a) == len(b) and all(map(same, a, b))
    return np.array_equal(a, b)


# ---------------------------------------------------------------- surfaces in one argument

TAKE_A_WHOLE_SURFACE = {
    **TAKE_A_SURFACE,
    "boundary_loops": lambda v, f: koebe.boundary_loops(v if f is None else f),
    "cut": lambda v, f: koebe.uniformize(v, f, cut=True),
    "parts": koebe.parts,
    "ring_map": koebe.ring_map,
    "sphere_map": koebe.sphere_map,
    "open_surface": lambda v, f: koebe.open_surface(v, f).pieces[0].vertices,
    "Surface": lambda v, f: koebe.Surface(v, f).uniformize(v if f is None else None),
}


@pytest.mark.parametrize("name", set(TAKE_A_WHOLE_SURFACE) - {"disk_map"})
def test_a_pair_and_a_file_are_surfaces_in_every_function(name, tmp_path):
    def run(vertices, faces=None):
        outcome = TAKE_A_WHOLE_SURFACE[name](vertices, faces)
        return getattr(outcome, "uv", outcome)

    file, expected = tmp_path / "in.obj", run(VERTICES, FACES)
    file.write_text(obj_text(VERTICES, FACES))
    for given in ((VERTICES, FACES), [VERTICES.tolist(), FACES.tolist()], file, str(file)):
        assert same(run(given), expected), type(given)
    for given, error in (
        (tmp_path / "absent.obj", FileNotFoundError), (tmp_path / "in.blend", (koebe.InputError, FileNotFoundError)),
        ((VERTICES, FACES, FACES), koebe.InputError), ((VERTICES, with_entry(FACES, 7, COUNT)), koebe.InputError),
        ([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]], koebe.InputError), ((VERTICES, None), koebe.InputError),
    ):  # fmt: skip
        with pytest.raises(error):
            run(given)


def test_a_file_keeps_its_polygons_and_another_formats_file_is_refused(tmp_path):
    quads = tmp_path / "quads.OBJ"
    quads.write_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\nf 1 2 3 4\nf 2 5 6 3\n")
    result = koebe.parts(quads)
    assert result.surface[1].shape == (4, 3) and result.part.tolist() == [0] * 4
    with pytest.raises(koebe.InputError, match="arrays or as a file"):
        koebe.uniformize(quads).to_mesh()
    (tmp_path / "in.blend").write_text("BLENDER")
    with pytest.raises(koebe.InputError, match="blend"):
        koebe.uniformize(tmp_path / "in.blend")
    with pytest.raises(TypeError, match="own faces"):
        koebe.uniformize(quads, FACES)


# ---------------------------------------------------------------- options


@pytest.mark.parametrize(
    "option",
    [
        {"method": "GK"}, {"method": ""}, {"engine": "dense"}, {"balance": "areas"}, {"outer": "shortest"},
        {"outer": "7"}, {"tolerance": 0}, {"tolerance": -1e-6}, {"tolerance": np.nan}, {"tolerance": np.inf},
        {"tolerance": 10**400}, {"max_sweeps": 0}, {"max_sweeps": -3}, {"max_sweeps": 2**31}, {"threads": -1},
        {"threads": 2**40}, {"center": 60, "balance": "area"},
    ],
)  # fmt: skip
def test_options_out_of_range_are_value_errors(option):
    with pytest.raises(ValueError, match=next(iter(option))) as caught:
        koebe.uniformize(VERTICES, FACES, **option)
    assert isinstance(caught.value, koebe.OptionError) and isinstance(caught.value, koebe.KoebeError)


@pytest.mark.parametrize(
    "option",
    [
        {"method": None}, {"method": 1}, {"method": b"gk"}, {"engine": ["mesh"]}, {"balance": False}, {"outer": 1.0},
        {"outer": None}, {"outer": True}, {"outer": np.array([1])}, {"tolerance": "1e-6"}, {"tolerance": None},
        {"tolerance": 1e-6 + 0j}, {"tolerance": True}, {"tolerance": np.array([1e-6])}, {"max_sweeps": 2.5},
        {"max_sweeps": "5"}, {"max_sweeps": True}, {"max_sweeps": None}, {"threads": 1.0}, {"threads": None},
        {"center": 1.0}, {"center": True}, {"center": "60"}, {"point": 0.0}, {"point": [0]},
        {"polish": "no"}, {"polish": 1}, {"polish": None}, {"progress": 1}, {"progress": "print"}, {"cancel": True},
        {"cancel": object()}, {"no_such_option": 1},
    ],
)  # fmt: skip
def test_options_of_a_wrong_type_are_type_errors(option):
    with pytest.raises(TypeError, match=next(iter(option))):
        koebe.uniformize(VERTICES, FACES, **option)


def test_numbers_of_any_kind_are_numbers():
    expected = koebe.uniformize(VERTICES, FACES, tolerance=2.0**-20, max_sweeps=3, outer=int(RIMS[0][0])).uv
    for tolerance, sweeps, outer in (
        (np.float32(2.0**-20), np.int64(3), np.int32(RIMS[0][0])),
        (Fraction(1, 2**20), np.uint8(3), RIMS[0][0]),
    ):
        assert np.array_equal(
            koebe.uniformize(VERTICES, FACES, tolerance=tolerance, max_sweeps=sweeps, outer=outer).uv, expected
        )


@pytest.mark.parametrize("vertex", [-1, 60, COUNT, 2**31 - 1, 2**31, -(2**40), 10**30])
def test_an_outer_vertex_on_no_loop_is_named(vertex):
    assert not any(vertex in rim for rim in RIMS)
    with pytest.raises(koebe.InputError) as caught:
        koebe.uniformize(VERTICES, FACES, outer=vertex)
    assert list(caught.value.elements) == [vertex] and not isinstance(caught.value, ValueError)


@pytest.mark.parametrize("option", ["center", "point"])
@pytest.mark.parametrize("vertex", [-1, COUNT, 2**31 - 1, 2**31, 10**30])
def test_a_place_for_a_vertex_that_does_not_exist_names_it(option, vertex):
    with pytest.raises(koebe.InputError, match=str(vertex)) as caught:
        koebe.uniformize(VERTICES, FACES, **{option: vertex})
    assert list(caught.value.elements) == [vertex] and not isinstance(caught.value, ValueError)


def test_the_center_is_inside_and_the_point_on_a_loop():
    rim, inside = int(RIMS[0][0]), 60
    for option, vertex in (("center", rim), ("point", inside)):
        with pytest.raises(koebe.InputError, match=f"vertex {vertex} ") as caught:
            koebe.uniformize(VERTICES, FACES, **{option: vertex})
        assert list(caught.value.elements) == [vertex]
    with pytest.raises(koebe.InputError, match="vertex"):
        koebe.uniformize(VERTICES, FACES, outer=rim, point=int(RIMS[1][0]))
    for engine in ("condensed", "mesh"):
        result = koebe.uniformize(VERTICES, FACES, engine=engine, center=np.int64(inside), point=int(RIMS[1][0]))
        assert result.uv[inside].tolist() == [0, 0] and result.uv[RIMS[1][0]].tolist() == [1, 0]
        assert (result.center, result.point) == (inside, RIMS[1][0]) == (
            result.to_dict()["center"], result.to_dict()["point"],
        )  # fmt: skip
        assert RIMS[1][0] in result.loops[0]
    plain = koebe.uniformize(VERTICES, FACES)
    assert plain.center is plain.point is None and not {"center", "point"} & plain.to_dict().keys()


# ---------------------------------------------------------------- the other functions' own arguments


RAGGED = [[1, 2], [3]]
DISK_MAP = koebe.uniformize(VERTICES, FACES)


def harmonic(fixed, values=None):
    return koebe.harmonic_map(VERTICES, FACES, fixed, np.zeros((len(fixed), 2)) if values is None else values)


@pytest.mark.parametrize(
    "call",
    [
        lambda: koebe.boundary_loops([[0, 0, 1]]),
        lambda: koebe.boundary_loops([[0, 1, 2]], vertex_count=2),
        lambda: koebe.boundary_loops([[0, 1, -2]]),
        lambda: koebe.boundary_loops([]),
        lambda: koebe.boundary_loops([[0, 1, 2]], vertex_count=0),
        lambda: koebe.boundary_loops([[0, 1, 2]], vertex_count=2**31),
        lambda: koebe.fill_holes(VERTICES, FACES, loops=[2]),
        lambda: koebe.fill_holes(VERTICES, FACES, loops=[-1]),
        lambda: koebe.fill_holes(VERTICES, FACES, loops=[0, 0]),
        lambda: koebe.fill_holes(VERTICES, FACES, loops=[0.0]),
        lambda: koebe.fill_holes(VERTICES, FACES, loops=[False]),
        lambda: koebe.fill_holes(VERTICES, FACES, loops=[2**40]),
        lambda: koebe.fill_holes(VERTICES, FACES, loops=0),
        lambda: koebe.fill_holes(VERTICES, FACES, loops=[[0]]),
        lambda: koebe.annulus_map(VERTICES, FACES, backend="ricci"),
        lambda: koebe.annulus_map(*DISK),
        lambda: koebe.disk_map(VERTICES, FACES),
        lambda: koebe.distortion(VERTICES, FACES, UV[1:]),
        lambda: koebe.distortion(VERTICES, FACES, VERTICES),
        lambda: koebe.distortion(VERTICES, FACES, with_entry(UV, (3, 1), np.nan)),
        lambda: koebe.distortion(VERTICES, FACES, UV.astype(complex)),
        lambda: koebe.distortion(VERTICES, FACES, UV.astype(object)),
        lambda: harmonic([]),
        lambda: harmonic([0, 1, 0]),
        lambda: harmonic([0, COUNT]),
        lambda: harmonic([-1, 0]),
        lambda: harmonic([0.0, 1.0]),
        lambda: harmonic([2**32, 1]),
        lambda: harmonic([0, 1], np.zeros((3, 2))),
        lambda: harmonic([0, 1], np.zeros((2, 3))),
        lambda: harmonic([0, 1], np.full((2, 2), np.inf)),
        lambda: harmonic([0, 1], np.zeros((2, 2), dtype=complex)),
        lambda: koebe.conformal_module(Domain(), order=[0, 1]),
        lambda: koebe.conformal_module(Domain(), order=[]),
        lambda: koebe.conformal_module(Domain(), order=[0, 1, 1]),
        lambda: koebe.conformal_module(Domain(), order=[0, 1, 3]),
        lambda: koebe.conformal_module(Domain(), order=[0, 1, -1]),
        lambda: koebe.conformal_module(Domain(), order=[0.0, 1.0, 2.0]),
        lambda: koebe.conformal_module(Domain(), order="by length"),
        lambda: koebe.conformal_module(Domain(radii=[1.0, 0.2])),
        lambda: koebe.conformal_module(Domain(radii=[np.nan, 0.2, 0.3])),
        lambda: koebe.conformal_module(Domain(radii=[1.0, 0.2, -0.3])),
        lambda: koebe.conformal_module(Domain(radii=[1.0, 0.2, 3e300])),
        lambda: koebe.conformal_module(Domain(radii=[])),
        lambda: koebe.conformal_module(Domain([], [])),
        lambda: koebe.conformal_module(Domain(centers=[[np.nan, 0.0], [0.5, 0.0], [-0.4, 0.1]])),
        lambda: koebe.conformal_module(Domain(centers=[0.0, 0.5, 1.0])),
        lambda: koebe.conformal_module(Domain(centers=np.zeros((3, 2), dtype=complex))),
        lambda: koebe.conformal_module(VERTICES),
        lambda: koebe.conformal_module(None),
        lambda: koebe.canonical_order(3),
        lambda: koebe.match_loops(Domain(), None),
        lambda: koebe.match_loops(Domain(), Domain([[0.0, 0.0]], [1.0])),
        lambda: koebe.align_domains(Domain(), Domain(), match=[1, 0, 2]),
        lambda: koebe.align_domains(Domain(), Domain(), match=[0, 1]),
        lambda: koebe.align_domains(Domain(), Domain(), match=[]),
        lambda: koebe.align_domains(Domain(), Domain(), match=[0, 1, 2**40]),
        lambda: koebe.align_domains(Domain(), Domain())(UV.astype(complex)),
        lambda: koebe.align_domains(Domain(), Domain())(VERTICES),
        lambda: koebe.align_domains(Domain(), Domain())([[np.nan, 0.0]]),
        lambda: koebe.module_distance([1.0], [1.0, 2.0]),
        lambda: koebe.module_distance([np.nan], [1.0]),
        lambda: koebe.module_distance([[1.0]], [[1.0]]),
        lambda: koebe.module_distance(["1"], ["1"]),
        lambda: koebe.module_distance([1j], [1j]),
        lambda: koebe.module_distance(None, None),
        lambda: koebe.to_image(DISK_MAP, RAGGED, 8),
        lambda: koebe.to_image(DISK_MAP, np.ma.masked_less(np.arange(float(COUNT)), 3.0), 8),
        lambda: koebe.distortion(VERTICES, FACES, RAGGED),
        lambda: koebe.pack(VERTICES, FACES, uv=RAGGED),
        lambda: koebe.pack(VERTICES, FACES, uv=UV, locked=RAGGED),
        lambda: koebe.sew(VERTICES, FACES, uv=UV, edges=RAGGED),
        lambda: koebe.parts(VERTICES, FACES, cuts=RAGGED),
        lambda: koebe.planar("a\0b"),
        lambda: koebe.point_test(np.eye(4), [0, 0, 1, 1], covariates=np.arange(4) * 1j),
        lambda: koebe.module_names(-1),
        lambda: koebe.module_names(2**40),
    ],
)
def test_arguments_that_mean_nothing_are_input_errors(call):
    with pytest.raises(koebe.InputError):
        call()


@pytest.mark.parametrize(
    "call",
    [
        lambda: koebe.boundary_loops([[0, 1, 2]], vertex_count=3.0),
        lambda: koebe.fill_holes(VERTICES, FACES, fair=1),
        lambda: koebe.harmonic_map(VERTICES, FACES, [0], [[0.0, 0.0]], uniform="yes"),
        lambda: koebe.annulus_map(VERTICES, FACES, backend=None),
        lambda: koebe.canonical_order(Domain(), any_outer="no"),
        lambda: koebe.match_loops(Domain(), Domain(), any_outer=0),
        lambda: koebe.module_names(2.0),
        lambda: koebe.module_names("2"),
        lambda: koebe.parts(VERTICES, FACES, sketch=np.zeros(3)),
        lambda: koebe.EvenDial(VERTICES, FACES, uv=UV).pin(False),
    ],
)
def test_arguments_of_a_wrong_type_are_type_errors(call):
    with pytest.raises(TypeError, match="must be"):
        call()


def test_one_vertex_that_no_mesh_needs_costs_no_memory():
    far = 2**31 - 3
    loops = koebe.boundary_loops([[0, 7, far], [7, 9, far]], vertex_count=2**31 - 1)
    assert [loop.tolist() for loop in loops] == [[0, 7, 9, far]] and loops[0].dtype == np.int32
    with pytest.raises(koebe.TopologyError) as caught:
        koebe.boundary_loops([[0, 7, far], [7, 0, 9], [0, 7, 11]])
    assert sorted(caught.value.elements) == [0, 7]
    with pytest.raises(koebe.TopologyError) as caught:
        koebe.boundary_loops([[0, 7, far], [7, 0, 9], [100, 101, 102]])
    assert list(caught.value.elements) == [2]


@pytest.mark.parametrize("scale", [1e-300, 1e-160, 1e160, 1e300])
def test_numbers_at_the_end_of_floating_point_give_finite_ones_or_an_error(scale):
    vertices = VERTICES * scale
    for name, call in TAKE_A_SURFACE.items():
        if name in ("boundary_loops", "disk_map"):
            continue
        try:
            outcome = call(vertices, FACES)
        except (koebe.SolverError, koebe.InputError):
            continue
        arrays = [outcome.uv] if name == "uniformize" else outcome.values() if isinstance(outcome, dict) else outcome
        for array in arrays:
            numbers = list(array.values()) if isinstance(array, dict) else array
            assert np.isfinite(np.asarray(numbers, dtype=float)).all(), name


def test_errors_can_be_sent_to_another_process():
    import pickle

    with pytest.raises(koebe.TopologyError) as caught:
        koebe.boundary_loops([[0, 1, 2], [1, 0, 3], [0, 1, 4]])
    again = pickle.loads(pickle.dumps(caught.value))
    assert str(again) == str(caught.value) and again.kind == "nonmanifold_edge"
    assert list(again.elements) == list(caught.value.elements) == [0, 1]
