# SPDX-License-Identifier: Apache-2.0
"""Imports faces of a crowd and places them.

Each face gets a collection with the face and its attachments. The face's object stores the crowd's folder and the id.
"""
import os

import bpy
import numpy
from mathutils import Matrix

from .program import Problem

CROWD, FACE, LEVEL, WELD = "crowdface_crowd", "crowdface_face", "crowdface_level", "crowdface_weld"


def _import_glb(file, weld):
    """The objects of a GLB file, the face first."""
    if "bool" not in numpy.__dict__:
        numpy.bool = bool  # Blender 3.4's importer needs this name
    before = set(bpy.data.objects)
    bpy.ops.import_scene.gltf(filepath=file, merge_vertices=weld)
    new = [item for item in bpy.data.objects if item not in before]
    return sorted(new, key=lambda item: item.parent is not None)


def _collection(name, parent):
    found = parent.children.get(name)
    if not found:
        found = bpy.data.collections.new(name)
        parent.children.link(found)
    return found


def _fill(collection, items):
    for item in items:
        for other in item.users_collection:
            other.objects.unlink(item)
        collection.objects.link(item)


def import_face(crowd, face, level, parent, weld=False):
    """A new collection below `parent` with one face. Returns its objects, the face first.

    `weld` merges vertices that GLB files split at texture seams. The vertex order then differs between faces.
    """
    file = crowd.mesh(face, level)
    if not file:
        raise Problem(f"{crowd.folder} has no GLB file of {face}" + (f" at level {level}" if level else ""))
    items = _import_glb(file, weld)
    items[0][CROWD], items[0][FACE], items[0][LEVEL], items[0][WELD] = crowd.folder, face, level, weld
    collection = bpy.data.collections.new(items[0].name)
    parent.children.link(collection)
    _fill(collection, items)
    return items


def _duplicate(items, parent):
    """Copies objects; the copies share the meshes of the originals."""
    copies = {item: item.copy() for item in items}
    for copy in copies.values():
        if copy.parent in copies:
            copy.parent = copies[copy.parent]
    collection = bpy.data.collections.new(items[0].name)
    parent.children.link(collection)
    _fill(collection, copies.values())
    return list(copies.values())


def see_through(scene):
    """Lets rays of Cycles pass at least 64 transparent surfaces. With the default of 8, hair cards and eyes become black."""
    if hasattr(scene, "cycles"):
        scene.cycles.transparent_max_bounces = max(64, scene.cycles.transparent_max_bounces)


def name_of(crowd):
    """The name of the collection with a crowd's faces."""
    return os.path.basename(crowd.folder) + " faces"


def place_faces(context, crowd, ids, levels, places, weld=False):
    """Imports a face for each place; if there are more places than faces, faces repeat as linked duplicates.

    Levels of detail other than the first of `levels` get a hidden collection each. Returns the faces' objects.
    """
    placed = []
    see_through(context.scene)
    for level in levels:
        parent = _collection(name_of(crowd) + (f" LOD{level}" if level != levels[0] else ""), context.scene.collection)
        imported = []
        for number, place in enumerate(places):
            if number < len(ids):
                items = import_face(crowd, ids[number], level, parent, weld)
                imported.append((items, items[0].matrix_basis.copy()))
            else:
                items = _duplicate(imported[number % len(ids)][0], parent)
            items[0].matrix_basis = place @ imported[number % len(ids)][1]
            if level == levels[0]:
                placed.append(items[0])
        parent.hide_viewport = parent.hide_render = level != levels[0]
    context.view_layer.update()
    return placed


def grid(origin, count, columns, spacing):
    return [Matrix.Translation((origin[0] + spacing * (i % columns), origin[1] + spacing * (i // columns), origin[2]))
            for i in range(count)]


def vertex_places(item):
    """The selected vertices of a mesh object."""
    item.update_from_editmode()
    return [Matrix.Translation(item.matrix_world @ vertex.co) for vertex in item.data.vertices if vertex.select]


def exclude(layer, collection):
    """Hides a collection from a view layer; instances of it stay visible."""
    for child in layer.children:
        if child.collection == collection:
            child.exclude = True
        exclude(child, collection)


def replace(context, crowd, ids):
    """Imports these faces again wherever the scene has them. Returns the ids of the replaced objects."""
    old = [item for item in context.scene.objects if item.get(CROWD) == crowd.folder and item.get(FACE) in ids]
    replaced = []
    for item in old:
        collection, place = item.users_collection[0], item.matrix_basis.copy()
        face, level, weld = item[FACE], item[LEVEL], bool(item[WELD])
        parent = next(c for c in [context.scene.collection, *bpy.data.collections] if collection.name in c.children)
        for part in list(collection.objects):
            bpy.data.objects.remove(part)
        bpy.data.collections.remove(collection)
        import_face(crowd, face, level, parent, weld)[0].matrix_basis = place
        replaced.append(face)
    return replaced
