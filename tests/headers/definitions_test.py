#!/usr/bin/env python3
"""What definitions.py tells apart."""
import unittest

from definitions import repeated, types_of

NAMED = "namespace a::b {\nstruct Key { int x; struct Inner {}; };\nenum class Kind : char { one };\n}\n"


class Definitions(unittest.TestCase):
    def test_types_of_named_namespaces(self):
        self.assertEqual(list(types_of(NAMED)), ["a::b::Key", "a::b::Kind"])

    def test_others_are_passed_over(self):
        for text in ("namespace a { namespace { struct Key {}; } }", "namespace a { struct Key; }",
                     "namespace a { void f() { struct Key {}; } }", "namespace a { struct Key::State {}; }",
                     '// struct Key {\nconst char* text = "struct Key {";', "namespace a { struct Key f(); }"):
            self.assertEqual(list(types_of(text)), [], text)

    def test_a_second_definition_is_found(self):
        self.assertEqual(repeated([("x.h", NAMED), ("y.h", "namespace a::b { class Key final : Base {}; }")]),
                         {"a::b::Key": ["x.h", "y.h"]})
        self.assertEqual(repeated([("x.h", NAMED), ("y.h", "namespace a { class Key {}; }")]), {})


if __name__ == "__main__":
    unittest.main()
