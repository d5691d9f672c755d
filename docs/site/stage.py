#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Puts the site's pages together, so that mkdocs finds every link's target.

usage: stage.py OUT_DIR   from the tree's root, after doxygen

The pages keep their places: README.md, docs/method.md. A link to a file or a folder of the tree that is no page becomes one to a
page which shows it, in sources/. A link that leads nowhere is an error, and so is a page that the site's menu does not have.
"""

import os
import pathlib
import re
import shutil
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
SITE = ROOT / "docs/site"
# What the browser shows as it is.
ASSETS = {".png", ".svg", ".json", ".xml"}
LANGUAGES = {".h": "cpp", ".cc": "cpp", ".c": "c", ".py": "python", ".js": "javascript", ".cmake": "cmake", ".toml": "toml",
             ".cff": "yaml", ".xml": "xml", ".msg": "text", ".srv": "text"}
LINK = re.compile(r"(\]\()([^)\s#]+)(#[^)\s]*)?(\))")


def pages():
    """Every page of the tree, relative to its root."""
    tops = sorted(p for p in ROOT.glob("*.md"))
    deeper = sorted(p for p in (ROOT / "docs").rglob("*.md") if SITE not in p.parents)
    return [p.relative_to(ROOT) for p in tops + deeper]


def files_of(target):
    """A file, or all files of a folder."""
    if target.is_file():
        return [target]
    return sorted(p for p in target.rglob("*") if p.is_file() and "__pycache__" not in p.parts)


def source_page(target):
    """A page that shows a file or a folder."""
    title = target.relative_to(ROOT)
    lines = [f"# {title}", ""]
    for path in files_of(target):
        if target.is_dir():
            lines += [f"## {path.relative_to(target)}", ""]
        text = path.read_text(encoding="utf-8")
        language = "cmake" if path.name == "CMakeLists.txt" else LANGUAGES.get(path.suffix, "text")
        lines += [f"````{language}", text.rstrip("\n"), "````", ""]
    return "\n".join(lines)


class Stage:
    def __init__(self, out):
        self.out = out
        self.pages = pages()
        self.sources = set()
        self.broken = []

    def place(self, relative, text):
        path = self.out / relative
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    def copy(self, target):
        path = self.out / target.relative_to(ROOT)
        path.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(target, path)

    def new_link(self, page, link):
        """Where a link of a page leads on the site."""
        target = pathlib.Path(os.path.normpath(ROOT / page.parent / link))
        if ROOT not in target.parents or not target.exists():
            self.broken.append(f"{page}: {link} is not there")
            return link
        relative = target.relative_to(ROOT)
        if relative in self.pages:
            return link
        if target.suffix in ASSETS:
            self.copy(target)
            return link
        source = pathlib.Path("sources") / f"{relative}.md"
        if source not in self.sources:
            self.sources.add(source)
            self.place(source, source_page(target))
        return os.path.relpath(source, page.parent)

    def rewrite(self, page):
        """The page's text with links that hold on the site."""
        def replace(match):
            begin, link, anchor, end = match.groups()
            if re.match(r"[a-z]+:", link):
                return match.group(0)
            return f"{begin}{self.new_link(page, link)}{anchor or ''}{end}"

        parts = re.split(r"(^```.*?^```$)", (ROOT / page).read_text(encoding="utf-8"), flags=re.DOTALL | re.MULTILINE)
        return "".join(part if part.startswith("```") else LINK.sub(replace, part) for part in parts)


def main():
    out = pathlib.Path(sys.argv[1]).resolve()
    shutil.rmtree(out, ignore_errors=True)
    stage = Stage(out)
    for page in stage.pages:
        stage.place(page, stage.rewrite(page))
    shutil.copy(SITE / "site.css", out)
    menu = (SITE / "mkdocs.yml").read_text(encoding="utf-8")
    missing = [f"docs/site/mkdocs.yml: {page} is not in the menu" for page in stage.pages if f": {page}\n" not in menu]
    for problem in stage.broken + missing:
        print(problem, file=sys.stderr)
    sys.exit(1 if stage.broken or missing else 0)


main()
