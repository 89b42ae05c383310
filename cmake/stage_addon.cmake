# SPDX-License-Identifier: GPL-3.0-or-later
# Target `stage_addon`: BUILD/blender/addons/antiradiance becomes the complete add-on, for
#   BLENDER_USER_SCRIPTS=BUILD/blender blender --addons antiradiance
# It runs in every build (tens of milliseconds): a list of files would miss those added later.

set(ANTIRADIANCE_ADDON_DIR ${PROJECT_BINARY_DIR}/blender/addons/antiradiance)
set(module "")
if(TARGET _antiradiance)
  set(module $<TARGET_FILE:_antiradiance>)
endif()
add_custom_target(stage_addon ALL
  COMMAND ${CMAKE_COMMAND} -DSOURCE=${PROJECT_SOURCE_DIR} -DSTAGE=${ANTIRADIANCE_ADDON_DIR} -DMODULE=${module}
          -DPYTHON=${Python_EXECUTABLE}
          -P ${PROJECT_SOURCE_DIR}/cmake/stage_addon_run.cmake
  VERBATIM)
if(TARGET _antiradiance)
  add_dependencies(stage_addon _antiradiance)
endif()
