# SPDX-License-Identifier: GPL-3.0-or-later
# Every library that is used, by its system package (packaging/debian-packages.txt).
#
# Targets to link: glm::glm, embree, PkgConfig::OIIO, TBB::tbb, PkgConfig::EPOXY (OpenGL and EGL entry
# points, with libEGL), tinyobjloader::tinyobjloader, nlohmann_json::nlohmann_json, CLI11::CLI11,
# pybind11 (through pybind11_add_module), GTest::gtest, benchmark::benchmark.

find_package(PkgConfig REQUIRED)
find_package(Threads REQUIRED)
find_package(glm REQUIRED)
find_package(TBB REQUIRED)
find_package(tinyobjloader REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)

# The API differs between 3 and 4 (rtcIntersect1 takes a context in 3); RTC_VERSION_MAJOR tells.
find_package(embree 4 QUIET)
if(NOT embree_FOUND)
  find_package(embree 3 REQUIRED)
endif()

# find_package(OpenImageIO) is broken in Debian 12 and 13: its exported targets name missing ones.
pkg_check_modules(OIIO REQUIRED IMPORTED_TARGET OpenImageIO)
pkg_check_modules(EPOXY REQUIRED IMPORTED_TARGET epoxy egl)

if(ANTIRADIANCE_BUILD_PYTHON)
  # The system's Python unless another is asked for: it is the one that the system's Blender
  # embeds, and a pyenv or virtual environment first on PATH gives a module Blender cannot load.
  if(NOT DEFINED Python_EXECUTABLE AND EXISTS /usr/bin/python3)
    set(Python_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "Python that the module is built for")
  endif()
  find_package(Python 3.10 REQUIRED COMPONENTS Interpreter Development.Module)
  set(CMAKE_INTERPROCEDURAL_OPTIMIZATION OFF) # else pybind11 adds -flto, for a thin file of bindings
  find_package(pybind11 REQUIRED)
endif()
if(ANTIRADIANCE_BUILD_TESTS)
  find_package(GTest REQUIRED)
endif()
if(ANTIRADIANCE_BUILD_BENCHMARKS)
  find_package(benchmark REQUIRED)
endif()
