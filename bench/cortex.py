# SPDX-License-Identifier: GPL-3.0-or-later
"""Flat maps of a cortex beside FreeSurfer's: docs/labs.md, its section Cortex.

    PYTHONPATH=build/python build/venv-labs/bin/python bench/cortex.py [options]

It needs nilearn, pygeodesic and matplotlib, which `make test-labs` installs. nilearn brings the surfaces: nothing is
downloaded. Where autoflatten is (flatten_peer.py), it is measured too. --picture draws docs/images/cortex.jpg and
cortex_lesions.jpg; --write keeps the tables in docs/figures.json and writes them into the page. --subject FOLDER prints
the table of another hemisphere: that of pycortex's source package is in its filestore/db/S1/surfaces.

The surface is fsaverage5, left hemisphere, white matter, with the faces of its flat map: the cuts are FreeSurfer's.
Lengths are in millimetres.
"""

import argparse
import datetime
import sys
import time
from dataclasses import dataclass
from pathlib import Path

import doc_figures  # noqa: E402
import flatten_peer  # noqa: E402
import numpy as np
import uv_measures  # noqa: E402
from geodesic_error import distance_error, geodesics  # noqa: E402

WEIGHTS = (0, 0.1, 0.375, 1, 3, 10)  # t: of areas against angles; E = 1.1 t / (1 + t)
LESIONS = {(-50.0, 18.0, 12.0): 14.0, (-44.0, -62.0, 34.0): 10.0}  # Broca's area, angular gyrus: geodesic radius, mm
HEAD = ["map", "angle error", "sd of log area", "distance error", "flips", "crossings", "seconds"]
# As https://gallantlab.org/autoflatten/example-output prints them, of another surface: 306,641 faces. Its distances are
# those within seven rings of vertices.
PRINTED = {"autoflatten, as printed, other surface": ["", "", "14.5 %", "15", "", "698 elapsed"]}


@dataclass
class Surface:
    """vertices (V, 3) mm, triangles (F, 3), FreeSurfer's flat map (V, 2) mm, sulcal depth (V,)."""

    vertices: np.ndarray
    triangles: np.ndarray
    flat: np.ndarray
    depth: np.ndarray

    def part(self, faces):
        """The surface of some faces (bool of each)."""
        used, triangles = np.unique(self.triangles[faces], return_inverse=True)
        return Surface(self.vertices[used], triangles.reshape(-1, 3), self.flat[used], self.depth[used])


def read():
    """The surface along the cuts of FreeSurfer's flat map."""
    try:
        import nibabel
        from nilearn.datasets import fetch_surf_fsaverage
    except ModuleNotFoundError as missing:
        sys.exit(f"{missing.name} is not there: pip install nilearn pygeodesic matplotlib")
    files = fetch_surf_fsaverage("fsaverage5")
    flat, triangles = (array.data for array in nibabel.load(files["flat_left"]).darrays)
    vertices, depth = (nibabel.load(files[name]).darrays[0].data for name in ("white_left", "sulc_left"))
    everything = Surface(vertices.astype(float), triangles, flat[:, :2].astype(float), depth)
    return everything.part(np.ones(len(triangles), bool))


def read_subject(folder):
    """A left hemisphere of pycortex's: the middle of its cortex, along the cuts of its flat map by FreeSurfer."""
    import nibabel

    white, pial = (nibabel.load(folder / f"{name}_lh.gii").darrays[0].data.astype(float) for name in ("wm", "pia"))
    flat, triangles = (array.data for array in nibabel.load(folder / "flat_lh.gii").darrays)
    flat = flat[:, :2].astype(float)
    if uv_measures.signed_areas(flat[triangles]).sum() < 0.0:
        flat[:, 0] *= -1.0
    whole = Surface((white + pial) / 2.0, triangles, flat, np.zeros(len(flat)))
    return whole.part(np.ones(len(triangles), bool))


def with_lesions(surface):
    """The surface without the faces that have a vertex in a lesion."""
    centers = [int(np.argmin(np.linalg.norm(surface.vertices - place, axis=1))) for place in LESIONS]
    inside = (geodesics(surface, centers) < np.array(list(LESIONS.values()))[:, None]).any(axis=0)
    return surface.part(~inside[surface.triangles].any(axis=1))


def exact(flat):
    """Stored coordinates as whole numbers of Python."""
    return [[int(x * 2**60) for x in point] for point in flat.astype(np.float32).astype(float).tolist()]


