# SPDX-License-Identifier: Apache-2.0
"""A crowd from arrays alone. The heads are made with NumPy, and the faces stay in memory.

    PYTHONPATH=build/release/python python3 examples/python/crowd_from_arrays.py [COUNT]
"""

import sys

import numpy as np

import crowdface


def sphere(rings, columns):
    """A sphere of quads, open at the neck: directions (V, 3), faces (F, 4), uvs (V, 2)."""
    v, u = np.meshgrid(np.linspace(0.06, 0.9, rings), np.arange(columns) / columns, indexing="ij")
    polar, around = np.pi * v, 2 * np.pi * u
    directions = np.stack(
        [np.sin(polar) * np.sin(around), np.cos(polar), np.sin(polar) * np.cos(around)], axis=-1
    )
    row, column = np.meshgrid(np.arange(rings - 1), np.arange(columns), indexing="ij")
    after = (column + 1) % columns
    faces = np.stack(
        [row * columns + column, (row + 1) * columns + column, (row + 1) * columns + after,
         row * columns + after], axis=-1,
    )  # fmt: skip
    uvs = np.stack([u, 1 - v], axis=-1)
    return directions.reshape(-1, 3), faces.reshape(-1, 4), uvs.reshape(-1, 2)


def bump(directions, where, width):
    """A smooth bump around a direction, with its mirror image: (V,)."""
    places = [np.array(where), np.array(where) * (-1, 1, 1)]
    return sum(
        np.exp(-np.sum((directions - place / np.linalg.norm(place)) ** 2, axis=1) / width**2)
        for place in places
    )


def head(directions, random):
    """A head of about 15 by 22 by 19 cm with a nose, eye sockets, a brow and a chin."""
    size = np.array([7.5, 11, 9.5]) * random.normal(1, 0.04, 3)
    relief = (
        random.normal(0.9, 0.15) * bump(directions, (0, -0.1, 1), random.normal(0.22, 0.02))  # nose
        - random.normal(0.5, 0.1) * bump(directions, (0.35, 0.15, 1), 0.2)  # eyes
        + random.normal(0.3, 0.08) * bump(directions, (0.3, 0.4, 1), 0.25)  # brow
        + random.normal(0.4, 0.1) * bump(directions, (0.1, -0.75, 0.8), 0.25)  # chin
    )
    return directions * size + directions * relief[:, None]


count = int(sys.argv[1]) if len(sys.argv) > 1 else 6
random = np.random.default_rng(5)
directions, faces, uvs = sphere(60, 80)
heads = crowdface.Heads(
    [head(directions, random) for _ in range(6)], faces, uvs=uvs, uv_faces=faces,
    names=["ada", "ben", "cleo", "dan", "eve", "fay"],
)  # fmt: skip
print(f"{len(heads)} heads of {heads.vertex_count} vertices, at distances (mm) of")
print(np.round(crowdface.distances(heads), 1))

# One region for the upper half and one for the lower half, with a soft border.
upper = 1 / (1 + np.exp(-directions[:, 1] / 0.1))
masks = np.stack([upper, 1 - upper], axis=1)

job = crowdface.Job(
    {
        "schema": 1,
        "crowd": {"name": "arrays", "count": count, "seed": 7},
        "faces": {"units": "cm", "up": "+Y", "front": "+Z"},
        "regions": {"names": ["upper", "lower"]},
        "sampling": {"smoothness": [0.1, 0.5]},
    },
    heads,
    masks,
)
recipes = job.cast()
for recipe in recipes:
    parts = {name: max(r["weights"], key=r["weights"].get) for name, r in recipe["regions"].items()}
    print(f"{recipe['id']}: the shape of {recipe['target']}, most detail of {parts}")

crowd = job.blend_all(recipes)
between = crowdface.distances(job.heads, crowd)
print(f"{len(crowd)} faces; the two most alike are {between[between > 0].min():.2f} mm apart")

# A face is an array like any other: here it is smoothed, and a head gets half of another's detail.
smoothing = crowdface.Smoothing(heads)
smooth = smoothing.smooth(crowd[0], 20)
print(f"20 iterations move {recipes[0]['id']} by up to {np.abs(smooth - crowd[0]).max():.2f} cm")
half = smoothing.blend(
    {
        "target": "ada",
        "regions": {"all": {"weights": {"ada": 0.5, "ben": 0.5}, "iterations": 300}},
    }
)
both = crowdface.distances(heads, [half, heads.positions(0), heads.positions(1)])
print(f"with half of ben's detail, ada is {both[0, 1]:.2f} mm from herself, {both[0, 2]:.2f} mm from ben")
