# SPDX-License-Identifier: Apache-2.0
"""Crowds of new faces in Blender. The add-on drives the installed program `crowdface` (docs/blender.md)."""

bl_info = {
    "name": "crowdface",
    "author": "The crowdface authors",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "3D View > Sidebar > crowdface",
    "description": "Makes crowds of new faces from heads that share one topology",
    "category": "Mesh",
}

from . import browse, generate, panels, state, wrap  # noqa: E402 (Blender reads bl_info first)

MODULES = (state, generate, browse, wrap, panels)


def register():
    for module in MODULES:
        module.register()


def unregister():
    for module in reversed(MODULES):
        module.unregister()
