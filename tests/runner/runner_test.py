#!/usr/bin/env python3
"""Tests `lissom test` from outside: what it runs, reports and leaves behind.
Usage: runner_test.py PROGRAM ROOT"""
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
import xml.etree.ElementTree as ElementTree

PROGRAM = os.path.abspath(sys.argv.pop(1))
ROOT = os.path.abspath(sys.argv.pop(1))

# A test of each kind of ending, in the order in which they are told.
ENDINGS = r'''
local lissom = require "lissom"
test("passes", function() expect.equal({ 1, { a = 2 } }, { 1, { a = 2 } }) end)
test("fails", function()
    print("printed before")
    expect.equal({ report = { joins = { { scale = 2 } } } }, { report = { joins = { { scale = 3 } } } })
end)
test("errs", function()
    local nothing
    return nothing.field
end)
test("never ends", function()
    while true do pcall(function() while true do end end) end
end, { timeout = 0.3 })
test("works on in the kernel", function()
    lissom.shapes.grid():boundaries()[1]:smooth{ iterations = 2147483647 }
end, { timeout = 0.3 })
test("exits", function() os.exit(0) end)
test("dies", function()
    io.write("last words")
    os.execute("kill -SEGV $PPID")
end)
test("is skipped", function() test.skip("no model") end)
test("passes after all", function() end)
'''


