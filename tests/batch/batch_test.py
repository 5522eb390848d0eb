#!/usr/bin/env python3
"""Tests `lissom batch` from outside: its plan, what runs again and why, and what is left after kills.
LISSOM_TRIALS is the number of random kills. Usage: batch_test.py PROGRAM"""
import csv
import fcntl
import glob
import json
import os
import pty
import random
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAM = os.path.abspath(sys.argv.pop(1))
TRIALS = int(os.environ.get("LISSOM_TRIALS", "30"))

# Writes its parameters into its output; `mode` makes it fail in a way.
SCRIPT = r'''
local lissom = require "lissom"
local p = lissom.params{
    number = { type = "number", default = 0, min = -1000, max = 1000 },
    count = { type = "integer", default = 1, min = 0 },
    mode = { type = "choice", default = "good", choices = { "good", "fails", "usage", "nothing", "never_ends", "dies",
        "warns", "orphan" } },
    text = { type = "string", default = "" },
    mesh = { type = "file", default = "" },
    out = { type = "file", default = "out.txt" },
}
local word = require "word"
if p.mode == "fails" then error("on purpose") end
if p.mode == "usage" then os.exit(2) end
if p.mode == "nothing" then return end
if p.mode == "never_ends" then while true do end end
if p.mode == "dies" then os.execute("kill -SEGV $PPID") end
if p.mode == "warns" then lissom.load("odd.obj") end
local faces = p.mesh ~= "" and lissom.load(p.mesh):face_count() or 0
local file = assert(io.open(p.out, "w"))
file:write(string.format("%s %.17g %d %s %d\n", word, p.number, p.count, p.text, faces))
file:close()
if p.mode == "orphan" then os.execute("sleep 2 >/dev/null 2>&1 &") end
'''

TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"


def children_of(process):
    """Processes that it has started."""
    try:
        with open(f"/proc/{process.pid}/task/{process.pid}/children", encoding="ascii") as file:
            return [int(word) for word in file.read().split()]
    except OSError:
        return []


class Folder(unittest.TestCase):
    """A test with a folder of its own, in which the program runs."""

    def setUp(self):
        self.folder = os.path.realpath(tempfile.mkdtemp(prefix="lissom-batch-"))
        self.write("make.lua", SCRIPT)
        self.write("word.lua", 'return "word"')

    def tearDown(self):
        # The last task of a cluster may still write its summary.
        for _ in range(50):
            shutil.rmtree(self.folder, ignore_errors=True)
            if not os.path.exists(self.folder):
                break
            time.sleep(0.1)

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def write(self, name, text):
        os.makedirs(os.path.dirname(self.path(name)), exist_ok=True)
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)

    def read(self, *names):
        with open(self.path(*names), encoding="utf-8") as file:
            return file.read()

    def words(self, *words):
        return [PROGRAM, "batch", *words]

    def batch(self, *words, status=0, environment=None):
        run = subprocess.run(self.words(*words), cwd=self.folder, capture_output=True, text=True, timeout=300,
                             env=environment, check=False, errors="replace")
        self.assertEqual(run.returncode, status, run.stdout + run.stderr)
        return run

    def plan(self, *words):
        return json.loads(self.batch(*words, "--list", "--json").stdout)["jobs"]

    def reasons(self, *words):
        return [job["reason"] for job in self.plan(*words)]

    def outputs(self, folder="out"):
        found = {}
        for at, folders, files in os.walk(self.path(folder)):
            folders[:] = [name for name in folders if name != ".batch"]
            for name in files:
                if name not in ("index.html", "summary.csv", "summary.json"):
                    path = os.path.join(at, name)
                    with open(path, "rb") as file:
                        found[os.path.relpath(path, self.path(folder))] = file.read()
        return found


