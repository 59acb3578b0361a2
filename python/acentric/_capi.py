"""The C library by ctypes: its structures, constants and functions as acentric_runtime.h has them, which a test compares.

Names are the header's without their prefix: the structure acentric_local_vertex is LocalVertex, ACENTRIC_FULL is FULL."""
from __future__ import annotations

import ctypes
import os
import pathlib
from ctypes import CFUNCTYPE, POINTER, Structure, c_char_p, c_double, c_float, c_int32, c_size_t, c_void_p
from ctypes import c_uint8, c_uint16, c_uint32, c_uint64

MAJOR, MINOR = 1, 1  # of the header that this file follows

OK = 0
ERROR_ARGUMENT, ERROR_NOT_FOUND, ERROR_UNREADABLE, ERROR_MALFORMED, ERROR_UNSUPPORTED = 1, 2, 3, 4, 5
ERROR_MEMORY, ERROR_OUTSIDE, ERROR_NOT_LOADED, ERROR_INTERNAL = 6, 7, 8, 9
LAYERED, BLENDED, MIRRORS, BACKGROUND, LIGHT = 1, 2, 4, 8, 16
RING, GAP_TRIANGLE, GAP_SQUARE, GAP_HEXAGON = 0, 1, 2, 3
LIST, SCALAR, ZBUFFER = 0, 1, 2
POINT, SPLAT, PATCHES = 0, 1, 4
CAPTURE, REGION = 0, 1
ABSENT, COARSE, FULL = 0, 1, 2
REPEAT, CLAMP, MIRROR = 0, 1, 2
OPAQUE, MASK, BLEND = 0, 1, 2

SizeFunction = CFUNCTYPE(c_int32, c_void_p, POINTER(c_uint64))
ReadFunction = CFUNCTYPE(c_int32, c_void_p, c_uint64, c_void_p, c_uint64)


class Ranges(Structure):
    _fields_ = [("user", c_void_p), ("size", SizeFunction), ("read", ReadFunction)]


class Info(Structure):
    _fields_ = [
        ("name", c_char_p), ("generator", c_char_p), ("origin", c_double * 3),
        ("bounds_min", c_double * 3), ("bounds_max", c_double * 3),
        ("sky_zenith", c_float * 3), ("sky_horizon", c_float * 3), ("sky_ground", c_float * 3),
        ("exposure", c_float), ("features", c_uint32), ("fov", c_double),
        ("storeys", c_int32), ("start_storey", c_int32), ("bookmarks", c_int32), ("paths", c_int32),
        ("textures", c_int32), ("materials", c_int32), ("mirrors", c_int32)]


class Storey(Structure):
    _fields_ = [
        ("name", c_char_p), ("floor_height", c_double), ("eye_height", c_double), ("eye_z", c_double),
        ("near_band", c_double), ("start", c_double * 2), ("start_yaw", c_double),
        ("cameras", c_int32), ("regions", c_int32)]


class Rendition(Structure):
    _fields_ = [
        ("columns", c_int32), ("rows", c_int32),
        ("samples", c_uint64), ("reflections", c_uint64), ("file_bytes", c_uint64)]


class Camera(Structure):
    _fields_ = [
        ("position", c_double * 2), ("low_azimuth", c_double), ("fov", c_double),
        ("top_elevation", c_double), ("bottom_elevation", c_double), ("full", Rendition), ("coarse", Rendition)]


class Region(Structure):
    _fields_ = [
        ("kind", c_int32), ("corners", c_int32), ("grown_corners", c_int32), ("neighbour_count", c_int32),
        ("polygon", POINTER(c_double)), ("grown", POINTER(c_double)), ("neighbours", POINTER(c_int32)),
        ("triangles", c_uint64), ("file_bytes", c_uint64)]


class Pose(Structure):
    _fields_ = [("eye", c_double * 3), ("yaw", c_double), ("pitch", c_double), ("seconds", c_double)]


class Bookmark(Structure):
    _fields_ = [("name", c_char_p), ("storey", c_int32), ("pose", Pose), ("fov", c_double)]


