"""What a result holds beside its report: fields, files, pickles, the picture in a notebook."""

import inspect
import io
import pickle
import re
from xml.etree import ElementTree

import koebe
import numpy as np
import pytest
from cli_support import triangulated_plate

VERTICES, FACES = triangulated_plate()
RESULT = koebe.uniformize(VERTICES, FACES)
RECORDED = koebe.uniformize(VERTICES, FACES, engine="mesh", max_sweeps=1, record_steps=True)


def equal(a, b):
    """Whether two results hold the same, to the last bit."""
    arrays = ("uv", "centers", "radii", "roundness", "own_circle", "log_scale", "face_angle_error_deg")
    same = all(np.array_equal(getattr(a, name), getattr(b, name), equal_nan=True) for name in arrays)
    same = same and np.array_equal(a.flipped_faces, b.flipped_faces)
    steps = all(np.array_equal(x, y, equal_nan=True) for x, y in zip(a.step_maps, b.step_maps, strict=True))
    loops = all(np.array_equal(x, y) for x, y in zip(a.loops + a.off_circle, b.loops + b.off_circle, strict=True))
    return same and steps and loops and a.to_dict() == b.to_dict() and repr(a) == repr(b)


@pytest.mark.parametrize("result", [RESULT, RECORDED], ids=["plain", "with steps"])
def test_a_result_survives_a_file_and_a_pickle(result, tmp_path):
    result.save(tmp_path / "face.npz")
    assert equal(koebe.load(tmp_path / "face.npz"), result)
    assert [path.name for path in tmp_path.iterdir()] == ["face.npz"]
    assert equal(pickle.loads(pickle.dumps(result)), result)
    # What was read is as complete as what was computed.
    read = koebe.load(tmp_path / "face.npz")
    assert np.array_equal(read.conformal.radii, result.conformal.radii)
    assert set(dir(read)) == set(dir(result))
    assert np.array_equal(read.surface[0], VERTICES) and np.array_equal(read.surface[1], FACES)
    assert not read.uv.flags.writeable


def test_before_balance_is_the_distortion_of_the_map_without_it():
    assert "ears" in [warning.kind for warning in RESULT.warnings]  # they count too
    before = koebe.uniformize(VERTICES, FACES, balance="area").area_distortion["before_balance"]
    assert before == {name: RESULT.area_distortion[name] for name in before}


@pytest.mark.parametrize("make", [koebe.sphere_map, koebe.ring_map, koebe.parts])
def test_maps_to_other_domains_survive_a_file_too(make, tmp_path):
    result = make(VERTICES, FACES)
    result.save(tmp_path / "map.npz")
    again = koebe.load(tmp_path / "map.npz")
    assert type(again) is type(result) and set(dir(again)) == set(dir(result)) and again.to_dict() == result.to_dict()
    for name, value in vars(result).items():
        if isinstance(value, np.ndarray):
            assert np.array_equal(getattr(again, name), value) and getattr(again, name).dtype == value.dtype, name
    assert np.array_equal(again.surface[1], FACES) and not again.uv.flags.writeable


