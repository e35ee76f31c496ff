// The names of a program, for every dialect: they are declared, found in their scopes and used, and undeclared ones are
// reported. A dialect derives its own table, which interprets declarations and has the names of the control; tools use
// the Analysis, which receives everything in the end.
#pragma once
#include <algorithm>
#include <cstdint>
#include <deque>
#include <initializer_list>
#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "frontend/sema/analysis.h"
#include "ir/support/diagnostics.h"

namespace rung::frontend {

inline constexpr uint32_t kNoName = UINT32_MAX;

inline constexpr std::string_view kFirstDeclared = "first declared here";

// Reports a name that is declared again. `first` is the former position, and `note` describes it; invalid: the control
// has the name.
void reportDuplicate(Diagnostics& diagnostics, std::string_view name, SourceRange range, SourceRange first,
                     std::string_view note = kFirstDeclared);

// A use of a name that is not declared.
struct UndeclaredUse {
  std::string_view name;
  SourceRange range;
};

// The positions of the uses.
template <class Use>
std::vector<SourceRange> placesOf(std::span<const Use> uses) {
  std::vector<SourceRange> places;
  for (const Use& use : uses) places.push_back(use.range);
  return places;
}

// Adds the second use, and the number of further ones.
void noteFurtherUses(DiagBuilder& report, SourceRange second, size_t further);

// The common form of all spellings of a name.
using NameKey = std::string (*)(std::string_view name);
// Case is significant, and so is the whole name.
std::string asWritten(std::string_view name);

// A Symbol has a `name`, whose text lives as long as the table, and the range `declared`, invalid for a name of the
// control. Undeclared is an UndeclaredUse, with what the dialect needs for the report. Two names with the same key are
// one name. Symbols are numbered in the order in which they are added and do not move. Scope 0 always exists; each
// addScope makes the next.
template <class Symbol, class Undeclared = UndeclaredUse>
class SymbolTable {
public:
  // In the first of the scopes that has the name; kNoName if none has.
  uint32_t find(std::string_view name, std::initializer_list<uint32_t> scopes = {0}) const {
    const std::string key = keyOf_(name);
    for (const uint32_t scope : scopes)
      if (const auto at = scopes_[scope].find(key); at != scopes_[scope].end()) return at->second;
    return kNoName;
  }
  // Records a use of the symbol's name.
  void use(SourceRange range, uint32_t symbol) { uses_.push_back({range, symbol}); }
  const Symbol& operator[](uint32_t symbol) const { return symbols_[symbol]; }
  const std::deque<Symbol>& all() const { return symbols_; }
  // In the order of recording; the definition is the number of the symbol.
  std::span<const NameUse> uses() const { return uses_; }

  // Whether a declaration of this name was reported as invalid: uses are not reported.
  bool wasRefused(std::string_view name) const { return refused_.contains(keyOf_(name)); }
  // May be called in any order, also several times.
  void noteUndeclared(Undeclared use) { undeclared_[keyOf_(use.name)].push_back(std::move(use)); }
  // Reports each name once, at its first use. `explain` is called with the report, which has the name as its first
  // argument, and all uses, the first one first, so that a fix can apply to all.
  template <class Explain>
  void reportUndeclared(Diagnostics& diagnostics, Diag code, Explain explain) {
    const auto begin = [](const Undeclared& use) { return use.range.begin; };
    for (auto& [key, uses] : std::exchange(undeclared_, {})) {
      std::ranges::stable_sort(uses, {}, begin);
      const auto again = std::ranges::unique(uses, {}, begin);
      uses.erase(again.begin(), again.end());
      DiagBuilder report = diagnostics.report(code, uses.front().range);
      report << uses.front().name;
      explain(report, std::span<const Undeclared>(uses));
      if (uses.size() > 1) noteFurtherUses(report, uses[1].range, uses.size() - 1);
    }
  }

  // Adds the table to the analysis: definitionOf(symbol) for each symbol, by its number, and the uses.
  template <class DefinitionOf>
  void addTo(Analysis& analysis, DefinitionOf definitionOf) const {
    for (const Symbol& symbol : symbols_) analysis.define(definitionOf(symbol));
    for (const NameUse& name : uses_) analysis.use(name.range, name.definition);
  }

protected:
  explicit SymbolTable(NameKey keyOf = asWritten) : keyOf_(keyOf) {}

  void addScope() { scopes_.emplace_back(); }
  // Adds a symbol that cannot be found by name.
  uint32_t add(Symbol symbol) {
    symbols_.push_back(std::move(symbol));
    return static_cast<uint32_t>(symbols_.size() - 1);
  }
  // Adds a symbol and lets its name refer to it from now on.
  uint32_t enter(Symbol symbol, uint32_t scope = 0) {
    const uint32_t index = add(std::move(symbol));
    scopes_[scope].insert_or_assign(keyOf_(symbols_[index].name), index);
    return index;
  }
  // The same, but a name that the scope already has is reported; then kNoName.
  uint32_t declare(Symbol symbol, Diagnostics& diagnostics) {
    const uint32_t first = find(symbol.name);
    if (first == kNoName) return enter(std::move(symbol));
    reportDuplicate(diagnostics, symbol.name, symbol.declared, symbols_[first].declared);
    return kNoName;
  }
  // Called when the dialect has reported that the declared name is invalid.
  void refuse(std::string_view name) { refused_.insert(keyOf_(name)); }
  Symbol& edit(uint32_t symbol) { return symbols_[symbol]; }

private:
  NameKey keyOf_;
  std::deque<Symbol> symbols_;
  std::vector<std::unordered_map<std::string, uint32_t>> scopes_{1};
  std::vector<NameUse> uses_;
  std::set<std::string> refused_;
  std::map<std::string, std::vector<Undeclared>> undeclared_;
};

} // namespace rung::frontend
