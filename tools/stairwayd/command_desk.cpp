// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairwayd/command_desk.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace stairway::daemon {
namespace {

using drivers::DiskMode;
using ipc::CommandAction;
using ipc::CommandResult;

constexpr std::size_t kMaxWaiting = 16;
constexpr std::size_t kKeptAnswers = 16;
constexpr double kTurn_rad = 2.0 * std::numbers::pi;

// What the settings permit, too.
constexpr double kShortestTurn_s = 1.0;

double turn_s(double speed_rad_s) { return kTurn_rad / std::abs(speed_rad_s); }

}  // namespace

CommandDesk::CommandDesk(const config::Settings& settings)
    : max_age_s_(settings.command.max_age_s),
      max_sweep_s_(settings.sweep.max_duration_s),
      motor_(settings.motor),
      mode_(settings.disk.mode),
      speed_rad_s_(settings.disk.speed_rad_s()) {}

bool CommandDesk::receive(ipc::CommandMessage command) {
  const std::lock_guard lock(mutex_);
  waiting_.push_back(std::move(command));
  if (waiting_.size() <= kMaxWaiting) return true;
  waiting_.pop_front();
  return false;
}

std::vector<ipc::CommandAckMessage> CommandDesk::obey(MeasurementSource& source, std::int64_t now_utime_us) {
  std::deque<ipc::CommandMessage> commands;
  {
    const std::lock_guard lock(mutex_);
    commands.swap(waiting_);
  }
  std::vector<ipc::CommandAckMessage> answers;
  for (const ipc::CommandMessage& command : commands) {
    const auto earlier = std::ranges::find(answers_, command.id, &ipc::CommandAckMessage::id);
    if (earlier != answers_.end()) {
      answers.push_back(*earlier);
      continue;
    }
    answers_.push_back(answer(command, source, now_utime_us));
    answers.push_back(answers_.back());
    if (answers_.size() > kKeptAnswers) answers_.pop_front();
  }
  return answers;
}

void CommandDesk::note_sweep(const scan::Sweep& sweep, MeasurementSource& source) {
  next_sweep_ = sweep.number + 1;
  const bool is_whole = sweep.statistics.end == scan::SweepEnd::FullTurn && sweep.statistics.covers_whole_turn();
  if (mode_ != DiskMode::SingleSweep || sweep.number < single_sweep_ || !is_whole) return;
  mode_ = DiskMode::Idle;
  static_cast<void>(source.order({false, speed_rad_s_}));
}

ipc::CommandAckMessage CommandDesk::answer(const ipc::CommandMessage& command, MeasurementSource& source,
                                           std::int64_t now_utime_us) {
  ipc::CommandAckMessage ack{.utime_us = now_utime_us, .id = command.id};
  if (ack.text = age_problem(command, now_utime_us); !ack.text.empty()) {
    ack.result = CommandResult::TooOld;
  } else if (ack.text = value_problem(command); !ack.text.empty()) {
    ack.result = CommandResult::BadValue;
  } else if (ack.text = carry_out(command, source); !ack.text.empty()) {
    ack.result = CommandResult::WrongSource;
  } else {
    ack.text = describe();
  }
  ack.mode = mode_;
  ack.speed_rad_s = speed_rad_s_;
  return ack;
}

std::string CommandDesk::age_problem(const ipc::CommandMessage& command, std::int64_t now_utime_us) const {
  const double age_s = 1e-6 * (static_cast<double>(now_utime_us) - static_cast<double>(command.utime_us));
  if (std::abs(age_s) <= max_age_s_) return {};
  return fmt::format("given {:.1f} s {}, more than command.max_age_s: is it from a recording, or do the clocks differ?",
                     std::abs(age_s), age_s > 0.0 ? "ago" : "in the future");
}

std::string CommandDesk::value_problem(const ipc::CommandMessage& command) const {
  if (command.action == CommandAction::Unknown) return "no such action in this version";
  if (command.action != CommandAction::SetSpeed) return {};
  const double period_s = turn_s(command.speed_rad_s);
  if (period_s >= kShortestTurn_s && period_s <= max_sweep_s_)
    return drivers::speed_problem(motor_, command.speed_rad_s);
  return fmt::format(
      "a turn must take {:g} to {:g} s (sweep.max_duration_s), so the speed must be {:.3f} to {:.3f} deg/s, or the "
      "same clockwise",
      kShortestTurn_s, max_sweep_s_, 360.0 / max_sweep_s_, 360.0 / kShortestTurn_s);
}

std::string CommandDesk::carry_out(const ipc::CommandMessage& command, MeasurementSource& source) {
  DiskMode mode = mode_;
  double speed_rad_s = speed_rad_s_;
  if (command.action == CommandAction::Start) mode = DiskMode::Continuous;
  if (command.action == CommandAction::Stop) mode = DiskMode::Idle;
  if (command.action == CommandAction::SingleSweep) mode = DiskMode::SingleSweep;
  if (command.action == CommandAction::SetSpeed) speed_rad_s = command.speed_rad_s;
  if (std::string problem = source.order({mode != DiskMode::Idle, speed_rad_s}); !problem.empty()) return problem;
  if (command.action == CommandAction::SingleSweep)
    single_sweep_ = mode_ == DiskMode::Idle ? next_sweep_ : next_sweep_ + 1;
  mode_ = mode;
  speed_rad_s_ = speed_rad_s;
  return {};
}

std::string CommandDesk::describe() const {
  const std::string turning =
      fmt::format(", a turn in {:.1f} s{}", turn_s(speed_rad_s_), speed_rad_s_ < 0.0 ? " clockwise" : "");
  return to_string(mode_.load()) + (mode_ == DiskMode::Idle ? ": the disk rests, the motor is off" : turning);
}

}  // namespace stairway::daemon
