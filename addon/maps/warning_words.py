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
    "coarse_mesh": ("", "There are too few vertices between the holes to make them round: subdivide the surface there"),
    "no_flux": ("", "A part of a boundary shrinks almost to a point: mark a seam near it"),
    "not_converged": ("", "The circles were still moving at the end: raise Sweeps, under Accuracy"),
    "no_circles": ("", "No round holes were found: subdivide the surface, or choose Shape: Parts"),
    "lost_circles": ("loops", "Too small in the UVs to be measured: {count}. Mark a seam near them"),
    "shrunk_circles": ("loops", "Made smaller, so that they do not touch: {count}. Subdivide the surface between them"),
    "replaced_circles": ("loops", "Moved a little, so that no face turns over: {count}. Subdivide the surface there"),
    "flaps": ("faces", "Connected by one edge only: {count}. Delete them, or connect them better"),
    "off_circle": ("vertices", "Not on the circle of their boundary: {count}. Subdivide the faces there"),
    "below_resolution": (
        "faces", "Too small in the UVs for any image: {count}. Choose Shape: Parts, or mark a seam near them"),
    "flipped": ("faces", "Turned over in the UVs: {count}. Choose Shape: Parts, or repair these faces"),
    "not_one_to_one": ("faces", "The UVs overlap: choose Shape: Parts"),
    "out_of_place": ("vertices", "The chosen vertex could not become the centre: choose another vertex"),
    "not_even": (
        "faces", "Even has no effect here, as faces would turn over: {count}. Lower Even, or choose more parts"),
    "lost_area": ("faces", ""),  # what is said of it has the share of the area
    "left_out": (
        "faces",
        "Without UVs, because another face has the same vertices: {count}. Use Mesh ▸ Clean Up ▸ Merge by Distance"),
    "not_mapped": ("faces", "Without UVs, all at one point: {count}. Repair the mesh there"),
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
