#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Compares the firmware's bill of materials with the libraries in its link map and the headers that it was compiled of:
check_bom.py BUILD MAP
"""
import json
import os
import re
import shutil
import subprocess
import sys

import emulated

_SKIPPED = 77


def output_of(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def packages_of(files):
    """Of those that belong to one."""
    listing = subprocess.run(['dpkg-query', '-S', *sorted(files)], check=False, capture_output=True, text=True).stdout
    return {line.partition(': ')[0].partition(':')[0] for line in listing.splitlines() if ': ' in line}


def linked(link_map):
    """Archives of the system; the linker names them by way of the compiler's folder."""
    with open(link_map, encoding='utf-8') as file:
        return {os.path.realpath(name) for name in re.findall(r'^LOAD (/\S+\.a)$', file.read(), re.MULTILINE)}


def included(build):
    lines = output_of('ninja', '-C', build, '-t', 'deps').splitlines()
    return {os.path.realpath(line.strip()) for line in lines if line.startswith('    /usr/')}


def main():
    emulated.skip_unless_built()
    build, link_map = sys.argv[1:]
    bom = os.path.join(build, 'disflow.cdx.json')
    for needed in ('dpkg-query', 'ninja'):
        if shutil.which(needed) is None:
            print(f'skipped: {needed} is not installed')
            return _SKIPPED
    with open(bom, encoding='utf-8') as file:
        components = json.load(file)['components']
    named = {re.match(r'pkg:deb/[a-z]+/([^@?]+)', item['purl']).group(1).replace('%2B', '+') for item in components}
    for item in components:
        assert item.get('version'), f'{item["name"]} has no version'
    assert any(item['name'] == 'newlib' for item in components)
    libraries, headers = linked(link_map), included(build)
    assert len(libraries) >= 3 and len(headers) > 50, 'too little to compare with'
    # Headers of the C library have a package of their own, from the same source.
    found = {'libnewlib-arm-none-eabi' if name == 'libnewlib-dev' else name for name in packages_of(libraries | headers)}
    assert found == named, f'went in: {sorted(found)}, named: {sorted(named)}'
    return 0


if __name__ == '__main__':
    sys.exit(main())
