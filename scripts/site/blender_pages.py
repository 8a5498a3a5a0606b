"""The reference of the add-on: its operators and their properties, as blender_names.py has found them."""

import json
import re

from markup import escaped, indented, sentence, title, toctree

ROOMS = {"uv": "UV maps", "mesh": "Meshes", "object": "Objects", "node": "Node groups"}
FIRST = ["uv.koebe_unwrap", "uv.koebe_uniformize", "uv.koebe_parts"]
TEXTLESS = {"filter_glob"}  # Blender's own


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
    return bare + silent


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
    made = title(one["label"], "-")
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
        made[f"reference/blender/{room}.rst"] = title(ROOMS[room]) + "".join(map(operator, mine))
    made["reference/blender/index.rst"] = index + toctree(sorted(rooms, key=[*ROOMS].index), ":hidden:")
    return made
