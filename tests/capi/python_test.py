"""The package as Python sees it: python_test.py FOLDER HEADER, of a folder that python_test.cpp makes."""
import ctypes
import dataclasses
import gc
import io
import itertools
import json
import pathlib
import subprocess
import sys
import tempfile
import threading
import unittest
import warnings
import weakref

import numpy as np

import acentric
from acentric import _capi

HEADER = pathlib.Path(sys.argv.pop())
FOLDER = pathlib.Path(sys.argv.pop())
BUNDLE, WALK = FOLDER / "bundle", FOLDER / "room.acentric"
VIEWS = [acentric.View(**view) for view in json.loads((FOLDER / "views.json").read_text())]


def expected(number, ending, dtype, *more):
    view = VIEWS[number]
    return np.fromfile(FOLDER / f"{number}.{ending}", dtype).reshape(view.height, view.width, *more)


class Bytes:
    """A walk in memory, with a mark of what was read."""

    def __init__(self, content):
        self.content, self.reads = content, []

    def size(self):
        return len(self.content)

    def read_at(self, offset, count):
        self.reads.append((offset, count))
        return self.content[offset:offset + count]


class Header(unittest.TestCase):
    """What is written once more in Python is what a compiler makes of the header."""

    NAMES = {ctypes.c_int32: "int32_t", ctypes.c_uint32: "uint32_t", ctypes.c_uint64: "uint64_t",
             ctypes.c_char_p: "const char*", _capi.Handle: "acentric_bundle*", ctypes.c_double: "double",
             ctypes.c_float: "float", ctypes.c_uint8: "uint8_t", ctypes.c_uint16: "uint16_t", None: "void"}

    @staticmethod
    def structures():
        return {"acentric_" + "".join("_" + letter.lower() if letter.isupper() else letter for letter in name)[1:]: kind
                for name, kind in vars(_capi).items()
                if isinstance(kind, type) and issubclass(kind, ctypes.Structure) and kind is not ctypes.Structure}

    @staticmethod
    def compiled(source, *flags):
        with tempfile.TemporaryDirectory() as folder:
            file, program = pathlib.Path(folder, "check.c"), pathlib.Path(folder, "check")
            file.write_text(f'#include "{HEADER}"\n#include <stdio.h>\n{source}\n')
            done = subprocess.run(["cc", "-std=c11", "-Wall", "-Wextra", "-Werror", *flags, file, "-o", program],
                                  capture_output=True, text=True)
            if done.returncode != 0:
                raise AssertionError(done.stderr)
            return "-c" in flags or subprocess.run([program], capture_output=True, text=True, check=True).stdout

    def name(self, kind):
        if kind in self.NAMES:
            return self.NAMES[kind]
        structures = {kind: name for name, kind in self.structures().items()}
        return structures[kind] if kind in structures else self.name(kind._type_) + "*"

    @staticmethod
    def either(kind):
        """ctypes knows no const."""
        return {kind, "const " + kind.removeprefix("const ")}

    @staticmethod
    def one_of(expression, kinds):
        return " || ".join(f"__builtin_types_compatible_p(__typeof__({expression}), {kind})" for kind in kinds)

    def test_structures_have_the_layout_of_the_header(self):
        lines, here = [], []
        structures = self.structures()
        self.assertGreater(len(structures), 20)
        for name, kind in structures.items():
            zeros = ", ".join("{0}" if issubclass(of, (ctypes.Array, ctypes.Structure)) else "0" for _, of in kind._fields_)
            lines.append(f"{name} all_of_{name} = {{{zeros}}}; (void)all_of_{name};")  # -Wextra tells of fields without one
            lines.append(f'printf("{name} %zu\\n", sizeof({name}));')
            here.append(f"{name} {ctypes.sizeof(kind)}")
            for field, _ in kind._fields_:
                place = getattr(kind, field)
                lines.append(f'printf("{name}.{field} %zu %zu\\n", offsetof({name}, {field}), sizeof((({name}*)0)->{field}));')
                here.append(f"{name}.{field} {place.offset} {place.size}")
        there = self.compiled("int main(void) {" + "\n".join(lines) + "return 0; }", "-Wno-missing-braces")
        self.assertEqual(there.splitlines(), here)

    def test_fields_have_the_types_of_the_header(self):
        checks = []
        for name, kind in self.structures().items():
            for field, of in kind._fields_:
                if issubclass(of, ctypes._CFuncPtr):
                    continue  # test_functions_ calls what takes them
                while issubclass(of, ctypes.Array):
                    field, of = field + "[0]", of._type_
                declared = "void*" if of is ctypes.c_void_p else "size_t" if of is ctypes.c_size_t else self.name(of)
                same = self.one_of(f"(({name}*)0)->{field}", self.either(declared))
                checks.append(f'_Static_assert({same}, "{name}.{field}");')
        self.assertGreater(len(checks), 120)
        self.compiled("\n".join(checks), "-c")

    def test_constants_are_those_of_the_header(self):
        constants = {name: value for name, value in vars(_capi).items()
                     if name.isupper() and isinstance(value, int) and name not in ("MAJOR", "MINOR")}
        constants |= {"RUNTIME_VERSION_MAJOR": _capi.MAJOR}
        self.assertGreater(len(constants), 30)
        there = self.compiled("int main(void) {" + "".join(
            f'printf("%d\\n", (int)ACENTRIC_{name});' for name in constants) + "return 0; }")
        self.assertEqual([int(line) for line in there.split()], list(constants.values()))

    def test_functions_take_and_return_what_the_header_says(self):
        checks = []
        for name, (result, *arguments) in _capi.FUNCTIONS.items():
            kinds = ["size_t" if kind is ctypes.c_size_t else self.name(kind) for kind in arguments]
            choices = itertools.product(*(self.either(kind) if "*" in kind else [kind] for kind in kinds))
            same = self.one_of(f"acentric_{name}", [f"{self.name(result)}({', '.join(each) or 'void'})" for each in choices])
            checks.append(f'_Static_assert({same}, "acentric_{name}");')
        self.compiled("\n".join(checks), "-c")

    def test_what_c_calls_is_what_the_header_says(self):
        self.compiled("acentric_status size(void* u, uint64_t* b); acentric_status read(void* u, uint64_t o, void* i, uint64_t b);"
                      "acentric_ranges ranges(void); acentric_ranges ranges(void) { acentric_ranges r = {0, size, read}; return r; }",
                      "-c")
        self.assertEqual(_capi.SizeFunction._argtypes_, (ctypes.c_void_p, ctypes.POINTER(ctypes.c_uint64)))
        self.assertEqual(_capi.ReadFunction._argtypes_,
                         (ctypes.c_void_p, ctypes.c_uint64, ctypes.c_void_p, ctypes.c_uint64))
        self.assertIs(_capi.SizeFunction._restype_, ctypes.c_int32)
        self.assertIs(_capi.ReadFunction._restype_, ctypes.c_int32)


