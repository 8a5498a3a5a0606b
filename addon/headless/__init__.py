# SPDX-License-Identifier: GPL-3.0-or-later
"""The rest of batch.py, beside the jobs: command line, objects, files, exit codes. May import maps, blender."""
