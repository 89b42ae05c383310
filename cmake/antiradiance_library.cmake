# SPDX-License-Identifier: GPL-3.0-or-later

# antiradiance_library(FOLDER SOURCES a.cpp b.cpp [PUBLIC lib...] [PRIVATE lib...])
# The static library antiradiance_FOLDER of native/FOLDER. Includes are relative to native/.
# A library goes under PUBLIC when the folder's headers include it, else under PRIVATE.
function(antiradiance_library folder)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;PUBLIC;PRIVATE")
  if(arg_UNPARSED_ARGUMENTS OR NOT arg_SOURCES)
    message(FATAL_ERROR "antiradiance_library(FOLDER SOURCES ... [PUBLIC ...] [PRIVATE ...]), got: ${ARGV}")
  endif()
  string(REGEX REPLACE "^antiradiance_" "" folder ${folder})
  set(name antiradiance_${folder})
  add_library(${name} STATIC ${arg_SOURCES})
  target_include_directories(${name} PUBLIC ${PROJECT_SOURCE_DIR}/native)
  target_link_libraries(${name} PUBLIC ${arg_PUBLIC} PRIVATE ${arg_PRIVATE} antiradiance_options)
endfunction()
