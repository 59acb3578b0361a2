"""Captures, near geometry and textures that are loaded, as NumPy arrays on the library's own memory.

Nothing is copied. The arrays are read-only, and hold what they lie in: unloading it is refused while one of them, or a
view of one, is in use, and a walk that is closed frees its memory when the last of them is gone."""
from __future__ import annotations

import ctypes
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from . import _capi as c

SAMPLE = np.dtype([("w_and_roles", "u4"), ("row", "u4")])
VERTEX = np.dtype([("position", "f4", 3), ("weights", "f4", 2)])
TRIANGLE = np.dtype([("vertices", "u4", 3), ("mesh", "u4"), ("source", "u4")])
WRAPS: dict[int, Literal["repeat", "clamp", "mirror"]] = {c.REPEAT: "repeat", c.CLAMP: "clamp", c.MIRROR: "mirror"}


def vector(of: Any) -> Any:
    """An array of ctypes as a tuple."""
    return tuple(of)


def array_at(holder: object, pointer: Any, shape: tuple[int, ...], dtype: Any) -> np.ndarray:
    """The array at a pointer of ctypes, which keeps `holder` alive; of zeros where the pointer is NULL."""
    kind = np.dtype(dtype)
    count = int(np.prod(shape, dtype=np.uint64))
    if not pointer or count == 0:
        empty = np.zeros(shape, kind)
        empty.flags.writeable = False
        return empty
    memory = (ctypes.c_uint8 * (count * kind.itemsize)).from_address(ctypes.addressof(pointer.contents))
    setattr(memory, "holder", holder)  # arrays keep `memory`, and it this
    return np.frombuffer(memoryview(memory).toreadonly(), kind).reshape(shape)


def _or_none(holder: object, pointer: Any, shape: tuple[int, ...], dtype: Any) -> np.ndarray | None:
    return array_at(holder, pointer, shape, dtype) if pointer else None


@dataclass(frozen=True, eq=False)
class Samples:
    """Column k has samples [column_start[k], column_start[k + 1]), rows not falling, in a pixel nearest first."""

    column_start: np.ndarray  #: columns + 1, uint32
    samples: np.ndarray  #: N of SAMPLE: w_and_roles, row
    rgba: np.ndarray  #: N x 4, uint8: sRGB after exposure and tone curve, straight alpha
    mirror: np.ndarray | None  #: N, uint8: of each the mirror that it belongs to, 0 = none

    @property
    def w(self) -> np.ndarray:
        """The inverse horizontal distance in 1/m: N, float32, a copy."""
        return (self.samples["w_and_roles"] & ~np.uint32(0xFF)).view(np.float32)

    @property
    def roles(self) -> np.ndarray:
        """The regions that draw it, by the bits of Need.roles: N, uint8, a copy."""
        return (self.samples["w_and_roles"] & np.uint32(0xFF)).astype(np.uint8)

    @property
    def columns(self) -> np.ndarray:
        """The column of each: N, a copy."""
        return np.repeat(np.arange(len(self.column_start) - 1), np.diff(self.column_start))


@dataclass(frozen=True, eq=False)
class CaptureData:
    """What a camera saw; captures' FORMAT.md tells what it means."""

    centre: tuple[float, float, float]  #: metres
    columns: int
    rows: int
    column_direction: np.ndarray  #: columns x 2, float32: unit, at its centre
    row_tangent: np.ndarray  #: rows, float32, at each row's centre
    surfaces: Samples
    reflections: Samples
    run_start: np.ndarray  #: columns + 1, uint32: runs of the background
    run_first: np.ndarray  #: rows, uint16
    run_end: np.ndarray
    run_roles: np.ndarray  #: uint8

    def points(self, samples: Samples | None = None) -> np.ndarray:
        """Where samples lie, the surfaces' unless others are given: N x 3, float64, metres."""
        of = samples or self.surfaces
        direction = self.column_direction[of.columns].astype(np.float64)
        tangent = self.row_tangent[of.samples["row"]].astype(np.float64)
        return np.column_stack([direction, tangent]) / of.w[:, None] + self.centre


def _samples(holder: object, of: c.Samples, columns: int) -> Samples:
    return Samples(
        array_at(holder, of.column_start, (columns + 1,), "u4"), array_at(holder, of.samples, (of.count,), SAMPLE),
        array_at(holder, of.rgba, (of.count, 4), "u1"), _or_none(holder, of.mirror, (of.count,), "u1"))


