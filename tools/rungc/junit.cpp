// JUnit XML by pugixml (see junit.h).
#include "tools/rungc/junit.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sstream>

#include <pugixml.hpp>

#include "ir/support/utf8.h"

namespace rung::rungc {
namespace {

// XML 1.0 has neither control characters nor U+FFFE and U+FFFF; texts of scenarios and programs may hold anything.
std::string inXml(std::string_view text) {
  std::string out;
  for (size_t at = 0; at < text.size();) {
    const CodePoint character = decodeUtf8(text, at);
    const uint32_t c = character.value;
    if (!character.valid || c == 0xFFFE || c == 0xFFFF)
      out += "\uFFFD";
    else if (c < ' ' && c != '\n' && c != '\t')
      out += '?';
    else
      out += text.substr(at, character.length);
    at += character.length;
  }
  return out;
}

void addText(pugi::xml_node parent, const char* name, std::string_view text) {
  parent.append_child(name).text().set(inXml(text).c_str());
}

void addFailure(pugi::xml_node parent, const scenario::RunResult& result) {
  std::string text = result.environment;
  for (const scenario::Problem& problem : result.problems) text += (text.empty() ? "" : "\n") + textOf(problem);
  const char* name = result.environment.empty() ? "failure" : "error";
  addText(parent, name, text);
  parent.last_child().append_attribute("message") = inXml(text.substr(0, text.find('\n'))).c_str();
}

void addCase(pugi::xml_node suite, const TestCase& test) {
  pugi::xml_node element = suite.append_child("testcase");
  element.append_attribute("classname") = "rungc";
  element.append_attribute("name") = inXml(test.path).c_str();
  element.append_attribute("time") = fmt::format("{:.6f}", test.seconds).c_str();
  if (!test.result.passed) addFailure(element, test.result);
  if (!test.result.printed.empty())
    addText(element, "system-out", fmt::format("{}", fmt::join(test.result.printed, "\n")));
}

} // namespace

std::string junitXml(const std::vector<TestCase>& tests) {
  const auto failed = [](const TestCase& t) { return !t.result.passed && t.result.environment.empty(); };
  const auto notRun = [](const TestCase& t) { return !t.result.passed && !t.result.environment.empty(); };
  pugi::xml_document document;
  pugi::xml_node declaration = document.append_child(pugi::node_declaration);
  declaration.append_attribute("version") = "1.0";
  declaration.append_attribute("encoding") = "UTF-8";
  pugi::xml_node suite = document.append_child("testsuite");
  suite.append_attribute("name") = "rungc";
  suite.append_attribute("tests") = tests.size();
  suite.append_attribute("failures") = std::ranges::count_if(tests, failed);
  suite.append_attribute("errors") = std::ranges::count_if(tests, notRun);
  for (const TestCase& test : tests) addCase(suite, test);
  std::ostringstream out;
  document.save(out, "  ", pugi::format_default, pugi::encoding_utf8);
  return std::move(out).str();
}

} // namespace rung::rungc
