# SPDX-License-Identifier: Apache-2.0
"""Makes a crowd from a collection of heads."""
import os

import bpy

from . import crowds, faces, meshes
from .program import Job, Problem, RunsJob


def heads_of(collection):
    """The mesh objects in a collection and its sub-collections."""
    return [item for item in collection.all_objects if item.type == 'MESH']


def tag_of(collection):
    return meshes.plain_name(meshes.base_name(collection.name))


def tags_of(collection, tags=()):
    """{head: names of the sub-collections that it is in}."""
    found = {item: tags for item in collection.objects if item.type == 'MESH'}
    for child in collection.children:
        found.update(tags_of(child, (*tags, tag_of(child))))
    return found


def write_heads(collection, folder):
    """Writes the heads and their tags. Removes other heads from the folder."""
    heads = heads_of(collection)
    names = [meshes.plain_name(item.name) for item in heads]
    twice = sorted({name for name in names if names.count(name) > 1})
    if twice:
        raise Problem(f"several heads have the name {twice[0]}: rename their objects")
    os.makedirs(folder, exist_ok=True)
    for file in os.listdir(folder):
        if file.endswith(".obj") and file[:-4] not in names:
            os.remove(os.path.join(folder, file))
    for name, item in zip(names, heads):
        meshes.write_obj(os.path.join(folder, name + ".obj"), item)
    tags = tags_of(collection)
    with open(os.path.join(folder, "tags.yaml"), "w", encoding="utf-8") as out:
        out.write("faces:\n  tags:\n")
        for name, item in zip(names, heads):
            out.write(f"    {name}: [{', '.join(tags[item])}]\n")


def write_shapes(item, folder):
    """Writes the shape keys of a head: its Basis as neutral.obj, the others into shapes/."""
    os.makedirs(os.path.join(folder, "shapes"), exist_ok=True)
    basis, *others = item.data.shape_keys.key_blocks
    meshes.write_obj(os.path.join(folder, "neutral.obj"), item, basis, materials=False)
    for block in others:
        file = os.path.join(folder, "shapes", meshes.plain_name(block.name) + ".obj")
        meshes.write_obj(file, item, block, materials=False)


class Crowd:
    """The files of a crowd that is made here, and the commands that make it."""

    def __init__(self, options):
        if not options.heads or not heads_of(options.heads):
            raise Problem("choose a collection with heads")
        if options.folder.startswith("//") and not bpy.data.filepath:
            raise Problem("save the Blender file first, or choose a folder that does not begin with //")
        self.options = options
        self.folder = os.path.abspath(bpy.path.abspath(options.folder))
        self.name = meshes.plain_name(options.heads.name)
        self.heads = os.path.join(self.folder, "heads")
        self.config = os.path.join(self.folder, "crowd.yaml")
        self.out = os.path.join(self.folder, "out", self.name)

    def write(self):
        write_heads(self.options.heads, self.heads)
        if self.options.expressions:
            write_shapes(self.options.expressions, os.path.join(self.folder, "expressions"))

    def init(self):
        return ["init", self.heads, "-o", self.config, "--force"]

    def command(self, name, *more):
        settings = [word for key, value in self.settings() for word in ("--set", f"{key}={value}")]
        return [name, self.config, *more, *settings]

    def settings(self):
        """Keys of the config that replace those of `init`."""
        options = self.options
        yield "crowd.name", self.name
        yield "crowd.count", options.count
        yield "crowd.seed", options.seed
        yield "sampling.smoothness", f"[{min(0.15, options.variety):.3g}, {options.variety:.3g}]"
        yield "output.meshes", "[glb]"
        yield "output.directory", self.out
        if options.distance:
            yield "diversity.min_distance", f"{options.distance:.4g} mm"
        if options.units != 'GUESS':
            yield "faces.units", options.units
        if options.align:
            yield "faces.align", "rigid"
        if options.groups:
            names = [tag_of(child) for child in options.heads.children if heads_of(child)]
            if not names:
                raise Problem("groups need sub-collections with heads in the collection")
            yield "groups", "[" + ", ".join(f"{{name: {name}, tags: [{name}]}}" for name in names) + "]"
        if options.families:
            yield "families", "[" + ", ".join(
                f"{{name: family_{i + 1}, members: {options.members}}}" for i in range(options.families)) + "]"
        if options.expressions:
            yield "shapes", "{neutral: expressions/neutral.obj, directory: expressions/shapes}"
        if options.attachments:
            yield "attachments.from", os.path.abspath(bpy.path.abspath(options.attachments))
        if options.traits:
            yield "traits", "{" + ", ".join(f"{name.strip()}: {{}}" for name in options.traits.split(",")) + "}"
        if options.lods:
            yield "output.lods", f"[{options.lods}]"


class CROWDFACE_OT_check(RunsJob, bpy.types.Operator):
    """Write the heads, and report every problem: different topology, wrong size or direction, bad options"""
    bl_idname = "crowdface.check"
    bl_label = "Check Heads"

    def start(self, context):
        crowd = Crowd(context.scene.crowdface.generate)
        crowd.write()
        return Job("Check", [crowd.init(), crowd.command("check")])

    def finish(self, context, job):
        self.report({'INFO'}, "the heads share one topology, and the options fit")


class CROWDFACE_OT_generate(RunsJob, bpy.types.Operator):
    """Write the heads and make the crowd; a cancelled run continues"""
    bl_idname = "crowdface.generate"
    bl_label = "Generate"
    bl_options = {'REGISTER', 'UNDO'}

    def start(self, context):
        options = context.scene.crowdface.generate
        self._crowd = Crowd(options)
        self._crowd.write()
        more = ["--force"] if options.force else []
        return Job("Generate", [self._crowd.init(), self._crowd.command("generate", *more)], self._crowd.out)

    def finish(self, context, job):
        browse = context.scene.crowdface.browse
        browse.folder = self._crowd.out
        if context.scene.crowdface.generate.show:
            crowd = crowds.read(self._crowd.out)
            ids = [face.id for face in crowd.faces]
            shown = faces.replace(context, crowd, ids)  # by an earlier run
            places = faces.grid(context.scene.cursor.location, len(ids), browse.columns, browse.spacing)
            new = [(face, place) for face, place in zip(ids, places) if face not in shown]
            faces.place_faces(context, crowd, [face for face, _ in new], [0], [place for _, place in new])
        self.report({'INFO'}, f"the crowd is in {self._crowd.out}")


CLASSES = (CROWDFACE_OT_check, CROWDFACE_OT_generate)


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister():
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
