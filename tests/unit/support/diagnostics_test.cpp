// The table of codes and the collecting of reports.
#include "ir/support/diag/ladder.h"
#include "ir/support/diag/operand.h"
#include "ir/support/diag/pmc.h"
#include "ir/support/diag/structure.h"
#include "ir/support/diag/technol.h"
#include "ir/support/diagnostics.h"

#include <cctype>
#include <set>

#include <gtest/gtest.h>

namespace rung {
namespace {

/// unbalanced-stack → UnbalancedStack
std::string nameOf(std::string_view code) {
  std::string name;
  bool upper = true;
  for (const char c : code) {
    if (c == '-') {
      upper = true;
      continue;
    }
    name += upper ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
    upper = false;
  }
  return name;
}

constexpr std::string_view kNames[] = {
// in the order of allDiags()
#define DIAG(name, code, severity, message, explanation) #name,
#include "ir/support/diag/all.def"
#undef DIAG
};

TEST(DiagTable, CodesAreUniqueKebabCaseAndMatchTheirNames) {
  std::set<std::string_view> seen;
  for (size_t i = 0; i < allDiags().size(); ++i) {
    const DiagInfo& info = allDiags()[i];
    EXPECT_TRUE(seen.insert(info.code).second) << info.code << " is there twice";
    EXPECT_EQ(info.code.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-"), std::string_view::npos)
        << info.code;
    EXPECT_EQ(nameOf(info.code), kNames[i]);
  }
}

TEST(DiagTable, EveryCodeIsFoundAndInOrder) {
  ASSERT_EQ(allDiags().size(), std::size(kNames));
  for (size_t i = 0; i < allDiags().size(); ++i) {
    const DiagInfo& info = allDiags()[i];
    if (i > 0) EXPECT_LT(allDiags()[i - 1].id, info.id);
    EXPECT_EQ(findDiag(info.code), &info);
    EXPECT_EQ(&diagInfo(info.id), &info);
  }
  EXPECT_EQ(findDiag("no-such-code"), nullptr);
}

TEST(DiagTable, EveryCodeIsExplained) {
  for (const DiagInfo& info : allDiags()) {
    EXPECT_FALSE(info.message.empty()) << info.code;
    EXPECT_GT(info.explanation.size(), 20u) << info.code;
    EXPECT_EQ(info.explanation.back(), '.') << info.code;
    EXPECT_NE(info.message.back(), '.') << info.code;
  }
}

TEST(DiagTable, MessagesFormatWithAnyNumberOfArguments) {
  for (const DiagInfo& info : allDiags()) {
    for (const size_t count : {0u, 1u, 4u, 12u}) {
      Diagnostic diagnostic;
      diagnostic.id = info.id;
      for (size_t i = 0; i < count; ++i) diagnostic.args.emplace_back(std::string("ARG"));
      const std::string message = messageOf(diagnostic);
      EXPECT_EQ(message.find("{0"), std::string::npos) << info.code;
      EXPECT_EQ(message.find("{}"), std::string::npos) << info.code << ": placeholders are numbered";
      const bool takesArgument = info.message.find("{0}") != std::string_view::npos;
      EXPECT_EQ(message.find("ARG") != std::string::npos, takesArgument && count > 0) << info.code;
    }
  }
}

/// Every code of the three dialects' inventories that a scenario may name; a sample of each family.
TEST(DiagTable, HasTheInventoriesCodesWithTheirSeverity) {
  for (const char* code : {"missing-end1", "multi-level-output", "dangling-wire", "bit-out-of-range",
                           "unbalanced-stack", "mech-loop-without-ex", "write-to-input", "tab-character"}) {
    ASSERT_NE(findDiag(code), nullptr) << code;
    EXPECT_EQ(findDiag(code)->severity, Severity::Error) << code;
  }
  for (const char* code : {"duplicate-counter", "label-zero", "symbol-in-nc-area", "backward-jump", "jlo-alias",
                           "label-unused", "mixed-output", "text-after-stop"}) {
    ASSERT_NE(findDiag(code), nullptr) << code;
    EXPECT_EQ(findDiag(code)->severity, Severity::Warning) << code;
  }
}

SourceRange rangeAt(uint32_t begin) { return {{begin}, {begin + 1}}; }

TEST(Diagnostics, CountsBySeverity) {
  Diagnostics diags;
  EXPECT_FALSE(diags.hasErrors());
  diags.report(diag::LabelUnused, rangeAt(5)) << 7;
  EXPECT_FALSE(diags.hasErrors());
  diags.report(diag::DuplicateLabel, rangeAt(9)) << "L1";
  EXPECT_EQ(diags.errorCount(), 1u);
  EXPECT_EQ(diags.warningCount(), 1u);
  EXPECT_TRUE(diags.has(diag::LabelUnused));
  EXPECT_FALSE(diags.has(diag::UndefinedLabel));
}

TEST(Diagnostics, MessageTakesTextAndNumbers) {
  Diagnostics diags;
  diags.report(diag::WrongConditionCount, rangeAt(1)) << "ADDB" << 2 << uint8_t{3};
  EXPECT_EQ(messageOf(diags.reported()[0]), "wrong number of conditions for ADDB: expected 2, found 3");
  diags.report(diag::UnclosedElement, rangeAt(2)) << ']';
  EXPECT_EQ(messageOf(diags.reported()[1]), "this element is not closed; ']' expected");
}

TEST(Diagnostics, MissingArgumentIsShownAsSuch) {
  Diagnostics diags;
  diags.report(diag::WrongConditionCount) << "ADDB";
  EXPECT_EQ(messageOf(diags.reported()[0]), "wrong number of conditions for ADDB: expected ?, found ?");
}

TEST(Diagnostics, LongArgumentsAreCutBetweenCharacters) {
  Diagnostics diags;
  std::string word(199, 'x');
  word += "\u4E2D\u4E2D";
  diags.report(diag::UnknownStatement) << word;
  EXPECT_EQ(messageOf(diags.reported()[0]), "unknown statement '" + std::string(199, 'x') + "...'");
}

TEST(Diagnostics, DropsWhatWasSaidAlready) {
  Diagnostics diags;
  for (int i = 0; i < 3; ++i) diags.report(diag::UndefinedLabel, rangeAt(5)) << "L1";
  EXPECT_EQ(diags.errorCount(), 1u);
  diags.report(diag::UndefinedLabel, rangeAt(5)) << "L2";
  diags.report(diag::UndefinedLabel, rangeAt(6)) << "L1";
  diags.report(diag::DuplicateLabel, rangeAt(5)) << "L1";
  EXPECT_EQ(diags.errorCount(), 4u);
}

TEST(Diagnostics, SortedIsStable) {
  Diagnostics diags;
  diags.report(diag::DuplicateLabel, rangeAt(9));
  diags.report(diag::UndefinedLabel, rangeAt(3));
  diags.report(diag::BadOperand, rangeAt(9));
  diags.report(diag::MissingStop);
  std::vector<Diag> order;
  for (const Diagnostic* d : diags.sorted()) order.push_back(d->id);
  EXPECT_EQ(order, (std::vector{diag::MissingStop, diag::UndefinedLabel, diag::DuplicateLabel, diag::BadOperand}));
}

TEST(Diagnostics, StrictModeRaisesTheListedWarnings) {
  Diagnostics diags;
  diags.raiseToError({diag::DuplicateCounter});
  diags.report(diag::DuplicateCounter, rangeAt(1));
  diags.report(diag::DuplicateTimer, rangeAt(2));
  EXPECT_EQ(diags.errorCount(), 1u);
  EXPECT_EQ(diags.warningCount(), 1u);
}

TEST(Diagnostics, ADialectMayLowerASeverityAndStrictModeStillWins) {
  Diagnostics diags;
  diags.report(diag::WriteToInput, rangeAt(1)).severity(Severity::Warning) << "N_ON" << "an input";
  EXPECT_EQ(diags.warningCount(), 1u);
  diags.raiseToError({diag::WriteToInput});
  diags.report(diag::WriteToInput, rangeAt(2)).severity(Severity::Warning) << "N_ON" << "an input";
  EXPECT_EQ(diags.errorCount(), 1u);
}

TEST(Diagnostics, KeepsOnlyAsManyAsTheLimitButCountsAll) {
  Diagnostics diags;
  diags.setErrorLimit(2);
  for (uint32_t i = 1; i <= 5; ++i) diags.report(diag::BadOperand, rangeAt(i));
  diags.report(diag::LabelUnused, rangeAt(9));
  EXPECT_EQ(diags.errorCount(), 5u);
  EXPECT_EQ(diags.droppedCount(), 3u);
  EXPECT_EQ(diags.reported().size(), 3u); // the warning has a limit of its own
}

} // namespace
} // namespace rung
