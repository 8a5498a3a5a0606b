"""All results have the same names for the same things."""

import copy
import functools
import inspect
import json
import pickle
import re
import typing
import warnings
from xml.etree import ElementTree

import koebe
import numpy as np
import pytest
from koebe._comparable import Result, subclasses
from sphere_surfaces import icosphere

FACE = "blend_samples/face.obj"
BALL = icosphere(6)
SQUARE = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2], [0, 2, 3]]
MAPS = {
    "uniformize": lambda: koebe.uniformize(FACE),
    "cut": lambda: koebe.uniformize(FACE, cut=True),
    "parts": lambda: koebe.parts(FACE),
    "ring": lambda: koebe.ring_map(FACE),
    "sphere": lambda: koebe.sphere_map(FACE),
    "torus": lambda: koebe.torus_map("docs/link.obj"),
    "schottky": lambda: koebe.schottky_map("docs/link.obj"),
    "flatten": lambda: koebe.flatten(FACE),
    "pack": lambda: koebe.pack(*SQUARE, uv=[[0, 0], [1, 0], [1, 1], [0, 1]], seconds=0.01),
    "fit": lambda: koebe.fit_circles(FACE, [[-0.3, 0.2], [0.3, 0.2], [0, -0.4]], [0.15, 0.15, 0.1]),
}


MADE = {name: functools.cache(make) for name, make in MAPS.items()}
DISTANCES = abs(np.subtract.outer(np.arange(8.0), np.arange(8.0)))
OTHERS = {  # results that are no maps
    "lift": lambda: koebe.lift(FACE, perforate=True),
    "transfer": lambda: koebe.transfer(MADE["uniformize"](), MADE["uniformize"]()),
    "spheres": lambda: koebe.transfer(koebe.sphere_map(BALL), koebe.sphere_map(BALL)),
    "harmonics": lambda: koebe.SphereHarmonics(np.ones((3, 2, 3, 3)), 2, 0.1, BALL[0], BALL[1]),
    "teichmueller": lambda: koebe.teichmueller(MADE["uniformize"](), MADE["uniformize"]()),
    "alignment": lambda: koebe.align_domains(MADE["uniformize"](), MADE["fit"]()),
    "match": lambda: koebe.match_loops(MADE["uniformize"](), MADE["fit"]()),
    "conformal": lambda: MADE["uniformize"]().conformal,
    "family": lambda: koebe.family([MADE["uniformize"](), MADE["fit"]()], labels=["a", "b"]),
    "sphere family": lambda: koebe.family([BALL, BALL]),
    "certified": lambda: koebe.certified_moduli(FACE),
    "planar": lambda: koebe.planar([[(-2, -2), (2, -2), (0, 2)], [(0, 0), (0.5, -1), (-0.5, -1)]], tolerance=1e-3),
    "opened": lambda: koebe.open_surface("docs/link.obj"),
    "piece": lambda: koebe.open_surface("docs/link.obj").pieces[0],
    "permutations": lambda: koebe.permutation_test(DISTANCES, [0, 0, 0, 0, 1, 1, 1, 1]),
    "points": lambda: koebe.point_test(np.random.default_rng(1).normal(size=(8, 30)), [0, 0, 0, 0, 1, 1, 1, 1]),
    "sewn": lambda: koebe.sew(*SQUARE, uv=[[[0, 0], [1, 0], [1, 1]], [[2, 2], [3, 3], [2, 3]]], edges=[(0, 2)]),
    "field": lambda: koebe.VertexField(np.arange(3, dtype=np.int32), {0: "a"}, {0: (0.0, 0.5, 1.0, 1.0)}),
    "patch": lambda: koebe.Patch(np.arange(3, dtype=np.int32), np.eye(3), np.array([True, False, True])),
    "cortex": lambda: koebe.FlatCortex(MADE["parts"](), MADE["uniformize"]().uv, *np.zeros((2, 2309), bool), 0.1),
}
MADE |= {name: functools.cache(make) for name, make in OTHERS.items()}
INSIDE = {"MapReport", "PointFamily", "LeftOutFace", "SurfaceCut"}  # bases of results, and entries of their lists


