"""Pictures of a result: the surface and its map, by matplotlib, which is imported on first use."""

from typing import Any

import numpy as np

from ._arrays import as_values
from ._comparable import Result
from ._fields import face_angle_error_deg, log_scale_of_corners
from ._options import choice_of
from ._types import Bools, Floats, Ints, Whole
from .errors import InputError
from .io.picture import histogram
from .making.lift import LiftResult
from .maps.result import MapReport, UniformizeResult

_FIELDS = {
    "checker": "checker of the map",
    "log_scale": "log of the scale, lengths in the map per surface length",
    "angle_error": "angle error of the faces, degrees",
}
_CHECKER = 24  # squares across the map's square
_PATCHES = ((0.93, 0.95, 0.98, 1.0), (0.62, 0.74, 0.86, 1.0), (0.25, 0.45, 0.65, 1.0))  # of a solid
_DRAWN_FACES = 80000  # about, in squares
_CLOSED = 1e-3  # mean normal of a surface that is closed, up to holes


def plot(result: Any, *, field: Any = "checker", ax: Any = None) -> Any:
    """A matplotlib Figure with the surface in space and its map beside it, in the same colours.

    result  of any map: its circle domain, or its UVs. Of `flatten`: the sheets side by side. Of `lift`: the surface
            with the pattern; of a solid, which has no UVs, the outside, the inside and the walls. Of `family`: the mean
            surface, and the map of the reference. Of all others their circles, points, triangles, or bars of numbers
    field   'checker': squares of the map, 24 across, brought to the surface; a conformal map keeps their angles;
            'log_scale'; 'angle_error', degrees; or values (V,) at the vertices, (F,) at the triangles, in any unit
    ax      your own axes: plane ones for the map, 3D ones for the surface, or a pair of both. None: a new figure
    Needs matplotlib (the extra `plot`). A notebook shows the figure; elsewhere call its savefig or show.

    >>> import koebe
    >>> figure = koebe.plot(koebe.uniformize("blend_samples/face.obj"))
    >>> len(figure.axes)
    2
    """
    named = isinstance(field, str)
    if named:
        choice_of(field, "field", _FIELDS)
    if not isinstance(result, Result):
        raise TypeError(f"plot takes a result, such as of uniformize, parts or lift, not {type(result).__name__}")
    import matplotlib.pyplot as plt

    if not hasattr(result, "_layout"):
        if not named or field != "checker":
            raise InputError(f"a {type(result).__name__} is no map: it takes no field")
        return _drawn_figure(result, ax, plt)
    shown: Any = result
    vertices, drawn = shown.vertices, shown._drawn()
    triangles, (images, side) = shown.triangles[drawn], shown._layout()
    corners, images = vertices[triangles], images[drawn]
    if not len(triangles):
        raise InputError("the result has no faces to draw")
    if isinstance(result, LiftResult) and not len(result.uv):
        if not named or field != "checker":
            raise InputError(f"a solid has no UVs, and so no {field if named else 'fields'}")
        colors, scale, images = np.array(_PATCHES)[result.patch], None, np.zeros((0, 3, 2))
    else:
        if named:
            values = None if field == "checker" else _values(field, vertices, triangles, images)
        else:
            values = _given_values(field, vertices, triangles, drawn)
        if values is None:  # squares do not end at edges: coarse faces are drawn in pieces
            pieces = max(1, int(np.sqrt(_DRAWN_FACES / len(triangles))))
            corners, images = _in_pieces(corners, pieces), _in_pieces(images, pieces)
        colors, scale = _colors(values, images * (_CHECKER / side), plt)
    if ax is None:
        figure = plt.figure(figsize=(11, 5), layout="constrained")
        space = figure.add_subplot(1, 2 if len(images) else 1, 1, projection="3d")
        plane = figure.add_subplot(1, 2, 2) if len(images) else None
    else:
        figure, space, plane = _axes(ax)
    if space is not None:
        _draw_surface(space, corners, colors, _in_front_of(vertices, triangles))
    if plane is not None:
        _draw_map(plane, images, colors, getattr(result, "_base", result), plt)
    if scale is not None:
        figure.colorbar(scale, ax=space if plane is None else plane, shrink=0.7, label=_FIELDS[field] if named else "")
    return figure


