"""What abi.py finds, and what it lets pass."""

import unittest

import abi

HEADER = """
#define LISSOM_ABI_VERSION 1
#define lissom_create lissom_create_abi1
typedef enum lissom_kind { LISSOM_ONE = 1, LISSOM_TWO = 2 } lissom_kind;
typedef struct lissom_list {
    size_t struct_size;
    void (*log)(void* user, const char* text);
    double m[12];
    const int* ids;
} lissom_list;
LISSOM_API lissom_kind lissom_create(const lissom_list* list,
                                     int** made);
LISSOM_API const char* lissom_name(void);
LISSOM_EXPERIMENTAL LISSOM_API int lissom_try(int a,
                                              int b);
"""

BEFORE = abi.entries([
    "function lissom_name",
    "constant LISSOM_ONE 1",
    "struct lissom_list 40",
    "field lissom_list.struct_size 0 8",
    "field lissom_list.m 8 32",
    "struct lissom_id 8",
    "field lissom_id.id 0 8",
])


class Header(unittest.TestCase):
    def test_names_are_read(self):
        self.assertEqual(abi.functions(HEADER), ["lissom_create_abi1", "lissom_name"])
        self.assertIn("lissom_try", abi.every_function(HEADER))
        self.assertEqual(abi.constants(HEADER), ["LISSOM_ABI_VERSION", "LISSOM_ONE", "LISSOM_TWO"])
        self.assertEqual(abi.structs(HEADER), [("lissom_list", ["struct_size", "log", "m", "ids"])])

    def test_signatures_hold_types_alone(self):
        self.assertEqual(list(abi.signatures(HEADER)), [
            "function lissom_create_abi1 lissom_kind(const_lissom_list*,int**)",
            "function lissom_name const_char*()",
            "experimental lissom_try int(int,int)",
            "callback lissom_list.log void(void*,const_char*)",
        ])
        self.assertEqual(abi.signature("lissom_status ", "const double point[3], void (*f)(void* a, int b)"),
                         "lissom_status(const_double[3],void_(*f)(void*a,int_b))")

    def test_comments_are_no_declarations(self):
        self.assertEqual(abi.functions(abi.without_comments("// LISSOM_API int lissom_no(void);\n")), [])


class Breaks(unittest.TestCase):
    def broken(self, **changes):
        now = dict(BEFORE)
        for key, value in changes.items():
            kind, name = key.split("__", 1)
            now.pop((kind, name.replace("__", ".")), None)
            if value is not None:
                now[kind, name.replace("__", ".")] = value
        return list(abi.differences(BEFORE, now))

    def test_what_may_change(self):
        self.assertEqual(self.broken(function__lissom_new="", constant__LISSOM_NEW="7"), [])
        self.assertEqual(self.broken(struct__lissom_list="48", field__lissom_list__more="40 8"), [])

    def test_types_of_a_function_stay(self):
        before = abi.entries(["function lissom_a int(int)", "callback lissom_b void(int)", "function lissom_c",
                              "experimental lissom_d int()"])
        after = abi.entries(["function lissom_a int(long)", "callback lissom_b void()", "function lissom_c int()"])
        self.assertEqual(list(abi.differences(before, after)),
                         ["function lissom_a was int(int), and is int(long)",
                          "callback lissom_b was void(int), and is void()"])

    def test_what_may_not(self):
        for change in (
            {"function__lissom_name": None},
            {"constant__LISSOM_ONE": "2"},
            {"struct__lissom_list": "32"},
            {"field__lissom_list__m": "16 32"},
            {"field__lissom_list__m": None},
            {"struct__lissom_id": "16"},
        ):
            with self.subTest(change):
                self.assertEqual(len(self.broken(**change)), 1)


if __name__ == "__main__":
    unittest.main()
