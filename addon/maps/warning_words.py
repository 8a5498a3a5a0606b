# SPDX-License-Identifier: GPL-3.0-or-later
"""The solver's warnings in an artist's words: what is seen, and what to do about it."""

from collections.abc import Iterable
from typing import Any

from .wording import counted

# By the kind of the warning: the kind of its elements, and the sentence. {count} counts the elements in that noun, and
# {are}, {have} and {them} are the words in its number.
WORDS = {
    "collapsed_faces": ("faces", "{count} {have} no area. Mesh ▸ Clean Up ▸ Degenerate Dissolve removes {them}"),
    "unused_vertices": ("vertices", "{count} {are} in no face. Mesh ▸ Clean Up ▸ Delete Loose removes {them}"),
    "reoriented_faces": (
        "faces", "{count} {are} facing the other way. Mesh ▸ Normals ▸ Recalculate Outside turns {them}"),
    "thin_faces": ("", "Some faces are so thin that rounding shows: dissolve them, or merge their vertices"),
    "coarse_mesh": ("", "The mesh is too coarse for this shape: subdivide the large faces"),
    "no_flux": ("", "A part of a boundary shrinks almost to a point: mark a seam near it"),
    "not_converged": ("", "The circles were still moving at the end: raise Sweeps, under Accuracy"),
    "no_circles": ("", "No round holes were found: subdivide the surface, or choose Shape: Parts"),
    "lost_circles": ("loops", "{count} {are} too small in the UVs to be measured. Mark a seam near {them}"),
    "shrunk_circles": (
        "loops", "{count} became smaller, so that circles do not touch. Subdivide the surface there"),
    "replaced_circles": ("loops", "{count} moved a little, so that no face turns over. Subdivide the surface there"),
    "flaps": (
        "faces", "{count} at the boundary {are} squeezed against its circle. Subdivide {them}, or choose Shape: Parts"),
    "off_circle": ("vertices", "{count} {are} not on the circle of the boundary. Subdivide the faces there"),
    "below_resolution": (
        "faces", "{count} {are} too small in the UVs for any image. Choose Shape: Parts, or mark a seam near {them}"),
    "flipped": ("faces", "{count} {are} turned over in the UVs. Choose Shape: Parts, or repair these faces"),
    "not_one_to_one": ("faces", "The UVs overlap: choose Shape: Parts"),
    "out_of_place": ("vertices", "The chosen vertex could not become the centre: choose another vertex"),
    "not_even": (
        "faces", "Even has no effect on {count}, as faces would turn over. Lower Even, or choose more parts"),
    "lost_area": ("faces", ""),  # what is said of it has the share of the area
    "left_out": (
        "faces",
        "{count} {have} no UVs, because another face has the same vertices. Use Mesh ▸ Clean Up ▸ Merge by Distance"),
    "concave_polygons": (
        "faces", "{count} {are} bent inwards in the UVs: triangles may overlap there. Triangulate {them} first"),
    "not_mapped": ("faces", "{count} could not be mapped, and {are} at one point in the UVs. Repair the mesh there"),
}  # fmt: skip
# Of a surface that was cut open: there the mesh is not at fault.
CUT_WORDS = {
    "flaps": ("faces", "{count} beside a cut {are} squeezed against the circle. Mark seams where cuts may run"),
}  # fmt: skip
NOUNS = {"faces": ("face", None), "vertices": ("vertex", "vertices"), "loops": ("boundary", "boundaries")}
WHOLE = "the whole map"  # what a warning is about that names no elements
SELECTED = ("faces", "vertices")  # that can be selected by their numbers in the mesh


def of_solver(result: Any) -> list[Any]:
    """The solver's warnings about an island. Vertices at one place are no fault of it: it is cut along its seams."""
    return [warning for warning in result.warnings if warning.kind != "coincident"]


def in_words(warnings: Iterable[dict[str, Any]], is_cut: bool = False) -> list[dict[str, Any]]:
    """Warnings of one map, in the mesh's numbers, as sentences: one for each kind, with all of its elements.

    Each is a dict: text, `of` and `elements`, where these can be selected. What has no sentence keeps its text.
    @param is_cut whether the surface was cut open
    """
    sentences = {**WORDS, **CUT_WORDS} if is_cut else WORDS
    found: dict[str, dict[str, Any]] = {}
    for warning in warnings:
        kind, text = warning["kind"], warning["text"]
        of, sentence = sentences.get(kind, ("", ""))
        one = found.setdefault(kind if sentence else text, {"text": sentence or text, "of": of, "elements": set()})
        one["elements"].update(warning["elements"] if of else ())
    return [_filled(**one) for one in found.values()]


def _filled(text: str, of: str, elements: set[int]) -> dict[str, Any]:
    count = counted(len(elements), *NOUNS[of]) if elements else WHOLE
    several = len(elements) > 1
    words = {"{count}": count, "{are}": "are" if several else "is", "{have}": "have" if several else "has",
             "{them}": "them" if several else "it"}  # fmt: skip
    selectable = of in SELECTED and bool(elements)
    for place, word in words.items():
        text = text.replace(place, word)
    said: dict[str, Any] = {"text": text}
    return {**said, "of": of, "elements": sorted(elements)} if selectable else said
