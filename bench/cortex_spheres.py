# SPDX-License-Identifier: GPL-3.0-or-later
"""The right hemisphere, mirrored, registered to the left by sulcal depth: docs/labs.md, its section Closed surfaces.

    PYTHONPATH=build/python build/venv-labs/bin/python bench/cortex_spheres.py [--picture FILE]

The surfaces are fsaverage5's white matter, which nilearn brings: nothing is downloaded. FreeSurfer's own spheres take
part under the same registration. Printed of each pair of spheres: mean angle error, standard deviation of log area, and
flips of the left one. Below, for each stiffness (None: only turned): the correlation of sulcal depth, and of curvature,
which the registration does not see, by area on the right surface; |mu| and standard deviation of log area of the
bending; angle error and standard deviation of log area of the right sphere then; CPU seconds. --picture only draws.
"""

import argparse
import copy
import time

import koebe
import numpy as np

STIFFNESS = (0.3, 0.1, 0.03)


def read(name, side):
    """The arrays of one of fsaverage5's files; the right hemisphere is mirrored."""
    import nibabel
    from nilearn.datasets import fetch_surf_fsaverage

    found = [array.data for array in nibabel.load(fetch_surf_fsaverage("fsaverage5")[f"{name}_{side}"]).darrays]
    if len(found) == 1:
        return found[0].astype(float)
    points, triangles = found[0].astype(float), found[1]
    return (points * [-1.0, 1.0, 1.0], triangles[:, [0, 2, 1]]) if side == "right" else (points, triangles)


def on_unit_sphere(result, points):
    """The surface on another sphere."""
    other = copy.copy(result)
    vars(other)["points"] = points / np.linalg.norm(points, axis=1, keepdims=True)
    return other


def singular_values(surface, sphere, triangles):
    """(F, 2) of the maps from the surface's faces to the flat faces on the sphere, and the surface's areas (F,)."""

    def flat(points):
        a, b, c = points[triangles].transpose(1, 0, 2)
        length = np.linalg.norm(b - a, axis=1)
        along = ((b - a) * (c - a)).sum(axis=1) / length
        height = np.linalg.norm(np.cross(b - a, c - a), axis=1) / length
        return np.stack([length, along, 0 * length, height], axis=1).reshape(-1, 2, 2)

    edges = flat(surface)
    return np.linalg.svd(flat(sphere) @ np.linalg.inv(edges), compute_uv=False), 0.5 * np.linalg.det(edges)


def distortion(surface, sphere, triangles):
    """Mean angle error of the corners by area, in degrees, and the standard deviation of log area."""
    values, area = singular_values(surface, sphere, triangles)
    log = np.log(values.prod(axis=1))
    weights = area / area.sum()

    def angles(points):
        edge = points[triangles][:, [1, 2, 0]] - points[triangles]
        edge /= np.linalg.norm(edge, axis=2, keepdims=True)
        return np.degrees(np.arccos(np.clip(-(edge * edge[:, [2, 0, 1]]).sum(axis=2), -1, 1)))

    error = np.abs(angles(surface) - angles(sphere)).mean(axis=1)
    return weights @ error, np.sqrt(weights @ (log - weights @ log) ** 2)


def by_area(values, others, result):
    """Correlation by the area around the vertices."""
    a, b, c = result.vertices[result.triangles].transpose(1, 0, 2)
    area = np.repeat(np.linalg.norm(np.cross(b - a, c - a), axis=1), 3)
    weights = np.bincount(result.triangles.ravel(), area, minlength=result.vertex_count)
    covariance = np.cov(values, others, aweights=weights)
    return covariance[0, 1] / np.sqrt(covariance[0, 0] * covariance[1, 1])


def flips(sphere, triangles):
    a, b, c = sphere[triangles].transpose(1, 0, 2)
    return int((np.einsum("fk,fk->f", a, np.cross(b, c)) <= 0.0).sum())


def pair_of(**options):
    return [koebe.sphere_map(*read("white", side), **options) for side in ("left", "right")]


