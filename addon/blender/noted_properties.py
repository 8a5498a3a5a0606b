# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes custom properties and property groups, and notes them before."""


from typing import Any

import bpy

from .transaction import Transaction


def set_property(run: Transaction, owner: bpy.types.ID, key: str, value: Any) -> None:
    """Set a custom property of a data-block; None removes it."""
    run.before_write(_restore_property, owner, key, _plain(owner.get(key)))
    _restore_property(owner, key, value)


def _restore_property(owner: bpy.types.ID, key: str, value: Any) -> None:
    if value is not None:
        owner[key] = value
    elif key in owner:
        del owner[key]


def _plain(value: Any) -> Any:
    """A custom property's value, which remains when the property is gone."""
    if hasattr(value, "to_dict"):
        return value.to_dict()
    return value.to_list() if hasattr(value, "to_list") else value


def note_group(run: Transaction, group: bpy.types.PropertyGroup) -> None:
    """Note all values of a property group before it is written."""
    run.before_write(_restore_group, group, _values(group))


def _values(group: bpy.types.PropertyGroup) -> dict[str, Any]:
    """The values set in a property group: plain values by name; lists of such for collections."""
    found: dict[str, Any] = {}
    for prop in group.bl_rna.properties:
        name = prop.identifier
        if prop.is_readonly and prop.type not in {"COLLECTION", "POINTER"} or name == "rna_type":
            continue
        if prop.type == "COLLECTION":
            found[name] = [_values(item) for item in getattr(group, name)]
        elif prop.type == "POINTER":
            found[name] = _values(getattr(group, name))
        elif group.is_property_set(name):
            value = getattr(group, name)
            found[name] = tuple(value) if getattr(prop, "is_array", False) else value
    return found


def _restore_group(group: bpy.types.PropertyGroup, values: dict[str, Any]) -> None:
    for prop in group.bl_rna.properties:
        name = prop.identifier
        if prop.type == "COLLECTION":
            items = getattr(group, name)
            items.clear()
            for item in values[name]:
                _restore_group(items.add(), item)
        elif prop.type == "POINTER" and name in values:
            _restore_group(getattr(group, name), values[name])
        elif name in values:
            setattr(group, name, values[name])
        elif not prop.is_readonly and name != "rna_type":
            group.property_unset(name)
