#!/usr/bin/env python3
"""Exports presets on two heads by one command. Usage: grooms_test.py PROGRAM"""
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM = os.path.abspath(sys.argv.pop(1))
SCRIPTS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scripts")

HEADS = r'''
local lissom = require "lissom"
local head = lissom.shapes.head{ vertices = 3000 }
head:save("heads/small.obj")
head:transform{ scale = { 100, 110, 100 } }
head:save("heads/tall.obj")
'''

SMALL = {"count": 400, "resolution": 8000, "guides": 20, "points": 8, "cards": 20, "slots": 6, "atlas": 128,
         "size": 240, "shell": 200, "strand_levels": 2}


class Grooms(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="lissom-grooms-")
        os.mkdir(self.path("heads"))
        with open(self.path("heads.lua"), "w", encoding="utf-8") as file:
            file.write(HEADS)
        self.run_program("run", "heads.lua")

    def tearDown(self):
        shutil.rmtree(self.folder)

    def path(self, *parts):
        return os.path.join(self.folder, *parts)

    def run_program(self, *words):
        done = subprocess.run([PROGRAM, *words], cwd=self.folder, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout

    def batch(self, presets, *words):
        sets = [word for name, value in SMALL.items() for word in ("--set", f"{name}={value}")]
        return self.run_program("batch", os.path.join(SCRIPTS, "export_hair.lua"), "--over", "heads/*.obj",
                                "--sweep", "preset=" + presets, *sets, "--out", "out/{name}/{preset}", *words)

    def test_a_star_is_every_preset_on_every_head(self):
        jobs = json.loads(self.batch("*", "--list", "--json"))["jobs"]
        presets = sorted(name[:-4] for name in os.listdir(os.path.join(SCRIPTS, "presets")))
        self.assertEqual(sorted(job["output"] for job in jobs),
                         [f"out/{head}/{preset}" for head in ("small", "tall") for preset in presets])

    def test_each_folder_has_what_its_manifest_names(self):
        self.batch("bob,afro")
        for head in ("small", "tall"):
            for preset in ("bob", "afro"):
                self.check_folder(preset, "out", head, preset)

    def check_folder(self, preset, *folder):
        with open(self.path(*folder, "manifest.json"), encoding="utf-8") as file:
            manifest = json.load(file)
        self.assertEqual(manifest["preset"], preset)
        levels = manifest["levels"]
        self.assertEqual([level["kind"] for level in levels],
                         ["strands", "strands", "cards", "cards", "cards", "shell"])
        files = [manifest["guides"]["file"], manifest["rig"]["file"], *manifest["pictures"]]
        for level in levels:
            files += [level["file"], *level.get("atlas", {}).values()]
            self.assertLessEqual(0, level["silhouette"]["mean"])
            self.assertLessEqual(level.get("cards", 0), SMALL["cards"])
        for name in files:
            self.assertGreater(os.path.getsize(self.path(*folder, name)), 0, name)
        sizes = [level["screen_size"] for level in levels]
        self.assertEqual(sizes[:2], sorted(sizes[:2], reverse=True))


if __name__ == "__main__":
    unittest.main()
