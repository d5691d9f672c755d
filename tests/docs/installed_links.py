#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Says which links and pictures of installed pages lead nowhere.

usage: installed_links.py FOLDER   where the pages are, e.g. an unpacked usr/share/doc/disflow

Who reads them has no tree beside them: a relative link has to lead to something within the folder, any other is a whole address.
"""

import pathlib
import re
import sys
import urllib.parse

_CODE = re.compile(r"^(```+|~~~+).*?^\1`*~*$|`[^`\n]*`", re.DOTALL | re.MULTILINE)
# Inline links and pictures, those that are defined elsewhere on the page, and HTML.
_LINKS = (
    re.compile(r"\]\(\s*<?([^)\s>]+)"),
    re.compile(r"^ {0,3}\[[^\]]+\]:\s*<?(\S+?)>?(?:\s|$)", re.MULTILINE),
    re.compile(r"<[^>]*\b(?:href|src)\s*=\s*[\"']?([^\"'\s>]+)"),
)
_WHOLE = re.compile(r"(https?://|mailto:)")


def links(text):
    """Every target on a page, but for what stands in code."""
    prose = _CODE.sub("", text)
    return [target for form in _LINKS for target in form.findall(prose)]


def broken(folder):
    """(page, link) of all that lead nowhere."""
    root = folder.resolve()
    found = []
    for page in sorted(root.rglob("*.md")):
        for link in links(page.read_text(encoding="utf-8")):
            if _WHOLE.match(link):
                continue
            path = urllib.parse.unquote(link.split("#")[0])
            target = (page.parent / path).resolve() if path else page
            if ":" in path or root not in target.parents or not target.exists():
                found.append((page.relative_to(root), link))
    return found


def main():
    folder = pathlib.Path(sys.argv[1])
    if not (folder / "README.md").is_file():
        sys.exit(f"{folder}/README.md: is not there; FOLDER has to be the one with the installed pages")
    found = broken(folder)
    for page, link in found:
        print(f"{folder / page}: {link} leads to nothing that is installed; put it into what docs/site/stage.py places", file=sys.stderr)
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
