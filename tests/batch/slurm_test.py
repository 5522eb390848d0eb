#!/usr/bin/env python3
"""Runs `lissom batch --slurm` on a Slurm of four nodes on the loopback: requeued tasks, a node whose tasks go on after it
has failed, a controller that forgets, a time limit, jobs that are purged, and more jobs than an array may have.
Needs slurmctld, slurmd, munged, and root. Usage: slurm_test.py PROGRAM"""
import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

from small_slurm import Cluster, missing_parts

PROGRAM = os.path.abspath(sys.argv.pop(1))
NODES = 4

SCRIPT = r'''
local p = require("lissom").params{ n = { type = "integer", default = 1 }, seconds = { type = "number", default = 0 },
    out = { type = "file", default = "" } }
if p.seconds > 0 then os.execute("sleep " .. p.seconds) end
local file = assert(io.open(p.out, "w"))
file:write(p.n, "\n")
file:close()
'''


class Slurm(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.root = tempfile.mkdtemp(prefix="lissom-slurm-")
        cls.cluster = Cluster(cls.root, NODES)
        cls.cluster.start()

    @classmethod
    def tearDownClass(cls):
        cls.cluster.stop()
        shutil.rmtree(cls.root, ignore_errors=True)

    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="job-", dir=self.root)
        with open(os.path.join(self.folder, "make.lua"), "w", encoding="ascii") as file:
            file.write(SCRIPT)

    def start(self, *words):
        return subprocess.Popen([PROGRAM, "batch", "make.lua", "--out", "out/{n}.txt", "--slurm", *words],
                                cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)

    def run_all(self, *words, timeout=600):
        process = self.start(*words)
        text = process.communicate(timeout=timeout)[0]
        return process.returncode, text

    def wait_for_outputs(self, count):
        for _ in range(1200):
            if len(self.outputs()) >= count:
                return
            time.sleep(0.1)
        self.fail("no outputs come")

    def outputs(self):
        out = os.path.join(self.folder, "out")
        found = {}
        for name in os.listdir(out) if os.path.isdir(out) else []:
            if name.endswith(".txt"):
                with open(os.path.join(out, name), encoding="ascii") as file:
                    found[name] = file.read()
        return found

    def expect_all(self, count):
        self.assertEqual(self.outputs(), {f"{n}.txt": f"{n}\n" for n in range(1, count + 1)})

    def until_all(self, *words, tries=4):
        """Gives the same command until all is done."""
        for _ in range(tries):
            status, text = self.run_all(*words)
            if status == 0:
                return
        self.fail(text)

    def test_more_jobs_than_an_array_may_have(self):
        status, text = self.run_all("--sweep", "n=1:3000:1")
        self.assertEqual(status, 0, text)
        self.expect_all(3000)

    def test_a_node_fails_and_its_task_goes_on(self):
        words = ("--sweep", "n=1:48:1", "--set", "seconds=1")
        process = self.start(*words)
        self.wait_for_outputs(1)
        self.cluster.kill("slurmd.n1")
        time.sleep(15)
        self.cluster.start_node(1)
        process.communicate(timeout=600)
        self.until_all(*words)
        self.expect_all(48)
        self.cluster.wait_for_nodes()

    def test_a_controller_that_forgets_uses_an_id_again(self):
        words = ("--sweep", "n=1:24:1", "--set", "seconds=0.5")
        process = self.start(*words)
        self.wait_for_outputs(1)
        self.cluster.kill("slurmctld")
        self.cluster.start_controller("-c")
        process.communicate(timeout=600)
        self.until_all(*words)
        self.expect_all(24)
        self.cluster.wait_for_nodes()

    def test_a_time_limit_ends_tasks_and_the_same_command_goes_on(self):
        words = ("--sweep", "n=1:3:1", "--set", "seconds=50", "--", "--time=1")
        status, text = self.run_all(*words)
        self.assertEqual(status, 1, text)
        self.until_all("--sweep", "n=1:3:1", "--set", "seconds=0", "--", "--time=1")
        self.expect_all(3)

    def array(self):
        with open(os.path.join(self.folder, "out", ".batch", "slurm", "array.json"), encoding="ascii") as file:
            return json.load(file)["id"]

    def test_a_requeued_task_does_only_what_is_left(self):
        words = ("--sweep", "n=1:24:1", "--set", "seconds=0.5")
        process = self.start(*words)
        self.wait_for_outputs(3)
        array = self.array()
        subprocess.run(["scontrol", "requeue", array], check=True)
        # It would wait for two minutes.
        for _ in range(50):
            time.sleep(0.2)
            run = subprocess.run(["scontrol", "update", "jobid=" + array, "StartTime=now"], capture_output=True,
                                 check=False)
            if run.returncode == 0:
                break
        text = process.communicate(timeout=600)[0]
        self.assertEqual(process.returncode, 0, text)
        self.expect_all(24)
        records = []
        results = os.path.join(self.folder, "out", ".batch", "results")
        for name in os.listdir(results):
            with open(os.path.join(results, name), encoding="utf-8") as file:
                records += [json.loads(line)["output"] for line in file]
        # A job that was cut short has no record.
        self.assertEqual(sorted(records), sorted(set(records)))

    def test_an_array_that_slurm_has_purged_is_submitted_anew(self):
        words = ("--sweep", "n=1:40:1", "--set", "seconds=0.5")
        process = self.start(*words)
        self.wait_for_outputs(1)
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130)
        array = self.array()
        subprocess.run(["scancel", array], check=True)
        for _ in range(600):
            run = subprocess.run(["squeue", "-h", "-t", "all", "-j", array], capture_output=True, text=True, check=False)
            if run.returncode != 0 and "Invalid job id" in run.stderr:
                break
            time.sleep(0.5)
        else:
            self.fail("Slurm keeps the record")
        self.assertLess(len(self.outputs()), 40)
        self.until_all(*words)
        self.assertNotEqual(self.array(), array)
        self.expect_all(40)

    def test_a_refused_option_is_told(self):
        status, text = self.run_all("--sweep", "n=1:3:1", "--", "--partition=nowhere")
        self.assertEqual(status, 1)
        self.assertIn("nowhere", text)


if __name__ == "__main__":
    reason = missing_parts()
    if reason:
        print("skipped: " + reason)
        sys.exit(77)
    unittest.main()
