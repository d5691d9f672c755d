# SPDX-License-Identifier: BSD-3-Clause
"""docs/safety.md names tests as evidence: they have to exist. Figures that it quotes have to be those of the pages they come from."""
import fnmatch
import pathlib
import re
import unittest

_ROOT = pathlib.Path(__file__).resolve().parents[3]
_DOCS = _ROOT / "docs"
_PAGE = (_DOCS / "safety.md").read_text(encoding="utf-8")
_RESULTS = (_DOCS / "results.md").read_text(encoding="utf-8")
_PERFORMANCE = (_DOCS / "performance.md").read_text(encoding="utf-8")
_MEMORY = (_DOCS / "memory.md").read_text(encoding="utf-8")
_ID = re.compile(r"[A-Z]{1,3}-[0-9]+")


def rows(page):
    """Cells of the tables' rows that begin with an id."""
    cells = [[cell.strip() for cell in line.strip().strip("|").split("|")] for line in page.splitlines()
             if line.startswith("|")]
    return [row for row in cells if _ID.fullmatch(row[0])]


def limits(page, name):
    """The last cell of a requirement: what was measured and what is assumed."""
    return next(row[-1] for row in rows(page) if row[0] == name)


def table(page, heading, first_column):
    """A section's table by its heading's cells; a row that does not say its first cell has that of the row above."""
    section = page.split(f"\n## {heading}\n")[1].split("\n## ")[0]
    lines = [[cell.strip().strip("*") for cell in line.strip().strip("|").split("|")] for line in section.splitlines()
             if line.startswith("|") and not set(line) <= set("|-: ")]
    columns = next(cells for cells in lines if cells[0] == first_column)
    found = []
    for cells in lines[lines.index(columns) + 1:]:
        found.append(dict(zip(columns, cells)))
        found[-1][first_column] = cells[0] or found[-2][first_column]
    return found


def instructions_of(results):
    """Of whole frames, as safety.md quotes them."""
    whole = {row[""]: row for row in table(results, "Firmware", "") if row["stage"] == "whole frame"}
    return "; ".join(f"{thing} median {whole[thing]['median']}, most {whole[thing]['most']}" for thing in ["box", "bottle"])


def instructions_on_a_pc(performance):
    """Of Edge and Dense, which no controller holds."""
    rows_of = {row["sequence"]: row for row in table(performance.replace("\n# ", "\n## ", 1), "Where the time goes", "sequence")}
    return "; ".join(f"{profile} {thing} median {row['frame']}, most {row['most after frame 5']}"
                     for profile in ["Edge", "Dense"] for thing in ["box", "bottle"]
                     for row in [rows_of[f"{thing}, d415, mask given, {profile}"]])


def stack_of(memory):
    row_of = {row["bytes"]: row for row in table(memory, "Firmware", "bytes")}
    columns = ["Micro (240×180)", "Small (160×120)"]
    worst, reserved = row_of["stack, worst case by the compiler's call graph"], row_of["stack reserved"]
    if len({reserved[column] for column in columns}) != 1:
        raise ValueError("the profiles reserve different stacks: safety.md has to tell both")
    named = ", ".join(f"{column.split()[0]} {worst[column]}" for column in columns)
    return f"{named} of {reserved[columns[0]]} bytes"


def budgets_of(memory):
    return re.search(r"^1\. \*\*Budgets\.\*\*.*: (.*)\.$", memory, re.MULTILINE).group(1).replace("≤ ", "")


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

    def test_instructions_are_those_of_the_results(self):
        self.assertIn(instructions_of(_RESULTS), limits(_PAGE, "TIM-1"))
        self.assertIn(instructions_on_a_pc(_PERFORMANCE), limits(_PAGE, "TIM-1"))

    def test_bytes_are_those_of_the_page_on_memory(self):
        self.assertIn(stack_of(_MEMORY), limits(_PAGE, "MEM-4"))
        self.assertIn(budgets_of(_MEMORY), limits(_PAGE, "MEM-3"))

    def test_a_figure_that_changes_on_the_other_page_would_be_noticed(self):
        whole = next(row for row in table(_RESULTS, "Firmware", "") if row["stage"] == "whole frame")
        self.assertNotIn(instructions_of(_RESULTS.replace(f"**{whole['most']}**", "**99.99**")), limits(_PAGE, "TIM-1"))
        self.assertNotIn(instructions_on_a_pc(re.sub(r"(Dense \|.*)\*\*[0-9.]+\*\*", r"\1**99.99**", _PERFORMANCE)), limits(_PAGE, "TIM-1"))
        worst = re.search(r"\| stack, worst case [^|]*\|([^|]*)\|", _MEMORY).group(1).strip()
        self.assertNotIn(stack_of(_MEMORY.replace(worst, "9 999")), limits(_PAGE, "MEM-4"))
        self.assertNotIn(budgets_of(_MEMORY.replace("Dense ≤ 11 MiB", "Dense ≤ 12 MiB")), limits(_PAGE, "MEM-3"))

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
