// User instructions (see macros.h).
#include "frontend/dialects/technol/read/macros.h"

#include <algorithm>

#include "frontend/sema/operand_count.h"
#include "ir/support/diag/operand.h"
#include "ir/support/diag/technol.h"
#include "rtlib/text/letters.h"

namespace rung::frontend::technol {
namespace {

struct FlagName {
  std::string_view name;
  bool isStack;
  MacroStack stack;
};
// C_x and D_x only affect the control's own compiler and its debugger.
constexpr FlagName kFlags[] = {
    {"T_NORMAL", true, MacroStack::Normal},
    {"T_BEGIN", true, MacroStack::Begin},
    {"T_END", true, MacroStack::End},
    {"T_PUSH", true, MacroStack::Push},
    {"T_POP", true, MacroStack::Pop},
    {"C_0", false, {}},
    {"C_1", false, {}},
    {"D_OFF", false, {}},
    {"D_ON", false, {}},
};

bool contains(const std::vector<std::string>& keys, std::string_view name) {
  return std::find(keys.begin(), keys.end(), symbolKey(name)) != keys.end();
}

} // namespace

bool MacroSet::flags(std::span<const Token> tokens, MacroStack& stack) {
  for (const Token& token : tokens) {
    if (token.is(',')) continue;
    const auto* flag = std::find_if(std::begin(kFlags), std::end(kFlags),
                                    [&](const FlagName& f) { return text::equalsIgnoringCase(token.text, f.name); });
    if (flag == std::end(kFlags)) {
      c_.report(diag::SyntaxError, token.range()) << "T_NORMAL, T_BEGIN, T_END, T_PUSH, T_POP, C_0, C_1, D_OFF or D_ON"
                                                  << "'" + std::string(token.text) + "'";
      return false;
    }
    if (flag->isStack) stack = flag->stack;
  }
  return true;
}

void MacroSet::declare(const Token& name, uint32_t macro) {
  // A macro may have the name of an instruction: CONTROL_T_MACRO decides which of them a use means (man. l.20572).
  if (findRow(name.text) == nullptr) c_.symbols.declare(namedSymbol(name, SymbolKind::Macro, file_, true));
  names_.emplace(symbolKey(name.text), macro);
}

void MacroSet::begin(std::span<const Token> operands, SourceRange at) {
  if (operands.empty() || operands[0].kind != TokenKind::Name) {
    c_.report(diag::SyntaxError, rangeOf(program_.sources, operands, at)) << "the name of a macro" << "none";
    operands = {};
  }
  Macro& macro = macros_.emplace_back();
  macro.at = at;
  defining_ = true;
  if (operands.empty()) return;
  macro.name = operands[0];
  for (const Token& token : operands.subspan(1)) {
    if (token.kind == TokenKind::Name)
      macro.formals.push_back(symbolKey(token.text));
    else if (!token.is(','))
      c_.report(diag::SyntaxError, token.range()) << "the name of a parameter" << "'" + std::string(token.text) + "'";
  }
  declare(operands[0], static_cast<uint32_t>(macros_.size()) - 1);
}

bool MacroSet::take(std::span<const Token> tokens, uint32_t line) {
  Macro& macro = macros_.back();
  if (tokens[0].kind == TokenKind::Name && text::equalsIgnoringCase(tokens[0].text, "END_T_MACRO")) {
    flags(tokens.subspan(1), macro.stack);
    defining_ = false;
    return false;
  }
  if (tokens[0].kind == TokenKind::Name && text::equalsIgnoringCase(tokens[0].text, "T_LOCAL")) {
    for (const Token& token : tokens.subspan(1))
      if (token.kind == TokenKind::Name) macro.locals.push_back(symbolKey(token.text));
    return true;
  }
  macro.body.push_back({{tokens.begin(), tokens.end()}, line});
  return true;
}

void MacroSet::abandon() {
  if (defining_) c_.report(diag::MacroNotClosed, macros_.back().at) << macros_.back().name.text;
  defining_ = false;
}

void MacroSet::append(std::span<const Token> operands, SourceRange at) {
  const auto parts = splitOperands(operands);
  const auto isName = [](std::span<const Token> part) { return part.size() == 1 && part[0].kind == TokenKind::Name; };
  if (!countFits(findRow("APPEND_T_MACRO")->info, parts.size(), at, c_.diagnostics)) return;
  if (!isName(parts[0]) || !isName(parts[1])) {
    c_.report(diag::SyntaxError, rangeOf(program_.sources, parts[isName(parts[0]) ? 1 : 0], at))
        << "the name of a macro" << "something else";
    return;
  }
  const auto found = names_.find(symbolKey(parts[0][0].text));
  if (found == names_.end()) {
    c_.report(diag::UndefinedSymbol, parts[0][0].range()) << parts[0][0].text;
    return;
  }
  Macro alias = macros_[found->second];
  alias.name = parts[1][0];
  for (size_t i = 2; i < parts.size(); ++i) flags(parts[i], alias.stack);
  macros_.push_back(std::move(alias));
  declare(parts[1][0], static_cast<uint32_t>(macros_.size()) - 1);
}

void MacroSet::control(std::span<const Token> operands, SourceRange at) {
  if (!countFits(findRow("CONTROL_T_MACRO")->info, splitOperands(operands).size(), at, c_.diagnostics)) return;
  const bool one = operands.size() == 1 && operands[0].kind == TokenKind::Name;
  if (one && text::equalsIgnoringCase(operands[0].text, "PRE"))
    first_ = true;
  else if (one && text::equalsIgnoringCase(operands[0].text, "POS"))
    first_ = false;
  else
    c_.report(diag::SyntaxError, rangeOf(program_.sources, operands, at)) << "POS or PRE" << "something else";
}

void MacroSet::offer(text::Similar& similar) const {
  for (const Macro& macro : macros_) similar.offer(macro.name.text);
}

const Macro* MacroSet::find(std::string_view name) const {
  const auto found = names_.find(symbolKey(name));
  return found == names_.end() ? nullptr : &macros_[found->second];
}

// Adds a token; a T_LOCAL name gets a suffix that is unique per use: NAME#3 in the third use.
void MacroSet::localName(const Macro& macro, Token token, Macro::Line& out) {
  if (token.kind == TokenKind::Name && contains(macro.locals, token.text)) {
    token.written = static_cast<uint32_t>(token.text.size());
    program_.madeTexts.push_back(std::string(token.text) + kUseMark + std::to_string(uses_));
    token.text = program_.madeTexts.back();
  }
  out.tokens.push_back(token);
}

// Replaces formals in operands that begin with TMAC.; all other operands stay as they are (man. l.20410-20431).
void MacroSet::substitute(const Macro& macro, const Macro::Line& line,
                          const std::vector<std::span<const Token>>& actuals, Macro::Line& out) {
  bool inTmac = false;
  for (size_t i = 0; i < line.tokens.size(); ++i) {
    const Token& token = line.tokens[i];
    if (token.is(',')) inTmac = false;
    if (token.kind == TokenKind::Name && text::equalsIgnoringCase(token.text, "TMAC") && i + 1 < line.tokens.size() &&
        line.tokens[i + 1].is('.')) {
      inTmac = true;
      ++i;
      continue;
    }
    const auto formal = token.kind == TokenKind::Name && inTmac
                            ? std::find(macro.formals.begin(), macro.formals.end(), symbolKey(token.text))
                            : macro.formals.end();
    if (formal == macro.formals.end()) {
      localName(macro, token, out);
      continue;
    }
    const std::span<const Token> actual = actuals[static_cast<size_t>(formal - macro.formals.begin())];
    const bool twice = !actual.empty() && actual[0].is('-') && !out.tokens.empty() && out.tokens.back().is('-');
    if (twice) out.tokens.pop_back(); // -TMAC.P with -B is B
    out.tokens.insert(out.tokens.end(), actual.begin() + (twice ? 1 : 0), actual.end());
  }
}

bool MacroSet::expand(const Macro& macro, std::span<const Token> operands, SourceRange at,
                      std::vector<Macro::Line>& out) {
  const auto actuals = splitOperands(operands);
  if (actuals.size() != macro.formals.size()) {
    c_.report(diag::MacroOperandCount, at).note(macro.name.range(), "it is defined here")
        << macro.name.text << macro.formals.size() << actuals.size();
    return false;
  }
  ++uses_;
  for (const Macro::Line& line : macro.body) {
    Macro::Line& made = out.emplace_back();
    made.line = line.line;
    substitute(macro, line, actuals, made);
  }
  return true;
}

} // namespace rung::frontend::technol
