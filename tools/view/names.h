// The meaning of an operand: its address, its comment, and its key in the cross reference.
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

// A declaration's comment without allowances, and without what only explains one: "until power off:
// allow(never-reset)".
std::string shownComment(std::string_view comment);

struct Named {
  std::string address; // for a name, its address; for an address, the name declared for it; never the operand itself
  std::string comment;
  std::string key;                   // the same for all spellings of one place; empty for constants
  std::optional<ir::BitRange> place; // nothing for constants, and if known at run time only
  bool input = false;                // the machine or the NC writes it
  bool output = false;               // the machine or the NC reads it
};

class Names {
public:
  // All arguments must outlive it. `analysis` is of the drawn text, `reference` of the program that it compiles to.
  Names(const frontend::Dialect& dialect, const frontend::Analysis& analysis, const report::CrossReference& reference);

  // For an operand of the text, or a name in its declaration.
  Named find(const frontend::Word& operand);
  Named find(const frontend::chart::Operand& operand);
  Named of(const frontend::Definition& definition);
  // The label or subprogram that the operand names; null if it names none.
  const frontend::TargetUse* targetAt(const frontend::Word& operand) const { return analysis_.targetAt(operand.range); }
  // The value of a constant as declared, or the text itself.
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
  Named lookUp(const frontend::Word& operand);
  Named lookUp(const frontend::OperandUse* use, const frontend::Definition* name, std::string_view operand);

  const frontend::Analysis& analysis_;
  const report::CrossReference& reference_;
  std::map<std::string_view, std::string_view> meanings_; // of the control's signals
  std::map<std::string, Known> byAddress_;                // the first name of a place; declared names have precedence
  std::map<SourcePos, uint32_t> declared_;                // position of a name: its definition
  std::map<std::string, Named> places_;                   // looked up before, by address and length
};

// Targets of jumps and calls: the rungs that begin a subprogram or have a label, and those that lead to them.

class Targets {
public:
  struct Target {
    uint32_t rung = 0; // number of the target rung; 0: unknown
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

// The default link: the source relative to the folder of the page.
inline constexpr std::string_view kSourceLink = "{file}#L{line}";

// `link` may contain {file}, the source relative to the folder of `page`; {path}, the full path of the source; {line}.
LinkTo sourceLinks(std::string_view page, std::string_view link);

// Finds the rungs of a drawing that use a place, under whatever operands.

class UseIndex {
public:
  // `reference` must outlive it; it adds uses that no operand shows: cells within an array, a counter's own cells.
  explicit UseIndex(const report::CrossReference& reference) : reference_(reference) {}

  // Adds a drawn use. Must not be called after of().
  void add(const ir::BitRange& place, Use use) { drawn_.push_back({place, use}); }
  // Ascending by rung, reads and writes each once.
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
  uint32_t longest_ = 0; // most bits of a use; 0: not determined yet
};

} // namespace rung::view
