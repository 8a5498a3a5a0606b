"""What the circles tell about a shape: its conformal module, and two domains compared or laid over each other.

A domain here is whatever has `centers` (L, 2) and `radii` (L,), the unit circle first: a UniformizeResult, say.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np

from ._native import _koebe
from .errors import InputError


def _circles(domain: Any) -> tuple[np.ndarray, np.ndarray]:
    try:
        centers = np.ascontiguousarray(domain.centers, dtype=np.float64)
        radii = np.ascontiguousarray(domain.radii, dtype=np.float64)
    except AttributeError as error:
        raise InputError(f"{type(domain).__name__} has no circles: give the result of uniformize") from error
    if centers.shape != (len(radii), 2):
        raise InputError(f"there are centers of shape {centers.shape} for {len(radii)} radii")
    return centers, radii


def canonical_order(result: Any, any_outer: bool = False) -> np.ndarray:
    """An order of the loops, the outer one first, that does not depend on how they are numbered.

    By how near they are to the outer loop conformally. It jumps where two loops are alike, so compare shapes by
    module_distance of two results, or give the order yourself. any_outer: the outer loop is chosen too.
    """
    return np.array(_koebe.canonical_order(*_circles(result), any_outer), dtype=np.int32)


def conformal_module(result: Any, order: Sequence[int] | str | None = None) -> np.ndarray:
    """The conformal module of a circle domain (paper, Fig. 13): r_1, y_2, r_2, x_3, y_3, r_3, ...

    order    the loops in the order wanted, the outer one, which may be any, first; None: as in the result;
             'canonical': by canonical_order
    The second loop is moved to the middle of the unit disk and the third's centre onto the positive y axis. Returns
    3n - 3 float64 numbers for n >= 2 holes, 1 for one hole, none without: lengths in the unit disk. Equal if and only
    if a conformal map that keeps orientation and numbering takes one surface to the other. Raises InputError.
    """
    centers, radii = _circles(result)
    if isinstance(order, str):
        if order != "canonical":
            raise InputError(f"order must be None, 'canonical' or a list of loops, not {order!r}")
        order = canonical_order(result)
    elif order is not None and len(order) != len(radii):
        raise InputError(f"the order must name each of the {len(radii)} loops once")
    return _koebe.conformal_module(centers, radii, [] if order is None else [int(k) for k in order])


def module_names(loop_count: int) -> list[str]:
    """What the module's numbers are called: ['r_1', 'y_2', 'r_2', ...]."""
    return _koebe.module_names(int(loop_count))


def match_loops(a: Any, b: Any, any_outer: bool = False) -> tuple[np.ndarray, np.ndarray, float]:
    """The correspondence of the loops of two domains with the least distance of their modules.

    Returns an order of a's loops and one of b's in which corresponding loops stand at the same place, outer ones
    first, and the distance of the modules in these orders. It is symmetric, and 0 only for equal shapes. any_outer:
    the outer loop of one may correspond to a hole of the other. Raises InputError for different numbers of loops.
    """
    order_a, order_b, distance = _koebe.match_loops(*_circles(a), *_circles(b), any_outer)
    return np.array(order_a, dtype=np.int32), np.array(order_b, dtype=np.int32), distance


def module_distance(a: Any, b: Any) -> float:
    """L2 distance of two conformal modules; of two results, that in the orders that match_loops finds."""
    if hasattr(a, "radii") and hasattr(b, "radii"):
        return match_loops(a, b)[2]
    first, second = np.asarray(a, dtype=np.float64), np.asarray(b, dtype=np.float64)
    if first.ndim != 1 or first.shape != second.shape:
        raise InputError(f"modules of shapes {first.shape} and {second.shape} cannot be compared")
    return float(np.linalg.norm(first - second))


def align_domains(source: Any, target: Any, match: Sequence[int] | None = None) -> "_koebe.DomainAlignment":
    """The automorphism of the unit disk that takes the target's circles nearest to the source's, by least squares.

    match    the target's loop for each of the source's, 0 for 0; None: as match_loops finds them
    Returns an object to call with points (n, 2) of the target's disk, with the fields match, residual (root of the
    mean over the holes of squared differences of centres and radii), largest and worst (that hole), a and turn. With
    one hole the circles leave the rotation free, and without a hole everything: the free part is the identity's.
    """
    chosen = [] if match is None else [int(k) for k in match]
    return _koebe.align_domains(*_circles(source), *_circles(target), chosen)