def test_the_results_are_all():
    public = {name for name in koebe.__all__ if inspect.isclass(getattr(koebe, name))}
    kinds = {one.__name__ for one in subclasses(Result)} & public
    assert {type(make()).__name__ for make in MADE.values()} == kinds - INSIDE


@pytest.mark.parametrize("kind", MADE)
def test_every_result_goes_to_another_process_and_into_a_file(kind, tmp_path):
    result = MADE[kind]()
    result.save(tmp_path / "result.npz")
    loaded = koebe.load(tmp_path / "result.npz", type(result))
    for again in (pickle.loads(pickle.dumps(result)), copy.deepcopy(result), loaded):
        assert type(again) is type(result) and again == result and (again != result) is False
        assert repr(again) == repr(result) and again._repr_html_() == result._repr_html_()
        for name in ("to_dict", "corner_uv"):
            one, other = (getattr(which, name, None) for which in (again, result))
            assert one() == other() if callable(one) else np.array_equal(one, other)
        assert fixed(again)
    assert result != kind and result != MADE["planar" if kind != "planar" else "lift"]()
    with pytest.raises(koebe.InputError, match=f"has a {type(result).__name__}, not a "):
        koebe.load(tmp_path / "result.npz", koebe.Patch if kind != "patch" else koebe.Correspondence)
    for one, other in zip(*(callables(which) for which in (loaded, result))):
        assert np.array_equal(one([[0.1, 0.2]]), other([[0.1, 0.2]]))
    if kind == "planar":
        assert np.array_equal(loaded([(0.0, 1.0)]), result([(0.0, 1.0)]))


def callables(result):
    """The automorphisms of the disk in a result."""
    return [one for one in (result, getattr(result, "alignment", None)) if isinstance(one, koebe.DomainAlignment)]


LAZY = {"points", "q"}  # the first takes a while, the second SciPy


def attributes(result):
    """What a user sees of a result: its attributes and properties."""
    names = {*vars(result), *dir(type(result))} if not isinstance(result, tuple) else {*result._fields}
    return {name: getattr(result, name) for name in names if not name.startswith("_") and name not in LAZY}


def fixed(result):
    """Whether no attribute, and no array of one, can be changed."""
    for name, value in attributes(result).items():
        with pytest.raises(AttributeError):
            setattr(result, name, 1)
        with pytest.raises(AttributeError):
            delattr(result, name)
        if getattr(result, name) is value:  # else it is made anew with each call
            for array in value if isinstance(value, (list, tuple)) else [value]:
                assert not isinstance(array, np.ndarray) or not array.flags.writeable, name
    return True


def arrays_of(hint):
    """The types of numbers that a type's arrays may have."""
    if typing.get_origin(hint) is np.ndarray:
        return [typing.get_args(typing.get_args(hint)[1])[0]]
    return [kind for one in typing.get_args(hint) for kind in arrays_of(one)]


@pytest.mark.parametrize("kind", MADE)
def test_arrays_have_the_numbers_that_their_types_say(kind):
    result = MADE[kind]()
    found = 0
    for cls in type(result).__mro__:
        hints = typing.get_type_hints(cls) if cls.__module__.startswith("koebe") else {}
        for name, one in vars(cls).items():
            if isinstance(one, (property, functools.cached_property)):
                hints[name] = typing.get_type_hints(one.fget if isinstance(one, property) else one.func).get("return")
        for name, hint in hints.items():
            value = getattr(result, name, None) if not name.startswith("_") and name != "q" else None
            said = [np.integer if typing.get_origin(one) is np.integer else one for one in arrays_of(hint)]
            for array in value if isinstance(value, (list, tuple)) else [value]:
                if isinstance(array, np.ndarray) and said:
                    found += 1
                    assert any(one is typing.Any or np.issubdtype(array.dtype, one) for one in said), (
                        name,
                        array.dtype,
                    )
    assert found or kind in ("permutations", "opened")


