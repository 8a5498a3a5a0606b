"""Pictures of a result."""

import sys

import koebe
import numpy as np
import pytest
from test_meshes import TRIANGLES, VERTICES

RESULT = koebe.uniformize(VERTICES, TRIANGLES)


@pytest.mark.parametrize("field", ["checker", "log_scale", "angle_error"])
def test_the_surface_and_its_domain_are_drawn(field, tmp_path):
    figure = koebe.plot(RESULT, field=field)
    space, plane = figure.axes[:2]
    assert len(figure.axes) == (2 if field == "checker" else 3)  # with a colour bar
    drawn = [(*patch.center, patch.radius) for patch in plane.patches]
    assert np.allclose(drawn, np.column_stack([RESULT.centers, RESULT.radii]))
    assert len(plane.collections[0].get_paths()) == len(TRIANGLES)
    figure.savefig(tmp_path / "picture.png")
    assert (tmp_path / "picture.png").stat().st_size > 10_000


def test_another_field_is_an_error():
    with pytest.raises(koebe.OptionError, match="field must be one of checker, log_scale, angle_error"):
        koebe.plot(RESULT, field="area")


def test_matplotlib_is_loaded_by_no_one_else():
    import subprocess

    done = subprocess.run([sys.executable, "-c", "import koebe, sys; sys.exit('matplotlib' in sys.modules)"])
    assert done.returncode == 0
