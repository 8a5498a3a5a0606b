# SPDX-License-Identifier: GPL-3.0-or-later
"""A run on Blender objects: read, compute, write. May import maps, solver, blender."""
