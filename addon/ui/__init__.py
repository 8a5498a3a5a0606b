# SPDX-License-Identifier: GPL-3.0-or-later
"""The visible part: panels, menus, overlays, preferences. May import maps, blender, state, operators."""
