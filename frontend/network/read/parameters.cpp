// Checks the parameters of function commands against the instruction table.
#include <algorithm>

#include <fmt/format.h>

#include "frontend/network/read/network_builder.h"
#include "ir/support/diag/operand.h"
#include "ir/support/diag/pmc.h"
#include "rtlib/text/letters.h"

namespace rung::frontend::network {
namespace {

using frontend::Access;
using frontend::OperandInfo;

// The value of a literal constant or of a `const` name.
std::optional<int64_t> constantWord(Context& context, const Word& word, std::string_view expected) {
  if (const uint32_t index = context.names.use(word, UserName::Kind::Constant); index != frontend::kNoName)
    return context.names[index].bad ? std::nullopt : std::optional(context.names[index].value);
  const auto value = parseConstant(context.language, word.text);
  if (!value) unknownOperand(context, word, UserName::Kind::Constant, expected);
  return value;
}

bool isConstantWord(const Context& context, const Word& word) {
  if (parseConstant(context.language, word.text)) return true;
  const uint32_t index = context.names.find(word.text);
  return index != frontend::kNoName && context.names[index].kind == UserName::Kind::Constant;
}

// Whether a constant fits into `length` bytes, written signed or unsigned (§6.4).
bool fits(int64_t value, uint32_t length) {
  const uint32_t bits = length * 8;
  return value >= -(int64_t{1} << (bits - 1)) && value < (int64_t{1} << bits);
}

// Whether the operand is one number; the cells of a block or table may have names of their own.
bool isVariable(const OperandKind& kind) {
  const bool isNumber =
      kind.length == Length::OfKind || kind.length == Length::OfFormat || kind.length == Length::OfDigits;
  return isNumber && !kind.rest;
}

class ParameterCheck {
public:
  ParameterCheck(Context& context, Network& network)
      : context_(context), network_(network), function_(network.function) {}

  bool check(const std::vector<Word>& words);
  bool checkTable(const std::vector<Word>& rows, bool capacityKnown);

private:
  bool lost(const Word& word, const Param& param);
  bool checkOne(const OperandInfo& info, const Word& word, Param& param);
  bool checkFormat(const Word& word, Param& param);
  bool checkNumber(const OperandInfo& info, const Word& word, Param& param);
  bool checkConstant(const Word& word, Param& param);
  bool checkRow(const Word& word, Param& param);
  bool checkBounds(const OperandInfo& info, const Word& word, const Param& param);
  bool checkMask(const Word& word, Param& param);
  std::optional<uint64_t> numberedWord(const Word& word, char letter);
  bool checkNamed(const OperandInfo& info, const Word& word, Param& param);
  bool checkValue(const OperandInfo& info, const Word& word, Param& param);
  bool checkPlace(const Word& word, const OperandKind& kind);
  bool checkAddress(const OperandInfo& info, const Word& word, Param& param);
  void noteSibling(DiagBuilder& report, size_t parameters) const;
  std::optional<bool> conditionOf(int8_t index) const;
  Access accessOf(const OperandInfo& info) const;
  uint32_t digitBytes() const { return conditionOf(function_.row->wide) == false ? 1 : 2; }
  uint32_t lengthOf(const OperandKind& kind) const;
  int64_t mostOf(const OperandInfo& info) const;
  std::string expectedBy(const OperandKind* kind, std::string_view expected) const;

