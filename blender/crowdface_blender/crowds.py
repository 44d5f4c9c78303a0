# SPDX-License-Identifier: Apache-2.0
"""Reads a crowd's folder (docs/crowd-directory.md). Needs no Blender."""
import csv
import json
import os
from collections import namedtuple

Face = namedtuple("Face", "id tags words row")

_read = {}  # folder: (time of crowd.csv, Crowd)


class Crowd:
    def __init__(self, folder):
        self.folder = folder
        with open(os.path.join(folder, "plan.jsonl"), encoding="utf-8") as plan:
            first = plan.readline()
        self.traits = list(json.loads(first).get("traits", {})) if first else []
        with open(os.path.join(folder, "crowd.csv"), encoding="utf-8", newline="") as table:
            self.faces = [_face(row) for row in csv.DictReader(table)]
        tags = {tag for face in self.faces for tag in face.tags}
        self.sexes = [tag for tag in ("female", "male") if tag in tags]
        self.ages = [tag for tag in ("young", "adult", "old") if tag in tags]
        self.tags = sorted(tags.difference(self.sexes, self.ages))
        meshes = os.path.join(folder, "meshes")
        self._folders = [meshes] + [os.path.join(meshes, name) for name in _numbers(meshes)]
        renders = os.path.join(folder, "renders")
        self._pictures = [renders] + [os.path.join(renders, name) for name in _numbers(renders)]

    def mesh(self, face, level=0):
        """The GLB file of a face, or None."""
        return _first(self._folders, face + (f"+LOD{level}" if level else "") + ".glb")

    def levels(self):
        """The number of levels of detail."""
        level = 0
        while self.faces and self.mesh(self.faces[0].id, level + 1):
            level += 1
        return level

    def formats(self):
        """The mesh formats of the first face, as `output.meshes` names them."""
        endings = {"obj": ".obj", "ply": ".ply", "glb": ".glb", "usd": ".usda", "points": ".npy"}
        return [name for name, ending in endings.items()
                if self.faces and _first(self._folders, self.faces[0].id + ending)]

    def picture(self, face):
        return _first(self._pictures, face + ".png")

    def filtered(self, words="", tags=(), trait=None, low=None, high=None):
        """The faces that pass all filters. Traits are compared with a tolerance of 1e-4, because `low` and `high` have single
        precision in Blender, and the table has four decimals."""
        wanted = words.lower().split()
        return [face for face in self.faces
                if all(word in face.words for word in wanted) and all(tag in face.tags for tag in tags)
                and (not trait or low - 1e-4 <= float(face.row[trait] or "nan") <= high + 1e-4)]

    def range_of(self, trait):
        values = [float(face.row[trait]) for face in self.faces if face.row[trait]]
        return (min(values), max(values)) if values else (0.0, 0.0)


def _face(row):
    tags = tuple(filter(None, (row.get("tags") or "").split(";")))
    parts = [row["id"], row["family"], row["target"], row.get("group"), row.get("attachments"), row.get("hair"), *tags]
    return Face(row["id"], tags, " ".join(filter(None, parts)).lower(), row)


def _numbers(folder):
    return sorted(name for name in os.listdir(folder) if name.isdigit()) if os.path.isdir(folder) else []


def _first(folders, name):
    return next((file for file in (os.path.join(folder, name) for folder in folders) if os.path.isfile(file)), None)


def read(folder):
    """The crowd in a folder, or None if the folder has no finished plan. Reads the folder again if crowd.csv changed."""
    try:
        changed = os.stat(os.path.join(folder, "crowd.csv")).st_mtime_ns
        if _read.get(folder, (0,))[0] != changed:
            _read[folder] = (changed, Crowd(folder))
    except OSError:
        return None
    return _read[folder][1]


def forget(folder):
    """Makes the next `read` read the folder again. Needed if files changed, but crowd.csv did not."""
    _read.pop(folder, None)
