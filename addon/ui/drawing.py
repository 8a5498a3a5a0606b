# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws over an editor: lines, a bar of colours, text. Coordinates are pixels of the region."""

from collections.abc import Callable

import bpy
import numpy as np

SPACES = {"VIEW_3D": bpy.types.SpaceView3D, "IMAGE_EDITOR": bpy.types.SpaceImageEditor}
TEXT = (0.92, 0.92, 0.92, 1.0)
SHADE = (0.0, 0.0, 0.0, 0.55)
BAR = (84, 160, 200, 12)  # left, from the top, width, height of the bar: below Blender's own text
TEXT_SIZE = 11  # points at a resolution scale of 1

Color = tuple[float, float, float, float]

_handles: dict[tuple[str, str], tuple[object, str]] = {}


def add(space: str, name: str, draw: Callable[[], None], when: str = "POST_PIXEL", region: str = "WINDOW") -> None:
    """Call `draw` whenever a region of an editor has been drawn. @param when "POST_VIEW": in the world's coordinates"""
    _handles[space, name] = SPACES[space].draw_handler_add(draw, (), region, when), region


def remove(space: str, name: str) -> None:
    """The reverse of `add`."""
    SPACES[space].draw_handler_remove(*_handles.pop((space, name)))


def drawn(
    *spaces: str, name: str, draw: Callable[[], None], when: str = "POST_PIXEL", region: str = "WINDOW"
) -> tuple[Callable[[], None], Callable[[], None]]:
    """What a module has as `register` and `unregister` that draws in these editors."""

    def register() -> None:
        for space in spaces:
            add(space, name, draw, when, region)

    def unregister() -> None:
        for space in spaces:
            remove(space, name)

    return register, unregister


def lines(strips: list[np.ndarray], color: Color, width: float) -> None:
    """Draw strips of points (x, y) as one batch."""
    if not strips:
        return
    points = np.concatenate(strips).astype(np.float32)
    first = np.arange(len(points), dtype=np.int32)
    ends = np.cumsum([len(strip) for strip in strips]) - 1
    first = np.delete(first, ends)  # no line starts at the last point of a strip
    segments(points, np.stack([first, first + 1], axis=1), color, width)


def segments(points: np.ndarray, pairs: np.ndarray | None, color: Color, width: float) -> None:
    """Draw lines between pairs (k, 2) of points (n, 2) in 32 bits, or (n, 3) in the world; without pairs between the
    first two, the next two…
    """
    import gpu
    from gpu_extras.batch import batch_for_shader

    from ..blender import compat

    shader = compat.flat_shader("UNIFORM_COLOR", points.shape[1])
    shader.bind()
    shader.uniform_float("color", color)
    gpu.state.blend_set("ALPHA")
    gpu.state.line_width_set(width)
    batch_for_shader(shader, "LINES", {"pos": points}, indices=pairs).draw(shader)
    gpu.state.line_width_set(1.0)
    gpu.state.blend_set("NONE")


def box(left: float, bottom: float, width: float, height: float, color: Color) -> None:
    """Fill a rectangle."""
    import gpu
    from gpu_extras.batch import batch_for_shader

    from ..blender import compat

    points = [(left + x * width, bottom + y * height) for x in (0, 1) for y in (0, 1)]
    shader = compat.flat_shader("UNIFORM_COLOR")
    shader.bind()
    shader.uniform_float("color", color)
    gpu.state.blend_set("ALPHA")
    batch_for_shader(shader, "TRI_STRIP", {"pos": points}).draw(shader)
    gpu.state.blend_set("NONE")


def text(content: str, x: float, y: float, color: Color = TEXT, centered: bool = True) -> None:
    """Write a line of text with its baseline at y, on a shadow."""
    import blf

    scale = bpy.context.preferences.system.ui_scale
    blf.size(0, TEXT_SIZE * scale)
    if centered:
        x -= blf.dimensions(0, content)[0] / 2  # type: ignore[index]
    blf.enable(0, blf.SHADOW)
    blf.shadow(0, 3, *SHADE)
    blf.color(0, *color)
    blf.position(0, x, y, 0)
    blf.draw(0, content)
    blf.disable(0, blf.SHADOW)


def color_bar(title: str, ramp: np.ndarray, marks: list[tuple[float, str]]) -> None:
    """A horizontal bar of colours (n, 3) with a title over it and marks under it."""
    from gpu_extras.batch import batch_for_shader

    from ..blender import compat

    scale = bpy.context.preferences.system.ui_scale
    left, top, width, height = (value * scale for value in BAR)
    bottom = bpy.context.region.height - top - height
    stops = [left + width * i / (len(ramp) - 1) for i in range(len(ramp))]
    points = [(x, y) for x in stops for y in (bottom, bottom + height)]
    colors = [(*map(float, color), 1.0) for color in ramp for _ in range(2)]
    shader = compat.flat_shader("SMOOTH_COLOR")
    shader.bind()
    batch_for_shader(shader, "TRI_STRIP", {"pos": points, "color": colors}).draw(shader)
    text(title, left, bottom + height + 6 * scale, centered=False)
    for place, content in marks:
        text(content, left + width * place, bottom - 14 * scale)
