# SPDX-License-Identifier: Apache-2.0
"""Crowds of believable faces from a handful of scanned heads.

Positions are arrays (V, 3) of float64, C-contiguous, in the unit of the heads; V is the number of
vertices. Arrays that belong to an object of this module are views without a copy, and not
writable. Long calls release the GIL, stop at Ctrl-C, and raise the exceptions of
`crowdface.errors`. A `progress` function is called about ten times a second with the name of the
stage, the number of finished steps and the number of all steps; if it returns False or raises an
exception, the work is cancelled.
"""

import json
import os
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Callable, Dict, Iterable, List, Mapping, Optional, Sequence, Tuple, Union

# The page of the gallery, where this package brings its own (pip install).
if (Path(__file__).parent / "gallery").exists():
    os.environ.setdefault("CROWDFACE_GALLERY", str(Path(__file__).parent / "gallery"))

import numpy as np

from . import _crowdface
from ._crowdface import Heads, __version__, cache_directory, set_log_level, set_threads
from .arrays import Indices, Numbers, Positions
from .crowd import Crowd, Face, PathLike
from .errors import (
    BrokenPrecondition,
    CannotCreate,
    Error,
    Interrupted,
    InvalidInput,
    IoError,
    MissingInput,
    Problem,
    Unsatisfiable,
    UsageError,
)

Recipe = Dict[str, Any]
Config = Union[PathLike, Mapping[str, Any]]
Progress = Callable[[str, int, int], Any]

__all__ = [
    "BrokenPrecondition", "CannotCreate", "Crowd", "Error", "Face", "Heads", "Interrupted",
    "InvalidInput", "IoError", "Job", "MissingInput", "Problem", "Smoothing", "Unsatisfiable",
    "UsageError", "Wrapped", "__version__", "cache_directory", "distances", "gather", "generate",
    "open_crowd", "plan", "read_heads", "set_log_level", "set_threads",
    "wrap",
]  # fmt: skip


def read_heads(
    files: Union[PathLike, Iterable[PathLike]], *, progress: Optional[Progress] = None
) -> Heads:
    """Reads heads of one topology: files of any format that the program reads, or folders of them.

    Raises an error that names every file that cannot be read or has another topology.
    """
    paths = [files] if isinstance(files, (str, os.PathLike)) else list(files)
    return _crowdface.read_heads([Path(path) for path in paths], progress)


def _line_of(recipe: Mapping[str, Any]) -> str:
    """A line of plan.jsonl. Adds the keys that a recipe written by hand may omit."""
    regions = {
        name: {"position": None, "smoothness": 0, "extrapolation": 1, **region}
        for name, region in recipe.get("regions", {}).items()
    }
    line = {"id": "face", "index": None, "family": None, "attempt": 0, "settings": "", **recipe}
    return json.dumps({**line, "regions": regions})


class Smoothing:
    """Smooths and blends meshes of one topology, with exact levels.

    boundary: "fixed" or "free"; operator: "umbrella" or "lazy", as in the config.
    """

    def __init__(self, heads: Heads, *, boundary: str = "fixed", operator: str = "umbrella") -> None:
        self._smoothing = _crowdface.Smoothing(heads, boundary, operator)

    def smooth(self, positions: Any, iterations: int) -> Positions:
        """Positions (V, 3) after this number of smoothing iterations."""
        return self._smoothing.smooth(positions, [iterations])[0]

    def smooth_to_levels(self, positions: Any, iterations: Sequence[int]) -> List[Positions]:
        """Positions (V, 3) after each of these numbers of iterations, in one pass."""
        return self._smoothing.smooth(positions, list(iterations))

    def blend(self, recipe: Mapping[str, Any], masks: Any = None) -> Positions:
        """The skin of a recipe's face, (V, 3), in the unit of the heads.

        recipe: `target` and `regions`, as in a plan; a region needs `weights` (by name of the head,
        with the sum 1) and `iterations`, and may have `extrapolation` (1), `position`, `bands`.
        masks: (V, R), not negative, each row with the sum 1; R is the recipe's number of regions.
        None: one region.
        """
        return self._smoothing.blend(_line_of(recipe), list(recipe.get("regions", {})), masks)


def distances(
    heads: Heads,
    faces: Optional[Sequence[Any]] = None,
    *,
    area: str = "front",
    front: str = "+Z",
    unit: str = "cm",
) -> Numbers:
    """Distances between faces of the heads' topology, (N, N), in mm.

    The distance of two faces is the root mean square over the area of the face, after the best
    rigid motion. faces: N arrays (V, 3); None: the heads. area: "front" or "skin". front: the axis
    along which heads look. unit: unit of the positions.
    """
    of = [heads.positions(i) for i in range(len(heads))] if faces is None else list(faces)
    return _crowdface.distances(heads, of, area, front, unit)