def _drawn_figure(result: Result, ax: Any, plt: Any) -> Any:
    """The figure of a result that is no map."""
    from matplotlib.collections import PolyCollection

    drawing = result._drawing()
    if not drawing:
        raise InputError(f"a {type(result).__name__} has nothing to draw")
    corners = np.asarray(drawing.get("corners", np.zeros((0, 3, 2))), np.float64)
    # A surface in space.
    if corners.shape[2] == 3:
        if ax is None:
            ax = plt.figure(figsize=(6, 6), layout="constrained").add_subplot(projection="3d")
        figure, space, _ = _axes(ax)
        if space is None:
            raise TypeError("ax must be 3D axes for a surface")
        corners = corners[np.isfinite(corners).all(axis=(1, 2))]
        view = _in_front_of(corners.reshape(-1, 3), np.arange(3 * len(corners)).reshape(-1, 3))
        _draw_surface(space, corners, np.tile(_PATCHES[0], (len(corners), 1)), view, edges="#1d4e89")
        return figure
    # A drawing in the plane: faces, circles, points, or the bars of a histogram.
    if ax is None:
        ax = plt.figure(figsize=(6, 6), layout="constrained").add_subplot()
    figure, _, plane = _axes(ax)
    if plane is None:
        raise TypeError("ax must be plane axes")
    if "corners" in drawing:
        plane.add_collection(PolyCollection(corners, facecolors=[_PATCHES[0]], edgecolors="#1d4e89", linewidths=0.2))
    for center, radius in zip(*drawing.get("circles", ((), ())), strict=True):
        plane.add_patch(plt.Circle(center, radius, fill=False, color="#1d4e89", linewidth=1.2))
    if "points" in drawing:
        plane.scatter(*np.asarray(drawing["points"]).T, s=2, color="#1d4e89")
    bars = histogram(drawing["values"]) if "values" in drawing else np.asarray(drawing.get("bars", np.zeros((0, 2))))
    plane.bar(np.arange(len(bars)), bars[:, 1] - bars[:, 0], bottom=bars[:, 0], color="#1d4e89")
    plane.autoscale_view()
    if not len(bars):
        plane.set(aspect="equal")
        plane.set_axis_off()
    return figure


def _axes(ax: Any) -> tuple[Any, Any, Any]:
    """The figure, and the 3D axes and the plane ones, or None."""
    given = list(ax) if isinstance(ax, (tuple, list, np.ndarray)) else [ax]
    if not given or any(not hasattr(one, "add_collection") for one in given):
        raise TypeError(f"ax must be axes of matplotlib, or a pair of them, not {ax!r}")
    space = [one for one in given if hasattr(one, "add_collection3d")]
    plane = [one for one in given if not hasattr(one, "add_collection3d")]
    if len(space) > 1 or len(plane) > 1:
        raise TypeError("ax must be 3D axes, plane ones, or one of each")
    return given[0].figure, next(iter(space), None), next(iter(plane), None)


def _draw_surface(space: Any, corners: Floats, colors: Floats, view: tuple[float, float], edges: Any = None) -> None:
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection

    edges = colors if edges is None else edges
    space.add_collection3d(Poly3DCollection(corners, facecolors=colors, edgecolors=edges, linewidths=0.3))
    space.view_init(*view)
    low, high = corners.min(axis=(0, 1)), corners.max(axis=(0, 1))
    for axis, a, b in zip("xyz", low, high, strict=True):
        getattr(space, f"set_{axis}lim")(a, b)
    space.set_box_aspect(np.maximum(high - low, 1e-9 * (high - low).max()))
    space.set_axis_off()