def crossings(flat, triangles):
    """How many pairs of border edges that share no end meet, in exact arithmetic, as stored in 32 bits."""
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    _, first, count = np.unique(np.sort(edges, axis=1), axis=0, return_index=True, return_counts=True)
    border, points, found = edges[first[count == 1]].tolist(), exact(flat), 0

    def side(a, b, c):
        area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
        return (area > 0) - (area < 0)

    for i, one in enumerate(border):
        a, b = points[one[0]], points[one[1]]
        for other in border[:i]:
            if set(one) & set(other):
                continue
            c, d = points[other[0]], points[other[1]]
            if any(max(a[k], b[k]) < min(c[k], d[k]) or max(c[k], d[k]) < min(a[k], b[k]) for k in (0, 1)):
                continue
            found += side(a, b, c) * side(a, b, d) <= 0 and side(c, d, a) * side(c, d, b) <= 0
    return found


def cells(surface, flat, sources, distances, seconds):
    """A row of the table; flips and crossings of the places as stored in 32 bits."""
    stored = flat.astype(np.float32).astype(float)
    corners, points = stored[surface.triangles], surface.vertices[surface.triangles]
    area, signed = uv_measures.triangle_areas(points), uv_measures.signed_areas(corners)
    angle = np.abs(uv_measures.corner_angles(corners) - uv_measures.corner_angles(points)).mean()
    upright = signed > 0
    log = np.log(signed[upright] / area[upright])
    sd = np.sqrt(np.average((log - np.average(log, weights=area[upright])) ** 2, weights=area[upright]))
    error, _ = distance_error(stored, sources, distances)
    return [f"{angle:.2f}°", f"{sd:.3f}", f"{100 * error:.1f} %", str((~upright).sum()),
            str(crossings(flat, surface.triangles)), seconds]  # fmt: skip


def even_of(weight):
    """E of t."""
    return min(1.0, 1.1 * weight / (1.0 + weight))


def ours(surface, weight, loops):
    """The map (V, 2) in [0, 1]², and its processor seconds."""
    import koebe

    begin = time.process_time()
    result = koebe.uniformize(surface.vertices, surface.triangles, even=even_of(weight), loops=loops)
    if result.warnings:
        print(loops, weight, *result.warnings, sep="; ", file=sys.stderr)
    return koebe.disk_to_uv(result.uv), time.process_time() - begin


def table(surface, count):
    """Rows by name, and the maps by (loops, t)."""
    sources = np.random.default_rng(1).choice(len(surface.vertices), count, replace=False)
    distances = geodesics(surface, sources)
    rows, maps = {}, {}
    for loops in ("free", "round"):
        for weight in WEIGHTS:
            if weight == 0 and loops == "round":
                continue  # a conformal map has round loops
            flat, seconds = maps[loops, weight] = ours(surface, weight, loops)
            name = f"{loops}, E = {even_of(weight):.3g} (t = {weight})" if weight else "conformal, E = 0"
            rows[name] = cells(surface, flat, sources, distances, f"{seconds:.2g}")
    return rows, maps, lambda flat, seconds: cells(surface, flat, sources, distances, seconds)


def tell(name, rows, write):
    """Prints a table, and keeps it if it is to be written."""
    print(doc_figures.markdown({"head": HEAD, "rows": rows}), end="\n\n", flush=True)
    if write:
        doc_figures.keep(name, HEAD, rows, "bench/cortex.py --write", datetime.date.today().isoformat())
        doc_figures.write()


def main():
    parser = argparse.ArgumentParser(prog="cortex.py", description=__doc__.splitlines()[0])
    parser.add_argument("--sources", type=int, default=1000, help="vertices from which distances are measured (1000)")
    parser.add_argument("--picture", action="store_true")
    parser.add_argument("--write", action="store_true")
    parser.add_argument("--subject", type=Path, metavar="FOLDER", help="of wm, pia and flat_lh.gii")
    options = parser.parse_args()
    surface = read_subject(options.subject) if options.subject else read()
    rows, maps, measured = table(surface, options.sources)
    rows["FreeSurfer's"] = measured(surface.flat, "")
    if options.subject:
        return tell("subject", rows, False)
    if flatten_peer.command():
        flat, seconds = flatten_peer.flat_map(surface.vertices, surface.triangles)
        rows["autoflatten, this surface"] = measured(flat, f"{seconds:.0f}")
    tell("cortex", {**rows, **PRINTED}, options.write)
    damaged = with_lesions(surface)
    rows, holed, _ = table(damaged, options.sources)
    tell("cortex_lesions", rows, options.write)
    if options.picture:
        import cortex_picture

        cortex_picture.draw(surface, damaged, maps, holed)


if __name__ == "__main__":
    main()
