"""What the library refuses, as exceptions."""
from __future__ import annotations

import enum

from . import _capi as c


class Status(enum.IntEnum):
    """Why a call failed; acentric_runtime.h tells when."""

    ARGUMENT = c.ERROR_ARGUMENT
    NOT_FOUND = c.ERROR_NOT_FOUND
    UNREADABLE = c.ERROR_UNREADABLE
    MALFORMED = c.ERROR_MALFORMED
    UNSUPPORTED = c.ERROR_UNSUPPORTED
    MEMORY = c.ERROR_MEMORY
    OUTSIDE = c.ERROR_OUTSIDE
    NOT_LOADED = c.ERROR_NOT_LOADED
    INTERNAL = c.ERROR_INTERNAL


class Error(Exception):
    """A call failed: `status` says of which kind, `message` names the file, the place in it and the reason."""

    def __init__(self, status: Status, message: str):
        super().__init__(message)
        self.status = status
        self.message = message


class NotFound(Error):
    """There is no such file, or the camera was not baked."""


class Outside(Error):
    """The eye stands in no region: Walk.clamp moves a place into one."""


class OutOfMemory(Error):
    """What is loaded would take more than the memory limit, or the machine's memory: Walk.unload frees some."""


_CLASSES = {Status.NOT_FOUND: NotFound, Status.OUTSIDE: Outside, Status.MEMORY: OutOfMemory}


def error_of(code: int, message: str) -> Error:
    """The exception of a status that is not OK."""
    status = Status(code) if code in set(Status) else Status.INTERNAL
    if not message:
        message = c.library.acentric_status_name(code).decode()
    return _CLASSES.get(status, Error)(status, message)


def refused(message: str) -> Error:
    return Error(Status.ARGUMENT, message)
