# SPDX-License-Identifier: Apache-2.0
from pathlib import Path
from typing import Any, Callable, Dict, List, Mapping, Optional, Sequence, Tuple

import numpy.typing as npt

from .arrays import Indices, Numbers, Positions

Progress = Optional[Callable[[str, int, int], Any]]

__version__: str

def set_threads(threads: int) -> None:
    """Limits the number of threads of all calls; 0: no limit."""

def set_log_level(level: str) -> None:
    """Which messages go to standard error: "quiet" (warnings, the default), "normal", "verbose"."""

def cache_directory() -> Path:
    """The default folder of prepared heads."""

class Heads:
    """Heads of one topology.

    positions: one array (V, 3) per head, or an array (H, V, 3). faces: an array (F, k) of vertex
    indices from 0, or (corners, offsets), or a list of lists. uvs: (T, 2). uv_faces: indices of rows
    of `uvs`, in the form of `faces`; -1: none. uv_faces=None: the same indices as `faces`. names: default head_00, head_01, …
    """

    def __init__(
        self,
        positions: Any,
        faces: Any,
        *,
        uvs: Optional[npt.ArrayLike] = None,
        uv_faces: Any = None,
        names: Optional[Sequence[str]] = None,
    ) -> None: ...
    def __len__(self) -> int: ...
    @property
    def names(self) -> List[str]: ...
    @property
    def vertex_count(self) -> int: ...
    def positions(self, head: int) -> Positions:
        """(V, 3), a view."""
    @property
    def uvs(self) -> Numbers:
        """(T, 2), a view; no rows without texture coordinates."""
    @property
    def corners(self) -> Indices:
        """(C,), a view: the vertex indices of all polygons."""
    @property
    def uv_corners(self) -> Indices:
        """(C,) or (0,), a view: indices of rows of `uvs`; 4294967295: none."""
    @property
    def offsets(self) -> Indices:
        """(F + 1,), a view: polygon f has the corners from offsets[f] up to offsets[f + 1]."""
    @property
    def faces(self) -> Optional[Indices]:
        """(F, k), a view, if all polygons have k corners; otherwise None."""
    def mean(self) -> Positions:
        """The mean head, (V, 3)."""
    def save(self, folder: Path) -> None:
        """Writes an OBJ file for each head, in single precision."""

def read_heads(files: Sequence[Path], progress: Progress) -> Heads: ...

class Smoothing:
    def __init__(self, heads: Heads, boundary: str, operator: str) -> None: ...
    def smooth(self, positions: npt.ArrayLike, iterations: Sequence[int]) -> List[Positions]: ...
    def blend(
        self, recipe: str, regions: Sequence[str], masks: Optional[npt.ArrayLike]
    ) -> Positions: ...

def distances(
    heads: Heads, faces: Sequence[Any], area: str, front: str, unit: str
) -> Numbers: ...

class Source:
    def __init__(
        self,
        file: Path,
        text: Optional[str],
        set: Sequence[str],
        out: Optional[str],
        review: Sequence[str],
        without_reviews: bool,
    ) -> None: ...

class Job:
    def __init__(self, source: Source, cache: Path, progress: Progress) -> None: ...
    @property
    def heads(self) -> Heads: ...
    @property
    def regions(self) -> List[str]: ...
    @property
    def masks(self) -> Numbers: ...
    @property
    def warnings(self) -> List[str]: ...
    @property
    def shape_names(self) -> List[str]: ...
    def cast(self, progress: Progress) -> List[str]: ...
    def blend(self, recipes: Sequence[str], progress: Progress) -> List[Positions]: ...
    def shapes(
        self, recipe: str, positions: npt.ArrayLike
    ) -> Dict[str, Tuple[Indices, Positions]]: ...
    def attachments(self, recipe: str, positions: npt.ArrayLike) -> Dict[str, Positions]: ...

def run(
    source: Source,
    cache: Path,
    force: bool,
    shard: Tuple[int, int],
    memory: int,
    only_plan: bool,
    progress: Progress,
) -> Path: ...
def wrap(
    texts: Mapping[str, str],
    picture: bool,
    estimate: bool,
    delight: bool,
    strict: bool,
    progress: Progress,
) -> None: ...
def gather(folder: Path, cache: Path, progress: Progress) -> None: ...
def verify(folder: Path) -> Dict[str, Any]: ...