class Path(Structure):
    _fields_ = [("name", c_char_p), ("storey", c_int32), ("count", c_int32), ("poses", POINTER(Pose))]


class View(Structure):
    _fields_ = [
        ("eye", c_double * 3), ("yaw", c_double), ("pitch", c_double), ("fov", c_double),
        ("width", c_int32), ("height", c_int32)]


class Settings(Structure):
    _fields_ = [
        ("renderer", c_int32), ("reconstruction", c_int32), ("max_splat_pixels", c_int32),
        ("local_geometry", c_int32), ("secondary_cover", c_int32), ("fill_holes", c_int32)]


class Need(Structure):
    _fields_ = [("kind", c_int32), ("number", c_int32), ("loaded", c_int32), ("roles", c_uint32)]


class Needs(Structure):
    _fields_ = [("storey", c_int32), ("region", c_int32), ("count", c_size_t)]


class Picture(Structure):
    _fields_ = [
        ("rgba", POINTER(c_uint8)), ("row_bytes", c_size_t), ("holes", POINTER(c_uint8)), ("z_depth", POINTER(c_float))]


class Sample(Structure):
    _fields_ = [("w_and_roles", c_uint32), ("row", c_uint32)]


class Samples(Structure):
    _fields_ = [
        ("count", c_uint64), ("column_start", POINTER(c_uint32)), ("samples", POINTER(Sample)),
        ("rgba", POINTER(c_uint8)), ("mirror", POINTER(c_uint8))]


class CaptureData(Structure):
    _fields_ = [
        ("centre", c_double * 3), ("columns", c_int32), ("rows", c_int32),
        ("column_direction", POINTER(c_float)), ("row_tangent", POINTER(c_float)),
        ("surfaces", Samples), ("reflections", Samples), ("runs", c_uint64), ("run_start", POINTER(c_uint32)),
        ("run_first", POINTER(c_uint16)), ("run_end", POINTER(c_uint16)), ("run_roles", POINTER(c_uint8))]


class LocalVertex(Structure):
    _fields_ = [("position", c_float * 3), ("weights", c_float * 2)]


class LocalTriangle(Structure):
    _fields_ = [("vertices", c_uint32 * 3), ("mesh", c_uint32), ("source", c_uint32)]


class RegionData(Structure):
    _fields_ = [
        ("vertex_count", c_uint64), ("triangle_count", c_uint64), ("vertices", POINTER(LocalVertex)),
        ("triangles", POINTER(LocalTriangle)), ("meshes", c_int32)]


class MeshData(Structure):
    _fields_ = [
        ("material", c_int32), ("vertex_count", c_uint64), ("triangle_count", c_uint64),
        ("positions", POINTER(c_float)), ("normals", POINTER(c_float)), ("uv0", POINTER(c_float)),
        ("uv1", POINTER(c_float)), ("colours", POINTER(c_uint8)), ("triangles", POINTER(c_uint32)),
        ("mirror_plane", POINTER(c_uint8)), ("first_sample", POINTER(c_uint32)), ("resolution", POINTER(c_uint16)),
        ("has_back", POINTER(c_uint8)), ("light", POINTER(c_uint16))]


class Texture(Structure):
    _fields_ = [
        ("width", c_int32), ("height", c_int32), ("wrap_u", c_int32), ("wrap_v", c_int32), ("nearest", c_int32),
        ("rgba", POINTER(c_uint8))]


class TextureUse(Structure):
    _fields_ = [("texture", c_int32), ("uv_set", c_int32), ("rows", c_float * 3 * 2)]


class Material(Structure):
    _fields_ = [
        ("name", c_char_p), ("base_colour", c_float * 4), ("emissive", c_float * 3),
        ("base_colour_texture", TextureUse), ("emissive_texture", TextureUse),
        ("metallic", c_float), ("roughness", c_float), ("transmission", c_float), ("alpha_cutoff", c_float),
        ("alpha_mode", c_int32), ("double_sided", c_int32), ("unlit", c_int32)]


class Mirror(Structure):
    _fields_ = [("normal", c_float * 3), ("point", c_float * 3)]


class Handle(c_void_p):
    """acentric_bundle*"""


