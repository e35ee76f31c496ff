// JUnit XML (see junit.h).
#include "tools/rungc/junit.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

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

std::string failureElement(const TestCase& test) {
  std::string text = test.result.environment;
  for (const scenario::Problem& problem : test.result.problems) text += (text.empty() ? "" : "\n") + textOf(problem);
  return fmt::format("    <{0} message=\"{1}\">{2}</{0}>\n", test.result.environment.empty() ? "failure" : "error",
                     escaped(text.substr(0, text.find('\n'))), escaped(text));
}

std::string caseElement(const TestCase& test) {
  std::string content;
  if (!test.result.passed) content += failureElement(test);
  if (!test.result.printed.empty())
    content += fmt::format("    <system-out>{}</system-out>\n",
                           escaped(fmt::format("{}", fmt::join(test.result.printed, "\n"))));
  const std::string attributes =
      fmt::format("classname=\"rungc\" name=\"{}\" time=\"{:.6f}\"", escaped(test.path), test.seconds);
  return content.empty() ? fmt::format("  <testcase {}/>\n", attributes)
                         : fmt::format("  <testcase {}>\n{}  </testcase>\n", attributes, content);
}

} // namespace

std::string junitXml(const std::vector<TestCase>& tests) {
  const auto failed = [](const TestCase& t) { return !t.result.passed && t.result.environment.empty(); };
  const auto notRun = [](const TestCase& t) { return !t.result.passed && !t.result.environment.empty(); };
  std::string cases;
  for (const TestCase& test : tests) cases += caseElement(test);
  return fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuite name=\"rungc\" tests=\"{}\" "
                     "failures=\"{}\" errors=\"{}\">\n{}</testsuite>\n",
                     tests.size(), std::ranges::count_if(tests, failed), std::ranges::count_if(tests, notRun), cases);
}

} // namespace rung::rungc
