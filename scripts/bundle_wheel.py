#!/usr/bin/env python3
"""Pack a bundle (-DKOEBE_BUNDLE=ON) into one wheel for every Python of its platform. Standard library only.

Usage: bundle_wheel.py BUILD_FOLDER PLATFORM_TAG OUT_FOLDER     PLATFORM_TAG: manylinux_2_28_x86_64, win_amd64, ...

The wheel holds the package `koebe`, in it the shared library, the command, and a module `_koebe` for each Python, which
finds its own by the suffix. So its tag is py3-none-PLATFORM, and Blender's extensions take it for every Python. What it
says of itself comes from pyproject.toml, the version from CMakeLists.txt. Equal input gives an equal wheel.
"""

import base64
import hashlib
import sys
import zipfile
from pathlib import Path

import tomllib
from package_extension import DATE, ROOT, project_version

PACKAGE = ROOT / "native" / "python" / "koebe"
TABLE = ROOT / "native" / "options" / "options.json"
LIBRARIES = ("libkoebe.so", "libkoebe.dylib", "koebe.dll")
MODULES = ("_koebe.*.so", "_koebe.*.pyd")
PROGRAMS = ("bin/koebe", "koebe.exe")  # Windows looks for the library beside the program


def metadata(version: str) -> str:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    lines = [
        "Metadata-Version: 2.4",
        "Name: koebe",
        f"Version: {version}",
        f"Summary: {project['description']}",
        f"License-Expression: {project['license']}",
        "License-File: LICENSE",
        "License-File: THIRD_PARTY.md",
        f"Requires-Python: {project['requires-python']}",
        *(f"Classifier: {item}" for item in project["classifiers"]),
        *(f"Requires-Dist: {item}" for item in project["dependencies"]),
    ]
    for extra, packages in project["optional-dependencies"].items():
        lines += [f"Provides-Extra: {extra}", *(f"Requires-Dist: {item}; extra == '{extra}'" for item in packages)]
    lines.append("Description-Content-Type: text/markdown")
    return "\n".join(lines) + "\n\n" + (ROOT / "README.md").read_text(encoding="utf-8")


def entry_points() -> str:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    return "[console_scripts]\n" + "".join(f"{name} = {place}\n" for name, place in project["scripts"].items())


def members(build: Path, platform: str, version: str) -> dict[str, bytes]:
    """What the wheel holds but for its RECORD: path -> content."""
    files = {f"koebe/{path.name}": path.read_bytes() for path in [*PACKAGE.glob("*.py"), PACKAGE / "py.typed", TABLE]}
    found = {kind: sorted(path for pattern in patterns for path in (build / "koebe").glob(pattern))
             for kind, patterns in {"library": LIBRARIES, "modules": MODULES, "program": PROGRAMS}.items()}
    if len(found["library"]) != 1 or len(found["program"]) != 1 or not found["modules"]:
        raise SystemExit(f"{build / 'koebe'} holds no bundle: {found}")
    for path in (path for paths in found.values() for path in paths):
        files[f"koebe/{path.relative_to(build / 'koebe').as_posix()}"] = path.read_bytes()
    info = f"koebe-{version}.dist-info"
    files[f"{info}/METADATA"] = metadata(version).encode()
    files[f"{info}/WHEEL"] = (
        f"Wheel-Version: 1.0\nGenerator: koebe\nRoot-Is-Purelib: false\nTag: py3-none-{platform}\n".encode()
    )
    files[f"{info}/entry_points.txt"] = entry_points().encode()
    for name in ("LICENSE", "THIRD_PARTY.md"):
        files[f"{info}/licenses/{name}"] = (ROOT / name).read_bytes()
    return files


def record_line(name: str, content: bytes) -> str:
    digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).decode().rstrip("=")
    return f"{name},sha256={digest},{len(content)}\n"


def main() -> None:
    if len(sys.argv) != 4:
        raise SystemExit(__doc__)
    build, platform, out = Path(sys.argv[1]), sys.argv[2], Path(sys.argv[3])
    version = project_version()
    files = members(build, platform, version)
    record = f"koebe-{version}.dist-info/RECORD"
    lines = "".join(record_line(name, content) for name, content in sorted(files.items()))
    files[record] = f"{lines}{record},,\n".encode()
    out.mkdir(parents=True, exist_ok=True)
    wheel = out / f"koebe-{version}-py3-none-{platform}.whl"
    with zipfile.ZipFile(wheel, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for name in [*sorted(set(files) - {record}), record]:
            entry = zipfile.ZipInfo(name, DATE)
            mode = 0o755 if name.endswith((".so", ".dylib", ".pyd", ".dll", *PROGRAMS)) else 0o644
            entry.external_attr = (0o100000 | mode) << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, files[name])
    print(f"{wheel}: {wheel.stat().st_size / 1e6:.1f} MB")


if __name__ == "__main__":
    main()
