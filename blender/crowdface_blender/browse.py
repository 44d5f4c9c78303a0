# SPDX-License-Identifier: Apache-2.0
"""Imports chosen faces of a crowd, and reviews a crowd."""
import os

import bpy
import bpy.utils.previews

from . import crowds, faces
from .program import CROWDFACE_OT_cancel, Job, Problem, RunsJob

PAGE = 12  # faces per page

_pictures = None


def picture(crowd, face):
    """Blender's icon number for a face's thumbnail; 0 if the face has no picture."""
    file = crowd.picture(face)
    if not file:
        return 0
    key = f"{file} {os.stat(file).st_mtime_ns}"
    if key not in _pictures:
        _pictures.load(key, file, 'IMAGE')
    return _pictures[key].icon_id


def open_crowd(context):
    browse = context.scene.crowdface.browse
    crowd = crowds.read(browse.path())
    if not crowd:
        raise Problem("choose the folder of a crowd")
    return browse, crowd


class CROWDFACE_OT_import(bpy.types.Operator):
    """Import the chosen faces with materials, hair and shape keys"""
    bl_idname = "crowdface.import_faces"
    bl_label = "Import Chosen Faces"
    bl_options = {'REGISTER', 'UNDO'}

    def execute(self, context):
        try:
            browse, crowd = open_crowd(context)
            ids = [item.name for item in browse.faces if item.chosen]
            if not ids:
                raise Problem("choose at least one face")
            levels = [browse.level]
            if browse.all_levels:
                levels += range(browse.level + 1, crowd.levels() + 1)
            places = self._places(context, browse, len(ids))
            placed = faces.place_faces(context, crowd, ids, levels, places, browse.weld)
        except Problem as problem:
            self.report({'ERROR'}, str(problem))
            return {'CANCELLED'}
        if browse.place == 'INSTANCES':
            faces.exclude(context.view_layer.layer_collection, bpy.data.collections[faces.name_of(crowd)])
        self.report({'INFO'}, f"{len(placed)} faces")
        return {'FINISHED'}

    @staticmethod
    def _places(context, browse, count):
        cursor = context.scene.cursor.location
        if browse.place == 'CURSOR':
            return faces.grid(cursor, count, count, browse.spacing)
        if browse.place == 'GRID':
            return faces.grid(cursor, count, browse.columns, browse.spacing)
        if browse.place == 'INSTANCES':
            return faces.grid((0, 0, 0), count, 1, 0)
        if browse.place == 'EMPTIES':
            places = [item.matrix_world.copy() for item in context.selected_objects if item.type == 'EMPTY']
        else:
            item = context.active_object
            places = faces.vertex_places(item) if item and item.type == 'MESH' else []
        if not places:
            raise Problem("select empties" if browse.place == 'EMPTIES' else "select vertices of the active mesh")
        return places


class CROWDFACE_OT_choose(bpy.types.Operator):
    """Choose all faces that the filters show, or none"""
    bl_idname = "crowdface.choose"
    bl_label = "Choose Faces"
    choose: bpy.props.BoolProperty(default=True)

    def execute(self, context):
        browse = context.scene.crowdface.browse
        for item in browse.filtered() if self.choose else browse.faces:
            item.chosen = self.choose
        return {'FINISHED'}


class CROWDFACE_OT_page(bpy.types.Operator):
    """Show other faces"""
    bl_idname = "crowdface.page"
    bl_label = "Page"
    by: bpy.props.IntProperty(default=1)

    def execute(self, context):
        browse = context.scene.crowdface.browse
        pages = (len(browse.filtered()) + PAGE - 1) // PAGE
        browse.page = max(0, min(browse.page + self.by, pages - 1))
        return {'FINISHED'}


class CROWDFACE_OT_add_glb(RunsJob, bpy.types.Operator):
    """Write GLB files of a crowd that has other formats only"""
    bl_idname = "crowdface.add_glb"
    bl_label = "Add GLB Files"

    def start(self, context):
        _, crowd = open_crowd(context)
        formats = ", ".join([*crowd.formats(), "glb"])
        return Job("Add GLB Files", [round_of(crowd, "--set", f"output.meshes=[{formats}]")], crowd.folder)

    def finish(self, context, job):
        crowds.forget(context.scene.crowdface.browse.path())


def round_of(crowd, *more):
    """The command that generates a crowd again in its folder."""
    return ["generate", os.path.join(crowd.folder, "config.yaml"), "--out", crowd.folder, *more]


def write_review(browse, file):
    """Writes the marks as a review. Returns the ids of the faces that the review changes."""
    marked = [item for item in browse.faces if item.mark != 'NONE']
    if not marked:
        raise Problem("mark at least one face")
    for item in marked:
        if item.mark == 'variant' and not item.variant_of:
            raise Problem(f"{item.name}: choose the face that it is a variant of")
    lines = {"faces": [], "changes": []}
    for item in marked:
        if item.mark in ('keep', 'reject'):
            lines["faces"].append(f"  {item.name}: {item.mark}\n")
        elif item.mark == 'variant':
            change = f"{{variant_of: {item.variant_of}, distance: {item.distance:.4g} mm}}"
            lines["changes"].append(f"  {item.name}: {change}\n")
        else:
            lines["changes"].append(f"  {item.name}: {{age: {item.mark}}}\n")
    with open(file, "w", encoding="utf-8") as out:
        out.write("schema: 1\n" + "".join(f"{key}:\n" + "".join(rows) for key, rows in lines.items() if rows))
    return [item.name for item in marked if item.mark != 'keep']


class CROWDFACE_OT_review(RunsJob, bpy.types.Operator):
    """Write the marks as a review and make the marked faces again; the scene shows the new faces"""
    bl_idname = "crowdface.review"
    bl_label = "Run Review"
    bl_options = {'REGISTER', 'UNDO'}

    def start(self, context):
        browse, crowd = open_crowd(context)
        file = crowd.folder + "-review.yaml"
        self._ids = write_review(browse, file)
        return Job("Review", [round_of(crowd, "--review", file)], crowd.folder)

    def finish(self, context, job):
        browse = context.scene.crowdface.browse
        browse.folder = browse.folder  # reads the crowd again, without marks
        replaced = faces.replace(context, crowds.read(browse.path()), self._ids)
        self.report({'INFO'}, f"{len(self._ids)} faces drawn again, {len(replaced)} objects replaced")


CLASSES = (CROWDFACE_OT_cancel, CROWDFACE_OT_import, CROWDFACE_OT_choose, CROWDFACE_OT_page, CROWDFACE_OT_add_glb,
           CROWDFACE_OT_review)


def register():
    global _pictures
    _pictures = bpy.utils.previews.new()
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister():
    if RunsJob.current:
        RunsJob.current.cancel()
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
    bpy.utils.previews.remove(_pictures)
