# SPDX-FileCopyrightText: The stairwayd authors
# SPDX-License-Identifier: Apache-2.0
# What lcm-gen 1.3.1 writes for a list of booleans is a map, which in Python 3 has neither length nor index.
# Usage: cmake -DFOLDER=... -P mend_python_messages.cmake
file(GLOB files ${FOLDER}/*.py)
foreach(file ${files})
  file(READ ${file} text)
  string(REGEX REPLACE " = map\\(bool, ([^\n]*)\\)\n" " = list(map(bool, \\1))\n" text "${text}")
  file(WRITE ${file} "${text}")
endforeach()
