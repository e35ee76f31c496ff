// Parses operands (see operand_parser.h).
#include "frontend/dialects/nct/read/operand_parser.h"

#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "frontend/dialects/nct/rows/instructions.h"
#include "frontend/ladder/text/fix.h"
#include "frontend/sema/foreign_word.h"
#include "ir/support/diag/nct.h"
#include "ir/support/diag/operand.h"
#include "ir/support/meant.h"
#include "rtlib/nc/nct/scope_symbols.h"
#include "rtlib/text/letters.h"
#include "rtlib/text/number.h"

namespace rung::frontend::nct {
namespace {

constexpr std::string_view kDecimalRange = "-2147483648 to 2147483647";
constexpr std::string_view kHexRange = "0 to FFFFFFFF";
constexpr std::string_view kRealRange = "the range of a double";

bool allDigits(std::string_view text) { return !text.empty() && std::ranges::all_of(text, text::isDigit); }

bool allHex(std::string_view text) {
  return !text.empty() && std::ranges::all_of(text, [](char c) { return text::hexDigit(c) >= 0; });
}

// Whether the text is a number, with or without a sign, but without the mark of a constant.
bool isDecimalNumber(std::string_view text) {
  if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
  return allDigits(text);
}
bool isRealNumber(std::string_view text) {
  if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
  const size_t point = text.find('.');
  return point != std::string_view::npos && allDigits(text.substr(0, point)) && allDigits(text.substr(point + 1));
}

// A number with too many digits exceeds every range.
int64_t decimalValue(std::string_view digits) { return text::numberIn<int64_t>(digits).value_or(INT64_MAX); }

// Whether the text is a hexadecimal constant without its $, such as #1F. #0b101 is not: it has a base of its own.
bool isOwnHex(std::string_view text) {
  return text.starts_with('#') && allHex(text.substr(1)) && !frontend::foreignNumber(text.substr(1));
}

// The value of #b101, which may be a binary number or mean #$B101.
std::optional<uint32_t> bitsAfterB(std::string_view text) {
  if (text.size() < 3 || text[0] != '#' || text::upper(text[1]) != 'B') return std::nullopt;
  return text::numberIn<uint32_t>(text.substr(2), 2);
}

constexpr char kHexConstant[] = "a hexadecimal constant is written #${}";

// Explains that a time is two operands of a timer.
std::string timeNote(const frontend::ForeignTime& time) {
  return fmt::format("a timer takes a time as two operands, a number and its unit (#0 ms, #1 s, #2 min, #3 h): #{} #{}",
                     time.amount, static_cast<int>(time.unit));
}

// Writes a constant of another language as a constant of this one.
std::string comparedOperand(std::string_view text) {
  if (isDecimalNumber(text)) return fmt::format("#{}", text);
  return isRealNumber(text) ? fmt::format("*{}", text) : std::string(text);
}

// Reports [x>5]: comparisons are boxes before the coil.
void reportComparison(Diagnostics& diagnostics, const Word& word, const frontend::ForeignComparison& comparison) {
  const std::string right = comparedOperand(comparison.right);
  const frontend::ForeignWord* box = frontend::findForeign(foreignWords(), comparison.word);
  const std::string_view integers = box->here;
  const std::string_view mnemonic = right.starts_with('*') ? doublesOf(integers) : integers;
  DiagBuilder report = diagnostics.report(diag::BadOperand, word.range);
  report << word.text << "a bit or a word";
  report.note(fmt::format("a comparison is a box: {{{} {} {}}}", mnemonic, comparison.left, right));
}

struct ConstantReader {
  const Word& word;
  std::string_view text;
  const SourceManager& sources;
  Diagnostics& diagnostics;

  std::optional<Constant> malformed() {
    DiagBuilder report = diagnostics.report(diag::ConstantFormat, rangeOf(word, text));
    report << text;
    std::string fixed(text);
    std::ranges::replace(fixed, ',', '.');
    if (text.starts_with('*') && fixed.find('.') == fixed.rfind('.')) {
      if (fixed != text) report.note("the decimal sign is a point: " + fixed);
      if (text.size() > 1 && allDigits(text.substr(1))) report.note("write " + fixed + ".0");
    }
    const bool isReal = text.starts_with('#') && text.find('.') != std::string_view::npos;
    if (isReal && !frontend::foreignTime(text.substr(1)))
      report.note("'#' begins an integer; a real number is written *" + std::string(text.substr(1)));
    else if (text.starts_with('#'))
      noteConstant(report, isOwnHex(text) ? text : text.substr(1), sources, rangeOf(word, text));
    return std::nullopt;
  }

