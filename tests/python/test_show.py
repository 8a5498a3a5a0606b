"""Show: where cuts and darts keep away."""

import json
import sys
from pathlib import Path

import koebe
import numpy as np
import pytest
from cli_support import CANNOT_BE_MAPPED, obj_text
from cli_support import koebe as command
from test_parts import TRIANGLES, VERTICES

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "bench"))
import random_models  # noqa: E402


def creature():
    """A body with a head and four limbs, front and back alike: a sphere with bumps in the plane y = 0."""
    vertices, triangles = random_models.ball(5)
    directions = np.array([(0, 0, 1), (1, 0, 0.3), (-1, 0, 0.3), (0.5, 0, -1), (-0.5, 0, -1)], float)
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    near = np.clip(vertices @ directions.T, 0, 1)
    return vertices * (1 + 2.2 * (near**12).sum(axis=1))[:, None], triangles


def cut_share(result, vertices, triangles, weights):
    """The length of cuts, and the share of it that lies where the weight is 1."""
    sides = {}
    for face, corners in zip(triangles, result.uv, strict=True):
        for k in range(3):
            ends = [(face[k], tuple(corners[k])), (face[(k + 1) % 3], tuple(corners[(k + 1) % 3]))]
            a, b = sorted(ends)
            sides.setdefault((a[0], b[0]), []).append((a[1], b[1]))
    cuts = np.array([edge for edge, both in sides.items() if len(both) == 2 and both[0] != both[1]])
    lengths = np.linalg.norm(vertices[cuts[:, 0]] - vertices[cuts[:, 1]], axis=1)
    shown = weights[cuts].all(axis=1)
    return lengths.sum(), lengths[shown].sum() / lengths.sum()


MODELS = {"finger": lambda: (VERTICES, TRIANGLES), "creature": creature}


@pytest.mark.parametrize("darts", [0.0, 0.2])
@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize("model", MODELS)
def test_cuts_keep_away_from_the_half_that_is_shown(model, sign, darts):
    vertices, triangles = MODELS[model]()
    show = (sign * vertices[:, 1] > 1e-9).astype(float)
    plain = koebe.parts(vertices, triangles, darts=darts)
    turned = koebe.parts(vertices, triangles, darts=darts, show=show)
    before, after = (cut_share(one, vertices, triangles, show) for one in (plain, turned))
    print(model, sign, darts, before, after, plain, turned)
    assert turned.flipped == 0 and turned.converged
