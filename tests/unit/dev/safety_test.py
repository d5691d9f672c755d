# SPDX-License-Identifier: BSD-3-Clause
"""docs/safety.md names tests as evidence: they have to exist."""
import fnmatch
import pathlib
import re
import unittest

_ROOT = pathlib.Path(__file__).resolve().parents[3]
_PAGE = (_ROOT / "docs" / "safety.md").read_text(encoding="utf-8")
_ID = re.compile(r"[A-Z]{1,3}-[0-9]+")


def rows(page):
    """Cells of the tables' rows that begin with an id."""
    cells = [[cell.strip() for cell in line.strip().strip("|").split("|")] for line in page.splitlines()
             if line.startswith("|")]
    return [row for row in cells if _ID.fullmatch(row[0])]


def is_requirement(row):
    """Not an assumption, a check of the sources or a deviation from a rule."""
    return not row[0].startswith(("U-", "C-", "D-"))


def evidence(row):
    """Tests and files that a row names, e.g. `Suite.Name`, `firmware.image_cortex-m7`, `tests/fuzz/fuzz_sequence.cc`."""
    return re.findall(r"`([^`\s]+)`", row[2]) if is_requirement(row) else []


def tests_in_sources(root):
    """Patterns of the names that CTest knows: of GoogleTest's macros, and of add_test, whose names may hold variables."""
    names = set()
    for path in (root / "tests").rglob("*_test.cc"):
        text = path.read_text(encoding="utf-8")
        names |= {re.escape(suite + "." + name)
                  for suite, name in re.findall(r"\b(?:TYPED_)?TEST(?:_F|_P)?\(\s*(\w+),\s*(\w+)\s*\)", text)}
    for path in (root / "tests").rglob("CMakeLists.txt"):
        for name in re.findall(r"add_test\(\s*NAME\s+(\S+)", path.read_text(encoding="utf-8")):
            parts = re.split(r"\$\{\w+\}", name)
            names.add("[^ ]+".join(re.escape(part) for part in parts))
    return names


def missing(items, root):
    patterns = re.compile("|".join(sorted(tests_in_sources(root))))
    return [item for item in items if not (root / item).is_file() and not patterns.fullmatch(item)]


class SafetyPage(unittest.TestCase):
    def test_every_id_is_used_once(self):
        ids = [row[0] for row in rows(_PAGE)]
        self.assertGreater(len(ids), 30)
        self.assertEqual(sorted(set(ids)), sorted(ids))

    def test_ids_are_numbered_without_gaps(self):
        numbers = {}
        for row in rows(_PAGE):
            group, _, number = row[0].partition("-")
            numbers.setdefault(group, []).append(int(number))
        for group, found in numbers.items():
            self.assertEqual(found, list(range(1, len(found) + 1)), group)

    def test_every_requirement_has_evidence(self):
        for row in rows(_PAGE):
            if is_requirement(row):
                self.assertTrue(evidence(row), row[0])

    def test_all_evidence_exists(self):
        items = [item for row in rows(_PAGE) for item in evidence(row) if item != "static_assert"]
        self.assertEqual(missing(items, _ROOT), [])

    def test_a_test_that_is_gone_would_be_noticed(self):
        gone = ["Tracker.RefusedFrame_ChangesNothing", "firmware.nothing", "tests/fuzz/nothing.cc"]
        self.assertEqual(missing(gone, _ROOT), gone)

    def test_ids_that_are_referred_to_exist(self):
        ids = {row[0] for row in rows(_PAGE)}
        self.assertLessEqual(set(re.findall(r"\b(?:MEM|TIM|INP|REP|COV|DET|REC|U|C|D)-[0-9]+\b", _PAGE)), ids)

    def test_checks_that_are_said_to_be_on_are_on(self):
        listed = re.findall(r"^  (-?[a-z][a-z-]+\*?),?$", (_ROOT / ".clang-tidy").read_text(encoding="utf-8"), re.MULTILINE)
        named = {check for row in rows(_PAGE) if row[0].startswith("C-") for check in re.findall(r"`([a-z-]+)`", row[1])}
        self.assertTrue(named)
        for check in named:
            verdicts = [not item.startswith("-") for item in listed if fnmatch.fnmatch(check, item.removeprefix("-"))]
            self.assertTrue(verdicts and verdicts[-1], check)


if __name__ == "__main__":
    unittest.main()
