# SPDX-License-Identifier: GPL-3.0-or-later
"""What batch.py has beside the jobs: command line, objects, files, exit codes. May import maps, blender."""
