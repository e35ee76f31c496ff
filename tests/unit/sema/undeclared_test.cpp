// Names that are not declared: one report for each, at its first use, in all dialects.
#include "frontend/sema/undeclared.h"

#include <gtest/gtest.h>

#include "frontend/dialects/dialect.h"
#include "ir/support/diag/technol.h"
#include "ir/support/diag_render.h"

namespace rung::frontend {
namespace {

struct Case {
  const char* dialect;
  const char* file;
  std::string_view name; // that is not declared
  const char* source;
};

constexpr Case kPrograms[] = {
    {"nct", "a.lad", "LOST",
     "dialect nct\nmodule MAIN\n"
     "rung\n|--[LOST]--(7000.00)\nrung\n|--[7000.01,LOST]--(S 7000.02)\nrung\n|--[/LOST]--{MOV 7001 LOST}\n"},
    {"gsk", "a.pmc", "LOST",
     "FUNC 0\nLD LOST\nOUT Y0.0\nLDI LOST\nOUT Y0.1\nLD LOST\nFUNC MOVN\nPRM 2\nPRM D0\nPRM LOST\nOUT R0.0\nFUNC 1\n"},
    {"gsk", "a.lad", "LOST",
     "dialect gsk\nmodule LEVEL2\nrung\n|--[LOST]--[/LOST]--(Y0.0)\nrung\n|--[LOST]--(S LOST)\n"},
};

// The text of all reports of a program.
std::string reports(const Case& c) {
  SourceManager sources;
  Diagnostics diagnostics;
  const std::vector<FileId> files = {sources.addBuffer(c.file, c.source)};
  (void)findDialect(c.dialect)->check(sources, files, {}, diagnostics);
  return renderText(diagnostics, sources);
}

TEST(Undeclared, OneReportANameAndProgram) {
  for (const Case& c : kPrograms) {
    const std::string text = reports(c);
    const std::string about = "error: '" + std::string(c.name) + "'";
    const size_t first = text.find(about);
    ASSERT_NE(first, std::string::npos) << text;
    EXPECT_EQ(text.find(about, first + 1), std::string::npos) << text;
    EXPECT_NE(text.find("note: and 3 further uses; the next is here"), std::string::npos) << text;
  }
}

using Names = UndeclaredNames<>;

SourceRange at(uint32_t begin) { return {{begin}, {begin + 1}}; }

// The place of each report, and its notes.
std::vector<std::string> reported(Names& names) {
  Diagnostics diagnostics;
  names.report(diagnostics, diag::UndefinedSymbol, [](DiagBuilder&, const UndeclaredUse&) {});
  std::vector<std::string> found;
  for (const Diagnostic& d : diagnostics.reported()) {
    found.push_back(std::get<std::string>(d.args.at(0)) + " at " + std::to_string(d.range.begin.value));
    for (const DiagNote& note : d.notes)
      found.back() += ", " + note.text + " " + std::to_string(note.range.begin.value);
  }
  return found;
}

TEST(Undeclared, UsesComeInAnyOrderAndSeveralTimes) {
  Names names;
  for (const uint32_t place : {30u, 10u, 20u, 10u}) names.add({"A", at(place)});
  for (const uint32_t place : {5u, 7u}) names.add({"B", at(place)});
  names.add({"C", at(1)});
  names.add({"C", at(1)});
  EXPECT_EQ(reported(names), (std::vector<std::string>{"A at 10, and 2 further uses; the next is here 20",
                                                       "B at 5, it is used once more, here 7", "C at 1"}));
  EXPECT_TRUE(reported(names).empty()) << "each is reported once";
}

} // namespace
} // namespace rung::frontend
