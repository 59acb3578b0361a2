"""What there is in a walk, and views of it, as values.

Positions are metres, Z up, relative to Info.origin. Angles are radians; azimuths and yaw run counter-clockwise seen
from above from +X, pitch upwards. Storeys, cameras, regions, textures, materials and mirrors are numbered from 0."""
from __future__ import annotations

import enum
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any, Generic, Literal, TypeVar, overload

import numpy as np

from . import _capi as c

Vector2 = tuple[float, float]
Vector3 = tuple[float, float, float]
Detail = Literal["coarse", "full"]
T = TypeVar("T")


class Features(enum.IntFlag):
    LAYERED = c.LAYERED  #: several samples in a pixel
    BLENDED = c.BLENDED  #: alpha below 1
    MIRRORS = c.MIRRORS  #: reflections
    BACKGROUND = c.BACKGROUND  #: runs of the background
    LIGHT = c.LIGHT  #: baked to near surfaces


class Listing(Sequence[T], Generic[T]):
    """Items that are read when they are asked for: a walk may have a million regions."""

    def __init__(self, length: int, item: Callable[[int], T]):
        self._length, self._item = length, item

    def __len__(self) -> int:
        return self._length

    @overload
    def __getitem__(self, number: int) -> T: ...
    @overload
    def __getitem__(self, number: slice) -> list[T]: ...
    def __getitem__(self, number: Any) -> Any:
        numbers = range(self._length)[number]
        return [self._item(each) for each in numbers] if isinstance(numbers, range) else self._item(numbers)

    def __repr__(self) -> str:
        return f"<{self._length} items>"


@dataclass(frozen=True)
class Info:
    name: str
    generator: str
    origin: Vector3
    bounds_min: Vector3  #: all 0 of an empty scene, as bounds_max
    bounds_max: Vector3
    sky_zenith: Vector3  #: linear radiance
    sky_horizon: Vector3
    sky_ground: Vector3
    exposure: float
    features: Features
    fov: float  #: horizontal, that the walk begins with
    start_storey: int


@dataclass(frozen=True)
class Rendition:
    """One capture file of a camera."""

    columns: int
    rows: int
    samples: int
    reflections: int
    file_bytes: int


@dataclass(frozen=True)
class Camera:
    """A column camera; `full` and `coarse` are None where there is no such rendition."""

    position: Vector2
    low_azimuth: float
    fov: float
    top_elevation: float
    bottom_elevation: float
    full: Rendition | None
    coarse: Rendition | None


@dataclass(frozen=True, eq=False)
class Region:
    """Where one may stand, a convex polygon, counter-clockwise."""

    kind: Literal["ring", "triangle", "square", "hexagon"]
    polygon: np.ndarray  #: corners x 2, float64
    grown: np.ndarray  #: the same by the near band
    neighbours: np.ndarray  #: numbers of the regions that touch it, int32
    triangles: int  #: of its near geometry
    file_bytes: int


@dataclass(frozen=True)
class Storey:
    name: str
    floor_height: float
    eye_height: float
    eye_z: float
    near_band: float
    start: Vector2
    start_yaw: float
    cameras: Sequence[Camera] = field(compare=False)
    regions: Sequence[Region] = field(compare=False)


@dataclass(frozen=True)
class View:
    """A picture that is asked for: `fov` is horizontal, width and height are pixels, 1 to 16384."""

    eye: Vector3
    yaw: float
    pitch: float
    fov: float
    width: int = 960
    height: int = 540


@dataclass(frozen=True)
class Pose:
    eye: Vector3
    yaw: float
    pitch: float
    seconds: float  #: from the beginning of a path; 0 of a bookmark

    def view(self, fov: float, width: int = 960, height: int = 540) -> View:
        return View(self.eye, self.yaw, self.pitch, fov, width, height)


@dataclass(frozen=True)
class Bookmark:
    name: str
    storey: int
    pose: Pose
    fov: float

    def view(self, width: int = 960, height: int = 540) -> View:
        return self.pose.view(self.fov, width, height)


@dataclass(frozen=True)
class Path:
    name: str
    storey: int
    poses: tuple[Pose, ...]


@dataclass(frozen=True)
class Settings:
    """How a view is drawn; Walk.settings are the project's."""

    renderer: Literal["list", "scalar", "zbuffer"]  #: list priority, its plain reference, or a depth buffer
    reconstruction: Literal["point", "splat", "patches"]  #: how samples become pixels
    max_splat_pixels: int  #: 1 to 64
    local_geometry: bool
    secondary_cover: bool
    fill_holes: bool


@dataclass(frozen=True)
class Need:
    """A capture or a region's near geometry that a view is drawn from."""

    kind: Literal["capture", "region"]
    number: int  #: of the camera or region
    loaded: Detail | None
    roles: int  #: of a capture: the region draws the samples and runs that share a bit with these


@dataclass(frozen=True)
class Needs:
    """What a view is drawn from, in drawing order: captures back to front, then the region's near geometry."""

    storey: int  #: where the eye stands
    region: int
    items: tuple[Need, ...]


@dataclass(frozen=True, eq=False)
class Frame:
    """A picture that was drawn; row 0 is on top."""

    rgba: np.ndarray  #: height x width x 4, uint8: sRGB, alpha 255, 0 where a hole is open
    holes: np.ndarray  #: height x width, bool: nothing is seen there, be the hole open or filled
    depth: np.ndarray  #: height x width, float32: metres along the viewing direction, infinite for the sky and holes


@dataclass(frozen=True)
class TextureUse:
    texture: int
    uv_set: int
    rows: tuple[Vector3, Vector3]  #: u' = rows[0] . (u, v, 1)


@dataclass(frozen=True)
class Material:
    name: str
    base_colour: tuple[float, float, float, float]  #: linear, as emissive
    emissive: Vector3
    base_colour_texture: TextureUse | None
    emissive_texture: TextureUse | None
    metallic: float
    roughness: float
    transmission: float
    alpha_cutoff: float
    alpha_mode: Literal["opaque", "mask", "blend"]
    double_sided: bool
    unlit: bool


@dataclass(frozen=True)
class Mirror:
    """A plane that reflects."""

    normal: Vector3
    point: Vector3
