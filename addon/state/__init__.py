# SPDX-License-Identifier: GPL-3.0-or-later
"""The add-on's data in Blender: options and reports. May import surfaces, layers, maps, blender."""