def _source(
    config: Config,
    settings: Optional[Mapping[str, Any]],
    out: Optional[PathLike],
    review: Iterable[PathLike] = (),
    without_reviews: bool = False,
) -> _crowdface.Source:
    return _crowdface.Source(
        Path("config" if isinstance(config, Mapping) else config),
        json.dumps(config) if isinstance(config, Mapping) else None,
        [f"{key}={value if isinstance(value, str) else json.dumps(value)}"
         for key, value in (settings or {}).items()],
        None if out is None else os.fspath(out),
        [os.fspath(file) for file in review],
        without_reviews,
    )  # fmt: skip


def _cache(cache: Optional[PathLike]) -> Path:
    return cache_directory() if cache is None else Path(cache)


def _with(config: Config, section: str, key: str, path: Path) -> Config:
    """The config with `key` of `section` set to `path`, under which the job finds arrays."""
    if not isinstance(config, Mapping):
        raise UsageError("heads, masks: expected the config as a dict, found a file")
    return {**config, section: {**config.get(section, {}), key: str(path)}}


class Job:
    """A config with its heads and masks in memory: casts recipes and blends faces as arrays.

    config: a file, or the same keys as a dict; relative paths in a dict begin at the working
    directory. settings: changes of values, such as {"crowd.count": 20}. heads, masks: arrays that
    replace the keys `faces.directory` and `regions.mask` of a dict; masks are (V, R), one column for
    each name of `regions.names`. Positions are rounded to single precision, as in mesh files.
    """

    def __init__(
        self,
        config: Config,
        heads: Optional[Heads] = None,
        masks: Any = None,
        *,
        settings: Optional[Mapping[str, Any]] = None,
        cache: Optional[PathLike] = None,
        progress: Optional[Progress] = None,
    ) -> None:
        with tempfile.TemporaryDirectory(prefix="crowdface-") as folder:
            if heads is not None:
                heads.save(Path(folder) / "heads")
                config = _with(config, "faces", "directory", Path(folder) / "heads")
            if masks is not None:
                np.save(Path(folder) / "masks.npy", np.asarray(masks, dtype=np.float64))
                config = _with(config, "regions", "mask", Path(folder) / "masks.npy")
            self._job = _crowdface.Job(_source(config, settings, None), _cache(cache), progress)

    @property
    def heads(self) -> Heads:
        """The heads as the job uses them, aligned if the config asks for it."""
        return self._job.heads

    @property
    def regions(self) -> List[str]:
        """Names of the regions; ["all"] without regions."""
        return self._job.regions

    @property
    def masks(self) -> Numbers:
        """Weights of the regions, (V, R); each row has the sum 1."""
        return self._job.masks

    @property
    def shape_names(self) -> List[str]:
        """Names of the shapes (expressions)."""
        return self._job.shape_names

    @property
    def warnings(self) -> List[str]:
        """Warnings about heads and masks."""
        return self._job.warnings

    def cast(self, *, progress: Optional[Progress] = None) -> List[Recipe]:
        """Casts the crowd: one recipe per face, as in plan.jsonl.

        Raises Unsatisfiable if the constraints cannot be met.
        """
        return [json.loads(line) for line in self._job.cast(progress)]

    def blend(self, recipe: Mapping[str, Any], *, progress: Optional[Progress] = None) -> Positions:
        """The face of a recipe, (V, 3), in the unit of the heads; parts follow the skin."""
        return self.blend_all([recipe], progress=progress)[0]

    def blend_all(
        self, recipes: Iterable[Mapping[str, Any]], *, progress: Optional[Progress] = None
    ) -> List[Positions]:
        """The faces of several recipes, each (V, 3): faster than one by one, and the same bits."""
        return self._job.blend([_line_of(recipe) for recipe in recipes], progress)

    def shapes(
        self, recipe: Mapping[str, Any], positions: Any
    ) -> Dict[str, Tuple[Indices, Positions]]:
        """The shapes of a face by name: indices of the moved vertices (M,), displacements (M, 3)."""
        return self._job.shapes(_line_of(recipe), positions)

    def attachments(self, recipe: Mapping[str, Any], positions: Any) -> Dict[str, Positions]:
        """The attachments of a face by name: positions (W, 3) of the W vertices of the item's mesh."""
        return self._job.attachments(_line_of(recipe), positions)


def _run(
    config: Config,
    settings: Optional[Mapping[str, Any]],
    out: Optional[PathLike],
    review: Iterable[PathLike],
    without_reviews: bool,
    force: bool,
    cache: Optional[PathLike],
    progress: Optional[Progress],
    *,
    only_plan: bool,
    shard: Tuple[int, int] = (1, 1),
    memory: int = 0,
) -> Crowd:
    source = _source(config, settings, out, review, without_reviews)
    folder = _crowdface.run(
        source, _cache(cache), force, shard, memory, only_plan, progress
    )
    return Crowd(folder)


