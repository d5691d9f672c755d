#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Pages that list the API, header by header, so that the site's search finds every name; each leads to Doxygen's page of it.

usage: api_index.py DOXYGEN_DIR OUT_DIR

DOXYGEN_DIR has Doxygen's xml/ and html/; html/ is copied to OUT_DIR/html.
"""

import collections
import pathlib
import re
import shutil
import sys
import xml.etree.ElementTree as ElementTree

ROOT = pathlib.Path(__file__).resolve().parents[2]
AREAS = {"core": "Core", "hal": "Hardware abstraction", "platform": "Platforms"}
INTRODUCTIONS = {
    "core": "The tracker: no heap, no thread, no clock. Most programs need `disflow/tracker.h`, or `disflow.h` from C.",
    "hal": "What the core does not know: sensors, links, MAVLink. As free of heap and operating system as the core.",
    "platform": "Linux: cameras, links, DDS, the live view, recordings.",
}
KINDS = {"class", "struct"}
PUBLIC = {"public-func", "public-static-func", "func", "enum", "typedef"}


def plain(element):
    """The text of a description, in one line."""
    return " ".join("".join(element.itertext()).split()) if element is not None else ""


def escaped(text):
    """Text that Markdown leaves as it is. Underscores inside words need nothing."""
    return "".join("\\" + character if character in "\\`*{}[]<>|#" else character for character in text)


def html_of(identifier):
    """Doxygen's page and anchor of a member."""
    page, _, anchor = identifier.rpartition("_1")
    return f"html/{page}.html#{anchor}"


def short(name):
    return name.replace("disflow::", "")


class Header:
    def __init__(self):
        self.types = []
        self.functions = []


def area_of(path):
    top = pathlib.PurePath(path).parts[0]
    return top if top in AREAS else None


def shown_path(path):
    """As it is included."""
    parts = pathlib.PurePath(path).parts
    return "/".join(parts[parts.index("include") + 1:]) if "include" in parts else path


def member_lines(compound, skip_own_name=""):
    """One line per documented public member."""
    lines = []
    for member in compound.iter("memberdef"):
        if member.get("prot") != "public" or member.get("kind") not in {"function", "enum"}:
            continue
        name, brief = member.findtext("name"), plain(member.find("briefdescription"))
        if not brief or name in {skip_own_name, "~" + skip_own_name} or name.startswith("operator"):
            continue
        arguments = member.findtext("argsstring") or ""
        brackets = "()" if member.get("kind") == "function" else ""
        lines.append(f"- [`{name}{brackets}`]({html_of(member.get('id'))} \"{escaped_title(name + arguments)}\"): {escaped(brief)}")
    return sorted(set(lines))


def escaped_title(text):
    return " ".join(text.replace('"', "'").split())


def read(xml):
    """Headers by area and path."""
    headers = collections.defaultdict(lambda: collections.defaultdict(Header))
    for file in sorted(xml.glob("*.xml")):
        if file.name == "index.xml":
            continue
        compound = ElementTree.parse(file).getroot().find("compounddef")
        if compound is None:
            continue
        if compound.get("kind") in KINDS and compound.get("prot") == "public":
            path = compound.find("location").get("file")
            name = short(compound.findtext("compoundname"))
            if area_of(path) and "anonymous_namespace" not in name and "<" not in name:
                own = name.split("::")[-1]
                headers[area_of(path)][path].types.append(
                    (name, compound.get("id"), plain(compound.find("briefdescription")), member_lines(compound, own)))
        if compound.get("kind") == "file" and area_of(compound.find("location").get("file")):
            path = compound.find("location").get("file")
            headers[area_of(path)][path].functions += member_lines(compound)
    return headers


def page(area, headers):
    lines = [f"# {AREAS[area]}", "", INTRODUCTIONS[area], "", "[Everything, with sources and all members](html/index.html).", ""]
    for path in sorted(headers, key=shown_path):
        header = headers[path]
        if not header.types and not header.functions:
            continue
        lines += [f"## {shown_path(path)}", ""]
        lines += [*header.functions, ""]
        for name, identifier, brief, members in sorted(header.types):
            lines += [f"### {name}", "", f"{escaped(brief)} [All members](html/{identifier}.html)".strip(), "", *members, ""]
    return "\n".join(lines)


def overview(headers):
    lines = ["# API", "", "By header. The search finds every class and function; each leads to its page with all members, units, frames and errors.", "",
             "| | headers | |", "|---|---|---|"]
    for area, title in AREAS.items():
        lines.append(f"| [{title}]({area}.md) | {len(headers[area])} | {INTRODUCTIONS[area]} |")
    lines += ["", "[All pages of Doxygen](html/index.html), with a search of their own.", ""]
    return "\n".join(lines)


def broken_links(out):
    """Links to Doxygen's pages that lead nowhere."""
    texts = {}
    for index in sorted(out.glob("*.md")):
        for file, anchor in re.findall(r"\]\((html/[^)#\s]+)(?:#([^)\s]+))?", index.read_text(encoding="utf-8")):
            if file not in texts:
                texts[file] = (out / file).read_text(encoding="utf-8") if (out / file).exists() else None
            if texts[file] is None or (anchor and f'id="{anchor}"' not in texts[file]):
                yield f"{index.name}: {file}#{anchor}"


def main():
    doxygen, out = map(pathlib.Path, sys.argv[1:3])
    headers = read(doxygen / "xml")
    out.mkdir(parents=True, exist_ok=True)
    for area in AREAS:
        if not headers[area]:
            sys.exit(f"{doxygen}: nothing of {area}")
        (out / f"{area}.md").write_text(page(area, headers[area]), encoding="utf-8")
    (out / "index.md").write_text(overview(headers), encoding="utf-8")
    shutil.copytree(doxygen / "html", out / "html", dirs_exist_ok=True)
    broken = list(broken_links(out))
    if broken:
        sys.exit("no such page of Doxygen's:\n" + "\n".join(broken))


main()
