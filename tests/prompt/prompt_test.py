#!/usr/bin/env python3
"""The prompt of `lissom repl` on a terminal: typed, edited and completed lines, their history, Ctrl-C.

    tests/prompt/prompt_test.py LISSOM
"""
import os
import pty
import select
import signal
import sys
import tempfile
import termios
import time
import unittest
from pathlib import Path

PROGRAM = ""
SECONDS = float(os.environ.get("LISSOM_TEST_SECONDS", "60"))


class Prompt:
    """A program on a terminal of its own, which is closed at the end."""

    def __init__(self, folder, history="history", kind="xterm"):
        values = {**os.environ, "TERM": kind, "HOME": str(folder), "LISSOM_HISTORY": str(folder / history)}
        values.pop("EDITRC", None)
        self.shown, self.status = "", None
        self.child, self.terminal = pty.fork()
        if self.child == 0:
            os.chdir(folder)
            os.execve(PROGRAM, [PROGRAM, "repl"], values)
        self.until("Ctrl-D ends")
        self.until("> ")

    def type(self, keys):
        os.write(self.terminal, keys.encode() if isinstance(keys, str) else keys)

    def until(self, text):
        """Waits for a text, and returns what was shown up to its end."""
        end = time.time() + SECONDS
        while text not in self.shown:
            if time.time() > end:
                raise AssertionError(f"no {text!r} in {self.shown!r}")
            if select.select([self.terminal], [], [], 0.1)[0]:
                try:
                    got = os.read(self.terminal, 4096)
                except OSError:
                    got = b""
                if not got:
                    raise AssertionError(f"ended without {text!r}: {self.shown!r}")
                self.shown += got.decode(errors="replace")
        at = self.shown.index(text) + len(text)
        before, self.shown = self.shown[:at], self.shown[at:]
        return before

    def line(self, keys, answer):
        """Types a line and waits for its answer on a line of its own, and for the next prompt."""
        self.type(keys + "\r")
        self.until("\n" + answer + "\r\n")
        self.until("> ")

    def settings(self):
        return termios.tcgetattr(self.terminal)

    def end(self):
        self.type("\x04")
        end = time.time() + SECONDS
        while self.status is None and time.time() < end:
            if select.select([self.terminal], [], [], 0.05)[0]:
                try:
                    self.shown += os.read(self.terminal, 4096).decode(errors="replace")
                except OSError:
                    pass
            done, status = os.waitpid(self.child, os.WNOHANG)
            if done:
                self.status = os.waitstatus_to_exitcode(status)
        os.close(self.terminal)
        if self.status is None:
            os.kill(self.child, signal.SIGKILL)
            os.waitpid(self.child, 0)
        return self.status


class PromptTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def test_a_line_is_run_and_ctrl_d_ends(self):
        prompt = Prompt(self.folder)
        prompt.line("6 * 7", "42")
        self.assertEqual(prompt.end(), 0)

    def test_keys_edit_the_line(self):
        prompt = Prompt(self.folder)
        for keys, answer in {
                "12\x7f3": "13",                    # Backspace
                "123\x01\x04": "23",                # Ctrl-A, Ctrl-D
                "3\x011\x052": "132",               # Ctrl-A, Ctrl-E
                "13\x1b[D2": "123",                 # left
                "13\x1b[D\x1b[D\x1b[C2": "123",     # right
                "23\x1b[H1": "123",                 # Home
                "23\x1bOH1\x1bOF4": "1234",         # Home and End of other terminals
                "123\x1b[D\x1b[3~": "12",           # Delete
                "1 + 20\x1700": "1",                # Ctrl-W, which leaves "1 + 00"
                "99\x01\x0b7": "7",                 # Ctrl-K
                "1 + 99\x1b[1;5D2": "300",          # a word left
                "12\x14": "21",                     # Ctrl-T
        }.items():
            with self.subTest(keys=keys):
                prompt.line(keys, answer)
        self.assertEqual(prompt.end(), 0)

    def test_characters_are_erased_whole(self):
        prompt = Prompt(self.folder)
        prompt.line("#'a\u00e4'", "3")
        prompt.line("#'a\u00e4\x7f'", "1")
        prompt.line("#'\u6f22\U0001f600'\x1b[D\x1b[D\x7f", "4")
        prompt.end()

    def test_bytes_that_are_no_characters_do_no_harm(self):
        prompt = Prompt(self.folder)
        prompt.type(b"1\xff\xc3\xfe2\r")
        prompt.until("\n12\r\n")
        prompt.until("> ")
        self.assertEqual(prompt.end(), 0)

    def test_tab_completes_names(self):
        prompt = Prompt(self.folder)
        prompt.line("type(lissom.shap\t.box)", "function")
        prompt.end()

    def test_tab_lists_what_begins_alike_and_shows_the_line_again(self):
        prompt = Prompt(self.folder)
        prompt.type("string.re\t\t")
        shown = prompt.until("reverse")
        self.assertIn("rep", shown)
        prompt.until("> string.re")
        prompt.type("p and 5\r")
        prompt.until("\n5\r\n")
        prompt.until("> ")
        prompt.end()

    def test_tab_completes_files_in_strings(self):
        (self.folder / "only_one.txt").write_text("")
        (self.folder / "a folder").mkdir()
        prompt = Prompt(self.folder)
        prompt.line("#'on\t'", str(len("only_one.txt")))
        prompt.line("'a\t'", "a folder/")
        prompt.end()

    def test_a_statement_takes_several_lines(self):
        prompt = Prompt(self.folder)
        prompt.type("for i = 7, 8 do\r")
        prompt.until(">> ")
        prompt.type("print(10 * i)\r")
        prompt.until(">> ")
        prompt.type("end\r")
        prompt.until("\n70\r\n80\r\n")
        prompt.until("> ")
        prompt.type("\x1b[A")
        prompt.until("for i = 7, 8 do print(10 * i) end")
        prompt.type("\r")
        prompt.until("\n70\r\n80\r\n")
        prompt.until("> ")
        prompt.end()

    def test_the_history_lasts_from_run_to_run(self):
        prompt = Prompt(self.folder)
        prompt.line("100 + 1", "101")
        prompt.line("200 + 2", "202")
        prompt.line("200 + 2", "202")
        prompt.line("\x1b[A\x1b[A", "101")
        prompt.end()
        self.assertEqual((self.folder / "history").read_text(), "100 + 1\n200 + 2\n100 + 1\n")
        prompt = Prompt(self.folder)
        prompt.line("\x1b[A\x1b[A", "202")
        prompt.line("\x12" + "100" + "\x05", "101")
        prompt.line("\x10\x10", "202")
        self.assertEqual(prompt.end(), 0)

    def test_the_history_keeps_a_thousand_lines(self):
        (self.folder / "history").write_text("".join(f"{i}\n" for i in range(1500)))
        prompt = Prompt(self.folder)
        prompt.line("\x1b[A", "1499")
        prompt.end()
        lines = (self.folder / "history").read_text().split("\n")
        self.assertEqual(len(lines) - 1, 1000)
        self.assertEqual(lines[-2], "1499")

    def test_ctrl_c_gives_up_a_line(self):
        prompt = Prompt(self.folder)
        prompt.type("no(such")
        prompt.until("no(such")
        prompt.type("\x03")
        prompt.until("^C")
        prompt.until("> ")
        prompt.line("1 + 1", "2")
        prompt.type("for i = 1, 2 do\r")
        prompt.until(">> ")
        prompt.type("\x03")
        prompt.until("^C")
        prompt.line("2 + 2", "4")
        self.assertEqual(prompt.end(), 0)

    def test_ctrl_c_stops_a_script(self):
        prompt = Prompt(self.folder)
        prompt.type("print('be' .. 'gun') while true do end\r")
        prompt.until("\nbegun")
        prompt.type("\x03")
        prompt.until("cancelled")
        prompt.until("> ")
        prompt.line("3 + 3", "6")
        self.assertEqual(prompt.end(), 0)

    def test_scripts_find_the_terminal_as_it_was(self):
        prompt = Prompt(self.folder)
        prompt.type("print('be' .. 'gun') while true do end\r")
        prompt.until("\nbegun")
        flags = prompt.settings()[3]
        self.assertTrue(flags & termios.ICANON and flags & termios.ECHO)
        prompt.type("\x03")
        prompt.until("> ")
        prompt.end()

    def test_a_terminal_without_a_cursor(self):
        for kind in ("dumb", ""):
            with self.subTest(kind=kind):
                prompt = Prompt(self.folder, kind=kind)
                prompt.line("12\x7f3", "13")
                self.assertEqual(prompt.end(), 0)

    def test_lines_longer_than_the_screen(self):
        prompt = Prompt(self.folder)
        prompt.line("#'" + 300 * "x" + "'", "300")
        prompt.end()


if __name__ == "__main__":
    PROGRAM = str(Path(sys.argv.pop(1)).resolve())
    unittest.main()
