# SPDX-License-Identifier: GPL-3.0-or-later
"""The texts of all results, reasons and warnings for the report, the status line and the command line."""

import re
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ..surfaces.errors import elements_of, kind_of
from ..surfaces.surface import Island, Numbers

if TYPE_CHECKING:
    import koebe

    from ..surfaces.opening import Opening

# For each kind of `koebe.TopologyError`: what is wrong, and what an artist can do about it.
REASONS = {
    "closed": "the surface is closed: mark a seam or delete a face, so that it has a boundary",
    "genus": "the surface has a handle ({detail}): mark a seam along it, so that it opens",
    "nonmanifold_edge": "{pairs} with more than two faces: delete the surplus faces or mark those edges as seams",
    "nonmanifold_vertex": "{vertices} where separate parts of it touch: split them",
    "nonorientable": "the surface is one-sided, like a Möbius strip: mark a seam across it",
}
MIRRORED = "the object's scale is negative, so textures look mirrored: apply the scale"
UNEVEN_TEXELS = "texels are very uneven: Unwrap to Parts makes them even"
MOST_UNEVEN = 100.0  # texel density at 95 % of the area over that at 5 %; above it the UVs cannot be painted on
MOST_SHOWN = 1000.0  # of such a ratio; larger values say no more
FEW = 6  # reasons in one message, which must fit on the screen


def cut_edges(opening: "Opening") -> int:
    """How many edges were cut."""
    return sum(len(vertices) - 1 for kind, vertices in opening.cuts if kind != "bow_tie")


def cut_line(opening: "Opening") -> str:
    """The cuts, turned faces and faces left out, and why, in one sentence."""
    edges = {kind: 0 for kind, _ in opening.cuts}
    for kind, vertices in opening.cuts:
        edges[kind] += len(vertices) - (kind != "bow_tie")

    def along(kind: str) -> str:
        return counted(edges[kind], "edge")

    words = []
    if "opening" in edges:
        words.append(f"{along('opening')} cut, as the surface is closed")
    if "handle" in edges:
        words.append(f"{along('handle')} cut through {counted(opening.handles, 'handle')}")
    if "crowded_edge" in edges:
        words.append(f"{along('crowded_edge')} with more than two faces cut")
    if "orientation" in edges:
        words.append(f"{along('orientation')} cut, as the surface is one-sided")
    if "bow_tie" in edges:
        words.append(f"faces parted in {counted(edges['bow_tie'], 'vertex', 'vertices')}")
    if len(opening.turned):
        words.append(f"{counted(len(opening.turned), 'face')} turned over in the UVs, as they face the other way")
    if len(opening.left_out):
        words.append(f"{counted(len(opening.left_out), 'face')} left out, degenerate or double")
    return "in the UVs: " + ", ".join(words)


def density_text(ratio: float) -> str:
    """A ratio of texel densities as a readable number."""
    return f"{ratio:.1f}" if ratio <= MOST_SHOWN else f"more than {MOST_SHOWN:,.0f}"


def too_uneven(one: Any) -> bool:
    """Whether a mapped island cannot be painted on: texels too uneven, or faces too small."""
    return bool(one.result.below_resolution) or one.density_ratio > MOST_UNEVEN


def failure_line(outcome: Any) -> str:
    """One line on the islands of an `Outcome` that could not be mapped or written: how many and why."""
    if outcome.not_written:
        return outcome.not_written
    failed = outcome.failed
    reasons: dict[str, list[Any]] = {}
    for one in failed:
        reasons.setdefault(explain(one.error), []).append(one)
    text = "; ".join(
        reason if len(alike) == 1 else f"{len(alike)} times: {reason}"
        for reason, alike in reasons.items()
    )
    count = "" if len(outcome.islands) == 1 else f"{len(failed)} of {len(outcome.islands)} islands: "
    return f"{outcome.name}: {count}{text}"


