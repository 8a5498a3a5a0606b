# SPDX-License-Identifier: GPL-3.0-or-later
"""Strips of frames as one SVG: surfaces seen from the front and their images in the disk, in one checker, with boundary
loops in colour, filled holes and captions."""

from dataclasses import dataclass, field
from html import escape

import mesh_regions
import numpy as np

PAPER, TILE, INK, FAINT = "#f7f2e8", "#a9c5cd", "#1b2a41", "#d8dde3"
LOOPS = ("#1b2a41", "#c8553d", "#2f7f5f", "#7a4f9c", "#b8860b", "#1d5f78")  # by rank, again from the second on
SHADES = (0.88, 0.79, 0.70, 0.60, 0.50, 0.38, 0.24)  # cosines of the light at which a surface darkens by a step
LIGHT = np.array([-0.35, 0.45, 0.82]) / np.linalg.norm([-0.35, 0.45, 0.82])  # in the picture: right, up, to the reader
NEAR = 0.018  # of a frame: how far outside the part that is seen a loop still shows
FONT = 'font-family="Georgia, \'DejaVu Serif\', serif"'


def loop_color(rank):
    return LOOPS[0] if rank == 0 else LOOPS[1 + (rank - 1) % (len(LOOPS) - 1)]


def gamma(rank):
    return "γ" + "".join("₀₁₂₃₄₅₆₇₈₉"[int(digit)] for digit in str(rank))


@dataclass
class Mesh:
    """What all frames of a figure share: the triangles, the loops by rank, and a checker in the coordinates of a map
    (uv, squares of side `step`), which all other maps carry along."""

    triangles: np.ndarray
    loops: list[np.ndarray]
    uv: np.ndarray
    step: float

    def __post_init__(self):
        self.loops = [np.asarray(loop) for loop in self.loops]
        self.tiles = mesh_regions.checker(self.triangles, self.uv, self.step)
        self.rims = mesh_regions.below(self.triangles, np.zeros(len(self.uv)), 1.0)

    def part(self, kept):
        """The same with some of the triangles alone."""
        return self if kept.all() else Mesh(self.triangles[kept], self.loops, self.uv, self.step)


@dataclass
class Frame:
    """One picture: parts in tenths of a unit, in a square of `size` units, and its caption."""

    caption: str = ""
    size: float = 220.0
    parts: list[str] = field(default_factory=list)

    def add(self, part):
        self.parts.append(part)
        return self


def into_frame(points, size, half=1.0, margin=8.0):
    """Points of the square [-half, half]^2, y up, as places in a frame of that size, y down."""
    scale = (size / 2 - margin) / half
    return np.asarray(points)[:, :2] * [scale, -scale] + size / 2


def fitted(points, half=1.0):
    """Points moved and scaled to fill the square [-half, half]^2."""
    low, high = points.min(axis=0), points.max(axis=0)
    return (points - (low + high) / 2) * 2 * half / (high - low).max()


def path_element(lines, style, tolerance=0.2, closed=True):
    return f'<path {style} d="{mesh_regions.path(lines, tolerance, closed)}"/>'


def draw_region(frame, mesh, places, opened=(), filled=(), lines=0.9):
    """The mesh at `places`, in its checker: the loops of `opened` as thick lines, those of `filled` with their holes in
    their colour, all others thin. Where the mesh is a part of the surface, loops are not drawn away from it."""
    here, near = near_mesh(mesh, places, NEAR * frame.size)
    rims = [places[np.append(loop, loop[0])] for loop in mesh.loops]
    around = int(np.argmax([np.ptp(rim, axis=0).prod() for rim in rims]))  # the loop that holds all the others
    region = [mesh_regions.place(rim, places) for rim in mesh.rims]
    edge = f'stroke="{INK}" stroke-width="5"'
    frame.add(path_element(region, f'fill="{PAPER}" fill-rule="evenodd" {edge}'))
    frame.add(
        path_element([mesh_regions.place(tile, places) for tile in mesh.tiles], f'fill="{TILE}" fill-rule="evenodd"')
    )
    for rank, rim in enumerate(rims):
        color = loop_color(rank)
        fill = f'fill="{color}" fill-opacity="0.28"' if rank in filled and rank != around else 'fill="none"'
        width = 10 * (2.8 if rank in opened else lines)
        style = f'stroke="{color}" stroke-width="{width:.0f}" stroke-linejoin="round"'
        closed = np.append(mesh.loops[rank], mesh.loops[rank][0])
        visible = near[closed]
        if visible.all():
            frame.add(path_element([rim], f"{fill} {style}"))
        else:
            ends = np.flatnonzero(np.diff(np.concatenate([[False], visible, [False]])))
            runs = [rim[a:b] for a, b in ends.reshape(-1, 2) if here[closed[a:b]].any()]
            frame.add(path_element(runs, f'fill="none" {style}', closed=False))
    return frame


