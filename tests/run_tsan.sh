#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# run_tsan.sh [CTEST-ARGUMENTS...]: the native tests under the thread sanitizer, not a part of run.sh.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
packaging/setup.sh
packaging/build.sh tsan
ctest --test-dir build-tsan --output-on-failure --timeout 1200 --no-tests=error "$@"
