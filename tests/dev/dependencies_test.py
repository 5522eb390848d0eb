#!/usr/bin/env python3
"""The libraries that ./dev installs, docs/guide/dependencies.md and NOTICE name the same works."""
import re
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
NOTICE = (ROOT / "NOTICE").read_text()
PAGE = (ROOT / "docs/guide/dependencies.md").read_text()
NOT_SHIPPED = ("tests only", "long checks only", "benchmark only", "build of the playground only")


def rows() -> list[list[str]]:
    """Returns the cells of each library's row."""
    lines = [line for line in PAGE.splitlines() if line.startswith("| ")][1:]
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]


def build_packages() -> list[str]:
    """Returns the packages with headers that a build needs."""
    return re.findall(r"^build (\S+-dev)\b", (ROOT / "dev").read_text(), re.MULTILINE)


class DependenciesTest(unittest.TestCase):
    def test_the_page_names_each_package_of_a_build(self):
        packages = build_packages()
        self.assertGreater(len(packages), 10)
        for package in packages:
            if package != "doctest-dev":
                self.assertIn(package, PAGE)

    def test_the_notice_names_each_work_that_users_get(self):
        shipped = [row for row in rows() if row[-1] not in NOT_SHIPPED]
        self.assertGreater(len(shipped), 10)
        for row in shipped:
            work = re.split(r",| \(|\d", row[0])[0].strip()
            self.assertIn(work, NOTICE, f"{row[0]} has no line in NOTICE")


if __name__ == "__main__":
    unittest.main()
