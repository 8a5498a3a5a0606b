"""SVG drawings on surfaces: holes in letters, united paths, places and sizes, and damaged files."""

import json

import koebe
import numpy as np
import pytest
from cli_support import CANNOT_BE_MAPPED, USAGE, obj_text, succeeded
from cli_support import koebe as command
from test_lift import euler, loops_of, stored_areas, tube

RING = {"shape": "ring"}
SQUARE = "M0 0H10V10H0Z"
LETTER_O = "M10 0A10 10 0 0 1 -10 0A10 10 0 0 1 10 0Z M5 0A5 5 0 0 1 -5 0A5 5 0 0 1 5 0Z"


def svg(inside, extra=""):
    return f'<?xml version="1.0"?>\n<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9" {extra}>{inside}</svg>\n'


def path(data, extra=""):
    return f'<path d="{data}" {extra}/>'


@pytest.fixture
def lifted(tmp_path):
    """Lifts the text of a drawing onto a tube of radius 1 and height 2, which its map rolls off as it is."""

    def lift(text, **options):
        file = tmp_path / "drawing.svg"
        file.write_bytes(text if isinstance(text, bytes) else text.encode())
        return koebe.lift(*tube(), file, **{**RING, **options})

    return lift


def area_of(result, patch):
    corners = result.vertices[result.triangles[result.patch == patch]]
    return np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1).sum() / 2


def size_of(points):
    """Length along the tube's circumference, and height."""
    angle = np.arctan2(points[:, 1], points[:, 0])
    angle = (angle - angle[0] + np.pi) % (2 * np.pi) - np.pi
    return np.ptp(angle), np.ptp(points[:, 2])


def holes_of(result):
    loops = [result.vertices[loop] for loop in loops_of(result.triangles)]
    return [loop for loop in loops if np.ptp(loop[:, 2]) > 1e-9]


def test_a_raised_letter_keeps_its_hole(lifted):
    result = lifted(svg(path(LETTER_O, 'fill-rule="evenodd"')), size=0.8, height=0.001)
    assert result.outlines == 1 and result.islands == 0 and result.pattern == "drawing.svg"
    assert result.size == pytest.approx(0.8)
    assert euler(result.triangles) == 0 and len(loops_of(result.triangles)) == 2
    assert area_of(result, 1) == pytest.approx(np.pi * (0.4**2 - 0.2**2), rel=0.01)
    flat = result.triangles[result.patch < 2]
    assert euler(flat) == 0 and (stored_areas(result.uv[result.patch < 2]) > 0).all()


def test_an_island_falls_out_with_its_outline_and_is_told(lifted):
    target = LETTER_O + " M2 0A2 2 0 0 1 -2 0A2 2 0 0 1 2 0Z"
    result = lifted(svg(path(target, 'fill-rule="evenodd"')), size=0.8, perforate=True)
    assert result.outlines == 2 - 1 and result.islands == 1 and len(holes_of(result)) == 1
    (warning,) = [one for one in result.warnings if one.kind == "left_out"]
    assert "would hang on nothing" in warning.text and len(warning.elements) == 1
    raised = lifted(svg(path(target, 'fill-rule="evenodd"')), size=0.8, height=0.001)
    assert raised.outlines == 2 and raised.islands == 0
    assert area_of(raised, 1) == pytest.approx(np.pi * (0.4**2 - 0.2**2 + 0.08**2), rel=0.01)


def test_the_fill_rule_decides(lifted):
    twice = "M10 0A10 10 0 0 1 -10 0A10 10 0 0 1 10 0Z M5 0A5 5 0 0 1 -5 0A5 5 0 0 1 5 0Z"
    assert area_of(lifted(svg(path(twice)), size=0.8, height=0.001), 1) == pytest.approx(np.pi * 0.16, rel=0.01)
    inherited = f'<g fill-rule="evenodd">{path(twice)}</g>'
    assert area_of(lifted(svg(inherited), size=0.8, height=0.001), 1) == pytest.approx(np.pi * 0.12, rel=0.01)