class Frames(unittest.TestCase):
    def assert_frames(self, walk):
        for number, view in enumerate(VIEWS):
            frame = walk.render(view)
            np.testing.assert_array_equal(frame.rgba, expected(number, "rgba", "u1", 4))
            np.testing.assert_array_equal(frame.holes, expected(number, "holes", "u1") == 255)
            np.testing.assert_array_equal(frame.depth, expected(number, "depth", "f4"))
            self.assertEqual((frame.rgba.dtype, frame.holes.dtype, frame.depth.dtype), (np.uint8, bool, np.float32))

    def test_are_the_librarys_from_wherever_the_walk_is(self):
        ranges = Bytes(WALK.read_bytes())
        for source in (BUNDLE, str(WALK), ranges, io.BytesIO(ranges.content)):
            with self.subTest(type(source).__name__), acentric.open(source) as walk:
                self.assert_frames(walk)
        self.assertGreater(len(ranges.reads), 10)
        opened = Bytes(ranges.content)
        with acentric.open(opened):
            self.assertEqual([offset for offset, _ in opened.reads], [0, 88], "header and root of the index")
        with WALK.open("rb") as file, acentric.open(file, threads=1) as walk:
            self.assertEqual(walk.threads, 1)
            self.assert_frames(walk)

    def test_are_the_same_from_several_threads_at_once(self):
        with acentric.open(WALK, threads=2) as walk:
            wrong = []

            def draw(number):
                for _ in range(3):
                    if not np.array_equal(walk.render(VIEWS[number]).rgba, expected(number, "rgba", "u1", 4)):
                        wrong.append(number)

            threads = [threading.Thread(target=draw, args=(number,)) for number in range(4)]
            for thread in threads:
                thread.start()
            for thread in threads:
                thread.join()
            self.assertEqual(wrong, [])

    def test_show_what_is_loaded(self):
        with acentric.open(WALK) as walk:
            nothing = walk.render(VIEWS[0], detail=None)
            self.assertEqual(walk.memory, 0)
            coarse = walk.render(VIEWS[0], detail="coarse")
            few = walk.memory
            full = walk.render(VIEWS[0])
            self.assertGreater(walk.memory, few)
            self.assertGreater(nothing.holes.mean(), coarse.holes.mean())
            self.assertFalse(np.array_equal(coarse.rgba, full.rgba))
            np.testing.assert_array_equal(full.rgba, expected(0, "rgba", "u1", 4))

    def test_follow_settings(self):
        with acentric.open(WALK) as walk:
            self.assertEqual(walk.settings.reconstruction, "patches")
            plain = dataclasses.replace(walk.settings, renderer="zbuffer", reconstruction="point", fill_holes=False)
            self.assertFalse(np.array_equal(walk.render(VIEWS[0], plain).rgba, walk.render(VIEWS[0]).rgba))
            self.assertGreater(walk.render(VIEWS[0], plain).holes.sum(), walk.render(VIEWS[0]).holes.sum())
            without = dataclasses.replace(plain, local_geometry=False)
            self.assertEqual({need.kind for need in walk.needs(VIEWS[0], without).items}, {"capture"})


