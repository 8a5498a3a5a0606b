# SPDX-License-Identifier: GPL-3.0-or-later
"""Run the notebooks of docs/ that need the packages of `make test-labs`, and keep what they show.

    PYTHONPATH=build/python build/venv-labs/bin/python scripts/notebooks.py
"""

import base64
import io
import os
import shutil
import sys
import tempfile
from pathlib import Path

import koebe
import nbclient
import nbformat
from PIL import Image

ROOT = Path(__file__).resolve().parent.parent
NAMES = ("tutorial.ipynb", "atrium.ipynb", "cortex.ipynb")


def executed(name, folder):
    """A notebook of docs/, run in a folder to which the sample meshes are copied."""
    notebook = nbformat.read(ROOT / "docs" / name, as_version=4)
    (folder / "blend_samples").mkdir()
    for mesh in ("face.obj", "surprised.obj"):
        shutil.copy(ROOT / "blend_samples" / mesh, folder / "blend_samples")
    os.environ["PYTHONPATH"] = str(Path(koebe.__file__).resolve().parents[1])  # it may be a relative one here
    os.environ["MPLBACKEND"] = "module://matplotlib_inline.backend_inline"
    where = {"metadata": {"path": str(folder)}}
    nbclient.NotebookClient(notebook, timeout=900, kernel_name="python3", resources=where).execute()
    for cell in notebook.cells:
        cell.metadata.pop("execution", None)  # times
        if "outputs" in cell:  # without warnings, which name folders
            cell.outputs = [output for output in cell.outputs if output.get("name") != "stderr"]
    return notebook


def shown(notebook):
    """All outputs, one after the other."""
    return [output for cell in notebook.cells for output in cell.get("outputs", [])]


def in_few_colors(png):
    """A picture in base64, small enough for the repository."""
    picture = Image.open(io.BytesIO(base64.b64decode(png))).convert("RGB")
    picture.thumbnail((900, 900))
    out = io.BytesIO()
    picture.quantize(64).save(out, "PNG", optimize=True)
    return base64.b64encode(out.getvalue()).decode()


def main():
    for name in NAMES:
        with tempfile.TemporaryDirectory() as folder:
            notebook = executed(name, Path(folder))
        for output in shown(notebook):
            if "image/png" in output.get("data", {}):
                output["data"]["image/png"] = in_few_colors(output["data"]["image/png"])
        nbformat.write(notebook, ROOT / "docs" / name)


if __name__ == "__main__":
    sys.exit(main())
