// Cells of the interface that instructions of axes and drives write beside their request.
#pragma once

#include "frontend/dialects/technol/lower/areas.h"
#include "frontend/dialects/technol/read/symbols.h"
#include "ir/support/check.h"
#include "rtlib/nc/technol/signals.h"

namespace rung::frontend::technol {

inline constexpr int64_t kMostAxes = 16;

inline const nc::Signal& interfaceSignal(std::string_view name) {
  const nc::Signal* signal = nc::findSignal(nc::technolSignals(), name, "I");
  RUNG_CHECK(signal != nullptr, "a cell that the interface lacks");
  return *signal;
}
inline ir::Place placeOf(std::string_view name) {
  const nc::Signal& signal = interfaceSignal(name);
  return {.space = kInterfaceSpace, .byte = signal.byteOffset, .bit = signal.bit};
}

// Whether an axis, i64, exists: 1 to 16.
inline ir::ValueId isAxis(ir::RungBuilder& b, ir::ValueId axis) {
  const ir::ValueId number = b.sub(axis, b.constant(ir::Type::I64, 1));
  return b.ltU(number, b.constant(ir::Type::I64, kMostAxes));
}

// Sets the bit of an axis, i64, in two bytes of eight axes each, where `when` is 1.
inline void setBitOfAxis(ir::RungBuilder& b, std::string_view low, std::string_view high, ir::ValueId axis,
                         ir::ValueId when) {
  const ir::ValueId number = b.zextOrTrunc(ir::Type::I32, b.sub(axis, b.constant(ir::Type::I64, 1)));
  const ir::ValueId isLow = b.ltU(number, b.i32(8));
  const ir::ValueId bit = b.and_(number, b.i32(7));
  const auto set = [&](std::string_view byte, ir::ValueId where) {
    const ir::Window window{.space = kInterfaceSpace, .byte = placeOf(byte).byte, .count = 1};
    b.when(b.and_(when, where), [&] { b.storeBitAt(window, b.i32(0), bit, b.bit(true)); });
  };
  set(low, isLow);
  set(high, b.not_(isLow));
}

} // namespace rung::frontend::technol
