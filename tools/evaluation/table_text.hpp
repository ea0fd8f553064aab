// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tools/evaluation/experiment.hpp"

namespace stairway::evaluation {

/// A table for a terminal: the title, the names of the columns with their units below, the rows; numbers to the right,
/// names to the left, "-" for what is empty or not a number. Ends with a line end.
std::string table_text(const Table& table);

/// Tables one below the other, then the notes.
std::string result_text(const Result& result);

}  // namespace stairway::evaluation
