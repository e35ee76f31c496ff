// What an operand names: its address, its comment, and what it is counted under in the cross reference.
#pragma once
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "frontend/dialects/dialect.h"
#include "frontend/ladder/ladder.h"
#include "rtlib/nc/signal.h"

namespace rung::view {

struct Named {
  std::string address; // of a name; of an address the name that is declared for it
  std::string comment;
  std::string key;     // the same for all spellings of one place; empty for constants
  bool input = false;  // known to be written by the machine or the NC
  bool output = false; // known to be read by them
};

class Names {
public:
  // `module` is what the files compile to; it holds the program's symbols with their places.
  Names(const frontend::Dialect& dialect, const ir::Module& module, const std::vector<ladder::LadderFile>& files);

  Named find(std::string_view operand) const;
  // What a constant means: its value as declared, otherwise the text itself.
  std::string_view valueOf(std::string_view operand) const;
  bool isGsk() const { return gsk_; }

private:
  // A place in memory; what is not fixed follows it as it is written.
  struct Place {
    std::string_view space;
    uint32_t byte = 0;
    uint32_t bit = 0;
    bool isBit = false;
  };
  struct Known {
    Place place;
    std::string_view name;
    std::string_view comment;
  };

  void add(const Known& known);
  void addSymbol(const ir::Module& module, const ir::Symbol& symbol);
  void addSignals();
  std::string textOf(const Place& place) const;
  Named findNct(std::string_view operand) const;
  Named findGsk(std::string_view operand) const;
  Named atAddress(const Place& place) const;
  const Known* known(std::string_view name) const;
  void setTraffic(Named& named, const Place& place) const;

  bool gsk_ = false;
  std::vector<Known> known_;
  std::unordered_map<std::string_view, uint32_t> spaceFlags_; // GSK: enum rung_space_flags
  uint32_t ownMemory_ = 0;                                    // NCT: the byte that the program's own memory begins with
  std::unordered_map<std::string_view, uint32_t> byName_;
  std::unordered_map<std::string, uint32_t> byAddress_;
  std::unordered_map<std::string_view, std::string_view> constants_;
};

} // namespace rung::view
