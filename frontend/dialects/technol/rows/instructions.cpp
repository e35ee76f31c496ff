// The instruction table (see instructions.h): the rows of all chapters in one list, and look-up functions. Mnemonics,
// operands and lines of the manual correspond to tests/unit/technol/instructions.csv.
#include "frontend/dialects/technol/rows/instructions.h"

#include <algorithm>

#include "frontend/dialects/technol/rows/foreign_words.h"
#include "frontend/dialects/technol/rows/rows_bit.h"
#include "frontend/dialects/technol/rows/rows_data.h"
#include "frontend/dialects/technol/rows/rows_mechanism.h"
#include "frontend/dialects/technol/rows/rows_message.h"
#include "frontend/dialects/technol/rows/rows_nc.h"
#include "frontend/dialects/technol/rows/rows_service.h"
#include "frontend/dialects/technol/rows/rows_structure.h"
#include "frontend/dialects/technol/rows/rows_text.h"
#include "frontend/dialects/technol/rows/rows_timing.h"
#include "frontend/table/rows.h"
#include "rtlib/text/letters.h"

namespace rung::frontend::technol {
namespace {

constexpr auto kRows = joinRows(kStructureRows, kBitRows, kDataRows, kTimingRows, kMechanismRows, kTextRows,
                                kMessageRows, kNcRows, kServiceRows);
constexpr auto kInfos = infosOf(kRows);
constexpr auto kByName = orderOf(kRows, kMnemonicOf);

static_assert(rowsAreComplete<kRows>());
static_assert(everyRowHas(kRows, &InstructionInfo::example), "every row has an example");
static_assert(everyRow(kRows, [](const Row& row) { return row.role != Role::Code || row.lower != nullptr; }),
              "every row of code has a lowering function");

constexpr std::string_view kRegisters[] = {"BX", "CX",  "AX",  "AH",  "DX", "SI",
                                           "DI", "ECX", "EDX", "RLO", "DR", "DR_REAL"};

// Instructions of the 80386 and its coprocessor; all but MOV BX,CX, CLI and STI are unsupported.
constexpr std::string_view kAssembler[] = {
    "AAA",     "AAD",     "AAM",     "AAS",     "ADC",     "ADD",     "AND",    "ARPL",   "BOUND",   "BSF",    "BSR",
    "BT",      "BTC",     "BTR",     "BTS",     "CALL",    "CBW",     "CDQ",    "CLC",    "CLD",     "CLTS",   "CMC",
    "CMP",     "CMPSB",   "CMPSD",   "CMPSW",   "CWD",     "CWDE",    "DAA",    "DAS",    "DEC",     "DIV",    "ENTER",
    "ESC",     "F2XM1",   "FABS",    "FADD",    "FADDP",   "FBLD",    "FBSTP",  "FCHS",   "FCLEX",   "FCOM",   "FCOMP",
    "FCOMPP",  "FCOS",    "FDECSTP", "FDIV",    "FDIVP",   "FDIVR",   "FDIVRP", "FFREE",  "FIADD",   "FICOM",  "FICOMP",
    "FIDIV",   "FIDIVR",  "FILD",    "FIMUL",   "FINCSTP", "FINIT",   "FIST",   "FISTP",  "FISUB",   "FISUBR", "FLD",
    "FLD1",    "FLDCW",   "FLDENV",  "FLDL2E",  "FLDL2T",  "FLDLG2",  "FLDLN2", "FLDPI",  "FLDZ",    "FMUL",   "FMULP",
    "FNCLEX",  "FNINIT",  "FNOP",    "FNSAVE",  "FNSTCW",  "FNSTENV", "FNSTSW", "FPATAN", "FPREM",   "FPREM1", "FPTAN",
    "FRNDINT", "FRSTOR",  "FSAVE",   "FSCALE",  "FSIN",    "FSINCOS", "FSQRT",  "FST",    "FSTCW",   "FSTENV", "FSTP",
    "FSTSW",   "FSUB",    "FSUBP",   "FSUBR",   "FSUBRP",  "FTST",    "FUCOM",  "FUCOMP", "FUCOMPP", "FWAIT",  "FXAM",
    "FXCH",    "FXTRACT", "FYL2X",   "FYL2XP1", "HLT",     "IDIV",    "IMUL",   "IN",     "INC",     "INSB",   "INSD",
    "INSW",    "INT",     "INTO",    "IRET",    "IRETD",   "JA",      "JAE",    "JB",     "JBE",     "JC",     "JCXZ",
    "JE",      "JECXZ",   "JG",      "JGE",     "JL",      "JLE",     "JMP",    "JNA",    "JNAE",    "JNB",    "JNBE",
    "JNC",     "JNE",     "JNG",     "JNGE",    "JNL",     "JNLE",    "JNO",    "JNP",    "JNS",     "JNZ",    "JO",
    "JP",      "JPE",     "JPO",     "JS",      "JZ",      "LAHF",    "LAR",    "LDS",    "LEA",     "LEAVE",  "LES",
    "LFS",     "LGDT",    "LGS",     "LIDT",    "LLDT",    "LMSW",    "LOCK",   "LODSB",  "LODSD",   "LODSW",  "LOOP",
    "LOOPE",   "LOOPNE",  "LOOPNZ",  "LOOPZ",   "LSL",     "LSS",     "LTR",    "MOVSB",  "MOVSD",   "MOVSW",  "MOVSX",
    "MOVZX",   "MUL",     "NEG",     "NOP",     "NOT",     "OR",      "OUT",    "OUTSB",  "OUTSD",   "OUTSW",  "POP",
    "POPA",    "POPAD",   "POPF",    "POPFD",   "PUSH",    "PUSHA",   "PUSHAD", "PUSHF",  "PUSHFD",  "RCL",    "RCR",
    "REP",     "REPE",    "REPNE",   "REPNZ",   "REPZ",    "RET",     "RETF",   "RETN",   "ROL",     "ROR",    "SAHF",
    "SAL",     "SAR",     "SBB",     "SCASB",   "SCASD",   "SCASW",   "SETA",   "SETAE",  "SETB",    "SETBE",  "SETC",
    "SETE",    "SETG",    "SETGE",   "SETL",    "SETLE",   "SETNA",   "SETNAE", "SETNB",  "SETNBE",  "SETNC",  "SETNE",
    "SETNG",   "SETNGE",  "SETNL",   "SETNLE",  "SETNO",   "SETNP",   "SETNS",  "SETNZ",  "SETO",    "SETP",   "SETPE",
    "SETPO",   "SETS",    "SETZ",    "SGDT",    "SHL",     "SHLD",    "SHR",    "SHRD",   "SIDT",    "SLDT",   "SMSW",
    "STC",     "STD",     "STOSB",   "STOSD",   "STOSW",   "SUB",     "TEST",   "VERR",   "VERW",    "WAIT",   "XCHG",
    "XLAT",    "XLATB",   "XOR",
};

template <size_t N>
bool isOneOf(std::string_view name, const std::string_view (&list)[N]) {
  return std::any_of(std::begin(list), std::end(list),
                     [&](std::string_view item) { return text::equalsIgnoringCase(name, item); });
}

} // namespace

std::span<const Row> allRows() { return kRows; }
std::span<const InstructionInfo* const> instructionInfos() { return kInfos; }

const Row* findRow(std::string_view mnemonic) {
  const auto at = std::lower_bound(kByName.begin(), kByName.end(), mnemonic, [](uint16_t row, std::string_view name) {
    return text::compareIgnoringCase(name, kRows[row].info.mnemonic) > 0;
  });
  if (at != kByName.end() && text::compareIgnoringCase(mnemonic, kRows[*at].info.mnemonic) == 0) return &kRows[*at];
  const auto alias = std::ranges::find_if(
      kRows, [&](const Row& row) { return isAlias(row.info, mnemonic, text::equalsIgnoringCase); });
  return alias == std::end(kRows) ? nullptr : &*alias;
}

// The words of chapters 3-5, 7 and 22 are reserved; the others are names in examples of the manual (man. l.12300).
Reserved reservedWord(std::string_view name) {
  if (isOneOf(name, kRegisters)) return Reserved::Yes;
  const Row* row = findRow(name);
  if (row == nullptr) return Reserved::No;
  const std::string_view chapter = row->info.ref.substr(0, row->info.ref.find('.'));
  const bool core = chapter == "3" || chapter == "4" || chapter == "5" || chapter == "7" || chapter == "22";
  return core ? Reserved::Yes : Reserved::Warn;
}

bool isAssembler(std::string_view name) { return isOneOf(name, kAssembler); }

const ForeignWord* foreignWord(std::string_view word) { return findForeign(kForeignWords, word); }

std::string_view moduleName(ModuleKind kind) {
  for (const Row& row : kRows)
    if (row.role == Role::Module && row.variant == static_cast<int>(kind)) return row.info.mnemonic;
  return {};
}

} // namespace rung::frontend::technol
