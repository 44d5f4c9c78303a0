# SPDX-License-Identifier: Apache-2.0
"""The add-on's preferences, and the panels' settings, which the scene stores."""
import os

import bpy
from bpy.props import (BoolProperty, CollectionProperty, EnumProperty, FloatProperty, IntProperty, PointerProperty,
                       StringProperty)

from . import crowds
from .program import RunsJob

ANY = "*"  # no filter

_items = {}  # Blender keeps no reference to the strings of dynamic enumerations


def _choices(kind, names):
    """The items of a filter: everything, or one of the names of the open crowd."""

    def items(browse, context):
        crowd = crowds.read(browse.path())
        _items[kind] = [(ANY, "Any", "")] + [
            (name, name.replace("_", " "), "") for name in (names(crowd) if crowd else [])]
        return _items[kind]
    return items


def _open_crowd(browse, context):
    """Lists the faces of another folder."""
    crowd = crowds.read(browse.path())
    browse.faces.clear()
    browse.page = 0
    for face in crowd.faces if crowd else []:
        browse.faces.add().name = face.id


def _choose_trait(browse, context):
    crowd = crowds.read(browse.path())
    if crowd and browse.trait not in ("", ANY):
        browse.low, browse.high = crowd.range_of(browse.trait)


class CrowdfacePreferences(bpy.types.AddonPreferences):
    bl_idname = __package__
    program: StringProperty(name="Program", default="crowdface", subtype='FILE_PATH',
                            description="The installed program crowdface, or its name if it is on PATH")

    def draw(self, context):
        self.layout.prop(self, "program")


class CrowdfaceGenerate(bpy.types.PropertyGroup):
    heads: PointerProperty(name="Heads", type=bpy.types.Collection,
                           description="Mesh objects that share one topology; sub-collections become tags")
    folder: StringProperty(name="Folder", default="//crowdface", subtype='DIR_PATH',
                           description="Gets the heads, the config and the crowd")
    units: EnumProperty(name="Unit", default='GUESS', description="What one Blender unit is", items=[
        ('GUESS', "Guess", "crowdface guesses the unit from the size of the heads"),
        ('m', "Metre", ""), ('cm', "Centimetre", ""), ('mm', "Millimetre", ""), ('in', "Inch", "")])
    align: BoolProperty(name="Align heads", description="Correct heads that are shifted or rotated")
    count: IntProperty(name="Faces", default=12, min=0, soft_max=1000)
    seed: IntProperty(name="Seed", default=1, min=0)
    variety: FloatProperty(name="Variety", default=0.7, min=0, max=1, subtype='FACTOR',
                           description="How much of a head's detail other heads may replace (sampling.smoothness)")
    distance: FloatProperty(name="Apart, mm", default=0, min=0, soft_max=5,
                            description="The smallest distance between two faces in mm (diversity.min_distance)")
    groups: BoolProperty(name="Groups by sub-collection",
                         description="Faces of a group are made of the heads of one sub-collection")
    families: IntProperty(name="Families", default=0, min=0, soft_max=20)
    members: IntProperty(name="Members", default=3, min=1, soft_max=20, description="Faces of each family")
    expressions: PointerProperty(name="Expressions", type=bpy.types.Object,
                                 poll=lambda self, item: item.type == 'MESH' and item.data.shape_keys is not None,
                                 description="A head whose shape keys every face gets")
    attachments: StringProperty(name="Hair", subtype='DIR_PATH',
                                description="A folder with attachments.yaml, in the unit and axes of the heads")
    lods: StringProperty(name="Levels",
                         description="Levels of detail: percentages of the triangles, such as 50 %, 20 %")
    traits: StringProperty(name="Traits", description="Measurements to filter by, such as nose_width, face_height")
    force: BoolProperty(name="Replace other crowd",
                        description="Replace a crowd of other heads or options in the folder")
    show: BoolProperty(name="Import when done", default=True)


