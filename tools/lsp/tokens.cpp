// Kinds of words, for colours that a grammar of the text alone cannot know.
#include <algorithm>
#include <array>
#include <vector>

#include "tools/lsp/features.h"
#include "tools/lsp/subject.h"

namespace rung::lsp {
namespace {

enum class TokenKind : uint8_t { Function, Variable, Constant, Address, Target };
constexpr std::array<const char*, 5> kKinds{"function", "variable", "enumMember", "property", "method"};
enum Modifier : uint32_t { kDeclaration = 1, kReadonly = 2, kControl = 4, kWritten = 8 };
constexpr uint32_t modifierIf(bool holds, Modifier modifier) { return holds ? uint32_t{modifier} : 0; }
constexpr std::array<const char*, 4> kModifiers{"declaration", "readonly", "defaultLibrary", "modification"};

struct Token {
  SourceRange range;
  TokenKind kind;
  uint32_t modifiers = 0;
};

class Tokens {
public:
  Tokens(const Program& program, FileId file)
      : sources_(program.sources()), analysis_(*program.analysis()), file_(file) {}

  std::vector<Token> all() {
    for (const frontend::Definition& definition : analysis_.definitions())
      if (isHere(definition.range)) add(definition.range, definition, kDeclaration);
    for (const frontend::NameUse& use : analysis_.names())
      if (isHere(use.range))
        add(use.range, analysis_.definitions()[use.definition],
            modifierIf(isWrittenAt(analysis_, use.range), kWritten));
    for (const frontend::OperandUse& operand : analysis_.operands())
      if (operand.base == frontend::kNoDefinition && isHere(operand.range))
        tokens_.push_back({withoutIndex(operand), TokenKind::Address, modifierIf(isWritten(operand.access), kWritten)});
    for (const frontend::TargetUse& target : analysis_.targets())
      if (isHere(target.range))
        tokens_.push_back({target.range, TokenKind::Target, modifierIf(target.defines, kDeclaration)});
    for (const frontend::InstructionUse& use : analysis_.instructions())
      if (isHere(use.range)) tokens_.push_back({use.range, TokenKind::Function});
    std::ranges::stable_sort(tokens_, {}, [](const Token& token) { return token.range.begin; });
    return std::move(tokens_);
  }

private:
  bool isHere(SourceRange range) const { return range.valid() && sources_.fileOf(range.begin) == file_; }
  void add(SourceRange range, const frontend::Definition& definition, uint32_t modifiers) {
    if (definition.isConstant())
      tokens_.push_back({range, TokenKind::Constant, modifiers | kReadonly});
    else
      tokens_.push_back({range, TokenKind::Variable, modifiers | modifierIf(!definition.range.valid(), kControl)});
  }
  SourceRange withoutIndex(const frontend::OperandUse& operand) const {
    const auto index = static_cast<uint32_t>(operand.computed.size());
    const uint32_t length = operand.range.end.value - operand.range.begin.value;
    return index < length ? SourceRange{operand.range.begin, {operand.range.end.value - index}} : operand.range;
  }

  const SourceManager& sources_;
  const frontend::Analysis& analysis_;
  FileId file_;
  std::vector<Token> tokens_;
};

} // namespace

json semanticLegend() { return {{"tokenTypes", kKinds}, {"tokenModifiers", kModifiers}}; }

json semanticTokens(Program& program, FileId file, Unit unit) {
  std::vector<uint32_t> data;
  Position last;
  if (program.analysis() != nullptr)
    for (SourcePos end; const Token& token : Tokens(program, file).all()) {
      if (token.range.begin < end) continue; // inside the one before
      end = token.range.end;
      const Range range = rangeOf(program.sources(), token.range, unit);
      if (range.begin.line != range.end.line) continue;
      const bool sameLine = range.begin.line == last.line;
      for (const uint32_t number :
           {range.begin.line - last.line, range.begin.character - (sameLine ? last.character : 0),
            range.end.character - range.begin.character, static_cast<uint32_t>(token.kind), token.modifiers})
        data.push_back(number);
      last = range.begin;
    }
  return {{"data", std::move(data)}};
}

} // namespace rung::lsp
