"""The words of docs/glossary.md: those that have gone do not come back into code, pages and interface."""

import re
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PAGE = (ROOT / "docs/glossary.md").read_text(encoding="utf-8")
SEARCHED = ("native", "addon", "docs", "README.md", "CONTRIBUTING.md")
SUFFIXES = {".h", ".cpp", ".py", ".md", ".json", ".cmake", ".txt"}
NOT_SEARCHED = (
    "docs/glossary.md", "native/python/koebe/_report_entries.py",  # they name the words
)  # fmt: skip
GONE = {  # words that are more, or less, than an identifier
    "flap": "flap", "crumb": "crumb", "foretold": "foretold", "hang": r"\b(?:hangs?|hung)\b(?! on nothing)",
    "heap of sources": "koebe_heap|heaps? of sources", "told": r"\btold\b(?! to )|told_|_told",
}  # fmt: skip


def table(heading):
    """First cells of the rows of the table under a heading."""
    rows = re.findall(r"^\| (.+?) \|", PAGE.split(heading)[1].split("\n## ")[0], re.MULTILINE)
    return rows[2:]


def pattern_of(word):
    return GONE.get(word, rf"(?<![a-z]){word}(?![a-z])")


def texts():
    files = subprocess.run(["git", "ls-files", "-z", *SEARCHED], cwd=ROOT, capture_output=True, check=True).stdout
    for name in files.decode().split("\0"):
        if name and not name.startswith(NOT_SEARCHED) and Path(name).suffix in SUFFIXES:
            yield name, (ROOT / name).read_text(encoding="utf-8")


def words_that_have_gone():
    return [word for cell in table("## Words that have gone") for word in cell.split(", ")]


def test_words_that_have_gone_do_not_come_back():
    gone = re.compile("|".join(map(pattern_of, words_that_have_gone())), re.IGNORECASE)
    found = [f"{name}: {match[0]}" for name, text in texts() for match in gone.finditer(text)]
    assert not found


@pytest.mark.parametrize("word", words_that_have_gone())
def test_each_of_them_is_found_where_it_is(word):
    line = {"heap of sources": "koebe_heaps(target)"}.get(word, f"void {word}(int x);")
    assert re.search(pattern_of(word), line)


def test_each_word_has_a_reference_on_one_page():
    rows = re.findall(r"^\| (.+?) \| (.+?) \| (.+) \|$", PAGE.split("## Words")[0].replace(r"\|", ""), re.MULTILINE)
    assert len(rows) > 30 and all(re.search(r"\d|\]\(", row[2]) or "manual" in row[2] for row in rows[2:])
    assert PAGE.count("\n") <= 60
