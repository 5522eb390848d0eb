#!/usr/bin/env python3
"""What dynamic.py finds."""
import unittest

from dynamic import findings, loaded

LDD = """\tlinux-vdso.so.1 (0x00007ffd)
\tlibOpenMeshCore.so.9 => /lib/x86_64-linux-gnu/libOpenMeshCore.so.9 (0x00007f)
\tlibc.so.6 => /lib/x86_64-linux-gnu/libc.so.6 (0x00007f)
\t/lib64/ld-linux-x86-64.so.2 (0x00007f)
"""


class DynamicTest(unittest.TestCase):
    def test_libraries_of_ldd(self):
        self.assertEqual(loaded(LDD), ["libOpenMeshCore.so.9", "libc.so.6"])

    def test_sound(self):
        self.assertEqual(findings("module", ["libc.so.6"], ["luaopen_lissom"], False), [])
        self.assertEqual(findings("program", ["libc.so.6"], ["anything"], False), [])

    def test_cholmod(self):
        libraries = ["libcholmod.so.3", "libamd.so.2", "libopenblas.so.0"]
        self.assertIn("under the GPL: libcholmod.so.3", findings("program", libraries, [], False)[0])
        self.assertEqual(findings("program", libraries, [], True), [])
        self.assertIn("under the GPL: libcholmod.so.3", findings("library", libraries, ["lissom_call"], True)[0])
        self.assertIn("under the GPL: libcholmod.so.3", findings("module", libraries, ["luaopen_lissom"], True)[0])

    def test_readline_is_never_allowed(self):
        self.assertIn("libreadline.so.8", findings("program", ["libreadline.so.8"], [], True)[0])

    def test_too_many(self):
        found = findings("library", [f"lib{i}.so" for i in range(8)], ["lissom_mesh_load"], False)
        self.assertIn("loads 8 libraries, at most 7", found[0])

    def test_archives_define_nothing_of_tbb(self):
        self.assertEqual(findings("archive", [], ["_ZN10lissom_tbb6detail2r15spawnEv", "_ZN6lissom4MeshE"], False), [])
        found = findings("archive", [], ["_ZN3tbb6detail2r15spawnEv", "_ZTVN3tbb6detail2d14taskE"], False)
        self.assertIn("defines 2 names of oneTBB", found[0])

    def test_names_that_show(self):
        self.assertIn("shows 1 names", findings("module", [], ["luaopen_lissom", "_ZN6lissom4MeshE"], False)[0])
        self.assertEqual(findings("library", [], [], False), ["shows nothing"])

    def test_a_module_with_lua(self):
        self.assertIn("second Lua", findings("module", ["liblua5.4.so.0"], ["luaopen_lissom"], False)[0])

    def test_a_library_with_lua_inside(self):
        beside = (["liblua5.4.so.0"], ["lissom_call"], False)
        self.assertEqual(findings("library", *beside), [])
        self.assertIn("second Lua", findings("library", *beside, own_lua=True)[0])
        self.assertIn("shows 1 names", findings("library", [], ["lissom_call", "lua_call"], False, True)[0])


if __name__ == "__main__":
    unittest.main()
