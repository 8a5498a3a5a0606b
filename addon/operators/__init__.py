# SPDX-License-Identifier: GPL-3.0-or-later
"""The artist's actions: gather, run, write, report. May import surfaces, layers, maps, solver, blender, jobs, state."""
