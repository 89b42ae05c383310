# SPDX-License-Identifier: GPL-3.0-or-later
"""count_results.py STEP=EXITCODE=JUNITFILE|- ...: sums the steps of run.sh.

A step without a JUnit file is one test. A step that failed although none of its tests did, or that
left no results (it crashed, ran into its time limit or collected nothing), is one failed test more.
"""

import pathlib
import sys
import xml.etree.ElementTree as ElementTree


def count_cases(path):
    """(passed, names of failed, names of skipped) of one JUnit file, by ctest or pytest."""
    passed, failed, skipped = 0, [], []
    for case in ElementTree.parse(path).iter("testcase"):
        name = f"{case.get('classname', '')} {case.get('name')}"
        if case.find("failure") is not None or case.find("error") is not None:
            failed.append(name)
        elif case.find("skipped") is not None:
            skipped.append(name)
        else:
            passed += 1
    return passed, failed, skipped


def main():
    all_passed, all_failed, all_skipped = 0, [], []
    for argument in sys.argv[1:]:
        step, code, file = argument.split("=", 2)
        passed, failed, skipped = 0, [], []
        if file == "-":
            passed = int(code == "0")
        else:
            try:
                passed, failed, skipped = count_cases(pathlib.Path(file))
            except (OSError, ElementTree.ParseError) as error:
                failed.append(f"{step}: no results ({error})")
            if not passed and not failed:
                failed.append(f"{step}: ran no test")
        if code != "0" and not failed:
            failed.append(f"{step}: exit code {code}")
        all_passed += passed
        all_failed += failed
        all_skipped += skipped
    for name in all_skipped:
        print(f"skipped: {name}")
    for name in all_failed:
        print(f"failed: {name}")
    print(f"{all_passed} passed, {len(all_failed)} failed")
    return 1 if all_failed or not all_passed else 0


if __name__ == "__main__":
    sys.exit(main())
