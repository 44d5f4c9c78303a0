# SPDX-License-Identifier: Apache-2.0
"""Finished crowds as plain Python objects, read from the files of their folder."""

import csv
import json
import os
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Dict, Iterable, Iterator, List, Mapping, Optional, Tuple, Union

from . import _crowdface
from .arrays import Positions
from .errors import MissingInput, UsageError

PathLike = Union[str, "os.PathLike[str]"]


@dataclass(frozen=True)
class Face:
    """A face of a crowd. docs/crowd-directory.md explains the fields of recipe and columns."""

    id: str
    recipe: Dict[str, Any]
    """The face's line of plan.jsonl."""
    columns: Dict[str, Any]
    """The face's line of crowd.csv: numbers as float or int, empty cells as None."""
    files: Tuple[Path, ...] = field(default=())
    """All finished files of the face: meshes, shapes, textures, picture, …"""

    @property
    def index(self) -> Optional[int]:
        """Number of the sampled face, from 1; None for recipes and families."""
        index: Optional[int] = self.recipe["index"]
        return index

    @property
    def target(self) -> str:
        """Name of the head that the face is built on."""
        return str(self.recipe["target"])

    @property
    def family(self) -> Optional[str]:
        return self.recipe.get("family")

    @property
    def group(self) -> Optional[str]:
        return self.recipe.get("group")

    @property
    def tags(self) -> Tuple[str, ...]:
        """Tags of the head whose tags the face has."""
        tags = self.columns.get("tags")
        return tuple(str(tags).split(";")) if tags else ()

    @property
    def sex(self) -> Optional[str]:
        return self.columns.get("sex")

    @property
    def age(self) -> Any:
        """The column `age` of crowd.csv."""
        return self.columns.get("age")

    @property
    def changed(self) -> Tuple[str, ...]:
        """Who changed which keys of the face, such as "config: age" or "review 2: hair"."""
        return tuple(self.recipe.get("changed", ()))

    @property
    def traits(self) -> Dict[str, float]:
        """Measurements that the config names, in mm, degrees or as ratios."""
        return dict(self.recipe.get("traits", {}))

    @property
    def attachments(self) -> Tuple[str, ...]:
        """Names of the attachments that the face wears."""
        return tuple(self.recipe.get("attachments", ()))

    def mesh(self, extension: str = ".obj") -> Path:
        """The face's mesh file: `ID.obj`, `.ply`, `.glb`, `.npy` or `.usda`."""
        for file in self.files:
            if file.name == self.id + extension:
                return file
        raise MissingInput(f"{self.id}: no finished file {self.id}{extension}")

    def picture(self) -> Path:
        """The face's picture, `renders/ID.png`."""
        return self.mesh(".png")

    def positions(self) -> Positions:
        """Vertex positions (V, 3), float64, in the unit of the heads, from the first mesh file."""
        for extension in (".npy", ".obj", ".ply", ".usda"):
            if any(file.name == self.id + extension for file in self.files):
                return _crowdface.read_heads([self.mesh(extension)], None).positions(0)
        raise MissingInput(f"{self.id}: no finished mesh that keeps the order of the vertices")


def _cell(text: str) -> Any:
    if text == "":
        return None
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            pass
    return text


def _json_lines(path: Path) -> Iterator[Dict[str, Any]]:
    with open(path, encoding="utf-8") as file:
        for line in file:
            try:
                yield json.loads(line)
            except ValueError:  # a run is writing this line
                continue


