# SPDX-License-Identifier: GPL-3.0-or-later
"""The solver's warnings in an artist's words: what is seen, and what to do about it."""

from collections.abc import Iterable
from typing import Any

from .wording import counted

# By the kind of the warning: what its elements are, and the sentence. {count} counts them in that noun.
WORDS = {
    "collapsed_faces": ("faces", "{count} without an area: Mesh ▸ Clean Up ▸ Degenerate Dissolve removes them"),
    "unused_vertices": ("vertices", "{count} without a face: Mesh ▸ Clean Up ▸ Delete Loose removes them"),
    "reoriented_faces": (
        "faces", "{count} looking the other way: Mesh ▸ Normals ▸ Recalculate Outside turns them"),
    "thin_faces": ("", "some faces are so thin that rounding shows: dissolve them, or merge their vertices"),
    "coarse_mesh": ("", "there are too few vertices between the holes for round ones: subdivide the surface there"),
    "no_flux": ("", "a part of a boundary shrinks almost to a point: a seam near it gives it room"),
    "not_converged": ("", "the circles were still moving at the end: raise Sweeps, under Accuracy"),
    "no_circles": ("", "no round holes were found: subdivide the surface, or take Shape: Parts"),
    "lost_circles": ("loops", "{count} too small to be measured in the UVs: a seam near it gives it room"),
    "shrunk_circles": ("loops", "{count} made smaller, as it met another boundary: subdivide the surface between them"),
    "replaced_circles": ("loops", "{count} moved a little, so that no face turns over: subdivide the surface there"),
    "flaps": (
        "faces", "{count} hanging on a boundary by one edge alone, drawn along it: delete them, or join them better"),
    "off_circle": ("vertices", "{count} of a boundary had to leave the circle: subdivide the faces there"),
    "below_resolution": (
        "faces", "{count} too small in the UVs for any image: take Shape: Parts, or put a seam near them"),
    "flipped": ("faces", "{count} turned over in the UVs: take Shape: Parts, or repair the faces there"),
    "not_one_to_one": ("faces", "the UVs lie over each other: take Shape: Parts"),
    "out_of_place": ("vertices", "the vertex for the centre could not be brought there: choose another one"),
    "not_even": ("faces", "{count} not made more even, as faces would turn over: take a smaller Even, or more parts"),
    "lost_area": ("faces", "{count} without an area in the UVs: take Shape: Parts"),
    "left_out": (
        "faces", "{count} without a place, as they repeat another face: Mesh ▸ Clean Up ▸ Merge by Distance"),
    "not_mapped": ("faces", "{count} without a map, all at one point: repair the mesh there"),
}  # fmt: skip
NOUNS = {"faces": ("face", None), "vertices": ("vertex", "vertices"), "loops": ("boundary", "boundaries")}
WHOLE = "all of it"  # what a warning is about that names no elements
SELECTED = ("faces", "vertices")  # that can be selected by their numbers in the mesh


def in_words(warnings: Iterable[dict[str, Any]]) -> list[dict[str, Any]]:
    """Warnings of one map, in the mesh's numbers, as sentences: one for each kind, with all of its elements.

    Each is a dict: text, `of` and `elements`, where these can be selected. What has no words keeps its text.
    """
    found: dict[str, dict[str, Any]] = {}
    for warning in warnings:
        kind, text = warning["kind"], warning["text"]
        of, sentence = WORDS.get(kind, ("", ""))
        one = found.setdefault(kind if sentence else text, {"text": sentence or text, "of": of, "elements": set()})
        one["elements"].update(warning["elements"] if of else ())
    return [_filled(**one) for one in found.values()]


def _filled(text: str, of: str, elements: set[int]) -> dict[str, Any]:
    count = counted(len(elements), *NOUNS[of]) if elements else WHOLE
    selectable = of in SELECTED and bool(elements)
    said: dict[str, Any] = {"text": text.replace("{count}", count)}
    return {**said, "of": of, "elements": sorted(elements)} if selectable else said
