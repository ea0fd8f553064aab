// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/integration/daemon_process.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <thread>

namespace stairway::test {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr auto kPause = 20ms;

}  // namespace

DaemonProcess::DaemonProcess(const std::vector<std::string>& arguments, const std::vector<std::string>& environment,
                             const std::string& program) {
  static int number = 0;
  const std::string name = "stairwayd_" + std::to_string(::getpid()) + "_" + std::to_string(number++) + ".log";
  output_file_ = std::filesystem::path(testing::TempDir()) / name;
  std::vector<char*> argv{const_cast<char*>(program.c_str())};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  pid_ = ::fork();
  if (pid_ != 0) return;
  const int output = ::open(output_file_.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600);
  ::dup2(output, STDOUT_FILENO);
  ::dup2(output, STDERR_FILENO);
  for (const std::string& assignment : environment) ::putenv(const_cast<char*>(assignment.c_str()));
  ::execv(argv[0], argv.data());
  ::_exit(127);
}

DaemonProcess::~DaemonProcess() {
  if (is_running()) {
    signal(SIGKILL);
    wait(5s);
  }
  if (testing::Test::HasFailure()) std::fputs(output().c_str(), stderr);
  std::filesystem::remove(output_file_);
}

void DaemonProcess::signal(int number) const { ::kill(pid_, number); }

std::optional<int> DaemonProcess::wait(std::chrono::milliseconds timeout) {
  const auto end = Clock::now() + timeout;
  while (!exit_code_) {
    int status = 0;
    if (::waitpid(pid_, &status, WNOHANG) == pid_) exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    if (exit_code_ || Clock::now() >= end) break;
    std::this_thread::sleep_for(kPause);
  }
  return exit_code_;
}

std::string DaemonProcess::output() const {
  std::ifstream file(output_file_);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

bool DaemonProcess::has_said(const std::string& text, std::chrono::milliseconds timeout) const {
  const auto end = Clock::now() + timeout;
  while (output().find(text) == std::string::npos) {
    if (Clock::now() >= end) return false;
    std::this_thread::sleep_for(kPause);
  }
  return true;
}

}  // namespace stairway::test
