// Operations of a request to a device of the control (rtlib/nc/technol/services.h): its arguments, its results, and the
// bytes of its answer.
#pragma once
#include <string>
#include <vector>

#include "frontend/dialects/technol/lower/areas.h"
#include "frontend/dialects/technol/lower/lowering.h"
#include "frontend/dialects/technol/read/symbols.h"
#include "ir/support/check.h"
#include "rtlib/nc/technol/services.h"
#include "rtlib/nc/technol/signals.h"

namespace rung::frontend::technol {

// The form of a service's data operand. Binary: as many bytes as there is room for; Bytes: as many as another operand
// says.
enum class DataForm : uint8_t { None, Integer, Real, Text, Binary, Bytes };

class DeviceRequest {
public:
  // The service of the current statement; the second constructor is for a mnemonic with several services.
  explicit DeviceRequest(Lowering& context);
  DeviceRequest(Lowering& context, nc::technol::ServiceKind kind)
      : DeviceRequest(context, nc::technol::deviceService(kind)) {}

  // Adds the next argument, i64. Returns it.
  ir::ValueId add(ir::ValueId value);
  // Adds an operand that is a number, a bit or a word; not given: nc::technol::kNotGiven. `guard` as for Memory::reach.
  ir::ValueId addOperand(uint32_t number, const Operand& operand, ir::ValueId guard = {});
  // Returns the ticket.
  ir::ValueId send();
  // A result by its name; the table's default value if there was no answer.
  ir::ValueId result(std::string_view name);
  ir::ValueId flag(std::string_view name); // as a bit
  ir::ValueId real(std::string_view name);
  // Refers to a request sent earlier.
  void use(ir::ValueId ticket);
  // Polls the request: one call for this and for all results after it.
  ir::ValueId answered();
  // After `answered`: the control no longer has the request, because the program has not polled it for too long.
  ir::ValueId forgotten() const { return forgotten_; }

private:
  DeviceRequest(Lowering& context, const nc::technol::DeviceService& device) : l_(context), device_(device) {}

  Lowering& l_;
  const nc::technol::DeviceService& device_;
  std::vector<ir::ValueId> args_;
  ir::ValueId ticket_;
  ir::ValueId executed_;
  ir::ValueId forgotten_;
};

// The operand with the number of data bytes; null if the row has none.
const Operand* lengthIn(std::span<const OperandInfo> infos, std::span<const Operand> operands);
// The argument for `count` bytes of an area, i32.
ir::ValueId bytesArgument(Emitter& emitter, const Area& area, ir::ValueId count);
// Stores the first `count` bytes of an answer, at most `most`, in the area.
void fetchBytes(Emitter& emitter, ir::ValueId ticket, const Area& to, ir::ValueId count, uint32_t most);

// Cells of the interface that instructions of axes and drives write in addition to their request.

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

// Bytes from the results of several requests, eight per word, stored in the program's memory.

// The contents of each request.
struct PartSize {
  uint32_t bytes = 0;     // maximum
  uint32_t firstWord = 0; // index among its results
};

// Stores the words of one request, which begin at the byte `first` of the area.
inline void putWords(ir::RungBuilder& b, const Area& to, ir::ValueId count, ir::ValueId ticket, ir::ValueId first,
                     uint32_t words, uint32_t firstWord) {
  for (uint32_t w = 0; w < words; ++w) {
    const ir::ValueId word = b.serviceResult(ticket, firstWord + w);
    const ir::ValueId begin = b.add(first, b.i32(int64_t{w} * 8));
    const auto in = b.loop(8, std::array{word});
    const ir::ValueId number = b.add(begin, in[0]);
    b.when(b.ltU(number, count), [&] { storeByte(b, to, number, b.zextOrTrunc(ir::Type::I8, in[1])); });
    b.endLoop(std::array{b.shrU(in[1], b.i32(8))});
  }
}

// Stores the first `count` bytes (i32), at most `most`; `request` sends the request for a part by its number (i32) and
// returns the ticket.
template <class Request>
void putParts(ir::RungBuilder& b, const Area& to, ir::ValueId count, uint32_t most, PartSize size, Request request) {
  if (most == 0) return;
  const uint32_t parts = (most + size.bytes - 1) / size.bytes;
  const uint32_t words = parts > 1 ? size.bytes / 8 : (most + 7) / 8;
  const ir::ValueId part = b.loop(parts)[0];
  const ir::ValueId first = b.mul(part, b.i32(size.bytes));
  b.when(b.ltU(first, count), [&] { putWords(b, to, count, request(part), first, words, size.firstWord); });
  b.endLoop();
}

} // namespace rung::frontend::technol
