# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces as arrays, their maps to UVs, and the texts about them. Never imports bpy or another room."""
