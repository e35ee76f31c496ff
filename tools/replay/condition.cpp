// Reads and evaluates conditions (see condition.h).
#include "tools/replay/condition.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <fmt/format.h>
#include <utility>

namespace rung::replay {
namespace {

struct Token {
  std::string text;
  bool quoted = false;
};

constexpr std::array<std::string_view, 8> kComparisons = {"==", "!=", "<=", ">=", "<>", "=", "<", ">"};

std::string_view comparisonAt(std::string_view text) {
  for (const std::string_view comparison : kComparisons)
    if (text.starts_with(comparison)) return comparison;
  return {};
}

// A bracket of an index belongs to its name.
Result<std::vector<Token>> tokensOf(std::string_view text) {
  std::vector<Token> tokens;
  bool open = false; // the last token continues
  while (!text.empty()) {
    const std::string_view comparison = comparisonAt(text);
    if (text[0] == ' ' || text[0] == '\t') {
      open = false;
      text.remove_prefix(1);
    } else if (text[0] == '"') {
      const size_t end = text.find('"', 1);
      if (end == std::string_view::npos) return failure("the quotation mark is not closed");
      tokens.push_back({std::string(text.substr(1, end - 1)), true});
      open = false;
      text.remove_prefix(end + 1);
    } else if (text[0] == '(' || text[0] == ')') {
      tokens.push_back({std::string(1, text[0])});
      open = false;
      text.remove_prefix(1);
    } else if (!comparison.empty()) {
      tokens.push_back({std::string(comparison)});
      open = false;
      text.remove_prefix(comparison.size());
    } else {
      if (!open) tokens.emplace_back();
      tokens.back().text += text[0];
      open = true;
      text.remove_prefix(1);
    }
  }
  return tokens;
}

} // namespace

class Condition::Parser {
public:
  Parser(Condition& to, std::vector<Token> tokens, const Locate& locate)
      : to_(to), tokens_(std::move(tokens)), locate_(locate) {}

