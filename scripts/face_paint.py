# SPDX-License-Identifier: GPL-3.0-or-later
"""A face painted as a sugar skull, in a circle domain: every ornament is drawn around a hole of the face."""

import numpy as np

INK, BONE = "#1d2330", "#f3e9d6"
PETALS = ("#2a9d8f", "#e9b03c")
ROSE, LEAF, VIOLET = "#cf3f5b", "#4f8a4c", "#6c4aa0"


class Painting:
    """Colours (n, n, 3) of the square around the unit disk, painted over each other; z is where each texel lies."""

    def __init__(self, pixels):
        s = (np.arange(pixels) + 0.5) / pixels * 2.0 - 1.0
        self.z = s[None, :] + 1j * s[:, None]
        self.blur = 2.0 / pixels
        self.colors = np.empty((pixels, pixels, 3))
        self.colors[:] = _rgb(BONE)

    def fill(self, depth, code, line=0.0):
        """Paint where depth > 0, a length; with an inked outline of that width."""
        if line:
            self.fill(depth + line, INK)
        cover = np.clip(depth / self.blur + 0.5, 0.0, 1.0)[..., None]
        self.colors += cover * (_rgb(code) - self.colors)

    def disk(self, center, radius, code, line=0.0):
        """A disk."""
        self.fill(radius - np.abs(self.z - center), code, line)

    def flower(self, center, inner, outer, petals, codes, turn=0.0, line=0.008):
        """Petals around a disk, their colours taking turns."""
        arm = self.z - center
        angle = np.angle(arm) - turn
        reach = inner + (outer - inner) * np.sqrt(np.abs(np.cos(0.5 * petals * angle)))
        depth = reach - np.abs(arm)
        self.fill(depth, codes[0], line)
        number = np.floor((petals * angle / (2.0 * np.pi)) + 0.5) % len(codes)
        for k, code in enumerate(codes[1:], start=1):
            self.fill(np.where(number == k, depth, -1.0), code)
        self.fill(np.minimum(depth, 0.5 * line - np.abs(np.sin(0.5 * petals * (angle - np.pi / petals)) * np.abs(arm))
                             * 2.0 / petals), INK)  # fmt: skip


def _rgb(code):
    return np.array([int(code[i : i + 2], 16) / 255.0 for i in (1, 3, 5)])


def sugar_skull(pixels, eyes, nostrils, mouth):
    """Colours (n, n, 3), from the bottom row up. Each hole is (centre as a complex number, radius)."""
    paint = Painting(pixels)
    middle = 0.5 * (eyes[0][0] + eyes[1][0])
    span = abs(eyes[0][0] - eyes[1][0])
    up = 1j * (eyes[1][0] - eyes[0][0]) / span
    up *= np.sign((up * np.conj(middle - mouth[0])).real)
    right = up / 1j

    for center, radius in eyes:
        paint.flower(center, 1.45 * radius, 2.35 * radius, 12, PETALS, np.angle(up))
        paint.disk(center, 1.55 * radius, VIOLET, 0.008)
        paint.disk(center, 1.2 * radius, INK)
    nose = sum(center for center, _ in nostrils) / len(nostrils)
    for side in (-1.0, 1.0):
        paint.disk(nose + 0.025 * side * right + 0.01 * up, 0.045, INK)
        paint.disk(middle + 0.98 * side * span * right - 0.62 * span * up, 0.012, INK)
    _lips(paint, mouth, up)
    brow = middle + 0.75 * span * up
    paint.flower(brow, 0.07, 0.17, 8, (ROSE, "#e27a8c"), np.angle(up))
    paint.disk(brow, 0.055, PETALS[1], 0.008)
    for side in (-1.0, 1.0):
        cheek = middle + 0.80 * side * span * right - 0.72 * span * up
        paint.flower(cheek, 0.05, 0.12, 6, (ROSE, "#e27a8c"), np.angle(up))
        paint.disk(cheek, 0.038, PETALS[1], 0.008)
        for k in range(4):
            leaf = brow + side * (0.235 + 0.075 * k) * right - 0.02 * k * k * up
            paint.disk(leaf, 0.028 - 0.004 * k, LEAF, 0.006)
    chin = mouth[0] - (mouth[1] + 0.205) * up
    paint.flower(chin, 0.03, 0.085, 5, (PETALS[0], "#6cc4b8"), np.angle(up))
    paint.disk(chin, 0.026, PETALS[1], 0.006)
    _border(paint)
    return paint.colors


def _lips(paint, mouth, up):
    """Lips around the mouth, and stitches across them."""
    center, radius = mouth
    arm = (paint.z - center) / up
    paint.fill(radius + 0.052 - np.abs(arm), ROSE, 0.008)
    angle, reach = np.angle(arm), np.abs(arm)
    stitch = 0.006 - reach * np.abs(np.sin(8.0 * angle)) / 8.0
    paint.fill(np.minimum(stitch, np.minimum(reach - radius + 0.02, radius + 0.105 - reach)), INK)


def _border(paint):
    """Beads along the rim."""
    reach = np.abs(paint.z)
    paint.fill(np.minimum(reach - 0.90, 0.912 - reach), INK)
    for k in range(40):
        paint.disk(0.955 * np.exp(2j * np.pi * k / 40), 0.022, PETALS[k % 2], 0.006)
