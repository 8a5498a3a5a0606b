"""Takes points of one surface to another, through their circle domains."""

import dataclasses
import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from numbers import Integral
from typing import Any, overload

import numpy as np

from .._arrays import as_indices, as_numbers
from .._comparable import Result
from .._native import _koebe
from .._options import callback, flag, token, vertex
from .._progress import Run, Shown, Watched
from .._report_entries import Warning
from .._signatures import Unpack
from .._types import Bools, Floats, Ints, Values
from .._watched import watched
from ..errors import InputError
from ..maps.carry import carried, landmark_pairs
from ..maps.figures import Beltrami
from ..maps.result import UniformizeResult
from ..maps.sphere import SphereMap
from .fit import FitResult
from .shapes import DomainAlignment, mapped_surface
from .sphere_transfer import STIFFNESS, SphereCorrespondence, SphereOptions, sphere_transfer


@dataclass(frozen=True, eq=False)
class Correspondence(Result):
    """A point of surface a for each vertex of surface b.

    faces       (V_b,) int32 triangle of a that holds the point
    weights     (V_b, 3) its barycentric coordinates there: at least 0, sum 1
    points      (V_b, 3) the point in space, in a's unit
    distances   (V_b,) how far outside a's domain b's vertex was before it took the nearest point, disk lengths
                A vertex of b without a face corresponds to nothing: its face is -1, all else NaN
    alignment   of a's domain over b's: the corresponding loops, and by how much each of b's holes is missed
    fitted      whether the holes were then bent onto each other; False if that would have turned faces over
    uv          (V_a, 2) a's conformal domain as laid over b's; with landmarks inside faces, the faces are cut there,
                and the map is linear in the pieces
    beltrami    |mu| of the bending of a's aligned domain, mean and max over the faces, dimensionless: 0 without bending
    flipped     faces that the bending has turned over: 0
    warnings    list of Warning: 'ambiguous_match' if the loops may be matched wrongly (alignment.margin), 'not_fitted'
                if fit=True and the holes could not be bent onto each other
    """

    faces: Ints
    weights: Floats
    points: Floats
    distances: Floats
    alignment: DomainAlignment
    fitted: bool
    uv: Floats
    beltrami: Beltrami
    flipped: int
    triangles: Ints
    warnings: list[Warning] = dataclasses.field(default_factory=list)

    def _drawing(self) -> dict[str, Any]:
        return {"corners": self.uv[self.triangles]}

    @property
    def match(self) -> list[int]:
        """b's loop for each of a's."""
        return self.alignment.match

    def __repr__(self) -> str:
        return (
            f"<koebe.Correspondence {len(self.points)} points, holes miss by up to "
            f"{self.alignment.misses_in_radii.max():.3g} radii, {'fitted' if self.fitted else 'not fitted'}, "
            f"|mu| {self.beltrami['mean']:.3g} in the mean, {self.beltrami['max']:.3g} at most>"
        )

    def carry(self, field: Any, *, labels: bool | None = None) -> Values:
        """Carry to b's vertices, as (V_b,) or (V_b, k) values, a field (V_a,) or (V_a, k) at a's.

        labels   True: each vertex takes one of the labels at its triangle's corners: the label of greatest weight.
                 False: values are linear in each face. None: as labels, unless the field has floats
        A vertex of b without a face has the label -1 (False among booleans, 0 in unsigned types, no word), or the value
        NaN.
        """
        return carried(field, self.triangles, self.faces, self.weights, len(self.uv), labels)


class _OnDisks(Watched, total=False):
    match: Sequence[int] | None
    fit: bool
    landmarks: Sequence[tuple[Any, Any]] | None
    extremal: bool


class _OnSpheres(SphereOptions, total=False):
    landmarks: Sequence[tuple[Any, Any]] | None
    fields: tuple[Any, Any] | None