  // "" or what is wrong.
  std::string run() {
    (void)either();
    if (problem_.empty() && at_ < tokens_.size())
      problem_ = fmt::format("expected and, or, a comparison or the end, found '{}'", tokens_[at_].text);
    return problem_;
  }

private:
  bool take(std::string_view word, std::string_view other = {}) {
    if (at_ == tokens_.size() || tokens_[at_].quoted) return false;
    if (tokens_[at_].text != word && (other.empty() || tokens_[at_].text != other)) return false;
    ++at_;
    return true;
  }
  uint32_t add(const Node& node) {
    to_.nodes_.push_back(node);
    return static_cast<uint32_t>(to_.nodes_.size() - 1);
  }
  uint32_t either() {
    uint32_t left = both();
    while (problem_.empty() && take("or", "||")) {
      const uint32_t right = both();
      left = add({.kind = Kind::Or, .a = left, .b = right});
    }
    return left;
  }
  uint32_t both() {
    uint32_t left = term();
    while (problem_.empty() && take("and", "&&")) {
      const uint32_t right = term();
      left = add({.kind = Kind::And, .a = left, .b = right});
    }
    return left;
  }
  uint32_t term() {
    if (++depth_ > kDeepest) problem_ = "it is nested too deeply";
    const uint32_t node = problem_.empty() ? termInside() : 0;
    --depth_;
    return node;
  }
  uint32_t termInside() {
    if (take("not")) {
      const uint32_t of = term();
      return add({.kind = Kind::Not, .a = of});
    }
    if (take("(")) {
      const uint32_t inside = either();
      if (problem_.empty() && !take(")")) problem_ = "a bracket is not closed";
      return inside;
    }
    for (const auto& [word, kind] :
         {std::pair("rises", Kind::Rises), std::pair("falls", Kind::Falls), std::pair("changes", Kind::Changes)})
      if (take(word)) return add({.kind = kind, .a = operand()});
    return comparison();
  }
  uint32_t comparison() {
    const uint32_t left = operand();
    if (!problem_.empty()) return 0;
    const std::string_view word =
        at_ < tokens_.size() && !tokens_[at_].quoted ? comparisonAt(tokens_[at_].text) : std::string_view();
    if (word.empty()) return add({.kind = Kind::Value, .a = left});
    ++at_;
    const uint32_t right = operand();
    if (word == "=" || word == "==") return add({.kind = Kind::Equal, .a = left, .b = right});
    if (word == "!=" || word == "<>") return add({.kind = Kind::NotEqual, .a = left, .b = right});
    const bool swapped = word[0] == '>';
    const Kind kind = word.size() == 1 ? Kind::Less : Kind::LessEqual;
    return add({.kind = kind, .a = swapped ? right : left, .b = swapped ? left : right});
  }
  // A number, on, off, or a name.
  uint32_t operand() {
    if (at_ == tokens_.size()) {
      problem_ = "expected a name or a number at the end";
      return 0;
    }
    const Token& token = tokens_[at_++];
    Operand operand;
    if (token.quoted || !number(token.text, operand)) {
      operand = {};
      operand.name = token.text;
      problem_ = operand.locate(locate_);
      if (!problem_.empty()) return 0;
    }
    to_.operands_.push_back(std::move(operand));
    return static_cast<uint32_t>(to_.operands_.size() - 1);
  }
  static bool number(std::string_view text, Operand& operand) {
    operand.isNumber = true;
    if (text == "on" || text == "true" || text == "off" || text == "false") {
      operand.integer = text == "on" || text == "true" ? 1 : 0;
      operand.number = static_cast<double>(operand.integer);
      return true;
    }
    const bool negative = text.starts_with('-');
    std::string_view digits = text.substr(negative ? 1 : 0);
    const int base = digits.starts_with("0x") || digits.starts_with("0X") ? 16 : 10;
    if (base == 16) digits.remove_prefix(2);
    uint64_t whole = 0;
    const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), whole, base);
    if (read.ec == std::errc() && read.ptr == digits.data() + digits.size()) {
      operand.integer = static_cast<int64_t>(negative ? 0 - whole : whole);
      operand.number = static_cast<double>(operand.integer);
      return true;
    }
    const bool begins = !digits.empty() && (digits[0] == '.' || (digits[0] >= '0' && digits[0] <= '9')); // not: INF
    if (!begins) return false;
    const auto real = std::from_chars(text.data(), text.data() + text.size(), operand.number);
    operand.real = real.ec == std::errc() && real.ptr == text.data() + text.size();
    return operand.real;
  }

  Condition& to_;
  std::vector<Token> tokens_;
  const Locate& locate_;
  static constexpr uint32_t kDeepest = 200;
  size_t at_ = 0;
  uint32_t depth_ = 0;
  std::string problem_;
};

// A constant of the program is a number.
std::string Condition::Operand::locate(const Locate& locate) {
  const Result<runtime::Ref> found = locate(name);
  if (!found.ok()) return found.error();
  ref = found.value();
  place = {};
  if (ref.kind == runtime::RefKind::Text) return fmt::format("{} is a text, and conditions compare numbers", name);
  real = ref.kind == runtime::RefKind::Real;
  isNumber = ref.kind == runtime::RefKind::Constant;
  if (isNumber) integer = ref.constant, number = static_cast<double>(ref.constant);
  return {};
}

Result<Condition> Condition::parse(std::string_view text, const Locate& locate) {
  Result<std::vector<Token>> tokens = tokensOf(text);
  if (!tokens.ok()) return tokens.failure();
  if (tokens.value().empty()) return failure("expected a condition, such as X8.4 or D100 > 500");
  Condition condition;
  if (std::string problem = Parser(condition, std::move(tokens).value(), locate).run(); !problem.empty())
    return failure(std::move(problem));
  return condition;
}

std::string Condition::locate(const Locate& locate) {
  for (Operand& operand : operands_)
    if (!operand.name.empty())
      if (std::string problem = operand.locate(locate); !problem.empty()) return problem;
  return {};
}

bool Condition::holds(const core::Memory& memory) {
  for (Operand& operand : operands_)
    if (!operand.isNumber && operand.place.outside()) operand.place = runtime::locate(memory, operand.ref);
  const bool result = holds(static_cast<uint32_t>(nodes_.size() - 1), memory);
  started_ = true;
  return result;
}

