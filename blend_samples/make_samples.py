# SPDX-License-Identifier: GPL-3.0-or-later
"""Make the sample .blend files and check that each mesh is what expected.json declares.

    blender -b --factory-startup --python-exit-code 1 -P blend_samples/make_samples.py -- [options]
    python blend_samples/make_samples.py -- [options]          (with the bpy module)

    --output DIR   where to (default: this folder)
    --only NAME    only these samples
    --dense        the ones too large to be kept, too
    --check        make nothing; check the files that are in DIR

Exit code: 0 done, 1 a mesh is not what it should be, 2 wrong usage. Equal runs give equal meshes.
"""

import argparse
import json
import sys
from pathlib import Path

import bpy

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

import character  # noqa: E402
import closed_head  # noqa: E402
import face_model  # noqa: E402
import hand  # noqa: E402
import mesh_check  # noqa: E402
import mug  # noqa: E402
import scene  # noqa: E402
import simple_shapes  # noqa: E402
import suzanne_mask  # noqa: E402

# What makes each sample, and the direction from which it looks best.
SAMPLES = {
    "suzanne_mask": (suzanne_mask.suzanne_mask, (0.45, -1.0, 0.05)),
    "face_five_holes": (face_model.five_holes, (0.50, -1.0, -0.12)),
    "face_surprised": (face_model.surprised, (0.50, -1.0, -0.12)),
    "perforated_panel": (simple_shapes.perforated_panel, (0.45, -0.9, 1.3)),
    "vase": (simple_shapes.vase, (0.3, -1.0, 0.42)),
    "bowl": (simple_shapes.bowl, (0.2, -1.0, 0.45)),
    "character": (character.character, (0.5, -1.0, 0.1)),
    "hand": (hand.hand, (0.5, 1.0, 0.2)),
    "mug": (mug.mug, (0.6, -1.0, 0.6)),
    "closed_head": (closed_head.closed_head, (0.5, -1.0, 0.1)),
    "face_dense": (face_model.dense, (0.50, -1.0, -0.12)),
}


def parse():
    """The options after "--"."""
    given = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
    parser = argparse.ArgumentParser(prog="make_samples.py", description=__doc__.splitlines()[0])
    parser.add_argument("--output", type=Path, default=HERE)
    parser.add_argument("--only", nargs="+", choices=SAMPLES, metavar="NAME")
    parser.add_argument("--dense", action="store_true")
    parser.add_argument("--check", action="store_true")
    return parser.parse_args(given)


def make(name, path):
    """Make one sample and save it."""
    shape, view = SAMPLES[name]
    bpy.ops.wm.read_factory_settings(use_empty=True)
    obj = scene.new_scene(name, *shape())
    scene.light_and_frame(obj, view)
    path.parent.mkdir(parents=True, exist_ok=True)
    scene.save(path)


def check(name, path, expected):
    """Open one sample, print what it is, and return what is wrong with it."""
    bpy.ops.wm.open_mainfile(filepath=str(path.absolute()))
    meshes = [obj for obj in bpy.context.scene.objects if obj.type == "MESH"]
    if [obj.name for obj in meshes] != [name]:
        return [f"the scene should hold one mesh object named {name}"]
    measured = mesh_check.measure(meshes[0].data)
    print(f"{name:17}", *(f"{key} {value:.6g}" if value is not True else key for key, value in measured.items()))
    return mesh_check.complaints(measured, expected)


def main():
    options = parse()
    expected = json.loads((HERE / "expected.json").read_text(encoding="utf-8"))["samples"]
    names = options.only or [name for name in SAMPLES if options.dense or not expected[name]["dense"]]
    wrong = 0
    for name in names:
        path = options.output / f"{name}.blend"
        if not options.check:
            make(name, path)
        for line in check(name, path, expected[name]):
            print(f"{name}: {line}", file=sys.stderr)
            wrong += 1
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
