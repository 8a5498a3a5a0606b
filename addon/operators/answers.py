# SPDX-License-Identifier: GPL-3.0-or-later
"""What operators answer at their end, with a message if something was not done."""

from collections.abc import Sequence

import bpy

from ..maps.wording import few, lines


def refused(operator: bpy.types.Operator, what: str, reasons: Sequence[str] = ()) -> set[str]:
    """The answer of an operator that has done nothing, after an error that says why."""
    operator.report({"ERROR"}, lines(f"Koebe UV: {what}".strip(), reasons))
    return {"CANCELLED"}


def finished(operator: bpy.types.Operator, not_done: str, reasons: Sequence[str]) -> set[str]:
    """The answer of an operator that has done something, after a warning for what was left out, if anything was."""
    if reasons:
        operator.report({"WARNING"}, f"Koebe UV: {not_done}. {few(reasons)}")
    return {"FINISHED"}
