"""A walk that is open."""
from __future__ import annotations

import ctypes
import operator
import os
import threading
import weakref
from collections.abc import Sequence
from ctypes import POINTER, byref
from types import TracebackType
from typing import Any

import numpy as np

from . import _data, _errors, _facts
from . import _capi as c
from ._data import vector
from ._facts import Bookmark, Camera, Detail, Features, Frame, Info, Listing, Material, Mirror, Need, Needs, Path, Pose
from ._facts import Region, Rendition, Settings, Storey, TextureUse, Vector2, Vector3, View
from ._source import Openable, Source

_DETAILS: dict[str, int] = {"coarse": c.COARSE, "full": c.FULL}
_RENDERERS: dict[str, int] = {"list": c.LIST, "scalar": c.SCALAR, "zbuffer": c.ZBUFFER}
_RECONSTRUCTIONS: dict[str, int] = {"point": c.POINT, "splat": c.SPLAT, "patches": c.PATCHES}
_KINDS: dict[int, Any] = {
    c.RING: "ring", c.GAP_TRIANGLE: "triangle", c.GAP_SQUARE: "square", c.GAP_HEXAGON: "hexagon"}
_ALPHA_MODES: dict[int, Any] = {c.OPAQUE: "opaque", c.MASK: "mask", c.BLEND: "blend"}


def _code(codes: dict[str, int], name: str, what: str) -> int:
    if name not in codes:
        raise _errors.refused(f"{what}: {' or '.join(codes)}, not {name!r}")
    return codes[name]


def _name(codes: dict[str, int], code: int) -> Any:
    return next(name for name, number in codes.items() if number == code)


def _int32(value: int, what: str) -> int:
    """ctypes would leave out bits without a word."""
    number = operator.index(value)
    if not -(2**31) <= number < 2**31:
        raise _errors.refused(f"{what}: {number} is out of range")
    return number


def _text(given: bytes | None) -> str:
    return (given or b"").decode(errors="replace")


def _doubles(values: Sequence[float], count: int, what: str) -> ctypes.Array:
    if len(values) != count:
        raise _errors.refused(f"{what}: {count} numbers, not {len(values)}")
    return (ctypes.c_double * count)(*values)


def _view(view: View) -> c.View:
    return c.View(_doubles(view.eye, 3, "eye"), view.yaw, view.pitch, view.fov,
                  _int32(view.width, "width"), _int32(view.height, "height"))


def _settings(settings: Settings | None) -> Any:
    """A pointer, which is NULL for the project's."""
    if settings is None:
        return None
    return byref(c.Settings(
        _code(_RENDERERS, settings.renderer, "renderer"),
        _code(_RECONSTRUCTIONS, settings.reconstruction, "reconstruction"),
        _int32(settings.max_splat_pixels, "max_splat_pixels"),
        settings.local_geometry, settings.secondary_cover, settings.fill_holes))


def _pose(of: c.Pose) -> Pose:
    return Pose(vector(of.eye), of.yaw, of.pitch, of.seconds)


def _rendition(of: c.Rendition) -> Rendition | None:
    return Rendition(of.columns, of.rows, of.samples, of.reflections, of.file_bytes) if of.columns else None


def _texture_use(of: c.TextureUse) -> TextureUse | None:
    return TextureUse(of.texture, of.uv_set, (vector(of.rows[0]), vector(of.rows[1]))) if of.texture >= 0 else None


def _copy(pointer: Any, shape: tuple[int, ...], dtype: Any) -> np.ndarray:
    return _data.array_at(None, pointer, shape, dtype).copy()


class _Handle:
    """Closed once nothing needs it: neither the walk nor an array of its data."""

    def __init__(self, pointer: c.Handle, source: Source | None):
        self.pointer = pointer
        self.source = source

    def __del__(self, close: Any = c.library.acentric_close) -> None:
        close(self.pointer)