def test_paths_that_cross_are_united(lifted):
    both = svg('<rect x="0" y="0" width="10" height="4"/><rect x="3" y="-3" width="4" height="10"/>')
    result = lifted(both, size=0.8, height=0.001)
    assert result.outlines == 1 and sum(result.left_out.values()) == 0
    assert area_of(result, 1) == pytest.approx(0.0064 * (40 + 40 - 16), rel=0.01)
    star = "M0 -10L5.878 8.09L-9.511 -3.09L9.511 -3.09L-5.878 8.09Z"
    assert lifted(svg(path(star)), size=0.8, perforate=True).outlines == 1


@pytest.mark.parametrize("turn, wide, high", [(0, 0.8, 0.2), (180, 0.8, 0.2), (90, 0.8, 3.2)])
def test_the_size_is_the_width_of_the_turned_drawing(lifted, turn, wide, high):
    bar = svg('<rect x="5" y="7" width="20" height="5"/>')
    if high > 2:
        wide, high = wide / 4, high / 4
    (hole,) = holes_of(lifted(bar, size=wide, turn=turn, perforate=True))
    assert size_of(hole) == pytest.approx((wide, high), abs=0.02)
    assert hole[:, 2].mean() == pytest.approx(1.0, abs=0.03)


def test_transforms_and_shapes(lifted):
    drawing = svg(
        '<g transform="translate(3 4) scale(2)"><circle cx="1" cy="1" r="2"/>'
        '<ellipse cx="9" cy="1" rx="2" ry="2"/><polygon points="-1,7 3,7 3,11 -1,11"/>'
        '<g transform="rotate(90)"><rect x="7" y="-11" width="4" height="4" rx="1"/></g></g>'
        '<defs><circle r="99"/></defs><circle r="99" display="none"/><line x1="0" y1="0" x2="9" y2="9"/>'
    )
    holes = holes_of(lifted(drawing, size=1.2, perforate=True))
    assert len(holes) == 4
    for hole in holes:
        assert size_of(hole) == pytest.approx((0.4, 0.4), abs=0.02)


def test_copies_go_round(lifted):
    drawing = svg(path(SQUARE))
    result = lifted(drawing, size=0.5, repeats=5, perforate=True)
    angles = np.sort([np.arctan2(*hole.mean(axis=0)[1::-1]) for hole in holes_of(result)])
    assert len(angles) == 5 and np.diff(angles) == pytest.approx(2 * np.pi / 5, abs=0.02)
    with pytest.raises(koebe.InputError, match="room up to a size of 1.25"):
        lifted(drawing, size=1.3, repeats=5, perforate=True)
    with pytest.raises(koebe.InputError, match="another domain does not repeat"):
        lifted(drawing, shape="disk", repeats=2, perforate=True)


def test_without_a_size_it_fills_the_room(lifted):
    (hole,) = holes_of(lifted(svg(path(SQUARE)), perforate=True))
    assert size_of(hole) == pytest.approx((1.8, 1.8), abs=0.05)


def test_what_is_not_drawn_is_told(lifted):
    result = lifted(svg(path(SQUARE) + path("M20 0L21 0L22 5") + "<text>a</text>"), size=0.4, perforate=True)
    assert result.outlines == 1 and result.left_out["open"] == 1
    assert {"left_out", "not_kept"} <= {warning.kind for warning in result.warnings}
    assert any("<text> is not drawn" in warning.text for warning in result.warnings)
    with pytest.raises(koebe.InputError, match="no closed path; it has text"):
        lifted(svg("<text>a</text>"), perforate=True)
    with pytest.raises(koebe.InputError, match="a drawing has its own bridges"):
        lifted(svg(path(SQUARE)), bridge=0.1, height=0.1)


