"""Progress and cancel of every long call."""

import contextlib
import signal
import threading
import time
from functools import cache, partial
from pathlib import Path

import koebe
import numpy as np
import pytest
from domain_surfaces import holed_ring, holed_torus
from handle_surfaces import double_ring
from sphere_surfaces import icosphere

SAMPLES = Path(__file__).resolve().parents[2] / "blend_samples"
CIRCLES = [[-0.3, 0.2], [0.3, 0.2], [0.0, -0.4]], [0.15, 0.15, 0.1]


@cache
def disk(name):
    return koebe.uniformize(SAMPLES / f"{name}.obj")


@cache
def ball(frequency, height=1.2):
    points, triangles = icosphere(frequency)
    return koebe.sphere_map(points * [1.0, 1.0, height], triangles)


def five_tori():
    vertices, triangles = holed_torus(3, holes={})[:2]
    return (np.concatenate([vertices + [3.0 * k, 0, 0] for k in range(5)]),
            np.concatenate([triangles + k * len(vertices) for k in range(5)]))  # fmt: skip


def depths(*spheres):
    return tuple(np.cos(sphere.points @ [3.0, 1.0, 2.0]) for sphere in spheres)


def marks(count):
    return [(7 * k, 7 * k + 1) for k in range(count)]


def fresh(result):
    """The result without the finer mesh's circles, which it would keep."""
    vars(result).pop("_refined", None)
    return result


CALLS = {
    "transfer": lambda: partial(koebe.transfer, disk("face"), disk("surprised")),
    "transfer, landmarks": lambda: partial(koebe.transfer, disk("face"), disk("surprised"), landmarks=[(200, 210)]),
    "transfer, no fit": lambda: partial(koebe.transfer, disk("face"), disk("surprised"), fit=False),
    "transfer, spheres": lambda: partial(koebe.transfer, ball(6), ball(6, 1.3), landmarks=marks(4)),
    "transfer, fields": lambda: partial(koebe.transfer, ball(6), ball(6, 1.3), fields=depths(ball(6), ball(6, 1.3))),
    "transfer, bend": lambda: partial(koebe.transfer, ball(6), ball(6, 1.3), landmarks=marks(4), bend=True),
    "transfer, bend fields": lambda: partial(
        koebe.transfer, ball(6), ball(6, 1.3), fields=depths(ball(6), ball(6, 1.3)), bend=True
    ),
    "teichmueller": lambda: partial(koebe.teichmueller, disk("face"), disk("surprised")),
    "fit_circles": lambda: partial(koebe.fit_circles, SAMPLES / "face.obj", *CIRCLES),
    "fit_circles, extremal": lambda: partial(koebe.fit_circles, SAMPLES / "face.obj", *CIRCLES, extremal=True),
    "certified_moduli": lambda: partial(koebe.certified_moduli, SAMPLES / "face.obj"),
    "planar": lambda: partial(koebe.planar, [[(-2, -2), (2, -2), (0, 2)], [(0, 0), (0.5, -1), (-0.5, -1)]]),
    "uniformize": lambda: partial(koebe.uniformize, SAMPLES / "face.obj"),
    "uniformize, many pieces": lambda: partial(koebe.uniformize, *five_tori(), cut=True),
    "torus_map": lambda: partial(koebe.torus_map, *holed_torus(6)[:2]),
    "ring_map": lambda: partial(koebe.ring_map, *holed_ring(6)[:2]),
    "sphere_map": lambda: partial(koebe.sphere_map, *icosphere(10)),
    "sphere_map, holes": lambda: partial(koebe.sphere_map, *holed_ring(6)[:2]),
    "schottky_map": lambda: partial(koebe.schottky_map, *double_ring(4)[:2]),
    "parts": lambda: partial(koebe.parts, *icosphere(10)),
    "open_surface": lambda: partial(koebe.open_surface, SAMPLES / "face.obj"),
    "module_error": lambda: partial(koebe.module_error, fresh(disk("face"))),
    "noise_error": lambda: partial(koebe.noise_error, disk("face"), noise=0.01, samples=3),
    "family": lambda: partial(koebe.family, [disk("face"), disk("surprised")]),
    "family, errors": lambda: partial(koebe.family, [fresh(disk("face")), fresh(disk("surprised"))], error=True),
    "family, spheres": lambda: partial(koebe.family, [ball(6), ball(6, 1.3), ball(6, 1.4)]),
}


@pytest.mark.parametrize("name", CALLS)
def test_progress_never_falls_and_ends_at_1(name):
    seen = []
    CALLS[name]()(progress=lambda fraction, stage: seen.append((fraction, stage, threading.get_ident())))
    fractions = [fraction for fraction, _, _ in seen]
    assert len(seen) > 1 and fractions == sorted(fractions) and fractions[0] >= 0.0 and fractions[-1] == 1.0
    assert all(stage for _, stage, _ in seen) and {thread for *_, thread in seen} == {threading.get_ident()}


@pytest.mark.parametrize("name", CALLS)
def test_a_token_and_an_exception_end_the_call_and_the_next_is_whole(name):
    raised = koebe.CancelToken()
    raised.cancel()
    with pytest.raises(koebe.Cancelled):
        CALLS[name]()(cancel=raised)
    stages = []

    def stop(fraction, stage, error, least):
        if fraction >= least:
            stages.append(stage)
            raise error

    for least, error in ((0.0, KeyboardInterrupt), (0.5, koebe.SolverError)):  # also one that a sample may raise
        with pytest.raises(error):
            CALLS[name]()(progress=partial(stop, error=error, least=least))
    assert len(stages) == 2
    token = koebe.CancelToken()
    with pytest.raises(koebe.Cancelled):
        CALLS[name]()(progress=lambda fraction, stage: token.cancel(), cancel=token)
    CALLS[name]()(cancel=koebe.CancelToken())


@pytest.mark.parametrize("wrong", [{"progress": 3}, {"cancel": True}])
@pytest.mark.parametrize("name", CALLS)
def test_other_things_are_type_errors(name, wrong):
    with pytest.raises(TypeError):
        CALLS[name]()(**wrong)


class Interrupted(Exception):
    """As KeyboardInterrupt by Ctrl-C."""


@contextlib.contextmanager
def interrupted_after(seconds):
    def stop(number, frame):
        raise Interrupted

    before = signal.signal(signal.SIGALRM, stop)
    signal.setitimer(signal.ITIMER_REAL, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


LONG_CALLS = {
    "teichmueller": CALLS["teichmueller"],
    "transfer, fields": lambda: partial(
        koebe.transfer, ball(20), ball(20, 1.3), fields=depths(ball(20), ball(20, 1.3))
    ),
    "transfer, bend": lambda: partial(koebe.transfer, ball(30), ball(30, 1.3), landmarks=marks(20), bend=True),
    "noise_error": lambda: partial(koebe.noise_error, disk("face"), noise=0.01, samples=1000),
}


@pytest.mark.parametrize("name", LONG_CALLS)
def test_ctrl_c_ends_a_call_soon(name):
    call = LONG_CALLS[name]()
    with pytest.raises(Interrupted), interrupted_after(0.1):
        begin = time.monotonic()
        call()
    assert time.monotonic() - begin < 2.0  # 0.1 s if the machine does nothing else
