# SPDX-License-Identifier: Apache-2.0
"""Writes mesh objects as OBJ files, and reads vertices back.

Vertices keep their order. Coordinates are Blender's (+Z up, heads look along -Y), with the object's rotation and scale
but without its location, so heads may stand side by side in the scene.
"""
import os
import re
import shutil

import bpy
import numpy

UP, FRONT = "+Z", "-Y"


def plain_name(name):
    """The name with each character that crowdface does not accept replaced by `_`."""
    return re.sub(r"[^A-Za-z0-9_.-]", "_", name).lstrip(".")[:64] or "_"


def base_name(name):
    """The name without the number, such as .001, that Blender appends to make names unique."""
    return re.sub(r"\.\d{3}$", "", name)


def _material_names(mesh):
    """Material names without Blender's numbers: the skin of each imported head is "skin", not "skin.001"."""
    names = [plain_name(material.name) if material else "none" for material in mesh.materials]
    short = [base_name(name) for name in names]
    return short if len(set(short)) == len(set(names)) else names


def points_of(item, block=None):
    """Vertices of a mesh object (or of one of its shape keys), n by 3."""
    source = block.data if block else item.data.vertices
    points = numpy.empty(3 * len(source))
    source.foreach_get("co", points)
    turn = numpy.array(item.matrix_world.to_3x3())
    return points.reshape(-1, 3) @ turn.T


def _corners(mesh):
    corners = numpy.empty(len(mesh.loops), dtype=int)
    mesh.loops.foreach_get("vertex_index", corners)
    return corners


def _texture_coordinates(mesh, corners):
    """The texture coordinates of all different (vertex, u, v), and for each corner an index of these rows."""
    layer = mesh.uv_layers.active
    if not layer:
        return None, None
    uvs = numpy.empty(2 * len(corners))
    layer.data.foreach_get("uv", uvs)
    rows, numbers = numpy.unique(numpy.column_stack([corners, uvs.reshape(-1, 2)]), axis=0, return_inverse=True)
    return rows[:, 1:], numbers.reshape(-1)


def write_obj(file, item, block=None, materials=True):
    """Writes the mesh without its modifiers."""
    mesh = item.data
    corners = _corners(mesh)
    uvs, uv_corners = _texture_coordinates(mesh, corners)
    names = _material_names(mesh)
    lines = []
    if materials and names:
        library = os.path.splitext(file)[0] + ".mtl"
        _write_materials(library, names, mesh.materials)
        lines.append(f"mtllib {os.path.basename(library)}")
    lines += ["v %.9g %.9g %.9g" % tuple(point) for point in points_of(item, block)]
    if uvs is not None:
        lines += ["vt %.9g %.9g" % tuple(uv) for uv in uvs]
    used = None
    for polygon in mesh.polygons:
        if names and polygon.material_index != used:
            used = polygon.material_index
            lines.append(f"usemtl {names[min(used, len(names) - 1)]}")
        if uvs is None:
            lines.append("f " + " ".join(str(corners[i] + 1) for i in polygon.loop_indices))
        else:
            lines.append("f " + " ".join(f"{corners[i] + 1}/{uv_corners[i] + 1}" for i in polygon.loop_indices))
    with open(file, "w", encoding="utf-8") as out:
        out.write("\n".join(lines) + "\n")


def base_colour(material):
    """The image that feeds the Base Color of a material (or None), and the plain colour."""
    tree = material.node_tree
    shader = next((n for n in tree.nodes if n.type == 'BSDF_PRINCIPLED'), None) if tree else None
    if not shader:
        return None, material.diffuse_color
    socket = shader.inputs["Base Color"]
    waiting = [link.from_node for link in socket.links]
    while waiting:
        node = waiting.pop(0)
        if node.type == 'TEX_IMAGE' and node.image and node.image.source in ('FILE', 'GENERATED'):
            return node.image, socket.default_value
        waiting += [link.from_node for plug in node.inputs for link in plug.links]
    return None, socket.default_value


def _write_materials(library, names, materials):
    lines = []
    for name, material in zip(names, materials):
        lines.append(f"newmtl {name}")
        image, colour = base_colour(material) if material else (None, (0.8, 0.8, 0.8, 1))
        lines.append("Kd %.6g %.6g %.6g" % tuple(colour[:3]))
        if image:
            lines.append(f"map_Kd {_write_image(image, os.path.dirname(library))}")
    with open(library, "w", encoding="utf-8") as out:
        out.write("\n".join(lines) + "\n")


def _write_image(image, folder):
    """Copies an image into the folder, or writes it there, and returns its file name."""
    source = bpy.path.abspath(image.filepath, library=image.library)
    stem = plain_name(re.sub(r"\.(png|jpe?g|tiff?|exr|tga|bmp)$", "", image.name, flags=re.IGNORECASE))
    if image.packed_file:
        name = stem + (".jpg" if image.file_format == 'JPEG' else ".png")
        with open(os.path.join(folder, name), "wb") as out:
            out.write(image.packed_file.data)
    elif os.path.isfile(source) and not image.is_dirty:
        name = stem + os.path.splitext(source)[1].lower()
        if os.path.abspath(source) != os.path.abspath(os.path.join(folder, name)):
            shutil.copyfile(source, os.path.join(folder, name))
    else:  # painted or generated, not saved
        name = stem + ".png"
        copy = image.copy()
        copy.filepath_raw, copy.file_format = os.path.join(folder, name), 'PNG'
        copy.save()
        bpy.data.images.remove(copy)
    return name


def read_points(file):
    """The vertices of an OBJ file, n by 3."""
    with open(file, encoding="utf-8") as lines:
        return numpy.array([line.split()[1:4] for line in lines if line.startswith("v ")], dtype=float)


def set_points(item, points):
    """Moves the vertices of an object to `points`, in the coordinates of `points_of`."""
    turn = numpy.linalg.inv(numpy.array(item.matrix_world.to_3x3()))
    item.data.vertices.foreach_set("co", (points @ turn.T).astype(numpy.float32).reshape(-1))
    item.data.update()
