// What stands where in rungs that a person can follow; what operands are called; what uses are found.
#include <gtest/gtest.h>

#include "tests/unit/view/drawn.h"
#include "tools/view/layout.h"
#include "tools/view/svg.h"

namespace rung::view::test {
namespace {

const Text* findText(const Picture& picture, std::string_view text) {
  for (const Text& one : picture.texts)
    if (one.text == text) return &one;
  return nullptr;
}

const NameRow* findRow(const Program& program, std::string_view name) {
  for (const NameTable& table : program.tables)
    for (const NameRow& row : table.rows)
      if (row.name == name) return &row;
  return nullptr;
}

std::string usesOf(const Program& program, std::string_view name) {
  const NameRow* row = findRow(program, name);
  if (row == nullptr) return "no row";
  std::string text;
  for (const Use& use : row->uses) text += (use.writes ? " w" : " r") + std::to_string(use.rung);
  return text;
}

TEST(ViewLayout, CoilsStandAtTheRightRailBelowEachOther) {
  const auto drawn = drawRung("|--[7000.00]--+--[7000.01]--(7001.00)\n"
                              "              +--(S 7001.01)\n");
  const Picture picture = layOut(drawn->program.figures[0].sheet, 560);
  EXPECT_EQ(picture.rail, 560);
  ASSERT_EQ(picture.symbols.size(), 4u);
  EXPECT_EQ(picture.symbols[2].left.x, picture.symbols[3].left.x);
  EXPECT_LT(picture.symbols[2].left.y, picture.symbols[3].left.y);
  EXPECT_EQ(picture.symbols[0].left.y, picture.symbols[1].left.y);
  ASSERT_EQ(picture.dots.size(), 1u); // the branch; its lower end is a corner
  EXPECT_EQ(picture.dots[0].y, picture.symbols[0].left.y);
  size_t atRail = 0;
  for (const Line& wire : picture.wires) atRail += wire.to.x == picture.rail ? 1 : 0;
  EXPECT_EQ(atRail, 2u);
}

TEST(ViewLayout, AJointIsOneVerticalLine) {
  const auto drawn = drawRung("|--[7000.00]--------------+--(7001.00)\n"
                              "|                         |\n"
                              "|--[7000.01]--[7000.02]---+\n");
  const Picture picture = layOut(drawn->program.figures[0].sheet, 560);
  size_t vertical = 0;
  for (const Line& wire : picture.wires) vertical += wire.from.x == wire.to.x && wire.from.y < wire.to.y ? 1 : 0;
  EXPECT_EQ(vertical, 1u);
  EXPECT_EQ(picture.dots.size(), 1u);
}

TEST(ViewLayout, MarksTellTheKindsOfContactsAndCoils) {
  const auto drawn = drawRung("|--[7000.00]--[/7000.01]--[@7000.02]--[%7000.03]--[/@7000.04]--+--(/7001.00)\n"
                              "                                                               +--(R 7001.01)\n");
  const Picture picture = layOut(drawn->program.figures[0].sheet, 800);
  std::string marks;
  for (const Text& text : picture.texts)
    if (text.style == Style::Mark) marks += text.text + " ";
  EXPECT_EQ(marks, "P N /P R ");
  ASSERT_EQ(picture.symbols.size(), 7u);
  EXPECT_FALSE(picture.symbols[0].slash);
  EXPECT_TRUE(picture.symbols[1].slash);
  EXPECT_TRUE(picture.symbols[5].slash);
  EXPECT_EQ(picture.symbols[5].glyph, Glyph::Coil);
}

TEST(ViewLayout, PinsStandAtTheirWires) {
  const auto drawn = drawRung("|--[7000.00]--{CNT 7002 #0 #10 #10}--(7001.00)\n"
                              "|--[7000.01]--{U/D                }\n"
                              "|--[7000.02]--{R                  }\n");
  const Picture picture = layOut(drawn->program.figures[0].sheet, 560);
  ASSERT_EQ(picture.frames.size(), 1u);
  // Contacts and coils as they stand in the source: the coil is the second one.
  for (auto [pin, symbol] : {std::pair("U/D", 2u), std::pair("R", 3u)}) {
    ASSERT_NE(findText(picture, pin), nullptr);
    EXPECT_EQ(findText(picture, pin)->at.y, picture.symbols[symbol].left.y + 4);
  }
  EXPECT_NE(findText(picture, "Ending Value"), nullptr); // operands say what they are
}

TEST(ViewLayout, AWideRungIsCutAndGoesOn) {
  std::string drawing = "|--";
  for (int i = 0; i < 30; ++i) drawing += "[70" + std::to_string(10 + i) + ".00]--";
  const auto drawn = drawRung(drawing + "(7001.00)\n");
  const Picture picture = layOut(drawn->program.figures[0].sheet, 800);
  EXPECT_EQ(picture.rail, 800);
  ASSERT_EQ(picture.jumps.size(), 4u);
  EXPECT_NE(findText(picture, "\u21921"), nullptr);
  EXPECT_NE(findText(picture, "1\u2192"), nullptr);
  EXPECT_LT(picture.jumps[0].from.y, picture.jumps[0].to.y);
  EXPECT_EQ(wrongWires(drawn->rung(0), picture), "");
}

TEST(ViewLayout, DepthAndWidthAreLinear) {
  std::string drawing;
  for (int i = 0; i < 20000; ++i) drawing += i == 0 ? "|--[7000.00]--+--(7001.00)\n" : "|--[7000.00]--+\n";
  const auto deep = drawRung(drawing);
  EXPECT_EQ(layOut(deep->program.figures[0].sheet, 560).symbols.size(), 20001u);
  drawing = "|";
  for (int i = 0; i < 200000; ++i) drawing += "--[7000.00]";
  const auto wide = drawRung(drawing + "--(7001.00)\n");
  const Picture picture = layOut(wide->program.figures[0].sheet, 560);
  EXPECT_EQ(picture.rail, 560);
  EXPECT_GT(picture.jumps.size(), 30000u);
}

TEST(ViewLayout, AHighRungIsCutBetweenRows) {
  std::string drawing = "|--[7000.00]--+--(7001.00)\n";
  for (int i = 0; i < 30; ++i) drawing += "|--[7000.01]--+\n";
  drawing += "|--[7000.02]--+--{CNT 7002 #0 #10 #10}--(7001.01)\n"
             "|--[7000.03]-----{U/D                }\n"
             "|--[7000.04]-----{R                  }\n";
  const auto drawn = drawRung(drawing);
  const Picture picture = layOut(drawn->program.figures[0].sheet, 800);
  const std::vector<Picture> pieces = piecesOf(picture, 300);
  ASSERT_GT(pieces.size(), 5u);
  Picture whole = picture; // put together again
  whole.wires.clear();
  size_t texts = 0;
  int top = 0;
  for (const Picture& piece : pieces) {
    EXPECT_EQ(piece.top, top);
    EXPECT_LE(piece.height, 300);
    top += piece.height;
    texts += piece.texts.size();
    EXPECT_EQ(overlaps(piece), "");
    for (const Text& text : piece.texts) EXPECT_TRUE(text.at.y > piece.top && text.at.y < top) << text.text;
    for (const Frame& frame : piece.frames) EXPECT_LT(frame.corner.y + frame.height, top);
    whole.wires.insert(whole.wires.end(), piece.wires.begin(), piece.wires.end());
  }
  EXPECT_EQ(top, picture.height);
  EXPECT_EQ(texts, picture.texts.size());
  EXPECT_EQ(wrongWires(drawn->rung(0), whole), "");
  EXPECT_EQ(piecesOf(picture, picture.height).size(), 1u);
}

TEST(ViewNames, AddressesAndCommentsOfSymbols) {
  const auto drawn = draw("t.lad", "dialect nct\nmodule MAIN\n"
                                   "symbol START 7000.05 ; green\nsymbol WORDS 7100\nsymbol NEXT START\nconst FIVE #5\n"
                                   "rung\n|--[START]--[7000.05]--[WORDS.07]--[WORDS,FIVE]--[WORDS:WORDS]--(NEXT)\n");
  const Sheet& sheet = drawn->program.figures[0].sheet;
  std::string found;
  for (const Cell& cell : sheet.cells)
    if (!cell.operand.name.empty()) found += cell.operand.name + "=" + cell.operand.address + " ";
  EXPECT_EQ(found, "START=7000.05 7000.05=START WORDS.07=7100.07 WORDS,FIVE=7105 WORDS:WORDS=7100:WORDS NEXT=7000.05 ");
  EXPECT_EQ(sheet.cells[1].operand.note, "green");
  EXPECT_EQ(sheet.cells[2].operand.note, "green"); // the address of a symbol
}

TEST(ViewNames, PlacesOfTheNcHaveTheirNamesWhateverTheSpelling) {
  const auto drawn =
      draw("t.lad", "dialect nct\nmodule MAIN\n"
                    "rung\n|--[0030.12]--[INP000.12]--[/0030.12]--[7000.01]--{MOV 7000 0732}--(0732.03)\n");
  std::string found;
  for (const Cell& cell : drawn->program.figures[0].sheet.cells)
    if (!cell.operand.name.empty()) found += cell.operand.name + "=" + cell.operand.address + " ";
  EXPECT_EQ(found, "0030.12=INP000.12 INP000.12= 0030.12=INP000.12 7000.01= 0732.03=OUT000.03 ");
}

TEST(ViewNames, UsesAreFoundWhateverTheSpelling) {
  const auto drawn = draw("t.lad", "dialect nct\nmodule MAIN\nsymbol A 7000.05\nsymbol W 7100\nsymbol LONELY 7200\n"
                                   "rung\n|--[A]--[/A]--{MOV W #5}\n\nrung\n|--[7000.05]--{ADD 7100 W #1}\n\n"
                                   "rung\n|--[N_ON]--(A)\n");
  EXPECT_EQ(usesOf(drawn->program, "A"), " r1 r2 w3");
  EXPECT_EQ(usesOf(drawn->program, "W"), " w1 r2 w2");
  EXPECT_EQ(usesOf(drawn->program, "LONELY"), "");
  EXPECT_EQ(usesOf(drawn->program, "N_ON"), " r3");
  EXPECT_EQ(usesOf(drawn->program, "7000.05"), "no row"); // it is A's
  const std::vector<CrossReference>& uses = drawn->program.figures[2].sheet.rows[0].uses;
  ASSERT_EQ(uses.size(), 1u);
  EXPECT_EQ(uses[0].lead, "read in");
  EXPECT_EQ(uses[0].rungs, (std::vector<uint32_t>{1, 2}));
}

TEST(ViewNames, ListsHaveTheirOwnLines) {
  const auto drawn = draw("t.pmc", "dialect gsk\nsymbol LAMP Y0.1 ; shines\nFUNC END1\n\n; the lamp\nLD X0.0\n"
                                   "; above the OR\nOR X0.1\nOUT LAMP\nFUNC END2\n");
  ASSERT_EQ(drawn->program.figures.size(), 1u);
  const Figure& figure = drawn->program.figures[0];
  EXPECT_EQ(textOf(drawn->program, figure.place), "t.pmc:6");
  EXPECT_EQ(figure.title, "the lamp");
  EXPECT_EQ(figure.comments, std::vector<std::string>{"above the OR"});
  std::string lamp;
  for (const Cell& cell : figure.sheet.cells)
    if (cell.kind == Cell::Kind::Coil) lamp = cell.operand.address;
  EXPECT_EQ(lamp, "Y0.1");
}

TEST(ViewSvg, TextsAreEscaped) {
  const auto drawn =
      draw("t.lad", "dialect nct\nmodule MAIN\nsymbol AB 7000.05 ; <b>\"&'\nrung \"<script>\"\n|--[AB]--(AB)\n");
  const std::string svg = renderSvg(drawn->program);
  EXPECT_NE(svg.find("&lt;b&gt;&quot;&amp;'"), std::string::npos);
  EXPECT_EQ(svg.find("<script>"), std::string::npos);
}

TEST(ViewText, LongWordsStayWhole) {
  EXPECT_EQ(wrap("a very_long_word_that_does_not_fit b", Style::Note, 40),
            (std::vector<std::string>{"a", "very_long_word_that_does_not_fit", "b"}));
  EXPECT_TRUE(wrap("  ", Style::Note, 40).empty());
  EXPECT_GE(widthOf("主轴", Style::Note), 22); // as wide as the font is high, each
}

} // namespace
} // namespace rung::view::test
