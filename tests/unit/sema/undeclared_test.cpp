// Names that are not declared: one report for each, at its first use, in all dialects.
#include <algorithm>
#include <functional>

#include <gtest/gtest.h>

#include "frontend/dialects/dialect.h"
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

constexpr Case kMisspelt[] = {
    {"nct", "a.lad", "NAEM",
     "dialect nct\nmodule MAIN\nsymbol NAME 7000.01\n"
     "rung\n|--[NAEM]--(7000.00)\nrung\n|--[/NAEM]--[NAEM]--(7000.02)\nrung\n|--{END}\n"},
    {"gsk", "a.pmc", "NAEM",
     "symbol NAME X0.0\nFUNC END1\nLD NAEM\nANI NAEM\nOUT Y0.0\nLD NAEM\nOUT Y0.1\nFUNC END2\n"},
    {"technol", "a.plc", "NAEM",
     "DATA\nDFM NAME\nDATA_END\nMODULE_INPUT\nMODULE_INPUT_END\nMODULE_BLOCK_INIT\nMODULE_BLOCK_INIT_END\n"
     "MODULE_BLOCK_DONE\nMODULE_BLOCK_DONE_END\nMODULE_MAIN\nLDR NAEM\nLA -NAEM\nWR NAEM\nMODULE_MAIN_END\n"
     "MODULE_INIT\nMODULE_INIT_END\nMODULE_CLEAR\nMODULE_CLEAR_END\nMODULE_HALT\nMODULE_HALT_END\nSTOP\n"},
};

TEST(Undeclared, AMisspeltNameIsCorrectedAtAllItsUses) {
  for (const Case& c : kMisspelt) {
    SourceManager sources;
    Diagnostics diagnostics;
    const std::vector<FileId> files = {sources.addBuffer(c.file, c.source)};
    (void)findDialect(c.dialect)->check(sources, files, {}, diagnostics);
    ASSERT_EQ(diagnostics.errorCount(), 1u) << renderText(diagnostics, sources);
    std::vector<DiagFix> fixes = diagnostics.reported().front().fixes;
    EXPECT_EQ(fixes.size(), 3u) << c.dialect;
    std::string text(c.source);
    std::ranges::sort(fixes, std::greater(), [](const DiagFix& fix) { return fix.range.begin.value; });
    for (const DiagFix& fix : fixes)
      text.replace(sources.offsetOf(fix.range.begin), sources.text(fix.range).size(), fix.replacement);
    const std::vector<FileId> fixed = {sources.addBuffer(c.file, text)};
    Diagnostics rest;
    (void)findDialect(c.dialect)->check(sources, fixed, {}, rest);
    EXPECT_EQ(rest.errorCount(), 0u) << renderText(rest, sources);
    EXPECT_EQ(text.find(c.name), std::string::npos) << text;
  }
}

} // namespace
} // namespace rung::frontend
