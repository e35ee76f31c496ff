// What an operand names: its address, its comment, and what it is counted under in the cross reference.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "frontend/dialects/dialect.h"
#include "frontend/syntax/word_lexer.h"
#include "tools/report/cross_reference.h"

namespace rung::view {

struct Named {
  std::string address; // of a name; of an address the name that is declared for it; never the operand itself
  std::string comment;
  std::string key;                   // the same for all spellings of one place; empty for constants
  std::optional<ir::BitRange> place; // nothing where it is known at run time only, and for constants
  bool input = false;                // written by the machine or the NC
  bool output = false;               // read by them
};

class Names {
public:
  // All must outlive it. `analysis` is of the text that is drawn, `reference` of the program that it compiles to.
  Names(const frontend::Dialect& dialect, const frontend::Analysis& analysis, const report::CrossReference& reference);

  // Of an operand of the text, and of a name where it is declared.
  Named find(const frontend::Word& operand);
  // The label or subprogram that an operand is; null when it is none.
  const frontend::TargetUse* targetAt(const frontend::Word& operand) const { return analysis_.targetAt(operand.range); }
  // What a constant means: its value as declared, otherwise the text itself.
  std::string_view valueOf(const frontend::Word& operand) const;

private:
  struct Known {
    std::string_view name;
    std::string_view comment;
  };
  void addDefinitions();
  void addSignals(const frontend::Dialect& dialect);
  std::optional<ir::BitRange> placeOf(const frontend::NamedPlace& place) const;
  std::string textOf(const ir::BitRange& place) const;
  const Named& at(const ir::BitRange& place);
  Named of(const frontend::Definition& definition);
  Named lookUp(const frontend::Word& operand);

  const frontend::Analysis& analysis_;
  const report::CrossReference& reference_;
  std::map<std::string, Known> byAddress_; // the first name of a place; declared ones come first
  std::map<SourcePos, uint32_t> declared_; // where: the definition
  std::map<std::string, Named> places_;    // that were asked for, by address and length
};

} // namespace rung::view
