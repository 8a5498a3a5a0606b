# SPDX-License-Identifier: GPL-3.0-or-later
"""The error of a native package that is not there or does not load; apart, so that naming it loads nothing."""


class NativeError(ImportError):
    """The native package is missing, damaged, or was built for another interpreter."""
