"""Progress in the status line: a redraw of the window that takes long comes seldom."""

from types import SimpleNamespace

import pytest

pytestmark = pytest.mark.alike

RUN = 60.0  # seconds


@pytest.fixture
def shown(addon, monkeypatch):
    """A function that runs for RUN seconds and returns how often progress was shown, if a redraw takes so long."""
    modal_run = addon("operators.modal_run")

    def times(redraw):
        now, texts = [100.0], []
        monkeypatch.setattr(modal_run, "time", SimpleNamespace(monotonic=lambda: now[0]))
        operator = modal_run.ModalRun()
        operator._worker = SimpleNamespace(fraction=0.0, stage="factor")
        operator._shown_at, operator._shown, operator._show_next = now[0], "", now[0]
        context = SimpleNamespace(workspace=SimpleNamespace(status_text_set=texts.append), screen=None)
        while now[0] < 100.0 + RUN:
            operator._worker.fraction += 0.01
            before = len(texts)
            operator._show_progress(context)
            operator._show_progress(context)  # another event before the window is drawn
            now[0] += modal_run.POLL_SECONDS + (redraw if len(texts) > before else 0.0)
        return len(texts)

    return times


def test_a_fast_window_shows_it_four_times_a_second(shown):
    assert 3.0 * RUN <= shown(0.0) <= 4.1 * RUN


@pytest.mark.parametrize("redraw", [0.1, 1.0, 3.0])
def test_redraws_take_a_fifth_of_the_time_at_most(shown, redraw):
    assert 3 <= shown(redraw) <= 1.1 * (0.2 * RUN / redraw) + 1