@overload
def transfer(
    a: UniformizeResult, b: UniformizeResult, field: None = None, **how: "Unpack[_OnDisks]"
) -> Correspondence: ...
@overload
def transfer(a: SphereMap, b: SphereMap, field: None = None, **how: "Unpack[_OnSpheres]") -> SphereCorrespondence: ...
@overload
def transfer(a: UniformizeResult, b: UniformizeResult, field: Any, **how: "Unpack[_OnDisks]") -> Values: ...
@overload
def transfer(a: SphereMap, b: SphereMap, field: Any, **how: "Unpack[_OnSpheres]") -> Values: ...
@watched()
def transfer(
    a: UniformizeResult | SphereMap,
    b: UniformizeResult | SphereMap,
    field: Any = None,
    *,
    match: Sequence[int] | None = None,
    fit: bool = True,
    landmarks: Sequence[tuple[Any, Any]] | None = None,
    extremal: bool = False,
    fields: tuple[Any, Any] | None = None,
    moebius: bool = False,
    bend: bool = False,
    stiffness: float = STIFFNESS,
    progress: Shown = None,
    cancel: "_koebe.CancelToken | None" = None,
) -> Correspondence | SphereCorrespondence | Values:
    """Carry a field of surface a to the vertices of surface b, with equally many loops, by corresponding points.

    The automorphism of the disk that brings the holes nearest lays a's circle domain over b's (align_domains). fit=True
    then bends it until the holes are the same circles: of such maps the one of least distortion, as for fit_circles.
    Nothing is lost at the rims, and no face turns over, but it is quasi-conformal where the holes differ.
    field      (V_a,) or (V_a, k) at a's vertices: returns its values at b's vertices, (V_b,) or (V_b, k): numbers as
               float64, labels (whole numbers, booleans, words) as labels. None: returns the Correspondence
    match      b's loop for each of a's, 0 for 0; None: by match_loops or, with landmarks and up to five holes, the
               match that brings circles and landmarks nearest
    landmarks  pairs (on a, on b) that must correspond. Each is a vertex, or a point (x, y, z) in the surface's unit,
               which stands for the nearest point of the surface. Then the domain is bent further, circles to circles.
               Of the maps that take landmarks to landmarks exactly and turn no face over, it takes the one with the
               least fourth power of |mu| over the surface. On a rim landmarks are vertices of both
    extremal   with landmarks: the largest |mu| becomes nearly as small as it can be, and |mu| nearly constant
    fields     of two results of sphere_map: values at a's vertices and at b's, such as sulcal depth. The sphere of b is
               turned until they correlate best. Several fields are columns: (V_a, k) and (V_b, k)
    moebius    of two results of sphere_map: not only rotations, but all Moebius maps. Landmarks must be three then
    bend       of two results of sphere_map: then bend b's sphere, without turning a face over, until the fields agree
               and landmarks meet exactly. With bend=True both may be given
    stiffness  of this bending, above 0: its elastic energy over half the mean square difference of the fields, which
               have mean 0 and standard deviation 1
    progress, cancel    as for `uniformize`
    Holes that could not be bent onto each other, and loops that may be matched wrongly, give a koebe.Warning, too.
    Without a hole, or with one, landmarks also choose the automorphism of the disk: the one that brings them nearest.
    Two results of sphere_map, of closed surfaces, correspond through the sphere: as the spheres are, or with landmarks
    or fields after a rotation of b's. Without bend=True landmarks need not meet: `misses_deg` says how near they are. A
    point (x, y, z) stands for the nearest vertex. Without a field it returns a SphereCorrespondence.
    Two results of fit_circles with the same circles already lie over each other: circle k corresponds to circle k.
    Raises InputError, also if circles are not the surface's own and for landmarks that exclude each other, and
    SolverError if no such map was found: `elements` are the landmarks, by their places in the list. Cancelled.

    >>> import koebe, numpy as np
    >>> face, other = (koebe.uniformize(f"blend_samples/{name}.obj") for name in ("face", "surprised"))
    >>> heights = koebe.transfer(face, other, face.surface[0][:, 1])
    >>> heights.shape
    (2309,)
    >>> places = koebe.transfer(face, other)
    >>> bool(np.allclose(places.weights.sum(axis=1), 1.0)), places.flipped
    (True, 0)
    """
    if isinstance(a, SphereMap) and isinstance(b, SphereMap):
        if match is not None or fit is not True or extremal is not False:
            raise InputError("match, fit and extremal are for surfaces with holes")
        found_on_sphere = sphere_transfer(a, b, landmarks, fields, moebius, bend, stiffness, Run(progress, cancel))
        return found_on_sphere if field is None else found_on_sphere.carry(field)
    if fields is not None or flag(moebius, "moebius") or flag(bend, "bend"):
        raise InputError("fields, moebius and bend are for two results of sphere_map")
    if not (isinstance(a, UniformizeResult) and isinstance(b, UniformizeResult)):
        other = next(type(one).__name__ for one in (a, b) if not isinstance(one, UniformizeResult))
        raise TypeError(f"transfer takes results of uniformize, or two of sphere_map, not {other}")
    partners = [] if match is None else as_indices(match, "match", len(b.loops), "loops").tolist()
    if match is not None and len(partners) != len(b.loops):
        raise InputError("the match must name each of the loops of b once, the outer one first")
    pairs = landmark_pairs(landmarks)
    if flag(extremal, "extremal") and not pairs:
        raise InputError("extremal needs landmarks")
    on_a, on_b = (places(result, [pair[side] for pair in pairs]) for side, result in enumerate((a, b)))
    same = on_one_template(a, b)
    if same and match is None:
        partners = list(range(len(a.loops)))
    surfaces = mapped_surface(b, same), mapped_surface(a, same)
    run = callback(progress, "progress"), token(cancel, "cancel")
    backwards = np.argsort(partners).tolist()  # the native module takes b's vertices to a
    found = _koebe.correspond(*surfaces, backwards, flag(fit, "fit"), on_b, on_a, extremal, *run)
    _forget(found, ~b._source.used)
    radii = b.radii if same else b.conformal.radii
    found["alignment"] = DomainAlignment(found["alignment"], radii, np.argsort(found["alignment"].match).tolist())
    found["warnings"] = [Warning(warning) for warning in found["warnings"]]
    for warning in found["warnings"]:
        warnings.warn(warning, stacklevel=3)
    correspondence = Correspondence(**found, triangles=a.surface[1])
    return correspondence if field is None else correspondence.carry(field)