def near_mesh(mesh, places, reach):
    """Which vertices are in the mesh; and which are, or are drawn no farther than `reach` from its boundary."""
    here = np.zeros(len(places), bool)
    here[mesh.triangles] = True
    rim = places[np.unique(mesh_regions.boundary_edges(mesh.triangles))]
    near = here.copy()
    for v in np.flatnonzero(~here):
        near[v] = ((rim - places[v]) ** 2).sum(axis=1).min() <= reach**2
    return here, near


def seen(points, tilt=0.0, turn=0.0):
    """Right, up and towards the reader, of a face that looks along -y, z up; turned about z, then tilted, degrees."""
    c, s = np.cos(np.radians(turn)), np.sin(np.radians(turn))
    x, y, z = c * points[:, 0] - s * points[:, 1], s * points[:, 0] + c * points[:, 1], points[:, 2]
    c, s = np.cos(np.radians(tilt)), np.sin(np.radians(tilt))
    return np.column_stack([x, c * z + s * y, s * z - c * y])


def brightness(points, triangles):
    """Cosine between the vertex normals and the light."""
    corner = points[triangles]
    normal = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
    total = np.zeros_like(points)
    for k in range(3):
        np.add.at(total, triangles[:, k], normal)
    return total @ LIGHT / np.maximum(np.linalg.norm(total, axis=1), 1e-300)


def shade(frame, mesh, view, places):
    """Darker where less light falls: regions between levels of the brightness, one over the other."""
    light = brightness(view, mesh.triangles)
    for level in SHADES:
        chains = mesh_regions.below(mesh.triangles, light, level)
        frame.add(
            path_element(
                [mesh_regions.place(c, places) for c in chains if len(c) > 6],
                f'fill="{INK}" fill-opacity="0.07" fill-rule="evenodd"',
                0.35,
            )
        )
    return frame


def surface_frame(caption, mesh, points, size=220.0, opened=(), filled=(), tilt=0.0, turn=0.0):
    """A surface in space, seen from the front; faces that turn away are left out."""
    view = seen(points, tilt, turn)
    places = into_frame(fitted(view[:, :2]), size)
    corner = view[mesh.triangles]
    front = mesh.part(np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])[:, 2] > 0.0)
    frame = draw_region(Frame(caption, size), front, places, opened, filled)
    return shade(frame, front, view, places)


def image_frame(caption, mesh, image, size=220.0, opened=(), filled=(), half=1.0):
    """An image in the unit disk."""
    return draw_region(Frame(caption, size), mesh, into_frame(image, size, half), opened, filled)


def turned_like(image, other):
    """The image (V, 2), turned about 0 so that it lies as nearly as it can like `other`."""
    z, w = image @ [1.0, 1j], other @ [1.0, 1j]
    total = np.vdot(z - z.mean(), w - w.mean())
    z = z * total / abs(total)
    return np.column_stack([z.real, z.imag])


def strip(frames, columns, title="", gap=12.0, line=17.0, arrows=False):
    """The frames in rows, as an SVG. A caption may have several lines."""
    size = max(frame.size for frame in frames)
    text = line * max(len(frame.caption.split("\n")) for frame in frames) + 8
    rows = -(-len(frames) // columns)
    width = columns * size + (columns + 1) * gap
    top = gap + (26 if title else 0)
    height = top + rows * (size + text + gap)
    out = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:.0f} {height:.0f}" width="{width:.0f}">',
        f'<rect width="{width:.0f}" height="{height:.0f}" fill="#ffffff"/>',
    ]
    if title:
        out.append(
            f'<text x="{width / 2:.0f}" y="{gap + 12:.0f}" {FONT} font-size="15" fill="{INK}" text-anchor="middle">'
            f"{escape(title)}</text>"
        )
    for number, frame in enumerate(frames):
        row, column = divmod(number, columns)
        x, y = gap + column * (size + gap), top + row * (size + text + gap)
        inset = (size - frame.size) / 2
        place, side = f'x="{x + inset:.1f}" y="{y + inset:.1f}"', f"{frame.size:.0f}"
        box = f'viewBox="0 0 {side}0 {side}0"'  # in tenths
        out += [f'<svg class="frame" {place} width="{side}" height="{side}" {box}>', *frame.parts, "</svg>"]
        for k, words in enumerate(frame.caption.strip("\n").split("\n")):
            out.append(
                f'<text x="{x + size / 2:.1f}" y="{y + size + line * (k + 1):.1f}" {FONT} font-size="13" fill="{INK}" '
                f'text-anchor="middle">{escape(words)}</text>'
            )
        if arrows and column + 1 < columns and number + 1 < len(frames):
            out.append(
                f'<path d="M{x + size + 1:.1f} {y + size / 2:.1f}h{gap - 4:.1f}m-4 -3.5l4 3.5l-4 3.5" fill="none" '
                f'stroke="{INK}" stroke-width="1.2"/>'
            )
    return "\n".join([*out, "</svg>\n"])
