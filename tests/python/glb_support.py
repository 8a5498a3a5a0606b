"""GLB files for tests: made of arrays, and read back."""

import json
import struct

import numpy as np

TYPES = {"f4": 5126, "i1": 5120, "u1": 5121, "i2": 5122, "u2": 5123, "u4": 5125}
DTYPES = {number: np.dtype("<" + name) for name, number in TYPES.items()}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}


class GlbBuilder:
    """A scene that grows: accessors, meshes, and whatever a test puts into `json`."""

    def __init__(self):
        self.binary = b""
        self.json = {"asset": {"version": "2.0"}, "buffers": [{}], "bufferViews": [], "accessors": [], "meshes": []}

    def view(self, data, **more):
        self.binary += b"\0" * (-len(self.binary) % 4)
        place = {"buffer": 0, "byteOffset": len(self.binary), "byteLength": len(data), **more}
        self.json["bufferViews"].append(place)
        self.binary += data
        return len(self.json["bufferViews"]) - 1

    def accessor(self, array, kind, view=None, offset=0, **more):
        """@param view where the array lies already, from an offset on"""
        array = np.ascontiguousarray(array)
        view = self.view(array.tobytes()) if view is None else view
        name = array.dtype.newbyteorder("=").str[1:]
        place = {"bufferView": view, "byteOffset": offset, "componentType": TYPES[name], "count": len(array)}
        self.json["accessors"].append({**place, "type": kind, **more})
        return len(self.json["accessors"]) - 1

    def positions(self, vertices):
        vertices = np.asarray(vertices, "<f4")
        return self.accessor(vertices, "VEC3", min=vertices.min(0).tolist(), max=vertices.max(0).tolist())

    def mesh(self, *primitives, **more):
        self.json["meshes"].append({"primitives": list(primitives), **more})

    def bytes(self):
        self.json["buffers"][0]["byteLength"] = len(self.binary)
        chunks = b""
        text = json.dumps(self.json).encode()
        for kind, data, padding in ((b"JSON", text, b" "), (b"BIN\0", self.binary, b"\0")):
            data += padding * (-len(data) % 4)
            chunks += struct.pack("<I4s", len(data), kind) + data
        return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


class GlbReader:
    """The JSON, the binary data, and arrays of accessors."""

    def __init__(self, data):
        assert data[:8] == b"glTF\2\0\0\0" and struct.unpack_from("<I", data, 8)[0] == len(data)
        length = struct.unpack_from("<I", data, 12)[0]
        self.json = json.loads(data[20 : 20 + length])
        self.binary = data[28 + length :]
        assert len(self.binary) == struct.unpack_from("<I", data, 20 + length)[0]

    def array(self, number):
        accessor = self.json["accessors"][number]
        dtype, width = DTYPES[accessor["componentType"]], WIDTHS[accessor["type"]]
        size = dtype.itemsize * width
        if "bufferView" in accessor:
            view = self.json["bufferViews"][accessor["bufferView"]]
            begin = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
            rows = [
                np.frombuffer(self.binary, dtype, width, begin + k * view.get("byteStride", size))
                for k in range(accessor["count"])
            ]
            assert (
                accessor.get("byteOffset", 0) + (len(rows) - 1) * view.get("byteStride", size) + size
                <= view["byteLength"]
            )
            values = np.stack(rows)
        else:
            values = np.zeros((accessor["count"], width), dtype)
        if "sparse" in accessor:
            sparse = accessor["sparse"]
            where, what = (
                self.json["bufferViews"][sparse[k]["bufferView"]]["byteOffset"] for k in ("indices", "values")
            )
            places = np.frombuffer(self.binary, DTYPES[sparse["indices"]["componentType"]], sparse["count"], where)
            values = values.copy()
            values[places] = np.frombuffer(self.binary, dtype, sparse["count"] * width, what).reshape(-1, width)
        return values

    def corners(self, primitive):
        """(F, 3) vertices of the primitive's triangles: of a list, a strip or a fan."""
        if "indices" in primitive:
            order = self.array(primitive["indices"])[:, 0].astype(int)
        else:
            order = np.arange(self.json["accessors"][primitive["attributes"]["POSITION"]]["count"])
        mode = primitive.get("mode", 4)
        if mode == 4:
            return order.reshape(-1, 3)
        if mode == 5:
            return np.array([order[[i, i + 1 + i % 2, i + 2 - i % 2]] for i in range(len(order) - 2)])
        return np.array([[order[i + 1], order[i + 2], order[0]] for i in range(len(order) - 2)])

    def of_corners(self, primitive, name="POSITION", target=None):
        attributes = primitive["attributes"] if target is None else primitive["targets"][target]
        return self.array(attributes[name])[self.corners(primitive)]
