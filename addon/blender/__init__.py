# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads and writes Blender's data, and can undo its writing. May import surfaces, layers, maps."""
