// User instructions: DEF_T_MACRO … END_T_MACRO (man. ch. 22). A macro's lines are stored as tokens; a use makes new
// tokens in which formal parameters after TMAC. are replaced by the actual operands and T_LOCAL names by unique names.
#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "frontend/dialects/technol/read/read_context.h"
#include "rtlib/text/similar.h"

namespace rung::frontend::technol {

// The effect of a use on the stack, regardless of the body (man. l.20536).
enum class MacroStack : uint8_t { Normal, Begin, End, Push, Pop };

struct Macro {
  struct Line {
    std::vector<Token> tokens;
    uint32_t line = 0;
  };
  Token name;
  SourceRange at;                   // of its DEF_T_MACRO
  std::vector<std::string> formals; // keys
  std::vector<std::string> locals;  // keys
  std::vector<Line> body;
  MacroStack stack = MacroStack::Normal;
};

class MacroSet {
public:
  MacroSet(ReadContext& context, uint32_t file) : c_(context), program_(context.program), file_(file) {}

  bool defining() const { return defining_; }
  // DEF_T_MACRO name par1, par2
  void begin(std::span<const Token> operands, SourceRange at);
  // Takes a line while a macro is being defined; false for its END_T_MACRO.
  bool take(std::span<const Token> tokens, uint32_t line);
  // Called at the end of a module or file: the macro was not closed.
  void abandon();
  // APPEND_T_MACRO name, alias [,flags]
  void append(std::span<const Token> operands, SourceRange at);
  // CONTROL_T_MACRO POS|PRE: whether macros come before the language's own instructions
  void control(std::span<const Token> operands, SourceRange at);
  bool first() const { return first_; }

  // Null if there is none.
  const Macro* find(std::string_view name) const;
  // Offers all names as suggestions.
  void offer(text::Similar& similar) const;
  // The lines of one use; nothing after a report.
  bool expand(const Macro& macro, std::span<const Token> operands, SourceRange at, std::vector<Macro::Line>& out);

private:
  bool flags(std::span<const Token> tokens, MacroStack& stack);
  void declare(const Token& name, uint32_t macro);
  void substitute(const Macro& macro, const Macro::Line& line, const std::vector<std::span<const Token>>& actuals,
                  Macro::Line& out);
  void localName(const Macro& macro, Token token, Macro::Line& out);

  ReadContext& c_;
  SourceProgram& program_;
  uint32_t file_;
  bool defining_ = false;
  bool first_ = false;
  uint32_t uses_ = 0;
  std::vector<Macro> macros_;
  std::unordered_map<std::string, uint32_t> names_;
};

} // namespace rung::frontend::technol
