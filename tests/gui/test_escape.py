"""Esc at every stage of a run ends it at once, whatever the thread is doing, and leaves everything as it was."""

import pytest
from window import ROOT, xdotool

# The thread can be held at the first report of a stage; what the operators answer is kept.
HOLD = f"""
import sys, threading
sys.path.insert(0, {str(ROOT / "tests" / "blender")!r})
if not hasattr(heart, 'held'):
    module = lambda name: next(m for n, m in sys.modules.items() if n.endswith('koebe_uv.' + name))
    worker, run = module('solver.worker').Worker, module('operators.modal_run').ModalRun
    progress, running, modal, compute = worker._progress, worker.running, run.modal, worker._run
    def held(self, fraction, stage):
        progress(self, fraction, stage)
        if stage not in heart.stages:
            heart.stages.append(stage)
        if heart.hold in (stage, "any"):
            heart.held.set()
            heart.go.wait(20)
    def answered(self, context, event):
        answer = modal(self, context, event)
        heart.answers.append((event.type, sorted(answer)[0]))
        return answer
    def ended(self):
        compute(self)
        heart.ended = True
    worker._progress, worker._run, run.modal = held, ended, answered
    worker.running = property(lambda self: heart.hold == 'written' or running.fget(self))
    heart.stages = []
heart.hold, heart.answers, heart.ended, heart.held, heart.go = None, [], False, threading.Event(), threading.Event()
import fingerprint
heart.fingerprint = fingerprint.fingerprint
heart.differences = lambda: fingerprint.differences(heart.before, fingerprint.fingerprint())
"""


def escape(window, operator, stage):
    """Start an operator, press Esc when the thread is in that stage, and look at what is left."""
    window.run(HOLD)
    window.run(f"heart.hold = {stage!r}; heart.before = heart.fingerprint()")
    window.press(operator)
    window.wait("heart.ended" if stage == "written" else "heart.held.is_set()")
    xdotool("key", "Escape")
    window.wait("any(answer == 'CANCELLED' for _, answer in heart.answers)")
    assert window.ask("heart.ended") == (stage == "written")  # nobody waits for the thread
    window.run("heart.go.set()")
    window.wait("heart.ended")
    assert window.ask("heart.differences()") == []
    window.run("heart.hold = None")


def stages_of(window, operator):
    """The stages that a run of the operator reports; it is undone after."""
    window.run(HOLD)
    window.run("heart.stages.clear()")
    window.press(operator)
    window.wait("heart.ended")
    window.wait("any(answer == 'FINISHED' for _, answer in heart.answers)")
    window.move(*window.middle("VIEW_3D"))
    window.key("ctrl+z")
    return window.ask("heart.stages")


@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
def test_uniformize(window, open_sample, mode):
    open_sample("suzanne_mask")
    window.move(*window.middle("VIEW_3D"))
    if mode == "EDIT":
        window.key("Tab", "a")
    operator = "uv.koebe_uniformize"
    stages = stages_of(window, operator)
    assert len(stages) >= 4
    for stage in [*stages, "written"]:
        escape(window, operator, stage)
        assert window.ask("len(bpy.context.view_layer.objects.active.data.uv_layers)") == 0
    window.picture(f"23_escaped_{mode.lower()}")
    assert window.ask("bpy.context.mode") == ("EDIT_MESH" if mode == "EDIT" else "OBJECT")
    window.press(operator)  # and then it works
    window.wait("any(answer == 'FINISHED' for _, answer in heart.answers)")
    assert window.ask("[u.name for u in bpy.context.view_layer.objects.active.data.uv_layers]") == ["Koebe"]
