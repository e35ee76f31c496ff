// libFuzzer target: any bytes as a scenario. Each statement reads alone as it reads in its file, each problem has its
// line. What a scenario includes is not there.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "ir/support/check.h"
#include "tools/scenario/scenario.h"

namespace {

using namespace rung::scenario;

void checkStatement(const Statement& statement, uint32_t lines) {
  RUNG_CHECK(statement.file == "nowhere/f.scn" && statement.line > 0 && statement.line <= lines, "a statement's place");
  const rung::Result<Statement> alone = parseStatement(statement.text);
  RUNG_CHECK(alone.ok(), "a statement reads alone");
  const Statement& other = alone.value();
  RUNG_CHECK(other.kind == statement.kind && other.name == statement.name && other.words == statement.words &&
                 other.count == statement.count && other.microseconds == statement.microseconds &&
                 other.number == statement.number && other.value.text == statement.value.text &&
                 other.value.integer == statement.value.integer && other.keys.size() == statement.keys.size() &&
                 other.results.size() == statement.results.size(),
             "and as the same");
  RUNG_CHECK(statement.microseconds >= 0, "time does not go back");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const Scenario scenario = parse("nowhere/f.scn", text);
  uint32_t lines = 1;
  for (const char c : text) lines += c == '\n' ? 1 : 0;
  for (const Statement& statement : scenario.statements) checkStatement(statement, lines);
  for (const Problem& problem : scenario.problems) {
    RUNG_CHECK(problem.file == "nowhere/f.scn" && problem.line > 0 && problem.line <= lines, "a problem's place");
    RUNG_CHECK(!problem.message.empty(), "a problem says what it is");
  }
  RUNG_CHECK(!scenario.statements.empty() || !scenario.problems.empty(), "a scenario of nothing is refused");
  static_cast<void>(expectsNothing(scenario));
  return 0;
}
