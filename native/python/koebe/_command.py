"""The koebe command of this package."""

import contextlib
import os
import subprocess
import sys
from pathlib import Path

from .errors import KoebeError

_NAME = "koebe.exe" if sys.platform == "win32" else "koebe"
_PACKAGE = Path(__file__).resolve().parent


def path() -> Path:
    """The path of the command: in the package's folder bin (on Windows beside its library, in the package's folder), or
    in the build folder that holds the package.

    Raises KoebeError if the package was installed without it.
    """
    for folder in (_PACKAGE / "bin", _PACKAGE, _PACKAGE.parents[1]):
        place = folder / _NAME
        if place.is_file():
            if not os.access(place, os.X_OK):  # Blender unpacks wheels without these bits
                with contextlib.suppress(OSError):
                    place.chmod(0o755)
            return place
    raise KoebeError(f"this package has no command: {_PACKAGE / 'bin' / _NAME} is missing; install the package again")


def main() -> int:
    """Entry point of `python -m koebe` and of the script `koebe`: the command with the same arguments. Files of
    FreeSurfer, GIfTI and VTK are converted before and after it. `cortex` runs here."""
    if sys.argv[1:2] == ["cortex"]:
        from .labs.cortex_command import run as run_cortex

        return run_cortex(sys.argv[2:])
    try:
        command = str(path())
    except KoebeError as error:
        print(f"koebe: {error}", file=sys.stderr)
        return 3
    from ._conversion import is_needed, run  # not for everyone who only wants the path

    if is_needed(sys.argv[1:]):
        return run(command, sys.argv[1:])
    if sys.platform != "win32":
        os.execv(command, [command, *sys.argv[1:]])
    process = subprocess.Popen([command, *sys.argv[1:]])
    while True:
        try:
            return process.wait()
        except KeyboardInterrupt:  # the command got it, too, and ends
            continue