class Facts(unittest.TestCase):
    def setUp(self):
        self.walk = acentric.open(WALK)
        self.addCleanup(self.walk.close)

    def test_tell_what_there_is(self):
        info = self.walk.info
        self.assertEqual((info.name, info.start_storey), ("walk", 0))
        self.assertAlmostEqual(info.exposure, 0.8, 6)
        self.assertIn(acentric.Features.MIRRORS | acentric.Features.LIGHT, info.features)
        self.assertTrue(all(low < high for low, high in zip(info.bounds_min, info.bounds_max)))
        self.assertEqual(len(self.walk.storeys), 1)
        storey = self.walk.storeys[0]
        self.assertEqual(self.walk.storey_at((0, 0, storey.eye_z)), 0)
        self.assertEqual(len(storey.cameras[:]), len(storey.cameras))
        self.assertGreater(storey.cameras[-1].full.samples, storey.cameras[-1].coarse.samples)
        bookmark, path = self.walk.bookmarks[0], self.walk.paths[0]
        self.assertEqual((bookmark.name, bookmark.pose.eye, bookmark.pose.yaw), ("the lamp", (0.1, -0.2, 1.6), 0.25))
        self.assertEqual(bookmark.view(80, 60), acentric.View((0.1, -0.2, 1.6), 0.25, -0.125, bookmark.fov, 80, 60))
        self.assertEqual((path.name, [pose.seconds for pose in path.poses]), ("round", [0, 2.5]))
        self.assertEqual(self.walk.render(bookmark.view(80, 60)).rgba.shape, (60, 80, 4))
        materials = list(self.walk.materials)
        self.assertIn("mask", [material.alpha_mode for material in materials])
        self.assertAlmostEqual(materials[0].base_colour_texture.rows[0][1], -0.5)
        self.assertIn(None, [material.base_colour_texture for material in materials])
        self.assertEqual(len(self.walk.mirrors), 2)
        self.assertAlmostEqual(abs(self.walk.mirrors[1].normal[0]), 1, 5)
        self.assertEqual(acentric.runtime_version[0], 1)

    def test_regions_hold_their_middle(self):
        storey = self.walk.storeys[0]
        for number, region in enumerate(storey.regions):
            self.assertEqual(self.walk.region_at(0, region.polygon.mean(axis=0)), number)
            corners = region.polygon
            edges = np.roll(corners, -1, axis=0) - corners
            self.assertGreater(np.sum(corners[:, 0] * edges[:, 1] - corners[:, 1] * edges[:, 0]), 0, "counter-clockwise")
            self.assertTrue(all(number in storey.regions[int(other)].neighbours for other in region.neighbours))
        self.assertGreater(len(storey.regions), 1)
        with self.assertRaises(acentric.Outside) as raised:
            self.walk.region_at(0, (50, 0))
        self.assertEqual(raised.exception.status, acentric.Status.OUTSIDE)
        self.walk.region_at(0, self.walk.clamp(0, (50, 0)))

    def test_needs_are_what_is_loaded(self):
        needs = self.walk.needs(VIEWS[0])
        self.assertEqual([need.loaded for need in needs.items], [None] * len(needs.items))
        self.assertEqual((needs.items[-1].kind, needs.items[-1].number), ("region", needs.region))
        self.walk.load(VIEWS[0], "coarse")
        self.assertEqual([need.loaded for need in self.walk.needs(VIEWS[0]).items],
                         ["coarse"] * (len(needs.items) - 1) + ["full"])