@pytest.mark.parametrize("kind", MADE)
def test_every_result_shows_itself(kind):
    result = MADE[kind]()
    shown = ElementTree.fromstring(result._repr_html_())
    picture = shown.find("svg")
    assert list(picture) and "".join(shown.itertext()) and repr(result).startswith(f"<koebe.{type(result).__name__} ")
    size = float(picture.get("width")), float(picture.get("height"))
    for path in picture.iter("path"):
        pixels = np.array(re.findall(r"[\d.]+", path.get("d")), float).reshape(-1, 2)
        assert (len(pixels) > 10 or kind in ("sewn", "pack")) and (pixels >= 0).all() and (pixels <= size).all()
    low, box = np.array(picture.get("viewBox").split(), float).reshape(2, 2)
    marks = [np.array([[one.get(name) for name in names]], float) for names in (("cx", "cy"), ("x", "y"))
             for one in picture if one.get(names[0])]  # fmt: skip
    assert all((mark >= low).all() and (mark <= low + box).all() for mark in marks)


@pytest.mark.parametrize("kind", MADE)
def test_every_result_is_plotted(kind):
    pytest.importorskip("matplotlib").use("agg")
    figure = MADE[kind]().plot()
    assert any(len(axes.collections) + len(axes.patches) for axes in figure.axes)


def test_equal_inputs_give_equal_results():
    for kind in ("uniformize", "cut", "parts", "sphere", "ring", "fit", "family", "certified"):
        again = {**MAPS, **OTHERS}[kind]()
        assert again == MADE[kind]() and again is not MADE[kind]()
        if isinstance(again, koebe.MapReport):
            assert len({again, MADE[kind](), MADE["uniformize"]()}) == (2 if kind != "uniformize" else 1)
    faces = [koebe.uniformize(koebe.example(name)) for name in ("face", "surprised")]
    assert faces[0] != faces[1] and faces[0].conformal != faces[1].conformal
    assert koebe.family(faces, labels=["a", "b"]) == koebe.family(faces, labels=["a", "b"])
    assert koebe.family(faces, labels=["a", "b"]) != koebe.family(faces, labels=["a", "c"])


def test_calls_that_fit_no_result_say_what_fits(tmp_path):
    disk, sphere = MADE["uniformize"](), MADE["sphere"]()
    for shapes in ([disk, sphere], [sphere, disk]):
        with pytest.raises(koebe.InputError, match="a family has results of uniformize, or of sphere_map") as caught:
            koebe.family(shapes)
        assert caught.value.elements == [1]
    with pytest.raises(TypeError, match="plot takes a result, such as"):
        koebe.plot([1])
    with pytest.raises(koebe.OptionError, match="^koebe batch has no option --evn: did you mean --even"):
        koebe.batch(FACE, tmp_path, evn=1)


@pytest.mark.parametrize("kind", MAPS)
def test_vertices_triangles_and_uvs_are_of_one_kind(kind):
    result = MADE[kind]()
    assert result.vertices.shape == (result.vertex_count, 3) and result.triangles.shape == (result.face_count, 3)
    assert (result.to_dict()["vertices"], result.to_dict()["faces"]) == (result.vertex_count, result.face_count)
    assert result.corner_uv.shape == (result.face_count, 3, 2)
    if result.uv.ndim == 2:
        assert np.allclose(result.corner_uv, koebe.disk_to_uv(result.uv)[result.triangles])
    for loop in result.loops:
        assert isinstance(loop, koebe.Loop) and loop.dtype == np.int32 and loop.ndim == 1
        assert np.array_equal(loop["vertices"], loop) and not isinstance(loop[:2], koebe.Loop)
        again = pickle.loads(pickle.dumps(loop))
        assert np.array_equal(again, loop) and again.figures.keys() == loop.figures.keys()
        assert type(np.sort(np.asarray(loop))) is np.ndarray and loop.tolist() == list(map(int, loop))


def test_a_loop_has_its_figures():
    result, ring = MADE["uniformize"](), MADE["ring"]()
    assert [loop["radius"] for loop in result.loops] == result.radii.tolist()
    assert sum(loop["rim"] for loop in ring.loops) == 2
    loop = result.loops[0]
    assert "radius" in loop and "slit" not in loop and int(loop[0]) in loop and -1 not in loop
    with pytest.raises(KeyError):
        result.loops[0]["colour"]


