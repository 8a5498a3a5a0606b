# SPDX-License-Identifier: GPL-3.0-or-later
"""The pictures of docs/domains.md: docs/images/domains_torus.png, _ring.png, _sphere.png and _schottky.png.

Surfaces with the checker of their tiles, and the tiles with their copies. NumPy and the package alone; the surfaces are
those of the tests and the mug and the head of the samples. PYTHONPATH=build/python python3 scripts/domains_picture.py
"""

import struct
import sys
import zlib
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "tests" / "python"), str(ROOT / "blend_samples")]

import closed_head  # noqa: E402
import koebe  # noqa: E402
import mug  # noqa: E402
from cage_mesher import catmull_clark  # noqa: E402
from domain_surfaces import holed_ring, holed_torus  # noqa: E402
from sphere_surfaces import icosphere  # noqa: E402

SIZE, FINER = 480, 2  # pixels of a panel, and how many times finer it is drawn
PAPER = np.array([1.0, 1.0, 1.0])
INKS = np.array([[0.15, 0.32, 0.52], [0.93, 0.88, 0.78]])
BACK, RED = np.array([0.62, 0.45, 0.38]), np.array([0.85, 0.15, 0.1])


def write_png(path, image):
    pixels = (np.clip(image, 0, 1) * 255 + 0.5).astype(np.uint8)
    rows = np.concatenate([np.zeros((len(pixels), 1), np.uint8), pixels.reshape(len(pixels), -1)], axis=1)

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    head = struct.pack(">IIBBBBB", pixels.shape[1], pixels.shape[0], 8, 2, 0, 0, 0)
    chunks = chunk(b"IHDR", head), chunk(b"IDAT", zlib.compress(rows.tobytes(), 9)), chunk(b"IEND", b"")
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + b"".join(chunks))


def checker(uv, periods, cells):
    """Dark and light squares, a whole number of them along the first period."""
    side = np.hypot(*periods[0]) / cells
    angle = np.arctan2(periods[0][1], periods[0][0])
    along = (uv @ [np.cos(angle), np.sin(angle)]) / side
    across = (uv @ [-np.sin(angle), np.cos(angle)]) / side
    if len(periods) > 1:  # the other period brings squares onto squares too, if they are a little longer
        height = abs(periods[0][0] * periods[1][1] - periods[0][1] * periods[1][0]) / np.hypot(*periods[0]) / side
        rows = max(2, 2 * round(height / 2))
        lean = (periods[1] @ periods[0]) / np.hypot(*periods[0]) / side
        across = across * rows / height
        along = along - (lean - 2 * round(lean / 2)) * across / rows
    return INKS[(np.floor(along + 1e-9) + np.floor(across + 1e-9)).astype(int) % 2]


def raster(points, faces, uv, color, shade, box):
    """A panel: triangles at points (n, 3), x and y in the box, the highest z in front; color(uv) of each pixel."""
    size = SIZE * FINER
    image = np.tile(PAPER, (size, size, 1))
    depth = np.full((size, size), -np.inf)
    (x0, y0), width = box
    place = np.column_stack([(points[:, 0] - x0) / width, 1 - (points[:, 1] - y0) / width, points[:, 2]])
    place[:, :2] *= size
    for f, face in enumerate(faces):
        a, b, c = place[face]
        area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
        low = np.maximum(np.floor(np.min([a, b, c], axis=0)[:2]).astype(int), 0)
        high = np.minimum(np.ceil(np.max([a, b, c], axis=0)[:2]).astype(int) + 1, size)
        if area == 0 or (high <= low).any():
            continue
        x, y = np.meshgrid(np.arange(low[0], high[0]) + 0.5, np.arange(low[1], high[1]) + 0.5)
        wb = ((x - a[0]) * (c[1] - a[1]) - (y - a[1]) * (c[0] - a[0])) / area
        wc = ((b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])) / area
        wa = 1 - wb - wc
        z = wa * a[2] + wb * b[2] + wc * c[2]
        view = (slice(low[1], high[1]), slice(low[0], high[0]))
        seen = (np.minimum(np.minimum(wa, wb), wc) >= -1e-9) & (z > depth[view])
        if not seen.any():
            continue
        at = np.stack([wa[seen], wb[seen], wc[seen]], axis=1) @ uv[f]
        paint = color(at, f) if area < 0 else np.tile(BACK, (len(at), 1))  # rows run downwards
        depth[view][seen] = z[seen]
        image[view][seen] = paint * shade[f]
    return image.reshape(SIZE, FINER, SIZE, FINER, 3).mean(axis=(1, 3))


