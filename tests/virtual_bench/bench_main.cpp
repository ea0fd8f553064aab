// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdio>

namespace {

// One line a scenario, after everything that failures have to say.
class Table : public testing::EmptyTestEventListener {
  void OnTestProgramEnd(const testing::UnitTest& program) override {
    std::printf("\n%-74s %7s %8s\n", "scenario", "result", "seconds");
    for (int s = 0; s < program.total_test_suite_count(); ++s) {
      const testing::TestSuite& suite = *program.GetTestSuite(s);
      for (int t = 0; t < suite.total_test_count(); ++t) {
        const testing::TestInfo& test = *suite.GetTestInfo(t);
        if (test.should_run()) print(suite.name() + std::string(".") + test.name(), *test.result());
      }
    }
    std::printf("%-74s %7s %8.1f\n", "together", program.Passed() ? "passed" : "FAILED",
                1e-3 * static_cast<double>(program.elapsed_time()));
    std::fflush(stdout);
  }

  static void print(const std::string& name, const testing::TestResult& result) {
    const char* verdict = result.Skipped() ? "skipped" : result.Passed() ? "passed" : "FAILED";
    std::printf("%-74s %7s %8.1f\n", name.c_str(), verdict, 1e-3 * static_cast<double>(result.elapsed_time()));
  }
};

}  // namespace

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  testing::UnitTest::GetInstance()->listeners().Append(new Table);
  const int result = RUN_ALL_TESTS();
  if (testing::UnitTest::GetInstance()->test_to_run_count() == 0) {
    std::fputs("no scenario has such a name; --list tells them\n", stderr);
    return 2;
  }
  return result;
}
