# SPDX-License-Identifier: BSD-3-Clause
"""Where things are, set by run.py, and what was measured."""
programs = ""
arm_programs = ""
arm_root = ""
folder = ""
figures = []
