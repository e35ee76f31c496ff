// What `rungc explain` says to somebody who has no manual.
#include "compiler/reference.h"

#include <gtest/gtest.h>
#include <regex>

namespace rung::compiler {
namespace {

const std::regex kLineOfManual(R"(\bl\.\d|\(P\d+\)|\bman\. )");

TEST(Reference, AllThatASearchListsIsExplainedWithoutLinesOfManuals) {
  const std::vector<ReferenceEntry> entries = referenceEntries();
  EXPECT_GT(entries.size(), 1000u);
  for (const ReferenceEntry& entry : entries) {
    EXPECT_FALSE(std::regex_search(entry.title, kLineOfManual)) << entry.title;
    if (entry.kind == "technol signal" && entry.name.find("[]") != std::string::npos) continue; // BLK[].M3: of a block
    const std::optional<std::string> text = explain(entry.name);
    if (!text) ADD_FAILURE() << entry.kind << " " << entry.name << " is not explained";
    if (text) EXPECT_FALSE(std::regex_search(*text, kLineOfManual)) << *text;
  }
  for (const char* topic : {"fanuc", "gsk", "nct", "technol", "diagnostics", "faults", "config"})
    EXPECT_FALSE(std::regex_search(explainTopic(topic).value(), kLineOfManual)) << topic;
}

TEST(Reference, TitlesAreWholeSentences) {
  const auto titleOf = [](std::string_view name, std::string_view kind) {
    for (const ReferenceEntry& entry : referenceEntries())
      if (entry.name == name && entry.kind == kind) return entry.title;
    return std::string("none");
  };
  EXPECT_EQ(titleOf("param.N", "gsk configuration"), "parameter N; `param.N.A` of axis A, 1 the first.");
  EXPECT_EQ(titleOf("overtravel", "gsk configuration"), "whether the limit switches are wired");
  EXPECT_EQ(titleOf("format-a", "gsk kind of operands").find("none"), std::string::npos);
}

TEST(Reference, AKindOfOperandsByItsName) {
  EXPECT_EQ(explain("format-a", frontend::findDialect("gsk")).value_or("").find("[gsk] kind of operands format-a\n"),
            0u);
  EXPECT_NE(explain("format-a").value_or("").find("[fanuc] kind of operands format-a\n"), std::string::npos);
  EXPECT_EQ(explain("MOV", frontend::findDialect("gsk")), std::nullopt);
  EXPECT_EQ(explain("MOV", frontend::findDialect("nct")).value_or("").find("[nct] "), 0u);
}

TEST(ManualLines, GoWithTheirBrackets) {
  EXPECT_EQ(withoutManualLines("goes before ACT (P17); ends (man. l.540-542, l.7)."), "goes before ACT; ends.");
  EXPECT_EQ(withoutManualLines("twice (ISB, l.5247) and (F23 = bit 22, l.7681-7689)"),
            "twice (ISB) and (F23 = bit 22)");
  EXPECT_EQ(withoutManualLines("of (table says not used; l.6719 assigns it)"), "of (table says not used)");
  EXPECT_EQ(withoutManualLines("steps (l.363, 3022)"), "steps");
  EXPECT_EQ(withoutManualLines("Manual: 5.19, l.1921. Not built yet."), "Manual: 5.19. Not built yet.");
  EXPECT_EQ(withoutManualLines("Manual: l.10-12, 20-22.\nnext"), "next");
  EXPECT_EQ(withoutManualLines("  Group door. Manual: l.10."), "  Group door.");
}

TEST(ManualLines, LeaveTheRest) {
  for (const char* text : {"P1 to P512 (G31 P2)", "a (b (c) d) e", "f() and (", "(5)",
                           "Manual: chapter 28 and those of the services.", "```\n|--[X]--(P17)\n```\n"})
    EXPECT_EQ(withoutManualLines(text), text);
}

} // namespace
} // namespace rung::compiler
