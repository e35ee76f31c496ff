// Reader of part programs (see part_program.h).
#include "tools/sim/gsk/part_program.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace rung::sim::gsk {
namespace {

// Tenths, since G54.1 is one.
constexpr int kCodes[] = {0,   10,  40,  170, 180, 190, 200, 210, 280, 300, 400, 410, 420, 430, 490,
                          530, 540, 541, 550, 560, 570, 580, 590, 800, 810, 900, 910, 920, 940, 950};

class Reader {
public:
  Reader(std::string_view text, std::string_view axes, bool manyM) : text_(text), axes_(axes), manyM_(manyM) {}

  std::string read(PartProgram& program) {
    program = {};
    do {
      Block block;
      if (std::string wrong = readBlock(block, program); !wrong.empty())
        return "block " + std::to_string(++number_) + ": " + wrong;
      ++number_;
      if (block.sequence != 0 || !block.words.empty()) program.blocks.push_back(std::move(block));
    } while (at_++ < text_.size()); // over the ";"
    return program.blocks.empty() ? "the program has no blocks" : std::string();
  }

private:
  static bool endsBlock(char c) { return c == ';' || c == '\n'; }
  bool atEnd() const { return at_ >= text_.size() || endsBlock(text_[at_]); }
  void skipBlanks() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t' || text_[at_] == '\r')) ++at_;
  }

  std::string readBlock(Block& block, PartProgram& program) {
    for (skipBlanks(); !atEnd(); skipBlanks())
      if (std::string wrong = readItem(block, program); !wrong.empty()) return wrong;
    const auto codes = std::ranges::count(block.words, 'M', &Word::letter);
    if (codes > (manyM_ ? 3 : 1))
      return manyM_ ? "more than three M codes" : "more than one M code; parameter 1803.6 allows three";
    return {};
  }

  std::string readItem(Block& block, PartProgram& program) {
    const char c = text_[at_];
    if (c == '/' && block.words.empty()) {
      ++at_;
      block.skipped = true;
      return {};
    }
    if (c == '(') {
      const size_t end = text_.find(')', at_);
      if (end == std::string_view::npos) return "a comment without ')'";
      at_ = end + 1;
      return {};
    }
    Word word;
    word.letter = static_cast<char>(c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c);
    ++at_;
    if (word.letter == '#') {
      double variable = 0;
      if (!readNumber(variable) || variable < 1 || at_ >= text_.size() || text_[at_] != '=')
        return "expected #NUMBER=VALUE";
      word.variable = static_cast<uint32_t>(variable);
      ++at_;
    } else if (word.letter < 'A' || word.letter > 'Z') {
      return std::string("unexpected character '") + c + "'";
    }
    if (!readValue(word.value)) return std::string("a number is missing after '") + c + "'";
    return take(word, block, program);
  }

  std::string take(const Word& word, Block& block, PartProgram& program) {
    const auto whole = [&] { return static_cast<uint32_t>(word.value.number); };
    if (word.letter == 'O') {
      program.number = whole();
      return {};
    }
    if (word.letter == 'N') {
      block.sequence = whole();
      return {};
    }
    if (word.letter == 'G' && std::ranges::find(kCodes, std::lround(word.value.number * 10)) == std::end(kCodes))
      return "G" + number(word.value.number) + " is not simulated";
    if (word.letter == 'M' && (word.value.number == 98 || word.value.number == 99))
      return "M" + number(word.value.number) + " is not simulated";
    const bool axis = axes_.find(word.letter) != std::string_view::npos;
    if (!axis && std::string_view("GMSTBFHDPR#").find(word.letter) == std::string_view::npos)
      return std::string("unknown word ") + word.letter + "; the axes are " + std::string(axes_);
    const bool code = !axis && std::string_view("MSTBHDP").find(word.letter) != std::string_view::npos;
    if (code && word.value.variable == 0 && (word.value.number < 0 || word.value.number > 4294967295.0))
      return std::string(1, word.letter) + " takes no such number";
    block.words.push_back(word);
    return {};
  }

  static std::string number(double value) {
    const long tenths = std::lround(value * 10);
    return std::to_string(tenths / 10) + (tenths % 10 == 0 ? "" : "." + std::to_string(tenths % 10));
  }

  bool readValue(Value& value) {
    skipBlanks();
    if (at_ < text_.size() && text_[at_] == '#') {
      ++at_;
      double variable = 0;
      if (!readNumber(variable) || variable < 1) return false;
      value.variable = static_cast<uint32_t>(variable);
      return true;
    }
    return readNumber(value.number);
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
  std::string_view axes_;
  bool manyM_;
  size_t at_ = 0;
  uint32_t number_ = 0;
};

} // namespace

std::string readPartProgram(std::string_view text, std::string_view axes, bool manyM, PartProgram& program) {
  return Reader(text, axes, manyM).read(program);
}

} // namespace rung::sim::gsk
