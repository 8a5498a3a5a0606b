"""All results have the same names for the same things."""

import functools
import json
import pickle
import re
import warnings
from xml.etree import ElementTree

import koebe
import numpy as np
import pytest

FACE = "blend_samples/face.obj"
MAPS = {
    "uniformize": lambda: koebe.uniformize(FACE),
    "cut": lambda: koebe.uniformize(FACE, cut=True),
    "parts": lambda: koebe.parts(FACE),
    "ring": lambda: koebe.ring_map(FACE),
    "sphere": lambda: koebe.sphere_map(FACE),
    "torus": lambda: koebe.torus_map("docs/link.obj"),
    "schottky": lambda: koebe.schottky_map("docs/link.obj"),
    "flatten": lambda: koebe.flatten(FACE),
    "fit": lambda: koebe.fit_circles(FACE, [[-0.3, 0.2], [0.3, 0.2], [0, -0.4]], [0.15, 0.15, 0.1]),
}


MADE = {name: functools.cache(make) for name, make in MAPS.items()}
OTHERS = {  # results that are no maps
    "lift": lambda: koebe.lift(FACE, perforate=True),
    "transfer": lambda: koebe.transfer(MADE["uniformize"](), MADE["uniformize"]()),
    "teichmueller": lambda: koebe.teichmueller(MADE["uniformize"](), MADE["uniformize"]()),
    "alignment": lambda: koebe.align_domains(MADE["uniformize"](), MADE["fit"]()),
    "family": lambda: koebe.family([MADE["uniformize"]()]),
    "certified": lambda: koebe.certified_moduli(FACE),
    "planar": lambda: koebe.planar([[(-2, -2), (2, -2), (0, 2)], [(0, 0), (0.5, -1), (-0.5, -1)]]),
    "opened": lambda: koebe.open_surface("docs/link.obj"),
    "permutations": lambda: koebe.permutation_test(1.0 - np.eye(4), [0, 0, 1, 1]),
}


def parts_of(result):
    """What a result holds, in a form that can be compared."""
    return {name: repr(value) for name, value in vars(result).items() if "native" not in name}


@pytest.mark.parametrize("kind", [*MAPS, *OTHERS])
def test_every_result_goes_to_another_process(kind):
    result = {**MADE, **OTHERS}[kind]()
    again = pickle.loads(pickle.dumps(result))
    assert type(again) is type(result) and parts_of(again) == parts_of(result)
    if kind == "transfer":
        assert np.array_equal(again.alignment([[0.1, 0.2]]), result.alignment([[0.1, 0.2]]))


@pytest.mark.parametrize("kind", MAPS)
def test_every_result_with_save_is_loaded_again(kind, tmp_path):
    result = MADE[kind]()
    result.save(tmp_path / "result.npz")
    again = koebe.load(tmp_path / "result.npz", type(result))
    with pytest.raises(koebe.InputError, match=f"has a {type(result).__name__}, not a Correspondence"):
        koebe.load(tmp_path / "result.npz", koebe.Correspondence)
    assert type(again) is type(result) and again.to_dict() == result.to_dict() and repr(again) == repr(result)
    assert np.array_equal(again.corner_uv, result.corner_uv)
    assert again._repr_html_() == result._repr_html_()
    if kind == "flatten":
        assert (again.svg, again.dxf) == (result.svg, result.dxf)


@pytest.mark.parametrize("kind", [*MAPS, "lift"])
def test_every_result_shows_itself(kind):
    shown = ElementTree.fromstring({**MADE, **OTHERS}[kind]()._repr_html_())
    picture = shown.find("svg")
    assert list(picture) and "".join(shown.itertext())
    for path in picture.iter("path"):
        pixels = np.array(re.findall(r"[\d.]+", path.get("d")), float).reshape(-1, 2)
        size = float(picture.get("width")), float(picture.get("height"))
        assert len(pixels) > 10 and (pixels >= 0).all() and (pixels <= size).all()


def test_calls_that_fit_no_result_say_what_fits(tmp_path):
    disk, sphere = MADE["uniformize"](), MADE["sphere"]()
    for shapes in ([disk, sphere], [sphere, disk]):
        with pytest.raises(koebe.InputError, match="a family has results of uniformize, or of sphere_map") as caught:
            koebe.family(shapes)
        assert caught.value.elements == [1]
    with pytest.raises(TypeError, match="plot takes a result of a map"):
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
    import inspect

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
