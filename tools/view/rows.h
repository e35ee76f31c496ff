// The instruction rows of a dialect, for boxes.
#pragma once
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "frontend/dialects/dialect.h"
#include "frontend/ladder/ladder.h"

namespace rung::view {

class Rows {
public:
  explicit Rows(const frontend::Dialect& dialect);
  Rows(const Rows&) = delete;
  Rows& operator=(const Rows&) = delete;

  // Null for a mnemonic that the dialect does not have.
  const frontend::InstructionInfo* find(std::string_view mnemonic) const;
  // For the parser of ladder text.
  const ladder::FurtherPins& furtherPins() const { return furtherPins_; }

private:
  struct Entry {
    const frontend::InstructionInfo* info = nullptr;
    std::vector<std::string_view> furtherPins;
  };
  const Entry* entry(std::string_view mnemonic) const;

  bool ignoreCase_;
  std::unordered_map<std::string, Entry> rows_;
  ladder::FurtherPins furtherPins_;
};

} // namespace rung::view
