// Functions that are sent to the PLC.
#include "sim/nct/channel_functions.h"

#include <algorithm>

#include "sim/nct/tool_management.h"

namespace rung::sim::nct {

namespace {
constexpr uint32_t kLines = nc::NctFunctions::kLines;
constexpr uint32_t kFirstAuxiliary = nc::NctFunctions::kAuxiliary;
static_assert(kCodesOfABlock == nc::NctFunctions::kCodes);
constexpr int32_t kOffsetDigits = 100; // T of a lathe: tool and offset number, l.10674
} // namespace

bool BlockFunctions::has(int32_t code) const { return std::ranges::find(codes, code) != codes.end(); }

bool BlockFunctions::any() const { return ChannelFunctions::mask(*this) != 0; }

uint32_t ChannelFunctions::mask(const BlockFunctions& functions) {
  uint32_t mask = 0;
  for (uint32_t i = 0; i < kCodesOfABlock; ++i)
    if (functions.codes[i] >= 0) mask |= uint32_t{1} << i;
  if (functions.speed >= 0) mask |= kSpeed;
  if (functions.tool >= 0) mask |= kTool;
  for (uint32_t i = 0; i < 3; ++i)
    if (functions.auxiliary[i] >= 0) mask |= uint32_t{1} << (kFirstAuxiliary + i);
  return mask;
}

int32_t ChannelFunctions::codeOf(const BlockFunctions& functions, uint32_t line, bool turning) const {
  if (line < kCodesOfABlock) return functions.codes[line];
  if (line == nc::NctFunctions::kSpeed) return functions.speed;
  if (line == nc::NctFunctions::kTool) return turning ? functions.tool / kOffsetDigits : functions.tool;
  return functions.auxiliary[line - kFirstAuxiliary];
}

void ChannelFunctions::issue(const BlockFunctions& functions, uint32_t mask, bool turning) {
  if ((mask & kSpeed) != 0) selectRange(functions);
  if ((mask & kTool) != 0) showPlace(codeOf(functions, nc::NctFunctions::kTool, turning));
  for (uint32_t line = 0; line < kLines; ++line)
    if ((mask >> line & 1) != 0) handshake_.issue(links_.signals, line, codeOf(functions, line, turning));
}

uint32_t ChannelFunctions::unacknowledged(uint32_t mask) const {
  uint32_t open = 0;
  for (uint32_t line = 0; line < kLines; ++line)
    if ((mask >> line & 1) != 0 && !handshake_.acknowledged(links_.signals, line)) open |= uint32_t{1} << line;
  return open;
}

// Selects the first range that reaches the speed (l.10664-10668), or the last one if none does.
void ChannelFunctions::selectRange(const BlockFunctions& functions) {
  const SignalMemory& signals = links_.signals;
  int32_t range = 0;
  while (range < 7 && functions.speed > links_.parameters->real(parameters_.rangeEnd[range], functions.spindle - 1))
    ++range;
  signals.set(spindle_, channel_, static_cast<int32_t>(functions.spindle));
  signals.set(range_, channel_, nc::NctFunctions::kFirstRange + range);
}

// Shows the place of the tool, if tool management is enabled (l.9515-9522, 10732-10772).
void ChannelFunctions::showPlace(int32_t type) {
  const SignalMemory& signals = links_.signals;
  const bool managed = links_.tools->managed();
  const ToolPick pick = managed ? links_.tools->pick(type) : ToolPick{};
  signals.set(magazine_, channel_, static_cast<int32_t>(pick.place.cartridge));
  signals.set(pot_, channel_, static_cast<int32_t>(pick.place.pot));
  signals.set(toolExpired_, channel_, pick.expired);
}

// Reads part programs.

namespace {

// G codes in tenths, because of G5.1. channel_motion.cpp executes some of them; the others have no effect here.
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
