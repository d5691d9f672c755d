# SPDX-License-Identifier: BSD-3-Clause
"""What pyproject.toml cannot say: the compiled module, and the version, which is that of CMakeLists.txt."""
import os
import pathlib
import re

from pybind11.setup_helpers import ParallelCompile, Pybind11Extension
from setuptools import setup

ROOT = pathlib.Path(__file__).parent


def eigen():
    """Where Eigen's headers are."""
    for folder in (os.environ.get('EIGEN3_INCLUDE_DIR', ''), '/usr/include/eigen3', '/usr/local/include/eigen3',
                   '/opt/homebrew/include/eigen3'):
        if folder and pathlib.Path(folder, 'Eigen', 'Core').exists():
            return folder
    raise SystemExit('Eigen 3.4 is needed: install libeigen3-dev, or set EIGEN3_INCLUDE_DIR')


version = re.search(r'project\(disflow VERSION ([\d.]+)', (ROOT / 'CMakeLists.txt').read_text()).group(1)
includes = ['core/include', eigen()]
# As cmake/flags.cmake has them: the same bits as the programs.
flags = ['-std=c++20', '-O3', '-DNDEBUG', '-ffp-contract=off', '-fno-math-errno', '-g0', '-fvisibility=hidden']
headers = [str(path.relative_to(ROOT)) for folder in ('core', 'platform/python') for path in (ROOT / folder).rglob('*.h')]
core = sorted(str(path.relative_to(ROOT)) for path in (ROOT / 'core' / 'src').rglob('*.cc'))

with ParallelCompile(default=0):
    setup(version=version,
          ext_modules=[Pybind11Extension('disflow._disflow',
                                         ['platform/python/module.cc', 'platform/python/tracker.cc',
                                          'platform/python/estimate.cc', *core],
                                         include_dirs=includes, extra_compile_args=flags, depends=headers)])