def _draw_map(plane: Any, images: Floats, colors: Floats, result: MapReport | LiftResult, plt: Any) -> None:
    from matplotlib.collections import PolyCollection

    plane.add_collection(PolyCollection(images, facecolors=colors, edgecolors=colors, linewidths=0.3))
    if isinstance(result, UniformizeResult):
        for center, radius in zip(result.centers, result.radii, strict=True):
            plane.add_patch(plt.Circle(center, radius, fill=False, color="#1d4e89", linewidth=1.2))
        low, high = np.array([-1.0, -1.0]), np.array([1.0, 1.0])
    else:
        low, high = np.nanmin(images, axis=(0, 1)), np.nanmax(images, axis=(0, 1))
    room = 0.015 * (high - low).max()
    plane.set(xlim=(low[0] - room, high[0] + room), ylim=(low[1] - room, high[1] + room), aspect="equal")
    plane.set_axis_off()


def _in_front_of(vertices: Floats, triangles: Whole) -> tuple[float, float]:
    """Elevation and azimuth, degrees, of a view along the mean normal, with y up if the view is along z."""
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    normals = np.cross(b - a, c - a)
    normal, area = normals.sum(axis=0), np.linalg.norm(normals, axis=1).sum()
    if not np.linalg.norm(normal) > _CLOSED * area:  # a closed surface has no mean normal
        return 30.0, -60.0
    x, y, z = normal / np.linalg.norm(normal)
    level = float(np.hypot(x, y))
    return float(np.degrees(np.arctan2(z, level))), float(np.degrees(np.arctan2(y, x))) if level > 0.5 else -90.0


def _in_pieces(corners: Floats, count: int) -> Floats:
    """Triangles (F, 3, d) with each edge cut into so many: (F * count^2, 3, d)."""
    steps = [(i, j) for i in range(count) for j in range(count - i)]
    upright = [((i, j), (i + 1, j), (i, j + 1)) for i, j in steps]
    turned = [((i + 1, j), (i + 1, j + 1), (i, j + 1)) for i, j in steps if i + j + 1 < count]
    shares = np.array(upright + turned, dtype=float) / count
    weights = np.concatenate([1.0 - shares.sum(axis=2, keepdims=True), shares], axis=2)  # (count^2, 3, 3)
    return np.einsum("pkc,fcd->fpkd", weights, corners).reshape(-1, 3, corners.shape[2])


def _values(field: str, vertices: Floats, triangles: Ints, images: Floats) -> Floats:
    """(F,) the field's value of each triangle, with images (F, 3, 2)."""
    if field == "log_scale":
        return log_scale_of_corners(vertices, triangles, images)[triangles].mean(axis=1)
    own = np.arange(3 * len(triangles)).reshape(-1, 3)  # each corner by itself
    return face_angle_error_deg(vertices[triangles].reshape(-1, 3), own, images.reshape(-1, 2))


def _given_values(field: Any, vertices: Floats, triangles: Ints, drawn: Bools) -> Floats:
    """(F,) values of the drawn triangles, from values at the vertices or at all triangles. Raises InputError."""
    values = as_values(field, "the field")
    if values.dtype.kind not in "fiub" or values.shape not in ((len(vertices),), (len(drawn),)):
        raise InputError(
            f"the field must be ({len(vertices)},) numbers at the vertices or ({len(drawn)},) at the triangles, "
            f"not {values.shape} {values.dtype}"
        )
    return values[triangles].mean(axis=1) if len(values) == len(vertices) else values[drawn].astype(np.float64)


def _colors(values: Floats | None, squares: Floats, plt: Any) -> tuple[Floats, Any]:
    """Colours (n, 4) of the drawn triangles, by their values or by the squares that hold their images (n, 3, 2), and
    what a colour bar explains, or None."""
    if values is None:
        middle = np.nan_to_num(squares.mean(axis=1))
        dark = np.floor(middle).astype(int).sum(axis=1) % 2
        return np.array([_PATCHES[0], _PATCHES[2]])[dark], None
    known = values[np.isfinite(values)]
    # The worst hundredth of the faces must not use up the colours.
    limits = np.percentile(known, [1, 99]) if len(known) else (0.0, 1.0)
    scale = plt.cm.ScalarMappable(plt.Normalize(*limits), "viridis")
    return scale.to_rgba(np.where(np.isfinite(values), values, limits[0])), scale