class Plans(Folder):
    def test_axes_multiply_and_the_last_varies_fastest(self):
        jobs = self.plan("make.lua", "--sweep", "number=0:1:0.5", "--sweep", "count=1,2", "--set", "text=x",
                         "--out", "out/{number}/{count}.txt")
        self.assertEqual([job["output"] for job in jobs],
                         [f"out/{n}/{c}.txt" for n in ("0", "0.5", "1") for c in (1, 2)])
        self.assertEqual(jobs[0]["arguments"], {"number": "0", "count": "1", "text": "x"})
        self.assertFalse(os.path.exists(self.path("out")))

    def test_a_star_takes_all_choices_of_a_parameter(self):
        jobs = self.plan("make.lua", "--sweep", "mode=*", "--out", "out/{mode}.txt")
        self.assertEqual([job["arguments"]["mode"] for job in jobs][:2], ["good", "fails"])
        jobs = self.plan("make.lua", "--sweep", "text=*", "--out", "out/{n}.txt")
        self.assertEqual([job["arguments"]["text"] for job in jobs], ["*"])

    def test_files_and_rows_of_a_table_are_axes(self):
        for name in ("in/a.obj", "in/deep/b c.obj", "in/ü.obj"):
            self.write(name, TRIANGLE)
        jobs = self.plan("make.lua", "--over", "in/**/*.obj", "--out", "out/{dir}/{name}.{ext}")
        self.assertEqual([job["output"] for job in jobs], ["out/a.obj", "out/deep/b c.obj", "out/ü.obj"])
        self.write("t.csv", 'text,number,label\n"a, ""b""",1,one\nc,2,two\n')
        jobs = self.plan("make.lua", "--over", "t.csv", "--out", "out/{label}.txt")
        self.assertEqual([job["arguments"] for job in jobs],
                         [{"text": 'a, "b"', "number": "1"}, {"text": "c", "number": "2"}])

    def test_wrong_plans_are_usage_errors_that_say_why(self):
        self.write("torn.csv", "number,text\n1,a\n2\n")
        self.write("strange.csv", "numbr\n1\n")
        self.write("none.lua", "print(1)")
        for text, *words in (
                ("did you mean 'number'", "make.lua", "--sweep", "numbr=1", "--out", "o/{n}"),
                ("number from -1000 to 1000 expected", "make.lua", "--sweep", "number=1,2000", "--out", "o/{n}"),
                ("no value for {numbr}, did you mean 'number'", "make.lua", "--sweep", "number=1", "--out", "{numbr}"),
                ("both write o/1", "make.lua", "--sweep", "number=1,2", "--out", "o/1"),
                ("outside of", "make.lua", "--sweep", "number=1", "--out", "o/{n}/../../x"),
                ("never ends", "make.lua", "--sweep", "number=0:9:-1", "--out", "o/{n}"),
                ("there is no folder 'nothing'", "make.lua", "--over", "nothing/*.obj", "--out", "o/{n}"),
                ("matches '*.obj'", "make.lua", "--over", "*.obj", "--out", "o/{n}"),
                ("torn.csv:3: the row has 1 value for 2 columns", "make.lua", "--over", "torn.csv", "--out", "o/{n}"),
                ("did you mean 'number'", "make.lua", "--over", "strange.csv", "--out", "o/{n}"),
                ("given twice", "make.lua", "--sweep", "number=1", "--set", "number=2", "--out", "o/{n}"),
                ("no such file", "make.lua", "--set", "mesh=nix.obj", "--out", "o/{n}"),
                ("declares no parameters", "none.lua", "--out", "o/{n}"),
                ("no such file", "nix.lua", "--out", "o/{n}"),
                ("write over the input", "make.lua", "--set", "mesh=word.lua", "--out", "word.lua"),
                ("--out is missing", "make.lua"),
                ("SCRIPT is missing", "--out", "o/{n}")):
            run = self.batch(*words, status=2)
            self.assertIn(text, run.stderr)
        self.assertFalse(os.path.exists(self.path("o")))

    def test_mistakes_of_beginners_are_told_with_what_to_write(self):
        for name in ("in/a.obj", "in/b.obj", "in/c.obj"):
            self.write(name, TRIANGLE)
        self.write("no_out.lua", 'require("lissom").params{ mesh = { type = "file" }, size = { type = "number", default = 1 } }')
        self.write("no_file.lua", 'require("lissom").params{ mesh = { type = "string" }, out = { type = "file" } }')
        out = ("--out", "o/{name}.obj")
        for text, *words in (
                # The shell has replaced a pattern without quotes.
                ("--over 'in/*.obj'", "make.lua", "--over", "in/a.obj", "in/b.obj", "in/c.obj", *out),
                ("files are given by --over 'in/*.obj'", "make.lua", "in/*.obj", *out),
                ("files are given by --over", "make.lua", "--in", "in/*.obj", *out),
                ("given by --set number=VALUE, or by --sweep number=", "make.lua", "--number", "3", "--out", "o/{n}"),
                ("did you mean '--sweep'", "make.lua", "--swep", "number=3", "--out", "o/{n}"),
                ("there is: mesh, name, stem, ext, dir, count, mode, number, text, n", "make.lua", "--over", "in/*.obj",
                 "--out", "o/{filename}.obj"),
                ("o/ is a folder: add the name of the file, as o/{name}.obj", "make.lua", "--over", "in/*.obj", "--out", "o/"),
                ("needs a placeholder that tells them apart, as {name}", "make.lua", "--over", "in/*.obj", "--out", "o"),
                ("needs a placeholder that tells them apart, as {count}", "make.lua", "--over", "in/*.obj",
                 "--sweep", "count=1,2", *out),
                ("FROM:TO:STEP", "make.lua", "--sweep", "number=-30:30", "--out", "o/{n}"),
                ("FROM:TO:STEP", "make.lua", "--sweep", "number=[1,2]", "--out", "o/{n}"),
                ('declare out = { type = "file"', "no_out.lua", "--over", "in/*.obj", *out),
                ("or name another (mesh): --out NAME=", "no_out.lua", "--sweep", "size=1,2", *out),
                ("name the one that takes the files: --over NAME=in/*.obj", "no_file.lua", "--over", "in/*.obj", *out),
                ("--timeout: Value 1m not in range 0", "make.lua", "--timeout", "1m", "--out", "o/{n}"),
                ("not in range 1 to 1024", "make.lua", "--jobs", "0", "--out", "o/{n}")):
            self.assertIn(text, self.batch(*words, status=2).stderr)
        self.assertFalse(os.path.exists(self.path("o")))
        jobs = self.plan("no_file.lua", "--over", "mesh=in/*.obj", *out)
        self.assertEqual([job["output"] for job in jobs], ["o/a.obj", "o/b.obj", "o/c.obj"])

    def test_tables_of_spreadsheets_are_read(self):
        for text in ("\ufeffnumber;text\r\n1;a,b\r\n2;c\r\n", "number\ttext\n1\ta,b\n2\tc\n",
                     'number, text\n 1, "a,b"\n2 ,c \n', 'number,text,\r\n1,"a,b",\r\n,,\r\n2,c,\r\n'):
            self.write("t.csv", text)
            self.assertEqual([job["arguments"] for job in self.plan("make.lua", "--over", "t.csv", "--out", "o/{n}")],
                             [{"number": "1", "text": "a,b"}, {"number": "2", "text": "c"}])
        for told, content in (("UTF-16", "number\n1\n".encode("utf-16")),
                              ("t.csv:2: the table is not in UTF-8", b"text\ngr\xfcn\n"),
                              ("job 2 (t.csv:4): parameter 'number': number from -1000 to 1000 expected, got '1,5'; "
                               "decimals stand behind a point", b"number;count\n1;1\n\n1,5;2\n"),
                              ("job 1 (t.csv:2): parameter 'mesh': in/a.ply: there is no", b"mesh\nin/a.ply\n")):
            with open(self.path("t.csv"), "wb") as file:
                file.write(content)
            self.assertIn(told, self.batch("make.lua", "--over", "t.csv", "--out", "o/{n}", status=2).stderr)

    def test_a_folder_may_end_with_a_slash(self):
        self.write("many.lua", '''
            local p = require("lissom").params{ n = { type = "integer", default = 1 }, out = { type = "folder", default = "" } }
            assert(io.open(p.out .. "/x", "w")):write(p.n):close()''')
        self.batch("many.lua", "--sweep", "n=1,2", "--out", "out/{n}/")
        self.assertEqual(sorted(self.outputs()), ["1/x", "2/x"])

    def test_whole_numbers_are_written_out(self):
        jobs = self.plan("make.lua", "--sweep", "count=99999:100001:1", "--out", "out/{count}.txt")
        self.assertEqual([job["output"] for job in jobs], ["out/99999.txt", "out/100000.txt", "out/100001.txt"])

    def test_a_hundred_thousand_jobs_are_listed_and_reported(self):
        words = ("make.lua", "--sweep", "count=1:100000:1", "--out", "out/{count}.txt")
        jobs = self.plan(*words)
        self.assertEqual(len({job["output"] for job in jobs}), 100000)
        self.assertEqual(jobs[-1]["output"], "out/100000.txt")
        self.batch(*words, "--export", "task.sh")
        self.batch("--submission", self.path("out", ".batch", "slurm", "submission.json"), "--collect")
        with open(self.path("out", "summary.csv"), encoding="utf-8", newline="") as file:
            self.assertEqual([row["count"] for row in csv.DictReader(file)], [str(n + 1) for n in range(100000)])
        self.assertIn("100000 jobs, 100000 waiting", self.read("out", "index.html"))
        self.assertLess(os.path.getsize(self.path("out", "index.html")), 60000000)

    def test_scripts_that_ship_have_plans(self):
        root = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
        scripts = [script for folder in ("scripts/presets", "scripts/recipes", "examples/deform", "examples/hair")
                   for script in glob.glob(os.path.join(root, folder, "*.lua"))]
        self.assertGreater(len(scripts), 40)
        for script in scripts:
            with self.subTest(script=script):
                self.assertEqual(len(self.plan(script, "--out", "out/{n}")), 1)

    def test_values_never_lead_out_of_the_folder(self):
        self.write("t.csv", "text\n../../x\n..\na/b\n\n\"\"\n")
        jobs = self.plan("make.lua", "--over", "t.csv", "--out", "out/{text}/{n}.txt")
        self.assertEqual([job["output"] for job in jobs],
                         ["out/.._.._x/1.txt", "out/__/2.txt", "out/a_b/3.txt", "out/_/4.txt"])


