# SPDX-License-Identifier: GPL-3.0-or-later
"""The picture of docs/method.md, "After the iteration": docs/images/after_the_iteration.svg.

It needs `make build`, and NumPy. A face with open eyes and mouth, mapped six times: with each option of the page, and
without. All maps have the top of the face as their point, so that it is up.
"""

import sys
import tempfile
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "blend_samples"), str(Path(__file__).resolve().parent)]

import make_obj  # noqa: E402
from even_picture import LEVELS, colour, log_density, mapped  # noqa: E402

OUT = ROOT / "docs" / "images" / "after_the_iteration.svg"
CELLS = 24  # across the face
SIZE, CAPTION = 300, 44
DENSE = 1.5  # of log area: full blue or full red
DEGREES = 4.0  # full red
MARK = "#2a9d5c"


def angles(points, faces):
    """(F, 3) angles at the corners, in degrees."""
    corner = points[faces]
    ahead, behind = np.roll(corner, -1, axis=1) - corner, np.roll(corner, 1, axis=1) - corner
    cosine = (ahead * behind).sum(axis=2) / np.linalg.norm(ahead, axis=2) / np.linalg.norm(behind, axis=2)
    return np.degrees(np.arccos(np.clip(cosine, -1, 1)))


def panel(place, uv, faces, level, caption, marks=()):
    """The faces of a map, in eleven colours. The point 1 of the disk is at the top."""
    at = np.round((1 - uv[:, ::-1]) * (SIZE - 20) + 10, 1)
    parts = [f'<g transform="translate({place[0] * SIZE} {place[1] * (SIZE + CAPTION)})">']
    nearest = np.abs(np.clip(level, -1, 1)[:, None] - LEVELS).argmin(axis=1)
    for k, value in enumerate(LEVELS):
        path = "".join("M{} {}L{} {}L{} {}z".format(*at[face].ravel()) for face in faces[nearest == k])
        if path:
            parts.append(f'<path fill="{colour(value)}" stroke="#8892a6" stroke-width="0.3" d="{path}"/>')
    parts += ['<circle cx="{}" cy="{}" r="5" fill="{}"/>'.format(*at[vertex], MARK) for vertex in marks]
    for row, words in enumerate(caption):
        at_line = f'x="{SIZE / 2}" y="{SIZE + 10 + 19 * row}"'
        parts.append(f'<text {at_line} text-anchor="middle" font-size="15">{words}</text>')
    return [*parts, "</g>"]


def main():
    points, faces = make_obj.face(cells=CELLS)
    nose = int(np.abs(points[:, [0, 2]] - points[:, [0, 2]].mean(axis=0)).sum(axis=1).argmin())
    rim = make_obj.boundary_vertices(faces)
    top = int(rim[points[rim, 2].argmax()])
    mouth = points[:, 2] < np.quantile(points[:, 2], 0.35)
    wanted = angles(points, faces)
    parts = []
    with tempfile.TemporaryDirectory() as folder:
        importance = Path(folder) / "importance.txt"
        importance.write_text("".join(f"{int(w)}\n" for w in mouth), encoding="ascii")
        turned = ("--point", str(top))
        balance = (*turned, "--balance", "area")
        for k, (options, words, marks) in enumerate((
            (turned, "as the iteration ends", ()),
            (balance, "--balance area", ()),
            ((*balance, "--importance", str(importance)), "mouth important", ()),
            ((*turned, "--center", str(nose)), "chosen centre and point", (nose, top)),
        )):
            uv, report = mapped(points, faces, *options)
            spread = f"sd of log area {report['area_distortion']['log_sd']:.2f}"
            parts += panel((k % 3, k // 3), uv, faces, log_density(uv, points, faces) / DENSE, (words, spread), marks)
        for k, (options, words) in enumerate(((balance, "not polished"), ((*balance, "--polish"), "--polish")), 4):
            uv, report = mapped(points, faces, *options)
            error = np.abs(angles(uv, faces) - wanted).mean(axis=1)
            mean = f"angle error {report['angle_error_deg']['mean']:.2f}°"
            parts += panel((k % 3, k // 3), uv, faces, -error / DEGREES, (words, mean))
    box = f"0 0 {3 * SIZE} {2 * (SIZE + CAPTION)}"
    head = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{box}" font-family="sans-serif">'
    OUT.write_text("\n".join([head, '<rect width="100%" height="100%" fill="white"/>', *parts, "</svg>"]) + "\n",
                   encoding="utf-8")


if __name__ == "__main__":
    main()
