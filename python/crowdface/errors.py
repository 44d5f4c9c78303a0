# SPDX-License-Identifier: Apache-2.0
"""The exceptions of crowdface: one class for each exit code of the program."""

import re
from dataclasses import dataclass
from typing import Dict, List, Optional, Type


@dataclass(frozen=True)
class Problem:
    """One message of an error, and the place that it names.

    Lines and columns count from 1. A message without a place has no file.
    """

    message: str
    file: Optional[str] = None
    line: Optional[int] = None
    column: Optional[int] = None


_PLACE = re.compile(r"(?P<file>[^\s:][^:]*):(?:(?P<line>\d+):(?:(?P<column>\d+):)?)? ")


def _problem(message: str) -> Problem:
    place = _PLACE.match(message)
    # A message without a line is "FILE: WHAT" only if the first word looks like a path.
    if not place or not (place["line"] or re.search(r"[/.\\]", place["file"])):
        return Problem(message)
    return Problem(
        message,
        place["file"],
        int(place["line"]) if place["line"] else None,
        int(place["column"]) if place["column"] else None,
    )


class Error(RuntimeError):
    """Base of all errors of crowdface.

    `code` is the exit code of the program, `problems` has one entry for each line of the message.
    `file`, `line` and `column` belong to the first problem.
    """

    code = 70

    def __init__(self, message: str) -> None:
        super().__init__(message)
        self.problems: List[Problem] = [_problem(line) for line in message.splitlines()]

    @property
    def _first(self) -> Problem:
        return self.problems[0] if self.problems else Problem("")

    @property
    def file(self) -> Optional[str]:
        return self._first.file

    @property
    def line(self) -> Optional[int]:
        return self._first.line

    @property
    def column(self) -> Optional[int]:
        return self._first.column


class Unsatisfiable(Error):
    """The constraints of a plan cannot be met."""

    code = 3


class UsageError(Error):
    """A config or an argument is wrong."""

    code = 64


class InvalidInput(Error):
    """The content of an input cannot be used."""

    code = 65


class MissingInput(Error):
    """An input file is missing or cannot be read."""

    code = 66


class BrokenPrecondition(Error):
    """A mistake in the calling program or in crowdface."""

    code = 70


class CannotCreate(Error):
    """An output file or folder cannot be created."""

    code = 73


class IoError(Error):
    """A read or write failed after it began."""

    code = 74


class Interrupted(Error):
    """The work was cancelled; the same call continues it."""

    code = 75


_CLASSES: Dict[int, Type[Error]] = {cls.code: cls for cls in Error.__subclasses__()}


def error_of(code: int, message: str) -> Error:
    """The exception for an exit code and a message. The extension module calls this function."""
    return _CLASSES.get(code, Error)(message)