class CrowdfaceFace(bpy.types.PropertyGroup):
    """A face in the list; its name is the id."""
    chosen: BoolProperty(name="Choose")
    mark: EnumProperty(name="Mark", default='NONE', items=[
        ('NONE', "–", "No mark"),
        ('keep', "Keep", "The face has been checked"),
        ('reject', "Reject", "Draw another face"),
        ('older', "Older", "Make the face older"),
        ('younger', "Younger", "Make the face younger"),
        ('variant', "Variant", "Make a variant of another face in its place")])
    variant_of: StringProperty(name="Of", description="The face that this face becomes a variant of")
    distance: FloatProperty(name="Apart, mm", default=1.5, min=0.01, soft_max=5,
                            description="Distance from that face in mm")


class CrowdfaceBrowse(bpy.types.PropertyGroup):
    folder: StringProperty(name="Crowd", subtype='DIR_PATH', update=_open_crowd, description="A crowd's folder")
    faces: CollectionProperty(type=CrowdfaceFace)
    words: StringProperty(name="Search", options={'TEXTEDIT_UPDATE'},
                          description="Words in id, family, group, target, tags and attachments")
    sex: EnumProperty(name="Sex", items=_choices("sex", lambda crowd: crowd.sexes))
    age: EnumProperty(name="Age", items=_choices("age", lambda crowd: crowd.ages))
    tag: EnumProperty(name="Tag", items=_choices("tag", lambda crowd: crowd.tags))
    trait: EnumProperty(name="Trait", items=_choices("trait", lambda crowd: crowd.traits),
                        update=_choose_trait)
    low: FloatProperty(name="From")
    high: FloatProperty(name="To")
    page: IntProperty(name="Page", min=0)
    place: EnumProperty(name="Place", items=[
        ('CURSOR', "At the cursor", "One face at the 3D cursor, the others beside it"),
        ('GRID', "On a grid", "Rows of faces, from the 3D cursor on"),
        ('EMPTIES', "On selected empties", "Faces repeat if there are more empties than faces"),
        ('VERTICES', "On selected vertices", "Selected vertices of the active mesh; faces repeat"),
        ('INSTANCES', "For instancing", "A hidden collection for the node Collection Info in geometry nodes")])
    columns: IntProperty(name="Columns", default=6, min=1)
    spacing: FloatProperty(name="Spacing", default=0.3, min=0, subtype='DISTANCE')
    level: IntProperty(name="Level", default=0, min=0, max=8, description="Level of detail; 0 is the whole face")
    weld: BoolProperty(name="Weld seams", description="Merge vertices that GLB files split at texture seams; "
                       "vertices then have another order in each face")
    all_levels: BoolProperty(name="All levels", description="Import coarser levels too, each in a hidden collection")

    def path(self):
        return os.path.realpath(bpy.path.abspath(self.folder)) if self.folder else ""

    def filtered(self):
        """The list's items that pass the filters."""
        crowd = crowds.read(self.path())
        if not crowd:
            return []
        tags = [tag for tag in (self.sex, self.age, self.tag) if tag not in ("", ANY)]
        trait = self.trait if self.trait not in ("", ANY) else None
        ids = {face.id for face in crowd.filtered(self.words, tags, trait, self.low, self.high)}
        return [item for item in self.faces if item.name in ids]


class CrowdfaceWrap(bpy.types.PropertyGroup):
    scan: PointerProperty(name="Scan", type=bpy.types.Object, poll=lambda self, item: item.type == 'MESH')
    keep_size: BoolProperty(name="Scan size",
                            description="The head gets the size of the scan, not of the template")


class CrowdfaceState(bpy.types.PropertyGroup):
    generate: PointerProperty(type=CrowdfaceGenerate)
    browse: PointerProperty(type=CrowdfaceBrowse)
    wrap: PointerProperty(type=CrowdfaceWrap)


CLASSES = (CrowdfacePreferences, CrowdfaceGenerate, CrowdfaceFace, CrowdfaceBrowse, CrowdfaceWrap, CrowdfaceState)


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    bpy.types.Scene.crowdface = PointerProperty(type=CrowdfaceState)
    bpy.types.WindowManager.crowdface_progress = FloatProperty(
        subtype='PERCENTAGE', min=0, max=100, precision=0,
        get=lambda _: 100 * RunsJob.current.fraction if RunsJob.current else 0, description="Progress of the job")


def unregister():
    del bpy.types.WindowManager.crowdface_progress
    del bpy.types.Scene.crowdface
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
