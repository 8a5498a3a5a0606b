# SPDX-License-Identifier: GPL-3.0-or-later
"""What the paper prints in figures: Table 1, the orders of its process figures, the distance of Fig. 13.

W. Zeng, X. Yin, M. Zhang, F. Luo, X. Gu, "Generalized Koebe's Method for Conformal Mapping Multiply Connected Domains".
Its Table 2 is not preserved in the text that this project has; its sentence is: GK is at least two times as fast as CK
for the same roundness.
"""

from dataclasses import dataclass


@dataclass(frozen=True)
class Row:
    """Of Table 1. Minutes on a laptop of 2.00 GHz; None: did not converge."""

    figure: str
    holes: int
    vertices: int
    faces: int
    rf_minutes: int | None
    rf_roundness: float | None
    gk_steps: int
    gk_minutes: int
    gk_roundness: float

    @property
    def boundary(self):
        """Boundary vertices, by Euler's formula for genus 0: not printed."""
        return 2 * self.vertices - self.faces + 2 * (self.holes + 1) - 4


TABLE_1 = (
    Row("Fig. 2", 3, 13515, 26304, 36, 0.048356, 42, 17, 0.040613),
    Row("Fig. 8", 3, 36737, 72391, 115, 0.042560, 42, 50, 0.039315),
    Row("Fig. 10", 5, 17732, 34653, 45, 0.044641, 12, 14, 0.041758),
    Row("Fig. 11", 5, 40335, 79999, 120, 0.043786, 6, 10, 0.037872),
    Row("Fig. 12", 9, 73839, 145566, None, None, 10, 46, 0.038551),
    Row("Fig. 1", 15, 20226, 40034, None, None, 16, 16, 0.047927),
)

FIG_2_ORDER = ((0,), (3,), (1,), (2,))  # CK: the one loop that each step opens, again and again
FIG_2_FRAMES = 9  # the surface and eight steps
FIG_4_ORDER = ((0, 2), (3, 0), (0, 2), (3, 1), (0, 2))  # GK: the two loops that each step opens
FIG_13_DISTANCE = 0.064952  # faces of two persons with a similar expression