class Runs(Folder):
    SWEEP = ("make.lua", "--sweep", "number=1,2,3", "--out", "out/{number}.txt")

    def test_only_what_has_changed_runs_again_and_says_why(self):
        self.batch(*self.SWEEP)
        self.assertEqual(self.outputs(), {f"{n}.txt": b"word %d 1  0\n" % n for n in (1, 2, 3)})
        self.assertEqual(self.reasons(*self.SWEEP), ["", "", ""])
        os.utime(self.path("make.lua"), (1, 1))
        os.utime(self.path("out", "1.txt"), (1, 1))
        self.assertEqual(self.reasons(*self.SWEEP), ["", "", ""])
        self.write("out/2.txt", "other")
        os.remove(self.path("out", "3.txt"))
        self.assertEqual(self.reasons(*self.SWEEP),
                         ["", "out/2.txt is not as it was written", "out/3.txt is missing"])
        self.assertIn("2 done, 1 done before", self.batch(*self.SWEEP).stdout)
        self.assertEqual(self.reasons(*self.SWEEP, "--set", "count=5"), ["count is given now"] * 3)
        self.write("word.lua", 'return "changed"')
        self.assertEqual(self.reasons(*self.SWEEP), ["./word.lua has changed"] * 3)
        self.batch(*self.SWEEP)
        self.assertEqual(self.outputs()["1.txt"], b"changed 1 1  0\n")
        self.write("make.lua", SCRIPT + "\n")
        self.assertEqual(self.reasons(*self.SWEEP), ["make.lua has changed"] * 3)

    def test_a_changed_input_runs_its_own_job_again(self):
        for name in ("in/a.obj", "in/b.obj"):
            self.write(name, TRIANGLE)
        words = ("make.lua", "--over", "in/*.obj", "--out", "out/{name}.txt")
        self.batch(*words)
        self.write("in/b.obj", TRIANGLE + "v 1 1 0\nf 2 4 3\n")
        self.write("in/0.obj", TRIANGLE)
        self.assertEqual(self.reasons(*words), ["new", "", "in/b.obj has changed"])
        self.batch(*words)
        self.assertEqual(self.outputs()["b.txt"], b"word 0 1  2\n")

    def test_each_ending_is_told_and_the_rest_goes_on(self):
        words = ("make.lua", "--sweep", "mode=good,fails,usage,nothing,dies,never_ends", "--timeout", "1",
                 "--retries", "1", "--out", "out/{mode}.txt")
        run = self.batch(*words, status=1)
        self.assertEqual(list(self.outputs()), ["good.txt"])
        with open(self.path("out", "summary.csv"), encoding="utf-8", newline="") as file:
            rows = {row["mode"]: row for row in csv.DictReader(file)}
        self.assertEqual({mode: row["outcome"] for mode, row in rows.items()},
                         {"good": "done", "fails": "failed", "usage": "failed", "nothing": "failed",
                          "dies": "crashed", "never_ends": "timed_out"})
        self.assertEqual({mode: row["attempts"] for mode, row in rows.items()},
                         {"good": "1", "fails": "2", "usage": "1", "nothing": "2", "dies": "2", "never_ends": "2"})
        self.assertIn("on purpose", rows["fails"]["message"])
        self.assertIn("made no nothing.txt", rows["nothing"]["message"])
        self.assertIn("on purpose", self.read("out", rows["fails"]["log"]))
        self.assertGreater(float(rows["good"]["memory_mib"]), 1)
        self.assertIn("failed  out/fails.txt", run.stdout)
        self.assertEqual(self.reasons(*words)[:2], ["", "failed before"])
        self.assertEqual(os.listdir(self.path("out", ".batch", "work")), [])

    def pack_of(self, bad):
        """A table of 48 jobs with bad ones among them, and the command that runs them in packs of a dozen."""
        modes = {12 + 5 * i: mode for i, mode in enumerate(bad)}
        rows = [f"{n},{modes.get(n, 'good')}" for n in range(1, 49)]
        self.write("table.csv", "number,mode\n" + "\n".join(rows) + "\n")
        return ("make.lua", "--over", "table.csv", "--jobs", "1", "--isolate", "state", "--out", "out/{number}.txt")

    def test_jobs_of_one_process_have_states_logs_and_inputs_of_their_own(self):
        self.write("make.lua", SCRIPT + "\nprint(p.number, seen)\nseen = p.number\n")
        self.write("odd.obj", TRIANGLE + "f 1 2 2\n")
        words = self.pack_of(["warns"])
        self.batch(*words)
        self.assertEqual(self.outputs(), {f"{n}.txt": b"word %d 1  0\n" % n for n in range(1, 49)})
        jobs = json.loads(self.read("out", "summary.json"))["jobs"]
        self.assertEqual([job["number"] for job in jobs if job["warnings"] > 0], [12])
        log = self.read("out", jobs[11]["log"])
        line = 1 + SCRIPT[:SCRIPT.index('"odd.obj"')].count("\n")
        self.assertIn(f"warning: make.lua:{line}: 1 face with fewer than three", log)
        self.assertRegex(log, r"done after [0-9.]+ s, [0-9]+ MiB\n")
        for job in jobs:
            self.assertIn("%d\tnil\n" % job["number"], self.read("out", job["log"]).replace(".0", ""))
        processes = {job["memory_mib"] for job in jobs}
        self.assertLess(len(processes), 48)
        self.assertEqual(set(self.reasons(*words)), {""})
        self.write("word.lua", 'return "changed"')
        self.assertEqual(set(self.reasons(*words)), {"./word.lua has changed"})

    def test_what_ends_a_pack_costs_no_other_job(self):
        words = self.pack_of(["fails", "usage", "dies", "never_ends", "nothing"])
        self.batch(*words, "--timeout", "1", status=1)
        self.assertEqual(len(self.outputs()), 43)
        with open(self.path("out", "summary.csv"), encoding="utf-8", newline="") as file:
            bad = {row["mode"]: (row["outcome"], row["attempts"]) for row in csv.DictReader(file)
                   if row["mode"] != "good" or row["outcome"] != "done" or row["attempts"] != "1"}
        self.assertEqual(bad, {"fails": ("failed", "2"), "usage": ("failed", "1"), "dies": ("crashed", "2"),
                               "never_ends": ("timed_out", "2"), "nothing": ("failed", "2")})
        self.assertEqual(os.listdir(self.path("out", ".batch", "work")), [])

    def test_a_folder_is_an_output_too_and_loses_what_is_not_made_again(self):
        self.write("many.lua", '''
            local p = require("lissom").params{ files = { type = "integer", default = 1 },
                out = { type = "folder", default = "out" } }
            for i = 1, p.files do assert(io.open(p.out .. "/" .. i, "w")):write("x"):close() end''')
        self.batch("many.lua", "--set", "files=3", "--out", "out/all")
        self.assertEqual(sorted(self.outputs()), ["all/1", "all/2", "all/3"])
        self.batch("many.lua", "--set", "files=1", "--out", "out/all")
        self.assertEqual(sorted(self.outputs()), ["all/1"])

    def test_files_that_two_jobs_write_must_be_equal(self):
        self.write("beside.lua", '''
            local p = require("lissom").params{ a = { type = "integer", default = 1 }, b = { type = "integer",
                default = 1 }, out = { type = "file", default = "out" } }
            assert(io.open(p.out, "w")):write(p.a):close()
            assert(io.open(p.out:gsub("[^/]*$", "shared"), "w")):write(p.b):close()''')
        self.batch("beside.lua", "--sweep", "a=1,2", "--out", "out/{a}")
        run = self.batch("beside.lua", "--sweep", "a=1,2", "--sweep", "b=1,2", "--out", "two/{a}{b}", "--jobs", "1",
                         status=1)
        self.assertIn("exists with other content", run.stdout)

    def test_a_second_batch_in_the_folder_is_refused(self):
        os.makedirs(self.path("out", ".batch"))
        with open(self.path("out", ".batch", "lock"), "w", encoding="utf-8") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            lock.write("somewhere.12.34\n")
            lock.flush()
            run = self.batch(*self.SWEEP, status=1)
        self.assertIn("somewhere.12.34", run.stderr)
        self.batch(*self.SWEEP)

    def test_torn_and_strange_records_are_passed_over(self):
        self.batch(*self.SWEEP)
        results = self.path("out", ".batch", "results")
        name = os.path.join(results, os.listdir(results)[0])
        with open(name, "r+", encoding="utf-8") as file:
            text = file.read()
            file.seek(0)
            file.truncate()
            file.write(text[:-40])
        with open(os.path.join(results, "z.jsonl"), "wb") as file:
            file.write(b"\x00\xff{]\n{}\n[1,2]\n")
        self.assertEqual(sorted(self.reasons(*self.SWEEP)), ["", "", "new"])
        self.batch(*self.SWEEP)
        self.assertEqual(self.reasons(*self.SWEEP), ["", "", ""])

    def test_outputs_beside_the_inputs_are_no_inputs_of_the_next_run(self):
        for name in ("in/a.obj", "in/b.obj"):
            self.write(name, TRIANGLE)
        self.write("copy.lua", """
            local lissom = require("lissom")
            local p = lissom.params{ mesh = { type = "file" }, out = { type = "file", default = "" } }
            lissom.load(p.mesh):save(p.out)""")
        words = ("copy.lua", "--over", "in/*.obj", "--out", "in/{name}_bent.obj")
        self.batch(*words)
        self.write("in/c.obj", TRIANGLE)
        self.assertEqual(self.reasons(*words), ["", "", "new"])
        self.assertIn("1 done, 2 done before", self.batch(*words).stdout)

    def test_files_that_are_read_with_an_input_are_inputs_too(self):
        self.write("copy.lua", """
            local lissom = require("lissom")
            local p = lissom.params{ mesh = { type = "file" }, out = { type = "file", default = "" } }
            lissom.load(p.mesh):save(p.out)""")
        self.write("in/m.obj", "mtllib m n.mtl\nusemtl wood\n" + TRIANGLE)
        self.write("in/m n.mtl", "newmtl wood\nKd 1 0 0\nmap_Kd -s 1 1 1 wood.png\n")
        subprocess.run([PROGRAM, "convert", "in/m.obj", "in/b.gltf"], cwd=self.folder, check=True, capture_output=True)
        with open(self.path("in", "b.gltf"), encoding="utf-8") as file:
            document = json.load(file)
        if document["buffers"][0]["uri"].startswith("data:"):
            import base64
            data = base64.b64decode(document["buffers"][0]["uri"].split(",", 1)[1])
            document["buffers"][0]["uri"] = "the%20data.bin"
            self.write("in/b.gltf", json.dumps(document))
            with open(self.path("in", "the data.bin"), "wb") as file:
                file.write(data)
        words = ("copy.lua", "--over", "in/*", "--out", "out/{name}.ply")
        self.batch(*words)
        self.assertEqual(self.reasons(*words), ["", ""])
        side = [name for name in os.listdir(self.path("in")) if name.endswith(".bin")][0]
        with open(self.path("in", side), "ab") as file:
            file.write(b"0000")
        self.write("in/wood.png", "x")
        self.assertEqual(self.reasons(*words), ["in/" + side + " has changed", "in/wood.png has changed"])
        self.batch(*words)
        self.write("in/m n.mtl", "newmtl wood\nKd 0 1 0\n")
        self.assertEqual(self.reasons(*words), ["", "in/m n.mtl has changed"])

    def test_a_scene_in_a_folder_is_an_input(self):
        self.write("scene.lua", """
            local lissom = require("lissom")
            local scene = lissom.scene{}
            scene:add("ball", lissom.shapes.sphere())
            scene:save("room/")""")
        self.write("use.lua", """
            local lissom = require("lissom")
            local p = lissom.params{ scene = { type = "folder", default = "room" }, out = { type = "file", default = "" } }
            local scene = lissom.load_scene(p.scene)
            assert(io.open(p.out, "w")):write(#scene:names()):close()""")
        os.makedirs(self.path("room"))
        subprocess.run([PROGRAM, "run", "scene.lua"], cwd=self.folder, check=True)
        words = ("use.lua", "--out", "out/x.txt")
        self.batch(*words)
        self.assertEqual(self.reasons(*words), [""])
        with open(self.path("room", "scene.json"), "a", encoding="utf-8") as file:
            file.write("\n")
        self.assertEqual(self.reasons(*words), ["room/scene.json has changed"])

    def test_two_batches_at_once_do_each_job_once(self):
        words = self.words("make.lua", "--sweep", "number=1:20:1", "--out", "out/{number}.txt")
        both = [subprocess.Popen(words, cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
                for _ in range(2)]
        texts = [process.communicate(timeout=120)[0] for process in both]
        self.assertIn(0, [process.returncode for process in both], texts)
        if 1 in [process.returncode for process in both]:
            self.assertIn("another batch works in out", "".join(texts))
        self.assertEqual(self.outputs(), {f"{n}.txt": b"word %d 1  0\n" % n for n in range(1, 21)})
        results = self.path("out", ".batch", "results")
        lines = "".join(self.read("out", ".batch", "results", name) for name in os.listdir(results)).splitlines()
        self.assertEqual(len(lines), 20)

    def test_names_that_are_no_text_fail_alone(self):
        self.write("in/a.obj", TRIANGLE)
        with open(os.path.join(os.fsencode(self.path("in")), b"b\xff.obj"), "w", encoding="ascii") as file:
            file.write(TRIANGLE)
        run = self.batch("make.lua", "--over", "in/*.obj", "--out", "out/{name}.txt", status=1)
        self.assertIn("the name is not in UTF-8", run.stdout)
        self.assertEqual(list(self.outputs()), ["a.txt"])

    @unittest.skipIf(os.geteuid() == 0 and not shutil.which("setpriv"), "root writes everywhere")
    def test_a_folder_without_write_permission_is_told_before_the_first_job(self):
        os.mkdir(self.path("closed"))
        os.chmod(self.path("closed"), 0o555)
        os.chmod(self.folder, 0o755)
        user = ["setpriv", "--reuid=65534", "--regid=65534", "--clear-groups"] if os.geteuid() == 0 else []
        run = subprocess.run(user + self.words(*self.SWEEP[:-1], "closed/{number}.txt"), cwd=self.folder,
                             capture_output=True, text=True, timeout=60, check=False)
        self.assertEqual(run.returncode, 1)
        self.assertIn("closed/.batch/results: the folder cannot be made", run.stderr)

    def test_an_interrupt_keeps_what_is_done(self):
        process = subprocess.Popen(self.words("make.lua", "--sweep", "number=1,2", "--sweep", "mode=good,never_ends",
                                              "--out", "out/{number}{mode}.txt"), cwd=self.folder,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        for _ in range(600):
            if os.path.exists(self.path("out", "1good.txt")):
                break
            time.sleep(0.05)
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130)
        self.assertIn("1good.txt", self.outputs())
        self.assertTrue(os.path.exists(self.path("out", "index.html")))

    def test_progress_is_told_as_json_and_plainly(self):
        run = self.batch(*self.SWEEP, "--progress", "json")
        last = json.loads(run.stderr.splitlines()[-1])
        self.assertEqual((last["all"], last["done"], last["failed"]), (3, 3, 0))
        self.assertGreater(last["rate"], 0)
        self.assertEqual(last["seconds_left"], 0)
        shutil.rmtree(self.path("out"))
        plain = self.batch(*self.SWEEP[:-2], "--sweep", "mode=good,fails", "--out", "out/{number}{mode}.txt", "--retries", "0",
                           "--progress", "plain", status=1).stderr.splitlines()[-1]
        self.assertRegex(plain, r"^6 of 6 jobs, 3 failed, [0-9.]+ a (second|minute), 0 s left$")

    def test_a_terminal_has_one_line_of_progress(self):
        terminal, other = pty.openpty()
        environment = dict(os.environ, TERM="xterm")
        process = subprocess.Popen(self.words("make.lua", "--sweep", "number=1:60:1", "--out", "out/{number}.txt"),
                                   cwd=self.folder, stdout=subprocess.PIPE, stderr=other, stdin=other, env=environment)
        os.close(other)
        process.communicate(timeout=120)
        os.set_blocking(terminal, False)
        shown = os.read(terminal, 1 << 20).decode()
        os.close(terminal)
        self.assertRegex(shown, r"[0-9]+ of 60 jobs, [0-9.]+ a (second|minute), [0-9]+ s left")
        self.assertNotIn("\n", shown.rstrip())

    def test_a_changed_program_runs_all_again(self):
        program = self.path("program")
        shutil.copy(PROGRAM, program)
        words = ["batch", *self.SWEEP]
        subprocess.run([program, *words], cwd=self.folder, check=True, capture_output=True)
        with open(program, "ab") as file:
            file.write(b"\0")
        run = subprocess.run([program, *words, "--list"], cwd=self.folder, check=True, capture_output=True, text=True)
        self.assertEqual(run.stdout.count("[the program has changed]"), 3)


class Files(Folder):
    """Verbs over many files: they run as jobs of a batch."""

    def setUp(self):
        super().setUp()
        for name in ("in/a.obj", "in/deep/b c.obj", "in/\u00fc.obj"):
            self.write(name, TRIANGLE)
        self.write("in/twisted.obj", TRIANGLE + "v 0 -1 0\nf 1 2 4\n")
        self.write("in/bad.obj", "v 0 0 0\nf 1 2 3\n")

    def run_verb(self, *words, status=0, environment=None):
        run = subprocess.run([PROGRAM, *words], cwd=self.folder, capture_output=True, text=True, timeout=300,
                             check=False, env=environment)
        self.assertEqual(run.returncode, status, run.stdout + run.stderr)
        return run

    def convert(self, *words, status=0, **more):
        return self.run_verb("convert", "--in", "in/**/*.obj", "--out", "out", "--to", "ply", *words, status=status, **more)

    def table(self, name="out"):
        with open(self.path(name, "summary.csv"), encoding="utf-8", newline="") as file:
            return {row["file"]: row for row in csv.DictReader(file)}

    def test_convert_resumes_and_keeps_a_table(self):
        run = self.convert(status=1)
        self.assertIn("3 converted, 1 repaired, 1 failed; ", run.stdout)
        self.assertEqual([line.split("  ")[0] for line in run.stdout.splitlines()],
                         ["file", "in/a.obj", "in/bad.obj", "in/deep/b c.obj", "in/twisted.obj", "in/\u00fc.obj",
                          "3 converted, 1 repaired, 1 failed; out/index.html"])
        self.assertEqual(sorted(self.outputs()), ["a.ply", "deep/b c.ply", "twisted.ply", "\u00fc.ply"])
        rows = self.table()
        self.assertEqual(rows["in/twisted.obj"]["result.outcome"], "repaired")
        self.assertEqual(rows["in/a.obj"]["result.vertices"], "3")
        self.assertEqual((rows["in/bad.obj"]["outcome"], rows["in/bad.obj"]["attempts"]), ("failed", "1"))
        self.assertIn("vertex 3 does not exist", rows["in/bad.obj"]["message"])
        self.assertIn("in/twisted.obj", self.read("out", "index.html"))
        first = self.outputs()
        self.write("in/bad.obj", TRIANGLE)
        os.remove(self.path("out", "a.ply"))
        again = json.loads(self.convert("--json").stdout)
        self.assertEqual({row["file"]: row["kept"] for row in again["files"]},
                         {"in/a.obj": False, "in/bad.obj": False, "in/deep/b c.obj": True, "in/twisted.obj": True,
                          "in/\u00fc.obj": True})
        self.assertEqual((again["converted"], again["repaired"], again["failed"], again["kept"]), (4, 1, 0, 3))
        self.assertEqual(self.outputs()["a.ply"], first["a.ply"])
        # Other options make other files.
        self.assertEqual({line.split("[")[1] for line in self.convert("--text", "--list").stdout.splitlines()},
                         {"options is given now]"})
        self.convert("--text")
        self.assertIn(b"format ascii", self.outputs()["a.ply"])

    def test_convert_makes_what_it_makes_of_one_file(self):
        self.convert("--up", "z", "--in-up", "y", status=1)
        self.run_verb("convert", "in/a.obj", "one.ply", "--up", "z", "--in-up", "y")
        with open(self.path("one.ply"), "rb") as file:
            self.assertEqual(self.outputs()["a.ply"], file.read())

    def test_files_of_the_user_are_not_replaced_by_the_table(self):
        for name in ("index.html", "summary.csv", "summary.json"):
            self.write("out/" + name, "mine")
            run = self.convert(status=1)
            self.assertIn(f"out/{name} is not from a batch", run.stderr)
            self.assertEqual(os.listdir(self.path("out")), [name])
            self.assertEqual(self.read("out", name), "mine")
            os.remove(self.path("out", name))
        self.convert(status=1)
        shutil.rmtree(self.path("out", ".batch"))
        self.assertIn("3 converted", self.convert(status=1).stdout)

    def test_names_that_begin_as_options_do_are_files(self):
        self.write("-x.obj", TRIANGLE)
        self.run_verb("convert", "--in", "./*.obj", "--out", "out", "--to", "off")
        self.run_verb("convert", "--in=-x.obj", "--out", "out2", "--to", "off")
        self.assertEqual(self.outputs(), self.outputs("out2"))
        self.assertEqual(list(self.outputs()), ["-x.off"])

    def write_textured(self, name):
        """A .glb file whose texture is called "skin" and has the name of the file in it."""
        points = struct.pack("<15f", 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1)
        picture = b"\x89PNG\r\n\x1a\n" + name.encode().ljust(8, b"\0")
        views = [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 24},
                 {"buffer": 0, "byteOffset": 60, "byteLength": 16}]
        document = {
            "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": 0}]}],
            "materials": [{"name": "m", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
            "textures": [{"source": 0}], "images": [{"name": "skin", "mimeType": "image/png", "bufferView": 2}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0],
                           "max": [1, 1, 0]}, {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2"}],
            "bufferViews": views, "buffers": [{"byteLength": 76}]}
        text = json.dumps(document).encode()
        text += b" " * (-len(text) % 4)
        os.makedirs(self.path("glb"), exist_ok=True)
        with open(self.path("glb", name + ".glb"), "wb") as file:
            file.write(struct.pack("<4sIII4s", b"glTF", 2, 28 + len(text) + 76, len(text), b"JSON") + text)
            file.write(struct.pack("<I4s", 76, b"BIN\0") + points + picture)

    def test_textures_of_one_name_do_not_take_each_others_place(self):
        for name in "abc":
            self.write_textured(name)
        convert = ("convert", "--in", "glb", "--out", "out", "--to", "obj", "--jobs", "2")
        self.run_verb(*convert)
        made = self.outputs()

        def named(file, keyword):
            return next(line.split(None, 1)[1] for line in made[file].decode().splitlines() if line.startswith(keyword))

        for name in "abc":
            texture = named(named(name + ".obj", "mtllib"), "map_Kd")
            self.assertEqual(made[texture][8:9], name.encode(), sorted(made))
        self.assertIn("3 of them before", self.run_verb(*convert).stdout)

    def test_a_crash_costs_one_file(self):
        environment = dict(os.environ, LISSOM_THREADS="1")
        for n in range(30):
            self.write(f"in/{n}.obj", TRIANGLE)
        process = subprocess.Popen([PROGRAM, "convert", "--in", "in", "--out", "out", "--to", "ply", "--jobs", "2"],
                                   cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                   env=environment)
        # Workers are killed as soon as they are seen.
        for _ in range(3):
            time.sleep(0.02)
            for child in children_of(process):
                try:
                    os.kill(child, signal.SIGKILL)
                except ProcessLookupError:
                    pass
        text = process.communicate(timeout=120)[0]
        self.run_verb("convert", "--in", "in", "--out", "out", "--to", "ply", "--jobs", "2", status=1)
        self.assertEqual(len(self.outputs()), 33, text)

    def test_inspect_makes_a_table_of_a_folder(self):
        run = self.run_verb("inspect", "--in", "in/**/*.obj", "--out", "out", status=1)
        self.assertIn("4 inspected, 1 failed", run.stdout)
        self.assertEqual(sorted(self.outputs()), ["a.obj.json", "deep/b c.obj.json", "twisted.obj.json", "\u00fc.obj.json"])
        one = json.loads(self.run_verb("inspect", "in/twisted.obj", "--json").stdout)
        self.assertEqual(json.loads(self.outputs()["twisted.obj.json"]), one)
        row = self.table()["in/twisted.obj"]
        self.assertEqual((row["result.faces"], row["result.boundaries"], row["result.closed"]), ("2", "1", "false"))
        self.assertIn("1 faces flipped", row["result.notes"])
        self.assertIn("4 of them before",
                      self.run_verb("inspect", "--in", "in/**/*.obj", "--out", "out", status=1).stdout)

    def test_wrong_words_are_told_before_the_first_job(self):
        for text, *words in (("--out is missing", "inspect", "--in", "in"),
                             ("--jobs is for many files", "inspect", "in/a.obj", "--jobs", "2"),
                             ("belong to --slurm", "inspect", "--in", "in", "--out", "out", "--", "--mem=2G"),
                             ("FILE does not go with --in", "inspect", "in/a.obj", "--in", "in", "--out", "out"),
                             ("--to", "convert", "--in", "in", "--out", "out", "--to", "doc"),
                             ("several are given by --in, as --in 'in/*.obj' --out FOLDER", "convert", "in/a.obj", "in/b.obj",
                              "in/c.obj", "--to", "glb"),
                             ("its files are given by --in in", "convert", "in", "out"),
                             ("its files are given by --in in", "inspect", "in"),
                             ("did you mean '--out'", "inspect", "--in", "in", "--otu", "out")):
            self.assertIn(text, self.run_verb(*words, status=2).stderr)
        self.assertFalse(os.path.exists(self.path("out")))


class Kills(Folder):
    """After any kills the outputs are those of an undisturbed run."""

    WORDS = ("make.lua", "--sweep", "number=1:25:1", "--jobs", "3", "--out")

    def start(self, rng):
        isolate = rng.choice(("process", "state"))
        return subprocess.Popen(self.words(*self.WORDS, "out/{number}.txt", "--isolate", isolate), cwd=self.folder,
                                stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def kill_at_random(self, rng, process, victims):
        time.sleep(rng.uniform(0.0, 0.25))
        children = children_of(process)
        if "driver" in victims:
            process.kill()
        if "worker" in victims and children:
            try:
                os.kill(rng.choice(children), signal.SIGKILL)
            except ProcessLookupError:
                pass
        if "driver" not in victims:
            time.sleep(0.05)
            process.kill()
        process.wait()

    def test_random_kills_change_nothing(self):
        self.batch(*self.WORDS, "undisturbed/{number}.txt")
        rng = random.Random(1)
        for trial in range(TRIALS):
            victims = (["driver"], ["driver"], ["worker"], ["driver", "worker"])[trial % 4]
            # Another batch may work in the folder, or take it over from the one that is killed.
            second = self.start(rng) if rng.random() < 0.3 else None
            self.kill_at_random(rng, self.start(rng), victims)
            if second:
                self.kill_at_random(rng, second, victims)
            if rng.random() < 0.2:
                made = list(self.outputs())
                if made:
                    os.remove(self.path("out", rng.choice(made)))
            if rng.random() < 0.2:
                self.tear_a_record(rng)
            if rng.random() < 0.1:
                shutil.rmtree(self.path("out"), ignore_errors=True)
        self.batch(*self.WORDS, "out/{number}.txt")
        self.assertEqual(self.outputs(), self.outputs("undisturbed"))
        self.assertEqual(set(self.reasons(*self.WORDS, "out/{number}.txt")), {""})
        self.assertEqual(os.listdir(self.path("out", ".batch", "work")), [])

    def tear_a_record(self, rng):
        files = glob.glob(self.path("out", ".batch", "results", "*"))
        if files:
            name = rng.choice(sorted(files))
            os.truncate(name, rng.randrange(os.path.getsize(name) + 1))

    def test_what_a_dead_job_has_started_holds_its_place(self):
        words = ("make.lua", "--set", "mode=orphan", "--out", "out/x.txt")
        self.batch(*words)
        os.remove(self.path("out", "x.txt"))
        started = time.monotonic()
        self.batch(*words)
        self.assertGreater(time.monotonic() - started, 0.5)
        self.assertEqual(list(self.outputs()), ["x.txt"])

    def test_a_limit_of_files_is_the_failure_of_its_job(self):
        self.write("sizes.lua", """
            local p = require("lissom").params{ n = { type = "integer", default = 1 }, out = { type = "file", default = "" } }
            local file = assert(io.open(p.out, "w"))
            assert(file:write(("x"):rep(p.n)))
            assert(file:close())""")
        words = self.words("sizes.lua", "--sweep", "n=10,3000000,20", "--out", "out/{n}.txt")
        limited = subprocess.run(["sh", "-c", "ulimit -f 2000; exec \"$@\"", "sh", *words], cwd=self.folder,
                                 capture_output=True, text=True, timeout=120, check=False)
        self.assertEqual(limited.returncode, 1, limited.stdout + limited.stderr)
        self.assertEqual(sorted(self.outputs()), ["10.txt", "20.txt"])
        self.batch(*words[2:])
        self.assertEqual(len(self.outputs()["3000000.txt"]), 3000000)

    @unittest.skipUnless(os.geteuid() == 0 and shutil.which("mount"), "a small disk needs root")
    def test_a_full_disk_stops_the_batch_and_loses_nothing(self):
        os.mkdir(self.path("small"))
        mount = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=3m", "none", self.path("small")],
                               capture_output=True, check=False)
        if mount.returncode != 0:
            self.skipTest("this system mounts no small disk")
        try:
            self.write("large.lua", '''
                local p = require("lissom").params{ n = { type = "integer", default = 1 }, out = { type = "file",
                    default = "" } }
                local file = assert(io.open(p.out, "w"))
                assert(file:write(("x"):rep(700000)))
                assert(file:close())''')
            words = ("large.lua", "--sweep", "n=1:9:1", "--jobs", "2", "--out", "small/{n}.txt")
            run = self.batch(*words, status=1)
            self.assertIn("is full", run.stderr)
            self.assertTrue(all(len(text) == 700000 for text in self.outputs("small").values()))
        finally:
            subprocess.run(["umount", self.path("small")], check=True)


class Slurm(Folder):
    """A cluster that is acted (see fake_slurm.py)."""

    WORDS = ("make.lua", "--sweep", "number=1:25:1", "--out", "out/{number}.txt", "--slurm")

    def setUp(self):
        super().setUp()
        os.mkdir(self.path("bin"))
        os.mkdir(self.path("slurm"))
        for name in ("sbatch", "squeue", "scontrol"):
            os.symlink(os.path.join(os.path.dirname(os.path.abspath(__file__)), "fake_slurm.py"),
                       self.path("bin", name))

    def submit(self, *words, status=0, **more):
        environment = dict(os.environ, PATH=self.path("bin") + ":" + os.environ["PATH"],
                           FAKE_SLURM=self.path("slurm"), **more)
        return self.batch(*words, status=status, environment=environment)

    def calls(self):
        return self.read("slurm", "calls").splitlines()

    def all_outputs(self):
        return {f"{n}.txt": b"word %d 1  0\n" % n for n in range(1, 26)}

    def test_one_array_runs_all_and_a_task_writes_the_summary(self):
        self.submit(*self.WORDS, "--", "--account=me", "--mem=2G", FAKE_ARRAY_SIZE="2")
        self.assertEqual(self.outputs(), self.all_outputs())
        array, collector = self.calls()
        for word in ("--array=0-1", "--requeue", "--open-mode=append", "--signal=B:TERM@60", "--account=me", "--mem=2G"):
            self.assertIn(word, array.split())
        self.assertIn("--dependency=afterany:101", collector.split())
        for _ in range(200):
            if os.path.exists(self.path("slurm", "102.ended")):
                break
            time.sleep(0.05)
        self.assertIn("25 jobs, 25 done", self.read("out", "index.html"))
        self.assertIn("0 done, 25 done before", self.submit(*self.WORDS).stdout)
        self.assertEqual(len(self.calls()), 2)

    def test_tasks_that_run_twice_do_no_harm(self):
        self.submit(*self.WORDS, FAKE_MODE="twice", FAKE_ARRAY_SIZE="3")
        self.assertEqual(self.outputs(), self.all_outputs())
        records = [json.loads(line) for name in os.listdir(self.path("out", ".batch", "results"))
                   for line in self.read("out", ".batch", "results", name).splitlines()]
        self.assertEqual(sorted(record["output"] for record in records),
                         sorted("out/" + name for name in self.all_outputs()))

    def test_what_a_cluster_loses_is_submitted_by_the_same_command(self):
        run = self.submit(*self.WORDS, FAKE_MODE="lose", FAKE_ARRAY_SIZE="6", status=1)
        self.assertRegex(run.stdout, "0 done, 25 left")
        self.submit(*self.WORDS, FAKE_MODE="forget", FAKE_ARRAY_SIZE="6")
        self.assertEqual(self.outputs(), self.all_outputs())

    def test_a_task_that_ends_early_takes_on_jobs_of_others(self):
        self.submit(*self.WORDS, FAKE_MODE="first", FAKE_ARRAY_SIZE="6")
        self.assertEqual(self.outputs(), self.all_outputs())

    def test_a_missing_or_refusing_sbatch_is_told(self):
        run = self.submit(*self.WORDS, status=1, FAKE_MODE="refuse")
        self.assertIn("Invalid account", run.stderr)
        os.remove(self.path("bin", "sbatch"))
        if not shutil.which("sbatch"):
            self.assertIn("sbatch is not installed", self.submit(*self.WORDS, status=1).stderr)
        self.assertIn("belong to --slurm", self.batch(*self.WORDS[:-1], "--", "--mem=2G", status=2).stderr)

    def test_a_verb_over_many_files_runs_on_the_cluster(self):
        for n in range(6):
            self.write(f"in/{n}.obj", TRIANGLE)
        environment = dict(os.environ, PATH=self.path("bin") + ":" + os.environ["PATH"], FAKE_SLURM=self.path("slurm"))
        run = subprocess.run([PROGRAM, "convert", "--in", "in", "--out", "out", "--to", "off", "--slurm", "--", "--mem=2G"],
                             cwd=self.folder, capture_output=True, text=True, timeout=300, check=False, env=environment)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        self.assertIn("6 converted, 0 repaired, 0 failed", run.stdout)
        self.assertEqual(sorted(self.outputs()), [f"{n}.off" for n in range(6)])
        self.assertIn("--mem=2G", self.calls()[0].split())

    def test_a_submission_is_exported_for_sites_that_change_it(self):
        run = self.submit(*self.WORDS[:-1], "--export", "task.sh", "--", "--account=me")
        self.assertFalse(os.path.exists(self.path("slurm", "calls")))
        words = run.stdout.split()
        self.assertEqual((words[0], words[-1]), ("sbatch", "task.sh"))
        self.assertIn("--account=me", words)
        subprocess.run(["sh", "task.sh"], cwd=self.folder, check=True, env=dict(os.environ, SLURM_ARRAY_TASK_ID="0"))
        self.assertTrue(self.outputs())


if __name__ == "__main__":
    unittest.main()
