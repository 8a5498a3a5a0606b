"""What a sample's mesh is, measured on the Blender mesh itself, and whether that is what expected.json declares."""

import numpy as np


def measure(mesh):
    """Counts, topology and shape of a Blender mesh as a dict of plain numbers."""
    corners, face_of, edge_of, start = _loops(mesh)
    following = np.arange(len(corners)) + 1
    following[start[1:] - 1] = start[:-1]
    tail, head = corners, corners[following]
    uses = np.bincount(edge_of, minlength=len(mesh.edges))
    directed = np.unique(tail.astype(np.int64) * len(mesh.vertices) + head)
    boundary = uses[edge_of] == 1
    parts = len(np.unique(_components(len(mesh.polygons), *_twins(face_of, edge_of))))
    # Two corners of neighbouring faces at one vertex belong to one fan. A manifold has as many fans as vertices.
    fans = len(np.unique(_components(len(corners), *_fan_links(corners, following, edge_of))))
    euler = len(mesh.vertices) - len(mesh.edges) + len(mesh.polygons)
    loops = _count_cycles(tail[boundary], head[boundary])
    return {
        "vertices": len(mesh.vertices),
        "faces": len(mesh.polygons),
        "triangles": int((np.diff(start) - 2).sum()),
        "loops": loops,
        "euler": euler,
        "components": parts,
        "genus": (2 * parts - loops - euler) / 2,
        "manifold": bool(uses.min() >= 1 and uses.max() <= 2 and fans == len(mesh.vertices)),
        "oriented": len(directed) == len(corners),
        "outward": bool(_outward_flux(mesh) > 0),
        "min_angle_deg": float(_angles(mesh).min()),
        "uv_layers": len(mesh.uv_layers),
    }


def complaints(measured, expected):
    """Where measured differs from what the sample must be, one line each. The least angle of `expected` is a bound."""
    wanted = {
        "components": 1,
        "genus": expected.get("genus", 0),
        "manifold": True,
        "oriented": True,
        "outward": True,
        "uv_layers": 0,
        **{key: expected[key] for key in ("loops", "vertices", "faces", "triangles")},
    }
    found = [f"{key} is {measured[key]}, not {value}" for key, value in wanted.items() if measured[key] != value]
    if measured["min_angle_deg"] < expected["min_angle_deg"]:
        found.append(f"least angle {measured['min_angle_deg']:.2f} < {expected['min_angle_deg']} degrees")
    return found


def _read(collection, name, width=1, kind=np.int32):
    values = np.empty(len(collection) * width, kind)
    collection.foreach_get(name, values)
    return values


def _loops(mesh):
    """Per corner its vertex, face and edge; per face where its corners start, and the end."""
    sizes = _read(mesh.polygons, "loop_total")
    face_of = np.repeat(np.arange(len(sizes)), sizes)
    start = np.concatenate([[0], np.cumsum(sizes)])
    return _read(mesh.loops, "vertex_index"), face_of, _read(mesh.loops, "edge_index"), start


def _twins(labels, edge_of):
    """Pairs of labels that share an edge."""
    order = np.argsort(edge_of, kind="stable")
    same = np.flatnonzero(edge_of[order][1:] == edge_of[order][:-1])
    return labels[order[same]], labels[order[same + 1]]


def _fan_links(corners, following, edge_of):
    """Pairs of corners of neighbouring faces at one vertex."""
    left, right = _twins(np.arange(len(corners)), edge_of)
    same = corners[left] == corners[right]
    first = np.where(same, right, following[right])
    second = np.where(same, following[right], right)
    return np.concatenate([left, following[left]]), np.concatenate([first, second])


def _components(count, a, b):
    """Per item the least item that it is linked to, by pointer doubling."""
    label = np.arange(count)
    while True:
        low = np.minimum(label[a], label[b])
        before = label.copy()
        np.minimum.at(label, a, low)
        np.minimum.at(label, b, low)
        np.minimum.at(label, before[a], low)
        np.minimum.at(label, before[b], low)
        label = label[label]
        if np.array_equal(label, before):
            return label


def _count_cycles(tail, head):
    """The number of closed loops of directed boundary edges; none branches on a manifold."""
    number = {int(v): i for i, v in enumerate(tail)}
    after = np.array([number[int(v)] for v in head], np.int64)
    return len(np.unique(_components(len(tail), np.arange(len(tail)), after)))


def _triangles(mesh):
    """Points of the triangles that Blender cuts the faces into, (3, F, 3)."""
    mesh.calc_loop_triangles()
    points = _read(mesh.vertices, "co", 3, np.float32).astype(float).reshape(-1, 3)
    return points[_read(mesh.loop_triangles, "vertices", 3).reshape(-1, 3).T]


def _outward_flux(mesh):
    """Sum over triangles of area vector . (center - mean of all centers): positive when the outside is in front."""
    a, b, c = _triangles(mesh)
    center = (a + b + c) / 3
    return np.sum(np.cross(b - a, c - a) * (center - center.mean(axis=0)))


def _angles(mesh):
    """All angles of the triangles in degrees."""
    corners = _triangles(mesh)
    u = np.roll(corners, -1, axis=0) - corners
    v = np.roll(corners, 1, axis=0) - corners
    return np.degrees(np.arctan2(np.linalg.norm(np.cross(u, v), axis=2), (u * v).sum(axis=2)))
