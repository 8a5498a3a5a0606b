# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces as arrays, cut into islands, and the errors about them. Imports no bpy and no other room."""
