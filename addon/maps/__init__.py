# SPDX-License-Identifier: GPL-3.0-or-later
"""Maps of surfaces to UVs, their options, and the words of reports. Imports no bpy. May import surfaces, layers."""
