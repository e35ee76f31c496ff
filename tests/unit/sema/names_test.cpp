// The table of names that all front ends use.
#include "frontend/sema/names.h"

#include <string>

#include <gtest/gtest.h>

#include "ir/support/diag/operand.h"
#include "ir/support/source.h"
#include "rtlib/text/letters.h"

namespace rung::frontend {
namespace {

struct Meaning {
  std::string_view name;
  SourceRange declared;
  int value = 0;
};

std::string inCapitals(std::string_view name) { return text::upper(name); }

class NamesTest : public testing::Test {
protected:
  SourceRange range(uint32_t begin, uint32_t end) const {
    return {sources_.position(file_, begin), sources_.position(file_, end)};
  }
  const Diagnostic& reported() const { return diagnostics_.reported().at(0); }

  SourceManager sources_;
  FileId file_ = sources_.addBuffer("names", "pump PUMP pump\n");
  Diagnostics diagnostics_;
};

TEST_F(NamesTest, CaseMattersUnlessTheDialectSaysOtherwise) {
  NameTable<Meaning> exact;
  EXPECT_EQ(exact.declare({"pump", range(0, 4), 1}, diagnostics_), 0u);
  EXPECT_EQ(exact.declare({"PUMP", range(5, 9), 2}, diagnostics_), 1u);
  EXPECT_EQ(exact[exact.find("PUMP")].value, 2);
  EXPECT_EQ(exact.find("Pump"), kNoName);

  NameTable<Meaning, inCapitals> capitals;
  capitals.enter({"pump", {}, 1});
  EXPECT_EQ(capitals.find("Pump"), 0u);
  EXPECT_TRUE(diagnostics_.reported().empty());
}

TEST_F(NamesTest, ASecondDeclarationShowsTheFirst) {
  NameTable<Meaning> table;
  table.declare({"pump", range(0, 4), 1}, diagnostics_);
  EXPECT_EQ(table.declare({"pump", range(10, 14), 2}, diagnostics_), kNoName);
  ASSERT_EQ(diagnostics_.reported().size(), 1u);
  EXPECT_EQ(reported().id, diag::DuplicateSymbol);
  EXPECT_EQ(reported().range, range(10, 14));
  EXPECT_EQ(reported().notes.at(0).range, range(0, 4));
  EXPECT_EQ(reported().notes.at(0).text, "first declared here");
  EXPECT_EQ(table[table.find("pump")].value, 1);
}

TEST_F(NamesTest, ANameOfTheControlHasNoPlace) {
  NameTable<Meaning> table;
  table.enter({"pump", {}, 1});
  EXPECT_EQ(table.declare({"pump", range(0, 4), 2}, diagnostics_), kNoName);
  EXPECT_EQ(reported().notes.at(0).text, "it is predefined by the control");
}

TEST_F(NamesTest, TheFirstScopeThatHasTheNameCounts) {
  NameTable<Meaning> table;
  table.addScope();
  const uint32_t outer = table.enter({"pump", {}, 1}, 0);
  EXPECT_EQ(table.find("pump", {1, 0}), outer);
  const uint32_t inner = table.enter({"pump", {}, 2}, 1);
  EXPECT_EQ(table.find("pump", {1, 0}), inner);
  EXPECT_EQ(table.find("pump"), outer);
  const uint32_t hidden = table.add({"valve", {}, 3});
  EXPECT_EQ(table[hidden].value, 3);
  EXPECT_EQ(table.find("valve", {1, 0}), kNoName);
}

} // namespace
} // namespace rung::frontend