def capture_data(holder: object, of: c.CaptureData) -> CaptureData:
    return CaptureData(
        vector(of.centre), of.columns, of.rows,
        array_at(holder, of.column_direction, (of.columns, 2), "f4"), array_at(holder, of.row_tangent, (of.rows,), "f4"),
        _samples(holder, of.surfaces, of.columns), _samples(holder, of.reflections, of.columns),
        array_at(holder, of.run_start, (of.columns + 1,), "u4"), array_at(holder, of.run_first, (of.runs,), "u2"),
        array_at(holder, of.run_end, (of.runs,), "u2"), array_at(holder, of.run_roles, (of.runs,), "u1"))


@dataclass(frozen=True, eq=False)
class MeshData:
    """V vertices and T source triangles of one material, with their baked light.

    Of triangle t (resolution r > 0) light at weights (i / r, j / r), i + j <= r, j fastest, lies from light[first_sample[t]]
    on; as many again for the back where has_back[t]."""

    material: int
    positions: np.ndarray  #: V x 3, float32, metres
    normals: np.ndarray  #: V x 3, float32
    uv0: np.ndarray | None  #: V x 2, float32
    uv1: np.ndarray | None
    colours: np.ndarray | None  #: V x 4, uint8, linear
    triangles: np.ndarray  #: T x 3, uint32
    mirror_plane: np.ndarray | None  #: T, uint8, 255 = none
    first_sample: np.ndarray | None  #: T, uint32; None where no light is baked, as all that follows
    resolution: np.ndarray | None  #: T, uint16
    has_back: np.ndarray | None  #: T, uint8
    light: np.ndarray | None  #: samples x 4, float16: red, green, blue, unused


def mesh_data(holder: object, of: c.MeshData) -> MeshData:
    vertices, triangles = of.vertex_count, of.triangle_count
    first = _or_none(holder, of.first_sample, (triangles,), "u4")
    resolution = _or_none(holder, of.resolution, (triangles,), "u2")
    back = _or_none(holder, of.has_back, (triangles,), "u1")
    light = None
    if first is not None and resolution is not None and back is not None:
        r = resolution.astype(np.uint64)
        ends = first + ((r + 1) * (r + 2) // 2 << back)
        light = array_at(holder, of.light, (int(ends[r > 0].max(initial=0)), 4), "f2")
    return MeshData(
        of.material, array_at(holder, of.positions, (vertices, 3), "f4"), array_at(holder, of.normals, (vertices, 3), "f4"),
        _or_none(holder, of.uv0, (vertices, 2), "f4"), _or_none(holder, of.uv1, (vertices, 2), "f4"),
        _or_none(holder, of.colours, (vertices, 4), "u1"), array_at(holder, of.triangles, (triangles, 3), "u4"),
        _or_none(holder, of.mirror_plane, (triangles,), "u1"), first, resolution, back, light)


@dataclass(frozen=True, eq=False)
class RegionData:
    """A region's near geometry: parts of the triangles of its meshes."""

    vertices: np.ndarray  #: of VERTEX: position in metres, weights of the source triangle's 2nd and 3rd corner
    triangles: np.ndarray  #: of TRIANGLE: vertices counter-clockwise from the front, mesh, source triangle in it
    meshes: tuple[MeshData, ...]


def region_data(holder: object, of: c.RegionData, meshes: tuple[MeshData, ...]) -> RegionData:
    return RegionData(
        array_at(holder, of.vertices, (of.vertex_count,), VERTEX),
        array_at(holder, of.triangles, (of.triangle_count,), TRIANGLE), meshes)


@dataclass(frozen=True, eq=False)
class Texture:
    width: int
    height: int
    wrap_u: Literal["repeat", "clamp", "mirror"]
    wrap_v: Literal["repeat", "clamp", "mirror"]
    nearest: bool
    rgba: np.ndarray | None  #: height x width x 4, uint8: sRGB, straight alpha; None unless loaded, by a region that uses it


def texture(holder: object, of: c.Texture) -> Texture:
    return Texture(of.width, of.height, WRAPS[of.wrap_u], WRAPS[of.wrap_v], bool(of.nearest),
                   _or_none(holder, of.rgba, (of.height, of.width, 4), "u1"))
