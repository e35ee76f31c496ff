// The common parts of part programs in all dialects: blocks that end with ";" or a new line, words with a letter and a
// value, macro variables, comments. The reader of a dialect adds its words, codes and rules.
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
  uint32_t variable = 0; // number of a macro variable; 0: `number` is the value

  template <class Archive>
  void state(Archive& archive) {
    archive(number, variable);
  }
};

// The text of a part program, read from its beginning to its end.
class ProgramText {
public:
  // `lastVariable`: the highest macro variable; they begin with #1.
  ProgramText(std::string_view text, uint32_t lastVariable) : text_(text), lastVariable_(lastVariable) {}

  bool atBlockEnd() const;
  // Skips the end of a block; false: the end of the text.
  bool nextBlock();
  // `written`: the next character, 0 at the end of the text; `here`: the same as a capital letter.
  char written() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  char here() const;
  bool atLetter() const { return here() >= 'A' && here() <= 'Z'; }
  void advance() { ++at_; }
  void skipBlanks();
  // Takes `word`, which must be in capital letters; false: something else follows.
  bool take(std::string_view word);
  // Skips the rest of a comment whose "(" has been taken; returns "", or the error.
  std::string skipComment();

  // These functions return nothing if the text continues differently, and then take nothing.
  std::optional<double> number();
  std::optional<uint32_t> variable(); // after "#"
  std::optional<ProgramValue> value();

private:
  std::string_view text_;
  size_t at_ = 0;
  uint32_t lastVariable_;
};

// Whether the code is in `tenths`: codes such as G54.1 are written 541.
bool isCode(std::span<const int> tenths, double code);

// Reads a program block by block. Blocks that are `empty` are not added to the program.
template <class Block>
class ProgramReader {
public:
  virtual ~ProgramReader() = default;
  ProgramReader(const ProgramReader&) = delete;
  ProgramReader& operator=(const ProgramReader&) = delete;

  // Adds the blocks; returns "", or the error.
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

  // Called before the first item of a block.
  virtual void beginBlock(Block& block) { (void)block; }
  // Reads an item that is neither a blank nor a comment.
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

// The codes for lengths, coordinates and feeds, common to all dialects: G20 and G21, G90 and G91, G94 and G95.

struct PathModes {
  static constexpr double kMmPerInch = 25.4;

  bool inch = false;        // G20
  bool incremental = false; // G91
  bool perTurn = false;     // G95
  double feed = 0;          // mm per minute or per revolution of the spindle

  // Takes a G code in tenths; other codes change nothing.
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

  // Converts a programmed length to mm.
  double length(double written) const { return inch ? written * kMmPerInch : written; }
  // The machine coordinate for a programmed length; all in the same unit.
  template <class T>
  T target(T length, T from, T zeroPoint) const {
    return incremental ? from + length : length + zeroPoint;
  }
  template <class Archive>
  void state(Archive& archive) {
    archive(inch, incremental, perTurn, feed);
  }

  double feedPerMinute(double turnsPerMinute) const { return perTurn ? feed * std::abs(turnsPerMinute) : feed; }
};

} // namespace rung::sim
