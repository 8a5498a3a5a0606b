#!/usr/bin/env python3
"""Give the C libraries inside a repaired wheel names of their own.

ELF looks a symbol up in the host program before it looks in the wheel. Debian's Blender links the system's
BLAS, so a bundled CHOLMOD would call THAT one: slow where it is the reference BLAS, a crash where it is an
OpenBLAS of another version. Every symbol that a bundled C library exports therefore gets the prefix `koebe_`,
in the library and in all that call it. C++ names, libgomp and libgfortran stay: they are versioned by their makers.
Their files get names of their own too: threadpoolctl, and so scikit-learn, takes every file called libopenblas...
for an OpenBLAS, and asks it for functions by names that it no longer has.

Usage: isolate_wheel.py IN.whl OUT_FOLDER   (needs patchelf >= 0.18 and the package `wheel`)
"""

import subprocess
import sys
import tempfile
from pathlib import Path

PREFIX = "koebe_"
KEEP = ("libgomp", "libgfortran", "libquadmath", "libOpenMesh")  # their symbols keep their names


def exported(library: Path) -> set[str]:
    """The C symbols that `library` defines for others."""
    out = subprocess.run(
        ["nm", "--dynamic", "--defined-only", "--without-symbol-versions", "--format=posix", library],
        check=True, capture_output=True, text=True,
    ).stdout
    names = {line.split()[0] for line in out.splitlines()}
    return {name for name in names if not name.startswith("_")}


def require_fast_blas(libraries: list[Path]) -> None:
    """Stop unless the BLAS inside is OpenBLAS with threads and with kernels for every processor."""
    for lib in libraries:
        if lib.name.startswith("libopenblasp") and b"DYNAMIC_ARCH" in lib.read_bytes():
            return
    sys.exit("the wheel does not hold libopenblas0-pthread: see `update-alternatives --config libblas.so.3-*`")


def own_names(libraries: list[Path]) -> dict[str, str]:
    """File names of the bundled libraries -> their new ones: `libopenblas.so.0` becomes `libkoebe_openblas.so.0`."""
    return {lib.name: f"lib{PREFIX}{lib.name.removeprefix('lib')}" for lib in libraries
            if lib.parent.name.endswith(".libs") and not lib.name.startswith(KEEP)}


def main() -> None:
    wheel, out = Path(sys.argv[1]), Path(sys.argv[2])
    with tempfile.TemporaryDirectory() as scratch:
        run = [sys.executable, "-m", "wheel"]
        subprocess.run([*run, "unpack", "--dest", scratch, wheel], check=True, stdout=subprocess.DEVNULL)
        tree = next(Path(scratch).iterdir())
        libraries = sorted(tree.rglob("*.so*"))
        require_fast_blas(libraries)
        libraries += tree.glob("koebe/bin/*")  # the command, which calls them
        files = own_names(libraries)
        names = set().union(*(exported(lib) for lib in libraries if lib.name in files))
        mapping = Path(scratch) / "symbols"
        mapping.write_text("".join(f"{name} {PREFIX}{name}\n" for name in sorted(names)))
        needed = [word for old, new in files.items() for word in ("--replace-needed", old, new)]
        for lib in libraries:
            if lib.name.startswith(KEEP):
                continue
            named = ["--set-soname", files[lib.name]] if lib.name in files else []
            subprocess.run(["patchelf", "--rename-dynamic-symbols", mapping, *needed, *named, lib], check=True)
            lib.rename(lib.with_name(files.get(lib.name, lib.name)))
        out.mkdir(parents=True, exist_ok=True)
        subprocess.run([*run, "pack", "--dest-dir", out, tree], check=True, stdout=subprocess.DEVNULL)
    print(f"{wheel.name}: {len(names)} symbols of the bundled libraries made private")


if __name__ == "__main__":
    main()
