#!/usr/bin/env python3
"""Check the wheels of `make dist` by what their binaries ask of a system, and what is in the source package.

Usage: check_dist.py FOLDER PYTHON...     PYTHON: each wheel has a module for it, as 3.10. Standard library only.
"""

import re
import sys
import tarfile
import zipfile
from pathlib import Path

from binary_facts import Facts, facts_of
from sbom import NAME as SBOM

BINARIES = (".so", ".dylib", ".dll", ".pyd", ".exe", "bin/koebe")
MACHINES = {"x86_64": "x86_64", "amd64": "x86_64", "aarch64": "aarch64", "arm64": "aarch64"}
# Of the system alone: what every machine of it has. manylinux's list [PEP 600], and Windows 10's.
SYSTEM_LIBRARIES = {
    "manylinux": r"lib(c|m|pthread|dl|rt)\.so\.\d+|ld-linux-(x86-64|aarch64)\.so\.\d|libkoebe\.so",
    "win": r"(kernel32|advapi32|ntdll|psapi|user32|userenv|iphlpapi|ws2_32|bcrypt(primitives)?|"
           r"ucrtbase|msvcrt|python3\d+|koebe|api-ms-win-[a-z0-9-]+)\.dll",
    "macosx": r"/usr/lib/libSystem\.B\.dylib|@rpath/libkoebe\.dylib",
}  # fmt: skip


def problems_of(facts: Facts, system: str, tag: str) -> list[str]:
    """What is wrong with a binary in a wheel of that platform tag."""
    found = []
    machine = next(name for end, name in MACHINES.items() if tag.endswith(end))
    if facts.machine != machine:
        found.append(f"is for {facts.machine}")
    foreign = [name for name in facts.libraries if not re.fullmatch(SYSTEM_LIBRARIES[system], name, re.IGNORECASE)]
    if foreign:
        found.append(f"needs {', '.join(foreign)}")
    limit = tuple(map(int, re.findall(r"\d+", tag)[:2])) if system != "win" else ()
    if system == "manylinux":
        late = [name for name in facts.versions
                if (match := re.fullmatch(r"GLIBC_(\d+)\.(\d+)(\.\d+)?", name)) is None
                or (int(match[1]), int(match[2])) > limit]
        if late:
            found.append(f"needs {', '.join(late)}")
    if system == "macosx":
        if facts.minimum_os is None or facts.minimum_os > limit:
            found.append(f"is for macOS {facts.minimum_os}")
        if machine == "aarch64" and not facts.signed:
            found.append("has no signature, without which no such Mac loads it")
    return found


def machine_paths(content: bytes) -> list[str]:
    """What a binary says of the place where it was built: paths that begin above this project."""
    found = re.search(rb"[\w./-]*[\w.-]/build/(?:sources|venv|dist-)[\w./-]*", content)
    return [f"says {found[0].decode()}, a place on the machine that built it"] if found else []


def sources_told(folder: Path) -> int:
    """Say of each source package what is wrong with it; how much that is."""
    bad = 0
    for package in sorted(folder.glob("koebe-*.tar.gz")):
        with tarfile.open(package) as archive:
            names = {name.split("/", 1)[1] for name in archive.getnames() if "/" in name}
        said = [f"has {name}" for name in sorted(names) if name.split("/")[0].startswith("build") or ".so" in name][:3]
        said += [f"has no {name}" for name in ("CMakeLists.txt", "pyproject.toml", "LICENSE", "native/CMakeLists.txt")
                 if name not in names]
        bad += len(said)
        print(f"{package.name}: {'; '.join(said) or 'good'}  [{len(names)} files]")
    return bad


def main() -> None:
    folder = Path(sys.argv[1])
    pythons = [python.replace(".", "") for python in sys.argv[2:]]
    bad = sources_told(folder)
    wheels = sorted(folder.glob("koebe-*-py3-none-*.whl"))
    if not wheels:
        raise SystemExit(f"no wheels in {folder}")
    for wheel in wheels:
        tag = wheel.stem.rsplit("-", 1)[1]
        system = re.match(r"[a-z]+", tag)[0]
        with zipfile.ZipFile(wheel) as archive:
            binaries = [name for name in archive.namelist() if name.endswith(BINARIES)]
            missing = [python for python in pythons if not any(f"_koebe.cp{python}-" in name or f"-{python}-" in name
                                                               for name in binaries)]
            said = [f"has no module for Python {python}" for python in missing]
            needs: set[str] = set()
            for name in binaries:
                content = archive.read(name)
                facts = facts_of(content)
                needs |= set(facts.versions) | set(facts.libraries)
                said += [f"{name} {problem}" for problem in [*problems_of(facts, system, tag), *machine_paths(content)]]
            said += [f"has no {SBOM}"] if not any(name.endswith(f"sboms/{SBOM}") for name in archive.namelist()) else []
        bad += len(said)
        print(f"{wheel.name}: {'; '.join(said) or 'good'}  [{', '.join(sorted(needs))}]")
    raise SystemExit(1 if bad else 0)


if __name__ == "__main__":
    main()
