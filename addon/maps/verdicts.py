# SPDX-License-Identifier: GPL-3.0-or-later
"""The figures by which an artist judges a map: each with whether it is good, and what to do where it is not."""

import dataclasses
from typing import Any

from .wording import MOST_SHOWN, density_text

EVEN = 4.0  # texel density at 95 % of the area over that at 5 %: below, a checker looks even
COVERED = 0.4  # of the UV square: below, most of an image is empty
TRUE = 5.0  # degrees of mean angle error: above, a checker looks skewed
OF_LAYOUT = 11.0  # degrees of it that a round ball has, as lines of longitude meet at the poles


@dataclasses.dataclass(frozen=True)
class Figure:
    """A figure of a map. @param advice what to do where it is not good, else empty"""

    name: str
    value: str
    advice: str

    @property
    def is_good(self) -> bool:
        """Whether there is nothing to do about it."""
        return not self.advice


def figures(entry: Any, coverage: float | None = None) -> list[Figure]:
    """The figures of a mapped island, as the report has it (state/run_report.py).

    @param coverage of all islands that share the UV square with this one; by default this island's alone
    """
    found = [_evenness(entry)] if entry.density else []
    found += [_coverage(entry, entry.coverage if coverage is None else coverage)] if entry.coverage else []
    return [*found, _angles(entry), _flips(entry)]


def is_good(entry: Any) -> bool:
    """Whether there is nothing to do about a mapped island itself."""
    return entry.converged and not entry.message and all(figure.is_good for figure in figures(entry, 1.0))


def _evenness(entry: Any) -> Figure:
    advice = ""
    if entry.density > EVEN:
        if entry.parts:
            advice = "Texels are uneven: move the slider Parts to the right"
        elif entry.domain in ("sphere", "schottky"):
            advice = "This shape always has uneven texels: to paint, choose Shape: Parts"
        elif entry.domain:
            advice = "Texels are uneven: raise Even, or choose Shape: Parts"
        else:  # Automatic has the slider for parts, where Keep Angles moves it
            advice = "Texels are uneven: with Shape: Disk raise Even, or choose Shape: Parts"
    value = f"1 : {density_text(entry.density)}" if entry.density <= MOST_SHOWN else f"over {MOST_SHOWN:.0f}"
    return Figure("Texel density", value, advice)


def _coverage(entry: Any, coverage: float) -> Figure:
    advice = ""
    if coverage < COVERED:
        alone = entry.parts == 1 or (not entry.parts and coverage == entry.coverage)  # then a packer has no choice
        better = "mark a seam across the surface" if alone else "press Pack Only, under Packing"
        advice = f"Much of the image stays empty: {better}"
    return Figure("Coverage", f"{100.0 * coverage:.0f} %", advice)


def _angles(entry: Any) -> Figure:
    advice = ""
    if entry.domain == "sphere":
        if entry.angle_error > TRUE + OF_LAYOUT:
            advice = "The checker is bent: to paint, choose Shape: Parts"
    elif entry.angle_error > TRUE:
        more = "move the slider Parts to the right" if entry.parts else "choose Shape: Parts"
        advice = f"The checker is bent: {'lower Even' if entry.even else f'subdivide large faces, or {more}'}"
    return Figure("Angle error", f"{entry.angle_error:.2f}°", advice)


def _flips(entry: Any) -> Figure:
    advice = ""
    if entry.flipped:
        advice = ("Textures look mirrored on these faces: repair the faces" if entry.parts else
                  "Textures look mirrored on these faces: choose Shape: Parts")  # fmt: skip
    return Figure("Flips", f"{entry.flipped}" if entry.flipped else "none", advice)