def plan(
    config: Config,
    *,
    settings: Optional[Mapping[str, Any]] = None,
    out: Optional[PathLike] = None,
    review: Iterable[PathLike] = (),
    without_reviews: bool = False,
    force: bool = False,
    cache: Optional[PathLike] = None,
    progress: Optional[Progress] = None,
) -> Crowd:
    """Casts a crowd and writes its plan, but no meshes. See `generate`."""
    return _run(config, settings, out, review, without_reviews, force, cache, progress, only_plan=True)


def generate(
    config: Config,
    *,
    settings: Optional[Mapping[str, Any]] = None,
    out: Optional[PathLike] = None,
    review: Iterable[PathLike] = (),
    without_reviews: bool = False,
    force: bool = False,
    shard: Tuple[int, int] = (1, 1),
    memory: int = 0,
    cache: Optional[PathLike] = None,
    progress: Optional[Progress] = None,
) -> Crowd:
    """Makes a crowd, or continues it: what `crowdface generate` does, with the same bytes.

    config: a file, or the same keys as a dict; relative paths in a dict begin at the working
    directory. settings: changes of values, such as {"crowd.count": 20}. out: the crowd's folder.
    review: review files. force: replace another config's crowd. shard: (number from 1, count).
    memory: limit in bytes; 0: three quarters of the machine's memory.
    """
    return _run(
        config, settings, out, review, without_reviews, force, cache, progress,
        only_plan=False, shard=shard, memory=memory,
    )  # fmt: skip


@dataclass(frozen=True)
class Wrapped:
    """A template that was fitted to a scan."""

    positions: Positions
    """(V, 3), vertices of the template; in the scan's size if `scan_units` was given."""
    report: Dict[str, Any]
    """The report of `crowdface wrap`: distances to the scan and landmarks, in mm; warnings."""


def wrap(
    template: Union[PathLike, Heads],
    scan: Union[PathLike, Heads],
    *,
    out: Optional[PathLike] = None,
    landmarks: Union[PathLike, Mapping[str, Any], None] = None,
    texture: int = 0,
    delight: bool = False,
    picture: bool = False,
    estimate: bool = False,
    strict: bool = False,
    progress: Optional[Progress] = None,
    **options: str,
) -> Wrapped:
    """Fits a template to a scan: what `crowdface wrap` does.

    template, scan: a mesh file, or arrays as Heads with one head. out: an OBJ file to write, with
    its report beside it. landmarks: a file, or the content of a YAML file as a dict:
    {"template": {name: vertex}, "scan": {name: [x, y, z]}}; "none": also detect none. texture:
    texels per side of the textures that are baked beside `out` from the scan's colours; 0: none.
    delight: remove the light from these colours. picture: also write a picture beside `out`.
    estimate: also estimate the error of correspondence. strict: raise InvalidInput if features of
    the face are doubtful, and write no head. options: template_landmarks, model,
    ignore, units, scan_units, up, front, scan_up, scan_front, as on the command line.
    """
    if texture and out is None:
        raise UsageError("texture: expected out=FILE.obj, beside which the textures are written")
    with tempfile.TemporaryDirectory(prefix="crowdface-") as folder:

        def file_of(mesh: Union[PathLike, Heads], name: str) -> str:
            if not isinstance(mesh, Heads):
                return os.fspath(mesh)
            faces, has_uvs = (mesh.corners, mesh.offsets), len(mesh.uvs) > 0
            one = Heads(
                [mesh.positions(0)],
                faces,
                uvs=mesh.uvs if has_uvs else None,
                uv_faces=(mesh.uv_corners, mesh.offsets) if has_uvs else None,
                names=[name],
            )
            one.save(Path(folder))
            return os.path.join(folder, f"{name}.obj")

        if isinstance(landmarks, Mapping):
            text = json.dumps(landmarks)
            landmarks = Path(folder) / "landmarks.yaml"
            landmarks.write_text(text, encoding="utf-8")
        head = Path(folder, "head.obj") if out is None else Path(out)
        texts = {"template": file_of(template, "template"), "scan": file_of(scan, "scan")}
        if landmarks is not None:
            texts["landmarks"] = os.fspath(landmarks)
        if texture:
            texts["texture"] = str(texture)
        texts["out"] = str(head)
        _crowdface.wrap({**options, **texts}, picture, estimate, delight, strict, progress)
        report = json.loads(head.with_suffix(".wrap.json").read_text(encoding="utf-8"))
        return Wrapped(_crowdface.read_heads([head], None).positions(0), report)


def gather(
    folder: PathLike, *, cache: Optional[PathLike] = None, progress: Optional[Progress] = None
) -> Crowd:
    """Checks the faces of all shards and adds sheets and report."""
    _crowdface.gather(Path(folder), _cache(cache), progress)
    return Crowd(folder)


def open_crowd(folder: PathLike) -> Crowd:
    """Opens a planned or finished crowd. Needs neither heads nor masks."""
    return Crowd(folder)
