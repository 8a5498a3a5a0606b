"""Tubes cut open and unrolled by the add-on, without Blender."""

import koebe
import numpy as np
import pytest
from addon_support import named_module
from test_domains import GIRTH, pipe, uneven
from test_moebius import surface_of

islands, tube, triangles_of = named_module("islands"), named_module("tube"), named_module("triangles")


@pytest.mark.parametrize("girths", [2.0, 12.0, 1000.0])
def test_a_tube_of_any_length_is_unrolled_to_its_rectangle(girths):
    surface = surface_of(*pipe(uneven(girths * GIRTH, 150)))
    (island,) = islands.cut_into_islands(surface)
    loops = koebe.boundary_loops(island.triangles)
    ((sheet, flat),) = tube.unroll(koebe, surface, [(island, loops, False)])
    assert (triangles_of.signed_areas(flat, sheet.triangles) > 0).all()
    width, height = np.ptp(flat, axis=0)
    assert height / width > 0.9 * girths  # the cut is a zigzag: a little wider than one turn
    for loop in loops:
        there = np.isin(sheet.source_vertex, island.source_vertex[loop])
        assert np.ptp(flat[there, 1]) < 1e-6