  Context& context_;
  const Network& network_; // with its conditions
  Function& function_;
  bool lengthKnown_ = true;
  bool constantOperand_ = false;
  uint32_t blockLength_ = 1;
};

// Of a condition of the function that never changes.
std::optional<bool> ParameterCheck::conditionOf(int8_t index) const {
  if (index < 0) return std::nullopt;
  return constantCondition(context_.language, network_, static_cast<size_t>(index));
}

// Of a table and the data beside it, one is only read and the other one only written if the direction never changes.
Access ParameterCheck::accessOf(const OperandInfo& info) const {
  const std::optional<bool> writes = conditionOf(function_.row->direction);
  if (info.access != Access::ReadWrite || !writes) return info.access;
  const auto operands = function_.row->info.operands.all();
  const bool isTable = &info == &*std::ranges::find(operands, Access::ReadWrite, &OperandInfo::access);
  return isTable == *writes ? Access::Write : Access::Read;
}

uint32_t ParameterCheck::lengthOf(const OperandKind& kind) const {
  switch (kind.length) {
  case Length::OfKind: return kind.bytes;
  case Length::OfFormat: return lengthKnown_ ? function_.length : 1;
  case Length::OfElements: return lengthKnown_ ? function_.length * function_.count : 1;
  case Length::OfCount: return lengthKnown_ ? function_.count : 1;
  case Length::OfNumber: return blockLength_;
  case Length::OfRow: return function_.row->recordBytes;
  case Length::OfDigits: return digitBytes();
  case Length::OfDigitTable: return digitBytes() * blockLength_;
  }
  return 1;
}

// The control may have fewer than the language.
int64_t ParameterCheck::mostOf(const OperandInfo& info) const {
  const Language& language = context_.language;
  const Row& row = *function_.row;
  if (&info != row.info.operands.all().data()) return info.max; // only the first operand is a number of an instruction
  if (const auto& [area, first, bytes] = row.places; bytes != 0)
    return std::min<int64_t>(info.max, language.at(area).room(first) / bytes);
  return language.mostNumber == nullptr ? info.max : std::min(info.max, language.mostNumber(language, row));
}

// Checks a format: `1`, `2` or `4` with any leading zeros; a00n has exactly four digits (P20).
bool ParameterCheck::checkFormat(const Word& word, Param& param) {
  const bool selects = param.kind->selects, counts = param.kind->counts;
  const auto digits = parseDigits(word.text);
  const uint64_t value = digits.value_or(0);
  const uint64_t length = counts ? value % 10 : value;
  if (param.kind->chooses && digits && value <= 1) {
    constantOperand_ = value == 0;
    function_.length = 2;
    param.value = static_cast<int64_t>(value);
    return true;
  }
  const bool hasLength = (length == 1 || length == 2 || length == 4) && !param.kind->chooses;
  const bool constant = hasLength && value < 1000;
  const bool address = selects && word.text.size() == 4 && (value == 1001 || value == 1002 || value == 1004);
  const bool tooLong = (selects || counts) && word.text.size() > 4;
  if ((!constant && !address) || tooLong) {
    context_.diagnostics.report(diag::BadFormat, word.range) << word.text << function_.row->info.mnemonic;
    lengthKnown_ = false;
    return false;
  }
  param.value = static_cast<int64_t>(value);
  function_.length = static_cast<uint32_t>(counts ? length : value % 1000);
  function_.count = static_cast<uint32_t>(counts ? std::max<uint64_t>(value / 10, 1) : 1);
  constantOperand_ = constant;
  return true;
}

bool ParameterCheck::checkNumber(const OperandInfo& info, const Word& word, Param& param) {
  const auto number =
      constantWord(context_, word, info.doc.empty() ? "a number" : fmt::format("a number ({})", info.doc));
  if (!number) return false;
  param.value = *number;
  const int64_t most = mostOf(info);
  if (param.value < info.min || param.value > most) {
    DiagBuilder report = context_.diagnostics.report(diag::ParameterOutOfRange, word.range);
    report << word.text << fmt::format("{} to {}", info.min, most) << function_.row->info.mnemonic;
    if (info.min == info.max) report.note(info.doc);
    return false;
  }
  blockLength_ = static_cast<uint32_t>(param.value);
  return true;
}

// Adds to `expected` why the format asks for a constant or an address. `kind` is null for the row of a table.
std::string ParameterCheck::expectedBy(const OperandKind* kind, std::string_view expected) const {
  if (kind == nullptr || !kind->constant || !kind->address || kind->either) return std::string(expected);
  const auto format = [&](bool address) { return fmt::format("{}00{}", address ? 1 : 0, function_.length); };
  return fmt::format("{}, which the format {} asks for; {} asks for {}", expected, format(!constantOperand_),
                     format(constantOperand_), constantOperand_ ? "an address" : "a constant");
}

// Of a constant for which the row has bounds.
bool ParameterCheck::checkBounds(const OperandInfo& info, const Word& word, const Param& param) {
  if (info.min > info.max || (param.value >= info.min && param.value <= info.max)) return true;
  context_.diagnostics.report(diag::ParameterOutOfRange, word.range)
      << word.text << fmt::format("{} to {}", info.min, info.max) << function_.row->info.mnemonic;
  return false;
}

bool ParameterCheck::checkConstant(const Word& word, Param& param) {
  const auto constant = constantWord(context_, word, expectedBy(param.kind, "a constant"));
  if (!constant) return false;
  param.value = *constant;
  const bool either = param.kind != nullptr && param.kind->either;
  const uint32_t length = either ? param.kind->bytes : function_.length;
  if (!lengthKnown_ || fits(param.value, length)) return true;
  if (context_.language.cutsConstants) {
    context_.diagnostics.report(diag::ConstantCut, word.range)
        << word.text << fmt::format("{} byte{}", length, length == 1 ? "" : "s");
    return true;
  }
  const uint32_t bits = length * 8;
  context_.diagnostics.report(diag::ConstantOutOfRange, word.range)
      << word.text << fmt::format("{} to {}", -(int64_t{1} << (bits - 1)), (int64_t{1} << bits) - 1);
  return false;
}

bool ParameterCheck::checkMask(const Word& word, Param& param) {
  const auto isBinary = [](char c) { return c == '0' || c == '1'; };
  std::string_view digits = word.text;
  while (param.kind->digits < 4 && digits.size() > 4 && digits[0] == '0') digits.remove_prefix(1);
  const bool hasDigits = digits.size() <= 4 && digits.size() >= param.kind->digits;
  if (!hasDigits || !std::ranges::all_of(digits, isBinary)) {
    context_.diagnostics.report(diag::BadMask, word.range) << word.text;
    return false;
  }
  for (char c : digits) param.value = param.value * 2 + (c - '0');
  return true;
}

// The number of a label or a subprogram, written as P5 or by its name.
std::optional<uint64_t> ParameterCheck::numberedWord(const Word& word, char letter) {
  if (word.text.empty()) return std::nullopt;
  if (text::upper(word.text[0]) == letter)
    if (const auto number = parseDigits(word.text.substr(1))) return number;
  const uint32_t index = context_.names.use(word, UserName::Kind::Numbered);
  if (index == frontend::kNoName || context_.names[index].text[0] != letter) return std::nullopt;
  return static_cast<uint64_t>(context_.names[index].value);
}

// Checks the number of a label or subprogram. Number 0 occurs at two places of the manual and is accepted (P2).
bool ParameterCheck::checkNamed(const OperandInfo& info, const Word& word, Param& param) {
  const std::string_view letter = param.kind->written.substr(0, 1);
  const auto number = numberedWord(word, letter[0]);
  if (!number && context_.language.undeclared != diag::BadOperand) {
    unknownOperand(context_, word, UserName::Kind::Numbered, fmt::format("a {} such as {}1", param.kind->name, letter));
    return false;
  }
  if (!number) {
    context_.diagnostics.report(diag::BadOperand, word.range)
        << word.text << fmt::format("a {} such as {}1", param.kind->name, letter);
    return false;
  }
  param.value = static_cast<int64_t>(*number);
  if (param.value > mostOf(info)) {
    context_.diagnostics.report(diag::ParameterOutOfRange, word.range)
        << word.text
        << (mostOf(info) == 0 ? "what this control has: none"
                              : fmt::format("{0}{1}-{0}{2}", letter, info.min, mostOf(info)))
        << function_.row->info.mnemonic;
    return false;
  }
  if (param.value == 0) context_.diagnostics.report(diag::LabelZero, word.range) << info.doc;
  const Control control = function_.row->control;
  context_.analysis.use({.range = word.range,
                         .scope = letter,
                         .number = static_cast<uint32_t>(param.value),
                         .defines = control == Control::Lbl || control == Control::Sp});
  return true;
}

// Checks the area of an operand whose kind requires one, whatever its length.
bool ParameterCheck::checkPlace(const Word& word, const OperandKind& kind) {
  if (!kind.area) return true;
  const auto first = byteOperand(context_, word, 1);
  if (!first) return false;
  if (first->area == *kind.area) return true;
  context_.diagnostics.report(kind.elsewhere, word.range) << word.text;
  return false;
}

bool ParameterCheck::checkAddress(const OperandInfo& info, const Word& word, Param& param) {
  if (!checkPlace(word, *param.kind)) return false;
  const uint32_t most = lengthOf(*param.kind), least = param.kind->least == 0 ? most : param.kind->least;
  const auto address = byteOperand(context_, word, least, expectedBy(param.kind, kByteAddress));
  if (!address) return false;
  const uint32_t length = std::min(most, context_.language.at(address->area).room(address->byte));
  param.isAddress = true;
  param.address = *address;
  param.access = accessOf(info);
  context_.analysis.use({.range = word.range,
                         .base = address->name,
                         .place = placeOf(context_.language, *address, length),
                         .access = param.access,
                         .isVariable = isVariable(*param.kind)});
  param.bytes = param.kind->rest ? context_.language.at(address->area).room(address->byte) : length;
  const uint32_t written = function_.row->direction < 0 ? length : param.bytes;
  return param.access == Access::Read || checkWritable(context_, *address, written, word.range);
}

// Whether the operand was already rejected where it was read; its range is then invalid.
bool ParameterCheck::lost(const Word& word, const Param& param) {
  if (word.range.valid()) return false;
  if (param.kind->parse == OperandClass::Format) lengthKnown_ = false;
  return true;
}

bool ParameterCheck::checkValue(const OperandInfo& info, const Word& word, Param& param) {
  const OperandKind& kind = *param.kind;
  if (kind.constant && kind.address && !kind.either && !lengthKnown_)
    return false; // the format, which decides, is not known
  const bool selected = kind.either ? isConstantWord(context_, word) : !kind.address || constantOperand_;
  const bool isConstant = kind.constant && selected;
  return isConstant ? checkConstant(word, param) && checkBounds(info, word, param) : checkAddress(info, word, param);
}

bool ParameterCheck::checkOne(const OperandInfo& info, const Word& word, Param& param) {
  switch (param.kind->parse) {
  case OperandClass::Value: return checkValue(info, word, param);
  case OperandClass::Number: return checkNumber(info, word, param);
  case OperandClass::Mask: return checkMask(word, param);
  case OperandClass::Named: return checkNamed(info, word, param);
  case OperandClass::Format: return checkFormat(word, param);
  }
  return false;
}

// Mentions the variant of a timer or counter with its preset elsewhere, which takes this number of parameters.
void ParameterCheck::noteSibling(DiagBuilder& report, size_t parameters) const {
  const frontend::InstructionInfo& info = function_.row->info;
  const auto& rows = context_.language.rows;
  const auto sibling = std::ranges::find_if(
      rows, [&](const Row* row) { return row->info.group == info.group && row->info.operands.size() == parameters; });
  if (function_.row->numbers == Row::Numbers::Free || parameters <= info.operands.size() || sibling == rows.end())
    return;
  report.note(
      fmt::format("{}: {}; {}: {}", info.mnemonic, info.title, (*sibling)->info.mnemonic, (*sibling)->info.title));
}

bool ParameterCheck::check(const std::vector<Word>& words) {
  const auto operands = function_.row->info.operands.all();
  if (words.size() != operands.size()) { // it is unknown which parameter is missing
    DiagBuilder report = context_.diagnostics.report(diag::WrongParameterCount, function_.range);
    report << function_.row->info.mnemonic << operands.size() << words.size();
    std::string names;
    for (const OperandInfo& operand : operands) names += fmt::format("{}{}", names.empty() ? " " : ", ", operand.name);
    if (!names.empty()) report.note(fmt::format("its parameters in order:{}", names));
    noteSibling(report, words.size());
    return false;
  }
  bool good = true;
  for (size_t i = 0; i < words.size(); ++i) {
    Param param{.kind = &kindOf(operands[i]), .range = words[i].range};
    param.bad = lost(words[i], param) || !checkOne(operands[i], words[i], param);
    good = good && !param.bad;
    function_.params.push_back(param);
  }
  return good;
}

bool ParameterCheck::checkRow(const Word& word, Param& param) {
  const int64_t most = function_.row->mostRow;
  if (most < 0) return checkConstant(word, param);
  const auto constant = constantWord(context_, word, "a constant");
  if (!constant) return false;
  param.value = *constant;
  if (param.value >= 0 && param.value <= most) return true;
  context_.diagnostics.report(diag::ConstantOutOfRange, word.range) << word.text << fmt::format("0 to {}", most);
  return false;
}

bool ParameterCheck::checkTable(const std::vector<Word>& rows, bool capacityKnown) {
  bool good = true;
  for (const Word& row : rows) {
    Param param;
    good = row.range.valid() && checkRow(row, param) && good;
    function_.table.push_back(param.value);
  }
  if (!capacityKnown) return false;
  const int64_t given = function_.params[function_.row->capacityAt].value;
  const int64_t capacity = given == 0 ? 100 : given;
  if (static_cast<int64_t>(rows.size()) == capacity) return good;
  context_.diagnostics.report(diag::TableSizeMismatch, function_.range)
      << (rows.size() == 1 ? "1 row" : fmt::format("{} rows", rows.size())) << capacity;
  return false;
}

} // namespace

bool checkFunction(Context& context, const std::vector<Word>& parameters, const std::vector<Word>& table,
                   Network& network) {
  ParameterCheck check(context, network);
  const bool good = check.check(parameters);
  return network.function.row->hasTable ? check.checkTable(table, good) : good;
}

} // namespace rung::frontend::network
