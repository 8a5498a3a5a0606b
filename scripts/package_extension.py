#!/usr/bin/env python3
"""Pack addon/ and its wheels into dist/koebe_uv-VERSION.zip. Standard library only.

With --release the wheels are those of `make dist`, one a platform for every Python, and so are the zips:
dist/koebe_uv-VERSION-PLATFORM.zip, and koebe_uv-VERSION-all.zip with every wheel if that is not too large. Without,
they are those that `make wheel` has built for Pythons of this machine. The two kinds are never in one zip: from wheels
of both, Blender would conclude that the extension is for the Pythons of the second kind alone.

The one zip is an extension (Blender 4.2 and later) and a legacy add-on (3.4 to 4.1): both accept files under
a single folder `koebe_uv/`. The version comes from project(koebe VERSION ...) in CMakeLists.txt; it is written
into the manifest and into `bl_info`. Equal input gives an equal zip: sorted names, one date, one mode.
"""

import argparse
import re
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
FOLDER = "koebe_uv"
DATE = (1980, 1, 1, 0, 0, 0)  # the oldest that a zip can hold
PLATFORMS = {  # how a wheel's platform tag ends, and what Blender calls it
    "linux": {"x86_64": "linux-x64", "aarch64": "linux-arm64"},
    "macosx": {"x86_64": "macos-x64", "arm64": "macos-arm64"},
    "win": {"amd64": "windows-x64", "arm64": "windows-arm64"},
}


LARGEST = 60e6  # bytes: of a zip with the wheels of all platforms


def project_version() -> str:
    """The version in CMakeLists.txt."""
    return re.search(r"project\(\s*koebe\s+VERSION\s+(\d+\.\d+\.\d+)", (ROOT / "CMakeLists.txt").read_text())[1]


def blender_platform(wheel: str) -> str:
    """Blender's name for the platform of a wheel: `...-manylinux_2_34_x86_64.whl` is `linux-x64`."""
    tag = wheel.removesuffix(".whl").rsplit("-", 1)[1]
    for system, machines in PLATFORMS.items():
        for machine, name in machines.items():
            if system in tag and tag.endswith(machine):
                return name
    raise SystemExit(f"no Blender platform for {wheel}")


def substitute(pattern: str, value: str, text: str, where: str) -> str:
    """`text` with the one match of `pattern` replaced."""
    text, count = re.subn(pattern, lambda _: value, text, flags=re.MULTILINE | re.DOTALL)
    if count != 1:
        raise SystemExit(f"{where}: {count} matches of {pattern!r}, expected 1")
    return text


def filled_manifest(text: str, version: str, wheels: list[str]) -> str:
    """The manifest with its version, wheels and platforms."""
    def quoted(items):
        return "[\n" + "".join(f'  "{item}",\n' for item in items) + "]"

    platforms = sorted({blender_platform(wheel) for wheel in wheels})
    text = substitute(r'^version = "[^"]*"', f'version = "{version}"', text, "manifest")
    text = re.sub(r"^platforms = \[.*?\]\n", "", text, flags=re.MULTILINE | re.DOTALL)
    listed = f"platforms = {quoted(platforms)}\nwheels = {quoted('./wheels/' + wheel for wheel in wheels)}"
    return substitute(r"^wheels = \[.*?\]", listed, text, "manifest")


def filled_bl_info(text: str, version: str) -> str:
    """The add-on's __init__.py with its version in `bl_info`."""
    return substitute(r'(?<=["\']version["\']: )\([^)]*\)', f"({version.replace('.', ', ')})", text, "bl_info")


def members(addon: Path, version: str, wheels: list[Path]) -> dict[str, bytes]:
    """What the zip holds: path inside the folder -> content."""
    from guide_html import PAGES, page  # here: wheels are packed by Pythons without its Markdown

    files = {
        path.relative_to(addon).as_posix(): path.read_bytes()
        for path in addon.rglob("*")
        if path.is_file() and "__pycache__" not in path.parts and not path.name.startswith(".")
        and path.suffix not in {".pyc", ".whl"}
    }
    for name, fill in {
        "blender_manifest.toml": lambda text: filled_manifest(text, version, [wheel.name for wheel in wheels]),
        "__init__.py": lambda text: filled_bl_info(text, version),
    }.items():
        files[name] = fill(files[name].decode()).encode()
    files["LICENSE"] = (ROOT / "LICENSE").read_bytes()
    for name in PAGES:
        files[f"{name}.html"] = page((ROOT / "docs" / f"{name}.md").read_text("utf-8"), f"Koebe UV: {name}").encode()
    tables = (path for path in (ROOT / "native" / "options").iterdir() if path.suffix in {".json", ".csv"})
    files.update({f"maps/{path.name}": path.read_bytes() for path in tables})
    files.update({f"wheels/{wheel.name}": wheel.read_bytes() for wheel in wheels})
    return files


def write_package(package: Path, addon: Path, version: str, wheels: list[Path]) -> None:
    """Write one zip and say what is in it."""
    with zipfile.ZipFile(package, "w") as archive:
        for name, content in sorted(members(addon, version, wheels).items()):
            entry = zipfile.ZipInfo(f"{FOLDER}/{name}", DATE)
            entry.external_attr = 0o644 << 16
            entry.compress_type = zipfile.ZIP_STORED if name.endswith(".whl") else zipfile.ZIP_DEFLATED
            archive.writestr(entry, content)
    print(f"{package.relative_to(Path.cwd()) if package.is_relative_to(Path.cwd()) else package}: "
          f"{package.stat().st_size / 1e6:.1f} MB, {', '.join(wheel.name for wheel in wheels)}")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--addon", type=Path, default=ROOT / "addon")
    parser.add_argument("--dist", type=Path, default=ROOT / "dist", help="holds the wheels, receives the zip")
    parser.add_argument("--release", action="store_true", help="a zip for each platform, of the wheels of `make dist`")
    arguments = parser.parse_args()

    version = project_version()
    release = sorted(arguments.dist.glob(f"koebe-{version}-py3-none-*.whl"))
    wheels = release if arguments.release else sorted({*arguments.dist.glob(f"koebe-{version}-*.whl")} - {*release})
    if not wheels:
        target = "dist" if arguments.release else "wheel"
        raise SystemExit(f"no wheel of koebe {version} in {arguments.dist}: make {target}")
    for old in arguments.dist.glob(f"{FOLDER}-*.zip"):
        if bool(re.search(r"-[a-z0-9]+-[a-z0-9]+\.zip$|-all\.zip$", old.name)) == arguments.release:
            old.unlink()
    if not arguments.release:
        write_package(arguments.dist / f"{FOLDER}-{version}.zip", arguments.addon, version, wheels)
        return
    for wheel in wheels:
        package = arguments.dist / f"{FOLDER}-{version}-{blender_platform(wheel.name)}.zip"
        write_package(package, arguments.addon, version, [wheel])
    if len(wheels) > 1 and sum(wheel.stat().st_size for wheel in wheels) < LARGEST:
        write_package(arguments.dist / f"{FOLDER}-{version}-all.zip", arguments.addon, version, wheels)


if __name__ == "__main__":
    main()