def run_error(outcomes: Sequence[Any]) -> dict[str, Any]:
    """The error of a run whose outcomes have no usable map: name and kind of the first error, and all reasons."""
    failed = [outcome for outcome in outcomes if outcome.failed]
    error = failed[0].failed[0].error
    kind = kind_of(error)
    found = {"name": type(error).__name__, "reason": few([failure_line(outcome) for outcome in failed], "; ")}
    return found if kind is None else {**found, "kind": kind}


def explain(error: Exception | None) -> str:
    """Why the solver refused, and what to do about it."""
    reason, count = REASONS.get(kind_of(error) or ""), len(elements_of(error))
    if reason is None:
        return str(error)
    return reason.format(
        detail=str(error).split(":")[0],
        pairs=counted(count // 2, "edge"),
        vertices=counted(count, "vertex", "vertices"),
    )


def own_warning(kind: str, text: str, elements: Iterable[int] = ()) -> dict[str, Any]:
    """A warning that the solver does not give, or not in these words."""
    return {"kind": kind, "elements": [int(element) for element in elements], "text": text}


# Places in a warning's sentence that count faces or vertices, or name a vertex; a loop keeps its number.
_COUNTS = re.compile(
    r"\b(?P<count>\d+)(?: (?P<noun>face|vertex)(?:s|\b)| (?P<vertices>vertices)\b|(?= of them too small\b))"
)
_NAMES = re.compile(
    r"(?<=\bvertex )\d+|(?<=\bedge )\d+(?=-)|(?<=\d-)\d+|(?<=the circle, the first )\d+|"
    r"(?<=a place, the first is )\d+|(?<=the disk, the first is )\d+|(?<=at vertices, the first is )\d+"
)
_FIRST = re.compile(r"(?<=the first face is )\d+|(?<=the first vertex is )\d+")


def in_mesh(numbers: Island | Numbers, warning: "koebe.Warning") -> dict[str, Any]:
    """A warning of the solver in the mesh's numbers: its elements, each once and ascending, and the counts and names in
    its text. The solver counts triangles: elements become polygons, other counts are called triangles."""
    number = {"vertices": numbers.source_vertex, "faces": numbers.triangle_face}.get(warning.of)
    old = warning["elements"]
    elements = old if number is None or not old else np.unique(number[old]).tolist()

    def count(match: re.Match[str]) -> str:
        found, noun = int(match["count"]), match["noun"] or ("vertex" if match["vertices"] else "face")
        counts_all_elements = found == len(old) and warning.of == ("vertices" if noun == "vertex" else "faces")
        if noun == "face" and not counts_all_elements:
            noun = "triangle"
        return counted(
            len(elements) if counts_all_elements else found, noun, "vertices" if noun == "vertex" else None
        )

    def name(match: re.Match[str]) -> str:
        vertex = int(match[0])
        return str(numbers.source_vertex[vertex] if vertex < len(numbers.source_vertex) else vertex)

    text = _NAMES.sub(name, _COUNTS.sub(count, warning["text"]))
    text = _FIRST.sub(str(elements[0]), text) if elements else text
    return {"kind": warning["kind"], "elements": elements, "text": text}


def counted(count: int, noun: str, plural: str | None = None) -> str:
    """A number and its noun, in the plural if needed."""
    return f"{count} {noun if count == 1 else plural or noun + 's'}"


def named_vertices(vertices: Sequence[int]) -> str:
    """The numbers of the first vertices, and how many others there are."""
    first = ", ".join(str(vertex) for vertex in vertices[:FEW])
    more = f" and {len(vertices) - FEW} more" if len(vertices) > FEW else ""
    return f"{'vertex' if len(vertices) == 1 else 'vertices'} {first}{more}"


def few(reasons: Sequence[str], between: str = ". ") -> str:
    """The first reasons as one text, and the number of the others."""
    more = [f"And {len(reasons) - FEW} more"] if len(reasons) > FEW else []
    return between.join([*reasons[:FEW], *more])


def lines(start: str, reasons: Sequence[str]) -> str:
    """An error for Blender's popup, with a line for each reason if there are several."""
    return f"{start}\n{few(reasons, chr(10))}" if len(reasons) > 1 else " ".join([start, *reasons])
