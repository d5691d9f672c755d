# SPDX-License-Identifier: BSD-3-Clause
"""packaging/debian/copyright goes into every package: it has to name all that is compiled in, with holders and licence.
cmake/bom.cmake says what that is; the test bom.complete compares it with the headers that went in."""
import pathlib
import re
import unittest

_ROOT = pathlib.Path(__file__).resolve().parents[3]
_COPYRIGHT = (_ROOT / "packaging" / "debian" / "copyright").read_text(encoding="utf-8")
_BOM = (_ROOT / "cmake" / "bom.cmake").read_text(encoding="utf-8")
_PAGE_PARTS = _ROOT / "apps" / "view" / "node_modules"
# They build the Python module and leave nothing in it.
_BUILDERS = {"setuptools", "wheel"}


def paragraphs(text):
    """As dictionaries of fields; a line that begins with a space belongs to the field above it."""
    fields = re.compile(r"^([A-Za-z-]+):(.*(?:\n[ \t].*)*)", re.MULTILINE)
    return [{name: value.strip() for name, value in fields.findall(block)} for block in re.split(r"\n{2,}", text.strip())]


def works(text):
    return [paragraph for paragraph in paragraphs(text) if "Files" in paragraph]


def licence_texts(text):
    """Text by short name, of the paragraphs that are a licence alone."""
    alone = [paragraph["License"] for paragraph in paragraphs(text) if "License" in paragraph and "Files" not in paragraph]
    return {name: body for name, _, body in (licence.partition("\n") for licence in alone)}


def named(text):
    """Works of others: each says its name at the start of its comment."""
    return {work["Comment"].partition(": ")[0] for work in works(text) if "Comment" in work}


def components(bom):
    """Name and use of each, and the parts of the live view's page."""
    found = {(name or quoted): use or "linked" for quoted, name, use in re.findall(
        r"^ *disflow_bom\((?:\"([^\"]+)\"|(\S+)) (?:\"[^\"]+\"|\S+) (?:\"([^\"]+)\"|linked) ", bom, re.MULTILINE)}
    parts = re.search(r"set\(disflow_bom_page_parts \"(.+)\"\)", bom).group(1).split(";")
    return found | {part.partition("|")[0]: "part of the page" for part in parts}


def forgotten(text, bom):
    return {name for name, use in components(bom).items() if use != "linked"} - named(text)


def in_the_python_module():
    """What it is compiled of beside the library, which the bill of materials of the programs does not have."""
    project = (_ROOT / "pyproject.toml").read_text(encoding="utf-8")
    requires = re.search(r"^requires = \[(.*)\]$", project, re.MULTILINE).group(1)
    return set(re.findall(r"\"([A-Za-z0-9_-]+)", requires)) - _BUILDERS


def words(text):
    return re.sub(r"^ \.$", "", text, flags=re.MULTILINE).split()


class Copyright(unittest.TestCase):
    def test_all_that_is_compiled_in_is_named(self):
        self.assertGreater(len(components(_BOM)), 10)
        self.assertEqual(_BOM.count("\n  disflow_bom(") + _BOM.count("\ndisflow_bom("),
                         sum(use != "part of the page" for use in components(_BOM).values()))
        self.assertEqual(forgotten(_COPYRIGHT, _BOM), set())

    def test_what_the_python_module_is_compiled_of_is_named(self):
        self.assertTrue(in_the_python_module())
        self.assertLessEqual(in_the_python_module(), named(_COPYRIGHT))

    def test_a_component_that_is_forgotten_would_be_noticed(self):
        more = _BOM + '\ndisflow_bom("another one" MIT "compiled in" libanother-dev)\n'
        self.assertEqual(forgotten(_COPYRIGHT, more), {"another one"})
        self.assertEqual(forgotten(_COPYRIGHT, _BOM.replace("uplot|MIT", "uplot|MIT;plotly|MIT")), {"plotly"})

    def test_nothing_is_named_that_is_gone(self):
        self.assertLessEqual(named(_COPYRIGHT), set(components(_BOM)) | in_the_python_module())

    def test_it_is_as_debian_reads_it(self):
        first, *rest = paragraphs(_COPYRIGHT)
        self.assertEqual(first["Format"], "https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/")
        for paragraph in rest:
            self.assertIn("License", paragraph)
            self.assertLessEqual(set(paragraph), {"Files", "Copyright", "License", "Comment"})
        for work in works(_COPYRIGHT):
            self.assertTrue(work["Copyright"], work["Files"])
            self.assertTrue(work["Files"] == "*" or "Comment" in work, work["Files"])

    def test_every_licence_has_its_text_once_and_is_used(self):
        used = {name for work in works(_COPYRIGHT) for name in re.split(r" (?:and|or) ", work["License"])}
        texts = licence_texts(_COPYRIGHT)
        self.assertEqual(used, set(texts))
        self.assertEqual(len(texts), sum("Files" not in paragraph for paragraph in paragraphs(_COPYRIGHT)) - 1)
        for name, text in texts.items():
            self.assertGreater(len(text), 200, name)

    def test_the_projects_own_terms_are_those_of_its_licence_file(self):
        title, holder, terms = (_ROOT / "LICENSE").read_text(encoding="utf-8").split("\n\n", 2)
        self.assertEqual(title, "BSD 3-Clause License")
        own = next(work for work in works(_COPYRIGHT) if work["Files"] == "*")
        self.assertEqual("Copyright (c) " + own["Copyright"], holder)
        self.assertEqual(words(licence_texts(_COPYRIGHT)[own["License"]]), words(terms))

    @unittest.skipUnless(_PAGE_PARTS.is_dir(), "the parts of the live view's page are not there")
    def test_parts_of_the_page_have_the_holders_and_terms_of_their_own_files(self):
        for work in works(_COPYRIGHT):
            if not work["Files"].startswith("apps/view/node_modules/"):
                continue
            licence = (_ROOT / work["Files"].replace("*", "LICENSE")).read_text(encoding="utf-8")
            years, _, holder = work["Copyright"].partition(", ")
            self.assertRegex(licence, rf"Copyright (?:©|\(c\)) {years} {re.escape(holder)}")
            self.assertIn(" ".join(words(licence_texts(_COPYRIGHT)[work["License"]])), " ".join(licence.split()))


if __name__ == "__main__":
    unittest.main()
