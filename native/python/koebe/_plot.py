"""Pictures of a result: the surface and its circle domain, by matplotlib, which is imported on first use."""

from typing import Any

import numpy as np

from ._options import choice_of
from ._result import UniformizeResult

_FIELDS = {
    "checker": "checker of the disk",
    "log_scale": "log of the scale, disk lengths per surface length",
    "angle_error": "angle error of the faces, degrees",
}
_CHECKER = 24  # squares across the disk
_DRAWN_FACES = 80000  # about, in squares


def plot(result: UniformizeResult, *, field: str = "checker", ax: Any = None) -> Any:
    """A matplotlib Figure with the surface in space and the circle domain beside it, in the same colours.

    field   'checker': squares of the disk, 1/12 wide, mapped to the surface, which keeps their angles; 'log_scale';
            'angle_error', degrees
    ax      your own axes: plane ones for the domain, 3D ones for the surface, or a pair of both. None: a new figure
    Needs matplotlib (the extra `plot`). A notebook shows the figure; elsewhere call its savefig or show.

    >>> import koebe
    >>> figure = koebe.plot(koebe.uniformize("blend_samples/face.obj"))
    >>> len(figure.axes)
    2
    """
    import matplotlib.pyplot as plt

    choice_of(field, "field", _FIELDS)
    vertices, triangles = result.surface
    corners, images = vertices[triangles], result.uv[triangles]
    if field == "checker":  # squares do not end at edges: coarse faces are drawn in pieces
        pieces = max(1, int(np.sqrt(_DRAWN_FACES / len(triangles))))
        corners, images = _in_pieces(corners, pieces), _in_pieces(images, pieces)
    colors, scale = _colors(result, field, images, plt)
    if ax is None:
        figure = plt.figure(figsize=(11, 5), layout="constrained")
        space, plane = figure.add_subplot(1, 2, 1, projection="3d"), figure.add_subplot(1, 2, 2)
    else:
        figure, space, plane = _axes(ax)
    if space is not None:
        _draw_surface(space, corners, colors, result)
    if plane is not None:
        _draw_domain(plane, images, colors, result, plt)
    if scale is not None:
        figure.colorbar(scale, ax=space if plane is None else plane, shrink=0.7, label=_FIELDS[field])
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


def _draw_surface(space: Any, corners: np.ndarray, colors: np.ndarray, result: UniformizeResult) -> None:
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection

    drawn = result.vertices[result.triangles]
    space.add_collection3d(Poly3DCollection(corners, facecolors=colors, edgecolors=colors, linewidths=0.3))
    space.view_init(*_in_front_of(*result.surface))
    low, high = drawn.min(axis=(0, 1)), drawn.max(axis=(0, 1))
    for axis, a, b in zip("xyz", low, high, strict=True):
        getattr(space, f"set_{axis}lim")(a, b)
    space.set_box_aspect(np.maximum(high - low, 1e-9 * (high - low).max()))
    space.set_axis_off()


def _draw_domain(plane: Any, images: np.ndarray, colors: np.ndarray, result: UniformizeResult, plt: Any) -> None:
    from matplotlib.collections import PolyCollection

    plane.add_collection(PolyCollection(images, facecolors=colors, edgecolors=colors, linewidths=0.3))
    for center, radius in zip(result.centers, result.radii, strict=True):
        plane.add_patch(plt.Circle(center, radius, fill=False, color="#1d4e89", linewidth=1.2))
    plane.set(xlim=(-1.03, 1.03), ylim=(-1.03, 1.03), aspect="equal")
    plane.set_axis_off()


def _in_front_of(vertices: np.ndarray, triangles: np.ndarray) -> tuple[float, float]:
    """Elevation and azimuth, degrees, of a view along the mean normal, with y up if the view is along z."""
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    normal = np.cross(b - a, c - a).sum(axis=0)
    x, y, z = normal / max(np.linalg.norm(normal), np.finfo(float).tiny)
    level = float(np.hypot(x, y))
    return float(np.degrees(np.arctan2(z, level))), float(np.degrees(np.arctan2(y, x))) if level > 0.5 else -90.0


def _in_pieces(corners: np.ndarray, count: int) -> np.ndarray:
    """Triangles (F, 3, d) with each edge cut into so many: (F * count^2, 3, d)."""
    steps = [(i, j) for i in range(count) for j in range(count - i)]
    upright = [((i, j), (i + 1, j), (i, j + 1)) for i, j in steps]
    turned = [((i + 1, j), (i + 1, j + 1), (i, j + 1)) for i, j in steps if i + j + 1 < count]
    shares = np.array(upright + turned, dtype=float) / count
    weights = np.concatenate([1.0 - shares.sum(axis=2, keepdims=True), shares], axis=2)  # (count^2, 3, 3)
    return np.einsum("pkc,fcd->fpkd", weights, corners).reshape(-1, 3, corners.shape[2])


def _colors(result: UniformizeResult, field: str, images: np.ndarray, plt: Any) -> tuple[np.ndarray, Any]:
    """Colours (n, 4) of the drawn triangles, with images (n, 3, 2), and what a colour bar explains, or None."""
    triangles = result.surface[1]
    if field == "checker":
        square = np.floor(images.mean(axis=1) * _CHECKER / 2).astype(int).sum(axis=1) % 2
        return np.array([[0.93, 0.95, 0.98, 1.0], [0.25, 0.45, 0.65, 1.0]])[square], None
    values = result.face_angle_error_deg if field == "angle_error" else result.log_scale[triangles].mean(axis=1)
    known = values[np.isfinite(values)]
    # The worst hundredth of the faces must not use up the colours.
    limits = np.percentile(known, [1, 99]) if len(known) else (0.0, 1.0)
    scale = plt.cm.ScalarMappable(plt.Normalize(*limits), "viridis")
    return scale.to_rgba(np.where(np.isfinite(values), values, limits[0])), scale
