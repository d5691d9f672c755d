#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the tests of a build, once or many times, and says at the end what failed, what was skipped and why.

    tests/run_ctest.py --build build/release [--repeat N] [--busy] [-- CTEST_OPTION...]

Exit status: 0 if all rounds passed. With CI set in the environment, a test that was skipped although the machine is there
to run it is a failure as well.
"""
import argparse
import collections
import contextlib
import os
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree

# What may be skipped on CI.
_NOT_FOR_CI = (
    "DISFLOW_TEST_DATA",  # recordings of real cameras are no part of the project
    "run by ./dev test --firmware",  # a step of its own
    "sanitizers own malloc",  # the release build has these
    "disabled in this build",
    "this system keeps every rate",  # the opposite is tested then
    "no IPv6 loopback",  # a property of the machine's network
    "nothing can be mounted here",  # containers need not allow it
    "no control group with a limit of memory can be made here",
    "promtool is missing",  # 330 MB of packages and a service, to judge one text
)

Skip = collections.namedtuple("Skip", "test reason")
Round = collections.namedtuple("Round", "failed skipped count")


def reason_in(output):
    """The reason that a skipped test printed: "skipped: REASON", or what GoogleTest prints after "Skipped"."""
    found = re.search(r"^skipped: (.+)$", output, re.MULTILINE) or re.search(
        r": Skipped\n(?:Skipped\n)?(.+)$", output, re.MULTILINE)
    return found.group(1).strip() if found else "no reason given"


def read_round(path):
    """What a JUnit file of CTest's says."""
    cases = list(ElementTree.parse(path).getroot().iter("testcase"))
    failed, skipped = [], []
    for case in cases:
        name = case.get("name")
        if case.get("status") == "disabled":
            skipped.append(Skip(name, "disabled in this build"))
        elif case.find("skipped") is not None:
            skipped.append(Skip(name, reason_in(case.findtext("system-out") or "")))
        elif case.get("status") != "run":
            failed.append(name)
    return Round(failed, skipped, len(cases))


def without_detail(reason):
    """A reason's detail is in parentheses at its end, so that tests with the same need are counted together."""
    return re.sub(r"\s*\([^()]*\)$", "", reason)


def summary_of_skips(skipped):
    """e.g. "12 skipped", then a line for each need."""
    if not skipped:
        return "none skipped"
    reasons = collections.Counter(without_detail(skip.reason) for skip in skipped)
    lines = [f"{len(skipped)} skipped:"]
    lines += [f"  {count:4} {reason}" for reason, count in reasons.most_common()]
    return "\n".join(lines)


def missed_on_ci(skipped):
    return [skip for skip in skipped if not any(reason in skip.reason for reason in _NOT_FOR_CI)]


def summary_of_failures(rounds):
    """Each test that failed, with the number of rounds in which it did."""
    failures = collections.Counter(name for result in rounds for name in result.failed)
    return [f"  {count:4} of {len(rounds)} {name}" for name, count in failures.most_common()]


@contextlib.contextmanager
def busy_processors(wanted):
    """Keeps every processor at work meanwhile."""
    if not wanted:
        yield
        return
    load = subprocess.Popen(["stress-ng", "--quiet", "--cpu", str(os.cpu_count()), "--timeout", "0"])
    try:
        yield
    finally:
        load.terminate()
        load.wait()


def run_once(build, options, log):
    """The status of CTest and what its JUnit file says; None if it could not even begin."""
    with tempfile.TemporaryDirectory() as folder:
        report = os.path.join(folder, "report.xml")
        command = ["ctest", "--test-dir", build, "--output-on-failure", "--no-tests=error", "--output-junit", report,
                   "--test-output-size-passed", "8192",
                   "--parallel", os.environ.get("CTEST_PARALLEL_LEVEL", str(os.cpu_count())), *options]
        if log:
            command += ["--output-log", os.path.abspath(log)]
        status = subprocess.run(command, check=False).returncode
        return status, read_round(report) if os.path.exists(report) else None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", required=True, help="folder of the build")
    parser.add_argument("--repeat", type=int, default=1, metavar="N", help="rounds")
    parser.add_argument("--busy", action="store_true", help="keep every processor at work (stress-ng)")
    parser.add_argument("--log", help="CTest's output of the last round goes there as well")
    parser.add_argument("options", nargs="*", help="further options of ctest, after --")
    arguments = parser.parse_args()
    rounds = []
    with busy_processors(arguments.busy):
        for number in range(1, arguments.repeat + 1):
            status, result = run_once(arguments.build, arguments.options, arguments.log)
            if result is None:
                return status or 1
            if status != 0 and not result.failed:
                result.failed.append("ctest itself")
            rounds.append(result)
            if arguments.repeat > 1:
                print(f"== round {number} of {arguments.repeat}: {len(result.failed)} of {result.count} failed", flush=True)
    return judge(rounds)


def judge(rounds):
    """Prints the end of the report; the exit status."""
    print(summary_of_skips(rounds[-1].skipped))
    failures = summary_of_failures(rounds)
    if failures:
        print("failed:", *failures, sep="\n")
    passed = sum(not result.failed for result in rounds)
    if len(rounds) > 1:
        print(f"{passed} of {len(rounds)} rounds passed")
    missed = missed_on_ci(rounds[-1].skipped) if os.environ.get("CI") else []
    for skip in missed:
        print(f"skipped, but CI is there to run it: {skip.test}: {skip.reason}")
    return 1 if failures or missed else 0


if __name__ == "__main__":
    sys.exit(main())