  std::optional<Constant> tooLarge(std::string_view range) {
    diagnostics.report(diag::ConstantOutOfRange, rangeOf(word, text)) << text << range;
    return std::nullopt;
  }

  std::optional<Constant> decimal(std::string_view digits) {
    const bool negative = digits.starts_with('-'); // no '+', l.608
    if (negative) digits.remove_prefix(1);
    if (!allDigits(digits)) return malformed();
    const int64_t value = negative ? -decimalValue(digits) : decimalValue(digits);
    if (value < INT32_MIN || value > INT32_MAX) return tooLarge(kDecimalRange);
    return Constant{.kind = ConstantKind::Decimal, .integer = value, .real = 0};
  }

  std::optional<Constant> hexadecimal(std::string_view digits) {
    if (!allHex(digits)) return malformed();
    const auto value = text::numberIn<uint32_t>(digits, 16);
    if (!value) return tooLarge(kHexRange);
    return Constant{.kind = ConstantKind::Hex, .integer = static_cast<int32_t>(*value), .real = 0};
  }

  // The decimal point is required, exponents are not allowed (l.660).
  std::optional<Constant> real(std::string_view digits) {
    const bool negative = digits.starts_with('-');
    if (negative || digits.starts_with('+')) digits.remove_prefix(1);
    const size_t point = digits.find('.');
    if (point == std::string_view::npos || digits.size() < 2) return malformed();
    for (size_t i = 0; i < digits.size(); ++i)
      if (i != point && !text::isDigit(digits[i])) return malformed();
    const std::string padded = "0" + std::string(digits) + "0"; // ensures a digit on both sides of the point
    const auto value = text::realIn(padded);
    if (!value) return tooLarge(kRealRange);
    return Constant{.kind = ConstantKind::Real, .integer = 0, .real = negative ? -*value : *value};
  }
};

class AddressReader {
public:
  AddressReader(const Word& word, Symbols& symbols, Diagnostics& diagnostics)
      : word_(word), symbols_(symbols), diagnostics_(diagnostics) {}

  std::optional<ParsedAddress> read(std::string_view text) {
    const size_t comma = text.find(',');
    const std::string_view place = text.substr(0, comma);
    const size_t mark = place.find_first_of(".:");
    const std::string_view base = place.substr(0, mark);
    const bool ok = readBase(base, mark != std::string_view::npos) &&
                    (mark == std::string_view::npos || readBit(place[mark], place.substr(mark + 1))) &&
                    (comma == std::string_view::npos || readIndex(text.substr(comma + 1)));
    if (!ok) return std::nullopt;
    if (word64_ < 0 || word64_ >= kWords) {
      diagnostics_.report(diag::AddressOutOfRange, rangeOf(word_, text)) << text << "0000 to 9999";
      return std::nullopt;
    }
    result_.address.word = static_cast<uint32_t>(word64_);
    if (result_.base != nullptr && result_.base->signal != nullptr && comma != std::string_view::npos)
      checkElement(text);
    return result_;
  }

private:
  // Warns of a constant index that leads from one signal into another: allowed, but hardly intended (l.6438).
  void checkElement(std::string_view text) {
    const nc::Signal& signal = *result_.base->signal;
    const int64_t words = int64_t{signal.count} * signal.strideBytes / 4;
    const int64_t offset = word64_ - signal.byteOffset / 4;
    if (words < 2 || (offset >= 0 && offset < words)) return;
    diagnostics_.report(diag::SignalIndex, rangeOf(word_, text))
        << text << signal.symbol << (signal.count - 1) * signal.strideBytes / 4;
  }

