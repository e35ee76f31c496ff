// The names of a program in their scopes. What a name means is the dialect's; that it means one thing is checked here.
#pragma once
#include <cstdint>
#include <deque>
#include <initializer_list>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "ir/support/diagnostics.h"

namespace rung::frontend {

inline constexpr uint32_t kNoName = UINT32_MAX;

inline constexpr std::string_view kFirstDeclared = "first declared here";

// Reports a name that is declared again. `first` is the former place, and `note` what it is; invalid: the control has
// the name.
void reportDuplicate(Diagnostics& diagnostics, std::string_view name, SourceRange range, SourceRange first,
                     std::string_view note = kFirstDeclared);

// Capitals and small letters differ, and all of a name counts.
constexpr std::string_view asWritten(std::string_view name) { return name; }

// A Symbol has a `name`, whose text lives as long as the table, and the range `declared`: invalid, it is the control's.
// Two names of the same key are one name. Symbols are numbered in the order of entering and stay where they are. Scope
// 0 is there from the beginning; each addScope makes the next.
template <class Symbol, auto keyOf = asWritten>
class NameTable {
public:
  void addScope() { scopes_.emplace_back(); }

  // A symbol that no name leads to.
  uint32_t add(Symbol symbol) {
    symbols_.push_back(std::move(symbol));
    return static_cast<uint32_t>(symbols_.size() - 1);
  }
  // A symbol that its name leads to from now on.
  uint32_t enter(Symbol symbol, uint32_t scope = 0) {
    const uint32_t index = add(std::move(symbol));
    scopes_[scope].insert_or_assign(keyOf(symbols_[index].name), index);
    return index;
  }
  // The same, but a name that the scope has already is reported; kNoName then.
  uint32_t declare(Symbol symbol, Diagnostics& diagnostics) {
    const uint32_t first = find(symbol.name);
    if (first == kNoName) return enter(std::move(symbol));
    reportDuplicate(diagnostics, symbol.name, symbol.declared, symbols_[first].declared);
    return kNoName;
  }
  // In the first of the scopes that has the name; kNoName where none has.
  uint32_t find(std::string_view name, std::initializer_list<uint32_t> scopes = {0}) const {
    const auto key = keyOf(name);
    for (const uint32_t scope : scopes)
      if (const auto at = scopes_[scope].find(key); at != scopes_[scope].end()) return at->second;
    return kNoName;
  }

  Symbol& operator[](uint32_t index) { return symbols_[index]; }
  const Symbol& operator[](uint32_t index) const { return symbols_[index]; }
  const std::deque<Symbol>& all() const { return symbols_; }

private:
  using Scope = std::unordered_map<decltype(keyOf(std::string_view())), uint32_t>;

  std::deque<Symbol> symbols_;
  std::vector<Scope> scopes_{1};
};

} // namespace rung::frontend
