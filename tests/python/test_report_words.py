"""What Blender's report says of figures and warnings: without Blender."""

from types import SimpleNamespace

import koebe
import pytest


def test_the_words_of_a_warning_count_elements_that_it_lists(addon):
    words = addon("maps.warning_words").WORDS
    for kind, (of, sentence) in words.items():
        assert (of or "none") == koebe.WARNING_ELEMENTS[kind]
        assert not sentence.endswith(".") and ("{count}" not in sentence or of), kind


def warning(kind, *elements, text="as the solver says it"):
    return {"kind": kind, "elements": [*elements], "text": text}


def test_warnings_of_a_kind_are_one_sentence_with_all_their_elements(addon):
    said = addon("maps.warning_words").in_words(
        [warning("ears", 7, 3), warning("lost_circles", 1), warning("ears", 3, 5), warning("other"),
         warning("not_even")])  # fmt: skip
    assert [one.get("elements") for one in said] == [[3, 5, 7], None, None, None]
    assert said[0]["text"].startswith("3 faces at the boundary are squeezed ") and said[0]["of"] == "faces"
    assert said[1]["text"].startswith("1 boundary is too small ") and "of" not in said[1]
    assert said[1]["text"].endswith(" near it")
    assert said[2]["text"] == "as the solver says it"
    assert " no effect on the whole map, " in said[3]["text"]


def test_a_warning_that_speaks_for_itself_still_names_its_faces(addon):
    said = addon("maps.warning_words").in_words([warning("lost_area", 7, 3), warning("lost_area", 4)])
    assert said == [{"text": "as the solver says it", "of": "faces", "elements": [3, 4, 7]}]


def test_faces_that_a_cut_has_loosened_are_not_the_meshs_fault(addon):
    (said,) = addon("maps.warning_words").in_words([warning("ears", 7, 3)], is_cut=True)
    assert said["text"].startswith("2 faces beside a cut are squeezed ") and "Subdivide" not in said["text"]


GOOD = {"density": 2.0, "coverage": 0.7, "angle_error": 1.0, "flipped": 0, "parts": 0, "domain": "", "even": 0.0,
        "converged": True, "message": ""}  # fmt: skip


def test_a_good_map_asks_for_nothing(addon):
    found = addon("maps.verdicts").figures(SimpleNamespace(**GOOD))
    assert [(figure.name, figure.value) for figure in found] == [
        ("Texel density", "1 : 2.0"), ("Coverage", "70 %"), ("Angle error", "1.00°"), ("Flips", "none")]  # fmt: skip
    assert all(figure.is_good for figure in found)
    assert addon("maps.verdicts").is_good(SimpleNamespace(**GOOD))


@pytest.mark.parametrize("bad, name, advice", [
    ({"density": 50.0}, "Texel density", "with Shape: Disk raise Even, or choose Shape: Parts"),
    ({"density": 50.0, "domain": "ring"}, "Texel density", "uneven: raise Even, or choose Shape: Parts"),
    ({"density": 50.0, "parts": 3}, "Texel density", "slider Parts"),
    ({"density": 50.0, "domain": "sphere"}, "Texel density", "always has uneven texels"),
    ({"density": 5e6}, "Texel density", "Shape: Parts"),
    ({"coverage": 0.1}, "Coverage", "mark a seam across the surface"),
    ({"coverage": 0.1, "parts": 1}, "Coverage", "mark a seam across the surface"),
    ({"coverage": 0.1, "parts": 2}, "Coverage", "Pack Only"),
    ({"angle_error": 9.0}, "Angle error", "subdivide large faces, or choose Shape: Parts"),
    ({"angle_error": 9.0, "parts": 3}, "Angle error", "slider Parts"),
    ({"angle_error": 9.0, "even": 0.5}, "Angle error", "lower Even"),
    ({"angle_error": 17.0, "domain": "sphere"}, "Angle error", "is bent: to paint, choose Shape: Parts"),
    ({"flipped": 3}, "Flips", "choose Shape: Parts"),
    ({"flipped": 3, "parts": 3}, "Flips", "repair"),
], ids=str)  # fmt: skip
def test_what_is_bad_comes_with_what_to_do(addon, bad, name, advice):
    found = addon("maps.verdicts").figures(SimpleNamespace(**{**GOOD, **bad}))
    assert [figure.name for figure in found if not figure.is_good] == [name]
    assert advice in next(figure.advice for figure in found if figure.name == name)
    assert addon("maps.verdicts").is_good(SimpleNamespace(**{**GOOD, **bad})) == (name == "Coverage")


def test_islands_that_share_the_square_are_judged_by_what_they_cover_together(addon):
    found = addon("maps.verdicts").figures(SimpleNamespace(**{**GOOD, "coverage": 0.02}), 0.66)
    assert [(figure.value, figure.is_good) for figure in found if figure.name == "Coverage"] == [("66 %", True)]
    found = addon("maps.verdicts").figures(SimpleNamespace(**{**GOOD, "coverage": 0.02}), 0.2)
    assert "Pack Only" in next(figure.advice for figure in found if figure.name == "Coverage")


def test_a_sphere_is_not_blamed_for_its_layout(addon):
    """A ball in longitudes has a mean angle error of 11 degrees, however round it is."""
    assert addon("maps.verdicts").is_good(SimpleNamespace(**{**GOOD, "domain": "sphere", "angle_error": 11.4}))


def test_figures_that_a_map_has_not_are_left_out(addon):
    found = addon("maps.verdicts").figures(SimpleNamespace(**{**GOOD, "density": 0.0, "coverage": 0.0}))
    assert [figure.name for figure in found] == ["Angle error", "Flips"]
