# SPDX-License-Identifier: GPL-3.0-or-later
"""The error of a missing or broken native package. It has its own file, so that importing it loads nothing."""


class NativeError(ImportError):
    """The native package is missing, damaged, or was built for another interpreter."""
