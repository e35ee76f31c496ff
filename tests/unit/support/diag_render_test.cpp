// Diagnostics as text and as JSON.
#include "ir/support/diag/ladder.h"
#include "ir/support/diag/operand.h"
#include "ir/support/diag/source.h"
#include "ir/support/diag/structure.h"
#include "ir/support/diag/technol.h"
#include "ir/support/diag_render.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace rung {
namespace {

/// One source and its diagnostics.
struct Fixture {
  SourceManager sources;
  Diagnostics diags;
  FileId file;

  explicit Fixture(std::string text) : file(sources.addBuffer("main.lad", std::move(text))) {}
  SourceRange range(size_t begin, size_t end) const { return sources.range(file, begin, end); }
  std::string text(RenderOptions options = {}) const { return renderText(diags, sources, options); }
};

TEST(RenderText, ShowsTheLineAndUnderlinesThePlace) {
  Fixture f("dialect nct\n|--[A--(X)\n");
  f.diags.report(diag::UnclosedElement, f.range(15, 18)) << ']';
  EXPECT_EQ(f.text(), R"(main.lad:2:4: error: this element is not closed; ']' expected [unclosed-element]
    2 | |--[A--(X)
      |    ^~~
)");
}

TEST(RenderText, ShowsLabelsNotesAndFixes) {
  Fixture f("symbol A 0056\nsymbol A 57\n");
  f.diags.report(diag::DuplicateSymbol, f.range(21, 22))
          .label(f.range(23, 25), "this value")
          .note(f.range(7, 8), "first declared here")
          .note("names are common to all modules")
          .fix(f.range(21, 22), "B")
          .fix(f.range(7, 8), "B") // the same at a further place
      << "A";
  f.diags.report(diag::DuplicateSymbol, f.range(22, 22)).fix(f.range(22, 22), "2") << "A";
  f.diags.report(diag::DuplicateSymbol, f.range(23, 25)).fix(f.range(23, 25), "") << "57";
  EXPECT_EQ(f.text(), R"(main.lad:2:8: error: 'A' is already declared [duplicate-symbol]
    2 | symbol A 57
      |        ^
    2 | symbol A 57
      |          -- this value
main.lad:1:8: note: first declared here
    1 | symbol A 0056
      |        ^
note: names are common to all modules
      = help: write 'B' instead of 'A'
main.lad:2:9: error: 'A' is already declared [duplicate-symbol]
    2 | symbol A 57
      |         ^
      = help: insert '2'
main.lad:2:10: error: '57' is already declared [duplicate-symbol]
    2 | symbol A 57
      |          ^~
      = help: remove '57'
)");
}

TEST(RenderText, WithoutPlace) {
  Fixture f("");
  f.diags.report(diag::FileNotFound) << "x.lad" << "No such file or directory";
  EXPECT_EQ(f.text(), "error: cannot read 'x.lad': No such file or directory [file-not-found]\n");
}

TEST(RenderText, Warning) {
  Fixture f("L9");
  f.diags.report(diag::LabelUnused, f.range(0, 2)) << "L9";
  EXPECT_EQ(f.text(), "main.lad:1:1: warning: no jump leads to label L9 [label-unused]\n    1 | L9\n      | ^~\n");
}

TEST(RenderText, CaretBehindTheLastCharacterAndInAnEmptyFile) {
  Fixture f("ab\n");
  f.diags.report(diag::MissingStop, f.range(2, 2));
  EXPECT_NE(f.text().find("    1 | ab\n      |   ^\n"), std::string::npos) << f.text();
  Fixture empty("");
  empty.diags.report(diag::MissingStop, empty.range(0, 0));
  EXPECT_NE(empty.text().find("main.lad:1:1: error"), std::string::npos) << empty.text();
}

TEST(RenderText, RangeOverSeveralLinesIsUnderlinedOnItsFirst) {
  Fixture f("abcd\nefgh\n");
  f.diags.report(diag::MissingStop, f.range(2, 8));
  EXPECT_NE(f.text().find("    1 | abcd\n      |   ^~\n"), std::string::npos) << f.text();
}

TEST(RenderText, WideCharactersTakeTwoCells) {
  Fixture f("\u4E2D\u6587 x\n");
  f.diags.report(diag::MissingStop, f.range(7, 8));
  EXPECT_NE(f.text().find("main.lad:1:4:"), std::string::npos) << f.text();
  EXPECT_NE(f.text().find("\n      |      ^\n"), std::string::npos) << f.text();
}

TEST(RenderText, LongLinesAreClippedAroundThePlace) {
  const std::string padding(5'000'000, '-');
  Fixture f(padding + "[A" + padding);
  f.diags.report(diag::UnclosedElement, f.range(padding.size(), padding.size() + 2)) << ']';
  const std::string text = f.text({.width = 20});
  EXPECT_EQ(text, "main.lad:1:5000001: error: this element is not closed; ']' expected [unclosed-element]\n"
                  "    1 | ...----------[A--------...\n"
                  "      |              ^~\n");
}

TEST(RenderText, TerminalDoesNotObeyTheSource) {
  Fixture f("\x1b[31m\ttext\xFF\n");
  f.diags.report(diag::UnknownStatement, f.range(0, 5)) << "\x1b[31m";
  const std::string text = f.text();
  EXPECT_EQ(text.find('\x1b'), std::string::npos);
  EXPECT_NE(text.find("| \uFFFD[31m text\uFFFD\n"), std::string::npos) << text;
}

TEST(RenderText, ColorOnlyOnRequest) {
  Fixture f("x");
  f.diags.report(diag::MissingStop, f.range(0, 1));
  EXPECT_EQ(f.text().find('\x1b'), std::string::npos);
  const std::string colored = f.text({.color = true});
  EXPECT_NE(colored.find("\x1b[1;31merror: \x1b[0m"), std::string::npos);
}

TEST(RenderText, SortedByPositionAndSaysWhatIsLeftOut) {
  Fixture f("abc");
  f.diags.setErrorLimit(2);
  f.diags.report(diag::BadOperand, f.range(2, 3)) << "c" << "a number";
  f.diags.report(diag::BadOperand, f.range(0, 1)) << "a" << "a number";
  f.diags.report(diag::BadOperand, f.range(1, 2)) << "b" << "a number";
  const std::string text = f.text();
  EXPECT_LT(text.find("'a' is not a number"), text.find("'c' is not a number"));
  EXPECT_NE(text.find("(1 more diagnostics are not shown)"), std::string::npos);
}

TEST(RenderJson, HasPlaceMessageNotesAndFixes) {
  Fixture f("symbol A 0056\nsymbol A 57\n");
  f.diags.report(diag::DuplicateSymbol, f.range(21, 22))
          .note(f.range(7, 8), "first declared here")
          .fix(f.range(21, 22), "B")
      << "A";
  const auto list = nlohmann::json::parse(renderJson(f.diags, f.sources));
  ASSERT_EQ(list.size(), 1u);
  const nlohmann::json expected = nlohmann::json::parse(R"({
    "code": "duplicate-symbol", "severity": "error", "message": "'A' is already declared", "file": "main.lad",
    "line": 2, "column": 8, "endLine": 2, "endColumn": 9, "labels": [],
    "notes": [{"message": "first declared here", "file": "main.lad", "line": 1, "column": 8, "endLine": 1, "endColumn": 9}],
    "fixes": [{"replacement": "B", "file": "main.lad", "line": 2, "column": 8, "endLine": 2, "endColumn": 9}]})");
  EXPECT_EQ(list[0], expected);
}

TEST(RenderJson, EmptyAndWithoutPlace) {
  Fixture f("");
  EXPECT_EQ(renderJson(f.diags, f.sources), "[]\n");
  f.diags.report(diag::MissingStop);
  const auto list = nlohmann::json::parse(renderJson(f.diags, f.sources));
  EXPECT_EQ(list[0]["file"], "");
  EXPECT_EQ(list[0]["line"], 0);
}

TEST(RenderJson, BytesThatAreNoTextDoNotBreakIt) {
  Fixture f("\xFF");
  f.diags.report(diag::UnknownStatement, f.range(0, 1)) << "\xFF";
  const auto list = nlohmann::json::parse(renderJson(f.diags, f.sources));
  EXPECT_EQ(list[0]["message"], "unknown statement '\uFFFD'");
}

/// Every code can be rendered in both forms, whatever its arguments.
TEST(Render, AllCodes) {
  Fixture f("text");
  for (const DiagInfo& info : allDiags()) f.diags.report(info.id, f.range(0, 4)) << "first" << 2;
  const std::string text = f.text();
  for (const DiagInfo& info : allDiags())
    EXPECT_NE(text.find(" [" + std::string(info.code) + "]\n"), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(renderJson(f.diags, f.sources)).size(), allDiags().size());
}

} // namespace
} // namespace rung
