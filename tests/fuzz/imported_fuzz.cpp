// libFuzzer target: any bytes as each kind of file that rungc import takes. Every remark has a place in the file, and
// what is made of a file without mistakes can be read: as statements, or again as symbols.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "ir/support/check.h"
#include "ir/support/encoding.h"
#include "ir/support/foreign_file.h"
#include "tools/imported/imported.h"
#include "tools/scenario/scenario.h"

namespace {

using namespace rung::imported;

void checkRemarks(const Imported& made, const Source& source) {
  const auto lines = static_cast<uint32_t>(std::ranges::count(source.text, '\n') + 1);
  for (const Remark& remark : made.remarks) {
    RUNG_CHECK(remark.at.line > 0 && remark.at.line <= lines && remark.at.column > 0, "a remark has a place");
    RUNG_CHECK(!remark.text.empty() && textOf(source, remark).find('\n') == std::string::npos, "and is a line");
  }
}

void checkStatements(const Imported& made, const Source& source) {
  checkRemarks(made, source);
  if (!made.isUsable()) return;
  const rung::scenario::Scenario read = rung::scenario::parse("f.scn", "program main.mne\n" + made.text);
  RUNG_CHECK(read.problems.empty(), "what is made is statements");
  for (const rung::scenario::Statement& statement : read.statements) {
    using rung::scenario::Kind;
    const Kind kind = statement.kind;
    const bool isTime = kind == Kind::Slot || kind == Kind::Scan;
    RUNG_CHECK(isTime || kind == Kind::Program || kind == Kind::Set || kind == Kind::Expect, "of these kinds");
  }
}

void checkSymbols(const Imported& made, const Source& source) {
  checkRemarks(made, source);
  if (!made.isUsable()) return;
  RUNG_CHECK(!rung::foreignFile(made.text), "what is made is a file of a program");
  const Imported again = symbolSection({.name = source.name, .text = made.text});
  RUNG_CHECK(again.isUsable() && again.text == made.text, "which is the same when it is read again");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const std::string text = rung::decoded(bytes, rung::guessedEncoding(bytes)).text;
  const Source source{.name = "f", .text = text};
  static_cast<void>(rung::foreignFile(bytes));
  checkStatements(initialValues(source), source);
  checkStatements(scenarioOfSignals(source), source);
  const auto tolerance = static_cast<uint32_t>(size % 3);
  checkStatements(scenarioOfTrace(source, {.us = 4000, .tolerance = tolerance, .settleUs = 100}), source);
  checkSymbols(symbolSection(source), source);
  return 0;
}
