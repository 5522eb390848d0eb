#!/usr/bin/env python3
"""What words.py counts and finds."""
import tempfile
import unittest
from pathlib import Path

import words

PLAIN = "/// Returns the area of a face in squared units of the mesh, measured along its plane.\ndouble area();\n"


def count(text, suffix=".h"):
    total = words.Count()
    found = words.code_passages(text, suffix) if suffix in words.CODE else words.document_passages(text)
    for passage in found:
        total.add(passage)
    return total


class CountTest(unittest.TestCase):
    def test_words_in_comments_and_not_in_code(self):
        total = count("// what, Where and where\nint what(int where);  /* what */\n", ".cpp")
        self.assertEqual((total.hits["what"], total.hits["where"]), (2, 2))
        self.assertEqual(total.words, 5)

    def test_messages_are_sentences_in_strings(self):
        total = count('throw("the file says " "what it holds"); f("what"); f("what/where.obj");\n', ".cpp")
        self.assertEqual((total.hits["what"], total.words), (1, 6))

    def test_a_quote_in_a_character_or_a_slash_in_a_string_opens_nothing(self):
        total = count("""char c = '"'; // what\nauto s = "http://where.what";\nchar d = '"';\n""", ".cpp")
        self.assertEqual((total.hits["what"], total.hits["where"]), (1, 0))

    def test_a_sentence_opens_after_a_stop_over_the_end_of_a_line(self):
        total = count("/// Adds a face. As\n/// before. Sum of faces: As written. (Asked.) Whose face\n")
        self.assertEqual(total.hits["openings"], 2)

    def test_comments_beside_code_stand_alone(self):
        total = count("int a;  // Of the first\nint b;  // Of the second\n")
        self.assertEqual(total.hits["openings"], 2)

    def test_returns_count_in_docstrings_only(self):
        total = count(PLAIN + "// Returns early.\n")
        self.assertEqual(total.hits["returns"], 1)
        self.assertEqual(total.docstring_words, 16)

    def test_a_docstring_begins_with_no_clause(self):
        self.assertEqual(count("/// How a loop is measured.\nint a;\n/// Why. Which of them.\nint b;\n").hits["clauses"], 2)
        self.assertEqual(count("/// Sums faces. How many there are.\nint a;\n// How it works.\n").hits["clauses"], 0)

    def test_lua(self):
        total = count('--- Of all.\n--[[ what ]] local s = "it says what" -- where\nlocal t = [[what is there]]\n', ".lua")
        self.assertEqual((total.hits["openings"], total.hits["what"], total.hits["where"]), (1, 3, 1))

    def test_documents_without_their_code(self):
        total = count("# What\n\nSee `what` and [this](what.md).\n\n```sh\nwhere\n```\n- Where to\n", ".md")
        self.assertEqual((total.hits["what"], total.hits["where"], total.hits["openings"]), (1, 1, 2))


class FindingsTest(unittest.TestCase):
    def run_on(self, files, clean, action):
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder)
            for name, text in {**files, "tests/words/clean.txt": "# Words.\n" + clean}.items():
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text(text)
            return action(root)

    def findings(self, files, clean):
        return self.run_on(files, clean, words.findings)

    def test_all_that_people_read_is_clean(self):
        root = Path(words.__file__).resolve().parents[2]
        self.assertIn(".", words.read_clean(root))
        self.assertEqual([], words.findings(root))

    def test_a_clean_folder(self):
        self.assertEqual(self.findings({"kernel/a.h": PLAIN * 100}, "kernel\n"), [])

    def test_a_folder_over_the_limits(self):
        bad = "/// Of what there is, where it lies.\nint f();\n" * 100
        found = self.findings({"kernel/a.h": bad}, "kernel\n")
        self.assertEqual([line.split()[1] for line in found], ["what", "openings", "where", "returns"])

    def test_only_listed_folders_must_hold(self):
        bad = "// what what what\n" * 20
        files = {"kernel/a.h": PLAIN * 50, "kernel_old/a.cpp": bad, "viewer/a.cpp": bad}
        self.assertEqual(self.findings(files, "kernel\n"), [])

    def test_a_limit_is_rounded_up(self):
        self.assertEqual(self.findings({"kernel/a.cpp": "// what\n" + "// word\n" * 99}, "kernel\n"), [])
        found = self.findings({"kernel/a.cpp": "// what\n" * 2 + "// word\n" * 98}, "kernel\n")
        self.assertEqual(found, ["kernel: what 20.0 per 1,000 words, at most 1.0 (--show kernel)"])

    def test_a_listed_folder_that_is_not_there(self):
        self.assertEqual(self.findings({"kernel/a.cpp": "// words\n"}, "b\n"), ["b: no prose is there"])

    def test_the_lines_shown(self):
        files = {"kernel/a.cpp": "// One.\n// Then what\n// is where?\n", "viewer/b.cpp": "// what\n"}
        shown = self.run_on(files, "", lambda root: words.show(root, "kernel"))
        self.assertEqual(shown, "kernel/a.cpp:2: Then what\nkernel/a.cpp:3: is where?")


if __name__ == "__main__":
    unittest.main()
