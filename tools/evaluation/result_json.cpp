// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/result_json.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

namespace stairway::evaluation {
namespace {

using Json = nlohmann::ordered_json;

Json as_json(const Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  const auto* number = std::get_if<double>(&cell);
  return number != nullptr && std::isfinite(*number) ? Json(*number) : Json(nullptr);
}

Json as_json(const Table& table) {
  Json columns = Json::array(), rows = Json::array();
  for (const Column& column : table.columns) columns.push_back({{"name", column.name}, {"unit", column.unit}});
  for (const auto& row : table.rows) {
    Json cells = Json::array();
    for (const Cell& cell : row) cells.push_back(as_json(cell));
    rows.push_back(std::move(cells));
  }
  return {{"name", table.name}, {"title", table.title}, {"columns", std::move(columns)}, {"rows", std::move(rows)}};
}

}  // namespace

std::string result_json(const Experiment& experiment, const Request& request, const Result& result) {
  Json tables = Json::array();
  for (const Table& table : result.tables) tables.push_back(as_json(table));
  const Json object{{"name", experiment.name},
                    {"seed", request.seed},
                    {"share", request.share},
                    {"tables", std::move(tables)},
                    {"notes", result.notes}};
  return object.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace stairway::evaluation
