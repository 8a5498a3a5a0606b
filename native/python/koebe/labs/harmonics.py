"""Closed surfaces in spherical harmonics (SPHARM), by pyshtools."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from .._arrays import as_reals
from .._comparable import Result
from .._options import whole
from .._types import Floats, Ints
from ..errors import InputError
from ..maps.sphere import SphereMap
from .corresponding import library
from .sphere_transfer import vertex_areas

_MOST_DEGREE = 128


@dataclass(frozen=True, eq=False, repr=False)
class SphereHarmonics(Result):
    """A closed surface as a series of spherical harmonics on its sphere: the result of `spharm`.

    coefficients    (3, 2, L + 1, L + 1) float64 of x, y and z, as pyshtools has them: [c, 0, l, m] of the cosine,
                    [c, 1, l, m] of the sine; real, 4-pi normalized, without the phase (-1)^m, in the surface's unit
    degree          L
    rms             root mean square distance by area of the series from the surface, at its vertices
    sphere, triangles    (V, 3) and (F, 3): where the surface's vertices lie on the unit sphere, and its triangles
    """

    coefficients: Floats
    degree: int
    rms: float
    sphere: Floats
    triangles: Ints

    def __repr__(self) -> str:
        return f"<koebe.SphereHarmonics degree {self.degree}, rms {self.rms:.3g}>"

    def _drawing(self) -> dict[str, Any]:
        return {"bars": np.column_stack([np.zeros(self.degree), np.sqrt(self.power[1:])])}

    @property
    def power(self) -> Floats:
        """(L + 1,) sum of the squared coefficients of each degree: no turn of the surface or of its sphere changes it.
        A move changes degree 0."""
        return np.asarray((self.coefficients**2).sum(axis=(0, 1, 3)))

    def points(self, degree: int | None = None, directions: Any = None) -> Floats:
        """Evaluate the series up to a degree, (n, 3) points.

        degree        None: all
        directions    (n, 3) on the sphere; None: the surface's vertices, NaN at vertices without a face
        """
        most = self.degree if degree is None else whole(degree, "degree", 0, self.degree)
        places = self.sphere if directions is None else as_reals(directions, "directions")
        if places.ndim != 2 or places.shape[1] != 3:
            raise InputError(f"directions must be (n, 3), not {places.shape}")
        known = np.isfinite(places).all(axis=1) & (np.abs(places).max(axis=1, initial=0.0) > 0.0)
        found = np.full(places.shape, np.nan)
        latitude, longitude = _angles(places[known])
        kept = self.coefficients[:, :, : most + 1, : most + 1]
        for axis in range(3):
            series = library("pyshtools", extra="harmonics").SHCoeffs.from_array(kept[axis])
            found[known, axis] = series.expand(lat=latitude, lon=longitude) if known.any() else 0.0
        return found


def _angles(points: Floats) -> tuple[Floats, Floats]:
    """Latitude and longitude, degrees."""
    level = np.hypot(points[:, 0], points[:, 1])
    return np.degrees(np.arctan2(points[:, 2], level)), np.degrees(np.arctan2(points[:, 1], points[:, 0])) % 360.0


def spharm(result: SphereMap, degree: int = 15) -> SphereHarmonics:
    """Expand a closed surface in spherical harmonics on its sphere (SPHARM), by least squares over its area.

    result    of sphere_map without holes: conformal, or with even=1 as even as it can be, so that few degrees show
              small parts, too
    degree    L, from 1 to 128; (L + 1)^2 numbers for each coordinate, at most one for four vertices
    Needs pyshtools (the extra `harmonics`). Raises InputError.

    >>> import koebe
    >>> vertices, triangles, label = koebe.fill_holes("blend_samples/face.obj", fair=True)
    >>> series = koebe.spharm(koebe.sphere_map(vertices, triangles), 8)
    >>> series.coefficients.shape, series.rms < 0.05
    ((3, 2, 9, 9), True)
    """
    if not isinstance(result, SphereMap):
        raise TypeError(f"spharm takes a result of sphere_map, not {type(result).__name__}")
    most, used = whole(degree, "degree", 1, _MOST_DEGREE), result._source.used
    if len(result.loops) or result.on_sphere["flipped"]:
        raise InputError("the surface has holes, or its map to the sphere is not one to one")
    if 4 * (most + 1) ** 2 > used.sum():
        raise InputError(f"degree {most} needs {4 * (most + 1) ** 2} vertices, and there are {used.sum()}")
    shtools = library("pyshtools", extra="harmonics")
    weights, sphere = vertex_areas(result)[used], np.where(used[:, None], result.points, np.nan)
    weights = weights / weights.sum()
    surface = result.vertices[used]
    size = float(np.abs(surface).max()) or 1.0
    latitude, longitude = _angles(sphere[used])
    coefficients = np.array(
        [shtools.expand.SHExpandWLSQ(column, weights, latitude, longitude, most)[0] for column in surface.T / size]
    )
    if not np.isfinite(coefficients).all():
        raise InputError("the vertices lie too unevenly on the sphere for this degree")
    series = SphereHarmonics(size * coefficients, most, 0.0, sphere, result.triangles)
    away = np.linalg.norm(series.points()[used] / size - surface / size, axis=1)
    rms = size * float(np.sqrt(weights @ away**2))
    return SphereHarmonics(series.coefficients, most, rms, sphere, result.triangles)
