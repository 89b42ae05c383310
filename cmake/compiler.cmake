# SPDX-License-Identifier: GPL-3.0-or-later
# Language, visibility, architecture, sanitizers: what holds for every target of this project.

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Debug, Release or RelWithDebInfo" FORCE)
endif()

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

# The libraries end in a Python module that is loaded into Blender, which exports symbols of its own
# Embree, TBB and OpenImageIO: nothing of ours may be visible beside PyInit_.
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)

find_program(ANTIRADIANCE_CCACHE ccache)
mark_as_advanced(ANTIRADIANCE_CCACHE)
if(ANTIRADIANCE_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${ANTIRADIANCE_CCACHE})
endif()

add_library(antiradiance_options INTERFACE)
target_compile_options(antiradiance_options INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wno-sign-conversion
  -fno-math-errno) # nothing reads errno after sqrt, and without it loops with sqrt vectorise
if(ANTIRADIANCE_WARNINGS_AS_ERRORS)
  target_compile_options(antiradiance_options INTERFACE -Werror)
endif()

if(ANTIRADIANCE_NATIVE_ARCH)
  target_compile_options(antiradiance_options INTERFACE -march=native)
elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64)$")
  # SSE4.2 (x86-64-v2, every x86-64 processor since 2009-2013) is what Blender itself asks for from
  # 4.2 on. AVX2 (v3) is not safe to assume: desktop Pentium and Celeron lacked it until 2020.
  target_compile_options(antiradiance_options INTERFACE -march=x86-64-v2)
endif()

if(ANTIRADIANCE_SANITIZE)
  target_compile_options(antiradiance_options INTERFACE
    -fsanitize=${ANTIRADIANCE_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer
    -Wno-maybe-uninitialized) # instrumented code defeats GCC 12's analysis, even of <regex>
  target_link_options(antiradiance_options INTERFACE -fsanitize=${ANTIRADIANCE_SANITIZE})
endif()