// Both sides of and, or are evaluated, as they may compare with the last call.
bool Condition::holds(uint32_t index, const core::Memory& memory) {
  Node& node = nodes_[index];
  switch (node.kind) {
  case Kind::And:
  case Kind::Or: {
    const bool a = holds(node.a, memory), b = holds(node.b, memory);
    return node.kind == Kind::And ? a && b : a || b;
  }
  case Kind::Not: return !holds(node.a, memory);
  case Kind::Changes:
  case Kind::Rises:
  case Kind::Falls: {
    const uint64_t now = bitsOf(operands_[node.a], memory);
    const uint64_t last = std::exchange(node.last, now);
    if (!started_) return false;
    return node.kind == Kind::Changes ? now != last
                                      : (now != 0) != (last != 0) && (now != 0) == (node.kind == Kind::Rises);
  }
  default: return compare(node, memory);
  }
}

uint64_t Condition::bitsOf(const Operand& operand, const core::Memory& memory) {
  return operand.isNumber ? static_cast<uint64_t>(operand.integer) : memory.read(operand.place);
}

int64_t Condition::integerOf(const Operand& operand, const core::Memory& memory) {
  if (operand.isNumber) return operand.integer;
  return operand.place.width() == 1 ? static_cast<int64_t>(memory.read(operand.place))
                                    : memory.readSigned(operand.place);
}

double Condition::realOf(const Operand& operand, const core::Memory& memory) {
  return operand.isNumber ? operand.number : memory.readReal(operand.place);
}

// Whole values, as signed; a number may also be the pattern of the place's bits, such as 65535 of a word that is -1.
bool Condition::equal(const Operand& a, const Operand& b, const core::Memory& memory) {
  if (integerOf(a, memory) == integerOf(b, memory)) return true;
  return a.isNumber != b.isNumber && bitsOf(a, memory) == bitsOf(b, memory);
}

bool Condition::compare(const Node& node, const core::Memory& memory) const {
  const Operand& a = operands_[node.a];
  if (node.kind == Kind::Value) return a.real ? realOf(a, memory) != 0 : bitsOf(a, memory) != 0;
  const Operand& b = operands_[node.b];
  if (a.real || b.real) {
    const double left = realOf(a, memory), right = realOf(b, memory);
    switch (node.kind) {
    case Kind::Equal: return left == right;
    case Kind::NotEqual: return left != right;
    case Kind::Less: return left < right;
    default: return left <= right;
    }
  }
  switch (node.kind) {
  case Kind::Equal: return equal(a, b, memory);
  case Kind::NotEqual: return !equal(a, b, memory);
  case Kind::Less: return integerOf(a, memory) < integerOf(b, memory);
  default: return integerOf(a, memory) <= integerOf(b, memory);
  }
}

// ---- search ------------------------------------------------------------------------------------------------------

namespace {

// Calls found(part) where it begins to hold, until that returns false.
template <class Found>
void search(Past& past, Condition& condition, const Condition::Locate& locate, uint64_t from, uint64_t to,
            std::string& problem, Found found) {
  problem = past.goTo(from);
  if (!problem.empty()) return;
  const NotCompared notCompared(past);
  const auto memory = [&] { return past.instance().memory(); };
  uint32_t program = past.programNumber();
  problem = condition.locate(locate);
  if (!problem.empty()) return;
  condition.restart();
  bool held = condition.holds(memory());
  while (past.part() < to) {
    if (!past.next()) {
      problem = past.problem();
      return;
    }
    if (past.programNumber() != program) {
      program = past.programNumber();
      problem = condition.locate(locate);
      if (!problem.empty()) return;
    }
    const bool holds = condition.holds(memory());
    if (holds && !held && !found(past.part())) return;
    held = holds;
  }
}

} // namespace

std::optional<uint64_t> findNext(Past& past, Condition& condition, const Condition::Locate& locate, uint64_t from,
                                 uint64_t to, std::string& problem) {
  std::optional<uint64_t> found;
  search(past, condition, locate, from, to, problem, [&](uint64_t part) {
    found = part;
    return false;
  });
  return found;
}

std::vector<uint64_t> findAll(Past& past, Condition& condition, const Condition::Locate& locate, uint64_t from,
                              uint64_t to, size_t most, std::string& problem) {
  std::vector<uint64_t> found;
  search(past, condition, locate, from, to, problem, [&](uint64_t part) {
    found.push_back(part);
    return found.size() < most;
  });
  return found;
}

} // namespace rung::replay
