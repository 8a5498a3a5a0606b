"""The reference of the add-on: a page for each operator, with its picture and its properties as blender_names.py has
found them."""

import json
import re

from markup import escaped, indented, sentence, title, toctree

ROOMS = {"uv": "UV maps", "mesh": "Meshes", "object": "Objects", "node": "Node groups"}
FIRST = ["uv.koebe_unwrap", "uv.koebe_uniformize", "uv.koebe_parts"]
TEXTLESS = {"filter_glob"}  # Blender's own
# Of docs/images, and what it shows of these operators.
PICTURES = {
    "guide_film.gif": ("Unwrap is pressed, a circle is dragged, and Even is moved", "unwrap even"),
    "suzanne_mask.jpg": ("A mask in its checker, and its disk", "uniformize checker use_for_rendering"),
    "parts_character.jpg": ("A character in parts, and its islands", "parts select_cuts bake_texture"),
    "guide_parts_hand.jpg": ("Islands of one texel density, packed",
                             "pack sew measure_density set_density copy_density"),
    "domains_ring.png": ("A tube with holes, and its cylinder", "ring"),
    "guide_tile.jpg": ("A ring with two holes, its tile, and the next copies", "torus"),
    "guide_sphere.jpg": ("A head, its sphere, and its UVs", "sphere"),
    "domains_schottky.png": ("A surface with handles, and its domain", "schottky select_torn"),
    "guide_circles.jpg": ("The disk is dragged, and the checker follows", "moebius symmetrize"),
    "guide_live.gif": ("UVs that follow the hand", "relax sequence"),
    "guide_uv_editor.jpg": ("The mouth's loop, selected by its number", "select_loop"),
    "guide_distortion.jpg": ("The report, and texel density in colours",
                             "distortion show select_flipped select_offenders select_warning"),
    "guide_filled.jpg": ("The mouth filled with faces", "fill_holes"),
    "guide_loops.jpg": ("Loops round the holes of a face", "loops_around_holes"),
    "guide_flat.jpg": ("A vase, and its flat copy", "flat_copy"),
    "patterns.svg": ("A hat, and its pattern", "flat_svg"),
    "guide_lift.jpg": ("Circles cut out of a face, and the redo panel", "lift redo"),
    "guide_scatter.jpg": ("Balls on a face, by the node group Koebe Scatter",
                          "add_groups remove_groups add_library remove_library"),
    "guide_trims.jpg": ("Islands in a trim sheet", "arrange trims"),
    "carry_aligned.jpg": ("One texture on two faces", "carry_texture compare_shapes"),
    "guide_panel.jpg": ("The panel, its presets in the title", "preset preset_add reset"),
}  # fmt: skip
PICTURE_OF = {name: (file, text) for file, (text, names) in PICTURES.items() for name in names.split()}


def operators(path):
    return json.loads(path.read_text(encoding="utf-8"))


def seen(properties):
    return [one for one in properties if not one["hidden"] and one["name"] not in TEXTLESS]


def faults(found):
    """Operators and properties without a description."""
    bare = [f"bpy.ops.{one['name']} has no description" for one in found if not one["does"]]
    silent = [
        f"bpy.ops.{one['name']}: {said['name']} has no description"
        for one in found
        for said in seen(one["properties"])
        if not said["does"]
    ]
    blind = [f"bpy.ops.{one['name']} has no picture" for one in found if word(one) not in PICTURE_OF]
    return bare + silent + blind


def word(one):
    """The operator's name without the add-on's."""
    return one["name"].partition(".koebe_")[2]


def number(value):
    return f"{value:.6g}"


def range_of(low, high):
    """A range in words; Blender's largest numbers mean none."""
    bounds = [f"from {number(low)}" if low > -1e9 else "", f"to {number(high)}" if high < 1e9 else ""]
    return " ".join(filter(None, bounds))


def default(one):
    """The default in Python, or nothing."""
    value = one.get("default")
    if value is None or value == "" or one["kind"] not in ("int", "float", "enum", "boolean", "string"):
        return ""
    if one["kind"] == "float" and not isinstance(value, list):
        return number(value)
    return json.dumps(value).replace("true", "True").replace("false", "False").replace('"', "'")


def entry(one):
    """A property in reStructuredText."""
    text = sentence(escaped(one["does"]))
    if "range" in one and (said := range_of(*one["range"])):
        text += f" {sentence(said)}"
    if said := default(one):
        text += f" Default: ``{said}``."
    words = "".join(f"- ``'{word}'``: {escaped(means or label)}\n" for word, label, means in one.get("choices", ()))
    head = f"**{escaped(one['name'])}** ({escaped(one['label'] or one['name'])})\n"
    return head + indented(text) + "\n\n" + (indented(words) + "\n" if words else "")


def operator(one):
    """An operator in reStructuredText."""
    file, text = PICTURE_OF[word(one)]
    made = title(one["label"]) + f".. figure:: /images/{file}\n   :alt: {text}\n\n   {text}.\n\n"
    body = sentence(escaped(one["does"])) + "\n\n" + "".join(entry(said) for said in seen(one["properties"]))
    return made + f".. py:function:: bpy.ops.{one['name']}(...)\n   :no-contents-entry:\n\n{indented(body)}\n"


def pages(found):
    """The pages: name -> text."""
    made = {}
    index = title("Blender") + (
        "The operators of the add-on and their properties, as Blender has registered them. :doc:`/guide` shows them at "
        "work. A script calls them, for example "
        "``bpy.ops.uv.koebe_unwrap(shape='PARTS')``.\n\n"
    )
    rooms = list(dict.fromkeys(one["name"].split(".")[0] for one in found))
    for room in sorted(rooms, key=[*ROOMS].index):
        mine = [one for one in found if one["name"].startswith(room + ".")]
        mine.sort(key=lambda one: FIRST.index(one["name"]) if one["name"] in FIRST else len(FIRST))
        index += title(ROOMS[room], "-") + ".. list-table::\n   :class: names\n\n"
        for one in mine:
            brief = re.split(r"(?<=\.)\s", sentence(one["does"]))[0]
            index += f"   * - :py:func:`{escaped(one['label'])} <bpy.ops.{one['name']}>`\n     - {escaped(brief)}\n"
        index += "\n"
        made |= {f"reference/blender/{one['name']}.rst": operator(one) for one in mine}
    made["reference/blender/index.rst"] = index + toctree([one["name"] for one in found], ":hidden:")
    return made
