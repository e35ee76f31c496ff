// Reader of part programs (see channel_program.h).
#include "sim/nct/channel_program.h"

#include <algorithm>

namespace rung::sim::nct {
namespace {

// Tenths, since G5.1 is one. What the channel does with them: channel_motion.cpp; the others do nothing here.
constexpr int kCodes[] = {0,   10,  20,  30,  40,  51,  90,  170, 180, 190, 200, 210, 280, 310, 330, 400, 410,
                          420, 430, 440, 490, 502, 512, 530, 540, 550, 560, 570, 580, 590, 610, 620, 630, 640,
                          740, 780, 800, 808, 818, 840, 842, 843, 900, 910, 920, 940, 950, 960, 970};

constexpr uint32_t kLastMacro = 9999;
constexpr uint32_t kLastNumber = 99'999'999; // of blocks, programs and codes

class Reader final : public ProgramReader<ProgramBlock> {
public:
  explicit Reader(std::string_view text) : ProgramReader(text, kLastMacro) {}

private:
  void beginBlock(ProgramBlock& block) override {
    if (!text_.take("/")) return;
    block.condition = 1;
    if (text_.written() < '1' || text_.written() > '8') return;
    block.condition = static_cast<uint32_t>(text_.written() - '0');
    text_.advance();
  }

  std::string readItem(ProgramBlock& block) override {
    if (text_.take("GOTO")) return readTarget(block, {});
    const bool conditional = text_.take("IF");
    text_.skipBlanks();
    if (text_.take("#")) return readVariable(block, conditional);
    if (conditional) return "expected a macro variable after IF";
    if (!text_.atLetter()) return std::string("unexpected character '") + text_.written() + "'";
    return readWord(block);
  }

  std::string readTarget(ProgramBlock& block, ProgramJump jump) {
    text_.skipBlanks();
    const auto target = text_.number();
    if (!target || *target < 1 || *target > UINT32_MAX) return "expected the number of a block after GOTO";
    jump.target = static_cast<uint32_t>(*target);
    block.jump = jump;
    return {};
  }

  std::string readVariable(ProgramBlock& block, bool conditional) {
    const auto variable = text_.variable();
    if (!variable) return "expected the number of a macro variable";
    text_.skipBlanks();
    if (!conditional && text_.take("=")) {
      const auto value = text_.value();
      if (!value) return "a number is missing after '='";
      block.assignments.push_back({.variable = *variable, .value = *value});
      return {};
    }
    using enum ProgramJump::Test;
    constexpr std::pair<std::string_view, ProgramJump::Test> kTests[] = {{"EQ", Eq}, {"NE", Ne}, {"GT", Gt},
                                                                         {"LT", Lt}, {"GE", Ge}, {"LE", Le}};
    for (const auto& [name, test] : kTests) {
      if (!text_.take(name)) continue;
      const auto value = text_.value();
      if (!value) return "a number is missing after " + std::string(name);
      text_.skipBlanks();
      if (!text_.take("GOTO")) return "expected GOTO";
      return readTarget(block, {.test = test, .variable = *variable, .value = *value});
    }
    return "expected '=' or a comparison after the macro variable";
  }

  std::string readWord(ProgramBlock& block) {
    ProgramWord word{.letter = text_.here()};
    text_.advance();
    auto value = text_.value();
    if (!value) return std::string("a number is missing after ") + word.letter;
    if (word.letter == 'S' && text_.take("=")) {
      if (value->number < 1 || value->number > 16) return "spindles are S1 to S16";
      word.spindle = static_cast<uint32_t>(value->number);
      value = text_.value();
      if (!value) return "a number is missing after '='";
    }
    word.value = *value;
    return take(word, block);
  }

  static std::string take(const ProgramWord& word, ProgramBlock& block) {
    const double number = word.value.number;
    const bool eightDigits = number >= 0 && number <= kLastNumber;
    if (word.letter == 'N' || word.letter == 'O') {
      if (!eightDigits || word.value.variable != 0) return "numbers have up to eight digits";
      if (word.letter == 'N') block.sequence = static_cast<uint32_t>(number);
      return {};
    }
    if (word.letter == 'G' && !isCode(kCodes, number)) return "a G code that is not simulated";
    if (word.letter == 'M' && word.value.variable == 0 && (number == 98 || number == 99))
      return "subprograms are not simulated";
    if (std::string_view("MST").find(word.letter) != std::string_view::npos && !eightDigits)
      return std::string(1, word.letter) + " takes no such number";
    block.words.push_back(word);
    return {};
  }

  std::string checkBlock(const ProgramBlock& block) const override {
    const auto codes = static_cast<size_t>(std::ranges::count(block.words, 'M', &ProgramWord::letter));
    return codes > kCodesOfABlock ? "more than eight M codes" : "";
  }
};

} // namespace

std::string readChannelProgram(std::string_view text, ChannelProgram& program) {
  program.blocks.clear();
  if (std::string wrong = Reader(text).readBlocks(program.blocks); !wrong.empty()) return wrong;
  for (const ProgramBlock& block : program.blocks)
    if (block.jump &&
        std::ranges::find(program.blocks, block.jump->target, &ProgramBlock::sequence) == program.blocks.end())
      return "there is no block N" + std::to_string(block.jump->target);
  return {};
}

} // namespace rung::sim::nct
