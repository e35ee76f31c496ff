// Reader of part programs (see part_program.h).
#include "sim/gsk/part_program.h"

#include <algorithm>
#include <cmath>

namespace rung::sim::gsk {
namespace {

// Tenths, since G54.1 is one.
constexpr int kCodes[] = {0,   10,  40,  170, 180, 190, 200, 210, 280, 300, 400, 410, 420, 430, 490,
                          530, 540, 541, 550, 560, 570, 580, 590, 800, 810, 900, 910, 920, 940, 950};

class Reader final : public ProgramReader<Block> {
public:
  Reader(std::string_view text, std::string_view axes, bool manyM, PartProgram& program)
      : ProgramReader(text, UINT32_MAX), axes_(axes), manyM_(manyM), program_(program) {}

private:
  std::string readItem(Block& block) override {
    if (block.words.empty() && text_.take("/")) {
      block.skipped = true;
      return {};
    }
    const char c = text_.written();
    Word word{.letter = text_.here()};
    const bool isWord = text_.atLetter();
    text_.advance();
    if (c == '#') {
      const auto variable = text_.variable();
      if (!variable || !text_.take("=")) return "expected #NUMBER=VALUE";
      word.variable = *variable;
    } else if (!isWord) {
      return std::string("unexpected character '") + c + "'";
    }
    const auto value = text_.value();
    if (!value) return std::string("a number is missing after '") + c + "'";
    word.value = *value;
    return take(word, block);
  }

  std::string take(const Word& word, Block& block) {
    const double code = word.value.number;
    const auto noSuchNumber = [&] { return word.letter + std::string(" takes no such number"); };
    const bool whole = word.value.variable != 0 || (code >= 0 && code <= 4294967295.0);
    if (word.letter == 'O' || word.letter == 'N') {
      if (!whole) return noSuchNumber();
      (word.letter == 'O' ? program_.number : block.sequence) = static_cast<uint32_t>(code);
      return {};
    }
    const bool isSubprogram = word.letter == 'M' && (code == 98 || code == 99);
    if (isSubprogram || (word.letter == 'G' && !isCode(kCodes, code)))
      return word.letter + number(code) + " is not simulated";
    const bool axis = axes_.find(word.letter) != std::string_view::npos;
    if (!axis && std::string_view("GMSTBFHDPR#").find(word.letter) == std::string_view::npos)
      return std::string("unknown word ") + word.letter + "; the axes are " + std::string(axes_);
    if (!axis && !whole && std::string_view("MSTBHDP").find(word.letter) != std::string_view::npos)
      return noSuchNumber();
    block.words.push_back(word);
    return {};
  }

  std::string checkBlock(const Block& block) const override {
    const auto codes = std::ranges::count(block.words, 'M', &Word::letter);
    if (codes <= (manyM_ ? 3 : 1)) return {};
    return manyM_ ? "more than three M codes" : "more than one M code; parameter 1803.6 allows three";
  }

  static std::string number(double value) {
    const long tenths = std::lround(value * 10);
    return std::to_string(tenths / 10) + (tenths % 10 == 0 ? "" : "." + std::to_string(tenths % 10));
  }

  std::string_view axes_;
  bool manyM_;
  PartProgram& program_;
};

} // namespace

std::string readPartProgram(std::string_view text, std::string_view axes, bool manyM, PartProgram& program) {
  program = {};
  return Reader(text, axes, manyM, program).readBlocks(program.blocks);
}

} // namespace rung::sim::gsk
