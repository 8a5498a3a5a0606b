# SPDX-License-Identifier: GPL-3.0-or-later
"""The solver's warnings in an artist's words: what is seen, and what to do about it."""

import csv
from collections.abc import Iterable
from typing import Any

from .option_table import table_file
from .wording import counted

# By the kind of the warning: the kind of its elements, and the sentence. {count} counts the elements in that noun,
# {are}, {have} and {them} are the words in its number, and {text} is the warning's own text. CUT_WORDS are of a surface
# that was cut open: there the mesh is not at fault.
with table_file("warnings.csv").open(encoding="utf-8", newline="") as _file:
    _ROWS = list(csv.reader(_file))[1:]
WORDS, CUT_WORDS = (
    {row[0]: ("" if row[1] == "none" else row[1], row[column]) for row in _ROWS if row[column]} for column in (3, 4)
)
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
        said = sentence.replace("{text}", text) or text
        one = found.setdefault(said, {"text": said, "of": of, "elements": set()})
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
