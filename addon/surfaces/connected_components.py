# SPDX-License-Identifier: GPL-3.0-or-later
"""Connected components of a graph given as two arrays."""

import itertools

import numpy as np

# In the first rounds any smaller root will do. On a star whose hub has the largest number this could take as many
# rounds as leaves, so later rounds take the smallest root, which costs a sort.
HASTY_ROUNDS = 3


def connected_components(  # type: ignore[return]  # its loop ends in no other way
    count: int, first: np.ndarray, second: np.ndarray
) -> np.ndarray:
    """Smallest member of the component of each of `count` nodes, joined by the edges first[i]—second[i].

    Every root hooks onto a smaller root that it meets, then all paths are halved until they are flat [Shiloach and
    Vishkin 1982]. Labels never rise, so no cycle can arise.
    """
    label = np.arange(count, dtype=np.int32)
    low, high = np.minimum(first, second), np.maximum(first, second)
    for round_ in itertools.count():
        label[high] = low
        _flatten(label)
        low, high = label[first], label[second]
        apart = np.flatnonzero(low != high)
        if len(apart) == 0:
            return label
        first, second, low, high = first[apart], second[apart], low[apart], high[apart]
        low, high = np.minimum(low, high), np.maximum(low, high)
        if round_ + 1 >= HASTY_ROUNDS:
            # Of several writes to one place the last stays: make that the smallest.
            order = np.argsort(-low, kind="stable")
            low, high = low[order], high[order]


def _flatten(label: np.ndarray) -> None:
    """Make every node point to its root."""
    flat = label[label]
    steep = np.flatnonzero(flat != label)
    while len(steep):
        label[steep] = flat = label[label[steep]]
        steep = steep[label[flat] != flat]
