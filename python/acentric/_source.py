"""Walks that are read by ranges of bytes from wherever they are."""
from __future__ import annotations

import ctypes
import os
from collections.abc import Callable
from typing import Any, BinaryIO, Protocol, Union, runtime_checkable

from . import _capi as c


@runtime_checkable
class Ranges(Protocol):
    """A walk file behind HTTP range requests, within an archive, ..."""

    def size(self) -> int:
        """All its bytes."""
        ...

    def read_at(self, offset: int, count: int) -> bytes:
        """`count` bytes (any object with a buffer) from `offset` on: all of them, or an exception."""
        ...


#: The folder of a bundle or a walk file by its name, or where a walk file is read from.
Openable = Union[str, "os.PathLike[str]", Ranges, BinaryIO]


class _FileRanges:
    """Of a binary file that seeks, such as those of io and fsspec."""

    def __init__(self, file: BinaryIO):
        self._file = file

    def size(self) -> int:
        return self._file.seek(0, 2)

    def read_at(self, offset: int, count: int) -> bytes:
        self._file.seek(offset)
        return self._file.read(count)


class Source:
    """The functions of a source that C calls. What it raises is kept in `failure`, and not thrown across."""

    def __init__(self, given: Any):
        if isinstance(given, Ranges):
            self._ranges = given
        elif hasattr(given, "seek") and hasattr(given, "read"):
            self._ranges = _FileRanges(given)
        else:
            raise TypeError(f"a walk is a folder, a file, or an object with size() and read_at(offset, count), "
                            f"not {type(given).__name__}")
        self.failure: BaseException | None = None
        self.functions = c.Ranges(None, c.SizeFunction(self._size), c.ReadFunction(self._read))

    def _answer(self, body: Callable[[], None]) -> int:
        try:
            body()
            return c.OK
        except FileNotFoundError as failure:
            self.failure = failure
            return c.ERROR_NOT_FOUND
        except BaseException as failure:  # an interrupt too: it is raised again once C has returned
            self.failure = failure
            return c.ERROR_UNREADABLE

    def _size(self, _user: int | None, into: Any) -> int:
        def body() -> None:
            size = self._ranges.size()
            if not 0 <= size < 2**63:
                raise ValueError(f"size() gave {size}")
            into[0] = size
        return self._answer(body)

    def _read(self, _user: int | None, offset: int, into: int, count: int) -> int:
        def body() -> None:
            data = memoryview(self._ranges.read_at(offset, count)).cast("B")
            if len(data) != count:
                raise EOFError(f"read_at({offset}, {count}) gave {len(data)} bytes")
            memoryview((ctypes.c_uint8 * count).from_address(into)).cast("B")[:] = data
        return self._answer(body)
