# SPDX-License-Identifier: GPL-3.0-or-later
"""What the artist sees: panels, menus, overlays, preferences. May import maps, blender, state, operators."""