class Crowd(Mapping[str, Face]):
    """A crowd in a folder: a mapping from ids to faces, in the order of the plan.

    The folder is read once; `reload` reads it again.
    """

    def __init__(self, folder: PathLike) -> None:
        self.folder = Path(folder)
        self.reload()

    def reload(self) -> None:
        """Reads the folder. Raises MissingInput if it holds no crowd."""
        plan = self.folder / "plan.jsonl"
        if not plan.exists():
            raise MissingInput(f"{plan}: expected the plan of a crowd, found no such file")
        columns: Dict[str, Dict[str, Any]] = {}
        if (self.folder / "crowd.csv").exists():
            with open(self.folder / "crowd.csv", encoding="utf-8", newline="") as file:
                for row in csv.DictReader(file):
                    columns[row["id"]] = {key: _cell(cell) for key, cell in row.items()}
                    columns[row["id"]]["id"] = row["id"]
        files: Dict[str, Tuple[Path, ...]] = {}
        for ledger in sorted(self.folder.glob("ledger*.jsonl")):
            for line in _json_lines(ledger):
                kind, _, face = str(line.get("item", "")).partition("/")
                if kind == "faces":
                    files[face] = tuple(self.folder / entry["file"] for entry in line["files"])
        self._faces = {
            line["id"]: Face(line["id"], line, columns.get(line["id"], {}), files.get(line["id"], ()))
            for line in _json_lines(plan)
        }

    def __getitem__(self, face: str) -> Face:
        return self._faces[face]

    def __iter__(self) -> Iterator[str]:
        return iter(self._faces)

    def __len__(self) -> int:
        return len(self._faces)

    def __repr__(self) -> str:
        return f"<crowdface.Crowd {str(self.folder)!r}: {len(self)} faces>"

    def table(self) -> List[Dict[str, Any]]:
        """One dict per face: the columns of crowd.csv. `pandas.DataFrame(crowd.table())` takes it."""
        return [dict(face.columns) or {"id": face.id} for face in self.values()]

    def report(self) -> Dict[str, Any]:
        """The content of report.json. Raises MissingInput if the crowd is not finished."""
        path = self.folder / "report.json"
        if not path.exists():
            raise MissingInput(f"{path}: expected a finished crowd, found no report")
        return dict(json.loads(path.read_text(encoding="utf-8")))

    def verify(self) -> Dict[str, Any]:
        """Compares all files with the ledger: `files` (a count), lists `missing`, `altered`,
        `unfinished`, `remarks`."""
        return _crowdface.verify(self.folder)

    def write_review(
        self,
        file: PathLike,
        *,
        keep: Iterable[str] = (),
        reject: Iterable[str] = (),
        lock: Optional[Mapping[str, Iterable[str]]] = None,
        notes: Optional[Mapping[str, str]] = None,
        changes: Optional[Mapping[str, Mapping[str, Any]]] = None,
    ) -> Path:
        """Writes a review file for this crowd.

        keep, reject: ids of faces. lock: for rejected faces, by id, the regions that stay.
        notes: a remark for a rejected face, by id. changes: by id, the keys of `changes` in
        docs/config.md, such as {"market_0013": {"age": "older"}}. Pass the file to `run_round`.
        """
        marks: Dict[str, Any] = {face: "keep" for face in keep}
        marks.update({face: "reject" for face in reject})
        for face, regions in (lock or {}).items():
            marks[face] = {"lock": list(regions)}
        for face, note in (notes or {}).items():
            mark = marks.get(face)
            marks[face] = {**(mark if isinstance(mark, dict) else {"lock": []}), "note": note}
        unknown = [face for face in [*marks, *(changes or {})] if face not in self._faces]
        if unknown:
            raise UsageError(f"{self.folder}: the crowd has no faces {', '.join(unknown)}")
        sampled = sum(face.index is not None for face in self.values())
        review: Dict[str, Any] = {"schema": 1, "count": sampled, "faces": marks}
        if changes:
            review["changes"] = changes
        path = Path(file)
        path.write_text(json.dumps(review, ensure_ascii=False, indent=1) + "\n", encoding="utf-8")
        return path

    def run_round(self, review: PathLike, **options: Any) -> "Crowd":
        """Redraws the rejected faces of a review, applies its changes and makes the files of these
        faces; returns this crowd.

        options: the keyword arguments of `generate`, such as `progress`.
        """
        from . import generate

        generate(self.folder / "config.yaml", review=[review], **options)
        self.reload()
        return self