def _forget(found: dict[str, Any], vertices: Bools) -> None:
    """Vertices of b without a face correspond to nothing."""
    for name, nothing in (("faces", -1), ("weights", np.nan), ("points", np.nan), ("distances", np.nan)):
        found[name] = np.array(found[name])
        found[name][vertices] = nothing


def on_one_template(a: Any, b: Any) -> bool:
    """Whether both are fits with the same circles."""
    if not (isinstance(a, FitResult) and isinstance(b, FitResult)) or len(a.radii) != len(b.radii):
        return False
    return bool(np.allclose(a.centers, b.centers, 0.0, 1e-9) and np.allclose(a.radii, b.radii, 0.0, 1e-9))


def places(result: UniformizeResult, points: list[Any]) -> "list[_koebe.SurfacePoint]":
    """The places of vertices and points on the surface."""
    if not points:
        return []
    numbers, positions = np.full(len(points), -1, np.int32), np.zeros((len(points), 3))
    for number, point in enumerate(points):
        if isinstance(point, Integral):
            numbers[number] = result._source.mapped(vertex(point, "landmarks"))
            continue
        position = as_numbers(point, "landmarks")
        if len(position) != 3:
            raise InputError(f"landmark {number} is neither a vertex nor a point (x, y, z)", [number], "landmarks")
        positions[number] = position
    return _koebe.surface_points(*result.surface, numbers.tolist(), positions)
