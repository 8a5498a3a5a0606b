# SPDX-License-Identifier: GPL-3.0-or-later
"""Panels, menus, overlays, preferences. May import surfaces, layers, maps, blender, state, operators."""