  std::optional<uint32_t> number(std::string_view text) {
    if (text.size() == 4 && allDigits(text)) return static_cast<uint32_t>(decimalValue(text));
    DiagBuilder report = diagnostics_.report(diag::AddressFormat, rangeOf(word_, text));
    report << text;
    if (allDigits(text) && text.size() < 4)
      report.note("an address is written " + std::string(4 - text.size(), '0') + std::string(text) + ", a constant #" +
                  std::string(text));
    else if (allDigits(text))
      report.note("a constant is written #" + std::string(text));
    else
      noteConstant(report, text, symbols_.sources(), {});
    return std::nullopt;
  }

  const Symbol* symbol(std::string_view name) {
    if (name.empty()) {
      DiagBuilder report = diagnostics_.report(diag::AddressFormat, word_.range);
      report << word_.text;
      if (word_.text.ends_with(',')) report.note("operands are separated by blanks, without commas");
      return nullptr;
    }
    const Symbol* found = symbols_.use(name, rangeOf(word_, name));
    if (found == nullptr && !symbols_.wasRefused(name))
      symbols_.noteUndeclared({{name, rangeOf(word_, name)}, name.data() == word_.text.data() ? word_.text : ""});
    return found == nullptr || found->kind == SymbolKind::Bad ? nullptr : found;
  }

  bool mismatch(std::string_view name, SymbolKind is, std::string_view needed) {
    diagnostics_.report(diag::SymbolKindMismatch, rangeOf(word_, name)) << name << describe(is) << needed;
    return false;
  }

  bool readBase(std::string_view base, bool bitFollows) {
    if (!base.empty() && text::isDigit(base[0])) {
      const std::optional<uint32_t> n = number(base);
      word64_ = n.value_or(0);
      return n.has_value();
    }
    const Symbol* found = symbol(base);
    if (found == nullptr) return false;
    if (found->kind == SymbolKind::Constant) return mismatch(base, found->kind, "an address");
    if (found->kind == SymbolKind::Bit) {
      if (bitFollows) return mismatch(base, found->kind, "a word");
      result_.address.isBit = true;
      result_.address.bit = found->bit;
    }
    word64_ = found->word;
    result_.base = found;
    return true;
  }

  bool readBit(char mark, std::string_view text) {
    result_.address.isBit = true;
    if (mark == ':') return readRegister(text, result_.address.bitRegister);
    if (text.size() != 2 || !allDigits(text)) {
      DiagBuilder report = diagnostics_.report(diag::BitFormat, text.empty() ? word_.range : rangeOf(word_, text));
      report << text;
      if (text.size() == 1 && allDigits(text)) report.note("write .0" + std::string(text));
      if (text::equalsIgnoringCase(text, "DN") || text::equalsIgnoringCase(text, "Q"))
        report.note("a timer or counter shows that it is done by the coil after its box: {TOND ...}--(x)");
      const size_t modifier = text.find_first_of("@%!");
      if (modifier != std::string_view::npos)
        report.note("'" + std::string(1, text[modifier]) + "' is written before the operand");
      return false;
    }
    result_.address.bit = static_cast<uint32_t>(decimalValue(text));
    if (result_.address.bit < 32) return true;
    diagnostics_.report(diag::BitOutOfRange, rangeOf(word_, text)) << text;
    return false;
  }

  bool readRegister(std::string_view text, uint32_t& out) {
    if (!text.empty() && text::isDigit(text[0])) {
      const std::optional<uint32_t> n = number(text);
      out = n.value_or(0);
      return n.has_value();
    }
    const Symbol* found = symbol(text);
    if (found == nullptr) return false;
    if (found->kind != SymbolKind::Word) return mismatch(text, found->kind, "a word");
    out = found->word;
    return true;
  }

  bool readIndex(std::string_view text) {
    if (text.starts_with('#')) {
      const std::optional<Constant> constant = parseConstant(word_, text, symbols_.sources(), diagnostics_);
      if (!constant) return false;
      if (constant->kind == ConstantKind::Decimal) return constantIndex(*constant);
      diagnostics_.report(diag::ConstantFormat, rangeOf(word_, text)) << text;
      return false;
    }
    if (text.empty() || text::isDigit(text[0])) return readRegister(text, result_.address.indexRegister);
    const Symbol* found = symbol(text);
    if (found == nullptr) return false;
    if (found->kind == SymbolKind::Bit) return mismatch(text, found->kind, "a word or a constant");
    if (found->kind == SymbolKind::Constant) {
      if (found->constant.kind != ConstantKind::Real) return constantIndex(found->constant);
      diagnostics_.report(diag::OperandTypeMismatch, rangeOf(word_, text)) << text << "a double" << "an index" << "#";
      return false;
    }
    result_.address.indexRegister = found->word;
    return true;
  }

