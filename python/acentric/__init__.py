"""Walks that Acentric writes (acentric export P --to bundle or walk): frames of them, and their data as NumPy arrays.

    import acentric

    with acentric.open("gallery.acentric") as walk:
        frame = walk.render(walk.start_view(1280, 720))
        frame.rgba, frame.holes, frame.depth

Positions are metres, Z up; angles are radians. The C library draws (docs/runtimes.md)."""
from ._capi import library as _library
from ._data import CaptureData, MeshData, RegionData, Samples, Texture
from ._errors import Error, NotFound, OutOfMemory, Outside, Status
from ._facts import Bookmark, Camera, Features, Frame, Info, Material, Mirror, Need, Needs, Path, Pose, Region, Rendition
from ._facts import Settings, Storey, TextureUse, View
from ._source import Ranges
from ._walk import Walk, open

#: Of the C library that runs: (major, minor, patch).
runtime_version: tuple[int, int, int] = (
    _library.acentric_runtime_version() // 10000, _library.acentric_runtime_version() // 100 % 100,
    _library.acentric_runtime_version() % 100)

__all__ = [
    "Bookmark", "Camera", "CaptureData", "Error", "Features", "Frame", "Info", "Material", "MeshData", "Mirror", "Need",
    "Needs", "NotFound", "OutOfMemory", "Outside", "Path", "Pose", "Ranges", "Region", "RegionData", "Rendition", "Samples",
    "Settings", "Status", "Storey", "Texture", "TextureUse", "View", "Walk", "open", "runtime_version"]