DAMAGED = {
    "empty": "",
    "no xml": "solid\nfacet",
    "another root": "<html/>",
    "no namespace": f"<svg>{path(SQUARE)}</svg>".replace("<path", "<x:path"),
    "not closed": svg(path(SQUARE))[:-8],
    "zero byte": svg(path(SQUARE)).replace("10", "1\0"),
    "a number too large": svg(path("M0 0H1e400V10H0Z")),
    "an overflow by a transform": svg(path("M0 0H1e300V1e300H0Z", 'transform="scale(1e300)"')),
    "NaN": svg(path("M0 0HNaNV10H0Z")),
    "infinite": svg('<circle r="inf"/>'),
    "letters": svg(path("M0 0 hello Z")),
    "a negative radius": svg('<circle r="-5"/>'),
    "no area": svg(path("M0 0H10Z")),
    "one point": svg(path("M5 5Z")),
    "nested": svg("<g>" * 10_000 + path(SQUARE) + "</g>" * 10_000),
    "nested without end": svg("<g>" * 1_000_000),
    "a million pieces": svg(path("M0 0" + "H1V1" * 510_000 + "Z")),
    "too many corners": svg(path("M0 0" + "".join(f"L{k % 977} {k % 1009}" for k in range(201_000)) + "Z")),
}


@pytest.mark.parametrize("text", DAMAGED.values(), ids=DAMAGED.keys())
def test_a_damaged_drawing_is_refused(lifted, text):
    with pytest.raises(koebe.InputError):
        lifted(text, perforate=True)


@pytest.mark.slow
def test_any_cut_or_changed_byte_is_refused_or_drawn(lifted):
    letter = path(LETTER_O, 'fill-rule="evenodd" transform="rotate(30)"')
    whole = svg(letter + '<rect x="2" y="30" width="4" height="3"/>')
    random = np.random.default_rng(35)
    drawn = 0
    for _ in range(150):
        data = bytearray(whole.encode())
        if random.random() < 0.4:
            del data[random.integers(len(data)) :]
        for _ in range(random.integers(4)):
            if data:
                data[random.integers(len(data))] = random.choice(list(b"<>/=0-e\xff\x00 z"))
        try:
            result = lifted(bytes(data), size=0.6, height=0.001)
        except koebe.InputError:
            continue
        drawn += 1
        assert euler(result.triangles) == 0 and (stored_areas(result.uv[result.patch < 2]) > 0).all()
    assert 10 < drawn < 150


def test_the_command_reads_a_drawing(tmp_path):
    (tmp_path / "in.obj").write_text(obj_text(*tube()))
    (tmp_path / "logo.SVG").write_text(svg(path(SQUARE)))
    options = ["--shape", "ring", "--size", "0.4", "--perforate"]
    run = succeeded("lift", "in.obj", "logo.SVG", "out.obj", *options, "--json", "r.json", cwd=tmp_path)
    assert "1 outline cut out" in run.stdout, run.stderr
    report = json.loads((tmp_path / "r.json").read_text())
    assert report["pattern"] == "logo.SVG" and report["islands"] == 0 and report["left_out"]["open"] == 0
    (tmp_path / "bad.svg").write_text("<svg")
    for pattern, out, code in (
        ("bad.svg", "no.obj", CANNOT_BE_MAPPED),
        ("none.svg", "no.obj", CANNOT_BE_MAPPED),
        ("logo.SVG", "logo.SVG", USAGE),
        ("logo.gif", "no.obj", USAGE),
    ):
        run = command("lift", "in.obj", pattern, out, *options, cwd=tmp_path)
        assert run.returncode == code and run.stderr, (pattern, run.stderr)
        assert not (tmp_path / "no.obj").exists()
    assert (tmp_path / "logo.SVG").read_text() == svg(path(SQUARE))


def test_a_file_that_is_not_there_is_an_error_of_files(tmp_path):
    with pytest.raises(koebe.FileError, match="cannot read") as caught:
        koebe.lift(*tube(), tmp_path / "no.svg", perforate=True, **RING)
    assert isinstance(caught.value, OSError) and isinstance(caught.value, koebe.KoebeError)
