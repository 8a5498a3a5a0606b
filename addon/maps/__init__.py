# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces as arrays, their maps to UVs, and the texts about them. Imports no bpy and no other room."""
