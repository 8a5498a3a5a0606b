# SPDX-License-Identifier: GPL-3.0-or-later
"""What Blender keeps for the add-on: options and reports. May import maps, blender."""
