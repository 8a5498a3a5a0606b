# SPDX-License-Identifier: GPL-3.0-or-later
"""What any UV map of a triangle mesh is measured by, whoever made it.

Arrays: vertices (V, 3), triangles (F, 3), corner UVs (F, 3, 2). UVs count as 32-bit floats, as Blender stores them.
"""

import numpy as np

RASTER = 2048  # pixels along a side, for what is covered twice
FACTOR = 3.0  # of texel density, a length over a length, that counts as even


def triangle_areas(points):
    """Areas (F,) of triangles (F, 3, 3)."""
    return np.linalg.norm(np.cross(points[:, 1] - points[:, 0], points[:, 2] - points[:, 0]), axis=1) / 2.0


def signed_areas(uv):
    """Signed areas (F,) of triangles (F, 3, 2)."""
    a, b = uv[:, 1] - uv[:, 0], uv[:, 2] - uv[:, 0]
    return (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]) / 2.0


def corner_angles(points):
    """Angles (F, 3) in degrees of triangles (F, 3, d); those of collapsed ones are 0."""
    found = []
    for corner in range(3):
        a, b = points[:, (corner + 1) % 3] - points[:, corner], points[:, (corner + 2) % 3] - points[:, corner]
        lengths = np.linalg.norm(a, axis=1) * np.linalg.norm(b, axis=1)
        cosine = np.divide((a * b).sum(axis=1), lengths, out=np.ones(len(a)), where=lengths > 0.0)
        found.append(np.degrees(np.arccos(np.clip(cosine, -1.0, 1.0))))
    return np.stack(found, axis=1)


def edge_pairs(triangles):
    """The inner edges: for each two faces and, of both, the corners at its ends.

    Returns faces (E, 2) and corners (E, 2, 2): corner [e, k, i] of face [e, k] is at end i. Edges of three or more
    faces are left out.
    """
    start, end = triangles.ravel(), np.roll(triangles, -1, axis=1).ravel()
    corner = np.tile(np.arange(3), len(triangles))
    face = np.repeat(np.arange(len(triangles)), 3)
    low = start < end
    first, last = np.where(low, corner, (corner + 1) % 3), np.where(low, (corner + 1) % 3, corner)
    key = np.minimum(start, end).astype(np.int64) * (triangles.max() + 1) + np.maximum(start, end)
    order = np.argsort(key, kind="stable")
    _, begin, count = np.unique(key[order], return_index=True, return_counts=True)
    one, other = order[begin[count == 2]], order[begin[count == 2] + 1]
    return (np.stack([face[one], face[other]], axis=1),
            np.stack([np.stack([first[one], last[one]], 1), np.stack([first[other], last[other]], 1)], axis=1))


def labels(count, pairs):
    """The least member of each one's component (count,), for pairs (E, 2) that are joined."""
    label = np.arange(count)
    while True:
        low = np.minimum(label[pairs[:, 0]], label[pairs[:, 1]])
        np.minimum.at(label, label[pairs[:, 0]], low)
        np.minimum.at(label, label[pairs[:, 1]], low)
        label = label[label]
        if (label[pairs[:, 0]] == label[pairs[:, 1]]).all():
            return label[label]


def covered(uv):
    """The covered area, and the share of it on which two triangles lie or more, from a raster: each row of pixels
    crosses a triangle in one interval."""
    low, high = uv.reshape(-1, 2).min(axis=0), uv.reshape(-1, 2).max(axis=0)
    scale = (RASTER - 2) / max((high - low).max(), 1e-300)
    at = (uv - low) * scale + 0.37  # no pixel's centre on a grid that UVs like to lie on
    first = np.ceil(at[:, :, 1].min(axis=1)).astype(int)
    rows = np.ceil(at[:, :, 1].max(axis=1)).astype(int) - first
    face = np.repeat(np.arange(len(at)), rows)
    row = first[face] + np.arange(len(face)) - np.repeat(np.cumsum(rows) - rows, rows)
    begin, end = np.full(len(face), np.inf), np.full(len(face), -np.inf)
    for corner in range(3):
        a, b = at[:, corner], at[:, (corner + 1) % 3]
        a, b = (np.where((a[:, 1] < b[:, 1])[:, None], *ends)[face] for ends in ((a, b), (b, a)))
        crosses = (a[:, 1] <= row) & (row < b[:, 1])
        share = np.divide(row - a[:, 1], b[:, 1] - a[:, 1], out=np.zeros(len(face)), where=crosses)
        x = a[:, 0] + share * (b[:, 0] - a[:, 0])
        begin, end = np.where(crosses, np.minimum(begin, x), begin), np.where(crosses, np.maximum(end, x), end)
    size = RASTER * RASTER
    change = np.bincount(row * RASTER + np.ceil(begin).astype(int), minlength=size)
    change -= np.bincount(row * RASTER + np.ceil(end).astype(int), minlength=size)
    counts = np.cumsum(change)  # a row ends before the next begins
    hit = int((counts > 0).sum())
    return hit / scale**2, float((counts > 1).sum() / max(hit, 1))


def widest_window(logs, weights, width):
    """The largest share of the weights whose logarithms lie in a window of that width."""
    order = np.argsort(logs)
    logs, sums = logs[order], np.concatenate([[0.0], np.cumsum(weights[order])])
    end = np.searchsorted(logs, logs + width, side="right")
    return float((sums[end] - sums[:-1]).max() / sums[-1])


def measure(vertices, triangles, uv, texture=1.0):
    """The figures of one map as a dictionary; lengths are in units of the square root of the surface's area.

    @param texture area of the texture, in units of the UVs: a map that uses its whole has a coverage of 1
    """
    vertices = np.asarray(vertices, float)
    uv = np.asarray(uv, np.float32).astype(float)
    points = vertices[triangles]
    area, signed = triangle_areas(points), signed_areas(uv)
    real = area > 1e-12 * area.max()  # a face of no area has no density and no angles
    faces, corners = edge_pairs(triangles)
    sides = [uv[faces[:, k, None], corners[:, k]] for k in range(2)]
    joined = (sides[0] == sides[1]).all(axis=(1, 2))
    ends = vertices[triangles[faces[:, 0, None], corners[:, 0]]]
    lengths = np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1)
    island = labels(len(triangles), faces[joined])
    turn = np.sign(np.bincount(island, signed, minlength=len(triangles)))[island]
    lost = real & (np.abs(signed) <= 1e-14 * max(np.abs(signed).sum(), 1e-300))
    kept = real & ~lost
    logs = np.log(np.abs(signed[kept]) / area[kept]) / 2.0  # of a length over a length
    order = np.argsort(logs)
    share = np.cumsum(area[kept][order]) / area[kept].sum()
    low, high = logs[order][np.searchsorted(share, [0.05, 0.95])]
    covered_area, overlap = covered(uv)
    return {
        "islands": len(np.unique(island)),
        "seams": float(lengths[~joined].sum() / np.sqrt(area.sum())),
        "spread": float(np.exp(high - low)),
        "even": widest_window(logs, area[kept], np.log(FACTOR)) * float(area[kept].sum() / area.sum()),
        "angle": float(np.abs(corner_angles(uv[real]) - corner_angles(points[real])).mean()),
        "flips": int((real & ~lost & (signed * turn <= 0.0)).sum()),
        "lost": int(lost.sum()),
        "overlap": overlap,
        "coverage": covered_area / texture,
    }
