"""Files and meshes of other packages.

Its names for users are those of `koebe`.
"""
