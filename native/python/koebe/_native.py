"""The compiled module, loaded with the dense kernels that fit the processor.

OpenBLAS chooses its kernels while it is loaded, and a release older than the processor falls back to those of 2004,
3 to 6 times slower. OPENBLAS_CORETYPE (OpenBLAS manual, "Environment variables") names better ones.
"""

import contextlib
import os
from collections.abc import Iterator

import numpy  # noqa: F401  (may bring an OpenBLAS of its own, which shall choose for itself)

_CHOICE = "OPENBLAS_CORETYPE"


def _core_type() -> str | None:
    """The kernels for this processor, None where only OpenBLAS itself can tell."""
    try:
        with open("/proc/cpuinfo", encoding="ascii", errors="replace") as lines:
            flags = next((set(line.split()) for line in lines if line.startswith("flags")), set())
    except OSError:
        return None
    if {"avx512f", "avx512dq", "avx512bw", "avx512vl"} <= flags:
        return "SKYLAKEX"
    return "HASWELL" if {"avx2", "fma"} <= flags else None


@contextlib.contextmanager
def _fast_kernels() -> Iterator[None]:
    """Within it a newly loaded OpenBLAS takes the kernels for this processor; a value the user has set stays."""
    core_type = None if _CHOICE in os.environ else _core_type()
    if core_type:
        os.environ[_CHOICE] = core_type
    try:
        yield
    finally:
        if core_type:
            del os.environ[_CHOICE]


with _fast_kernels():
    from . import _koebe  # noqa: E402,F401
