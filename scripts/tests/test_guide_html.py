"""The pages of the zip: their text is that of docs/, and their links lead somewhere."""

import html
import re
from pathlib import Path

import pytest
from guide_html import PAGES, page

ROOT = Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs"
MADE = {name: page((DOCS / f"{name}.md").read_text(encoding="utf-8"), name) for name in PAGES}


def test_each_construct():
    made = page("# A *b*: `c*d`\n\nOne\ntwo, **three**.\n![no\npicture](x.png)\n- p\n  q\n- r\n\n"
                "| h | i |\n| --- | --- |\n| [t](guide.md#a-b) | [u](even.md) |\n\n"
                "```text\n<x> *y*\n```\n", "T")  # fmt: skip
    body = re.sub(r"\s*\n\s*", " ", made.split("<body>\n")[1].split("\n</body>")[0])
    for part in (
        '<h1 id="a-b-cd">A <em>b</em>: <code>c*d</code></h1>', "<p>One two, <strong>three</strong>. </p>",
        "<ul> <li>p q</li> <li>r</li> </ul>", '<td><a href="guide.html#a-b">t</a></td> <td>u</td>',
        "&lt;x&gt; *y*",
    ):  # fmt: skip
        assert part in body
    assert "<img" not in made and "even" not in made
    assert "<td>uv.koebe_pack</td>" in page("- [All](data/operators.csv)\n", "T")


@pytest.mark.parametrize("name", PAGES)
def test_links_lead_somewhere(name):
    ids = {of: set(re.findall(r'id="([^"]*)"', text)) for of, text in MADE.items()}
    for target in re.findall(r'href="([^"]*)"', MADE[name]):
        of, _, place = target.partition("#")
        if not target.startswith("https:"):
            assert not place or place in ids[of.removesuffix(".html") or name], target


@pytest.mark.parametrize("name", PAGES)
def test_no_words_are_lost_and_no_signs_are_left(name):
    source = re.sub(r"<!--.*?-->|!\[[^\]]*\]\([^)]*\)", "", (DOCS / f"{name}.md").read_text(encoding="utf-8"))
    source = re.sub(r"\]\([^)]*\)|^```text|^- |^\d+\. ", " ", source, flags=re.MULTILINE)
    shown = html.unescape(re.sub(r"<pre>.*?</pre>|<style>.*?</style>|<title>.*?</title>|<[^>]*>", "  ", MADE[name],
                                 flags=re.DOTALL))  # fmt: skip
    assert "**" not in shown and "](" not in shown
    words = re.findall(r"\w+", re.sub(r"```.*?```", "", source, flags=re.DOTALL))
    assert words and {*words} - {*re.findall(r"\w+", html.unescape(re.sub(r"<[^>]*>", " ", MADE[name])))} == set()
