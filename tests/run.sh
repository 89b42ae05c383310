#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# All set-up and all tests; the last line is "N passed, N failed", and the exit code says the same.
# Not run here, for their time: run_tsan.sh, lint.sh --tidy, tests/bench, packaging/test_fresh_debian.sh.
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
results=$PWD/build/test-results
python=/usr/bin/python3

# step NAME RESULT-FILE|- COMMAND...
# With `-` the step counts as one test; else the command leaves its own tests in a JUnit file.
step() {
    local name=$1 file=$2 begin=$SECONDS code=0
    shift 2
    echo
    echo "==== $name"
    if [ "$file" != - ]; then
        file=$results/$file.xml
    fi
    timeout --kill-after=20 1200 "$@" || code=$?
    echo "==== $name: exit code $code after $((SECONDS - begin)) s"
    steps+=("$name=$code=$file")
    return "$code"
}

finish() {
    echo
    "$python" tests/count_results.py "${steps[@]}"
    exit
}

native_tests() {
    local folder=$1
    ctest --test-dir "$folder" --output-on-failure --timeout 600 --parallel "$(nproc)" \
        --no-tests=error --output-junit "$results/native-$folder.xml" | grep -v ' Passed '
}

python_tests() {
    "$python" -m pytest -p no:cacheprovider -q -rfEs --junit-xml="$results/$1.xml" "tests/$1"
}
export -f native_tests python_tests
export results python

steps=()
step "set-up" - packaging/setup.sh || finish
mkdir -p "$results"
rm -f "$results"/*.xml
step "build" - packaging/build.sh || finish
step "formatting" - tests/lint.sh
step "native tests" native-build bash -o pipefail -c "native_tests build"
step "Python tests" python bash -c "python_tests python"
step "Blender tests" blender bash -c "python_tests blender"
if step "sanitizer build" - packaging/build.sh asan-ubsan; then
    step "native tests under the address and undefined-behaviour sanitizers" \
        native-build-asan-ubsan bash -o pipefail -c "native_tests build-asan-ubsan"
fi
finish
