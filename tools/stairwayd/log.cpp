// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairwayd/log.hpp"

#include <fmt/format.h>
#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <map>
#include <mutex>

namespace stairway::daemon::log {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds kQuiet{10};
constexpr std::size_t kMaxNames = 100;

class JournalPriority final : public spdlog::custom_flag_formatter {
 public:
  void format(const spdlog::details::log_msg& message, const std::tm&, spdlog::memory_buf_t& line) override {
    const std::string_view prefix = message.level >= spdlog::level::err    ? "<3>"
                                    : message.level == spdlog::level::warn ? "<4>"
                                    : message.level == spdlog::level::info ? "<6>"
                                                                           : "<7>";
    line.append(prefix.data(), prefix.data() + prefix.size());
  }
  std::unique_ptr<custom_flag_formatter> clone() const override { return std::make_unique<JournalPriority>(); }
};

spdlog::level::level_enum to_spdlog(config::LogLevel level) {
  switch (level) {
    case config::LogLevel::Error:
      return spdlog::level::err;
    case config::LogLevel::Warning:
      return spdlog::level::warn;
    case config::LogLevel::Info:
      return spdlog::level::info;
    case config::LogLevel::Debug:
      break;
  }
  return spdlog::level::debug;
}

struct Repetition {
  Clock::time_point said;
  std::uint64_t unsaid = 0;
};

std::mutex repetitions_mutex;
std::map<std::string, Repetition> repetitions;

}  // namespace

void set_up(config::LogLevel level) {
  // Desktop sessions hand JOURNAL_STREAM down to their terminals.
  const bool is_terminal = ::isatty(STDERR_FILENO) == 1;
  const bool is_journal = std::getenv("JOURNAL_STREAM") != nullptr && !is_terminal;
  auto formatter = std::make_unique<spdlog::pattern_formatter>();
  formatter->add_flag<JournalPriority>('J').set_pattern(is_journal ? "%J%v" : "%H:%M:%S.%e %^%l%$ %v");
  auto logger = std::make_shared<spdlog::logger>("stairwayd", std::make_shared<spdlog::sinks::stderr_color_sink_mt>());
  logger->set_formatter(std::move(formatter));
  logger->flush_on(spdlog::level::debug);
  spdlog::set_default_logger(std::move(logger));
  set_level(level);
}

void set_level(config::LogLevel level) { spdlog::set_level(to_spdlog(level)); }

void error(std::string_view text) { spdlog::error(text); }
void warning(std::string_view text) { spdlog::warn(text); }
void info(std::string_view text) { spdlog::info(text); }
void debug(std::string_view text) { spdlog::debug(text); }

void repeated_warning(const std::string& name, std::string_view text) {
  const std::lock_guard lock(repetitions_mutex);
  if (repetitions.size() >= kMaxNames) repetitions.clear();
  const Clock::time_point now = Clock::now();
  const auto [entry, is_new] = repetitions.try_emplace(name, Repetition{now});
  Repetition& repetition = entry->second;
  if (!is_new && now - repetition.said < kQuiet) {
    ++repetition.unsaid;
    return;
  }
  warning(repetition.unsaid == 0 ? std::string(text) : fmt::format("{} ({} times more)", text, repetition.unsaid));
  repetition = {now, 0};
}

}  // namespace stairway::daemon::log
