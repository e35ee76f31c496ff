// Random programs: every element and operand is drawn once, nothing lies on anything else, and the wires join what the
// source joins and nothing else. Ladder text of NCT with every shape that a grid can have (bridges too), command lists
// of GSK with all their functions; at rails so near that most rungs are cut, and at the usual ones.
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/unit/gsk/program_generator.h"
#include "tests/unit/view/drawn.h"

namespace rung::view::test {
namespace {

constexpr uint64_t kGrids = 400;
constexpr uint64_t kLists = 60;

// Rows of elements between columns; at every column neighbouring rows are joined or not.
class Grid {
public:
  explicit Grid(uint64_t seed) : random_(seed) {}
  std::string text();

private:
  uint32_t below(uint32_t n) { return static_cast<uint32_t>(random_() % n); }
  std::string bit() { return fmt::format("{}.{:02}", 7000 + next_++, below(32)); }
  std::string element();
  std::string padded(std::string text) {
    text.resize(34, '-');
    return text;
  }
  std::string end(uint32_t row, uint32_t rows);

  std::mt19937_64 random_;
  uint32_t next_ = 0;
  uint32_t kind_ = 0;
};

std::string Grid::element() {
  static constexpr std::string_view kForms[] = {"[{}]", "[/{}]", "[@{}]", "[/%{}]"};
  if (below(6) == 0) return fmt::format("{{CEQ {} #{}}}", 7000 + next_++, below(1000));
  return fmt::format(fmt::runtime(kForms[below(4)]), bit());
}

// What closes the grid: coils and boxes below each other, or a box with several pins.
std::string Grid::end(uint32_t row, uint32_t rows) {
  const uint32_t word = 7000 + next_++;
  if (rows >= 3 && kind_ == 1) {
    if (row == 0) return fmt::format("{{CNT {} #0 #10 #10}}--({})", word, bit());
    if (row < 3) return fmt::format("{{{:<19}}}", row == 1 ? "U/D" : "R");
  }
  switch (below(4)) {
  case 0: return fmt::format("(S {})", bit());
  case 1: return fmt::format("{{MOV {} #{}}}", word, below(100));
  case 2: return fmt::format("{{TOND {} #500 #0}}--(/{})", word, bit());
  default: return fmt::format("({})", bit());
  }
}

std::string Grid::text() {
  std::string out = "dialect nct\nmodule MAIN\n";
  for (uint32_t rung = 0; rung < 6; ++rung) {
    const uint32_t rows = 1 + below(5);
    const uint32_t columns = 1 + below(9);
    kind_ = below(2);
    std::vector<std::string> lines(rows, "|--");
    for (uint32_t column = 0; column < columns; ++column) {
      for (uint32_t row = 0; row < rows; ++row) lines[row] += padded(element());
      // The last column joins nothing where each row has an end of its own.
      for (uint32_t row = 0; row < rows; ++row) lines[row] += below(2) == 0 ? "--+--" : "-----";
    }
    for (uint32_t row = 0; row < rows; ++row) lines[row] += end(row, rows);
    out += "\nrung\n";
    for (const std::string& line : lines) out += line + "\n";
  }
  return out;
}

// With the longest badge at every element.
Sheet badged(Sheet sheet) {
  for (Cell& cell : sheet.cells) {
    if (cell.place.line == 0) continue;
    cell.seen = Seen::Part;
    cell.badge = "never decided";
  }
  return sheet;
}

void check(const Drawn& drawn, const std::string& what) {
  const std::vector<Figure>& figures = drawn.program.figures;
  ASSERT_EQ(figures.size(), drawn.ladders[0].rungs.size()) << what;
  for (size_t i = 0; i < figures.size(); ++i) {
    const Sheet run = badged(figures[i].sheet);
    for (auto [sheet, rail] : {std::pair(&figures[i].sheet, 320), std::pair(&figures[i].sheet, 800),
                               std::pair(&figures[i].sheet, 4000), std::pair(&run, 320), std::pair(&run, 800)}) {
      const Picture picture = layOut(*sheet, rail);
      const std::string wrong = wrongTexts(drawn.rung(i), picture) + overlaps(picture) +
                                wrongWires(drawn.rung(i), picture) + outOfBounds(picture);
      ASSERT_EQ(wrong, "") << what << ", rung " << i + 1 << ", rail " << rail << "\n"
                           << drawn.sources.text(drawn.rung(i).range);
    }
  }
}

TEST(ViewProperty, Grids) {
  size_t cut = 0;
  size_t joints = 0;
  for (uint64_t seed = 1; seed <= kGrids; ++seed) {
    const auto drawn = draw("grid.lad", Grid(seed).text());
    ASSERT_NE(drawn, nullptr);
    check(*drawn, fmt::format("seed {}", seed));
    if (HasFatalFailure()) return;
    for (const Figure& figure : drawn->program.figures) {
      const Picture picture = layOut(figure.sheet, 800);
      cut += picture.jumps.empty() ? 0 : 1;
      joints += picture.dots.empty() ? 0 : 1;
    }
  }
  EXPECT_GT(cut, kGrids);
  EXPECT_GT(joints, kGrids);
}

TEST(ViewProperty, Lists) {
  for (uint64_t seed = 1; seed <= kLists; ++seed) {
    const auto drawn = draw("list.pmc", frontend::gsk::test::ProgramGenerator(seed).list());
    ASSERT_NE(drawn, nullptr);
    check(*drawn, fmt::format("seed {}", seed));
    if (HasFatalFailure()) return;
  }
}

} // namespace
} // namespace rung::view::test
