# SPDX-License-Identifier: GPL-3.0-or-later
"""What the artist does: gather, run, write, say. May import maps, solver, blender, jobs, state."""
