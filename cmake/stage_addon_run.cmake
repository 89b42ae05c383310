# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -DSOURCE=repository -DSTAGE=folder -DPYTHON=python3 [-DMODULE=file.so] -P stage_addon_run.cmake
# Copies what changed and deletes what no longer has a source.
cmake_minimum_required(VERSION 3.25)

set(wanted "")
function(stage source target)
  file(COPY_FILE ${source} ${STAGE}/${target} ONLY_IF_DIFFERENT)
  set(wanted ${wanted} ${target} PARENT_SCOPE)
endfunction()

function(make_folder_of target)
  cmake_path(GET target PARENT_PATH folder)
  file(MAKE_DIRECTORY ${STAGE}/${folder})
endfunction()

file(GLOB_RECURSE addon_files RELATIVE ${SOURCE}/addon ${SOURCE}/addon/*)
list(FILTER addon_files EXCLUDE REGEX "(^|/)__pycache__/|\\.pyc$|(^|/)\\.|^make_manifest\\.py$")
foreach(file IN LISTS addon_files)
  make_folder_of(${file})
  stage(${SOURCE}/addon/${file} ${file})
endforeach()

file(GLOB_RECURSE shader_files RELATIVE ${SOURCE} ${SOURCE}/shaders/*)
list(FILTER shader_files EXCLUDE REGEX "\\.md$|(^|/)\\.")
foreach(file IN LISTS shader_files)
  make_folder_of(${file})
  stage(${SOURCE}/${file} ${file})
endforeach()

file(MAKE_DIRECTORY ${STAGE})
stage(${SOURCE}/LICENSE LICENSE)
# Blender 4.2 and later read what 3.4 finds in bl_info from a file.
if(EXISTS ${SOURCE}/addon/make_manifest.py)
  execute_process(
    COMMAND ${PYTHON} -B ${SOURCE}/addon/make_manifest.py ${STAGE}/__init__.py ${STAGE}/blender_manifest.toml
    COMMAND_ERROR_IS_FATAL ANY)
  list(APPEND wanted blender_manifest.toml)
endif()
if(MODULE)
  cmake_path(GET MODULE FILENAME name)
  stage(${MODULE} ${name})
endif()

file(GLOB_RECURSE staged RELATIVE ${STAGE} ${STAGE}/*)
list(FILTER staged EXCLUDE REGEX "(^|/)__pycache__/")
foreach(file IN LISTS staged)
  if(NOT file IN_LIST wanted)
    file(REMOVE ${STAGE}/${file})
  endif()
endforeach()
