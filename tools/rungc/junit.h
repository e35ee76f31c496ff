// Results of scenarios as JUnit XML, the form that CI servers read.
#pragma once
#include <string>
#include <vector>

#include "tools/scenario/runner.h"

namespace rung::rungc {

struct TestCase {
  std::string path;
  double seconds = 0;
  scenario::RunResult result;
};

std::string junitXml(const std::vector<TestCase>& tests);

} // namespace rung::rungc
