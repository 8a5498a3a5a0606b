"""The paper on the project: its sections and length are as its journal asks, its references are listed, and its figures
are the measured ones."""

import csv
import json
import re
from pathlib import Path
from statistics import median

import pytest

ROOT = Path(__file__).resolve().parents[2]
PAPER = ROOT / "paper"
HEAD, BODY = (PAPER / "paper.md").read_text(encoding="utf-8").split("---\n", 2)[1:]
FIGURES = json.loads((ROOT / "docs" / "figures.json").read_text(encoding="utf-8"))


def number(cell):
    return float(cell.split()[0].replace(",", ""))


def said(pattern):
    """The numbers that the paper says at that place."""
    found = re.search(pattern, " ".join(BODY.split()))
    assert found, pattern
    return [number(group) for group in found.groups()]


def test_it_has_the_sections_and_the_length_that_the_journal_asks_for():
    sections = re.findall(r"(?m)^# (.*)$", BODY)
    assert {"Summary", "Statement of need", "State of the field", "Software design", "Research impact statement",
            "AI usage disclosure", "Acknowledgements", "References"} <= set(sections)  # fmt: skip
    assert sections[0] == "Summary" and sections[-1] == "References"
    assert 750 <= len(BODY.split()) <= 1750
    assert all(f"{field}:" in HEAD for field in ("title", "tags", "authors", "affiliations", "date", "bibliography"))


def test_every_reference_is_listed_and_every_listed_one_is_cited():
    listed = re.findall(r"(?m)^@\w+\{(\w+),", (PAPER / "paper.bib").read_text(encoding="utf-8"))
    assert sorted(set(listed)) == sorted(listed)
    assert set(re.findall(r"@([a-z]+\d*)\b", BODY)) == set(listed)


def test_pictures_are_there_and_mentioned():
    pictures = re.findall(r"\\label\{(fig:\w+)\}\]\(([^)]+)\)", BODY)
    assert len(pictures) == 3
    for label, path in pictures:
        assert (PAPER / path).exists() and f"\\autoref{{{label}}}" in BODY


def test_figures_beside_the_peer_are_the_measured_ones():
    rows = [[number(cell) for cell in row] for name, row in FIGURES["bff"]["rows"].items() if "median" not in name]
    angles = said(r"over (\d+) meshes the median of the mean angle error is ([\d.]+)° with BFF and ([\d.]+)°")
    assert angles == pytest.approx([len(rows), *(median(row[place] for row in rows) for place in (3, 2))], abs=0.006)
    longest = max(rows, key=lambda row: row[1])
    (usual,) = said(r"takes ([\d.]+) times as long as that of BFF")
    assert usual == pytest.approx(median(row[1] for row in rows), abs=0.006)
    longer, times, faces = said(r"longer on (\d+) meshes, and (\d+) times as long on one mesh of (\d+) faces")
    assert (longer, times, faces) == (sum(row[1] > 1 for row in rows), int(longest[1]), longest[0])


def test_answers_to_random_surfaces_are_the_measured_ones():
    right, error, open_end, wrong = (
        sum(number(row[place]) for row in FIGURES["commands"]["rows"].values()) for place in (1, 2, 3, 4))
    assert wrong == 0 and "none was wrong" in " ".join(BODY.split())
    answers = said(r"Of ([\d,]+) answers none was wrong: ([\d,]+) were right, (\d+) were typed errors, and (\d+) said")
    assert answers == [right + error + open_end, right, error, open_end]


def test_figures_of_planar_domains_are_the_measured_ones():
    with open(ROOT / "docs" / "data" / "planar_peers.csv", encoding="utf-8", newline="") as file:
        rows = [row for row in csv.DictReader(file) if row["domain"].startswith("b")]
    programs = ("koebe planar", "PlgCirMap, its default")
    ours, theirs = ([row for row in rows if row["program"] == name] for name in programs)
    for pattern, measured in (("module of {0} after {0} s", ours), ("differs from it by {0} after {0} s", theirs)):
        three = r"([\d.e-]+), ([\d.e-]+) and ([\d.e-]+)"
        columns = [number(row[name]) for name in ("error of the module", "processor seconds") for row in measured]
        assert said(pattern.format(three)) == columns


def test_figures_of_the_cortex_are_the_measured_ones():
    rows = FIGURES["cortex"]["rows"]
    ours = next(row for name, row in rows.items() if name.startswith("free, E = 0.825"))
    theirs = rows["FreeSurfer's"]
    errors = said(r"distance \(([\d.]+) % against ([\d.]+) %\), of angle \(([\d.]+)° against ([\d.]+)°\)")
    measured = [number(row[place].replace("°", "")) for place in (2, 0) for row in (ours, theirs)]
    assert errors == pytest.approx(measured, abs=0.06)


def test_figures_beside_xatlas_are_those_of_the_comparison():
    page = " ".join((ROOT / "docs" / "comparison.md").read_text(encoding="utf-8").split())
    cuts, islands, density = said(
        r"have ([\d.]+) times the cuts of xatlas, ([\d.]+) times its islands and ([\d.]+) times its"
    )
    (angle,) = said(r"The angle error is ([\d.]+) times")
    for figure in (f"{cuts} times as long, and {islands} times as many islands", f"{density} times xatlas's",
                   f"angle error is {angle} times xatlas's"):  # fmt: skip
        assert figure in page