class _Lease:
    """What arrays hold: while there is one of a capture, a region or the textures, it is not unloaded."""

    def __init__(self, handle: _Handle):
        self.handle = handle


class Walk:
    """A bundle or walk file that is open: acentric.open makes one.

    Any thread may call it; one call runs at a time. After close() every call raises Error. A walk that is not closed
    is when nothing refers to it any more."""

    def __init__(self, source: Openable, threads: int | None, memory_limit: int | None):
        self._lock = threading.RLock()
        self._calling = False
        self._leases: weakref.WeakValueDictionary[tuple, _Lease] = weakref.WeakValueDictionary()
        self._asked: set[tuple[str, int, int]] = set()  # all that may be loaded: kind, storey, number
        self._handle: _Handle | None = self._opened(source)
        try:
            self.threads = min(len(os.sched_getaffinity(0)), 1024) if threads is None else threads
            self.memory_limit = memory_limit
        except BaseException:
            self.close()
            raise

    def _opened(self, given: Any) -> _Handle:
        pointer = c.Handle()
        source: Source | None = None
        if isinstance(given, (str, os.PathLike)):
            name = os.fsencode(given)
            if b"\0" in name:
                raise _errors.refused(f"{given!r} is no path")
            function = c.library.acentric_open_folder if os.path.isdir(name) else c.library.acentric_open_walk
            status = function(name, byref(pointer))
        else:
            source = Source(given)
            status = c.library.acentric_open_ranges(byref(source.functions), byref(pointer))
        handle = _Handle(pointer, source)
        self._check(handle, status)
        return handle

    @staticmethod
    def _check(handle: _Handle, status: int) -> None:
        """Raises where a call failed, from what the source raised if it did."""
        failure = None
        if handle.source is not None:
            failure, handle.source.failure = handle.source.failure, None
        if failure is not None and not isinstance(failure, Exception):
            raise failure
        if status != c.OK:
            message = _text(c.library.acentric_message(handle.pointer))
            raise _errors.error_of(status, message) from failure

    def _open_handle(self) -> _Handle:
        if self._handle is None:
            raise _errors.refused("the walk is closed")
        if self._calling:
            raise _errors.refused("the walk's own source calls it")
        return self._handle

    def _call(self, name: str, *arguments: Any) -> None:
        with self._lock:
            handle = self._open_handle()
            kinds = c.FUNCTIONS[name][2:]  # after what is returned, and the handle
            checked = [_int32(value, name) if kind is ctypes.c_int32 else value for kind, value in zip(kinds, arguments)]
            self._calling = True
            try:
                status = getattr(c.library, "acentric_" + name)(handle.pointer, *checked)
            finally:
                self._calling = False
            self._check(handle, status)

    def _get(self, out: Any, name: str, *arguments: Any) -> Any:
        self._call(name, *arguments, byref(out))
        return out

    def _lease(self, *key: Any) -> _Lease:
        lease = self._leases.get(key)
        if lease is None:
            lease = self._leases[key] = _Lease(self._open_handle())
        return lease

    def _refuse_in_use(self, *key: Any) -> None:
        if key in self._leases:
            raise _errors.refused(f"arrays of {' '.join(map(str, key))} are in use: let go of them first")

    # --- Closing ---

    def close(self) -> None:
        """Frees what is loaded, or once they are gone where arrays of it are in use."""
        with self._lock:
            if self._calling:
                raise _errors.refused("the walk's own source closes it")
            self._handle = None

    @property
    def closed(self) -> bool:
        return self._handle is None

    def __enter__(self) -> Walk:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self.close()

    def __repr__(self) -> str:
        return f"<acentric.Walk, {'closed' if self.closed else 'open'}>"

    # --- What there is ---

    def _info(self) -> c.Info:
        return self._get(c.Info(), "get_info")

    @property
    def info(self) -> Info:
        with self._lock:  # names and arrays of facts live as long as the handle
            of = self._info()
            return Info(
                _text(of.name), _text(of.generator), vector(of.origin), vector(of.bounds_min), vector(of.bounds_max),
                vector(of.sky_zenith), vector(of.sky_horizon), vector(of.sky_ground), of.exposure, Features(of.features),
                of.fov, of.start_storey)

    @property
    def storeys(self) -> Sequence[Storey]:
        return Listing(self._info().storeys, self._storey)

    @property
    def bookmarks(self) -> Sequence[Bookmark]:
        return Listing(self._info().bookmarks, self._bookmark)

    @property
    def paths(self) -> Sequence[Path]:
        return Listing(self._info().paths, self._path)

    @property
    def materials(self) -> Sequence[Material]:
        return Listing(self._info().materials, self._material)

    @property
    def mirrors(self) -> Sequence[Mirror]:
        return Listing(self._info().mirrors, self._mirror)

    def _storey(self, number: int) -> Storey:
        with self._lock:
            of = self._get(c.Storey(), "get_storey", number)
            return Storey(
                _text(of.name), of.floor_height, of.eye_height, of.eye_z, of.near_band, vector(of.start), of.start_yaw,
                Listing(of.cameras, lambda camera: self._camera(number, camera)),
                Listing(of.regions, lambda region: self._region(number, region)))

    def _camera(self, storey: int, number: int) -> Camera:
        of = self._get(c.Camera(), "get_camera", storey, number)
        return Camera(vector(of.position), of.low_azimuth, of.fov, of.top_elevation, of.bottom_elevation,
                      _rendition(of.full), _rendition(of.coarse))

    def _region(self, storey: int, number: int) -> Region:
        with self._lock:
            of = self._get(c.Region(), "get_region", storey, number)
            return Region(
                _KINDS[of.kind], _copy(of.polygon, (of.corners, 2), "f8"), _copy(of.grown, (of.grown_corners, 2), "f8"),
                _copy(of.neighbours, (of.neighbour_count,), "i4"), of.triangles, of.file_bytes)

    def _bookmark(self, number: int) -> Bookmark:
        with self._lock:
            of = self._get(c.Bookmark(), "get_bookmark", number)
            return Bookmark(_text(of.name), of.storey, _pose(of.pose), of.fov)

    def _path(self, number: int) -> Path:
        with self._lock:
            of = self._get(c.Path(), "get_path", number)
            return Path(_text(of.name), of.storey, tuple(_pose(of.poses[i]) for i in range(of.count)))

    def _material(self, number: int) -> Material:
        with self._lock:
            of = self._get(c.Material(), "get_material", number)
            return Material(
                _text(of.name), vector(of.base_colour), vector(of.emissive), _texture_use(of.base_colour_texture),
                _texture_use(of.emissive_texture), of.metallic, of.roughness, of.transmission, of.alpha_cutoff,
                _ALPHA_MODES[of.alpha_mode], bool(of.double_sided), bool(of.unlit))

    def _mirror(self, number: int) -> Mirror:
        of = self._get(c.Mirror(), "get_mirror", number)
        return Mirror(vector(of.normal), vector(of.point))

    def storey_at(self, eye: Vector3) -> int:
        """The storey whose regions are nearest to the eye."""
        return self._get(ctypes.c_int32(), "storey_at", _doubles(eye, 3, "eye")).value

    def region_at(self, storey: int, place: Vector2) -> int:
        """The region that holds a place; raises Outside if none does."""
        return self._get(ctypes.c_int32(), "region_at", storey, _doubles(place, 2, "place")).value

    def clamp(self, storey: int, place: Vector2) -> Vector2:
        """The place, or the nearest that a region holds if none holds it."""
        moved = _doubles(place, 2, "place")
        self._call("clamp", storey, moved)
        return vector(moved)

    # --- Views ---

    def start_view(self, width: int = 960, height: int = 540) -> View:
        """Where the walk begins."""
        of = self._get(c.View(), "start_view")
        return View(vector(of.eye), of.yaw, of.pitch, of.fov, width, height)

    @property
    def settings(self) -> Settings:
        """As the project has them, and as views are drawn without others."""
        of = self._get(c.Settings(), "default_settings")
        return Settings(
            _name(_RENDERERS, of.renderer), _name(_RECONSTRUCTIONS, of.reconstruction), of.max_splat_pixels,
            bool(of.local_geometry), bool(of.secondary_cover), bool(of.fill_holes))

    def needs(self, view: View, settings: Settings | None = None) -> Needs:
        """What a view is drawn from, and what of it is loaded. Raises Outside where the eye stands in no region."""
        asked, chosen, found = _view(view), _settings(settings), c.Needs()
        with self._lock:
            self._call("view_needs", byref(asked), chosen, None, 0, byref(found))
            items = (c.Need * found.count)()
            self._call("view_needs", byref(asked), chosen, items, found.count, byref(found))
        return Needs(found.storey, found.region, tuple(
            Need("capture" if item.kind == c.CAPTURE else "region", item.number,
                 None if item.loaded == c.ABSENT else _name(_DETAILS, item.loaded), item.roles) for item in items))

    def load(self, view: View, detail: Detail = "full", settings: Settings | None = None) -> None:
        """Loads all that a view needs: full captures, or with "coarse" coarse ones where nothing is loaded yet.

        A camera that was not baked is left out, one that has no such rendition gives its other. Raises OutOfMemory
        beyond the memory limit, and leaves what is there."""
        asked, code = _view(view), _code(_DETAILS, detail, "detail")
        with self._lock:
            needs = self.needs(view, settings)
            self._asked.update((need.kind, needs.storey, need.number) for need in needs.items)
            self._call("load_view", byref(asked), _settings(settings), code)

    def render(self, view: View, settings: Settings | None = None, detail: Detail | None = "full") -> Frame:
        """Draws a view, after it has loaded what it needs; with `detail` None of what is loaded, the rest holes."""
        asked = _view(view)
        with self._lock:
            if detail is not None:
                self.load(view, detail, settings)
            else:
                self.needs(view, settings)  # refuses a view that is none before memory is taken for its picture
            rgba = np.empty((asked.height, asked.width, 4), np.uint8)
            holes = np.empty((asked.height, asked.width), np.uint8)
            depth = np.empty((asked.height, asked.width), np.float32)
            picture = c.Picture(
                rgba.ctypes.data_as(POINTER(ctypes.c_uint8)), 0, holes.ctypes.data_as(POINTER(ctypes.c_uint8)),
                depth.ctypes.data_as(POINTER(ctypes.c_float)))
            self._call("render", byref(asked), _settings(settings), byref(picture))
        return Frame(rgba, holes != 0, depth)

    # --- Memory ---

    @property
    def threads(self) -> int:
        """That draw and unpack: 1 to 1024, as many as there are processors unless open() is told otherwise."""
        return self._threads

    @threads.setter
    def threads(self, threads: int) -> None:
        self._call("set_threads", threads)
        self._threads = threads

    @property
    def memory(self) -> int:
        """Bytes of the captures, regions and textures that are loaded."""
        with self._lock:
            return c.library.acentric_memory(self._open_handle().pointer)

    @property
    def memory_limit(self) -> int | None:
        """Bytes beyond which loading raises OutOfMemory; None: no limit."""
        return self._memory_limit

    @memory_limit.setter
    def memory_limit(self, limit: int | None) -> None:
        if limit is not None and not 0 < operator.index(limit) < 2**64:
            raise _errors.refused(f"memory_limit: {limit} is no number of bytes")
        self._call("set_memory_limit", limit or 0)
        self._memory_limit = limit

    def load_capture(self, storey: int, camera: int, detail: Detail = "full") -> None:
        """Raises NotFound where it was not baked, OutOfMemory beyond the memory limit."""
        with self._lock:
            self._call("load_capture", storey, camera, _code(_DETAILS, detail, "detail"))
            self._asked.add(("capture", storey, camera))

    def load_region(self, storey: int, region: int) -> None:
        """A region's near geometry, with the textures that it needs. Raises OutOfMemory beyond the memory limit."""
        with self._lock:
            self._call("load_region", storey, region)
            self._asked.add(("region", storey, region))

    def unload_capture(self, storey: int, camera: int, detail: Detail = "full") -> None:
        """Refused while an array of its data is in use; nothing happens where it is not loaded."""
        with self._lock:
            self._refuse_in_use("capture", storey, camera, detail)
            self._call("unload_capture", storey, camera, _code(_DETAILS, detail, "detail"))

    def unload_region(self, storey: int, region: int) -> None:
        """As unload_capture; its textures stay."""
        with self._lock:
            self._refuse_in_use("region", storey, region)
            self._call("unload_region", storey, region)

    def unload_textures(self) -> None:
        """As unload_capture, of all."""
        with self._lock:
            self._refuse_in_use("textures")
            self._call("unload_textures")

    def unload(self, keep: View | None = None, settings: Settings | None = None) -> None:
        """Unloads all but what a view is drawn from, and the textures; without one all.

        Captures, regions and textures of which arrays are in use stay."""
        with self._lock:
            kept: set[tuple] = set(self._leases.keys())
            if keep is not None:
                needs = self.needs(keep, settings)
                for need in needs.items:
                    details = _DETAILS if need.kind == "capture" else [None]
                    kept.update((need.kind, needs.storey, need.number, *([d] if d else [])) for d in details)
                kept.add(("textures",))
            for part in sorted(self._asked):
                if part[0] == "region":
                    codes = [()] if part not in kept else []
                else:
                    codes = [(code,) for detail, code in _DETAILS.items() if (*part, detail) not in kept]
                for code in codes:
                    self._call(f"unload_{part[0]}", *part[1:], *code)
                if len(codes) == (1 if part[0] == "region" else len(_DETAILS)):
                    self._asked.remove(part)
            if ("textures",) not in kept:
                self._call("unload_textures")

    # --- Data for a renderer of one's own ---

    def capture_data(self, storey: int, camera: int, detail: Detail = "full") -> _data.CaptureData:
        """Of a capture that is loaded. Nothing is copied: it cannot be unloaded while an array of it is in use."""
        with self._lock:
            of = self._get(c.CaptureData(), "get_capture_data", storey, camera, _code(_DETAILS, detail, "detail"))
            return _data.capture_data(self._lease("capture", storey, camera, detail), of)

    def region_data(self, storey: int, region: int) -> _data.RegionData:
        """Of a region that is loaded, as capture_data."""
        with self._lock:
            of = self._get(c.RegionData(), "get_region_data", storey, region)
            lease = self._lease("region", storey, region)
            meshes = tuple(_data.mesh_data(lease, self._get(c.MeshData(), "get_mesh_data", storey, region, mesh))
                           for mesh in range(of.meshes))
            return _data.region_data(lease, of, meshes)

    def texture(self, number: int) -> _data.Texture:
        """As capture_data, but for its facts, which are there without its picture."""
        with self._lock:
            of = self._get(c.Texture(), "get_texture", number)
            return _data.texture(self._lease("textures"), of)


def open(source: Openable, *, threads: int | None = None, memory_limit: int | None = None) -> Walk:
    """Opens the folder of a bundle, a walk file, or a walk file that is read from anywhere: an object with size() and
    read_at(offset, count), or a binary file that seeks.

    Reads the index; captures and regions come when they are asked for. `threads` draw and unpack, as many as there are
    processors unless told otherwise; `memory_limit` is in bytes. Raises NotFound, or Error with the reason."""
    return Walk(source, threads, memory_limit)
