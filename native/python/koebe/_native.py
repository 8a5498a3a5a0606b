"""The native module, loaded after NumPy: NumPy may bring an OpenBLAS of its own, which shall come first."""

import numpy  # noqa: F401

from . import _koebe as _koebe