def seen_from(vertices, faces, turn, tilt):
    """Turned for the eye, and how bright each face is."""
    cos, sin, up, ahead = np.cos(turn), np.sin(turn), np.cos(tilt), np.sin(tilt)
    x = cos * vertices[:, 0] - sin * vertices[:, 1]
    y = sin * vertices[:, 0] + cos * vertices[:, 1]
    points = np.column_stack([x, up * vertices[:, 2] + ahead * y, up * -y + ahead * vertices[:, 2]])
    a, b, c = points[faces].transpose(1, 0, 2)
    normal = np.cross(b - a, c - a)
    normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-300)
    return points, 0.55 + 0.45 * np.abs(normal @ np.array([-0.35, 0.55, 0.76]))


def surface_panel(vertices, faces, tile, cells, turn, tilt):
    points, shade = seen_from(vertices, faces, turn, tilt)
    low, high = points[:, :2].min(axis=0), points[:, :2].max(axis=0)
    width = 1.06 * (high - low).max()
    return raster(points, faces, tile.uv, lambda uv, f: checker(uv, tile.periods, cells), shade,
                  ((low + high) / 2 - width / 2, width))  # fmt: skip


def plane_panel(tile, cells, copies=2):
    """The tile, and its copies paler; what is no surface stays white."""
    low, high = tile.uv.min(axis=(0, 1)), tile.uv.max(axis=(0, 1))
    width = 1.5 * (high - low).max() if len(tile.periods) > 1 else 1.15 * (high - low).max()
    points, faces, uvs = [], [], []
    steps = range(-copies, copies + 1)
    for i in steps:
        for j in steps if len(tile.periods) > 1 else (0,):
            by = i * tile.periods[0] + (j * tile.periods[1] if len(tile.periods) > 1 else 0)
            corners = (tile.uv + by).reshape(-1, 2)
            if (corners.max(axis=0) < (low + high) / 2 - width / 2).any():
                continue
            if (corners.min(axis=0) > (low + high) / 2 + width / 2).any():
                continue
            faces.append(np.arange(len(corners)).reshape(-1, 3) + sum(map(len, points)))
            points.append(np.column_stack([corners, np.zeros(len(corners))]))
            uvs.append((tile.uv, i == 0 and j == 0))
    own = np.concatenate([np.full(len(uv), here) for uv, here in uvs])

    def color(uv, f):
        paint = checker(uv, tile.periods, cells)
        return paint if own[f] else 0.35 * paint + 0.65

    return raster(np.concatenate(points), np.concatenate(faces), np.concatenate([uv for uv, _ in uvs]), color,
                  np.ones(len(own)), ((low + high) / 2 - width / 2, width))  # fmt: skip


def triangulated(quads):
    return np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]]).astype(np.int32)


def torus_picture():
    vertices, triangles, _, _ = holed_torus(16)
    vertices = vertices * [1.15, 0.85, 1.1] + 0.08 * np.sin(3.0 * vertices[:, [1, 2, 0]])
    tile = koebe.torus_map(vertices, triangles)
    points, quads = mug.mug()
    faces = triangulated(quads)
    cup = koebe.torus_map(points, faces)
    print(tile, tile.converged, cup, cup.converged)
    return [surface_panel(vertices, triangles, tile, 12, 0.4, 0.9), plane_panel(tile, 12),
            surface_panel(points, faces, cup, 8, -0.5, 0.5), plane_panel(cup, 8)]  # fmt: skip


def with_slits(panel, tile):
    """The panel of a plane with the tile's slits as red lines."""
    low, high = tile.uv.min(axis=(0, 1)), tile.uv.max(axis=(0, 1))
    width = 1.15 * (high - low).max()
    corner = (low + high) / 2 - width / 2
    for loop in tile.loops:
        for by in (-1, 0, 1) if "slit" in loop else ():
            a, b = np.array(loop["slit"]) + by * tile.periods[0]
            for t in np.linspace(0, 1, 4 * SIZE):
                x, y = (a + t * (b - a) - corner) / width * SIZE
                row, column = SIZE - 1 - round(y), round(x)
                if 0 <= row < SIZE - 2 and 0 <= column < SIZE - 2:
                    panel[row : row + 3, column : column + 3] = RED
    return panel


def ring_picture():
    """A bent sleeve; below each the cylinder it is mapped to."""
    low, high = (0.5, 0.6), (0.5, 0.5)
    holes = {(0, 0): (low, 0.38), (1, 1): (high, 0.25), (3, 0): (low, 0.3), (4, 1): (high, 0.36)}
    _, triangles, height, flat, _ = holed_ring(20, holes=holes)
    turn = 2 * np.pi * flat[:, 0]
    radius = 0.16 + 0.03 * np.sin(9 * flat[:, 1] + turn)
    sleeve = np.column_stack([radius * np.cos(turn), 0.8 * radius * np.sin(turn), 1.3 * flat[:, 1]])
    sleeve[:, 0] += 0.25 * sleeve[:, 2] ** 2
    loops = koebe.boundary_loops(triangles)
    bottom, top = (int(next(loop[0] for loop in loops if np.allclose(flat[loop][:, 1], v))) for v in (0.0, height))
    columns = []
    for kind in ("circles", "concentric", "radial"):
        tile = koebe.ring_map(sleeve, triangles, outer=bottom, inner=top, holes=kind)
        print(kind, tile, tile.converged)
        above = surface_panel(sleeve, triangles, tile, 20, 0.3, 0.35)
        columns.append([above, with_slits(plane_panel(tile, 20, 1), tile)])
    return [np.concatenate(column) for column in columns]