_NUMBER = POINTER(c_int32)
_PLACE = POINTER(c_double)
_VIEW, _SETTINGS = POINTER(View), POINTER(Settings)
#: By name without "acentric_": what is returned, then the arguments.
FUNCTIONS: dict[str, tuple] = {
    "runtime_version": (c_uint32,),
    "status_name": (c_char_p, c_int32),
    "open_folder": (c_int32, c_char_p, POINTER(Handle)),
    "open_walk": (c_int32, c_char_p, POINTER(Handle)),
    "open_ranges": (c_int32, POINTER(Ranges), POINTER(Handle)),
    "close": (None, Handle),
    "message": (c_char_p, Handle),
    "set_threads": (c_int32, Handle, c_int32),
    "get_info": (c_int32, Handle, POINTER(Info)),
    "get_storey": (c_int32, Handle, c_int32, POINTER(Storey)),
    "get_camera": (c_int32, Handle, c_int32, c_int32, POINTER(Camera)),
    "get_region": (c_int32, Handle, c_int32, c_int32, POINTER(Region)),
    "get_bookmark": (c_int32, Handle, c_int32, POINTER(Bookmark)),
    "get_path": (c_int32, Handle, c_int32, POINTER(Path)),
    "storey_at": (c_int32, Handle, _PLACE, _NUMBER),
    "region_at": (c_int32, Handle, c_int32, _PLACE, _NUMBER),
    "clamp": (c_int32, Handle, c_int32, _PLACE),
    "start_view": (c_int32, Handle, _VIEW),
    "default_settings": (c_int32, Handle, _SETTINGS),
    "view_needs": (c_int32, Handle, _VIEW, _SETTINGS, POINTER(Need), c_size_t, POINTER(Needs)),
    "memory": (c_uint64, Handle),
    "set_memory_limit": (c_int32, Handle, c_uint64),
    "load_capture": (c_int32, Handle, c_int32, c_int32, c_int32),
    "unload_capture": (c_int32, Handle, c_int32, c_int32, c_int32),
    "load_region": (c_int32, Handle, c_int32, c_int32),
    "unload_region": (c_int32, Handle, c_int32, c_int32),
    "unload_textures": (c_int32, Handle),
    "load_view": (c_int32, Handle, _VIEW, _SETTINGS, c_int32),
    "render": (c_int32, Handle, _VIEW, _SETTINGS, POINTER(Picture)),
    "get_capture_data": (c_int32, Handle, c_int32, c_int32, c_int32, POINTER(CaptureData)),
    "get_region_data": (c_int32, Handle, c_int32, c_int32, POINTER(RegionData)),
    "get_mesh_data": (c_int32, Handle, c_int32, c_int32, c_int32, POINTER(MeshData)),
    "get_texture": (c_int32, Handle, c_int32, POINTER(Texture)),
    "get_material": (c_int32, Handle, c_int32, POINTER(Material)),
    "get_mirror": (c_int32, Handle, c_int32, POINTER(Mirror)),
}


def _load() -> ctypes.CDLL:
    """The one that ACENTRIC_RUNTIME names, else that of the package, else the system's."""
    name = f"libacentric_runtime.so.{MAJOR}"
    within = pathlib.Path(__file__).with_name(name)
    file = os.environ.get("ACENTRIC_RUNTIME") or (str(within) if within.is_file() else name)
    try:
        library = ctypes.CDLL(file)
    except OSError as error:
        raise ImportError(f"{error}. Set ACENTRIC_RUNTIME to the file of the C library, or install the package anew "
                          "where its libraries are (docs/runtimes.md)") from error
    for function, (result, *arguments) in FUNCTIONS.items():
        try:
            declared = getattr(library, "acentric_" + function)
        except AttributeError:
            raise ImportError(f"{file} is no library of Acentric from version {MAJOR}.{MINOR} on: "
                              f"it has no acentric_{function}") from None
        declared.restype, declared.argtypes = result, arguments
    found = library.acentric_runtime_version()
    if found // 10000 != MAJOR:
        raise ImportError(f"{file} is of version {found // 10000}, and this package knows version {MAJOR}")
    return library


library = _load()
