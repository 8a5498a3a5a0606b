"""An extra: patterns lifted onto surfaces, and patterns to sew.

Its names for users are those of `koebe`.
"""
