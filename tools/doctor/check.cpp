// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/doctor/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

namespace stairway::doctor {
namespace {

using Json = nlohmann::ordered_json;

State worst(std::span<const Check> checks) {
  const auto has = [&](State state) {
    return std::any_of(checks.begin(), checks.end(), [&](const Check& check) { return check.state == state; });
  };
  if (has(State::Failure)) return State::Failure;
  return has(State::Warning) ? State::Warning : State::Ok;
}

}  // namespace

const char* to_string(State state) {
  switch (state) {
    case State::Ok:
      return "ok";
    case State::Warning:
      return "warning";
    case State::Failure:
      return "failure";
    case State::Skipped:
      return "skipped";
  }
  return "?";
}

Check ok(std::string name, std::string text) { return {std::move(name), State::Ok, std::move(text), {}}; }
Check skipped(std::string name, std::string text) { return {std::move(name), State::Skipped, std::move(text), {}}; }
Check warning(std::string name, std::string text, std::string remedy) {
  return {std::move(name), State::Warning, std::move(text), std::move(remedy)};
}
Check failure(std::string name, std::string text, std::string remedy) {
  return {std::move(name), State::Failure, std::move(text), std::move(remedy)};
}

int exit_code(std::span<const Check> checks) {
  const State state = worst(checks);
  if (state == State::Failure) return 2;
  return state == State::Warning ? 1 : 0;
}

std::string to_text(std::span<const Check> checks) {
  std::size_t widest = 0;
  for (const Check& check : checks) widest = std::max(widest, check.name.size());
  std::string text;
  for (const Check& check : checks) {
    text += fmt::format("{:<8} {:<{}}  {}", to_string(check.state), check.name, widest, check.text);
    text += check.remedy.empty() ? "\n" : fmt::format(" -> {}\n", check.remedy);
  }
  return text;
}

std::string to_json(std::span<const Check> checks) {
  Json list = Json::array();
  for (const Check& check : checks) {
    list.push_back(
        {{"name", check.name}, {"state", to_string(check.state)}, {"text", check.text}, {"remedy", check.remedy}});
  }
  const Json object{{"state", to_string(worst(checks))}, {"checks", std::move(list)}};
  return object.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace stairway::doctor
