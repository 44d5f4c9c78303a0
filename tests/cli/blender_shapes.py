# SPDX-License-Identifier: Apache-2.0
"""Imports a face into Blender and compares it, at rest and in each shape, with its OBJ files.

blender --background --factory-startup --python-exit-code 1 --python blender_shapes.py -- MESHES ID CM [PICTURE]

MESHES/ID.glb has the shapes of MESHES/ID+SHAPE.obj; CM: how many OBJ units are a metre. Of MESHES/ID.usda the
vertices at rest are compared. PICTURE: where a picture of the last shape is drawn.
"""
import glob
import os
import sys

import bpy
import numpy
from mathutils import Vector, kdtree

# The importer of Debian 12 asks NumPy for a name that it has no longer.
numpy.bool = bool

folder, face, per_metre = sys.argv[sys.argv.index("--") + 1:][:3]
rest = sys.argv[sys.argv.index("--") + 4:]
per_metre = float(per_metre)
TOLERANCE = 2e-6  # metres: what single precision leaves


def read_obj(name):
    """Vertices as Blender has them: metres, +Z up."""
    with open(os.path.join(folder, name + ".obj"), encoding="utf-8") as lines:
        rows = [line.split()[1:4] for line in lines if line.startswith("v ")]
    points = numpy.array(rows, dtype=float) / per_metre
    return numpy.stack([points[:, 0], -points[:, 2], points[:, 1]], axis=1)


def empty_scene():
    bpy.ops.wm.read_factory_settings(use_empty=True)


def meshes():
    return [item for item in bpy.data.objects if item.type == "MESH"]


def vertices(item):
    """In the world, as the modifiers and shape keys leave them."""
    evaluated = item.evaluated_get(bpy.context.evaluated_depsgraph_get())
    local = numpy.empty(3 * len(evaluated.data.vertices))
    evaluated.data.vertices.foreach_get("co", local)
    world = numpy.array(evaluated.matrix_world)
    return local.reshape(-1, 3) @ world[:3, :3].T + world[:3, 3]


def numbers_of(points, expected):
    """Of each point those of the OBJ file's vertices that lie where it does."""
    tree = kdtree.KDTree(len(expected))
    for number, point in enumerate(expected):
        tree.insert(Vector(point), number)
    tree.balance()
    found = []
    for point in points:
        near = [number for _, number, _ in tree.find_range(Vector(point), TOLERANCE)]
        assert near, f"no vertex of the OBJ file at {point}"
        found.append(near)
    return found


def compare(points, numbers, expected, what):
    worst = max(
        min(numpy.linalg.norm(expected[number] - point) for number in near)
        for point, near in zip(points, numbers))
    assert worst < 2 * TOLERANCE, f"{what}: off by {worst} m"
    return worst


def import_glb():
    empty_scene()
    bpy.ops.import_scene.gltf(filepath=os.path.join(folder, face + ".glb"))
    (item,) = [item for item in meshes() if item.data.shape_keys]
    at_rest = read_obj(face)
    numbers = numbers_of(vertices(item), at_rest)
    assert len({number for near in numbers for number in near}) > 0.95 * len(at_rest)
    files = sorted(glob.glob(os.path.join(folder, glob.escape(face) + "+*.obj")))
    shapes = [os.path.basename(file)[len(face) + 1:-4] for file in files]
    keys = item.data.shape_keys.key_blocks
    assert sorted(key.name for key in keys[1:]) == shapes, [key.name for key in keys]
    for shape in shapes:
        keys[shape].value = 1
        bpy.context.view_layer.update()
        expected = read_obj(face + "+" + shape)
        moved = numpy.linalg.norm(expected - at_rest, axis=1).max()
        worst = compare(vertices(item), numbers, expected, shape)
        print(f"{face}, {shape}: moves {1000 * moved:.2f} mm, off by {1e6 * worst:.2f} um")
        keys[shape].value = 0
    return item, shapes


def import_usd():
    if not bpy.app.build_options.usd:
        print("this Blender was built without USD")
        return
    empty_scene()
    bpy.ops.wm.usd_import(filepath=os.path.join(folder, face + ".usda"))
    points = numpy.concatenate([vertices(item) for item in meshes()])
    numbers_of(points, read_obj(face))
    print(f"{face}.usda: {len(points)} vertices where the OBJ file has them")


def render(item, shape, picture):
    item.data.shape_keys.key_blocks[shape].value = 1
    points = vertices(item)
    middle, size = (points.min(axis=0) + points.max(axis=0)) / 2, numpy.ptp(points, axis=0).max()
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.location = middle + numpy.array([0, -2.2 * size, 0.05 * size])
    camera.rotation_euler = (1.5708, 0, 0)
    bpy.context.collection.objects.link(camera)
    scene = bpy.context.scene
    scene.camera = camera
    scene.render.engine = "BLENDER_WORKBENCH"
    scene.render.resolution_x = scene.render.resolution_y = 600
    scene.render.filepath = picture
    bpy.ops.render.render(write_still=True)


import_usd()
imported, names = import_glb()
if rest:
    render(imported, names[-1], rest[0])