def globe(points, f=None, cells=24):
    """Dark and light fields of the sphere, so many round the equator, between circles that keep them square."""
    points = points / np.linalg.norm(points, axis=1, keepdims=True)
    across = np.arctan2(points[:, 1], points[:, 0]) * cells / (2 * np.pi)
    up = np.arctanh(np.clip(points[:, 2], -0.995, 0.995)) * cells / (2 * np.pi)
    return INKS[(np.floor(across) + np.floor(up)).astype(int) % 2]


def globe_panel(vertices, faces, sphere, turn, tilt):
    """A surface, or its sphere, with the fields of the sphere."""
    points, shade = seen_from(vertices, faces, turn, tilt)
    low, high = points[:, :2].min(axis=0), points[:, :2].max(axis=0)
    width = 1.06 * (high - low).max()
    return raster(points, faces, sphere.points[faces], globe, shade, ((low + high) / 2 - width / 2, width))


def layout_panel(faces, sphere):
    """The UVs of a sphere, what goes beyond the unit square too."""
    corners = sphere.uv.reshape(-1, 2)
    tall = np.array([1.0, 0.5]) if sphere.layout["kind"] == "equirectangular" else np.ones(2)  # 2 : 1, as it is drawn
    points = np.column_stack([corners * tall, np.zeros(len(corners))])
    whole = np.setdiff1d(np.arange(len(faces)), sphere.layout["moved"] + sphere.layout["torn"])
    apart = np.arange(len(corners)).reshape(-1, 3)[whole]
    return raster(points, apart, sphere.points[faces][whole], globe, np.ones(len(whole)),
                  (tall / 2 - 0.54, 1.08))  # fmt: skip


def lantern():
    """A bent body with six holes, about round."""
    points, faces = icosphere(36)
    middles = [(1, 0.2, 0.4), (-0.6, -1, 0.1), (0.1, -0.7, 0.8), (0.5, 1, -0.4), (0.3, -0.6, -1), (-1, 0.5, 0.3)]
    middles = np.array(middles) / np.linalg.norm(middles, axis=1, keepdims=True)
    near = points @ middles.T > np.cos([0.42, 0.35, 0.26, 0.45, 0.3, 0.38])
    faces = faces[~near[faces].any(axis=(1, 2))]
    used, faces = np.unique(faces, return_inverse=True)
    points = points[used]
    x, y, z = points.T
    body = points * (1 + 0.18 * np.sin(3 * z + x)[:, None]) * [0.8, 0.8, 1.35]
    body[:, 0] += 0.35 * z**2
    return body, faces.reshape(-1, 3).astype(np.int32)


def sphere_picture():
    head, quads = closed_head.closed_head()
    head_faces = triangulated(np.array(quads))
    rows = []
    for vertices, faces, turn in ((head, head_faces, 0.45), (*lantern(), 0.3)):
        sphere = koebe.sphere_map(vertices, faces)
        print(sphere, sphere.converged, [warning.text for warning in sphere.warnings])
        rows.append([globe_panel(vertices, faces, sphere, turn, 0.25),
                     globe_panel(sphere.points, faces, sphere, turn, 0.25),
                     layout_panel(faces, sphere),
                     layout_panel(faces, koebe.sphere_map(vertices, faces, layout="octahedral"))])  # fmt: skip
    return [np.concatenate(column) for column in zip(*rows, strict=True)]


