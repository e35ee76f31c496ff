// The table of names that all front ends use.
#include "frontend/sema/symbol_table.h"

#include <string>

#include <gtest/gtest.h>

#include "ir/support/diag/operand.h"
#include "ir/support/diag/technol.h"
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

// As a dialect derives one.
class Names : public SymbolTable<Meaning> {
public:
  explicit Names(NameKey keyOf = asWritten) : SymbolTable(keyOf) {}
  using SymbolTable::add;
  using SymbolTable::addScope;
  using SymbolTable::declare;
  using SymbolTable::enter;
  using SymbolTable::refuse;
};

class SymbolTableTest : public testing::Test {
protected:
  SourceRange range(uint32_t begin, uint32_t end) const {
    return {sources_.position(file_, begin), sources_.position(file_, end)};
  }
  const Diagnostic& reported() const { return diagnostics_.reported().at(0); }

  SourceManager sources_;
  FileId file_ = sources_.addBuffer("names", "pump PUMP pump\n");
  Diagnostics diagnostics_;
};

TEST_F(SymbolTableTest, CaseMattersUnlessTheDialectSaysOtherwise) {
  Names exact;
  EXPECT_EQ(exact.declare({"pump", range(0, 4), 1}, diagnostics_), 0u);
  EXPECT_EQ(exact.declare({"PUMP", range(5, 9), 2}, diagnostics_), 1u);
  EXPECT_EQ(exact[exact.find("PUMP")].value, 2);
  EXPECT_EQ(exact.find("Pump"), kNoName);

  Names capitals(inCapitals);
  capitals.enter({"pump", {}, 1});
  EXPECT_EQ(capitals.find("Pump"), 0u);
  capitals.refuse("-k1");
  EXPECT_TRUE(capitals.wasRefused("-K1"));
  EXPECT_FALSE(capitals.wasRefused("pump"));
  EXPECT_TRUE(diagnostics_.reported().empty());
}

TEST_F(SymbolTableTest, ASecondDeclarationShowsTheFirst) {
  Names table;
  table.declare({"pump", range(0, 4), 1}, diagnostics_);
  EXPECT_EQ(table.declare({"pump", range(10, 14), 2}, diagnostics_), kNoName);
  ASSERT_EQ(diagnostics_.reported().size(), 1u);
  EXPECT_EQ(reported().id, diag::DuplicateSymbol);
  EXPECT_EQ(reported().range, range(10, 14));
  EXPECT_EQ(reported().notes.at(0).range, range(0, 4));
  EXPECT_EQ(reported().notes.at(0).text, "first declared here");
  EXPECT_EQ(table[table.find("pump")].value, 1);
}

TEST_F(SymbolTableTest, ANameOfTheControlHasNoPlace) {
  Names table;
  table.enter({"pump", {}, 1});
  EXPECT_EQ(table.declare({"pump", range(0, 4), 2}, diagnostics_), kNoName);
  EXPECT_EQ(reported().notes.at(0).text, "it is predefined by the control");
}

TEST_F(SymbolTableTest, TheFirstScopeThatHasTheNameCounts) {
  Names table;
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

TEST_F(SymbolTableTest, TheAnalysisGetsSymbolsAndUses) {
  Names table;
  const uint32_t pump = table.declare({"pump", range(0, 4), 1}, diagnostics_);
  const uint32_t big = table.declare({"PUMP", range(5, 9), 2}, diagnostics_);
  table.use(range(10, 14), pump);
  Analysis analysis;
  table.addTo(analysis,
              [](const Meaning& meaning) { return Definition{.name = meaning.name, .range = meaning.declared}; });
  analysis.settle();
  ASSERT_EQ(analysis.definitions().size(), 2u);
  EXPECT_EQ(analysis.definitions()[big].name, "PUMP");
  EXPECT_EQ(analysis.nameAt(range(10, 14)), &analysis.definitions()[pump]);
  EXPECT_EQ(analysis.declaredAt(range(5, 9).begin), &analysis.definitions()[big]);
}

SourceRange at(uint32_t begin) { return {{begin}, {begin + 1}}; }

// The place of each report, and its notes.
std::vector<std::string> reported(Names& names) {
  Diagnostics diagnostics;
  names.reportUndeclared(diagnostics, diag::UndefinedSymbol,
                         [](DiagBuilder& report, std::span<const UndeclaredUse> uses) {
                           for (const SourceRange place : placesOf(uses)) report.fix(place, "B");
                         });
  std::vector<std::string> found;
  for (const Diagnostic& d : diagnostics.reported()) {
    found.push_back(std::get<std::string>(d.args.at(0)) + " at " + std::to_string(d.range.begin.value));
    for (const DiagNote& note : d.notes)
      found.back() += ", " + note.text + " " + std::to_string(note.range.begin.value);
    for (const DiagFix& fix : d.fixes) found.back() += ", fixed at " + std::to_string(fix.range.begin.value);
  }
  return found;
}

TEST(SymbolTable, UndeclaredUsesComeInAnyOrderAndSeveralTimes) {
  Names names;
  for (const uint32_t place : {30u, 10u, 20u, 10u}) names.noteUndeclared({"A", at(place)});
  for (const uint32_t place : {5u, 7u}) names.noteUndeclared({"B", at(place)});
  names.noteUndeclared({"C", at(1)});
  names.noteUndeclared({"C", at(1)});
  EXPECT_EQ(reported(names),
            (std::vector<std::string>{
                "A at 10, and 2 further uses; the next is here 20, fixed at 10, fixed at 20, fixed at 30",
                "B at 5, it is used once more, here 7, fixed at 5, fixed at 7", "C at 1, fixed at 1"}));
  EXPECT_TRUE(reported(names).empty()) << "each is reported once";
}

} // namespace
} // namespace rung::frontend
