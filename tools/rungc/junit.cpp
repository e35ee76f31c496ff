// JUnit XML (see junit.h).
#include "tools/rungc/junit.h"

#include <fmt/format.h>

namespace rung::rungc {
namespace {

std::string escaped(std::string_view text) {
  std::string out;
  for (char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else if (static_cast<unsigned char>(c) < 32 && c != '\n' && c != '\t')
      out += '?'; // not allowed in XML
    else
      out += c;
  }
  return out;
}

} // namespace

std::string junitXml(const std::vector<TestCase>& tests) {
  size_t failures = 0;
  size_t errors = 0;
  std::string cases;
  auto put = std::back_inserter(cases);
  for (const TestCase& test : tests) {
    fmt::format_to(put, "  <testcase classname=\"rungc\" name=\"{}\" time=\"{:.6f}\"", escaped(test.path),
                   test.seconds);
    if (test.result.passed) {
      cases += "/>\n";
      continue;
    }
    const bool environment = !test.result.environment.empty();
    (environment ? errors : failures) += 1;
    std::string text = test.result.environment;
    for (const scenario::Problem& problem : test.result.problems)
      text += fmt::format("{}{}:{}: {}", text.empty() ? "" : "\n", test.path, problem.line, problem.message);
    const char* element = environment ? "error" : "failure";
    fmt::format_to(put, ">\n    <{0} message=\"{1}\">{2}</{0}>\n  </testcase>\n", element,
                   escaped(text.substr(0, text.find('\n'))), escaped(text));
  }
  return fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuite name=\"rungc\" tests=\"{}\" "
                     "failures=\"{}\" errors=\"{}\">\n{}</testsuite>\n",
                     tests.size(), failures, errors, cases);
}

} // namespace rung::rungc
