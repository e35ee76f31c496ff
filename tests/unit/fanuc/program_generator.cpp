// Programs at random.
#include "tests/unit/fanuc/program_generator.h"

#include <algorithm>
#include <sstream>

#include <fmt/format.h>

#include "frontend/dialects/fanuc/language.h"
#include "frontend/dialects/fanuc/rows/operand_kinds.h"

namespace rung::frontend::fanuc::test {
namespace {

using network::Control;

constexpr uint32_t kStack = 9; // values (F12)

std::vector<std::string> linesOf(std::string_view text) {
  std::vector<std::string> lines;
  std::istringstream stream{std::string(text)};
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

bool isByteAddress(const std::string& operand) {
  return operand.size() > 1 && std::string_view("XYFGREAKTCD").find(operand[0]) != std::string_view::npos &&
         operand.find('.') == std::string::npos;
}

const Row& rowNamed(const std::string& mnemonic) {
  return network::loweredRow(*languageOf(Pmc::MemB).findFunction(mnemonic));
}

} // namespace

std::string ProgramGenerator::remark() {
  static const std::vector<std::string> kTexts = {"feed hold",   "\"quoted\"", "----", "(KEY.M)", "[A0.1]",
                                                  "SUB 40",      "RD X1.0",    "%",    "N00010:", "(* no comment *)",
                                                  "Größe in µm", "tab\there",  "",     "L1 LBL",  "100 %"};
  return one(kTexts) + (chance(60) ? fmt::format(" {}", below(1000)) : "");
}

void ProgramGenerator::between() {
  while (chance(20)) text_ += chance(50) ? "\n" : fmt::format(";{}\n", remark());
  if (chance(15)) text_ += fmt::format("(* net{}{} *)\n", chance(30) ? "\n" : " ", below(1000));
}

void ProgramGenerator::line(const std::string& statement) {
  if (chance(6)) text_ += chance(80) ? fmt::format(";{}\n", remark()) : "\n";
  text_ += statement;
  if (chance(15)) text_ += fmt::format("{};{}", chance(50) ? "\t" : "   ", remark());
  text_ += '\n';
}

void ProgramGenerator::symbols() {
  text_ += "%@2\n";
  for (uint32_t i = 1 + below(5); i > 0; --i) {
    bits_.push_back(fmt::format("{}BIT{}.M", chance(50) ? "*" : "", i));
    text_ += fmt::format("R{:0{}}.{} {}\n", below(900), 1 + below(4), below(8), bits_.back());
  }
  text_ += "%\n";
}

std::string ProgramGenerator::bit(bool written) {
  if (!bits_.empty() && chance(30)) return one(bits_);
  static const std::vector<std::string> kSystem = {"R9000.0", "R9000.1", "R9000.5", "R9091.0", "R9091.1",
                                                   "R9091.5", "R9091.6", "R9015.0", "T9036.2", "A9000.1"};
  if (!written && chance(15)) return one(kSystem);
  const char area = one(written ? std::vector<char>{'R', 'Y', 'r', 'K', 'E', 'D', 'T', 'A'}
                                : std::vector<char>{'X', 'R', 'Y', 'F', 'x', 'g', 'K', 'D'});
  return fmt::format("{}{:0{}}.{}", area, below(100), 1 + below(4), below(8));
}

// Other places and numbers than those of the example.
std::string ProgramGenerator::respelled(const std::string& operand, const frontend::OperandInfo& info) {
  if (isByteAddress(operand))
    return fmt::format("{}{:0{}}", one(std::vector<char>{'D', 'R', 'E', 'd'}), below(200), 1 + below(4));
  if (info.kind == &kinds::kConstant || info.kind == &kinds::kEitherByte || info.kind == &kinds::kEitherDword)
    return chance(30) ? fmt::format("-{}", below(130)) : fmt::format("{}", below(70'000));
  if (info.name == "number" && chance(50)) return fmt::format("00{}", 1 + below(4));
  return operand;
}

// `contacts` contacts as one value, with at most `room` values on the stack.
void ProgramGenerator::block(uint32_t contacts, uint32_t room, bool begins) {
  static const std::vector<std::string> kFurther = {"AND", "AND.NOT", "OR", "OR.NOT", "and", "Or"};
  static const std::vector<std::string> kFirst = {"RD", "RD.NOT", "rd", "RDNT"};
  static const std::vector<std::string> kPushing = {"RD.STK", "RD.NOT.STK", "RD.STK.NOT"};
  line(fmt::format("{} {}", one(begins ? kFirst : kPushing), bit(false)));
  for (--contacts; contacts > 0;) {
    const uint32_t part = room > 1 && chance(30) ? 1 + below(contacts) : 0;
    if (part == 0) {
      line(fmt::format("{} {}", one(kFurther), bit(false)));
      --contacts;
      continue;
    }
    block(part, room - 1, false);
    contacts -= part;
    line(chance(50) ? "OR.STK" : "AND.STK");
  }
}

void ProgramGenerator::logic(uint32_t values) {
  if (values > 0 && chance(20)) text_ += fmt::format("N{:05}:{}", ++net_, chance(50) ? "\n" : " ");
  for (uint32_t i = 0; i < values; ++i) block(1 + below(chance(10) ? 25 : 5), kStack - i, i == 0);
}

void ProgramGenerator::coils() {
  static const std::vector<std::string> kCoils = {"WRT", "WRT.NOT", "SET", "RST"};
  do line(fmt::format("{} {}", one(kCoils), bit(true)));
  while (chance(30));
}

void ProgramGenerator::function(const Row& row) {
  logic(static_cast<uint32_t>(row.info.pins.size()));
  const bool hasName = row.info.mnemonic != "ANDF" && row.info.mnemonic != "ORF" && row.info.mnemonic != "SUB";
  line(hasName && chance(40) ? std::string(row.info.mnemonic) : fmt::format("SUB {}", row.info.number));
  const std::vector<std::string> example = linesOf(row.info.example);
  auto at = std::ranges::find_if(example, [](const std::string& text) { return text.starts_with("SUB "); });
  const auto operands = row.info.operands.all();
  for (size_t i = 0; ++at != example.end() && !at->starts_with("WRT "); ++i)
    line(i < operands.size() && !row.hasTable ? respelled(*at, operands[i]) : *at);
  if (row.info.output == frontend::Output::Always || (row.info.output == frontend::Output::Optional && chance(50)))
    coils();
}

void ProgramGenerator::function(const std::string& mnemonic, const std::string& parameter) {
  line(fmt::format("SUB {}", rowNamed(mnemonic).info.number));
  if (!parameter.empty()) line(parameter);
}

void ProgramGenerator::region() {
  const bool com = chance(50);
  bool& inside = com ? inCom_ : inJmp_;
  if (inside || inCom_) return network();
  inside = true;
  logic(1);
  function(com ? "COM" : "JMP", "0");
  for (uint32_t i = below(4); i > 0; --i) network();
  function(com ? "COME" : "JMPE");
  inside = false;
}

void ProgramGenerator::jump() {
  const std::string label = fmt::format("L{:0{}}", ++label_, 1 + below(4));
  logic(1);
  function("JMPB", label);
  for (uint32_t i = below(3); i > 0; --i) network();
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
    if (row.info.number >= 0 && row.control == Control::Plain && row.built) return function(row);
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
  const bool hasSections = chance(70);
  if (hasSections && chance(70)) symbols();
  if (hasSections) text_ += "%@3\n";
  const uint32_t last = below(4);
  for (uint32_t i = 1; i <= last; ++i) subprograms_.push_back(i);
  unit(below(4));
  function("END1");
  unit(below(12));
  function("END2");
  if (chance(30)) {
    unit(below(4));
    function("END3");
  }
  for (uint32_t i = 1; i <= last; ++i) {
    subprograms_.erase(subprograms_.begin());
    between();
    function("SP", fmt::format("P{:0{}}", i, 1 + below(3)));
    unit(below(4));
    function("SPE");
  }
  function("END");
  if (hasSections) text_ += "%\n";
  return std::move(text_);
}

} // namespace rung::frontend::fanuc::test