def test_a_warning_is_a_warning_of_python_and_a_mapping():
    one = koebe.Warning({"kind": "ears", "elements": [3, 5], "text": "2 faces; the first face is 3"})
    assert isinstance(one, UserWarning) and issubclass(koebe.Warning, RuntimeWarning)
    assert dict(one) == {"kind": "ears", "elements": [3, 5], "text": str(one)} and one == dict(one)
    assert one.kind == one["kind"] == "ears" and one.of == "faces" and pickle.loads(pickle.dumps(one)) == one
    assert one.renumbered(np.arange(10) * 2).text == "2 faces; the first face is 6"
    assert json.loads(json.dumps(dict(one))) == one and not hasattr(one, "nothing")
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        warnings.filterwarnings("ignore", category=koebe.Warning)
        warnings.warn(one, stacklevel=1)
        assert told == []
        warnings.filterwarnings("error", category=koebe.Warning)
        with pytest.raises(koebe.Warning, match="2 faces") as caught:
            warnings.warn(one, stacklevel=1)
    assert caught.value.elements == [3, 5]


def test_kinds_that_1_0_has_saved_are_read():
    old = koebe.Warning({"kind": "flaps", "elements": [3], "text": "1 face"})
    assert (old.kind, old.of) == ("ears", "faces")


def test_signatures_fit_a_screen():
    """Eight lines of 100 characters at most: the types are in the stubs, for type checkers."""
    for name in koebe.__all__:
        if inspect.isfunction(getattr(koebe, name)):
            assert len(f"{name}{inspect.signature(getattr(koebe, name))}") < 800, name
    assert len(str(inspect.signature(koebe.uniformize))) < 500


def test_labels_are_carried_as_labels():
    face, other = MAPS["uniformize"](), koebe.uniformize("blend_samples/surprised.obj")
    places = koebe.transfer(other, face)
    labels = (other.vertices[:, 1] > np.median(other.vertices[:, 1])).astype(np.int16) * 7 + 3
    carried = places.carry(labels)
    assert carried.dtype == np.int16 and set(carried) == {3, 10}
    linear = places.carry(labels, labels=False)
    assert linear.dtype == np.float64 and ((linear > 3.01) & (linear < 9.99)).any()
    assert np.array_equal(carried == 10, linear > 6.5)  # with two labels the one of greater weight is the nearer one
    assert places.carry(labels > 5).dtype == bool and np.array_equal(places.carry(labels > 5), carried == 10)
    two = places.carry(np.column_stack([labels, labels[::-1]]))
    assert two.shape == (face.vertex_count, 2) and np.array_equal(two[:, 0], carried)
    same = koebe.transfer(face, face).carry(np.arange(face.vertex_count))
    assert np.array_equal(same, np.arange(face.vertex_count))
    assert np.array_equal(koebe.transfer(other, face, labels), carried)
    words = np.where(labels > 5, "far", "near")
    assert np.array_equal(places.carry(words), np.where(carried > 5, "far", "near"))
    with pytest.raises(koebe.InputError, match="no mean"):
        places.carry(words, labels=False)
    with pytest.raises(koebe.InputError, match="numbers"):
        places.carry(np.full(other.vertex_count, None))


def test_of_three_labels_the_heaviest_wins_together():
    """Two corners of one label outweigh a third that is heavier than each of them."""
    from koebe.maps.carry import carried

    triangles, weights = np.array([[0, 1, 2]]), np.array([[0.4, 0.3, 0.3]])
    assert carried([5, 8, 8], triangles, np.array([0]), weights, 3, None).tolist() == [8]
    assert carried([5, 8, 9], triangles, np.array([0]), weights, 3, None).tolist() == [5]
    assert carried([5, 8, 8], triangles, np.array([-1]), weights * np.nan, 3, None).tolist() == [-1]
    assert carried([5, 8, 8], triangles, np.array([0]), weights, 3, False).tolist() == pytest.approx([6.8])
