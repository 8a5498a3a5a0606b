"""The examples of README.md and docs/ run as they are printed, in a copy of what a clone has after `make build`."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
BLENDER = os.environ.get("BLENDER", "blender")
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md")), ROOT / "blend_samples" / "README.md",
         ROOT / "native" / "python" / "README.md"]
LINKED = ("build", "addon", "bench", "blend_samples", "docs", "native", "scripts", "CMakeLists.txt")
PATH = "build/python"  # as README.md says
LIMIT = 300  # seconds
# Names that stand for a file of the reader.
STANDS_FOR = {"IN.blend": "blend_samples/bowl.blend"}
NOT_RUN = re.compile(r"^(make |git )|make_samples\.py")  # build, test and install; the samples need minutes

pytestmark = pytest.mark.slow


def without_code(text):
    """A page without its fenced blocks."""
    return re.sub(r"^```.*?^```", "", text, flags=re.DOTALL | re.MULTILINE)


def blocks():
    """Commands, line by line, and Python blocks, of all pages."""
    for page in PAGES:
        text = page.read_text(encoding="utf-8")
        found = re.findall(r"^```(\w*)\n(.*?)^```", text, re.DOTALL | re.MULTILINE)
        found += [("", block) for block in re.findall(r"^\n((?:    \S.*\n)+)", without_code(text), re.MULTILINE)]
        for language, block in found:
            if language == "python" and page.name != "labs.md":  # that one: tests/labs/test_page.py
                yield pytest.param("python", block, id=f"{page.name}: Python")
            elif language in ("", "sh", "bash"):
                for line in filter(None, map(str.strip, block.splitlines())):
                    command = re.split(r"\s+#", line)[0].strip()
                    if command and not NOT_RUN.search(command):
                        yield pytest.param("shell", command, id=f"{page.name}: {command}")


ALL = list(blocks())


@pytest.fixture
def clone(tmp_path):
    for name in LINKED:
        if (ROOT / name).exists():
            (tmp_path / name).symlink_to(ROOT / name)
    return tmp_path


def run(words, folder, **variables):
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    environment |= {"PYTHONDONTWRITEBYTECODE": "1", **variables}
    return subprocess.run(words, cwd=folder, env=environment, capture_output=True, text=True, timeout=LIMIT)


@pytest.mark.parametrize("kind, text", ALL)
def test_an_example_runs_as_printed(kind, text, clone):
    if kind == "python":
        done = run([sys.executable, "-c", text], clone, PYTHONPATH=PATH)
    else:
        for name, file in STANDS_FOR.items():
            text = text.replace(name, file)
        if text.split()[0] == "blender":
            if not shutil.which(BLENDER):
                pytest.skip("Blender is not here")
            text = BLENDER + text.removeprefix("blender")
        text = re.sub(r"^python3?\b", sys.executable, text)
        done = run(["bash", "-euc", text], clone)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "Traceback" not in done.stderr


def test_there_are_examples_of_all_kinds():
    shown = "\n".join(example.values[1] for example in ALL)
    assert shown.count("build/koebe ") >= 6 and "koebe.uniformize(" in shown and "blender -b" in shown


def test_the_small_faces_are_what_their_maker_makes(tmp_path):
    done = run([sys.executable, ROOT / "blend_samples" / "make_obj.py", "--output", tmp_path], tmp_path)
    assert done.returncode == 0, done.stderr
    for name in ("face.obj", "surprised.obj"):
        made, kept = ((folder / name).read_text().split() for folder in (tmp_path, ROOT / "blend_samples"))
        assert len(made) == len(kept)
        # Five decimals are written; the last one may differ with the arithmetic of another machine.
        assert all(a == b or abs(float(a) - float(b)) < 1.5e-5 for a, b in zip(made, kept))


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_what_a_page_names_is_there(page):
    text = without_code(page.read_text(encoding="utf-8"))
    links = re.findall(r"\]\((?!https?:|#)([^)#]+)(?:#[^)]*)?\)", text)
    names = re.findall(r"`((?:tests|bench|scripts|addon|blend_samples|native)/[\w/.]+\.\w+)`", text)
    missing = [link for link in links if not link.endswith("../releases") and not (page.parent / link).exists()]
    missing += [name for name in names if not (ROOT / name).exists()]
    assert not missing
