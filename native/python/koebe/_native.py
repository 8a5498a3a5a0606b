"""The compiled module."""

import numpy  # noqa: F401  (may bring an OpenBLAS of its own, which shall come first)

from . import _koebe  # noqa: F401
