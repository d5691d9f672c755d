#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Every command on a page of the documentation is one that there is: programs, their options, settings and `./dev`'s commands.

usage: commands_test.py PROGRAM_DIR

The commands of the tutorials are run as well, by run_tutorial.py.
"""

import functools
import pathlib
import re
import shlex
import subprocess
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAMS = pathlib.Path()
OWN = {"disflow_track", "disflow_sim", "disflow_eval", "disflow_feed"}


def pages():
    return sorted([*ROOT.glob("*.md"), *(ROOT / "docs").rglob("*.md")])


def commands(page):
    """(line number, words) of every command in a ```sh block."""
    text = page.read_text(encoding="utf-8")
    for block in re.finditer(r"^```sh\n(.*?)^```$", text, flags=re.DOTALL | re.MULTILINE):
        line = text[: block.start(1)].count("\n") + 1
        body = re.sub(r"<<'(\w+)'.*?\n\1\n", lambda m: "\n" * m.group(0).count("\n"), block.group(1), flags=re.DOTALL)
        for part in re.split(r"(?<!\\)\n", body):
            yield from ((line, words) for words in split(part))
            line += part.count("\n") + 1


def split(line):
    """The commands of a line, without what redirects, joins or explains them."""
    lexer = shlex.shlex(line.replace("\\\n", " "), posix=True, punctuation_chars="();<>|&")
    lexer.whitespace_split = True
    words = []
    for word in lexer:
        if set(word) <= set("();|&<>") or word in {"do", "done", "until"}:
            if words:
                yield words
            words = []
        else:
            words.append(word)
    if words:
        yield words


@functools.cache
def help_of(*command):
    done = subprocess.run([*command], capture_output=True, text=True, timeout=60, check=False)
    return done.stdout + done.stderr


@functools.cache
def settings():
    printed = subprocess.run([PROGRAMS / "disflow_track", "--print-settings-table"], capture_output=True, text=True, timeout=60, check=True)
    return set(re.findall(r"`([a-z_0-9]+\.[a-z_0-9]+)`", printed.stdout))


def problems_of(words):
    """What is wrong with a command."""
    while words and re.fullmatch(r"[A-Za-z_]+=.*", words[0]) or words and words[0] in {"sudo", "exec"}:
        words = words[1:]
    if not words:
        return
    program = pathlib.PurePath(words[0]).name
    if program in OWN:
        text = help_of(PROGRAMS / program, "--help")
    elif words[0] == "./dev":
        text = help_of(ROOT / "dev", "help")
        if len(words) < 2 or not re.search(rf"^  {re.escape(words[1])}\b", text, flags=re.MULTILINE):
            yield f"./dev has no command {words[1:2]}"
    elif program.startswith("disflow_"):
        yield f"there is no program {program}"
        return
    else:
        return
    for word in words[1:]:
        if word.startswith("--") and not re.search(rf"(?<![\w-]){re.escape(word.split('=')[0])}(?![\w-])", text):
            yield f"{program} has no option {word}"
    for option, value in zip(words, words[1:]):
        if option == "--set" and program == "disflow_track" and value.split("=")[0] not in settings():
            yield f"there is no setting {value}"


class Commands(unittest.TestCase):
    def test_every_command_of_the_pages_exists_with_its_options_and_settings(self):
        found = 0
        for page in pages():
            for line, words in commands(page):
                found += 1
                for problem in problems_of(words):
                    with self.subTest(page=page.relative_to(ROOT), line=line):
                        self.fail(problem)
        self.assertGreater(found, 100)

    def test_topics_of_the_ros_tutorial_are_those_of_the_reference(self):
        tutorial = (ROOT / "docs/tutorials/ros2.md").read_text(encoding="utf-8")
        reference = (ROOT / "docs/ros2.md").read_text(encoding="utf-8")
        topics = set(re.findall(r"/disflow/[a-z_/]+", tutorial)) - {"/disflow/depth/image_rect_raw", "/disflow/mask"}
        self.assertGreater(len(topics), 3)
        for topic in topics:
            self.assertIn(f"| `{topic}` |", reference)

    def test_wrong_commands_are_found(self):
        for wrong in ("disflow_track --senser sim:box", "./dev tset", "./dev test --ross", "disflow_teack", "disflow_track --set a.b=1"):
            with self.subTest(wrong):
                self.assertNotEqual([], list(problems_of(shlex.split(wrong))))
        for right in ("disflow_track --sensor sim:box --set sampler.border_px=0", "./dev test --hil", "DISFLOW=1 disflow_sim seq", "ls --nothing"):
            with self.subTest(right):
                self.assertEqual([], list(problems_of(shlex.split(right))))


if __name__ == "__main__":
    PROGRAMS = pathlib.Path(sys.argv.pop(1))
    unittest.main()
