"""Inside Blender, or under a Python that has `bpy`: install the zip through Blender's own operators, then pytest.

Arguments: [-- ] ZIP [pytest's options]. The exit code is pytest's.
"""

import os
import subprocess
import sys
from pathlib import Path

import bpy

# isort: split
import addon_utils  # bpy brings it

ROOT = Path(__file__).resolve().parent.parent


def install(package: str) -> str:
    """Check, install and enable the zip; return the add-on's module name."""
    sys.path.insert(0, str(ROOT / "tests/blender"))
    import installing

    if bpy.app.version >= (4, 2, 0):
        validate(package)
    module = installing.install(package)
    if not all(addon_utils.check(module)):
        sys.exit(f"{package} was not installed and enabled as {module}")
    bpy.ops.wm.save_userpref()  # so that a Blender which a test starts finds it enabled
    return module


def validate(package: str) -> None:
    """Blender's own check of a package."""
    scripts = Path(addon_utils.paths()[0]).parent
    tool, tags = (scripts / name for name in (
        "addons_core/bl_pkg/cli/blender_ext.py", "modules/_bpy_internal/extensions/tags.py"))
    known = ["--valid-tags", tags] if tags.exists() else []
    subprocess.run([sys.executable, tool, "validate", *known, package], check=True)


def main() -> None:
    import pytest

    arguments = sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else sys.argv[1:]
    package, *options = arguments
    module = install(package)
    print(f"Blender {bpy.app.version_string}, Python {sys.version.split()[0]}: {Path(package).name} as {module}")
    os.environ["KOEBE_UV_MODULE"] = module
    code = pytest.main(["-p", "no:cacheprovider", "--rootdir", str(ROOT), str(ROOT / "tests/blender"), *options])
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(code)  # pytest's line stays the last one; what Blender does when it closes is not under test


if __name__ == "__main__":
    main()
