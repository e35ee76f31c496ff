// What an operand names: its address, its comment, and what it is counted under in the cross reference.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "frontend/dialects/dialect.h"
#include "frontend/sema/analysis.h"
#include "frontend/syntax/word_lexer.h"
#include "tools/report/cross_reference.h"
#include "tools/view/html.h"
#include "tools/view/program.h"

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

// Where jumps and calls lead: the rungs that begin a subprogram or carry a label, and those that ask for it.

class Targets {
public:
  struct Target {
    uint32_t rung = 0; // its number; 0: no rung is known
    std::vector<uint32_t> callers;
  };

  uint32_t idOf(const frontend::TargetUse& use);
  void define(uint32_t id, uint32_t rung) { targets_[id].rung = rung; }
  void ask(uint32_t id, uint32_t rung);
  const Target& at(uint32_t id) const { return targets_[id]; }

private:
  std::map<std::pair<std::string_view, uint32_t>, uint32_t> ids_; // by scope and number
  std::vector<Target> targets_;
};

// Links from a page to the lines of the sources.

// From the lines of a source to it as seen from the folder of the page.
inline constexpr std::string_view kSourceLink = "{file}#L{line}";

// `link` with {file}, the source as seen from the folder of `page`; {path}, the whole path of the source; {line}.
LinkTo sourceLinks(std::string_view page, std::string_view link);

// Which rungs of a drawing use a place, whatever its operands look like.

class UseIndex {
public:
  // `reference` must outlive it. It knows what no operand says: the cells between the two ends of an array, a
  // counter's own.
  explicit UseIndex(const report::CrossReference& reference) : reference_(reference) {}

  // A use as drawn. All of them come before the first question.
  void add(const ir::BitRange& place, Use use) { drawn_.push_back({place, use}); }
  // By rung, each side once.
  std::vector<Use> of(const ir::BitRange& place);

private:
  struct Drawn {
    ir::BitRange place;
    Use use;
  };
  void settle();
  std::vector<Use> drawnAt(const ir::BitRange& place) const;

  const report::CrossReference& reference_;
  std::vector<Drawn> drawn_;
  uint32_t longest_ = 0; // bits of a use; 0: not settled yet
};

} // namespace rung::view
