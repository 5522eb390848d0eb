#!/usr/bin/env python3
"""Tests the Python package `lissom` that is on the path. Usage: python_test.py ABI_TXT [TEST...]"""
import array
import asyncio
import ctypes
import gc
import inspect
import math
import os
import sys
import tempfile
import threading
import unittest

import lissom
from lissom import _abi

ABI = os.path.abspath(sys.argv.pop(1))

try:
    import numpy
except ImportError:
    numpy = None

POSITIONS = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
CORNERS = [0, 1, 2, 0, 2, 3]


def sphere():
    return lissom.call("shapes.sphere", segments=10, kind="triangles")


class Interface(unittest.TestCase):
    def test_types_are_those_of_the_list_of_the_abi(self):
        """Sizes, offsets and functions agree with abi.txt; what has come since its release is more."""
        counts = {}
        with open(ABI, encoding="ascii") as file:
            lines = [line.split() for line in file]
        for kind, name, *rest in lines:
            counts[kind] = counts.get(kind, 0) + 1
            if kind == "struct":
                grows = getattr(_abi, name)._fields_[0][0] == "struct_size"
                compare = self.assertGreaterEqual if grows else self.assertEqual
                compare(ctypes.sizeof(getattr(_abi, name)), int(rest[0]), name)
            elif kind == "field":
                field = getattr(getattr(_abi, name.split(".")[0]), name.split(".")[1])
                self.assertEqual((field.offset, field.size), (int(rest[0]), int(rest[1])), name)
            elif kind in ("function", "experimental"):
                symbols = [entry for entry in _abi.FUNCTIONS.values() if entry[0] == name]
                self.assertEqual(len(symbols), 1, name)
                parameters = rest[0].split("(", 1)[1].rsplit(")", 1)[0]
                count = 0 if parameters in ("", "void") else parameters.count(",") + 1
                self.assertEqual(len(symbols[0][2]), count, name)
        self.assertLessEqual(counts["function"] + counts["experimental"], len(_abi.FUNCTIONS))
        self.assertGreater(counts["field"], 100)

    def test_each_function_is_a_method_with_help_and_hints(self):
        count = 0
        for kind in (lissom.Mesh, lissom.Region, lissom.Deformer, lissom.Pose, lissom.PoseSpace, lissom.Merger,
                     lissom.Paste, lissom.Hairstyle, lissom.Strands, lissom.RenderMap, lissom.Script, lissom.Object):
            self.assertTrue(kind.__doc__)
            for name, method in vars(kind).items():
                method = method.fget if isinstance(method, property) else getattr(method, "__func__", method)
                if name.startswith("_") or not inspect.isfunction(method):
                    continue
                count += 1
                self.assertTrue(method.__doc__, name)
                self.assertIn("return", method.__annotations__, name)
                for word in ("NULL", "LISSOM_", "lissom_"):
                    self.assertNotIn(word, method.__doc__.replace("lissom_basis.h", ""), f"{kind.__name__}.{name}")
        self.assertGreater(count, 100)
        self.assertTrue(os.path.exists(os.path.join(os.path.dirname(lissom.__file__), "py.typed")))


