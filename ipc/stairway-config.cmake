# SPDX-FileCopyrightText: The stairwayd authors
# SPDX-License-Identifier: Apache-2.0
# find_package(stairway) gives stairway::messages: the C++ classes of stairwayd's messages, and LCM itself.
find_path(stairway_LCM_INCLUDE_DIR lcm/lcm-cpp.hpp)
find_library(stairway_LCM_LIBRARY lcm)
if(NOT stairway_LCM_INCLUDE_DIR OR NOT stairway_LCM_LIBRARY)
  set(stairway_FOUND FALSE)
  set(stairway_NOT_FOUND_MESSAGE "LCM is missing; on Debian it is in liblcm-dev")
  return()
endif()
if(NOT TARGET stairway::messages)
  add_library(stairway::messages INTERFACE IMPORTED)
  get_filename_component(stairway_INCLUDE_DIR "${CMAKE_CURRENT_LIST_DIR}/../../../include" ABSOLUTE)
  target_include_directories(stairway::messages INTERFACE "${stairway_INCLUDE_DIR}" "${stairway_LCM_INCLUDE_DIR}")
  target_link_libraries(stairway::messages INTERFACE "${stairway_LCM_LIBRARY}")
endif()
