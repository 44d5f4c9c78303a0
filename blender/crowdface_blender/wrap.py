# SPDX-License-Identifier: Apache-2.0
"""Fits the active template to a scan."""
import os
import tempfile

import bpy

from . import meshes
from .program import Job, Problem, RunsJob


def landmarks_of(item):
    """{name: place} of the empties below an object, in the coordinates of its OBJ file. Blender's .001 is dropped."""
    turn = item.matrix_world.to_3x3() @ item.matrix_world.inverted().to_3x3()
    return {meshes.base_name(child.name): turn @ (child.matrix_world.translation - item.matrix_world.translation)
            for child in item.children if child.type == 'EMPTY'}


def write_landmarks(file, template, scan):
    """Writes landmarks if both objects have some."""
    both = [(key, landmarks_of(item)) for key, item in (("template", template), ("scan", scan))]
    if not all(landmarks for _, landmarks in both):
        return False
    with open(file, "w", encoding="utf-8") as out:
        for key, landmarks in both:
            out.write(f"{key}:\n")
            for name, place in landmarks.items():
                out.write(f"  {meshes.plain_name(name)}: [{', '.join('%.9g' % x for x in place)}]\n")
    return True


class CROWDFACE_OT_wrap(RunsJob, bpy.types.Operator):
    """Fit a copy of the active object, the template, to the scan. Empties below both are landmarks"""
    bl_idname = "crowdface.wrap"
    bl_label = "Wrap Scan"
    bl_options = {'REGISTER', 'UNDO'}

    def start(self, context):
        template, options = context.active_object, context.scene.crowdface.wrap
        if not template or template.type != 'MESH':
            raise Problem("make the template the active object")
        if not options.scan or options.scan == template:
            raise Problem("choose a scan that is not the template")
        self._template = template
        self._folder = tempfile.TemporaryDirectory(prefix="crowdface-")
        names = ("template.obj", "scan.obj", "landmarks.yaml", "head.obj")
        template_file, scan_file, landmarks, self._head = (os.path.join(self._folder.name, name) for name in names)
        meshes.write_obj(template_file, template, materials=False)
        meshes.write_obj(scan_file, options.scan, materials=False)
        command = ["wrap", template_file, scan_file, "-o", self._head, "--no-pictures",
                   "--up", meshes.UP, "--front", meshes.FRONT]
        if write_landmarks(landmarks, template, options.scan):
            command += ["--landmarks", landmarks]
        if options.keep_size:
            unit = f"{100 * context.scene.unit_settings.scale_length:.9g} cm"
            command += ["--units", unit, "--scan-units", unit]
        return Job("Wrap", [command])

    def finish(self, context, job):
        head = self._template.copy()
        head.data = self._template.data.copy()
        if head.data.shape_keys:
            head.shape_key_clear()
        head.name = context.scene.crowdface.wrap.scan.name + " wrapped"
        meshes.set_points(head, meshes.read_points(self._head))
        context.collection.objects.link(head)
        self.report({'INFO'}, head.name)


def register():
    bpy.utils.register_class(CROWDFACE_OT_wrap)


def unregister():
    bpy.utils.unregister_class(CROWDFACE_OT_wrap)