class Folder(unittest.TestCase):
    """A test with a folder of its own, in which the program runs."""

    def setUp(self):
        self.folder = os.path.realpath(tempfile.mkdtemp(prefix="lissom-runner-"))
        self.temporary = os.path.join(self.folder, "tmp")
        os.mkdir(self.temporary)

    def tearDown(self):
        shutil.rmtree(self.folder)

    def write(self, name, text):
        path = os.path.join(self.folder, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return path

    def environment(self, **changes):
        variables = dict(os.environ, TMPDIR=self.temporary)
        for name in ("LISSOM_REQUIRE_GL", "LISSOM_THREADS", "DISPLAY"):
            variables.pop(name, None)
        variables.update(changes)
        return variables

    def run_tests(self, *words, status=None, **variables):
        ended = subprocess.run([PROGRAM, "test", *words], cwd=self.folder, capture_output=True,
                               text=True, timeout=300, check=False,
                               env=self.environment(**variables))
        if status is not None:
            self.assertEqual(ended.returncode, status, ended.stdout + ended.stderr)
        return ended

    def results(self, *words, status=None, **variables):
        """The results by name."""
        ended = self.run_tests("--json", *words, status=status, **variables)
        return {test["name"]: test for test in json.loads(ended.stdout)["tests"]}

    def left_over(self):
        return os.listdir(self.temporary)


class Endings(Folder):
    def setUp(self):
        super().setUp()
        self.write("endings_test.lua", ENDINGS)

    def test_each_ending_is_told_and_the_rest_still_runs(self):
        tests = self.results("endings_test.lua", status=1)
        self.assertEqual([(name, test["status"]) for name, test in tests.items()], [
            ("passes", "passed"), ("fails", "failed"), ("errs", "failed"), ("never ends", "failed"),
            ("works on in the kernel", "failed"), ("exits", "failed"), ("dies", "failed"),
            ("is skipped", "skipped"), ("passes after all", "passed")])
        self.assertEqual(tests["fails"]["message"], "at .report.joins[1].scale: expected 3, got 2")
        self.assertEqual(tests["fails"]["at"], {"file": "endings_test.lua", "line": 6})
        self.assertEqual(tests["fails"]["kind"], "expectation")
        self.assertEqual(tests["fails"]["output"], "printed before\n")
        self.assertEqual(tests["errs"]["kind"], "error")
        self.assertEqual(tests["errs"]["at"]["line"], 10)
        for name in ("never ends", "works on in the kernel"):
            self.assertEqual(tests[name]["message"], "it took longer than 0.3 s")
        self.assertIn("status 0", tests["exits"]["message"])
        self.assertIn("signal 11", tests["dies"]["message"])
        self.assertEqual(tests["dies"]["output"], "last words")
        self.assertEqual(tests["dies"]["at"]["line"], 19)
        self.assertEqual(tests["is skipped"]["message"], "no model")
        self.assertNotIn("output", tests["passes after all"])
        self.assertEqual(self.left_over(), [])

    def test_the_text_names_places_and_counts(self):
        text = self.run_tests("endings_test.lua", status=1).stdout
        self.assertIn("FAILED  endings_test.lua  (6 of 9 tests, ", text)
        self.assertIn("endings_test.lua:6: at .report.joins[1].scale: expected 3, got 2\n", text)
        self.assertIn("  6 |     expect.equal({ report", text)
        self.assertIn("| printed before\n", text)
        self.assertIn("  skipped: endings_test.lua: is skipped: no model\n", text)
        self.assertRegex(text, r"\n2 passed, 6 failed, 1 skipped \(1 file, [\d.]+ s\)\n$")
        self.assertNotIn("passes after all", text)
        self.assertIn("passes after all",
                      self.run_tests("--verbose", "endings_test.lua", status=1).stdout)

    def test_junit_is_xml(self):
        self.write("odd_test.lua", r'''test("<&\"\0\1\255]]> ü", function()
            print("\27[1m <b> \255")
            error("a & b < c ]]> \2")
        end)''')
        text = self.run_tests("--format", "junit", ".", status=1).stdout
        root = ElementTree.fromstring(text)
        self.assertEqual(root.tag, "testsuites")
        self.assertEqual([suite.get("name") for suite in root], ["endings_test.lua", "odd_test.lua"])
        self.assertEqual({key: root.get(key) for key in ("tests", "failures", "errors", "skipped")},
                         {"tests": "10", "failures": "1", "errors": "6", "skipped": "1"})
        cases = {case.get("name"): case for case in root.iter("testcase")}
        self.assertIn("expected 3, got 2", cases["fails"].find("failure").get("message"))
        self.assertIn("endings_test.lua:6: ", cases["fails"].find("failure").text)
        self.assertEqual(cases["fails"].find("system-out").text, "printed before\n")
        self.assertEqual(cases["is skipped"].find("skipped").get("message"), "no model")
        self.assertEqual(len(cases["passes"]), 0)
        odd = next(case for name, case in cases.items() if name.startswith("<&"))
        self.assertEqual(odd.get("name"), '<&"??\ufffd]]> ü')
        self.assertIn("a & b < c ]]> ?", odd.find("error").get("message"))

    def test_tap_is_parsed(self):
        lines = self.run_tests("--format", "tap", "endings_test.lua", status=1).stdout.splitlines()
        self.assertEqual(lines[0], "TAP version 13")
        self.assertEqual(lines[-1], "1..9")
        points, details, block = [], {}, None
        for line in lines[1:-1]:
            found = re.fullmatch(r"(not )?ok (\d+) - ([^#]*[^# ])(?: # SKIP (.*))?", line)
            if found:
                self.assertEqual(int(found.group(2)), len(points) + 1)
                points.append((found.group(3), not found.group(1), found.group(4)))
            elif line == "  ---":
                block = details.setdefault(points[-1][0], {})
            elif line == "  ...":
                block = None
            else:
                self.assertIsNotNone(block, line)
                key, value = line.strip().split(": ", 1)
                block[key] = json.loads(value)
        self.assertEqual(points[0], ("endings_test.lua: passes", True, None))
        self.assertEqual(points[7], ("endings_test.lua: is skipped", True, "no model"))
        self.assertEqual([ok for _, ok, _ in points].count(False), 6)
        self.assertEqual(details["endings_test.lua: fails"]["at"], "endings_test.lua:6")

    def test_tap_hides_no_name_behind_a_directive(self):
        self.write("one_test.lua", "test('a # SKIP \\\\ b', function() end)")
        lines = self.run_tests("--format", "tap", "one_test.lua", status=0).stdout.splitlines()
        self.assertEqual(lines[1], r"ok 1 - one_test.lua: a \# SKIP \\ b")

    def test_a_report_goes_to_a_file_and_the_text_to_the_output(self):
        ended = self.run_tests("--format", "junit", "--output", "results.xml", ".", status=1)
        self.assertIn("2 passed, 6 failed", ended.stdout)
        root = ElementTree.parse(os.path.join(self.folder, "results.xml")).getroot()
        self.assertEqual(root.get("tests"), "9")

    def test_a_filter_is_a_part_of_the_name_or_a_pattern(self):
        self.assertEqual(list(self.results("--filter", "passes", ".", status=0)),
                         ["passes", "passes after all"])
        self.assertEqual(list(self.results("--filter", "^passes$", ".", status=0)), ["passes"])
        self.assertEqual(list(self.results("--filter", "is [", ".", status=1)), [])

    def results(self, *words, status=None, **variables):
        if "is [" in words:  # no pattern, and part of no name
            ended = self.run_tests(*words, status=status)
            self.assertIn("no test is called 'is ['", ended.stderr)
            return {}
        return super().results(*words, status=status, **variables)

    def test_tests_are_listed_and_not_run(self):
        text = self.run_tests("--list", ".", status=0).stdout
        self.assertEqual(text.splitlines()[:2],
                         ["endings_test.lua:3: passes", "endings_test.lua:4: fails"])
        self.assertEqual(len(text.splitlines()), 9)


class Files(Folder):
    def file_failure(self, text, **variables):
        path = self.write("one_test.lua", text)
        tests = self.results(os.path.basename(path), status=1, **variables)
        self.assertEqual(list(tests), [""])
        return tests[""]

    def test_a_file_that_cannot_be_run_fails(self):
        syntax = self.file_failure("test(\n\n= 1")
        self.assertEqual(syntax["at"], {"file": "one_test.lua", "line": 3})
        self.assertIn("unexpected symbol", syntax["message"])
        self.assertEqual(self.file_failure("\nerror('at load')")["at"]["line"], 2)
        self.assertIn("declares no test", self.file_failure("local a = 1")["message"])
        self.assertIn("status 7", self.file_failure("os.exit(7)")["message"])
        self.assertIn("signal 9", self.file_failure("os.execute('kill -KILL $PPID')")["message"])
        self.write("one_test.lua", "while true do end")
        ended = self.run_tests("--timeout", "0.3", "one_test.lua", status=1)
        self.assertIn("it took longer than 0.3 s", ended.stdout)

    def test_mistakes_in_declarations_are_told_with_their_line(self):
        for text, message in [
                ("test('a', function() end)\ntest('a', function() end)", "declared before, in line 1"),
                ("\ntest('a')", "a function is needed, got nil"),
                ("\ntest(function() end)", "a name is needed"),
                ("\ntest('a', function() end, { timeuot = 1 })", 'no option "timeuot"'),
                ("\ntest.befor(print)", "no 'test.befor'; there are: after, before, "),
                ("\nexpect.eqal(1, 1)", "no 'expect.eqal'; there are: equal, "),
                ("\ntest.folder()", "only while a test runs")]:
            failure = self.file_failure(text)
            self.assertIn(message, failure["message"])
            self.assertEqual(failure["at"]["line"], 2, text)

    def test_a_file_skips_itself(self):
        self.write("one_test.lua", "test('a', function() end)\ntest.skip('not here')")
        tests = self.results("one_test.lua", status=0)
        self.assertEqual((tests[""]["status"], tests[""]["message"]), ("skipped", "not here"))

    def test_folders_are_searched(self):
        declaration = "test('runs', function() end)"
        for name in ("b/one_test.lua", "a/two_test.lua", "scenes/bend.lua", "scenes/deep/far.lua",
                     "b/helper.lua", ".hidden/three_test.lua", "c_test.txt"):
            self.write(name, declaration)
        self.write("scenes/events.lua", "return {}")
        listed = self.run_tests("--list", ".", status=0).stdout
        self.assertEqual([line.split(":")[0] for line in listed.splitlines()],
                         ["a/two_test.lua", "b/one_test.lua", "scenes/bend.lua", "scenes/deep/far.lua"])
        for folder in ("scenes", "scenes/.", "./scenes/"):
            within = self.run_tests("--list", folder, status=0).stdout
            self.assertEqual(len(within.splitlines()), 2)
        os.symlink("..", os.path.join(self.folder, "scenes/deep/up"))
        self.assertEqual(len(self.run_tests("--list", ".", status=0).stdout.splitlines()), 4)
        twice = self.run_tests("--list", "b/helper.lua", "b", "b/one_test.lua", status=0).stdout
        self.assertEqual([line.split(":")[0] for line in twice.splitlines()],
                         ["b/helper.lua", "b/one_test.lua"])

    def test_wrong_calls(self):
        self.write("a_test.lua", "test('runs', function() end)")
        self.assertIn("PATH is required", self.run_tests(status=2).stderr)
        self.run_tests("--format", "html", ".", status=2)
        self.run_tests("--jobs", "0", ".", status=2)
        self.run_tests("--timeout", "-1", ".", status=2)
        self.assertIn("no such file or folder", self.run_tests("none", status=1).stderr)
        os.mkdir(os.path.join(self.folder, "empty"))
        self.assertIn("there are no tests in empty", self.run_tests("empty", status=1).stderr)

    def test_another_verb_says_who_runs_tests(self):
        self.write("a_test.lua", "test('runs', function() end)")
        ended = subprocess.run([PROGRAM, "run", "a_test.lua"], cwd=self.folder, capture_output=True,
                               text=True, check=False)
        self.assertIn("tests are run by: lissom test a_test.lua", ended.stderr)

    def test_paths_are_relative_to_the_file_and_modules_are_found_beside_it(self):
        self.write("deep/folder/helper.lua", "return { check = function(a) expect.equal(a, 1) end }")
        self.write("deep/folder/data.txt", "content")
        self.write("deep/folder/a_test.lua", '''local helper = require "helper"
            test("reads", function()
                expect.equal(assert(io.open("data.txt")):read("a"), "content")
            end)
            test("fails in a helper", function()
                helper.check(2)
            end)''')
        tests = self.results("deep", status=1)
        self.assertEqual(tests["reads"]["status"], "passed")
        failure = tests["fails in a helper"]
        self.assertTrue(failure["at"]["file"].endswith("deep/folder/helper.lua"))
        self.assertEqual(failure["callers"], [{"file": "deep/folder/a_test.lua", "line": 6}])

    def test_names_longer_than_lua_shows_are_whole(self):
        name = "a_folder_with_a_long_name/" * 4 + "long_test.lua"
        self.write(name, '''test("fails", function()
                error("here")
            end)
            test("drops", function()
                local box = require("lissom").shapes.box()
                box:save("no/folder.obj")
            end)''')
        tests = self.results(".", status=1)
        self.assertEqual(tests["fails"]["at"], {"file": name, "line": 2})
        self.assertEqual(tests["drops"]["at"], {"file": name, "line": 6})


class Scripts(Folder):
    def test_groups_and_hooks(self):
        self.write("one_test.lua", '''
            local log = {}
            test.before(function() log[#log + 1] = "file" end)
            test.group("outer", function()
                test.before(function() log[#log + 1] = "outer" end)
                test.after(function() log[#log + 1] = "after outer" end)
                test.group("inner", function()
                    test.after(function() log[#log + 1] = "after inner" end)
                    test("first", function() log[#log + 1] = "first"; error("on purpose") end)
                end)
                test("hooks", function()
                    expect.equal(table.concat(log, ", "),
                        "file, outer, first, after inner, after outer, file, outer")
                end)
            end)
            test.group("broken", function()
                test.after(function() error("in the hook") end)
                test("fails by its hook", function() end)
            end)''')
        tests = self.results("one_test.lua", status=1)
        self.assertEqual({name: test["status"] for name, test in tests.items()},
                         {"outer / inner / first": "failed", "outer / hooks": "passed",
                          "broken / fails by its hook": "failed"})
        self.assertIn("in the hook", tests["broken / fails by its hook"]["message"])

    def test_a_seed_gives_the_same_numbers_in_every_test(self):
        self.write("one_test.lua", '''for i = 1, 2 do
            test("test " .. i, function() print(math.random(1, 1e9)) end)
        end''')
        outputs = [test["output"] for test in self.results("one_test.lua").values()]
        self.assertEqual(outputs[0], outputs[1])
        alone = self.results("--filter", "test 2", "one_test.lua")["test 2"]["output"]
        self.assertEqual(alone, outputs[1])
        other = self.results("--seed", "2", "one_test.lua")["test 1"]["output"]
        self.assertNotEqual(other, outputs[0])

    def test_files_of_a_failed_test_are_kept(self):
        self.write("one_test.lua", '''local function write(name)
            local file = assert(io.open(test.file(name), "w"))
            file:write(test.folder())
            file:close()
        end
        test("passes", function() write("a.txt") end)
        test("fails: twice?", function()
            write("b.txt")
            error("on purpose")
        end)''')
        tests = self.results("one_test.lua", status=1)
        folder = tests["fails: twice?"]["folder"]
        self.assertTrue(folder.endswith("1-one_test/02-fails-twice"), folder)
        self.assertEqual(os.listdir(folder), ["b.txt"])
        self.assertEqual(len(self.left_over()), 1)
        self.assertNotIn("folder", tests["passes"])
        self.assertEqual(os.listdir(os.path.dirname(folder)), ["02-fails-twice"])

    def test_a_failure_of_the_library_fails_the_test_at_its_line(self):
        self.write("one_test.lua", '''local lissom = require "lissom"
            test("calls", function()
                local box = lissom.shapes.box()
                box:save("no/folder.obj")
            end)
            test("returns", function() return lissom.shapes.box():save("no/folder.obj") end)
            test("looks", function() lissom.try(lissom.load, "none.obj") end)''')
        tests = self.results("one_test.lua", status=1)
        self.assertEqual([test["status"] for test in tests.values()], ["failed", "failed", "passed"])
        self.assertEqual(tests["calls"]["at"]["line"], 4)
        self.assertIn("[file_write_failed]", tests["calls"]["message"])
        self.assertIn("[file_write_failed]", tests["returns"]["message"])

    def test_messages_of_expectations(self):
        cases = [
            ("expect.near(1.5, 1.25, 0.1)", "expected 1.25, got 1.5, which is 0.25 away (0.1 allowed)"),
            ("expect.near({ 1, { 2 } }, { 1, { 3 } })",
             "at [2][1]: expected 3, got 2, which is 1 away (1e-09 allowed)"),
            ("expect.near(0 / 0, 1)", "expected 1, got nan"),
            ("expect.near(1 / 0, 1 / 0)", None),
            ("expect.near({ 1, 2 }, { 1 })", "at [2]: expected nil, got 2"),
            ("expect.near(require'lissom'.shapes.box():positions(), { 1 })", "at [1]: expected 1, got -0.5"),
            ("expect.equal(1, '1')", 'expected "1", got 1'),
            ("expect.equal(nil, false)", "expected false, got nil"),
            ("expect.equal({ a = 1 }, { a = 1, b = {} })", "at .b: expected {}, got nil"),
            ("expect.equal({ ['a b'] = 1 }, { ['a b'] = 2 })", 'at ["a b"]: expected 2, got 1'),
            ("local a, b = {}, {}; a.a = a; b.a = b; expect.equal(a, b)", None),
            ("expect.equal(('x'):rep(99) .. 'y', ('x'):rep(99) .. 'z')", "they differ at byte 100: "),
            ("local box = require'lissom'.shapes.box(); expect.equal(box, box:copy())", None),
            ("local got, most = 7, 5; expect.truthy(got < most)", "with got = 7, most = 5"),
            ("local s = { n = { 1 } }; expect.falsy(s.n)", "s.n = { 1 }"),
            ("expect.error(function() error('abc') end, 'b')", None),
            ("expect.error(function() error('abc') end, 'x')", 'expected an error with "x", got '),
            ("expect.error(function() return 1 end)", "expected an error, but there was none"),
            ("expect.failure('zero_area', require'lissom'.error, { message = 'text' })",
             'expected the failure "zero_area", got '),
            ("expect.failure('zero_area', function() return 1 end)",
             'expected the failure "zero_area", got 1'),
            ("expect.failure('zero_area', 1)", "a function to call is needed, got 1"),
            ("expect.failure('zero_area', require'lissom'.error, { message = 'a', code = 'zero_area' })", None),
            ("expect.hash(require'lissom'.shapes.box(), 'x')", 'expected the hash "x", got "'),
            ("expect.hash(1, 'x')", "an object with a hash is needed, got 1"),
            ("expect.near(1, 1, -1)", "the tolerance must be a number of at least 0, got -1"),
        ]
        text = "".join(f"test('{i}', function() {code} end)\n" for i, (code, _) in enumerate(cases))
        text = re.sub(r"^test\('(\d+)', function\(\) ", r"test('\1', function() ", text, flags=re.M)
        self.write("one_test.lua", text)
        tests = self.results("one_test.lua", status=1)
        for i, (code, message) in enumerate(cases):
            test = tests[str(i)]
            self.assertEqual(test["status"], "failed" if message else "passed", code)
            if message:
                self.assertIn(message, test["message"], code)
                self.assertEqual(test["at"], {"file": "one_test.lua", "line": i + 1}, code)


    def test_the_annotations_name_what_there_is(self):
        self.write("one_test.lua", '''test("names", function()
                for name, functions in pairs{ test = test, expect = expect } do
                    for key in pairs(functions) do print(name .. "." .. key) end
                end
            end)''')
        names = self.results("one_test.lua")["names"]["output"].split()
        with open(os.path.join(ROOT, "bindings/lua/meta/lissom_testing.lua"), encoding="utf-8") as file:
            annotated = re.findall(r"^function ([\w.]+)\(", file.read(), flags=re.M)
        self.assertEqual(sorted(annotated), sorted(names))
        with open(os.path.join(ROOT, "docs/testing.md"), encoding="utf-8") as file:
            documentation = file.read()
        for name in names:
            self.assertIn(name, documentation)


class Processes(Folder):
    def test_five_hundred_files_side_by_side(self):
        for i in range(500):
            self.write(f"many/n{i:03}_test.lua",
                       f"test('test {i}', function() expect.truthy({i} ~= 250) end)")
        ended = self.run_tests("--jobs", "8", "many", status=1)
        named = re.findall(r"many/(n\d+)_test\.lua  \(", ended.stdout)
        self.assertEqual(named, [f"n{i:03}" for i in range(500)])
        self.assertRegex(ended.stdout, r"\n499 passed, 1 failed \(500 files, ")

    def test_the_order_does_not_depend_on_the_jobs(self):
        for i in range(6):
            self.write(f"n{i}_test.lua", f'''test("late", function()
                local start = os.clock()
                while os.clock() < start + {0.06 * (6 - i)} do end
            end)''')
        def order(jobs):
            text = self.run_tests("--jobs", jobs, "--format", "tap", ".", status=0).stdout
            return text.splitlines()
        self.assertEqual(order("6"), order("1"))

    def test_a_limit_of_the_system_that_ends_the_process_is_a_crash(self):
        self.write("one_test.lua", '''test("takes all its time", function()
                while true do end
            end)
            test("still runs", function() end)''')
        ended = subprocess.run(
            ["sh", "-c", f"ulimit -t 1; exec '{PROGRAM}' test --json one_test.lua"], cwd=self.folder,
            capture_output=True, text=True, timeout=60, check=False, env=self.environment())
        tests = {test["name"]: test for test in json.loads(ended.stdout)["tests"]}
        self.assertIn("the process crashed: signal ", tests["takes all its time"]["message"])
        self.assertEqual(tests["still runs"]["status"], "passed")

    def test_what_cannot_be_stopped_is_killed(self):
        self.write("one_test.lua", '''test("sleeps", function()
                os.execute("sleep 60")
            end, { timeout = 0.2 })
            test("still runs", function() end)''')
        start = time.monotonic()
        tests = self.results("one_test.lua", status=1)
        self.assertLess(time.monotonic() - start, 30)
        self.assertIn("could not be stopped within 5 s", tests["sleeps"]["message"])
        self.assertEqual(tests["still runs"]["status"], "passed")
        self.assertEqual(self.processes(), [])

    @unittest.skipUnless(sys.platform == "linux", "processes are looked for in /proc")
    def test_ctrl_c_ends_all_and_leaves_nothing(self):
        self.write("a_test.lua", "test('waits', function() os.execute('sleep 60') end)")
        self.write("b_test.lua", "test('spins', function() while true do end end)")
        with subprocess.Popen([PROGRAM, "test", "--jobs", "2", "."], cwd=self.folder, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              env=self.environment()) as process:
            self.wait_for_processes(3)
            process.send_signal(signal.SIGINT)
            _, errors = process.communicate(timeout=20)
        self.assertEqual(process.returncode, 130)
        self.assertIn("stopped by Ctrl-C", errors)
        self.assertEqual(self.left_over(), [])
        self.assertEqual(self.processes(), [])

    @unittest.skipUnless(sys.platform == "linux", "processes are looked for in /proc")
    def test_a_killed_run_leaves_no_process(self):
        self.write("b_test.lua", "test('spins', function() while true do end end)")
        with subprocess.Popen([PROGRAM, "test", "."], cwd=self.folder, env=self.environment()) as process:
            self.wait_for_processes(2)
            process.kill()
        self.wait_for_processes(0)

    def wait_for_processes(self, count):
        """Until so many of the program work in the folder of this test; a loaded machine starts them late."""
        for _ in range(300):
            if len(self.processes()) == count or len(self.processes()) > count > 0:
                return
            time.sleep(0.1)
        self.fail(f"not {count} processes: {self.processes()}")

    def processes(self):
        """Those of the program that work in the folder of this test."""
        found = []
        for process in filter(str.isdigit, os.listdir("/proc")):
            try:
                if os.readlink(f"/proc/{process}/cwd").startswith(self.folder):
                    found.append(process)
            except OSError:
                pass
        return found


DRAWS = "lissom render" in subprocess.run([PROGRAM, "--help"], capture_output=True, text=True,
                                          check=True).stdout
PICTURES = '''local lissom = require "lissom"
local function scene(size)
    return { mesh = lissom.shapes.box{ size = { 1, 1, size } }, size = { 120, 90 }, occlusion = 0 }
end
test("from a file", function()
    local options = { mesh = lissom.shapes.box(), size = { 60, 60 }, file = test.file("a.png") }
    local file = assert(lissom.render(options))
    expect.picture(file, "golden/a.png")
end)
test("by its options", function() expect.picture(scene(SIZE), "golden/b.png") end)
'''


class Pictures(Folder):
    def picture_tests(self, size=1, **variables):
        self.write("one_test.lua", PICTURES.replace("SIZE", str(size)))
        return self.results("one_test.lua", **variables)

    def can_draw(self):
        self.write("can_test.lua", '''local lissom = require "lissom"
            test("draws", function()
                assert(lissom.render{ mesh = lissom.shapes.box(), file = test.file("a.png") })
            end)''')
        can = self.results("can_test.lua")["draws"]["status"] == "passed"
        if DRAWS and not can and "LISSOM_REQUIRE_GL" in os.environ:
            self.fail("LISSOM_REQUIRE_GL is set, and nothing can be drawn here")
        if not can:
            self.skipTest("nothing can be drawn here")

    def test_golden_pictures_are_written_and_compared(self):
        self.can_draw()
        missing = self.picture_tests(status=1)
        self.assertIn("there is no golden picture golden/a.png yet; lissom test --update writes it",
                      missing["from a file"]["message"])
        updated = self.run_tests("--update", "one_test.lua", status=0).stdout
        self.assertIn("  wrote golden/a.png\n  wrote golden/b.png\n", updated)
        self.assertIn("2 passed, 0 failed, 2 pictures written", updated)
        self.assertNotIn("wrote", self.run_tests("--update", "one_test.lua", status=0).stdout)
        self.picture_tests(status=0)

        for folder in self.left_over():
            shutil.rmtree(os.path.join(self.temporary, folder))
        failed = self.picture_tests(size=1.3, status=1)["by its options"]
        self.assertRegex(failed["message"], r"^[\d.]+ % of the pixels differ from b.png by more than 0.05 ")
        difference = failed["message"].split(": ")[-1]
        self.assertTrue(difference.endswith("/b.difference.png") and os.path.exists(difference))
        self.assertEqual(sorted(os.listdir(failed["folder"])), ["b.difference.png", "b.png"])

    def test_sizes_and_what_is_no_picture(self):
        self.can_draw()
        self.write("one_test.lua", PICTURES.replace("SIZE", "1"))
        self.run_tests("--update", "one_test.lua", status=0)
        shutil.copy(os.path.join(self.folder, "golden/a.png"), os.path.join(self.folder, "golden/b.png"))
        tests = self.picture_tests(status=1)
        self.assertIn("expected 60 x 60 pixels as golden/b.png has, got 120 x 90 pixels",
                      tests["by its options"]["message"])
        self.write("golden/b.png", "no picture")
        self.assertIn("golden/b.png: the bytes are no PNG picture",
                      self.picture_tests(status=1)["by its options"]["message"])

    def test_wrong_options_of_a_picture_are_told_with_their_line(self):
        self.can_draw()
        self.write("one_test.lua", '''local lissom = require "lissom"
            test("draws", function()
                expect.picture({ mesh = lissom.shapes.box(), szie = 5 }, "a.png")
            end)
            test("compares", function() expect.picture("a.png", "b.png", { t = 1 }) end)''')
        tests = self.results("one_test.lua", status=1)
        self.assertIn("unknown option 'szie'", tests["draws"]["message"])
        self.assertEqual(tests["draws"]["at"], {"file": "one_test.lua", "line": 3})
        self.assertIn("no option \"t\"; there are tolerance, pixels and connected", tests["compares"]["message"])

    @unittest.skipUnless(DRAWS, "the program was built without the viewer")
    def test_without_opengl_pictures_are_left_out_and_told(self):
        blind = {"EGL_PLATFORM": "none", "__EGL_VENDOR_LIBRARY_FILENAMES": "/nonexistent.json"}
        tests = self.picture_tests(status=0, **blind)
        self.assertEqual(tests["from a file"]["status"], "skipped")
        self.assertEqual(tests["by its options"]["status"], "passed")
        self.assertEqual(len(tests["by its options"]["left_out"]), 1)
        text = self.run_tests("one_test.lua", status=0, **blind).stdout
        self.assertIn("1 passed, 0 failed, 1 skipped, 1 picture not compared", text)
        required = self.picture_tests(status=1, LISSOM_REQUIRE_GL="1", **blind)
        self.assertEqual([test["status"] for test in required.values()], ["failed", "failed"])
        self.assertIn("LISSOM_REQUIRE_GL is set", required["by its options"]["message"])


if __name__ == "__main__":
    unittest.main()
