"""Builds the site in build/docs/html: writes the sources of its pages, runs Doxygen and Sphinx, and checks the links.
The page of `make web`, if it is there, becomes a part of it.

    PYTHONPATH=build/python build/venv-docs/bin/python scripts/site/build.py build/docs

Ends with 1 if a public name is undocumented, if Sphinx warns, or if a link leads nowhere.
"""

import shutil
import sys
from pathlib import Path

import blender_pages
import command_pages
import cpp_pages
import links
import pages
import python_pages
from sphinx.cmd.build import build_main

SITE = Path(__file__).resolve().parents[2] / "docs" / "site"


def write(folder, texts, files):
    """Writes what has changed, so that Sphinx reads no other page again, and removes what is no longer there."""
    wanted = {folder / name: text.encode() for name, text in texts.items()}
    wanted |= {folder / name: path.read_bytes() for name, path in files.items()}
    for path in [path for path in folder.rglob("*") if path.is_file() and path not in wanted]:
        path.unlink()
    for path, content in wanted.items():
        if not path.is_file() or path.read_bytes() != content:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content)


def fail(faults):
    if faults:
        raise SystemExit("\n".join([*faults, f"make docs: faults: {len(faults)}"]))


def run_sphinx(source, html, kept):
    """Runs Sphinx. After a fault it knows again what it knew before, so that it reads the pages at fault once more."""
    memory = kept / "environment.pickle"
    before = memory.read_bytes() if memory.is_file() else None
    if build_main(["-q", "-W", "-c", str(SITE), "-d", str(kept), str(source), str(html)]) != 0:
        if before is None:
            shutil.rmtree(kept, ignore_errors=True)
        else:
            memory.write_bytes(before)
        fail(["Sphinx warned: see above"])


def main():
    folder = Path(sys.argv[1]).resolve()
    found = blender_pages.operators(folder / "operators.json")
    cpp_pages.doxygen(folder / "doxygen")
    fail(python_pages.faults() + command_pages.faults() + blender_pages.faults(found)
         + cpp_pages.faults(folder / "doxygen"))  # fmt: skip
    texts = {**pages.texts(), **python_pages.pages(), **command_pages.pages(), **cpp_pages.pages(folder / "doxygen")}
    write(folder / "source", {**texts, **blender_pages.pages(found)}, pages.files())
    html = folder / "html"
    shutil.rmtree(html / pages.TRY, ignore_errors=True)
    run_sphinx(folder / "source", html, folder / "doctrees")
    if pages.WEB.is_dir():
        shutil.copytree(pages.WEB, html / pages.TRY)
    fail(links.dead(html))
    print(f"{len(list(html.rglob('*.html')))} pages: {html / 'index.html'}")


if __name__ == "__main__":
    main()
