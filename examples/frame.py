#!/usr/bin/env python3
"""Draws one frame of a bundle with the C library: frame.py BUNDLE OUT.ppm

ACENTRIC_RUNTIME names the library where the system does not find it."""
import ctypes
import os
import sys


class View(ctypes.Structure):
    _fields_ = [("eye", ctypes.c_double * 3), ("yaw", ctypes.c_double), ("pitch", ctypes.c_double),
                ("fov", ctypes.c_double), ("width", ctypes.c_int32), ("height", ctypes.c_int32)]


class Picture(ctypes.Structure):
    _fields_ = [("rgba", ctypes.c_void_p), ("row_bytes", ctypes.c_size_t), ("holes", ctypes.c_void_p),
                ("z_depth", ctypes.c_void_p)]


FULL = 2
lib = ctypes.CDLL(os.environ.get("ACENTRIC_RUNTIME", "libacentric_runtime.so.1"))
lib.acentric_status_name.restype = lib.acentric_message.restype = ctypes.c_char_p
lib.acentric_message.argtypes = lib.acentric_close.argtypes = [ctypes.c_void_p]
lib.acentric_open_folder.argtypes = [ctypes.c_char_p, ctypes.POINTER(ctypes.c_void_p)]
lib.acentric_start_view.argtypes = [ctypes.c_void_p, ctypes.POINTER(View)]
lib.acentric_load_view.argtypes = [ctypes.c_void_p, ctypes.POINTER(View), ctypes.c_void_p, ctypes.c_int32]
lib.acentric_render.argtypes = [ctypes.c_void_p, ctypes.POINTER(View), ctypes.c_void_p,
                                ctypes.POINTER(Picture)]


def main(folder, out):
    bundle = ctypes.c_void_p()

    def check(status):
        if status != 0:
            reason = lib.acentric_status_name(status) + b": " + lib.acentric_message(bundle)
            sys.exit(reason.decode())

    check(lib.acentric_open_folder(os.fsencode(folder), ctypes.byref(bundle)))
    view = View()
    check(lib.acentric_start_view(bundle, ctypes.byref(view)))
    check(lib.acentric_load_view(bundle, ctypes.byref(view), None, FULL))
    rgba = (ctypes.c_uint8 * (4 * view.width * view.height))()
    picture = Picture(ctypes.cast(rgba, ctypes.c_void_p), 0, None, None)
    check(lib.acentric_render(bundle, ctypes.byref(view), None, ctypes.byref(picture)))
    pixels = bytes(rgba)
    rgb = bytearray(3 * view.width * view.height)
    for channel in range(3):
        rgb[channel::3] = pixels[channel::4]
    with open(out, "wb") as file:
        file.write(b"P6\n%d %d\n255\n" % (view.width, view.height) + rgb)
    lib.acentric_close(bundle)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit("usage: frame.py BUNDLE OUT.ppm")
    main(sys.argv[1], sys.argv[2])
