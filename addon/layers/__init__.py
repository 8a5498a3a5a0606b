# SPDX-License-Identifier: GPL-3.0-or-later
"""UV layers as they are: measured, moved, relaxed, drawn; nothing is mapped. Imports no bpy. May import surfaces."""
