# SPDX-License-Identifier: BSD-3-Clause
"""Compares the bill of materials with the headers that were compiled in and the libraries that the programs ask for:
complete_test.py BOM BUILD VERSION PROGRAM...
"""
import json
import re
import shutil
import subprocess
import sys
import unittest
import urllib.parse

_SKIPPED = 77
_BOM, _BUILD, _VERSION, *_PROGRAMS = sys.argv[1:]

# Source packages of headers that others include and of which nothing is linked: those of the kernel's interface, and what
# libwebsockets.h and the C library declare. C++'s own library asks whether oneTBB is there: for clang that includes it.
_DECLARATIONS_ONLY = {"linux", "openssl", "libcap2", "libxcrypt", "onetbb"}
# The compiler's own headers are the libraries' that come with it.
_COMPILER = re.compile(r"(gcc|llvm-toolchain)-[0-9]+")


def output_of(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def sources_of_packages(packages):
    """Debian's source packages: one for a library and its headers."""
    found = output_of("dpkg-query", "-W", "-f", "${source:Package}\n", *sorted(packages)).split()
    return {"gcc" if _COMPILER.fullmatch(name) else name for name in found}


def sources_of_files(files):
    """Of those that belong to a package."""
    listing = subprocess.run(["dpkg-query", "-S", *sorted(files)], check=False, capture_output=True, text=True).stdout
    return sources_of_packages({line.partition(": ")[0].partition(":")[0].partition(",")[0]
                                for line in listing.splitlines() if ": " in line})


def included_headers():
    """Of the system, by the objects of what is installed: not of tests, nor of the module for OpenCV, which is not."""
    headers, wanted = set(), False
    for line in output_of("ninja", "-C", _BUILD, "-t", "deps").splitlines():
        if line and not line.startswith(" "):
            wanted = re.match(r"(core|hal|platform|apps)/", line) and "disflow_semi_global" not in line
        elif wanted and line.strip().startswith("/usr/"):
            headers.add(line.strip())
    return headers


def needed_libraries():
    """Files of the shared libraries that the programs name, without what these need in turn."""
    files = set()
    for program in _PROGRAMS:
        names = re.findall(r"\(NEEDED\).*\[(.+)\]", output_of("readelf", "-d", program))
        places = dict(re.findall(r"^\s*(\S+) => (\S+)", output_of("ldd", program), re.MULTILINE))
        files |= {places[name] for name in names if name in places}
    return files


class BillOfMaterials(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with open(_BOM, encoding="utf-8") as file:
            cls.bom = json.load(file)
        cls.components = cls.bom["components"]
        cls.packages = {urllib.parse.unquote(re.match(r"pkg:deb/[a-z]+/([^@?]+)", item["purl"]).group(1))
                        for item in cls.components if item["purl"].startswith("pkg:deb/")}

    def test_it_names_this_version(self):
        self.assertEqual(self.bom["metadata"]["component"]["version"], _VERSION)

    def test_every_component_has_version_licence_and_a_reference_of_its_own(self):
        references = [item["bom-ref"] for item in self.components]
        self.assertEqual(len(set(references)), len(references))
        self.assertEqual(self.bom["dependencies"][0]["dependsOn"], references)
        for item in self.components:
            self.assertTrue(item.get("version"), item["name"])
            self.assertTrue(item["licenses"], item["name"])
        for package in self.packages:
            # One for each architecture that it is installed for.
            self.assertTrue(output_of("dpkg-query", "-W", "-f", "x", package), package)

    def test_every_header_that_is_compiled_in_belongs_to_a_component(self):
        headers = included_headers()
        self.assertGreater(len(headers), 100)
        unnamed = sources_of_files(headers) - sources_of_packages(self.packages) - _DECLARATIONS_ONLY
        self.assertEqual(unnamed, set())

    def test_every_library_that_is_linked_belongs_to_a_component(self):
        libraries = needed_libraries()
        self.assertGreater(len(libraries), 3)
        # /lib is a link to /usr/lib, and packages own files under either name.
        files = libraries | {"/usr" + file for file in libraries} | {file.removeprefix("/usr") for file in libraries}
        found = sources_of_files(files)
        self.assertTrue(found)
        self.assertEqual(found - sources_of_packages(self.packages), set())

    def test_every_part_of_the_page_is_a_component_of_that_version(self):
        with open(f"{_BUILD}/apps/view/licences-of-the-view.txt", encoding="utf-8") as file:
            parts = [section.strip().splitlines()[0] for section in file.read().split("-" * 72)][1:]
        self.assertTrue(parts)
        self.assertEqual(sorted(parts), sorted(f"{item['name']} {item['version']}" for item in self.components
                                               if item["purl"].startswith("pkg:npm/")))


if __name__ == "__main__":
    for tool in ["dpkg-query", "ninja", "readelf"]:
        if shutil.which(tool) is None:
            print(f"skipped: {tool} is not installed")
            sys.exit(_SKIPPED)
    unittest.main(argv=sys.argv[:1])