def pretzel():
    """A round body with two handles: a slab of cubes with two windows, subdivided."""
    quads = []
    solid = {(i, j) for i in range(7) for j in range(5)} - {(2, 2), (4, 2), (0, 0), (0, 4), (6, 0), (6, 4)}
    for i, j in sorted(solid):
        quads += [[(i, j, 1), (i + 1, j, 1), (i + 1, j + 1, 1), (i, j + 1, 1)]]
        quads += [[(i, j, 0), (i, j + 1, 0), (i + 1, j + 1, 0), (i + 1, j, 0)]]
        for a, b, beside in (
            ((i, j), (i + 1, j), (i, j - 1)), ((i + 1, j), (i + 1, j + 1), (i + 1, j)),
            ((i + 1, j + 1), (i, j + 1), (i, j + 1)), ((i, j + 1), (i, j), (i - 1, j)),
        ):  # fmt: skip
            if beside not in solid:
                quads += [[(*a, 0), (*b, 0), (*b, 1), (*a, 1)]]
    corners = sorted({corner for quad in quads for corner in quad})
    number = {corner: k for k, corner in enumerate(corners)}
    points, quads = np.array(corners, float), np.array([[number[corner] for corner in quad] for quad in quads])
    for _ in range(4):
        points, quads = catmull_clark(points, quads)
    points -= points.mean(axis=0)
    points[:, 2] += 0.35 * np.sin(0.5 * points[:, 0])
    return points, triangulated(quads)


def log_fields(uv, period):
    """Dark and light fields in the plane, square in every size, a whole number of them along the period."""
    z = (2 * uv - 1) @ (1, 1j)
    rows = max(2, 2 * round(24 * period / (4 * np.pi)))
    around = np.angle(z) * 24 / (2 * np.pi)
    across = np.log(np.maximum(abs(z), 1e-12)) * rows / period
    return INKS[(np.floor(around) + np.floor(across)).astype(int) % 2]


def copies_panel(result, period, box):
    """The faces in the plane, and their copies by one generator and by two paler."""
    z = (2 * result.uv - 1) @ (1, 1j)
    letters = [m for g in result.generators for m in (g, np.linalg.inv(g))]
    words = [np.eye(2)] + letters + [a @ b for a in letters for b in letters if abs(a @ b - np.eye(2)).max() > 1e-6]
    points, uvs, pale = [], [], []
    for k, (a, b, c, d) in enumerate(word.ravel() for word in words):
        with np.errstate(all="ignore"):
            moved = (a * z + b) / (c * z + d)
        (x, y), width = box
        here = np.isfinite(moved).all(axis=1) & (abs(moved - complex(x + width / 2, y + width / 2)).min(axis=1) < width)
        here &= abs(moved - np.roll(moved, 1, axis=1)).max(axis=1) < width
        points.append(np.column_stack([moved[here].real.ravel(), moved[here].imag.ravel(), np.zeros(3 * here.sum())]))
        uvs.append(result.uv[here])
        pale.append(np.full(here.sum(), 0.0 if k == 0 else 0.45 if k <= len(letters) else 0.7))
    points, uvs, pale = np.concatenate(points), np.concatenate(uvs), np.concatenate(pale)

    def color(uv, f):
        return (1 - pale[f]) * log_fields(uv, period) + pale[f]

    return raster(points, np.arange(len(points)).reshape(-1, 3), uvs, color, np.ones(len(uvs)), box)


def schottky_picture():
    body, faces = pretzel()
    corner = np.argmin(np.linalg.norm(body - body[body[:, 0].argmax()] * [0.6, 0, 1], axis=1))
    holed = faces[np.linalg.norm(body[faces].mean(axis=1) - body[corner], axis=1) > 0.7]
    rows = []
    for surface in (faces, holed):
        used, own = np.unique(surface, return_inverse=True)
        vertices, own = body[used], own.reshape(-1, 3).astype(np.int32)
        result = koebe.schottky_map(vertices, own)
        print(result, result.converged, result.by_circles, [warning.text for warning in result.warnings])
        outer = [abs(m) for m, h in zip(result.multipliers, result.handles, strict=True) if h["outer"]]
        period = -np.log(outer[0]) if outer else 2 * np.pi
        points, shade = seen_from(vertices, own, 0.35, 0.8)
        low, high = points[:, :2].min(axis=0), points[:, :2].max(axis=0)
        width = 1.06 * (high - low).max()

        def fields(uv, f, period=period):
            return log_fields(uv, period)

        pairs = [pair for pair, h in zip(result.circles, result.handles, strict=True) if not h["outer"]]
        x, y, radius = max((tuple(circle) for pair in pairs for circle in pair), key=lambda circle: circle[2])
        near = 4 * radius
        rows.append([
            raster(points, own, result.uv, fields, shade, ((low + high) / 2 - width / 2, width)),
            copies_panel(result, period, (np.array([-1.1, -1.1]), 2.2)),
            copies_panel(result, period, (np.array([x - near / 2, y - near / 2]), near)),
        ])  # fmt: skip
    return [np.concatenate(column) for column in zip(*rows, strict=True)]


def main():
    pictures = {"torus": torus_picture, "ring": ring_picture, "sphere": sphere_picture, "schottky": schottky_picture}
    for name in sys.argv[1:] or pictures:
        panels = pictures[name]()
        write_png(ROOT / "docs" / "images" / f"domains_{name}.png", np.concatenate(panels, axis=1))


if __name__ == "__main__":
    main()
