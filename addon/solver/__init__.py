# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds, checks, loads and runs the native package. Imports no bpy and no other room."""
