# SPDX-License-Identifier: GPL-3.0-or-later
"""A run on Blender objects: read, compute, write. May import surfaces, layers, maps, solver, blender."""
