// What is common to the readers of ladders and of charts: the rungs that use each name, the targets of jumps and calls,
// and the links between them, which are known when all rungs have been read.
#pragma once
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "tools/view/names.h"
#include "tools/view/program.h"
#include "tools/view/sheet_builder.h"

namespace rung::view {

inline constexpr uint32_t kNone = UINT32_MAX;

// The uses of each name, in the order of first use.
class UseList {
public:
  struct Entry {
    std::string name; // as first written
    Named named;
    std::vector<Use> uses;
  };

  explicit UseList(const report::CrossReference& reference) : index_(reference) {}

  // The index of the entry; kNone if the name is not listed.
  uint32_t add(const Named& named, std::string_view name, Use use) {
    if (named.key.empty()) return kNone;
    const auto [at, fresh] = byKey_.emplace(named.key, static_cast<uint32_t>(entries_.size()));
    if (fresh) entries_.push_back({std::string(name), named, {}});
    if (named.place) index_.add(*named.place, use);
    std::vector<Use>& uses = entries_[at->second].uses;
    // A rung occurs at most twice: as reader and as writer.
    if (std::find(uses.rbegin(), uses.rbegin() + std::min<ptrdiff_t>(2, std::ssize(uses)), use) ==
        uses.rbegin() + std::min<ptrdiff_t>(2, std::ssize(uses)))
      uses.push_back(use);
    return at->second;
  }
  // Called once all uses are added: adds the uses of a place by other operands, and by none.
  void settle() {
    for (Entry& entry : entries_)
      if (entry.named.place) entry.uses = index_.of(*entry.named.place);
  }
  // Uses of a place, whether an operand names it or not. Valid after settle().
  std::vector<Use> of(const ir::BitRange& place) { return index_.of(place); }
  const Entry* find(const std::string& key) const {
    const auto at = byKey_.find(key);
    return at == byKey_.end() ? nullptr : &entries_[at->second];
  }
  const std::vector<Entry>& entries() const { return entries_; }

private:
  UseIndex index_;
  std::unordered_map<std::string, uint32_t> byKey_;
  std::vector<Entry> entries_;
};

// A row at the right rail for the rungs that use a coil or lead to a target; they are not known before the last rung.
struct WaitingRow {
  uint32_t figure = 0;
  uint32_t row = 0;
  uint32_t id = 0;                     // of the coil's entry, or of the target
  std::string_view lead = "called in"; // of a target
};

// The rungs that read and write an entry.
struct Sides {
  std::vector<uint32_t> readers;
  std::vector<uint32_t> writers;
};

class ProgramBuilder : protected SheetListener {
protected:
  // All arguments must outlive it. `files`: those that the author wrote.
  ProgramBuilder(const SourceManager& sources, const frontend::Dialect& dialect, const frontend::Analysis& analysis,
                 const report::CrossReference& reference, std::span<const FileId> files);

  uint32_t indexOf(FileId file) const;
  Place placeOf(SourcePos pos) const;
  void add(Block::Kind kind, std::string text, std::string_view remark, const Place& place) {
    program_.blocks.push_back({.kind = kind, .text = std::move(text), .comment = std::string(remark), .place = place});
  }
  void declare(const Named& named, std::string_view name, bool constant, std::string comment);
  // A comment between declarations.
  void declareComment(std::string text) { declared_.push_back({.comment = std::move(text)}); }
  // The last rung, or its row, is a target: its row says which rungs lead there, after `lead`.
  void defineTarget(const frontend::TargetUse& target, uint32_t row, std::string_view lead);
  // The block that is added next is a subprogram that begins with the next rung.
  void beginSubprogram(const frontend::TargetUse& target);
  // Called after each rung.
  void endRung();

  // Called once all rungs have been read.
  void addNameTables();
  Program finish();

  const SourceManager& sources_;
  Names names_;
  Program program_;
  UseList uses_;
  Targets targets_;

private:
  Link onUse(const OperandUse& use) override;
  Link onTarget(const frontend::TargetUse& target, uint32_t row) override;
  void splitUses();
  CrossReference readersOf(uint32_t entry) const;
  CrossReference writersOf(uint32_t entry, std::string_view lead, uint32_t without, size_t most) const;
  CrossReference callersOf(uint32_t target, std::string_view lead) const;
  void fillRows();
  void numberRows();
  void settle(Link& link) const;
  void settleLinks();

  const std::span<const FileId> authors_;
  std::vector<WaitingRow> coils_;
  std::vector<WaitingRow> marks_;                          // rows of targets
  std::vector<std::pair<uint32_t, uint32_t>> subprograms_; // index of the block, target
  std::vector<Sides> sides_;                               // by entry of uses_
  std::vector<uint32_t> rowIds_;                           // by entry of uses_
  std::vector<NameRow> declared_;
  std::map<size_t, std::optional<ir::BitRange>> places_; // of those with a name
};

} // namespace rung::view
