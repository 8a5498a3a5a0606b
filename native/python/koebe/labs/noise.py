"""How sure a shape's numbers are under noise."""

import math
from collections.abc import Sequence
from numbers import Real
from typing import Any

import numpy as np

from .._native import _koebe
from .._options import whole
from .._progress import Run, Shown
from .._types import Floats
from .._watched import watched
from ..errors import InputError, KoebeError, OptionError, SolverError
from ..maps.input import surface_of
from ..maps.result import UniformizeResult
from ..maps.source import Source
from ..maps.surface import Surface
from .shapes import chosen_order, conformal_module

_MEDIAN = 0.6744897501960817  # of |x| for a normal x with the standard deviation 1
_PROBES = 64  # random vectors for the length of the filter's rows: an error of 1 / sqrt(2 * 64) = 9 % in each
_LEAST_VERTICES = 20


def vertex_noise(vertices: Any, triangles: Any = None, *, mask: Any = None) -> float:
    """An estimate of the noise in the positions of a surface's vertices: the standard deviation of each coordinate.

    vertices, triangles, mask    as for `uniformize`
    The mean of the neighbours is taken from each position, twice: of a smooth surface little is left, of noise most.
    Of that the part along the normal counts, by its median, at vertices at least three edges away from a rim. It is in
    the unit of the vertices. It says too much where the surface bends within an edge (sharp edges, a coarse mesh), and
    too little where noise is alike at neighbours (a smoothed scan). Raises InputError for fewer than 20 such vertices.

    >>> import koebe
    >>> points, faces = koebe.uniformize("blend_samples/face.obj").surface
    >>> import numpy as np
    >>> noisy = points + 0.02 * np.random.default_rng(1).normal(size=points.shape)
    >>> 0.017 < koebe.vertex_noise(noisy, faces) < 0.025
    True
    """
    source = surface_of(vertices, triangles, mask=mask)
    return _noise_of(source)


def _noise_of(source: Source) -> float:
    count = len(source.vertices)
    # Edges and degrees; `filtered` is I minus the mean of the neighbours.
    edges = np.sort(source.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    edges, times = np.unique(edges, axis=0, return_counts=True)
    ends = np.concatenate([edges, edges[:, ::-1]])
    degree = np.maximum(np.bincount(ends[:, 0], minlength=count), 1)

    def filtered(values: Floats) -> Floats:
        sums = np.stack([np.bincount(ends[:, 0], column[ends[:, 1]], minlength=count) for column in values.T], axis=1)
        return values - sums / degree[:, None]

    # Vertices within two edges of a rim are left out: their filter is another.
    near = ~source.used
    near[edges[times == 1]] = True
    for _ in range(2):
        near[ends[near[ends[:, 1]], 0]] = True
    if (~near).sum() < _LEAST_VERTICES:
        raise InputError(f"the noise needs {_LEAST_VERTICES} vertices away from rims, and there are {(~near).sum()}")
    # Normals, weighted by area. Along them the position, filtered twice, is noise: a smooth surface nearly vanishes.
    a, b, c = (source.vertices[source.triangles[:, k]] for k in range(3))
    cross = np.cross(b - a, c - a)
    normal = np.stack(
        [np.bincount(source.triangles.ravel(), np.repeat(column, 3), minlength=count) for column in cross.T], axis=1
    )
    # How much the filter lets through at each vertex, by random probes.
    probes = np.random.default_rng(0).normal(size=(count, _PROBES))
    rows = np.sqrt((filtered(filtered(probes)) ** 2).mean(axis=1))
    rest = np.einsum("vk,vk->v", filtered(filtered(source.vertices)), normal)
    known = ~near & (length := np.linalg.norm(normal, axis=1)).astype(bool)
    return float(np.median(np.abs(rest[known]) / (length[known] * rows[known])) / _MEDIAN)


@watched()
def noise_error(
    result: UniformizeResult,
    *,
    noise: float | None = None,
    order: Sequence[int] | str | None = None,
    samples: int = 24,
    seed: int = 0,
    progress: Shown = None,
    cancel: "_koebe.CancelToken | None" = None,
) -> Floats:
    """Error bars of conformal_module(result, order=order), lengths in the unit disk: the effect of noise in a scan.

    noise     standard deviation of each coordinate of a vertex, in the surface's unit; None: vertex_noise of it
    samples   surfaces with further noise that are mapped: each takes about half the time of a map
    seed      of the random numbers: the same seed gives the same bars
    progress, cancel    as for `uniformize`
    A parametric bootstrap: the surface gets as much noise again, and a bar is the mean change of its number plus twice
    its standard deviation, as sizes. It holds for independent noise of up to a tenth of an edge. It says nothing about
    the coarseness of the mesh: that is module_error; add the squares of both. docs/shapes.md has figures, and says
    where the bars fail. Raises InputError, Cancelled, and SolverError if fewer than half of the noisy surfaces can be
    mapped.

    >>> import koebe
    >>> result = koebe.uniformize("blend_samples/face.obj")
    >>> bars = koebe.noise_error(result, noise=0.01, samples=4)
    >>> bool((bars > 0).all() and (bars < 0.05).all())
    True
    """
    if not isinstance(result, UniformizeResult):
        raise TypeError(f"noise_error takes a result of uniformize, not {type(result).__name__}")
    count, chosen = whole(samples, "samples", least=2), chosen_order(result, order)
    module = conformal_module(result, order=chosen.tolist())
    if noise is not None and (not isinstance(noise, Real) or isinstance(noise, (bool, np.bool_))):
        raise TypeError(f"noise must be a number, not {noise!r}")
    sigma = vertex_noise(*result.surface) if noise is None else float(noise)
    if not (math.isfinite(sigma) and sigma >= 0.0):
        raise OptionError(f"noise must be a finite number from 0, not {noise!r}")
    random = np.random.default_rng(whole(seed, "seed", least=0))
    surface = Surface(*result.surface, outer=int(result.loops[0][0]))
    firsts, changes = [int(loop[0]) for loop in result.loops], []
    run = Run(progress, cancel)
    for number in range(count):
        run.at(number / count, "map")
        try:
            with np.errstate(over="ignore"):
                moved = result.vertices + sigma * random.normal(size=result.vertices.shape)
            noisy = surface.uniformize(moved, cancel=run.cancel)
            place = [next(k for k, loop in enumerate(noisy.loops) if first in loop) for first in firsts]
            there = _koebe.conformal_module(noisy.centers, noisy.radii, np.array(place, np.int32)[chosen])
        except KoebeError:  # too much noise for this surface
            surface = Surface(*result.surface, outer=firsts[0])
            continue
        changes.append(there - module)
    run.at(1.0, "finish")
    if 2 * len(changes) < count or len(changes) < 2:
        raise SolverError(f"with this noise {count - len(changes)} of {count} surfaces cannot be mapped")
    moves = np.array(changes)
    return np.abs(moves.mean(axis=0)) + 2.0 * moves.std(axis=0, ddof=1)