class Meshes(unittest.TestCase):
    def test_lists_go_in_and_come_out(self):
        mesh = lissom.Mesh.create(POSITIONS, CORNERS)
        self.assertEqual((mesh.vertex_count, mesh.face_count, mesh.boundary_count), (4, 2, 1))
        self.assertEqual([tuple(row) for row in mesh.positions().tolist()], POSITIONS)
        self.assertEqual(mesh.triangles().tolist(), [[0, 1, 2], [0, 2, 3]])
        corners, sizes = mesh.faces()
        self.assertEqual((corners.tolist(), sizes.tolist()), (CORNERS, [3, 3]))
        self.assertEqual(mesh.bounds(), ((0, 0, 0), (1, 1, 0)))
        self.assertEqual(sorted(mesh.boundary(0).tolist()), [0, 1, 2, 3])

    def test_memory_is_read_and_written_in_place(self):
        given = array.array("f", [number for row in POSITIONS for number in row])
        mesh = lissom.Mesh.create(given, array.array("H", CORNERS))
        out = array.array("f", bytes(4 * 12))
        self.assertIs(mesh.positions(out=out), out)
        self.assertEqual(out, given)
        # Positions among other numbers: rows of five, of which three are taken.
        rows = memoryview(array.array("d", bytes(8 * 20))).cast("B").cast("d", (4, 5))
        with self.assertRaises(ValueError):
            lissom.Mesh.create(given[:11], CORNERS)
        with self.assertRaises((ValueError, lissom.Error)):
            mesh.positions(out=rows)
        with self.assertRaises(lissom.Error) as raised:
            mesh.positions(out=array.array("f", bytes(4 * 9)))
        self.assertEqual(raised.exception.code, "out_of_range")

    @unittest.skipUnless(numpy, "numpy is not installed")
    def test_arrays_of_numpy_of_any_form(self):
        wide = numpy.zeros((4, 5), numpy.float32)
        wide[:, 1:4] = POSITIONS
        mesh = lissom.Mesh.create(wide[:, 1:4], numpy.array(CORNERS, numpy.int64))
        self.assertTrue((mesh.positions() == numpy.array(POSITIONS)).all())
        mesh.set_positions(numpy.asfortranarray(numpy.array(POSITIONS) * 2.0))
        mesh.positions(out=wide[:, :3])
        self.assertTrue((wide[:, :3] == 2 * numpy.array(POSITIONS)).all() and (wide[:, 4] == 0).all())
        frozen = numpy.array(POSITIONS, float)
        frozen.flags.writeable = False
        mesh.set_positions(frozen)
        with self.assertRaises((ValueError, BufferError)):
            mesh.positions(out=frozen)
        with self.assertRaises(ValueError):
            mesh.set_positions(numpy.zeros((4, 2)))

    def test_attributes_and_labels(self):
        mesh = lissom.Mesh.create(POSITIONS, CORNERS)
        mesh.write_attribute("uv", "vertices", 2, [(0, 0), (1, 0), (1, 1), (0, 1)])
        self.assertEqual(mesh.attribute("uv").tolist(), [[0, 0], [1, 0], [1, 1], [0, 1]])
        self.assertEqual(mesh.attribute_named("uv").width, 2)
        self.assertEqual(mesh.attribute_at(mesh.attribute_count - 1).name, "uv")
        mesh.write_labels("material", ["wood", "stone"], [1, 0])
        self.assertEqual((mesh.labels("material").tolist(), mesh.label_name("material", 0)), ([1, 0], "wood"))
        with self.assertRaises(ValueError) as raised:
            mesh.write_attribute("x", "nowhere", 1, [1, 2, 3, 4])
        self.assertIn("vertices, corners, faces", str(raised.exception))

    def test_files_and_bytes_with_options(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "\u00fc b.ply")
            mesh = sphere()
            mesh.save(path)
            self.assertEqual(lissom.Mesh.load(path).hash(), mesh.hash())
            text = mesh.encode("ply", binary=False)
            self.assertTrue(text.startswith(b"ply\nformat ascii"))
            self.assertEqual(lissom.Mesh.decode(text, "ply", repair=False).face_count, mesh.face_count)
            with self.assertRaises(lissom.Error) as raised:
                lissom.Mesh.load(os.path.join(folder, "none.ply"))
            self.assertEqual(raised.exception.code, "file_not_found")
            with self.assertRaises(TypeError):
                mesh.save(path, binry=False)

    def test_errors_name_their_elements(self):
        with self.assertRaises(lissom.Error) as raised:
            lissom.Mesh.create(POSITIONS, [0, 1, 2, 0, 1, 2])
        error = raised.exception
        self.assertEqual((error.code, error.element, error.count), ("duplicate_face", "face", len(error.ids)))
        self.assertIn("[duplicate_face]", str(error))
        mesh = lissom.Mesh.create(POSITIONS, CORNERS)
        with self.assertRaises(lissom.Error) as raised:
            lissom.Region.of_vertices(mesh, [0, 9])
        self.assertEqual((raised.exception.code, raised.exception.element, raised.exception.ids), ("out_of_range", "vertex", [9]))