def rows():
    """Prints the rows."""
    depth, bend = ([read(name, side) for side in ("left", "right")] for name in ("sulc", "curv"))
    conformal = pair_of()
    theirs = [on_unit_sphere(one, read("sphere", side)[0]) for one, side in zip(conformal, ("left", "right"))]
    print("FreeSurfer's, vertex by number:", [f"{by_area(one[0], one[1], conformal[1]):.3f}" for one in (depth, bend)])
    away = np.degrees(np.arccos(np.clip((theirs[0].points * theirs[1].points).sum(axis=1), -1, 1)))
    print(f"mirrored vertices of one number lie apart by {away.mean():.2f} deg in the mean, {away.max():.2f} at most")
    for name, pair in (("conformal", conformal), ("even=1", pair_of(even=1.0)), ("FreeSurfer", theirs)):
        a, b = pair
        own = distortion(a.vertices, a.points, a.triangles)
        print(f"{name}: angle error {own[0]:.1f}, sd of log area {own[1]:.2f}, flips {flips(a.points, a.triangles)}")
        for stiffness in (None, *STIFFNESS):
            begin = time.process_time()
            how = {} if stiffness is None else {"bend": True, "stiffness": stiffness}
            laid = koebe.transfer(a, b, fields=tuple(depth), **how)
            seconds = time.process_time() - begin
            words = f"depth {laid.similarity:.3f}, curvature {by_area(laid.carry(bend[0]), bend[1], b):.3f}"
            if laid.bending:
                figures = laid.bending
                words += f", |mu| {figures['beltrami']['mean']:.3f} (max {figures['beltrami']['max']:.2f})"
                words += f", sd {figures['log_area_sd']:.3f}, flips {flips(laid.sphere, b.triangles)}"
            whole = distortion(b.vertices, laid.sphere, b.triangles)
            print(f"  {stiffness}: {words}; sphere {whole[0]:.1f} deg, {whole[1]:.2f}; {seconds:.1f} s", flush=True)


def draw(file):
    """Sulcal depth of both hemispheres on the left sphere, from outside: before and after the bending."""
    import matplotlib

    matplotlib.use("agg")
    import matplotlib.pyplot as plt

    a, b = pair_of(even=1.0)
    depth = tuple(read("sulc", side) for side in ("left", "right"))
    turned, bent = (koebe.transfer(a, b, fields=depth, bend=bend) for bend in (False, True))
    low, high = np.percentile(depth[0], [2, 98])
    figure, axes = plt.subplots(1, 3, figsize=(10.5, 3.8), dpi=110, layout="constrained")
    words = ["left", "right, mirrored and turned", "right, bent onto the left"]
    pictures = [(a.points, a.triangles, depth[0]), (turned.sphere, b.triangles, depth[1]),
                (bent.sphere, b.triangles, depth[1])]  # fmt: skip
    out = np.array([-1.0, 0.0, 0.0])  # the outer side of the left hemisphere
    for axis, word, (points, triangles, values) in zip(axes, words, pictures):
        front = (points[triangles].mean(axis=1) @ out) > 0.0
        axis.tripcolor(-points[:, 1], points[:, 2], triangles[front], values, shading="gouraud", cmap="gray_r",
                       vmin=low, vmax=high)  # fmt: skip
        axis.tricontour(-a.points[:, 1], a.points[:, 2],
                        a.triangles[(a.points[a.triangles].mean(axis=1) @ out) > 0.0], depth[0], [0.0],
                        colors="#d8432b", linewidths=0.8)  # fmt: skip
        axis.set_title(word, fontsize=10)
        axis.set(aspect="equal", xlim=(-1.02, 1.02), ylim=(-1.02, 1.02))
        axis.axis("off")
    figure.savefig(file)


def main():
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("--picture", metavar="FILE")
    picture = options.parse_args().picture
    if picture:
        draw(picture)
    else:
        rows()


if __name__ == "__main__":
    main()
