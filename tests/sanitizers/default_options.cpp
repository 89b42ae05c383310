// SPDX-License-Identifier: GPL-3.0-or-later
// Linked into each native test of a sanitizer build; environment variables still override it.
// Suppressions name what drivers and system libraries do, nothing of ours.

#define SUPPRESSIONS(file) "suppressions=" ANTIRADIANCE_SOURCE_DIR "/tests/sanitizers/" file

// The runtime libraries look these names up, so they are exported from an otherwise quiet program.
#pragma GCC visibility push(default)
extern "C" {
const char* __lsan_default_options();
const char* __ubsan_default_options();
const char* __tsan_default_options();
}
#pragma GCC visibility pop

const char* __lsan_default_options() {
    return SUPPRESSIONS("lsan.supp") ":print_suppressions=0";
}
const char* __ubsan_default_options() {
    return "print_stacktrace=1";
}
const char* __tsan_default_options() {
    return SUPPRESSIONS("tsan.supp") ":ignore_noninstrumented_modules=1";
}
