"""What code says of a page is there, and what a page says of a file."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
SOURCES = [
    path
    for folder in ("native", "addon", "tests", "bench", "scripts", "blend_samples")
    for suffix in ("*.h", "*.cpp", "*.py", "*.sh")
    for path in sorted((ROOT / folder).rglob(suffix))
    if path != Path(__file__).resolve()
]
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", ROOT / "CHANGELOG.md", *sorted((ROOT / "docs").rglob("*.md"))]
TO_PAGE = re.compile(r'docs/(\w+\.md)(?:, "([^"]+)")?')
TO_FILE = re.compile(r"`((?:[\w.-]+/)+[\w.-]+\.(?:h|cpp|py|sh|json|txt|obj))`")
MADE = ("build/", "out/", "dist/", "shared/")  # not in the repository


def comment_text(path):
    """A file without the marks and line ends of its comments, so that a reference may run over a line."""
    return re.sub(r"\s*\n\s*(?:///?|#)?\s*", " ", path.read_text(encoding="utf-8"))


def headings(page):
    return re.findall(r"^#+ (.+)$", (ROOT / "docs" / page).read_text(encoding="utf-8"), re.MULTILINE)


def references():
    for path in SOURCES:
        for page, heading in TO_PAGE.findall(comment_text(path)):
            yield pytest.param(page, heading, id=f"{path.relative_to(ROOT)}: {page} {heading}")


@pytest.mark.parametrize("page, heading", references())
def test_the_pages_and_headings_that_code_names_exist(page, heading):
    assert (ROOT / "docs" / page).exists()
    assert not heading or heading in headings(page)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_the_files_that_a_page_names_exist(page):
    named = set(TO_FILE.findall(page.read_text(encoding="utf-8")))
    missing = [
        name
        for name in sorted(named)
        if not name.startswith(MADE)
        and not any((base / name).exists() for base in (ROOT, ROOT / "docs", *(ROOT / "native").iterdir()))
    ]
    assert not missing


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_links_lead_somewhere(page):
    for target, anchor in re.findall(r"\]\(([^)#\s]*)(#[\w-]+)?\)", page.read_text(encoding="utf-8")):
        if "://" in target:
            continue
        file = page.parent / target if target else page
        assert file.exists(), target
        if anchor:
            anchors = [
                "#" + re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")
                for heading in re.findall(r"^#+ (.+)$", file.read_text(encoding="utf-8"), re.MULTILINE)
            ]
            assert anchor in anchors, target + anchor
