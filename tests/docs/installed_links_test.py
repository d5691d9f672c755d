#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Pages that are installed lead nowhere else than to what is installed with them.

usage: installed_links_test.py BUILD_DIR
"""

import pathlib
import subprocess
import sys
import tempfile
import unittest

import installed_links

BUILD = pathlib.Path()


class InstalledLinks(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def broken_in(self, text):
        (self.folder / "docs").mkdir(exist_ok=True)
        (self.folder / "docs/there.md").write_text("# There\n", encoding="utf-8")
        (self.folder / "docs/page.md").write_text(text, encoding="utf-8")
        return [link for _, link in installed_links.broken(self.folder)]

    def test_every_link_of_the_installed_pages_leads_to_something_installed(self):
        subprocess.run(["cmake", "--install", BUILD, "--component", "documentation", "--prefix", self.folder],
                       check=True, stdout=subprocess.DEVNULL)
        readmes = list(self.folder.rglob("README.md"))
        self.assertEqual(len(readmes), 1)
        pages = readmes[0].parent
        self.assertGreater(len(list(pages.rglob("*.md"))), 30)
        self.assertEqual(installed_links.broken(pages), [])

    def test_links_that_lead_nowhere_are_found_however_they_are_written(self):
        for text, link in (
            ("[a](gone.md)", "gone.md"),
            ("![a](images/gone.png)", "images/gone.png"),
            ("[![a](gone.png)](there.md)", "gone.png"),
            ('[a](gone.md "title")', "gone.md"),
            ("[a][b]\n\n[b]: gone.md\n", "gone.md"),
            ('<img src="gone.png">', "gone.png"),
            ("[a](../../outside.md)", "../../outside.md"),
            ("[a](/usr/bin/env)", "/usr/bin/env"),
            ("[a](file:///etc/hostname)", "file:///etc/hostname"),
        ):
            with self.subTest(text):
                self.assertEqual(self.broken_in(text), [link])

    def test_links_that_lead_somewhere_are_let_through(self):
        for text in ("[a](there.md#x)", "[a](#x)", "[a](../docs/there.md)", "[a](https://example.org/b)", "`[a](gone.md)`", "```\n[a](gone.md)\n```\n"):
            with self.subTest(text):
                self.assertEqual(self.broken_in(text), [])


if __name__ == "__main__":
    BUILD = pathlib.Path(sys.argv.pop(1))
    unittest.main()
