# SPDX-License-Identifier: GPL-3.0-or-later
"""The solver's warnings in an artist's words: what is seen, and what to do about it."""

from collections.abc import Iterable
from typing import Any

from .wording import counted

# By the kind of the warning: what its elements are, and the sentence. {count} counts them in that noun.
WORDS = {
    "collapsed_faces": ("faces", "Without an area: {count}. Mesh ▸ Clean Up ▸ Degenerate Dissolve removes them"),
    "unused_vertices": ("vertices", "Without a face: {count}. Mesh ▸ Clean Up ▸ Delete Loose removes them"),
    "reoriented_faces": ("faces", "Looking the other way: {count}. Mesh ▸ Normals ▸ Recalculate Outside turns them"),
    "thin_faces": ("", "Some faces are so thin that rounding shows: dissolve them, or merge their vertices"),
    "coarse_mesh": ("", "There are too few vertices between the holes for round ones: subdivide the surface there"),
    "no_flux": ("", "A part of a boundary shrinks almost to a point: a seam near it gives it room"),
    "not_converged": ("", "The circles were still moving at the end: raise Sweeps, under Accuracy"),
    "no_circles": ("", "No round holes were found: subdivide the surface, or take Shape: Parts"),
    "lost_circles": ("loops", "Too small to be measured in the UVs: {count}. A seam nearby gives more room"),
    "shrunk_circles": ("loops", "Made smaller, as it met another boundary: {count}. Subdivide the surface in between"),
    "replaced_circles": ("loops", "Moved a little, so that no face turns over: {count}. Subdivide the surface there"),
    "flaps": ("faces", "Hanging on a boundary by one edge alone: {count}. Delete them, or join them better"),
    "off_circle": ("vertices", "Not on the circle of their boundary: {count}. Subdivide the faces there"),
    "below_resolution": (
        "faces", "Too small in the UVs for any image: {count}. Take Shape: Parts, or put a seam near them"),
    "flipped": ("faces", "Turned over in the UVs: {count}. Take Shape: Parts, or repair the faces there"),
    "not_one_to_one": ("faces", "The UVs lie over each other: take Shape: Parts"),
    "out_of_place": ("vertices", "The vertex for the centre could not be brought there: choose another one"),
    "not_even": (
        "faces", "Not made more even, as faces would turn over: {count}. Take a smaller Even, or more parts"),
    "lost_area": ("faces", ""),  # what is said of it has the share of the area
    "left_out": (
        "faces", "Without a place, as they repeat another face: {count}. Mesh ▸ Clean Up ▸ Merge by Distance"),
    "not_mapped": ("faces", "Without a map, all at one point: {count}. Repair the mesh there"),
}  # fmt: skip
NOUNS = {"faces": ("face", None), "vertices": ("vertex", "vertices"), "loops": ("boundary", "boundaries")}
WHOLE = "the whole map"  # what a warning is about that names no elements
SELECTED = ("faces", "vertices")  # that can be selected by their numbers in the mesh


def in_words(warnings: Iterable[dict[str, Any]]) -> list[dict[str, Any]]:
    """Warnings of one map, in the mesh's numbers, as sentences: one for each kind, with all of its elements.

    Each is a dict: text, `of` and `elements`, where these can be selected. What has no sentence keeps its text.
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
