#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""core and hal include nothing that a controller without an operating system lacks: a list of standard headers."""
import pathlib
import re
import sys

# Freestanding by the standard (C++20, [compliance]).
# As C has them, for the header that C includes.
C_HEADERS = {'stddef.h', 'stdint.h'}
FREESTANDING = {'atomic', 'bit', 'cfloat', 'climits', 'compare', 'concepts', 'cstdarg', 'cstddef', 'cstdint', 'initializer_list',
                'limits', 'new', 'source_location', 'type_traits', 'version'}
# Not freestanding by the standard, but what is used of them needs neither heap, exceptions nor an operating system.
TEMPLATES = {'algorithm', 'array', 'cassert', 'cmath', 'cstring', 'iterator', 'numbers', 'span', 'string_view', 'utility'}
EIGEN = {'Eigen/Cholesky', 'Eigen/Core', 'Eigen/Eigenvalues', 'Eigen/Geometry', 'Eigen/Jacobi'}
ALLOWED = {
    'core': FREESTANDING | TEMPLATES | EIGEN | C_HEADERS,
    # Texts of faults (vsnprintf) and addresses (from_chars) are for programs: firmware does not link them.
    'hal': FREESTANDING | TEMPLATES | EIGEN | {'charconv', 'cstdio', 'system_error'},
}


def main():
    root = pathlib.Path(sys.argv[1])
    bad = []
    for folder, allowed in ALLOWED.items():
        files = sorted(p for p in (root / folder).rglob('*') if p.suffix in ('.h', '.cc'))
        if len(files) < 10:
            sys.exit(f'{folder}: hardly any sources; the check would be void')
        for file in files:
            for number, line in enumerate(file.read_text().splitlines(), 1):
                found = re.match(r'\s*#\s*include\s*(<([^>]+)>|"([^"]+)")', line)
                if not found:
                    continue
                angle, quoted = found.group(2), found.group(3)
                if angle and angle not in allowed:
                    bad.append(f'{file}:{number}: <{angle}> is not on the list of headers that firmware has')
                if quoted and folder == 'core' and quoted.startswith('disflow/hal/'):
                    bad.append(f'{file}:{number}: core must not include {quoted}')
    print('\n'.join(bad) or 'only headers of the list')
    return 1 if bad else 0


if __name__ == '__main__':
    sys.exit(main())
