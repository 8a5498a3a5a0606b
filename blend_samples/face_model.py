"""The face samples: boundary curves drawn on the face, and the mesh between them."""

import face_expression
import face_surface
import numpy as np
from surface_mesher import Surface, closed_spline, mesh_surface, refine

AHEAD = np.array([0.0, 1.0, 0.0])
UPWARD = np.array([0.0, 0.0, 1.0])

EYE = [
    (0.150, -0.030), (0.165, -0.012), (0.215, 0.040), (0.275, 0.068), (0.345, 0.062), (0.405, 0.030),
    (0.440, -0.004), (0.432, -0.014), (0.390, -0.036), (0.330, -0.056), (0.260, -0.058), (0.200, -0.045),
    (0.162, -0.036),
]  # fmt: skip
UPPER_LIP = [(0.256, -0.671), (0.248, -0.662), (0.20, -0.658), (0.13, -0.652), (0.06, -0.650)]
LOWER_LIP = [(0.06, -0.696), (0.13, -0.692), (0.20, -0.683), (0.246, -0.679)]
NOSTRIL = (0.066, -1.045)
NOSTRIL_RADII = (0.030, 0.050)

# Where the mesh is finer, on the side x > 0: center, reach, and by how much.
FINE = [
    ((0.29, -0.83, 0.0), 0.28, 0.75),
    ((0.0, -0.95, -0.66), 0.32, 0.75),
    ((0.0, -1.05, -0.40), 0.25, 0.75),
    ((0.07, -1.05, -0.44), 0.10, 1.10),
    ((0.25, -0.89, -0.67), 0.09, 1.12),
    ((0.15, -0.82, -0.03), 0.08, 1.07),
    ((0.44, -0.75, -0.005), 0.08, 1.07),
]


def five_holes():
    """Two eyes, mouth and two nostrils; about 20,000 triangles."""
    return _mesh(0.0190, _holes())


def surprised():
    """The same face, surprised, meshed otherwise: eyes wide, jaw down."""
    points, triangles = _mesh(0.0205, _holes())
    return face_expression.surprised(points), triangles


def dense():
    """The same with four piercings (both brows, both cheeks), about 150,000 triangles."""
    piercings = [(0.33, 0.27, 0.022), (-0.33, 0.27, 0.022), (0.36, -0.52, 0.020), (-0.36, -0.52, 0.020)]
    rounds = [_seen_from_ahead(_circle((x, z), (r, r))) for x, z, r in piercings]
    points, triangles = _mesh(0.0137, _holes() + rounds)
    return refine(points, triangles, face_surface.project)


def _mesh(spacing, holes):
    surface = Surface(
        face_surface.chart,
        face_surface.lift,
        lambda p: face_surface.project(p, 2),
        lambda p: spacing * _coarseness(p),
    )
    return mesh_surface(surface, _outline(), holes)


def _coarseness(p):
    """Edge length relative to the plain parts of the face: finer around its features, finest at the corners of eyes
    and mouth, where the map stretches most."""
    side = np.column_stack([np.abs(p[:, 0]), p[:, 1:]])
    fine = [gain * np.exp(-((side - center) ** 2).sum(axis=1) / size**2) for center, size, gain in FINE]
    return 1.35 - np.max(fine, axis=0)


def _outline():
    """From the hairline along the temples and the jaw to below the chin, counterclockwise as seen from ahead."""
    side = [(0.45, -1.16), (0.85, -0.92), (1.08, -0.55), (1.15, -0.1), (1.10, 0.32), (0.90, 0.66), (0.50, 0.86)]
    drawing = [(0.0, -1.24), *side, (0.0, 0.92), *((-x, y) for x, y in reversed(side))]
    return face_surface.lift(closed_spline(drawing))


def _holes():
    mirrored = np.array([-1.0, 1.0])
    eye, mouth = np.array(EYE), UPPER_LIP + [(-x, z) for x, z in reversed(UPPER_LIP)]
    mouth += [(-x, z) for x, z in reversed(LOWER_LIP)] + LOWER_LIP
    nostril = _circle(NOSTRIL, NOSTRIL_RADII)
    return [
        _seen_from_ahead(closed_spline(eye)),
        _seen_from_ahead(closed_spline(eye * mirrored)),
        _seen_from_ahead(closed_spline(mouth)),
        _seen_from_below(nostril),
        _seen_from_below(nostril * mirrored),
    ]


def _circle(center, radii, count=64):
    angle = np.arange(count) * 2 * np.pi / count
    return np.array(center) + np.array(radii) * np.stack([np.cos(angle), np.sin(angle)], axis=1)


def _seen_from_ahead(drawing):
    """A drawing in (x, z), thrown on the face along +y."""
    start = np.stack([drawing[:, 0], np.full(len(drawing), -1.5), drawing[:, 1]], axis=1)
    return face_surface.cast(start, np.broadcast_to(AHEAD, start.shape))


def _seen_from_below(drawing):
    """A drawing in (x, y), thrown on the underside of the nose along +z."""
    start = np.stack([drawing[:, 0], drawing[:, 1], np.full(len(drawing), -0.55)], axis=1)
    return face_surface.cast(start, np.broadcast_to(UPWARD, start.shape))
