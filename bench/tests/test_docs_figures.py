"""What README.md and docs/ say in figures is in docs/figures.json, and that is what a measurement gives."""

import json
import re
import sys
from pathlib import Path

import against_bff
import doc_figures
import doc_tables
import pytest
import reproduce
from doc_tables import TABLES

ROOT = Path(__file__).resolve().parents[2]
FIGURES = doc_figures.load()
# Each has its command in the file.
MEASURED_ELSEWHERE = {
    "reliability", "commands", "cancel", "bff", "cortex", "cortex_lesions", "scans", "planar", "oracle",
    "noise", "power", "shared",
}  # fmt: skip
CHEAP = {"quality", "polish", "balance", "limits", "same_shape", "faces", "distances"}
LARGE = re.compile(r"fig1?\d_|_40tight|mountain_|neutral")
NUMBER = re.compile(r"-?[\d,]+(?:\.\d+)?(?:e[-+]?\d+)?")

pytestmark = pytest.mark.slow


def last_digit(text):
    """What one unit in the last printed digit is worth."""
    mantissa, _, exponent = text.replace(",", "").partition("e")
    decimals = len(mantissa.partition(".")[2])
    return 10.0 ** (int(exponent or 0) - decimals)


def agree(printed, measured):
    """The same words, whole numbers equal, others within one unit of the last printed digit."""
    if not NUMBER.fullmatch(printed) or not NUMBER.fullmatch(measured):
        return printed == measured
    one, other = (float(text.replace(",", "")) for text in (printed, measured))
    whole = "." not in printed and "e" not in printed
    return one == other if whole else abs(one - other) <= 1.01 * max(last_digit(printed), last_digit(measured))


def test_the_comparison_itself_sees_a_difference():
    assert agree("0.71", "0.72") and not agree("0.71", "0.73")
    assert agree("2.1e-03", "2.2e-03") and not agree("2.1e-03", "2.3e-03") and not agree("2.1e-03", "2.1e-04")
    assert agree("1,328", "1,328") and not agree("1,328", "1,329") and not agree("5", "6")
    assert not agree("0.71", "below 1e-9")


@pytest.mark.parametrize("page", doc_figures.pages(), ids=lambda page: page.name)
def test_every_marked_place_says_what_the_figures_say(page):
    text = page.read_text(encoding="utf-8")
    assert doc_figures.filled(text, FIGURES) == text, "bench/doc_figures.py write"


def test_every_mark_is_closed_and_every_table_is_used():
    text = "\n".join(page.read_text(encoding="utf-8") for page in doc_figures.pages())
    starts = re.findall(r"<!-- figures?: (.*?) -->", text)
    assert len(starts) == len(doc_figures.MARK.findall(text)) == text.count("<!-- end -->")
    assert {re.split("/| ", start)[0] for start in starts} == set(FIGURES)
    assert set(FIGURES) == set(TABLES) | MEASURED_ELSEWHERE
    assert not re.search(r"^<!-- figure: ", text, re.MULTILINE), "a comment at the margin ends its paragraph"


def test_a_changed_figure_is_seen():
    page = (ROOT / "docs" / "benchmarks.md").read_text(encoding="utf-8")
    changed = json.loads(json.dumps(FIGURES))
    changed["quality"]["rows"]["face"][2] = "0.01"
    assert doc_figures.filled(page, changed) != page
    row = "<!-- figures: quality | face -->\n\n{}\n\n<!-- end -->"
    assert "| 0.01 |" in doc_figures.filled(row, changed) and doc_figures.filled(row, changed).count("\n| ") == 2
    narrow = row.replace("face -->", "face || angle error -->")
    assert "| mesh | angle error |\n|---|---|\n| face | 0.01 |\n" in doc_figures.filled(narrow, changed)


def test_the_beginning_of_a_name_is_enough_if_no_other_begins_so():
    assert doc_figures.figure(FIGURES, "quality/choi_a/angle") == FIGURES["quality"]["rows"]["choi_alex3"][2]
    assert doc_figures.named(["face", "face_finer"], "face") == "face"
    with pytest.raises(ValueError, match="too many"):
        doc_figures.figure(FIGURES, "quality/choi_/angle")


def test_without_the_peer_the_last_measurement_is_printed(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(against_bff, "SOURCE", tmp_path)
    monkeypatch.setattr(sys, "argv", ["against_bff.py"])
    against_bff.main()
    printed = capsys.readouterr().out
    assert f"Measured on {FIGURES['bff']['date']}" in printed and doc_figures.markdown(FIGURES["bff"]) in printed


def test_the_angle_error_of_both_commands_is_the_one_of_the_report(tmp_path):
    sample = ROOT / "blend_samples" / "face.obj"
    report = doc_tables.report("face")
    doc_tables.run(doc_tables.KOEBE, "uniformize", sample, tmp_path / "out.obj", "--quiet")
    points, _, corners = against_bff.arrays(sample)
    assert len(corners) == report["faces"]
    error = against_bff.angle_error(points, tmp_path / "out.obj")
    assert error == pytest.approx(report["angle_error_deg"]["mean"], rel=1e-9)


def rows():
    for name in sorted(CHEAP):
        for row in FIGURES[name]["rows"]:
            if not LARGE.search(row):
                yield pytest.param(name, row, id=f"{name}: {row}")


@pytest.mark.parametrize("name, row", rows())
def test_a_measurement_gives_the_figures(name, row):
    table = TABLES[name]
    if not all(path.exists() for path in table.needs(row)):
        pytest.skip("this scan is not in the repository")
    measured = table.cells(row)
    printed = FIGURES[name]["rows"][row]
    assert len(measured) == len(printed) == len(FIGURES[name]["head"]) - 1
    wrong = [pair for pair in zip(printed, measured) if not agree(*pair)]
    assert not wrong, f"bench/doc_figures.py measure {name}"


@pytest.mark.parametrize("row", FIGURES["exact"]["rows"])
def test_exact_domains_give_the_figures(row):
    if "condensed" not in row:
        pytest.skip("the mesh engine takes long")
    table = TABLES["exact"]
    if not all(path.exists() for path in table.needs(row)):
        pytest.skip("build/bench/koebe_bench is not built")
    assert all(agree(*pair) for pair in zip(FIGURES["exact"]["rows"][row], table.cells(row)))


# ---------------------------------------------------------------- docs/reproduction.md: samples of `make reproduce`


def bare(cell):
    return cell.removesuffix("°")


@pytest.mark.parametrize("figure, name, holes, faces", [s for s in reproduce.SURFACES if s[3] < 36000])
def test_the_comparison_of_methods_holds(figure, name, holes, faces, tmp_path, monkeypatch):
    scan = reproduce.MESHES / f"{name}.obj"
    if not scan.exists():
        pytest.skip("this scan is not in the repository")
    monkeypatch.setattr(reproduce, "OUT", tmp_path)
    printed = FIGURES["scans"]["rows"][f"{figure}, condensed"]
    measured = reproduce.result_cells(reproduce.measure(scan, reproduce.RUNS["condensed"], 1))
    assert all(agree(*map(bare, pair)) for pair in zip(printed[3:9], measured))


def test_the_rates_of_the_theorems_hold():
    if not reproduce.convergence.RATES.exists():
        pytest.skip("build/bench/koebe_rates is not built")
    row = "circles far apart, condensed"
    for printed, measured in zip(FIGURES["rates"]["rows"][row], TABLES["rates"].cells(row)):
        # Slopes fitted to errors down to round-off: one digit.
        assert float(printed) == pytest.approx(float(measured), rel=0.15)