  bool constantIndex(const Constant& constant) {
    word64_ += constant.integer;
    result_.address.oddIndex = (constant.integer & 1) != 0;
    return true;
  }

  const Word& word_;
  Symbols& symbols_;
  Diagnostics& diagnostics_;
  ParsedAddress result_;
  int64_t word64_ = 0;
};

bool isConstantText(std::string_view text) { return text.starts_with('#') || text.starts_with('*'); }

// The constant that `text` names; null if it is anything else. Reports nothing.
const Symbol* constantSymbol(std::string_view text, Symbols& symbols) {
  if (text.empty() || text::isDigit(text[0]) || text.find_first_of(".:,") != std::string_view::npos) return nullptr;
  const Symbol* found = symbols.find(text);
  return found != nullptr && found->kind == SymbolKind::Constant ? found : nullptr;
}

} // namespace

SourceRange rangeOf(const Word& word, std::string_view part) {
  if (part.empty()) return word.range;
  const uint32_t begin =
      word.range.begin.value + (word.quoted ? 1 : 0) + static_cast<uint32_t>(part.data() - word.text.data());
  return {{begin}, {begin + static_cast<uint32_t>(part.size())}};
}

std::string_view describe(SymbolKind kind) {
  switch (kind) {
  case SymbolKind::Bad: return "wrong";
  case SymbolKind::Word: return "a word";
  case SymbolKind::Bit: return "a bit";
  case SymbolKind::Constant: return "a constant";
  }
  return "";
}

void noteConstant(DiagBuilder& report, std::string_view text, const SourceManager& sources, SourceRange range) {
  const std::optional<frontend::ForeignNumber> foreign = frontend::foreignNumber(text);
  const std::string_view number = text.substr(text.starts_with('+') ? 1 : 0); // constants have no '+'
  const auto fix = [&](const std::string& constant, bool fits) {
    if (range.valid() && fits) ladder::fix(report, sources, range, constant);
  };
  if (foreign && foreign->base == 16) {
    report.note(fmt::format(kHexConstant, foreign->digits));
    fix(fmt::format("#${}", foreign->digits), text::numberIn<uint32_t>(foreign->digits, 16).has_value());
  } else if (const auto binary = foreign ? text::numberIn<uint64_t>(foreign->digits, 2) : std::nullopt) {
    report.note(fmt::format("there are no binary constants; in decimal it is #{}", *binary));
    fix(fmt::format("#{}", *binary), *binary <= INT32_MAX);
  } else if (const auto bits = bitsAfterB(text)) {
    report.note(fmt::format("there are no binary constants; the bits {} are #{} in decimal", text.substr(2), *bits));
  } else if (isOwnHex(text)) {
    report.note(fmt::format(kHexConstant, text.substr(1)));
  } else if (isDecimalNumber(text)) {
    report.note(fmt::format("a constant is written #{}", number));
  } else if (isRealNumber(text)) {
    report.note(fmt::format("a real number is written *{}", number));
  } else if (const auto time = frontend::foreignTime(text)) {
    report.note(timeNote(*time));
  }
}

std::optional<Constant> parseConstant(const Word& word, std::string_view text, const SourceManager& sources,
                                      Diagnostics& diagnostics) {
  ConstantReader reader{word, text, sources, diagnostics};
  if (text.starts_with("#$")) return reader.hexadecimal(text.substr(2));
  if (text.starts_with('#')) return reader.decimal(text.substr(1));
  return reader.real(text.substr(1));
}

std::optional<ParsedAddress> parseAddress(const Word& word, std::string_view text, Symbols& symbols,
                                          Diagnostics& diagnostics) {
  return AddressReader(word, symbols, diagnostics).read(text);
}

Operand parseOperand(const Word& word, Symbols& symbols, Diagnostics& diagnostics) {
  Operand operand;
  operand.source = &word;
  if (word.quoted) {
    operand.form = Form::Text;
    return operand;
  }
  if (symbols.wasRefused(word.text)) return operand; // -K1, 1M1: its declaration has been reported
  if (const auto comparison = frontend::foreignComparison(word.text)) {
    reportComparison(diagnostics, word, *comparison);
    return operand;
  }
  std::string_view text = word.text;
  for (; !text.empty() && std::string_view("@%!").find(text[0]) != std::string_view::npos; text.remove_prefix(1)) {
    if (text[0] == '!')
      operand.address.immediate = true;
    else
      operand.edge = text[0];
  }
  if (isConstantText(text)) {
    const std::optional<Constant> constant = parseConstant(word, text, symbols.sources(), diagnostics);
    if (constant) operand.constant = *constant;
    operand.form = constant ? Form::Constant : Form::Bad;
    return operand;
  }
  if (text.starts_with('-') || text.starts_with('+') || frontend::foreignNumber(text) || frontend::foreignTime(text)) {
    DiagBuilder report = diagnostics.report(diag::ConstantFormat, rangeOf(word, text));
    report << text;
    noteConstant(report, text, symbols.sources(), rangeOf(word, text));
    if (!text::isDigit(text[0]) && text.size() > 1 && (text::isLetter(text[1]) || text[1] == '_'))
      report.note("a name begins with a letter or _; a closed contact is written [/x]");
    return operand;
  }
  operand.fromSymbol = !text.empty() && !text::isDigit(text[0]);
  if (const Symbol* named = constantSymbol(text, symbols)) {
    symbols.use(text, rangeOf(word, text));
    operand.form = Form::Constant;
    operand.constant = named->constant;
    return operand;
  }
  const std::optional<ParsedAddress> parsed = parseAddress(word, text, symbols, diagnostics);
  if (!parsed) return operand;
  const bool immediate = operand.address.immediate;
  operand.address = parsed->address;
  operand.base = parsed->base;
  operand.address.immediate = immediate;
  operand.form = parsed->address.isBit ? Form::Bit : Form::Word;
  return operand;
}

Operand parseScopeSymbol(const Word& word, Diagnostics& diagnostics) {
  Operand operand;
  operand.source = &word;
  const std::span<const nc::nct::ScopeSymbol> symbols = nc::nct::scopeSymbols();
  const auto found = std::ranges::find(symbols, word.text, &nc::nct::ScopeSymbol::name);
  if (found != symbols.end()) {
    operand.form = Form::Constant;
    operand.constant.integer = found - symbols.begin();
    return operand;
  }
  DiagBuilder report = diagnostics.report(diag::UnknownScopeSymbol, word.range);
  report << word.text;
  suggest(report, word.range, text::likeliest(word.text, symbols, &nc::nct::ScopeSymbol::name));
  return operand;
}

std::optional<uint32_t> parseLabel(const Word& word, Symbols& symbols, Diagnostics& diagnostics) {
  std::string_view digits = word.text;
  int64_t number = 0;
  if (allDigits(digits)) {
    number = decimalValue(digits);
  } else if (digits.starts_with("#") && !digits.starts_with("#$")) {
    const std::optional<Constant> constant = parseConstant(word, digits, symbols.sources(), diagnostics);
    if (!constant) return std::nullopt;
    number = constant->integer;
  } else {
    const Operand operand = parseOperand(word, symbols, diagnostics);
    if (operand.form == Form::Bad) return std::nullopt;
    if (operand.form != Form::Constant) {
      diagnostics.report(diag::SymbolKindMismatch, word.range) << word.text
                                                               << (operand.form == Form::Bit    ? "a bit"
                                                                   : operand.form == Form::Word ? "a word"
                                                                                                : "a text")
                                                               << "a label number";
      return std::nullopt;
    }
    if (operand.constant.kind != ConstantKind::Decimal) {
      diagnostics.report(diag::OperandTypeMismatch, word.range)
          << word.text << "no decimal constant" << "a label" << "#0 to #99";
      return std::nullopt;
    }
    number = operand.constant.integer;
  }
  if (number >= 0 && number <= 99) return static_cast<uint32_t>(number);
  diagnostics.report(diag::LabelOutOfRange, word.range) << word.text;
  return std::nullopt;
}

} // namespace rung::frontend::nct
