# SPDX-License-Identifier: GPL-3.0-or-later
"""tests/count_results.py must never turn a failure into a success."""

import pathlib
import subprocess
import sys

import pytest

SCRIPT = pathlib.Path(__file__).resolve().parents[1] / "count_results.py"
CASES = {
    "pass": '<testcase name="a"/>',
    "failure": '<testcase name="b"><failure message="x"/></testcase>',
    "error": '<testcase name="c"><error message="x"/></testcase>',
    "skip": '<testcase name="d"><skipped/></testcase>',
}


@pytest.mark.parametrize(
    "code, cases, last_line, success",
    [
        (0, "pass pass", "2 passed, 0 failed", True),
        (0, "pass skip", "1 passed, 0 failed", True),
        (1, "pass failure error", "1 passed, 2 failed", False),
        (0, "failure", "0 passed, 1 failed", False),  # the results outrank the exit code
        (139, "pass", "1 passed, 1 failed", False),  # a crash after the last test
        (0, "skip", "0 passed, 1 failed", False),  # nothing ran
        (0, "", "0 passed, 1 failed", False),
    ],
)
def test_sum_of_one_step(tmp_path, code, cases, last_line, success):
    file = tmp_path / "results.xml"
    body = "".join(CASES[case] for case in cases.split())
    file.write_text(f"<testsuites><testsuite>{body}</testsuite></testsuites>")
    check(f"step={code}={file}", last_line=last_line, success=success)


def test_missing_or_broken_results_fail(tmp_path):
    broken = tmp_path / "broken.xml"
    broken.write_text("<testsuites><testcase")
    check(f"a=0={broken}", "b=0=/nonexistent.xml", last_line="0 passed, 2 failed", success=False)


def test_steps_without_a_file_count_once():
    check("a=0=-", "b=1=-", last_line="1 passed, 1 failed", success=False)
    check("a=0=-", last_line="1 passed, 0 failed", success=True)


def check(*arguments, last_line, success):
    result = subprocess.run(
        [sys.executable, SCRIPT, *arguments], capture_output=True, text=True, check=False
    )
    assert result.stdout.splitlines()[-1] == last_line
    assert (result.returncode == 0) == success
