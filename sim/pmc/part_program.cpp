// Reads part programs.
#include "sim/pmc/part_program.h"

#include <algorithm>
#include <cmath>

#include "rtlib/text/number.h"
#include "sim/pmc/simulator.h"

namespace rung::sim::pmc {

namespace {

// G codes in tenths, because of G54.1.
constexpr int kCodes[] = {0,   10,  40,  170, 180, 190, 200, 210, 280, 300, 400, 410, 420, 430, 490,
                          530, 540, 541, 550, 560, 570, 580, 590, 800, 810, 900, 910, 920, 940, 950};

class Reader final : public ProgramReader<Block> {
public:
  Reader(std::string_view text, std::string_view axes, const Cnc& cnc, bool manyM, PartProgram& program)
      : ProgramReader(text, UINT32_MAX), axes_(axes), cnc_(cnc), manyM_(manyM), program_(program) {}

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
    constexpr const char* kNumbers[] = {"no", "one", "two", "three", "four", "five"};
    static_assert(std::size(kNumbers) == nc::pmc::kMostM + 1);
    if (codes <= (manyM_ ? cnc_.mostM : 1)) return {};
    if (manyM_) return std::string("more than ") + kNumbers[cnc_.mostM] + " M codes";
    const ParameterBit& many = cnc_.parameters.manyM;
    return "more than one M code; parameter " + std::to_string(many.number) + "." + std::to_string(many.bit) +
           " allows " + kNumbers[cnc_.mostM];
  }

  static std::string number(double value) {
    const long tenths = std::lround(value * 10);
    return std::to_string(tenths / 10) + (tenths % 10 == 0 ? "" : "." + std::to_string(tenths % 10));
  }

  std::string_view axes_;
  const Cnc& cnc_;
  bool manyM_;
  PartProgram& program_;
};

} // namespace

std::string readPartProgram(std::string_view text, std::string_view axes, const Cnc& cnc, bool manyM,
                            PartProgram& program) {
  program = {};
  return Reader(text, axes, cnc, manyM, program).readBlocks(program.blocks);
}

// Quantities of the simulated CNC by name, which scenarios read and set.

namespace {

// "OFFSET.H.3" is {"OFFSET.H", 3, 0}; "PARAM.1225.2" is {"PARAM", 1225, 2}.
struct Name {
  std::string_view head;
  uint32_t first = 0;
  uint32_t second = 0;
  uint32_t numbers = 0;
};

std::optional<uint32_t> lastNumber(std::string_view& name) {
  const size_t dot = name.rfind('.');
  if (dot == std::string_view::npos) return std::nullopt;
  const auto number = text::numberIn<uint32_t>(name.substr(dot + 1));
  if (number) name = name.substr(0, dot);
  return number;
}

Name split(std::string_view text) {
  Name name{.head = text};
  const auto last = lastNumber(name.head);
  if (!last) return name;
  name.first = *last;
  name.numbers = 1;
  if (const auto before = lastNumber(name.head)) {
    name.second = name.first;
    name.first = *before;
    name.numbers = 2;
  }
  return name;
}

// A cell of a table: NC.OFFSET.H.1, NC.WORK.1.2, NC.PARAM.1225[.1], NC.MACRO.100, NC.PITCH.5[.1].
struct Cell {
  Table table;
  uint32_t number;
  uint32_t attribute;
};

std::optional<Cell> cellOf(const Name& n) {
  constexpr std::string_view kKinds[] = {"OFFSET.H", "OFFSET.HWEAR", "OFFSET.D", "OFFSET.DWEAR"};
  for (uint32_t kind = 0; kind < 4; ++kind)
    if (n.head == kKinds[kind] && n.numbers == 1 && n.first >= 1 && n.first <= kToolOffsets)
      return Cell{Table::ToolOffset, n.first - 1, kind};
  const uint32_t axis = n.numbers == 2 ? n.second - 1 : 0;
  if (n.numbers == 0 || axis >= kAxes) return std::nullopt;
  if (n.head == "PARAM") return Cell{Table::Parameter, n.first, axis};
  if (n.head == "WORK" && n.numbers == 2) return Cell{Table::WorkOffset, n.first, axis};
  if (n.head == "PITCH" && axis <= 1) return Cell{Table::Pitch, n.first, axis};
  if (n.head == "MACRO" && n.numbers == 1 && n.first >= 100 && n.first <= 999) return Cell{Table::Macro, n.first, 0};
  return std::nullopt;
}

double real(int64_t units) { return static_cast<double>(units) / kUnitsPerMm; }

} // namespace

std::optional<double> Simulator::quantity(std::string_view text) const {
  const Machine& m = machine_;
  if (text == "FEED") return operation_.speed();
  if (text == "SPINDLE") return m.spindle.actual();
  if (text == "SPINDLE2") return m.spindle.actual2();
  if (text == "TOOL") return real(m.tables.get(Table::Tool, 0));
  if (text == "NEXTTOOL") return real(m.tables.get(Table::Tool, 1));
  if (text == "ALARM") return m.alarms.last();
  if (text == "PROGRAM") return operation_.programNumber();
  if (text == "SEQUENCE") return operation_.sequence();
  if (text == "PARTS") return external_.parts();
  if (text == "PARTSPRESET") return external_.partsPreset();
  const Name n = split(text);
  if (const auto cell = cellOf(n)) return real(m.tables.get(cell->table, cell->number, cell->attribute));
  if (n.numbers != 1 || n.first < 1 || n.first > m.axes.count()) return std::nullopt;
  const uint32_t axis = n.first - 1;
  if (n.head == "MPOS") return machinePosition(axis);
  if (n.head == "APOS") return operation_.absolute(m, axis);
  if (n.head == "RPOS") return real(m.axes[axis].relative);
  return std::nullopt;
}

double Simulator::machinePosition(uint32_t axis) const {
  return axis < machine_.axes.count() ? std::floor(static_cast<double>(machine_.axes[axis].machine) / 10) : 0;
}

std::string Simulator::setQuantity(std::string_view text, double value) {
  Machine& m = machine_;
  const int64_t units = std::llround(value * kUnitsPerMm);
  if (text == "TOOL" || text == "NEXTTOOL") {
    m.tables.set(Table::Tool, text == "TOOL" ? 0 : 1, 0, units);
    return {};
  }
  const Name n = split(text);
  if (const auto cell = cellOf(n)) {
    m.tables.set(cell->table, cell->number, cell->attribute, units);
    return {};
  }
  if (n.numbers == 1 && n.first >= 1 && n.first <= m.axes.count()) {
    if (n.head == "MPOS") {
      m.axes.place(n.first - 1, std::llround(value * 10));
      return {};
    }
    if (n.head == "RPOS") {
      m.axes[n.first - 1].relative = units;
      return {};
    }
  }
  return quantity(text) ? "NC." + std::string(text) + " can only be read"
                        : "the simulated NC has no variable 'NC." + std::string(text) + "'";
}

} // namespace rung::sim::pmc
