#!/usr/bin/env python3
"""Pack a wheel of the package `koebe`: its Python files, and what was compiled for it. Standard library only.

Usage: pack_wheel.py bundle BUILD_FOLDER TAG OUT_FOLDER      TAG: py3-none-manylinux_2_28_x86_64, py3-none-win_amd64
       pack_wheel.py local MODULE COMMAND TAG OUT_FOLDER     TAG: cp311-cp311-linux_x86_64

A bundle (-DKOEBE_BUNDLE=ON) has the shared library, the command, and a module `_koebe` for each Python, which finds its
own by the suffix: one wheel serves every Python, and Blender's extensions take it for each. A local wheel has the one
module and the command that this machine has compiled for itself, and beside them the libraries that they need and
another machine may not have. What the wheel says of itself comes from pyproject.toml, the version from CMakeLists.txt.
A bundle lists what it holds of others (sbom.py). Equal input gives an equal wheel.
"""

import base64
import hashlib
import re
import runpy
import subprocess
import sys
import zipfile
from pathlib import Path
from typing import Any

import tomllib
from package_extension import DATE, ROOT, project_version
from sbom import NAME as SBOM
from sbom import sbom

PACKAGE = ROOT / "native" / "python" / "koebe"
OPTIONS = ROOT / "native" / "options"
LIBRARIES = ("libkoebe.so", "libkoebe.dylib", "koebe.dll")
MODULES = ("_koebe.*.so", "_koebe.*.pyd")
PROGRAMS = ("bin/koebe", "koebe.exe")  # Windows looks for the library beside the program
# What every Linux has where a C++ program runs.
SYSTEM = r"linux-vdso|ld-linux|lib(c|m|dl|rt|pthread|gcc_s|stdc\+\+)\.so"


def project() -> dict[str, Any]:
    return tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]


def metadata(version: str) -> str:
    said = project()
    lines = [
        "Metadata-Version: 2.4",
        "Name: koebe",
        f"Version: {version}",
        f"Summary: {said['description']}",
        *(f"Author: {author['name']}" for author in said["authors"]),
        f"Keywords: {','.join(said['keywords'])}",
        f"License-Expression: {said['license']}",
        "License-File: LICENSE",
        "License-File: THIRD_PARTY.md",
        f"Requires-Python: {said['requires-python']}",
        *(f"Project-URL: {name}, {url}" for name, url in said["urls"].items()),
        *(f"Classifier: {item}" for item in said["classifiers"]),
        *(f"Requires-Dist: {item}" for item in said["dependencies"]),
    ]
    for extra, packages in said["optional-dependencies"].items():
        lines += [f"Provides-Extra: {extra}", *(f"Requires-Dist: {item}; extra == '{extra}'" for item in packages)]
    lines.append("Description-Content-Type: text/markdown")
    return "\n".join(lines) + "\n\n" + (ROOT / said["readme"]).read_text(encoding="utf-8")


def entry_points() -> str:
    return "[console_scripts]\n" + "".join(f"{name} = {place}\n" for name, place in project()["scripts"].items())


def bundle(build: Path) -> dict[str, Path]:
    """What was compiled for a release: place in the package -> file."""
    folder = build / "koebe"
    found = {kind: sorted(path for pattern in patterns for path in folder.glob(pattern))
             for kind, patterns in {"library": LIBRARIES, "modules": MODULES, "program": PROGRAMS}.items()}
    if len(found["library"]) != 1 or len(found["program"]) != 1 or not found["modules"]:
        raise SystemExit(f"{folder} holds no bundle: {found}")
    return {path.relative_to(folder).as_posix(): path for paths in found.values() for path in paths}


def local(module: Path, command: Path) -> dict[str, Path]:
    """What was compiled for this machine, with the libraries that it finds beside itself ($ORIGIN)."""
    files = {module.name: module, "bin/koebe": command}
    for binary in (module, command):
        listed = subprocess.run(["ldd", binary], check=True, capture_output=True, text=True).stdout
        files |= {name: Path(path) for name, path in re.findall(r"^\s*(\S+) => (/\S+)", listed, re.MULTILINE)
                  if not re.match(SYSTEM, name)}
    return files


def members(compiled: dict[str, Path], tag: str, version: str) -> dict[str, bytes]:
    """What the wheel holds but for its RECORD: path -> content."""
    sources = [*PACKAGE.rglob("*.py"), *PACKAGE.rglob("*.pyi"), PACKAGE / "py.typed"]
    files = {f"koebe/{path.relative_to(PACKAGE).as_posix()}": path.read_bytes() for path in sources}
    files |= {f"koebe/{path.name}": path.read_bytes() for path in OPTIONS.glob("*.json")}
    files |= {f"koebe/examples/{path.name}": path.read_bytes() for path in (ROOT / "blend_samples").glob("*.obj")}
    files["koebe/_signatures.py"] = runpy.run_path(str(OPTIONS / "generate.py"))["signatures"]().encode()
    files |= {f"koebe/{name}": path.read_bytes() for name, path in compiled.items()}
    info = f"koebe-{version}.dist-info"
    files[f"{info}/METADATA"] = metadata(version).encode()
    files[f"{info}/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: koebe\nRoot-Is-Purelib: false\nTag: {tag}\n".encode()
    files[f"{info}/entry_points.txt"] = entry_points().encode()
    for name in ("LICENSE", "THIRD_PARTY.md"):
        files[f"{info}/licenses/{name}"] = (ROOT / name).read_bytes()
    if tag.startswith("py3-none-"):  # what this machine's wheel holds of others is this machine's own
        files[f"{info}/sboms/{SBOM}"] = sbom(version, project()["license"], tag.removeprefix("py3-none-")).encode()
    return files


def record_line(name: str, content: bytes) -> str:
    digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).decode().rstrip("=")
    return f"{name},sha256={digest},{len(content)}\n"


def main() -> None:
    kinds = {("bundle", 4): bundle, ("local", 5): local}
    kind = kinds.get((sys.argv[1] if len(sys.argv) > 1 else "", len(sys.argv) - 1))
    if kind is None:
        raise SystemExit(__doc__)
    *compiled, tag, out = sys.argv[2:]
    write_wheel(members(kind(*map(Path, compiled)), tag, project_version()), tag, Path(out))


def write_wheel(files: dict[str, bytes], tag: str, out: Path) -> None:
    """The wheel in folder `out`, in the place of an older one."""
    version = project_version()
    record = f"koebe-{version}.dist-info/RECORD"
    lines = "".join(record_line(name, content) for name, content in sorted(files.items()))
    files[record] = f"{lines}{record},,\n".encode()
    out.mkdir(parents=True, exist_ok=True)
    for old in out.glob(f"koebe-*-{tag}.whl"):
        old.unlink()
    wheel = out / f"koebe-{version}-{tag}.whl"
    with zipfile.ZipFile(wheel, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for name in [*sorted(set(files) - {record}), record]:
            entry = zipfile.ZipInfo(name, DATE)
            mode = 0o755 if name.endswith((".dylib", ".pyd", ".dll", *PROGRAMS)) or ".so" in name else 0o644
            entry.external_attr = (0o100000 | mode) << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, files[name])
    print(f"{wheel}: {wheel.stat().st_size / 1e6:.1f} MB")


if __name__ == "__main__":
    main()