def test_a_file_that_is_no_result(tmp_path):
    RESULT.save(tmp_path / "whole.npz")
    whole = (tmp_path / "whole.npz").read_bytes()
    other = io.BytesIO()
    np.savez(other, report=np.array("{}"))
    for number, content in enumerate([b"", b"nonsense", whole[: len(whole) // 2], other.getvalue()]):
        (tmp_path / f"{number}.npz").write_bytes(content)
        with pytest.raises(koebe.InputError, match=f"{number}.npz is no result"):
            koebe.load(tmp_path / f"{number}.npz")
    with pytest.raises(FileNotFoundError):
        koebe.load(tmp_path / "absent.npz")


def test_nothing_is_left_of_a_file_that_cannot_be_written(tmp_path):
    with pytest.raises(FileNotFoundError):
        RESULT.save(tmp_path / "absent" / "face.npz")
    (tmp_path / "folder").mkdir()
    with pytest.raises(OSError):
        RESULT.save(tmp_path / "folder")
    assert [path.name for path in tmp_path.iterdir()] == ["folder"]


def test_the_scale_follows_the_unit_of_length():
    assert np.isfinite(RESULT.log_scale).all()
    scaled = koebe.uniformize(8.0 * VERTICES, FACES)
    assert np.allclose(scaled.log_scale, RESULT.log_scale - np.log(8.0), atol=1e-9)
    # Area in the disk is the integral of the squared scale over the surface.
    a, b, c = (VERTICES[FACES[:, k]] for k in range(3))
    area = 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1)
    circles = np.pi * (RESULT.radii[0] ** 2 - (RESULT.radii[1:] ** 2).sum())
    assert np.isclose((np.exp(2 * RESULT.log_scale)[FACES].mean(axis=1) * area).sum(), circles, rtol=0.05)


def test_the_angle_error_of_the_faces_has_the_mean_of_the_report():
    assert np.isclose(RESULT.face_angle_error_deg.mean(), RESULT.angle_error_deg["mean"], rtol=1e-6)


def test_disk_and_uv_square():
    points = RESULT.uv
    uv = koebe.disk_to_uv(points)
    assert uv.min() >= 0.0 and uv.max() <= 1.0
    assert np.allclose(koebe.uv_to_disk(uv), points, atol=1e-15)
    assert np.array_equal(koebe.disk_to_uv([[0.0, 0.0], [1.0, -1.0]]), [[0.5, 0.5], [1.0, 0.0]])
    with pytest.raises(koebe.InputError):
        koebe.disk_to_uv([[0.0, 0.0, 0.0]])


def test_a_notebook_shows_the_circles():
    picture = ElementTree.fromstring(RESULT._repr_html_())
    circles = [(float(c.get("cx")), -float(c.get("cy")), float(c.get("r"))) for c in picture.iter("circle")]
    assert np.allclose(circles, np.column_stack([RESULT.centers, RESULT.radii]), atol=1e-5)
    assert "converged in" in "".join(picture.itertext())


def test_a_circle_that_is_not_the_surfaces_is_marked():
    assert RESULT.own_circle.tolist() == [True] * len(RESULT.loops)
    report = RESULT.to_dict()
    assert [loop["own_circle"] for loop in report["loops"]] == RESULT.own_circle.tolist()


def test_the_report_says_what_it_was_made_from():
    import hashlib

    report = RESULT.to_dict()
    data = VERTICES.astype("<f8").tobytes() + FACES.astype("<i4").tobytes()
    assert report["input_sha256"] == RESULT.input_sha256 == hashlib.sha256(data).hexdigest()
    assert report["version"] == RESULT.version == koebe.__version__
    assert report["options"]["method"] == "gk" and report["options"]["tolerance"] == 1e-6
    other = koebe.uniformize(VERTICES + 1.0, FACES, method="ck", center=None, outer=np.int64(RESULT.loops[0][0]))
    assert other.input_sha256 != RESULT.input_sha256 and other.options["method"] == "ck"
    assert type(other.options["outer"]) is int
    # The options make the same map again.
    again = koebe.uniformize(*other.surface, **other.options)
    assert np.array_equal(again.uv, other.uv)


def test_an_editor_sees_all_of_a_result():
    names = set(re.findall(r"^(\w+) : ", inspect.getdoc(koebe.UniformizeResult), re.MULTILINE))
    assert len(names) > 25 and names <= set(dir(RESULT))
    assert set(RESULT.to_dict()) - {"input", "faces"} <= set(dir(RESULT))  # face_count, as vertices are an array
    places = koebe.transfer(RESULT, RESULT)
    for thing in (RESULT, places, places.alignment, koebe.family([RESULT])):
        assert repr(thing).startswith("<koebe.") and repr(thing).endswith(">")
