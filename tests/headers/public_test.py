#!/usr/bin/env python3
"""What public.py finds."""
import tempfile
import unittest
from pathlib import Path

import public

LISTS = {"kernel": "# Words.\n\nmesh/mesh.h\nvia mesh/soup.h\n", "bindings": "c/lissom.h\n", "viewer": "picture.h\n"}
FILES = {"kernel/mesh/mesh.h": '#include <Eigen/Core>\n#include <vector>\n\n#include "kernel/mesh/soup.h"\n',
         "kernel/mesh/soup.h": "", "kernel/mesh/secret.h": "",
         "bindings/c/lissom.h": "#include <stdint.h>\n", "viewer/picture.h": '#include "kernel/mesh/mesh.h"\n'}


class PublicTest(unittest.TestCase):
    def findings(self, lists=None, files=None):
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder)
            texts = {f"{name}/public_headers.txt": text for name, text in {**LISTS, **(lists or {})}.items()}
            for name, text in {**FILES, **texts, **(files or {})}.items():
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text(text)
            return public.findings(root)

    def test_a_complete_list(self):
        self.assertEqual(self.findings(), [])

    def test_a_private_header_is_included(self):
        found = self.findings(files={"kernel/mesh/soup.h": '#include "kernel/mesh/secret.h"\n'})
        self.assertEqual(found, ["kernel/mesh/soup.h: includes kernel/mesh/secret.h, which is private"])

    def test_many_private_headers_come_along(self):
        names = [f"mesh/h{i}.h" for i in range(public.MOST_DRAGGED)]
        lists = {"kernel": LISTS["kernel"] + "".join(f"via {name}\n" for name in names)}
        files = {f"kernel/{name}": "" for name in names}
        files["kernel/mesh/mesh.h"] = "".join(f'#include "kernel/{name}"\n' for name in [*names, "mesh/soup.h"])
        self.assertEqual(self.findings(lists, files), ["kernel: 16 private headers come along: at most 15 may"])

    def test_a_library_shows(self):
        found = self.findings(files={"kernel/mesh/soup.h": "#include <tiny_gltf.h>\n#include <cmath>\n"})
        self.assertEqual(found, ["kernel/mesh/soup.h: shows <tiny_gltf.h>"])

    def test_installed_for_nothing(self):
        found = self.findings(lists={"kernel": LISTS["kernel"] + "via mesh/secret.h\n"})
        self.assertEqual(found, ["kernel/mesh/secret.h: marked via, and nothing public includes it"])

    def test_listed_twice_and_missing(self):
        found = self.findings(lists={"viewer": "picture.h\npicture.h\nother.h\n"})
        self.assertEqual(found, ["viewer/picture.h: listed twice", "viewer/other.h: is not there"])

    def test_two_of_a_name(self):
        found = self.findings(lists={"bindings": "c/lissom.h\nengine/lissom.h\n"},
                              files={"bindings/engine/lissom.h": ""})
        self.assertEqual(found, ["lissom/lissom.h: two headers of this name"])

    def test_a_header_beside(self):
        found = self.findings(files={"bindings/c/lissom.h": '#include "other.h"\n'})
        self.assertEqual(found, ["bindings/c/lissom.h: includes bindings/c/other.h, which is private"])


if __name__ == "__main__":
    unittest.main()
