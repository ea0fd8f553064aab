// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/speed/child_process.hpp"

#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <stdexcept>

namespace stairway::bench {
namespace {

std::runtime_error failure(const std::vector<std::string>& command, const std::string& what) {
  std::string text;
  for (const std::string& word : command) text += word + ' ';
  return std::runtime_error(text + what);
}

pid_t spawn(const std::vector<std::string>& command, const std::array<int, 2>& pipe_ends) {
  std::vector<char*> words;
  for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, pipe_ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_addclose(&actions, pipe_ends[0]);
  posix_spawn_file_actions_addclose(&actions, pipe_ends[1]);
  pid_t id = 0;
  const int trouble = posix_spawnp(&id, words[0], &actions, nullptr, words.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (trouble != 0) throw failure(command, "cannot be run");
  return id;
}

std::string read_to_end(int file) {
  std::string text;
  std::array<char, 4096> part{};
  for (ssize_t count = 0; (count = read(file, part.data(), part.size())) > 0;)
    text.append(part.data(), static_cast<std::size_t>(count));
  return text;
}

double in_ms(const timeval& time) {
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-3 * static_cast<double>(time.tv_usec);
}

}  // namespace

ChildRun run_child(const std::vector<std::string>& command) {
  std::array<int, 2> pipe_ends{};
  if (pipe(pipe_ends.data()) != 0) throw failure(command, "has no pipe");
  const auto start = std::chrono::steady_clock::now();
  const pid_t id = spawn(command, pipe_ends);
  close(pipe_ends[1]);
  ChildRun run{.output = read_to_end(pipe_ends[0])};
  close(pipe_ends[0]);
  int status = 0;
  rusage usage{};
  wait4(id, &status, 0, &usage);
  run.wall_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  run.cpu_ms = in_ms(usage.ru_utime) + in_ms(usage.ru_stime);
  run.peak_MB = static_cast<double>(usage.ru_maxrss) / 1024.0;
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) throw failure(command, "has failed");
  return run;
}

}  // namespace stairway::bench
