// Reader of part programs (see channel_program.h).
#include "tools/sim/nct/channel_program.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace rung::sim::nct {
namespace {

// Tenths, since G5.1 is one. What the channel does with them: channel_motion.cpp; the others do nothing here.
constexpr int kCodes[] = {0,   10,  20,  30,  40,  51,  90,  170, 180, 190, 200, 210, 280, 310, 330, 400, 410,
                          420, 430, 440, 490, 502, 512, 530, 540, 550, 560, 570, 580, 590, 610, 620, 630, 640,
                          740, 780, 800, 808, 818, 840, 842, 843, 900, 910, 920, 940, 950, 960, 970};

class Reader {
public:
  explicit Reader(std::string_view text) : text_(text) {}

  std::string read(ChannelProgram& program) {
    do {
      ++number_;
      ProgramBlock block;
      if (std::string wrong = readBlock(block); !wrong.empty())
        return "block " + std::to_string(number_) + ": " + wrong;
      if (block.sequence != 0 || !block.words.empty() || !block.assignments.empty() || block.jump)
        program.blocks.push_back(std::move(block));
    } while (at_++ < text_.size()); // over the ";"
    if (program.blocks.empty()) return "the program has no blocks";
    for (const ProgramBlock& block : program.blocks)
      if (block.jump &&
          std::ranges::find(program.blocks, block.jump->target, &ProgramBlock::sequence) == program.blocks.end())
        return "there is no block N" + std::to_string(block.jump->target);
    return {};
  }

private:
  static bool isLetter(char c) { return c >= 'A' && c <= 'Z'; }
  bool atEnd() const { return at_ >= text_.size() || text_[at_] == ';' || text_[at_] == '\n'; }
  char here() const {
    const char c = at_ < text_.size() ? text_[at_] : '\0';
    return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  }
  void skipBlanks() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t' || text_[at_] == '\r')) ++at_;
  }
  bool take(std::string_view word) {
    const size_t from = at_;
    for (const char c : word) {
      if (here() != c) {
        at_ = from;
        return false;
      }
      ++at_;
    }
    return true;
  }

  std::string readBlock(ProgramBlock& block) {
    skipBlanks();
    if (take("/")) {
      block.condition = 1;
      if (here() >= '1' && here() <= '8') block.condition = static_cast<uint32_t>(text_[at_++] - '0');
    }
    for (skipBlanks(); !atEnd(); skipBlanks())
      if (std::string wrong = readItem(block); !wrong.empty()) return wrong;
    const auto codes = static_cast<size_t>(std::ranges::count(block.words, 'M', &ProgramWord::letter));
    return codes > kCodesOfABlock ? "more than eight M codes" : "";
  }

  std::string readItem(ProgramBlock& block) {
    if (take("(")) {
      const size_t end = text_.find(')', at_);
      if (end == std::string_view::npos) return "a comment without ')'";
      at_ = end + 1;
      return {};
    }
    if (take("GOTO")) return readTarget(block, {});
    const bool conditional = take("IF");
    skipBlanks();
    if (here() == '#') return readVariable(block, conditional);
    if (conditional) return "expected a macro variable after IF";
    if (!isLetter(here())) return std::string("unexpected character '") + text_[at_] + "'";
    return readWord(block);
  }

  std::string readTarget(ProgramBlock& block, ProgramJump jump) {
    skipBlanks();
    double target = 0;
    if (!readNumber(target) || target < 1) return "expected the number of a block after GOTO";
    jump.target = static_cast<uint32_t>(target);
    block.jump = jump;
    return {};
  }

  std::string readVariable(ProgramBlock& block, bool conditional) {
    ++at_;
    double variable = 0;
    if (!readNumber(variable) || variable < 1 || variable > 9999) return "expected the number of a macro variable";
    const auto number = static_cast<uint32_t>(variable);
    skipBlanks();
    if (!conditional && take("=")) {
      ProgramAssignment assignment{.variable = number, .value = {}};
      if (!readValue(assignment.value)) return "a number is missing after '='";
      block.assignments.push_back(assignment);
      return {};
    }
    using enum ProgramJump::Test;
    constexpr std::pair<std::string_view, ProgramJump::Test> kTests[] = {{"EQ", Eq}, {"NE", Ne}, {"GT", Gt},
                                                                         {"LT", Lt}, {"GE", Ge}, {"LE", Le}};
    for (const auto& [name, test] : kTests) {
      if (!take(name)) continue;
      ProgramJump jump{.test = test, .variable = number, .value = {}, .target = 0};
      if (!readValue(jump.value)) return "a number is missing after " + std::string(name);
      skipBlanks();
      return take("GOTO") ? readTarget(block, jump) : "expected GOTO";
    }
    return "expected '=' or a comparison after the macro variable";
  }

  std::string readWord(ProgramBlock& block) {
    ProgramWord word;
    word.letter = here();
    ++at_;
    if (!readValue(word.value)) return std::string("a number is missing after ") + word.letter;
    if (word.letter == 'S' && take("=")) {
      if (word.value.number < 1 || word.value.number > 16) return "spindles are S1 to S16";
      word.spindle = static_cast<uint32_t>(word.value.number);
      if (!readValue(word.value)) return "a number is missing after '='";
    }
    const double number = word.value.number;
    if (word.letter == 'N' || word.letter == 'O') {
      if (number < 0 || number > 99'999'999 || word.value.variable != 0) return "numbers have up to eight digits";
      if (word.letter == 'N') block.sequence = static_cast<uint32_t>(number);
      return {};
    }
    if (word.letter == 'G' && std::ranges::find(kCodes, std::lround(number * 10)) == std::end(kCodes))
      return "a G code that is not simulated";
    if (word.letter == 'M' && word.value.variable == 0 && (number == 98 || number == 99))
      return "subprograms are not simulated";
    if (std::string_view("MST").find(word.letter) != std::string_view::npos && (number < 0 || number > 99'999'999))
      return std::string(1, word.letter) + " takes no such number";
    block.words.push_back(word);
    return {};
  }

  bool readValue(ProgramValue& value) {
    skipBlanks();
    if (!take("#")) return readNumber(value.number);
    double variable = 0;
    if (!readNumber(variable) || variable < 1 || variable > 9999) return false;
    value.variable = static_cast<uint32_t>(variable);
    return true;
  }

  bool readNumber(double& number) {
    if (at_ < text_.size() && text_[at_] == '+') ++at_;
    const auto [end, error] =
        std::from_chars(text_.data() + at_, text_.data() + text_.size(), number, std::chars_format::fixed);
    if (error != std::errc()) return false;
    at_ = static_cast<size_t>(end - text_.data());
    return true;
  }

  std::string_view text_;
  size_t at_ = 0;
  uint32_t number_ = 0;
};

} // namespace

std::string readChannelProgram(std::string_view text, ChannelProgram& program) {
  program.blocks.clear();
  return Reader(text).read(program);
}

} // namespace rung::sim::nct
