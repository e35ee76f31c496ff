// Programs at random.
#include "tests/unit/gsk/program_generator.h"

#include <sstream>

#include <fmt/format.h>

#include "frontend/dialects/gsk/rows/operand_kinds.h"

namespace rung::frontend::gsk::test {
namespace {

std::vector<std::string> linesOf(std::string_view text) {
  std::vector<std::string> lines;
  std::istringstream stream{std::string(text)};
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

bool isAddress(const std::string& operand) {
  return operand.size() > 1 && std::string_view("XYFGRDCTAK").find(operand[0]) != std::string_view::npos &&
         operand[1] >= '0' && operand[1] <= '9';
}

} // namespace

std::string ProgramGenerator::comment() {
  static const std::vector<std::string> kTexts = {"feed hold",
                                                  "a \"quoted\" word",
                                                  "----",
                                                  "; twice",
                                                  "section \"Spindle\"",
                                                  "[X1.0] looks like a tag",
                                                  "-> {MOVB} so does this",
                                                  "list: LD AND",
                                                  "condition: LD X1.0",
                                                  "Größe in µm",
                                                  "tab\there",
                                                  "",
                                                  "100 %",
                                                  "=== title ===",
                                                  "module LEVEL2",
                                                  "rung",
                                                  "|--[A]--(B)",
                                                  "#1",
                                                  "{",
                                                  "(R1.0)"};
  return one(kTexts) + (chance(60) ? fmt::format(" {}", below(1000)) : "");
}

void ProgramGenerator::between() {
  while (chance(25)) text_ += chance(50) ? "\n" : fmt::format(";{}{}\n", chance(80) ? " " : "", comment());
}

void ProgramGenerator::line(const std::string& statement) {
  if (chance(6)) text_ += chance(80) ? fmt::format("; {}\n", comment()) : "\n";
  if (numbered_) text_ += fmt::format("{:04} ", step_++);
  text_ += statement;
  if (chance(15)) text_ += fmt::format("{}; {}", chance(50) ? "\t" : "   ", comment());
  text_ += '\n';
  if (chance(2)) text_ += fmt::format("symbol INNER{} R{}.0 ; {}\n", text_.size(), below(900), comment());
}

void ProgramGenerator::declarations() {
  between();
  if (chance(60)) text_ += chance(50) ? "dialect gsk\n" : fmt::format("DIALECT gsk ; {}\n", comment());
  between();
  for (uint32_t i = below(5); i > 0; --i) {
    bits_.push_back(fmt::format("BIT_{}", i));
    text_ += fmt::format("symbol BIT_{} R{:0{}}.{}{}\n", i, below(900), 1 + below(4), below(8),
                         chance(50) ? " ; " + comment() : "");
    between();
  }
  for (uint32_t i = below(3); i > 0; --i) {
    constants_.push_back(fmt::format("CONST_{}", i));
    text_ += fmt::format("const CONST_{} {}{}\n", i, 8 + below(90), chance(50) ? " ; " + comment() : "");
    between();
  }
}

std::string ProgramGenerator::bit(bool written) {
  if (!bits_.empty() && chance(40)) return one(bits_);
  if (!written && chance(10)) return one(std::vector<std::string>{"MJ", "KEY_START", "X_ESP", "*ESP"});
  const char area =
      one(written ? std::vector<char>{'R', 'Y', 'r', 'y'} : std::vector<char>{'X', 'R', 'Y', 'F', 'x', 'g'});
  return fmt::format("{}{:0{}}.{}", area, below(100), 1 + below(4), below(8));
}

std::string ProgramGenerator::respelled(std::string operand, const frontend::OperandKindInfo* kind) {
  if (isAddress(operand)) {
    if (chance(30)) operand.insert(1, "00");
    if (chance(20)) operand[0] = static_cast<char>(operand[0] + ('a' - 'A'));
  } else if (kind == &kinds::kConstant && chance(50)) {
    operand = chance(50) && !constants_.empty() ? one(constants_) : fmt::format("0x{:02X}", below(100));
  } else if (kind == &kinds::kNumber && chance(30)) {
    operand.insert(0, "00");
  }
  return operand;
}

// `contacts` contacts as one value, however grouped.
void ProgramGenerator::block(uint32_t contacts, uint32_t depth) {
  static const std::vector<std::string> kFurther = {"AND", "ANI", "OR", "ORI", "and", "Or"};
  line(fmt::format("{} {}", one(std::vector<std::string>{"LD", "LDI", "ld"}), bit(false)));
  for (--contacts; contacts > 0;) {
    const uint32_t part = depth < 6 && chance(30) ? 1 + below(contacts) : 0;
    if (part == 0) {
      line(fmt::format("{} {}", one(kFurther), bit(false)));
      --contacts;
      continue;
    }
    block(part, depth + 1);
    contacts -= part;
    line(chance(50) ? "ORB" : "ANB");
  }
}

void ProgramGenerator::logic(uint32_t values) {
  for (uint32_t i = 0; i < values; ++i) block(1 + below(chance(10) ? 25 : 5), i);
}

void ProgramGenerator::coils() {
  static const std::vector<std::string> kCoils = {"OUT", "OUTI", "SET", "RST"};
  do line(fmt::format("{} {}", one(kCoils), bit(true)));
  while (chance(30));
}

void ProgramGenerator::function(const Row& row) {
  logic(static_cast<uint32_t>(row.info.pins.size()));
  const uint32_t spelling = below(3);
  line(spelling == 0 ? fmt::format("FUNC {}", row.info.number) : fmt::format("FUNC {}", row.info.mnemonic));
  size_t operand = 0;
  for (const std::string& example : linesOf(row.info.example)) {
    if (example.starts_with("PRM "))
      line(fmt::format("PRM {}", respelled(example.substr(4), row.info.operands[operand++].kind)));
    if (example.starts_with("TABLE ")) line(fmt::format("TABLE {}", below(256)));
  }
  if (row.info.output == frontend::Output::Always || (row.info.output == frontend::Output::Optional && chance(50)))
    coils();
}

void ProgramGenerator::function(const std::string& name, const std::string& parameter) {
  line("FUNC " + name);
  if (!parameter.empty()) line("PRM " + parameter);
}

void ProgramGenerator::region() {
  const bool com = chance(50);
  bool& inside = com ? inCom_ : inJmp_;
  if (inside || inCom_) return network();
  inside = true;
  logic(1);
  function(com ? "COM" : "JMP", com ? "" : "0");
  for (uint32_t i = below(4); i > 0; --i) network();
  function(com ? "COME" : "JMPE");
  inside = false;
}

void ProgramGenerator::jump() {
  const std::string label = fmt::format("L{:0{}}", ++label_, 1 + below(4));
  logic(1);
  function("JMPB", label);
  for (uint32_t i = below(3); i > 0; --i) network();
  if (chance(20)) block(1 + below(4), 0);
  function("LBL", label);
}

void ProgramGenerator::network() {
  if (chance(40)) {
    logic(1);
    return coils();
  }
  if (!subprograms_.empty() && chance(10)) {
    const bool always = chance(50);
    if (!always) logic(1);
    return function(always ? "CALLU" : "CALL", fmt::format("P{}", one(subprograms_)));
  }
  for (;;) {
    const Row& row = allRows()[below(static_cast<uint32_t>(allRows().size()))];
    if (row.info.number >= 0 && row.control == frontend::network::Control::Plain) return function(row);
  }
}

void ProgramGenerator::unit(uint32_t networks) {
  for (; networks > 0; --networks) {
    between();
    if (chance(8))
      region();
    else if (chance(8))
      jump();
    else
      network();
  }
  between();
}

std::string ProgramGenerator::list() {
  text_.clear();
  numbered_ = chance(20);
  declarations();
  const uint32_t last = below(4);
  for (uint32_t i = 1; i <= last; ++i) subprograms_.push_back(i);
  unit(below(4));
  line("FUNC 0");
  unit(below(12));
  line("FUNC END2");
  for (uint32_t i = 1; i <= last; ++i) {
    subprograms_.erase(subprograms_.begin());
    between();
    if (chance(20)) block(1 + below(4), 0);
    line("FUNC SP");
    line(fmt::format("PRM P{:0{}}", i, 1 + below(3)));
    unit(below(4));
    line("FUNC 43");
  }
  between();
  return std::move(text_);
}

std::string ProgramGenerator::decorated(const std::string& ladder) {
  std::string result;
  bool drawing = false;
  for (std::string text : linesOf(ladder)) {
    const bool drawn = !text.empty() && (text[0] == '|' || text[0] == ' ');
    std::string remark = comment();
    for (char& c : remark)
      if (c == '\t') c = ' ';
    if (drawn && chance(10) && text.find(';') == std::string::npos) text += "  ; " + remark;
    if (chance(5)) result += fmt::format("{}; {}\n", drawing && chance(50) ? "    " : "", remark);
    if (!drawing && chance(5)) result += '\n';
    drawing = drawn || text.starts_with("rung") || (drawing && text.starts_with(';'));
    result += text + '\n';
  }
  return result;
}

} // namespace rung::frontend::gsk::test