class Objects(unittest.TestCase):
    def test_objects_are_freed_with_their_last_name(self):
        with lissom.Context() as context:
            mesh = lissom.Mesh.create(POSITIONS, CORNERS, context=context)
            copies = [mesh.copy() for _ in range(10)]
            self.assertEqual(context.object_count, 11)
            del copies
            gc.collect()
            self.assertEqual(context.object_count, 1)
            mesh.release()
            self.assertEqual(context.object_count, 0)
            with self.assertRaises(lissom.Error) as raised:
                mesh.positions()
            self.assertEqual(raised.exception.code, "invalid_handle")
        with self.assertRaises(lissom.Error):
            context.call("shapes.box")

    def test_a_handle_is_one_object(self):
        mesh = sphere()
        self.assertIs(lissom.call("Mesh.transform", mesh, scale=2), mesh)

    def test_wrong_kinds_are_told(self):
        mesh = sphere()
        with self.assertRaises(TypeError):
            lissom.Region.all(lissom.Region.all(mesh))
        with self.assertRaises(TypeError):
            lissom.Mesh()
        with lissom.Context() as other:
            with self.assertRaises(lissom.Error) as raised:
                lissom.Mesh.create(POSITIONS, CORNERS, context=other).merge(mesh)
            self.assertEqual(raised.exception.code, "invalid_handle")

    def test_contexts_work_in_their_own_threads(self):
        hashes = []

        def work():
            with lissom.Context(threads=1) as context:
                hashes.append(context.call("shapes.sphere", segments=20).hash())

        threads = [threading.Thread(target=work) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(len(hashes), 4)
        self.assertEqual(len(set(hashes)), 1)

    def test_a_failing_progress_stops_the_call(self):
        def progress(_label, _fraction):
            raise KeyboardInterrupt

        with lissom.Context(progress=progress) as context:
            mesh = context.call("shapes.sphere", segments=60)
            deformer = lissom.Deformer.create(mesh)
            deformer.pin(lissom.Region.sphere(mesh, (0, -1, 0), 0.5))
            with self.assertRaises(KeyboardInterrupt):
                deformer.prepare()
            self.assertEqual(mesh.boundary_count, 0)
            self.assertEqual(mesh.copy().hash(), mesh.hash())

    def test_a_space_of_the_host(self):
        with lissom.Context(z_up=True) as context:
            mesh = lissom.Mesh.create([(0, 0, 0), (1, 0, 0), (0, 0, 1)], [0, 1, 2], context=context)
            self.assertEqual(mesh.bounds()[1], (1, 0, 1))
            self.assertEqual(context.call("Mesh.bounds", mesh)["max"][1], 1)


class Work(unittest.TestCase):
    def test_a_deformation_by_handles(self):
        mesh = sphere()
        before = mesh.positions().tolist()
        deformer = lissom.Deformer.create(mesh)
        deformer.pin(lissom.Region.plane(mesh, (0, -0.5, 0), (0, -1, 0)))
        top = deformer.add_handle(lissom.Region.plane(mesh, (0, 0.8, 0), (0, 1, 0)))
        deformer.set_transform(top, [[1, 0, 0, 0.5], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
        self.assertEqual(deformer.get_transform(top)[3], 0.5)
        deformer.solve()
        self.assertEqual(len(deformer.positions().tolist()), deformer.row_count)
        deformer.apply(mesh)
        moved = [a[0] - b[0] for a, b in zip(mesh.positions().tolist(), before)]
        self.assertAlmostEqual(max(moved), 0.5, places=2)
        self.assertEqual(min(moved[i] for i, p in enumerate(before) if p[1] < -0.5), 0)
        report = deformer.report(mesh, True)
        self.assertEqual((report.harms, report.crossings), (0, 0))
        with self.assertRaises(ValueError):
            deformer.solve("best")
        deformer.solve("preview")
        self.assertEqual(lissom.Deformer.create(mesh, second="laplacian").row_count, mesh.vertex_count)
        with self.assertRaises(ValueError):
            lissom.Deformer.create(mesh, second="none")

    def test_bones_reach(self):
        mesh = lissom.call("shapes.bar", across=4, along=20)
        deformer = lissom.Deformer.create(mesh)
        bones = deformer.add_bones(mesh, [[0, -1.5, 0], [0, 0.5, 0], [0, 2.5, 0]], limits=[2.0, 2.0])
        deformer.turn_bone(bones, 1, (0, 0, 1), 0.5)
        self.assertLess(deformer.reach_with_bones(bones, (1, 1, 0), (0, 0, 1)), 1e-8)
        self.assertEqual(deformer.joint_count(bones), 3)
        self.assertAlmostEqual(deformer.joints(bones).tolist()[2][0], 1, places=8)
        deformer.follow_with_bones(bones, [[0, -1.5, 0], [1, 0, 0], [2, 0, 0]], False, 0.0)
        self.assertAlmostEqual(deformer.joints(bones).tolist()[0][1], -1.5, places=8)
        deformer.solve()
        deformer.remove_bones(bones)
        with self.assertRaises(lissom.Error) as raised:
            deformer.reset_bones(bones)
        self.assertEqual(raised.exception.code, "handle_removed")

    def test_pins_slide(self):
        mesh = lissom.call("shapes.bar", across=2, along=10)
        deformer = lissom.Deformer.create(mesh)
        deformer.pin(lissom.Region.named(mesh, "bottom"))
        top = deformer.add_handle(lissom.Region.named(mesh, "top"))
        deformer.set_transform(top, [[1, 0, 0, 1], [0, 1, 0, 0], [0, 0, 1, 0]])
        rows = deformer.rows().tolist()
        free = min(rows, key=lambda v: abs(mesh.positions().tolist()[v][1]))
        pin = {"vertex": free, "on": "plane", "point": (-0.2, 0, 0), "direction": (1, 0, 0)}
        self.assertLess(deformer.solve_with_pins([pin]), 1e-9)
        self.assertAlmostEqual(deformer.positions().tolist()[rows.index(free)][0], -0.2, places=8)

    def test_poses_blend(self):
        mesh = sphere()
        deformer = lissom.Deformer.create(mesh)
        top = deformer.add_handle(lissom.Region.plane(mesh, (0, 0.8, 0), (0, 1, 0)))
        deformer.pin(lissom.Region.plane(mesh, (0, -0.5, 0), (0, -1, 0)))
        rest = deformer.get_pose()
        deformer.set_transform(top, [[1, 0, 0, 0.5], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
        moved = deformer.get_pose()
        deformer.set_pose(rest.blend(moved, 0.4))
        self.assertAlmostEqual(deformer.get_transform(top)[3], 0.2)
        deformer.set_blended_pose(rest, moved, 0.6)
        self.assertAlmostEqual(deformer.get_transform(top)[3], 0.3)

    def test_meshes_blend_in_a_space_of_poses(self):
        mesh, posed, half = sphere(), sphere(), sphere()
        half.transform([[1, 0, 0, 1], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
        posed.transform([[1, 0, 0, 2], [0, 1, 0, 0], [0, 0, 1, 1], [0, 0, 0, 1]])
        space = lissom.PoseSpace.create(mesh, {"away": [half, posed], "moved": half})
        self.assertEqual((space.pose_count, space.pose_name(1)), (2, "moved"))
        self.assertEqual(space.positions([0.5, 0]).tolist(), half.positions().tolist())
        self.assertEqual(space.blend([1, 0]).positions().tolist(), posed.positions().tolist())
        made, report = space.targets([0.5, 0.5])
        self.assertEqual((report.pose_targets, report.correctives), (2, 2))
        self.assertEqual(made.vertex_count, mesh.vertex_count)
        self.assertEqual(space.targets()[1].correctives, 1)
        with self.assertRaises(lissom.Error) as raised:
            space.blend([1])
        self.assertEqual(raised.exception.code, "invalid_argument")
        job = lissom.PoseSpace.begin_create(mesh, {"moved": posed})
        self.assertEqual(job.finish().pose_count, 1)

    def test_a_merge_has_a_report(self):
        upper = sphere().cut_by_plane((0, 0, 0), (0, 1, 0))[0]
        lower = sphere().cut_by_plane((0, 0, 0), (0, -1, 0))[0]
        mesh, report = upper.merge(lower, [lissom.Join(0, 0, 0)], smooth=2)
        self.assertEqual(mesh.boundary_count, 0)
        self.assertTrue(report.ok, report.verdict)
        merger = lissom.Merger.create(upper, [lower])
        self.assertEqual(merger.solve()[0].boundary_count, 0)

    def test_hair_grows_along_a_curve(self):
        head = lissom.call("shapes.head")
        style = lissom.Hairstyle.create(head)
        points = [style.at(math.radians(a), math.radians(60 - 40 * i), 0.01) for i, a in enumerate((10, 75, 90))]
        style.add_stream(points)
        strands = style.grow(count=200, length=0.1)
        self.assertEqual(strands.size, 200)
        self.assertEqual(len(strands.points().tolist()), strands.point_count)
        self.assertEqual(strands.offsets().tolist()[-1], strands.point_count)
        self.assertEqual(len(strands.read("width").tolist()), 200)
        strands.write("color", [(1, 0, 0)] * 200)
        self.assertEqual(strands.read("color").tolist()[7], [1, 0, 0])
        strands.set_groups(["a", "b"])
        self.assertEqual((strands.group_count, strands.group_name(1)), (2, "b"))

    def test_jobs_are_finished_or_awaited(self):
        mesh = sphere()
        deformer = lissom.Deformer.create(mesh)
        deformer.pin(lissom.Region.sphere(mesh, (0, -1, 0), 0.5))
        job = deformer.begin_prepare()
        self.assertIsNone(job.finish())
        self.assertTrue(job.is_done())
        self.assertIsNone(job.finish())

        async def both():
            upper = sphere().cut_by_plane((0, 0, 0), (0, 1, 0))[0]
            lower = sphere().cut_by_plane((0, 0, 0), (0, -1, 0))[0]
            with tempfile.TemporaryDirectory() as folder:
                path = os.path.join(folder, "a.obj")
                await upper.begin_save(path)
                loaded = await lissom.Mesh.begin_load(path)
            merged, report = await upper.begin_merge(lower)
            kept, rest = await merged.cut_begin_by_plane((0, 0, 0), (1, 0, 0))
            return loaded, merged, report, kept, rest

        loaded, merged, report, kept, rest = asyncio.run(both())
        self.assertEqual((loaded.boundary_count, merged.boundary_count, report.ok), (1, 0, True))
        self.assertEqual((kept.boundary_count, rest.boundary_count), (1, 1))
        with self.assertRaises(lissom.Error):
            lissom.Mesh.begin_load("/none.obj").finish()

    def test_a_cancelled_task_cancels_its_job(self):
        script = lissom.Script.load("while true do end", "endless")

        async def impatient():
            await asyncio.wait_for(script.begin_run(), 0.1)

        with self.assertRaises(asyncio.TimeoutError):
            asyncio.run(impatient())
        self.assertEqual(lissom.Script.load("return 1", "next").run(), 1)


class Scripts(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()

    def tearDown(self):
        self.folder.cleanup()

    def write(self, text):
        path = os.path.join(self.folder.name, "script.lua")
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return path

    def test_a_script_takes_parameters_and_objects(self):
        path = self.write("""
            local lissom = require "lissom"
            local p = lissom.params{ path = { type = "string", default = "" }, height = { type = "number", default = 1, max = 90 }, mesh = { type = "file" },
                closed = { type = "boolean", default = false } }
            local mesh, options = lissom.load(p.mesh), ...
            return mesh, p.height, p.closed, options and options.mesh:vertex_count()""")
        mesh = sphere()
        result, height, closed, count = lissom.run(path, {"mesh": mesh}, height=30, mesh=mesh, closed=True, path="x")
        self.assertEqual(result.vertex_count, mesh.vertex_count)
        self.assertEqual((height, closed, count), (30, True, mesh.vertex_count))
        for wrong in ({"hight": 3}, {"height": 300}):
            with self.assertRaises(lissom.Error) as raised:
                lissom.run(path, mesh=mesh, **wrong)
            self.assertEqual(raised.exception.code, "invalid_argument")
        with self.assertRaises(TypeError):
            lissom.run(path, mesh=lissom.Region.all(mesh))
        described = {one["name"]: one for one in lissom.load_script(path).parameters()}
        self.assertEqual((described["height"]["type"], described["height"]["max"]), ("number", 90))

    def test_the_example_of_the_page_runs(self):
        page = os.path.join(os.path.dirname(os.path.abspath(ABI)), "..", "python", "README.md")
        with open(page, encoding="utf-8") as file:
            code = file.read().split("```python\n")[1].split("```")[0]
        before = os.getcwd()
        os.chdir(self.folder.name)
        try:
            exec(compile(code, "README.md", "exec"), {})  # pylint: disable=exec-used
            bent = lissom.Mesh.load("bent.obj")
        finally:
            os.chdir(before)
        self.assertGreater(bent.bounds()[1][0], 0.5)

    def test_an_error_of_a_script_has_its_line(self):
        with self.assertRaises(lissom.Error) as raised:
            lissom.run(self.write("\n\nerror('on purpose')"))
        self.assertEqual(raised.exception.code, "script_error")
        self.assertIn("script.lua:3: on purpose", str(raised.exception))

    def test_results_are_none_one_or_several(self):
        self.assertIsNone(lissom.run(self.write("")))
        self.assertEqual(lissom.run(self.write("return ...").strip(), [1, {"a": "b"}]), [1, {"a": "b"}])
        self.assertEqual(lissom.run(self.write("return 1, 'x'")), (1, "x"))

    def test_untrusted_scripts_are_held_in_a_sandbox(self):
        with lissom.Context() as context:
            context.sandbox(seconds=0.2)
            with self.assertRaises(lissom.Error) as raised:
                lissom.run(self.write("while true do end"), context=context)
            self.assertEqual(raised.exception.code, "cancelled")


if __name__ == "__main__":
    unittest.main()
