// What the part programs of all dialects consist of: blocks that end with ";" or a new line, words of a letter and a
// value, macro variables, comments. A dialect's reader adds its words, its codes and its rules.
//
//   program := block { (";" | newline) block }        word  := letter value
//   block   := { word | "(" comment ")" | … }          value := number | "#" number
#pragma once
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rung::sim {

struct ProgramValue {
  double number = 0;
  uint32_t variable = 0; // of a macro variable; 0: the number counts
};

// The text of a part program, from its beginning to its end.
class ProgramText {
public:
  // `lastVariable`: of the macro variables, which begin with #1.
  ProgramText(std::string_view text, uint32_t lastVariable) : text_(text), lastVariable_(lastVariable) {}

  bool atBlockEnd() const;
  // Over the end of a block; false: the text ends there.
  bool nextBlock();
  // The next character, 0 at the end of the text; `here`: as a capital letter.
  char written() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  char here() const;
  bool atLetter() const { return here() >= 'A' && here() <= 'Z'; }
  void advance() { ++at_; }
  void skipBlanks();
  // Takes `word`, which is in capital letters; false: something else follows.
  bool take(std::string_view word);
  // To the end of a comment whose "(" has been taken; "" or what is wrong.
  std::string skipComment();

  // Each gives nothing when the text continues differently; the text is not read further then.
  std::optional<double> number();
  std::optional<uint32_t> variable(); // after "#"
  std::optional<ProgramValue> value();

private:
  std::string_view text_;
  size_t at_ = 0;
  uint32_t lastVariable_;
};

// Whether a number is one of `tenths`: codes such as G54.1, which is 541.
bool isCode(std::span<const int> tenths, double code);

// Reads a program block by block. A Block knows whether it is `empty`: such a one does not count as part of a program.
template <class Block>
class ProgramReader {
public:
  virtual ~ProgramReader() = default;
  ProgramReader(const ProgramReader&) = delete;
  ProgramReader& operator=(const ProgramReader&) = delete;

  // Adds the blocks; "" or what is wrong.
  std::string readBlocks(std::vector<Block>& blocks) {
    uint32_t number = 0;
    do {
      ++number;
      Block block;
      if (std::string wrong = readBlock(block); !wrong.empty()) return "block " + std::to_string(number) + ": " + wrong;
      if (!block.empty()) blocks.push_back(std::move(block));
    } while (text_.nextBlock());
    return blocks.empty() ? "the program has no blocks" : std::string();
  }

protected:
  ProgramReader(std::string_view text, uint32_t lastVariable) : text_(text, lastVariable) {}

  // Before the first item of a block.
  virtual void beginBlock(Block& block) { (void)block; }
  // Neither a blank nor a comment.
  virtual std::string readItem(Block& block) = 0;
  virtual std::string checkBlock(const Block& block) const = 0;

  ProgramText text_;

private:
  std::string readBlock(Block& block) {
    text_.skipBlanks();
    beginBlock(block);
    for (text_.skipBlanks(); !text_.atBlockEnd(); text_.skipBlanks())
      if (std::string wrong = text_.take("(") ? text_.skipComment() : readItem(block); !wrong.empty()) return wrong;
    return checkBlock(block);
  }
};

// The codes of a part program by which all dialects read lengths, coordinates and feeds: G20 and G21, G90 and G91, G94
// and G95.

struct PathModes {
  static constexpr double kMmPerInch = 25.4;

  bool inch = false;        // G20
  bool incremental = false; // G91
  bool perTurn = false;     // G95
  double feed = 0;          // mm per minute or per turn of the spindle

  // A G code in tenths; what is not one of these changes nothing.
  void take(int tenths) {
    switch (tenths) {
    case 200:
    case 210: inch = tenths == 200; return;
    case 900:
    case 910: incremental = tenths == 910; return;
    case 940:
    case 950: perTurn = tenths == 950; return;
    default: return;
    }
  }

  // A length as the program writes it, in mm.
  double length(double written) const { return inch ? written * kMmPerInch : written; }
  // The machine coordinate that a length leads to, in the unit of all three.
  template <class T>
  T target(T length, T from, T zeroPoint) const {
    return incremental ? from + length : length + zeroPoint;
  }
  double feedPerMinute(double turnsPerMinute) const { return perTurn ? feed * std::abs(turnsPerMinute) : feed; }
};

} // namespace rung::sim
