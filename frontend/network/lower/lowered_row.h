// A row with its lowering.
#pragma once
#include "frontend/network/language.h"

namespace rung::frontend::network {

class Lowering;

using LowerFn = void (*)(Lowering& f);

struct LoweredRow : Row {
  LowerFn lower = nullptr; // null: known, but not built
  int variant = 0;         // for `lower`
  // The information about runs of its level that it needs; tracked only if a row needs it.
  enum class Asks : uint8_t { Nothing, Time, Count } asks = Asks::Nothing;
};

// All rows of a language whose programs are lowered have this type.
inline const LoweredRow& loweredRow(const Row& row) { return static_cast<const LoweredRow&>(row); }

} // namespace rung::frontend::network
