# SPDX-License-Identifier: GPL-3.0-or-later
"""The properties that say which shapes of a mesh are mapped one after the other, and what holds their UVs."""

from bpy.props import BoolProperty, EnumProperty, IntProperty

from ..maps.options import SequenceChoice

DEFAULTS = SequenceChoice()
RANGE_NAMES = ("frame_start", "frame_end", "frame_step")  # the scene's, where they are not set

SOURCE = EnumProperty(
    name="Source",
    items=[
        (
            "FRAMES",
            "Frames",
            "The mesh as modifiers, armatures, shape keys and drivers make it in each frame of a "
            "range. They may move vertices, but not add, remove or join faces",
        ),
        (
            "SHAPE_KEYS",
            "Shape Keys",
            "Every shape key of the mesh, the basis first, as it is at value 1. Muting, "
            "vertex groups and modifiers do not count",
        ),
    ],
    default=DEFAULTS.source,
    description="Which shapes of the mesh are mapped, each laid over the first",
)

TARGET = EnumProperty(
    name="Target",
    items=[
        (
            "ATTRIBUTE",
            "Attributes",
            "A vector attribute for each shape, named after UV Layer and frame or key, which "
            "nodes read: of points, or of face corners where the UVs are cut. Any number of them",
        ),
        ("LAYERS", "UV Layers", "A UV layer for each shape, named after UV Layer and frame or key. Blender allows 8"),
    ],
    default=DEFAULTS.target,
    description="What holds the UVs of the shapes",
)

PLAY = BoolProperty(
    name="Play",
    default=DEFAULTS.play,
    description="Of attributes of frames: show them. Writes the first one to the UV layer too, and adds a modifier, "
    "Koebe Sequence, which brings that of the current frame there",
)

SCENE_RANGE = BoolProperty(
    name="Scene Range",
    default=True,
    description="Take the first and last frame and the step of the scene. Off: those below",
)

FRAME_START = IntProperty(
    name="First Frame",
    default=1,
    options={"SKIP_SAVE"},
    description="The maps of the other frames are laid over that of this one. Not set: the scene's first frame",
)
FRAME_END = IntProperty(
    name="Last Frame",
    default=250,
    options={"SKIP_SAVE"},
    description="No frame after this one is mapped. Not set: the scene's last frame",
)
FRAME_STEP = IntProperty(
    name="Step",
    default=1,
    min=1,
    options={"SKIP_SAVE"},
    description="From one frame that is mapped to the next. Not set: the scene's step",
)
