// The table (see instructions.h): the rows of all chapters in one list, and ways to find one. Mnemonics, operands and
// lines of the manual are those of instructions.csv.
#include "frontend/dialects/technol/instructions.h"

#include <algorithm>
#include <array>

#include "frontend/dialects/technol/lexer.h"
#include "frontend/dialects/technol/rows_bit.h"
#include "frontend/dialects/technol/rows_data.h"
#include "frontend/dialects/technol/rows_mechanism.h"
#include "frontend/dialects/technol/rows_message.h"
#include "frontend/dialects/technol/rows_nc.h"
#include "frontend/dialects/technol/rows_service.h"
#include "frontend/dialects/technol/rows_structure.h"
#include "frontend/dialects/technol/rows_text.h"
#include "frontend/dialects/technol/rows_timing.h"

namespace rung::frontend::technol {
namespace {

constexpr size_t kRowCount = std::size(kStructureRows) + std::size(kBitRows) + std::size(kDataRows) +
                             std::size(kTimingRows) + std::size(kMechanismRows) + std::size(kTextRows) +
                             std::size(kMessageRows) + std::size(kNcRows) + std::size(kServiceRows);

constexpr std::array<Row, kRowCount> joinRows() {
  std::array<Row, kRowCount> rows{};
  size_t n = 0;
  for (const Row& row : kStructureRows) rows[n++] = row;
  for (const Row& row : kBitRows) rows[n++] = row;
  for (const Row& row : kDataRows) rows[n++] = row;
  for (const Row& row : kTimingRows) rows[n++] = row;
  for (const Row& row : kMechanismRows) rows[n++] = row;
  for (const Row& row : kTextRows) rows[n++] = row;
  for (const Row& row : kMessageRows) rows[n++] = row;
  for (const Row& row : kNcRows) rows[n++] = row;
  for (const Row& row : kServiceRows) rows[n++] = row;
  return rows;
}
constexpr std::array<Row, kRowCount> kRows = joinRows();

constexpr auto kInfos = [] {
  std::array<const InstructionInfo*, kRowCount> infos{};
  for (size_t i = 0; i < kRowCount; ++i) infos[i] = &kRows[i].info;
  return infos;
}();

constexpr auto kByName = [] {
  std::array<uint16_t, kRowCount> order{};
  for (size_t i = 0; i < kRowCount; ++i) order[i] = static_cast<uint16_t>(i);
  std::sort(order.begin(), order.end(),
            [](uint16_t a, uint16_t b) { return kRows[a].info.mnemonic < kRows[b].info.mnemonic; });
  return order;
}();

constexpr bool rowsAreComplete() {
  for (size_t i = 0; i < kRowCount; ++i) {
    const Row& row = kRows[i];
    if (row.info.doc.empty() || row.info.ref.empty() || row.info.title.empty()) return false;
    if (row.role == Role::Code && row.lower == nullptr) return false;
    const bool built = row.role != Role::NotBuilt && row.role != Role::NotBuiltService;
    if (built && row.info.example.empty()) return false;
    if (i > 0 && kRows[kByName[i]].info.mnemonic == kRows[kByName[i - 1]].info.mnemonic) return false;
  }
  return true;
}
static_assert(
    rowsAreComplete(),
    "every row has a title, a reference and a doc, a built one an example, code its lowering; mnemonics are unique");

constexpr std::string_view kRegisters[] = {"BX", "CX",  "AX",  "AH",  "DX", "SI",
                                           "DI", "ECX", "EDX", "RLO", "DR", "DR_REAL"};

// Of the 80386; all but MOV BX,CX, CLI and STI are beyond this compiler.
constexpr std::string_view kAssembler[] = {
    "AAA",   "ADC",   "ADD",   "AND",   "BT",    "CALL",  "CBW", "CLC",  "CLD",  "CMC",  "CMP", "CWD", "DEC",  "DIV",
    "ENTER", "HLT",   "IDIV",  "IMUL",  "IN",    "INC",   "INT", "IRET", "JA",   "JAE",  "JB",  "JBE", "JC",   "JE",
    "JG",    "JGE",   "JL",    "JLE",   "JMP",   "JNC",   "JNE", "JNZ",  "JS",   "JZ",   "LDS", "LEA", "LES",  "LODSB",
    "LOOP",  "MOVSB", "MOVSW", "MOVSX", "MOVZX", "MUL",   "NEG", "NOP",  "NOT",  "OR",   "OUT", "POP", "POPA", "POPF",
    "PUSH",  "PUSHA", "PUSHF", "RCL",   "RCR",   "REP",   "RET", "ROL",  "ROR",  "SAHF", "SAL", "SAR", "SBB",  "SETC",
    "SHL",   "SHR",   "STC",   "STD",   "STOSB", "STOSW", "SUB", "TEST", "XCHG", "XLAT", "XOR",
};

template <size_t N>
bool isOneOf(std::string_view name, const std::string_view (&list)[N]) {
  return std::any_of(std::begin(list), std::end(list), [&](std::string_view item) { return equalsNoCase(name, item); });
}

int compareNoCase(std::string_view name, std::string_view upperCase) {
  const size_t common = std::min(name.size(), upperCase.size());
  for (size_t i = 0; i < common; ++i)
    if (upper(name[i]) != upperCase[i]) return upper(name[i]) < upperCase[i] ? -1 : 1;
  return name.size() == upperCase.size() ? 0 : name.size() < upperCase.size() ? -1 : 1;
}

} // namespace

std::span<const Row> allRows() { return kRows; }
std::span<const InstructionInfo* const> instructionInfos() { return kInfos; }

const Row* findRow(std::string_view mnemonic) {
  if (equalsNoCase(mnemonic, "JLO")) mnemonic = "JL0";
  const auto at = std::lower_bound(kByName.begin(), kByName.end(), mnemonic, [](uint16_t row, std::string_view name) {
    return compareNoCase(name, kRows[row].info.mnemonic) > 0;
  });
  if (at == kByName.end() || compareNoCase(mnemonic, kRows[*at].info.mnemonic) != 0) return nullptr;
  return &kRows[*at];
}

// Reserved are the words of chapters 3-5, 7 and 22; the others name symbols in examples (man. l.12300).
Reserved reservedWord(std::string_view name) {
  if (isOneOf(name, kRegisters)) return Reserved::Yes;
  const Row* row = findRow(name);
  if (row == nullptr) return Reserved::No;
  const std::string_view chapter = row->info.ref.substr(0, row->info.ref.find('.'));
  const bool core = chapter == "3" || chapter == "4" || chapter == "5" || chapter == "7" || chapter == "22";
  return core ? Reserved::Yes : Reserved::Warn;
}

bool isAssembler(std::string_view name) { return isOneOf(name, kAssembler); }

std::string_view insteadOf(std::string_view assembler) {
  struct Pair {
    std::string_view assembler, instead;
  };
  constexpr Pair kInstead[] = {
      {"ADD", "AD"},
      {"AND", "ANDB"},
      {"BT", "LDR"},
      {"CALL", "PROC_CALL"},
      {"CMP", "EQ, LT, GT, LE, GE"},
      {"DEC", "DCR"},
      {"DIV", "DIVB"},
      {"IDIV", "DIVB"},
      {"IMUL", "MULB"},
      {"INC", "INR"},
      {"JE", "EQ and JL1"},
      {"JMP", "JUM"},
      {"JNE", "EQ and JL0"},
      {"JNZ", "LDR and JL1"},
      {"JZ", "LDR and JL0"},
      {"MOVSB", "MV"},
      {"MOVSW", "MV"},
      {"MOVSX", "LOD"},
      {"MOVZX", "LOD"},
      {"MUL", "MULB"},
      {"NEG", "INV"},
      {"OR", "ORB"},
      {"RET", "PROC_END"},
      {"SHL", "RL"},
      {"SHR", "RR"},
      {"SUB", "SU"},
      {"TEST", "LDR"},
      {"XCHG", "LOD and STO"},
      {"XOR", "XORB"},
  };
  for (const Pair& pair : kInstead)
    if (equalsNoCase(assembler, pair.assembler)) return pair.instead;
  return {};
}

std::string_view moduleName(ModuleKind kind) {
  for (const Row& row : kRows)
    if (row.role == Role::Module && row.variant == static_cast<int>(kind)) return row.info.mnemonic;
  return {};
}

} // namespace rung::frontend::technol
