"""Loops of two surfaces that correspond: by the circles or, where these leave a doubt, by areas too."""

import itertools
import math
import warnings
from typing import Any

import numpy as np

from .._fields import areas
from .._native import _koebe
from .._progress import Run
from .._report_entries import Warning
from .._signatures import Rims
from .._types import Ints
from ..errors import SolverError
from ..maps.result import UniformizeResult
from .shapes import LoopMatch, conformal_module, match_loops
from .transfer import transfer

_MOST_LOOPS = 6  # 120 matches
_MOST_TRIED = 6
_LEAST_AREA = 1e-4  # of a face, in median areas
_SURE = 0.7  # a margin of circles with which no wrong match was seen


def sure_match(reference: Any, shape: Any, rims: Rims, run: Run) -> tuple[Ints, float]:
    """The shape's loop for each of the reference's, and the margin of this match (LoopMatch).

    Circles do not tell the ends of a nearly symmetric surface apart. Of the matches that they leave, the one is taken
    by which corresponding points change areas most evenly; the margin is then 1 - its unevenness / the next one's.
    Points correspond with domains that are laid over each other or, if that leaves a doubt, bent.
    """
    found = match_loops(reference, shape, rims=rims)
    with_surfaces = isinstance(reference, UniformizeResult) and isinstance(shape, UniformizeResult)
    if found.margin >= _SURE or not with_surfaces or len(reference.loops) > _MOST_LOOPS:
        return found.match, found.margin
    matches = _candidates(reference, shape, found, rims)
    if len(matches) < 2:
        return found.match, found.margin
    first, margin = 0, found.margin
    for bent in (False, True):
        half = run.part(0.5 * bent, 0.5 + 0.5 * bent)
        scores = []
        for number, match in enumerate(matches):
            part = half.part(*((number + k) / len(matches) for k in (0, 1)))
            scores.append(_unevenness(reference, shape, match, bent, part))
        first, second = np.argsort(scores)[:2]
        margin = 1.0 - scores[first] / scores[second] if 0.0 < scores[second] < math.inf else found.margin
        if margin >= _koebe.ambiguous_margin:
            break
    return matches[first], margin


def _candidates(reference: Any, shape: Any, found: LoopMatch, rims: Rims) -> list[Ints]:
    """The matches whose modules are nearly as near as the best one's, nearest first."""
    order = found.order_a
    module = conformal_module(reference, order=order.tolist(), rims=rims)
    others = []
    for inner in itertools.permutations(range(1, len(order))):
        match = np.array([0, *inner], np.int32)
        if not np.array_equal(match, found.match):
            there = conformal_module(shape, order=match[order].tolist(), rims=rims)
            others.append((math.dist(module, there), match))
    limit = found.distance / (1.0 - _SURE)
    near = sorted((one for one in others if one[0] <= limit), key=lambda one: one[0])
    return [found.match, *(match for _, match in near[: _MOST_TRIED - 1])]


def _unevenness(reference: UniformizeResult, shape: UniformizeResult, match: Ints, bent: bool, run: Run) -> float:
    """Standard deviation, by area, of the log of the areas' ratios of corresponding faces; infinite without a map."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", Warning)
            backwards = np.argsort(match).tolist()
            places = transfer(shape, reference, match=backwards, fit=bent, progress=run.progress, cancel=run.cancel)
    except SolverError:
        return math.inf
    here, there = (areas(points[reference.triangles]) for points in (reference.vertices, places.points))
    used = here > 0.0
    here, there = here[used] / here.sum(), there[used]
    ratio = np.log(np.maximum(there, _LEAST_AREA * np.median(there)) / here)
    return float(np.sqrt(here @ (ratio - here @ ratio) ** 2)) if np.isfinite(ratio).all() else math.inf