class Memory(unittest.TestCase):
    def test_keeps_to_its_limit_and_is_freed(self):
        with acentric.open(WALK) as walk:
            walk.render(VIEWS[0])
            one = walk.memory
            for view in VIEWS:
                walk.load(view)
                walk.load(view, "coarse")
            self.assertGreater(walk.memory, one)
            walk.unload(keep=VIEWS[0])
            self.assertEqual([need.loaded for need in walk.needs(VIEWS[0]).items], ["full"] * len(walk.needs(VIEWS[0]).items))
            walk.unload()
            self.assertEqual(walk.memory, 0)
            walk.memory_limit = one // 2
            with self.assertRaisesRegex(acentric.OutOfMemory, "unload"):
                walk.render(VIEWS[0])
            self.assertLessEqual(walk.memory, one // 2)
            walk.memory_limit = None
            walk.render(VIEWS[0])
        for limit in (0, -1, 2**64):
            with self.assertRaises(acentric.Error):
                acentric.open(WALK, memory_limit=limit)
        self.assertEqual(acentric.open(WALK, memory_limit=10**9).memory_limit, 10**9)


class Data(unittest.TestCase):
    def setUp(self):
        self.walk = acentric.open(WALK)
        self.addCleanup(self.walk.close)
        self.walk.load(VIEWS[0])
        self.needs = self.walk.needs(VIEWS[0])
        self.camera = self.needs.items[0].number

    def test_of_captures_is_what_their_cameras_saw(self):
        data, camera = self.walk.capture_data(0, self.camera), self.walk.storeys[0].cameras[self.camera]
        self.assertEqual((data.columns, data.rows), (camera.full.columns, camera.full.rows))
        np.testing.assert_allclose(data.centre[:2], camera.position)
        surfaces = data.surfaces
        self.assertEqual(len(surfaces.samples), camera.full.samples)
        self.assertEqual((surfaces.column_start[0], surfaces.column_start[-1]), (0, camera.full.samples))
        self.assertEqual(surfaces.rgba.shape, (camera.full.samples, 4))
        np.testing.assert_allclose(np.linalg.norm(data.column_direction, axis=1), 1, atol=1e-6)
        self.assertTrue((surfaces.samples["row"] < data.rows).all() and surfaces.roles.any() and (surfaces.w > 0).all())
        points = data.points()
        np.testing.assert_allclose(np.linalg.norm(points[:, :2] - data.centre[:2], axis=1), 1 / surfaces.w, rtol=1e-5)
        low, high = np.array(self.walk.info.bounds_min), np.array(self.walk.info.bounds_max)
        self.assertTrue(((points > low - 0.2) & (points < high + 0.2)).all(), "within the scene, to half a pixel")
        mirrored = [self.walk.capture_data(0, need.number) for need in self.needs.items
                    if need.kind == "capture" and self.walk.storeys[0].cameras[need.number].full.reflections]
        self.assertTrue(mirrored)
        for of in mirrored:
            self.assertEqual(len(of.points(of.reflections)), len(of.reflections.samples))
            self.assertTrue(of.reflections.mirror.all())

    def test_of_regions_lies_on_their_source_triangles(self):
        data = self.walk.region_data(0, self.needs.region)
        self.assertEqual(len(data.triangles), self.walk.storeys[0].regions[self.needs.region].triangles)
        for triangle in data.triangles:
            mesh = data.meshes[triangle["mesh"]]
            corners = mesh.positions[mesh.triangles[triangle["source"]]]
            at = data.vertices[triangle["vertices"]]
            second, third = at["weights"][:, :1], at["weights"][:, 1:]
            np.testing.assert_allclose((1 - second - third) * corners[0] + second * corners[1] + third * corners[2],
                                       at["position"], atol=1e-4)
        self.assertTrue(any(mesh.uv0 is not None for mesh in data.meshes))
        self.assertTrue(any(mesh.uv0 is None for mesh in data.meshes))
        lit = [mesh for mesh in data.meshes if mesh.light is not None and len(mesh.light)]
        self.assertTrue(lit)
        for mesh in lit:
            self.assertTrue(np.isfinite(mesh.light).all() and mesh.light.max() > 0)
        texture = self.walk.texture(0)
        self.assertEqual(texture.rgba.shape, (texture.height, texture.width, 4))
        self.assertEqual(texture.wrap_u, "repeat")
        np.testing.assert_array_equal(texture.rgba[1, 1], (52, 230, 90, 0))

    def test_is_asked_for_once_it_is_loaded(self):
        self.walk.unload()
        for ask in (lambda: self.walk.capture_data(0, self.camera), lambda: self.walk.region_data(0, self.needs.region)):
            with self.assertRaises(acentric.Error) as raised:
                ask()
            self.assertEqual(raised.exception.status, acentric.Status.NOT_LOADED)
        self.assertIsNone(self.walk.texture(0).rgba)

    def test_is_not_unloaded_while_it_is_in_use(self):
        rows = self.walk.capture_data(0, self.camera).surfaces.samples["row"][10:20]  # a view of an array
        mesh = self.walk.region_data(0, self.needs.region).meshes[0].positions
        picture = self.walk.texture(0).rgba
        before, taken = (rows.copy(), mesh.copy(), picture.copy()), self.walk.memory
        for unload in (lambda: self.walk.unload_capture(0, self.camera), self.walk.unload_textures,
                       lambda: self.walk.unload_region(0, self.needs.region)):
            with self.assertRaisesRegex(acentric.Error, "in use"):
                unload()
        self.assertEqual(self.walk.memory, taken)
        self.walk.unload_capture(0, self.camera, "coarse")
        self.walk.unload()
        self.assertLess(0, self.walk.memory)
        for array, values in zip((rows, mesh, picture), before):
            np.testing.assert_array_equal(array, values)
        del rows, mesh, picture, array
        self.walk.unload_capture(0, self.camera)
        self.walk.unload()
        self.assertEqual(self.walk.memory, 0)

    def test_outlives_its_walk_and_cannot_be_changed(self):
        arrays = self.walk.capture_data(0, self.camera)
        points, colours = arrays.points(), arrays.surfaces.rgba
        values, handle = colours.copy(), weakref.ref(self.walk._handle)
        self.walk.close()
        self.walk = None
        gc.collect()
        np.testing.assert_array_equal(colours, values)
        np.testing.assert_array_equal(arrays.points(), points)
        with self.assertRaises(ValueError):
            colours[0] = 1
        with self.assertRaises(ValueError):
            colours.flags.writeable = True
        del arrays
        self.assertIsNotNone(handle())
        del colours
        self.assertIsNone(handle(), "the last array frees it")


class Refusals(unittest.TestCase):
    def assert_status(self, status, call, *arguments, **named):
        with self.assertRaises(acentric.Error) as raised:
            call(*arguments, **named)
        self.assertEqual(raised.exception.status, status, raised.exception)
        self.assertTrue(raised.exception.message)
        return raised.exception

    def test_of_wrong_arguments(self):
        with acentric.open(WALK) as walk:
            view, wrong = VIEWS[0], acentric.Status.ARGUMENT
            change = dataclasses.replace
            for bad in (change(view, width=0), change(view, height=-5), change(view, width=2**32 + 160),
                        change(view, width=20000), change(view, fov=float("nan")), change(view, eye=(float("inf"), 0, 0)),
                        change(view, eye=(0, 0))):
                self.assert_status(wrong, walk.render, bad)
                self.assert_status(wrong, walk.render, bad, detail=None)
            self.assert_status(acentric.Status.OUTSIDE, walk.render, change(view, eye=(90.0, 0, 1.6)))
            settings = walk.settings
            for bad in (change(settings, renderer="gl"), change(settings, reconstruction="filtered"),
                        change(settings, max_splat_pixels=0), change(settings, max_splat_pixels=2**32 + 8)):
                self.assert_status(wrong, walk.render, view, bad)
            self.assert_status(wrong, walk.render, view, detail="half")
            self.assert_status(wrong, walk.load_capture, 2**32, 0)
            self.assert_status(wrong, walk.load_capture, 0, -1)
            self.assert_status(wrong, walk.unload_region, 0, 999)
            self.assert_status(wrong, walk.texture, 999)
            self.assert_status(wrong, walk.clamp, 0, (1, 2, 3))
            self.assert_status(wrong, setattr, walk, "threads", 0)
            for listing in (walk.storeys, walk.storeys[0].regions):
                with self.assertRaises(IndexError):
                    listing[len(listing)]
            with self.assertRaises(TypeError):
                walk.render(change(view, width=160.0))
        self.assert_status(wrong, acentric.open, WALK, threads=0)
        self.assert_status(wrong, acentric.open, "a\0b")
        with self.assertRaises(TypeError):
            acentric.open(42)

    def test_of_what_is_closed(self):
        walk = acentric.open(WALK)
        storey = walk.storeys[0]
        walk.render(VIEWS[0])
        walk.close()
        walk.close()
        self.assertTrue(walk.closed)
        for call in (lambda: walk.info, lambda: walk.storeys, lambda: storey.cameras[0], lambda: storey.regions[0],
                     lambda: walk.start_view(), lambda: walk.render(VIEWS[0]), lambda: walk.load(VIEWS[0]),
                     lambda: walk.capture_data(0, 0), lambda: walk.texture(0), lambda: walk.memory, walk.unload):
            self.assertIn("closed", self.assert_status(acentric.Status.ARGUMENT, call).message)

    def test_of_files_that_are_none(self):
        error = self.assert_status(acentric.Status.NOT_FOUND, acentric.open, FOLDER / "none.acentric")
        self.assertIsInstance(error, acentric.NotFound)
        self.assertIn("none.acentric", error.message)
        self.assertIn("bundle.json", self.assert_status(acentric.Status.NOT_FOUND, acentric.open, BUNDLE / "captures").message)
        self.assert_status(acentric.Status.MALFORMED, acentric.open, BUNDLE / "bundle.json")
        self.assert_status(acentric.Status.MALFORMED, acentric.open, io.BytesIO(bytes(4096)))
        self.assert_status(acentric.Status.UNREADABLE, acentric.open, io.BytesIO())
        self.assert_status(acentric.Status.MALFORMED, acentric.open, io.BytesIO(b"ACENTRIC"))

    def test_of_damaged_files_never_harm(self):
        whole = WALK.read_bytes()
        refused = 0
        for place in range(0, len(whole), max(1, len(whole) // 40)):
            content = bytearray(whole)
            content[place] ^= 0x55
            try:
                with acentric.open(Bytes(content)) as walk:
                    for view in VIEWS[::6]:
                        walk.render(view)
            except acentric.Error as error:
                self.assertIn(error.status, (acentric.Status.MALFORMED, acentric.Status.UNSUPPORTED), error)
                refused += 1
        self.assertGreater(refused, 10)
        for length in range(0, len(whole), len(whole) // 15):
            with self.assertRaises(acentric.Error):
                with acentric.open(Bytes(whole[:length])) as walk:
                    walk.render(VIEWS[0])

    def test_of_sources_that_fail(self):
        source = Bytes(WALK.read_bytes())
        walk = acentric.open(source)
        self.addCleanup(walk.close)

        def failing(error):
            def read_at(offset, count):
                raise error
            return read_at

        source.read_at = failing(ConnectionError("the line is dead"))
        raised = self.assert_status(acentric.Status.UNREADABLE, walk.render, VIEWS[0])
        self.assertIs(type(raised.__cause__), ConnectionError)
        source.read_at = failing(FileNotFoundError("gone"))
        self.assertIsInstance(self.assert_status(acentric.Status.NOT_FOUND, walk.load_capture, 0, 0), acentric.NotFound)
        source.read_at = lambda offset, count: b"short"
        self.assertIs(type(self.assert_status(acentric.Status.UNREADABLE, walk.render, VIEWS[0]).__cause__), EOFError)
        source.read_at = lambda offset, count: None
        self.assertIs(type(self.assert_status(acentric.Status.UNREADABLE, walk.render, VIEWS[0]).__cause__), TypeError)
        source.read_at = failing(KeyboardInterrupt())
        with self.assertRaises(KeyboardInterrupt):
            walk.render(VIEWS[0])
        for again in (walk.close, lambda: walk.memory, lambda: walk.info):  # while a call runs
            source.read_at = lambda offset, count: again()
            self.assertIs(type(self.assert_status(acentric.Status.UNREADABLE, walk.render, VIEWS[0]).__cause__), acentric.Error)
        del source.read_at
        np.testing.assert_array_equal(walk.render(VIEWS[0]).rgba, expected(0, "rgba", "u1", 4))
        for size in (-1, 2**64, 1.5):
            source.size = lambda: size
            self.assert_status(acentric.Status.UNREADABLE, acentric.open, source)


if __name__ == "__main__":
    warnings.simplefilter("error")
    unittest.main()
