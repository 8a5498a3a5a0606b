"""An extra: shapes compared by their circles, points carried, templates fitted, capacities certified.

Its names for users are those of `koebe`.
"""
