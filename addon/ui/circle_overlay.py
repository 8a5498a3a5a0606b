# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the circles of the last run over the UVs in the UV Editor, with the report's numbers."""

import bisect
from collections.abc import Iterator

import bpy
import numpy as np

from ..blender import sequence_player
from ..blender.targets import target_objects
from ..maps.option_table import LARGEST
from ..maps.options import label_of
from ..operators.even_slider import UV_OT_koebe_even
from ..operators.moebius import UV_OT_koebe_moebius
from ..state.run_report import KoebeIslandReport, report_of
from . import drawing

RIM, HOLE = (1.0, 1.0, 1.0, 0.55), (1.0, 0.62, 0.12, 0.95)
EDGES = (0.75, 0.75, 0.75, 0.3)
SEGMENTS = (12, 24, 48, 96)  # of circles up to a radius of so many pixels, and of larger ones
PIXELS = (8.0, 30.0, 120.0)
WIDTH = 2.0
ROOM = 9.0  # pixels of radius that hold a number; smaller circles have it outside, above to the right
SMALLEST_NUMBER = 3.0  # pixels of radius; smaller circles have no number


def visible_islands(context: bpy.types.Context) -> Iterator[KoebeIslandReport]:
    """Islands of the report whose circles lie at the UVs that the UV Editor shows, of a sequence the present frame's.
    """
    # In Edit Mode Blender shows the UVs that the mesh has, which are the first frame's.
    now = context.scene.frame_current if context.mode == "OBJECT" else -LARGEST
    shown: dict[str, tuple[str, str]] = {}  # by object: layer and shape
    for obj in target_objects(context):
        active = obj.data.uv_layers.active
        if active is not None and obj.name != UV_OT_koebe_even.dragged:
            frame = sequence_player.frame_shown(obj, active.name, now)
            shown[obj.name] = (active.name, "") if frame is None else ("", label_of(frame))
    for entry in report_of(context).islands:
        layer, shape = shown.get(entry.owner_name, ("", ""))
        if entry.mapped and entry.layer == layer and (entry.shape == shape if shape else layer):
            yield entry


def unit_circle(segments: int) -> np.ndarray:
    """(segments + 1, 2): once round, the first point again at the end."""
    angles = 2.0 * np.pi * np.arange(segments + 1) / segments
    return np.stack([np.cos(angles), np.sin(angles)], axis=1)


def draw_dragged(context: bpy.types.Context) -> None:
    """Draw the edges of the dragged domain, as Blender shows none in Object Mode, where drags happen."""
    shown = UV_OT_koebe_moebius.shown
    if shown is None:
        return
    to_region = context.region.view2d.view_to_region
    start, end = (complex(*to_region(x, x, clip=False)) for x in (0.0, 1.0))
    pixels = start + ((end - start).real * shown.real + 1j * (end - start).imag * shown.imag)
    points = np.ascontiguousarray(pixels.ravel(), dtype=np.complex64).view(np.float32).reshape(-1, 2)
    drawing.segments(points, None, EDGES, 1.0)


def draw() -> None:
    """Draw the circles, if they are switched on."""
    context = bpy.context
    space, report = context.space_data, report_of(context)
    if space.mode != "UV" or context.mode not in {"OBJECT", "EDIT_MESH"}:
        return
    draw_dragged(context)
    if not report.show_circles:
        return
    # Circles in pixels, with as many segments as their size asks for.
    to_region = context.region.view2d.view_to_region
    units = [unit_circle(count) for count in SEGMENTS]
    rims: list[np.ndarray] = []
    holes: list[np.ndarray] = []
    numbers: list[tuple[str, float, float]] = []
    for entry in visible_islands(context):
        for index, loop in enumerate(entry.loops):
            if loop.uv_radius == 0.0:
                continue
            x, y = to_region(*loop.uv_center, clip=False)
            right, _ = to_region(loop.uv_center[0] + loop.uv_radius, loop.uv_center[1], clip=False)
            strip = np.array([x, y]) + (right - x) * units[bisect.bisect(PIXELS, right - x)]
            (holes if index else rims).append(strip)
            if index and right - x > SMALLEST_NUMBER:
                # A number inside, or beside a circle that is too small for it.
                aside = 0.0 if right - x > ROOM else right - x + 5.0
                numbers.append((str(index), x + aside, y - 4.0 + aside))
    drawing.lines(rims, RIM, WIDTH)
    drawing.lines(holes, HOLE, WIDTH)
    for content, x, y in numbers:
        drawing.text(content, x, y)


register, unregister = drawing.drawn("IMAGE_EDITOR", name="circles", draw=draw)
