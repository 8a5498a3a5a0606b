"""The UV layout as flat pieces and as SVG: lengths, cuts, boundaries, millimetres. Without Blender."""

import dataclasses
import xml.etree.ElementTree as ET

import numpy as np
import pytest
from addon_support import named_module
from test_moebius import ring_domain, surface_of

flat, svg = named_module("flat_layout"), named_module("flat_svg")
SVG = "{http://www.w3.org/2000/svg}"


def strip(columns=6, rows=3, bend=0.0):
    """A strip of unit squares, rolled up around y with that angle a column, and its isometric UVs."""
    x, y = np.meshgrid(np.arange(columns + 1.0), np.arange(rows + 1.0))
    chord = 0.5 / np.sin(0.5 * bend) if bend else 0.0
    place = [chord * np.sin(bend * x), y, chord * np.cos(bend * x)] if bend else [x, y, 0 * x]
    vertices = np.stack(place, axis=-1).reshape(-1, 3)
    at = np.arange((columns + 1) * (rows + 1)).reshape(rows + 1, columns + 1)
    quads = np.stack([at[:-1, :-1], at[:-1, 1:], at[1:, 1:], at[1:, :-1]], axis=-1).reshape(-1, 4)
    surface = surface_of(vertices, quads)
    flat_uv = np.stack([x, y], axis=-1).reshape(-1, 2)[surface.corner_vertex] / 10.0
    return surface, flat_uv.astype(np.float32)


@pytest.mark.parametrize("bend", [0.0, 0.3])
def test_what_can_be_unrolled_gets_its_true_lengths(bend):
    surface, uv = strip(bend=bend)
    layout = flat.flat_layout(surface, uv)
    assert np.abs(layout.points.max(axis=0) - [6.0, 3.0]).max() < 1e-5
    assert layout.is_true and layout.lengths == pytest.approx((1.0, 1.0), abs=1e-5)
    assert layout.describe() == "true to scale: lengths are 100 % to 100 % of lengths on the surface (9 of 10 edges)"
    (piece,) = layout.pieces
    assert len(piece.outline) == 18 and piece.holes == []
    assert len(layout.edges) == 6 * 2 + 5 * 3


def test_it_is_cut_where_the_uvs_are_cut():
    surface, uv = strip()
    right = surface.corner_vertex.reshape(-1, 4).max(axis=1) % 7 > 3
    uv.reshape(-1, 4, 2)[right] += [0.05, 0.0]
    layout = flat.flat_layout(surface, uv)
    assert sorted(len(piece.outline) for piece in layout.pieces) == [12, 12]
    assert len(layout.points) == 2 * 16 and len(layout.faces) == 18
    assert np.abs(layout.points[layout.corner_vertex] - 10.0 * uv[layout.corners]).max() < 1e-5


def test_holes_are_told_from_outlines():
    surface, uv, result = ring_domain()
    (piece,) = flat.flat_layout(surface, uv).pieces
    assert sorted(map(len, piece.holes)) == sorted(len(loop) for loop in result.loops[1:])
    assert len(piece.outline) == len(result.loops[0])


def test_how_far_lengths_are_off_is_said():
    surface, uv = strip()
    uv[:, 0] *= 2.0  # with the areas right in the mean, one direction is √2 too long and the other too short
    layout = flat.flat_layout(surface, uv)
    assert layout.lengths == pytest.approx((0.5**0.5, 2**0.5), abs=1e-5) and not layout.is_true
    assert layout.describe().startswith("not true to scale: lengths are 70.71 % to 141.4 %")


def test_faces_without_uvs_are_left_out_and_counted():
    surface, uv = strip()
    uv.reshape(-1, 4, 2)[:2] = 0.0
    layout = flat.flat_layout(surface, uv)
    assert layout.left_out == 2 and len(layout.faces) == 16
    for wrong, text in ((0 * uv, "no UVs"), (np.nan * uv, "not finite")):
        with pytest.raises(flat.FlatError, match=text):
            flat.flat_layout(surface, wrong)
    with pytest.raises(flat.FlatError, match="no UVs"):
        flat.flat_layout(dataclasses.replace(surface, selected=np.zeros_like(surface.selected)), uv)


def points_of(path):
    """Points (k, 2) of a path of the SVG."""
    return np.array([pair.split() for pair in path.get("d")[1:-1].split("L")], dtype=float)


def test_the_drawing_is_in_millimetres_with_holes_first():
    surface, uv, _ = ring_domain()
    layout = flat.flat_layout(surface, uv)
    root = ET.fromstring(svg.flat_svg([("A & <B>", layout)], 1000.0))
    wide, high = 1000.0 * layout.points.max(axis=0) + 2 * svg.BORDER
    assert root.get("width").endswith("mm") and float(root.get("width")[:-2]) == pytest.approx(wide, abs=1e-3)
    assert root.get("viewBox").split()[2:] == [root.get("width")[:-2], root.get("height")[:-2]]
    assert float(root.get("height")[:-2]) == pytest.approx(high, abs=1e-3)
    assert "true to scale" in root.find(f"{SVG}desc").text
    (group,) = root.findall(f"{SVG}g/{SVG}g")
    assert group.get("id") == "A & <B> 1"
    paths = group.findall(f"{SVG}path")
    assert [path.get("class") for path in paths] == 6 * ["hole"] + ["outline"]
    outline = points_of(paths[-1])
    expected = 1000.0 * layout.points[layout.pieces[0].outline]
    assert np.abs(outline[:, 0] - expected[:, 0] - svg.BORDER).max() < 1e-3
    assert np.abs(float(root.get("height")[:-2]) - svg.BORDER - outline[:, 1] - expected[:, 1]).max() < 1e-3


def test_edges_are_engraved_if_asked_and_objects_lie_side_by_side():
    surface, uv = strip()
    layout = flat.flat_layout(surface, uv)
    root = ET.fromstring(svg.flat_svg([("One", layout), ("Two", layout)], 10.0, edges=True))
    assert [g.get("id") for g in root.findall(f"{SVG}g/{SVG}g")] == ["One 1", "Two 1"]
    first, second = (points_of(path) for path in root.iter(f"{SVG}path") if path.get("class") == "outline")
    assert second[:, 0].min() - first[:, 0].max() == pytest.approx(svg.BORDER)
    engraved = [path for path in root.iter(f"{SVG}path") if path.get("class") == "engrave"]
    assert len(engraved) == 2 and engraved[0].get("d").count("M") == len(layout.edges)
