# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces as arrays, what becomes of them in the UVs, and the words for it. Never bpy; no other room."""
