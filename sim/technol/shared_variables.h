// The variables of a running program that its control knows by names: mapped and logical inputs and outputs, and what
// SHARE_VAR and SHARE_BIT share (man. ch. 10, 18.2, 27). The program declares them while it starts.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "rtlib/change/relocation.h"
#include "rtlib/nc/technol/exchange.h"
#include "rtlib/run/instance.h"

namespace rung::sim::technol {

struct SharedVariable {
  std::string name; // as the program writes it
  nc::ExchangeKind kind = nc::ExchangeKind::Variable;
  nc::ExchangeType type = nc::ExchangeType::Uns8;
  nc::ExchangePeriod period = nc::ExchangePeriod::Slow;
  uint32_t count = 1; // elements, or bytes of a text
  uint32_t space = 0, byte = 0, bit = 0;
  std::optional<runtime::Ref> least, most; // of SHARE_VAR: reals

  // What the program takes from the control; a screen may write it.
  bool isInput() const {
    return kind == nc::ExchangeKind::MapIn || kind == nc::ExchangeKind::MapAin || kind == nc::ExchangeKind::DefIn;
  }
  bool isMapped() const { return nc::isMapped(kind); }
  bool isLogical() const { return kind == nc::ExchangeKind::DefIn || kind == nc::ExchangeKind::DefOut; }
  bool isText() const { return nc::isText(type); }
};

// The place of an element.
runtime::Ref placeOf(const SharedVariable& variable, uint32_t element);

class SharedVariables {
public:
  SharedVariables() { all_.reserve(kUsual); }
  void clear();
  // False where the name has another meaning already, or the place is not in the program's memory. `isNew` says
  // whether something has changed.
  bool define(const rung_program& program, SharedVariable variable, bool& isNew);

  // In another program; those that it does not have are dropped.
  void relocate(const runtime::Relocation& relocation);

  const std::vector<SharedVariable>& all() const { return all_; }
  // By a canonical identifier of a DEF_IN or DEF_OUT.
  const SharedVariable* logical(nc::ExchangeKind kind, std::string_view identifier) const;
  // By the name that a screen uses: of any kind, with the index of an element and `.Bit[k]` after it, as `PLC.Input.`
  // or `PLC.Output.` identifier or the identifier alone.
  std::optional<runtime::Ref> find(std::string_view name, bool toWrite) const;
  // Of MAP_* and DEF_*: the variable that holds the place, and which of its elements.
  const SharedVariable* at(const runtime::Ref& place, uint32_t& element) const;

private:
  static constexpr size_t kUsual = 1024; // more than that allocate when they are defined
  const SharedVariable* byName(std::string_view name, bool toWrite) const;

  std::vector<SharedVariable> all_;
  // By kind (see cpp) and canonical identifier.
  std::unordered_map<std::string, uint32_t> byKey_;
};

// What kDefineService declares.
std::optional<SharedVariable> variableOf(const core::ServiceRequest& request);

} // namespace rung::sim::technol
