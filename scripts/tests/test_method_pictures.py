"""The pictures of docs/method.md are what their script draws, and show what the page says."""

from pathlib import Path

import method_pictures
import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[2]


@pytest.mark.parametrize("name", method_pictures.PICTURES)
def test_a_picture_is_what_the_script_draws(name):
    drawn = (ROOT / "docs" / "images" / f"{name}.svg").read_text(encoding="utf-8")
    assert drawn == method_pictures.PICTURES[name]()


def test_the_point_of_an_automorphism():
    z = np.exp(1j * np.arange(7.0))
    assert method_pictures.point_taken_to_zero(z, 1j * method_pictures.moved(z, 0.3 - 0.2j)) == pytest.approx(
        0.3 - 0.2j
    )
