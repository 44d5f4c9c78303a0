# SPDX-License-Identifier: Apache-2.0
"""The panels in the sidebar of the 3D view."""
import bpy

from . import browse, crowds
from .program import RunsJob


class Panel(bpy.types.Panel):
    bl_space_type = 'VIEW_3D'
    bl_region_type = 'UI'
    bl_category = "crowdface"

    def column(self):
        """A column with names beside its values."""
        column = self.layout.column()
        column.use_property_split = True
        column.use_property_decorate = False
        return column


def draw_job(layout):
    """The running job, if there is one: a bar and Cancel."""
    job = RunsJob.current
    if not job:
        return
    box = layout.box()
    if hasattr(box, "progress"):  # Blender 4.0
        box.progress(factor=job.fraction, text=f"{round(100 * job.fraction)} %")
    else:
        box.prop(bpy.context.window_manager, "crowdface_progress", text=job.title, slider=True)
    box.label(text=job.message)
    box.operator("crowdface.cancel", icon='CANCEL')


class CROWDFACE_PT_generate(Panel):
    bl_label = "Generate"

    def draw(self, context):
        options = context.scene.crowdface.generate
        draw_job(self.layout)
        column = self.column()
        for name in ("heads", "folder", "units", "count", "seed", "variety", "distance", "families"):
            column.prop(options, name)
        if options.families:
            column.prop(options, "members")
        for name in ("expressions", "attachments", "lods", "traits"):
            column.prop(options, name)
        column = self.layout.column(align=True)
        for name in ("groups", "align", "force", "show"):
            column.prop(options, name)
        row = self.layout.row()
        row.operator("crowdface.check")
        row.operator("crowdface.generate", icon='COMMUNITY')


class CROWDFACE_PT_browse(Panel):
    bl_label = "Browse"

    def draw(self, context):
        state = context.scene.crowdface.browse
        self.column().prop(state, "folder")
        crowd = crowds.read(state.path())
        if not crowd:
            return
        self._draw_filters(state, crowd)
        self._draw_faces(context, state, crowd, state.filtered())
        column = self.column()
        column.prop(state, "place")
        if state.place in ('CURSOR', 'GRID'):
            column.prop(state, "spacing")
        if state.place == 'GRID':
            column.prop(state, "columns")
        if crowd.levels():
            column.prop(state, "level")
            column.prop(state, "all_levels")
        column.prop(state, "weld")
        if "glb" in crowd.formats():
            self.layout.operator("crowdface.import_faces", icon='IMPORT')
        else:
            self.layout.operator("crowdface.add_glb")

    def _draw_filters(self, state, crowd):
        self.layout.prop(state, "words", text="", icon='VIEWZOOM')
        column = self.column()
        for name in ("sex", "age", "tag", "trait"):
            column.prop(state, name)
        if state.trait in crowd.traits:
            row = self.layout.row(align=True)
            row.prop(state, "low")
            row.prop(state, "high")

    def _draw_faces(self, context, state, crowd, found):
        first = min(state.page, max(0, (len(found) - 1) // browse.PAGE)) * browse.PAGE
        columns = max(1, int(context.region.width / context.preferences.system.ui_scale / 100))
        grid = self.layout.grid_flow(columns=columns, even_columns=True, even_rows=True, align=True, row_major=True)
        for item in found[first:first + browse.PAGE]:
            cell = grid.column(align=True)
            cell.template_icon(icon_value=browse.picture(crowd, item.name), scale=5)
            cell.prop(item, "chosen", text=item.name, toggle=True)
            cell.prop(item, "mark", text="")
        row = self.layout.row(align=True)
        row.operator("crowdface.page", text="", icon='TRIA_LEFT').by = -1
        row.label(text=f"{first + 1}–{min(first + browse.PAGE, len(found))} of {len(found)}" if found else "No face")
        row.operator("crowdface.page", text="", icon='TRIA_RIGHT').by = 1
        row = self.layout.row(align=True)
        row.operator("crowdface.choose", text="Choose All").choose = True
        row.operator("crowdface.choose", text="None").choose = False


class CROWDFACE_PT_review(Panel):
    bl_label = "Review"

    def draw(self, context):
        state = context.scene.crowdface.browse
        marked = [item for item in state.faces if item.mark != 'NONE']
        self.layout.label(text=f"{len(marked)} faces marked")
        for item in marked:
            self.layout.label(text=f"{item.name}: {item.mark}")
            if item.mark == 'variant':
                column = self.layout.column(align=True)
                column.prop_search(item, "variant_of", state, "faces", text="")
                column.prop(item, "distance")
        self.layout.operator("crowdface.review", icon='FILE_REFRESH')


class CROWDFACE_PT_wrap(Panel):
    bl_label = "Wrap"
    bl_options = {'DEFAULT_CLOSED'}

    def draw(self, context):
        options = context.scene.crowdface.wrap
        column = self.column()
        active = context.active_object
        column.label(text=f"Template: {active.name if active and active.type == 'MESH' else 'no active mesh'}")
        column.prop(options, "scan")
        column.prop(options, "keep_size")
        self.layout.operator("crowdface.wrap", icon='MOD_SHRINKWRAP')


CLASSES = (CROWDFACE_PT_generate, CROWDFACE_PT_browse, CROWDFACE_PT_review, CROWDFACE_PT_wrap)


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister():
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
