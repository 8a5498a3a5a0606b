# SPDX-License-Identifier: GPL-3.0-or-later
"""The colours of the distortion display, and its legend."""

import numpy as np

from .distortion import ANGLE

# The ends of the legend: degrees from 0, and doublings of the texel density to either side of 0.
ANGLE_END, AREA_END = 10.0, 2.0
# sRGB colours at equal steps of the legend. Angle, as in Blender's stretch display: blue is good, red is bad. Area:
# blue has few texels, red has many.
ANGLE_RAMP = np.array(
    [(0.11, 0.27, 0.75), (0.10, 0.66, 0.78), (0.36, 0.76, 0.30), (0.96, 0.83, 0.20), (0.85, 0.15, 0.12)]
)
AREA_RAMP = np.array(
    [(0.13, 0.30, 0.70), (0.53, 0.70, 0.90), (0.93, 0.93, 0.91), (0.95, 0.66, 0.50), (0.72, 0.12, 0.14)]
)
NOT_MAPPED = (0.35, 0.35, 0.35)  # faces without an area in the UVs


def ramp(kind: str) -> np.ndarray:
    """sRGB colours (n, 3) at equal steps of the legend."""
    return ANGLE_RAMP if kind == ANGLE else AREA_RAMP


def colors(values: np.ndarray, kind: str) -> np.ndarray:
    """sRGB colours (n, 3) of distortions (n,)."""
    where = values / ANGLE_END if kind == ANGLE else 0.5 + 0.5 * values / AREA_END
    stops = np.linspace(0.0, 1.0, len(ramp(kind)))
    found = np.stack([np.interp(where, stops, channel) for channel in ramp(kind).T], axis=1)
    found[np.isnan(values)] = NOT_MAPPED
    return found


def linear(srgb: np.ndarray) -> np.ndarray:
    """Linear values of sRGB ones."""
    return np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)


def legend(kind: str) -> tuple[str, list[tuple[float, str]]]:
    """Title, and (place from 0 to 1, text) of the marks."""
    if kind == ANGLE:
        return "Angle error", [(0.0, "0°"), (0.5, f"{ANGLE_END / 2:.0f}°"), (1.0, f"{ANGLE_END:.0f}°")]
    return "Texel density", [(0.0, "1/4"), (0.25, "1/2"), (0.5, "1"), (0.75, "2"), (1.0, "4")]
