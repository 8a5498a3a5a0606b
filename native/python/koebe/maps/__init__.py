"""The maps: to circle domains, tiles, spheres, parts, and what their results have in common.

Its names for users are those of `koebe`.
"""
