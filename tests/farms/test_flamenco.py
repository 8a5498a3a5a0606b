"""The Flamenco job type: compiled in goja, the engine that Flamenco's manager embeds, and its commands run."""

import json
import os
import shutil
import subprocess
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
from conftest import COMMAND, FILES, ROOT, contents, koebe

JOB_TYPE = ROOT / "scripts" / "farms" / "flamenco" / "koebe-batch.js"
COMPILER = Path(__file__).parent / "compile_job"

pytestmark = pytest.mark.skipif(not shutil.which("go"), reason="Go is not here")


@pytest.fixture(scope="module")
def compiler(tmp_path_factory):
    program = tmp_path_factory.mktemp("go") / "compile_job"
    environment = {**os.environ, "GOFLAGS": "-mod=readonly"}
    subprocess.run(["go", "build", "-o", program, "."], cwd=COMPILER, check=True, timeout=300, env=environment)
    return program


@pytest.fixture
def compiled(compiler, tmp_path):
    """compiled(**settings): the tasks; raises RuntimeError with what the job type says."""

    def compiled(**settings):
        (tmp_path / "settings.json").write_text(json.dumps(settings))
        done = subprocess.run(
            [compiler, JOB_TYPE, tmp_path / "settings.json"], capture_output=True, text=True, timeout=60
        )
        if done.returncode:
            raise RuntimeError(done.stderr)
        return json.loads(done.stdout)["tasks"]

    return compiled


def run_task(task):
    """As a worker does: one command after the other, until one fails."""
    for command in task["commands"]:
        assert command["name"] == "exec" and set(command["parameters"]) == {"exe", "args"}
        words = [command["parameters"]["exe"], *command["parameters"]["args"]]
        subprocess.run(words, check=True, capture_output=True, timeout=300)


@pytest.mark.parametrize("in_task", [1, 7])
def test_the_commands_it_authors_give_the_results_of_one_run(compiled, library, undisturbed, tmp_path, in_task):
    out = tmp_path / "out"
    listed = koebe("batch", library, "--output", out, "--list").stdout
    tasks = compiled(files=listed, output=str(out), command=COMMAND, files_in_task=in_task, time_limit=120)
    *maps, table = tasks
    assert len(maps) == -(-FILES // in_task) and len({task["name"] for task in tasks}) == len(tasks)
    assert all(task["type"] == "misc" and not task["dependencies"] for task in maps)
    assert table["dependencies"] == [task["name"] for task in maps]
    with ThreadPoolExecutor(2) as workers:
        list(workers.map(run_task, maps))
    run_task(table)
    assert contents(out) == contents(undisturbed[0])


def test_options_and_blender_reach_every_command(compiled):
    (task, table) = compiled(
        files="/lib\ta b.blend\n", output="/out", blender="/opt/blender", options="--method=ck\n--polish\n"
    )
    (command,) = task["commands"]
    assert task["type"] == "blender" and command["parameters"]["exe"] == "koebe"
    assert command["parameters"]["args"][:4] == ["batch", "/lib/a b.blend", "--base", "/lib"]
    everywhere = {"--output", "/out", "--method=ck", "--polish", "--blender=/opt/blender"}
    for one in (*task["commands"], *table["commands"]):
        assert everywhere <= set(one["parameters"]["args"])


@pytest.mark.parametrize(
    ("settings", "reason"),
    [
        ({"output": "/out"}, "files is missing"),
        ({"files": "/a\tb.obj"}, "output is missing"),
        ({"files": "\n", "output": "/out"}, "no file"),
        ({"files": "/a/b.obj", "output": "/out"}, "no folder, tab and name"),
        ({"files": "/a\tb.obj", "output": "/out", "time_limit": "1"}, "no int32"),
        ({"files": "/a\tb.obj", "output": "/out", "colour": "red"}, "no setting is called colour"),
    ],
)
def test_wrong_settings_are_told(compiled, settings, reason):
    with pytest.raises(RuntimeError, match=reason):
        compiled(**settings)
