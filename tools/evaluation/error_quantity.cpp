// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/error_quantity.hpp"

#include <cmath>
#include <string>

namespace stairway::evaluation {

Spread absolute_error(std::span<const Outcome> outcomes, const ErrorQuantity& quantity) {
  std::vector<double> values;
  for (const Outcome& outcome : outcomes)
    if (outcome.error) values.push_back(quantity.factor * std::abs(quantity.of(*outcome.error)));
  return spread_of(values);
}

void append_error_columns(std::vector<Column>& columns, std::span<const ErrorQuantity> quantities) {
  for (const ErrorQuantity& quantity : quantities)
    for (const char* figure : {"_error", "_sd"})
      columns.push_back({std::string(quantity.name) + figure, quantity.unit, quantity.digits});
}

void append_errors(std::vector<Cell>& row, std::span<const Outcome> outcomes,
                   std::span<const ErrorQuantity> quantities) {
  for (const ErrorQuantity& quantity : quantities) {
    const Spread spread = absolute_error(outcomes, quantity);
    row.insert(row.end(), {spread.mean, spread.deviation});
  }
}

}  // namespace stairway::evaluation
