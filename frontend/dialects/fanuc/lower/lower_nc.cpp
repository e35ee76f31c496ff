// Windows, axes by the PMC, external data (inventory §6.10, §7).
#include <algorithm>

#include "frontend/dialects/fanuc/lower/lower.h"
#include "frontend/network/lower/axis.h"
#include "frontend/network/lower/functions.h"
#include "frontend/network/lower/window.h"
#include "rtlib/nc/fanuc/axis_commands.h"
#include "rtlib/nc/fanuc/services.h"
#include "rtlib/nc/fanuc/window_functions.h"

namespace rung::frontend::fanuc {
namespace {

using ir::Type;
using ir::ValueId;
namespace window = nc::fanuc;

constexpr uint32_t kWordBytes = 4;
constexpr int64_t kFunctionsOfPath = 1000; // path p adds 1000(p-1) to a function code
constexpr uint32_t kLengthResult = 1;

class FanucWindow final : public network::WindowLowering {
public:
  explicit FanucWindow(Lowering& f) : WindowLowering(f, f.variant() == kWindowWrite, window::windowFunctions()) {}

private:
  ValueId refusal(ValueId function, ValueId length) override;
  ValueId request(ValueId function, ValueId length) override;
  int64_t notProvided() const override { return window::kWindowBadData; }
  void finish(const Answer& answer) override;
  ValueId codeOf(ValueId function) override { return b_.remU(function, b_.constant(Type::I16, kFunctionsOfPath)); }

  uint32_t most() const { return std::min(room(), window::kWindowMaxLength); }
  ValueId dataAt(uint32_t first, ValueId length);
  void storeData(const Answer& answer, ValueId length);
};

// A function that the CNC does not have, and data to write without a length, or beyond the end of the area.
ValueId FanucWindow::refusal(ValueId function, ValueId length) {
  const auto access = writes() ? nc::pmc::WindowAccess::Write : nc::pmc::WindowAccess::Read;
  const ValueId known = isOneOf(codeOf(function), [&](const auto& f) { return f.access == access; });
  const auto code = [&](int64_t end) { return b_.constant(Type::I64, end); };
  ValueId good = code(window::kWindowDone);
  if (writes()) {
    const ValueId one = b_.constant(Type::I16, 1);
    const ValueId fits = b_.ltU(b_.sub(length, one), b_.constant(Type::I16, most()));
    good = b_.select(fits, good, code(window::kWindowBadData));
  }
  return b_.select(known, good, code(window::kWindowNoFunction));
}

// Four bytes of the data from `first` on, fewer at the end of the area. The first word has the sign of a shorter
// number.
ValueId FanucWindow::dataAt(uint32_t first, ValueId length) {
  ValueId data = b_.constant(Type::I32, 0);
  for (uint32_t byte = first; byte < std::min(first + kWordBytes, most()); ++byte) {
    const ValueId part = b_.zextOrTrunc(Type::I32, f_.load(Type::I8, at(nc::pmc::kWindowDataAt + byte)));
    data = b_.or_(data, b_.shl(part, b_.i32(8 * (byte - first))));
  }
  if (first == 0)
    for (const uint32_t bytes : {1u, 2u}) {
      const ValueId number = b_.sextOrTrunc(Type::I32, b_.trunc(ir::intOfBytes(bytes), data));
      data = b_.select(b_.eq(length, b_.constant(Type::I16, bytes)), number, data);
    }
  return b_.sextOrTrunc(Type::I64, data);
}

// Words of data as they lie in the block; the CNC takes as many bytes as the length says.
ValueId FanucWindow::request(ValueId function, ValueId length) {
  const auto raw = [&](ValueId value) { return b_.zextOrTrunc(Type::I64, value); };
  std::vector<ValueId> args{raw(function), raw(length), raw(word(nc::pmc::kWindowNumberAt)),
                            raw(word(nc::pmc::kWindowAttributeAt))};
  for (uint32_t at = 0; writes() && at < window::kWindowMaxLength; at += kWordBytes) args.push_back(dataAt(at, length));
  const auto kind = writes() ? nc::pmc::ServiceKind::WriteWindow : nc::pmc::ServiceKind::ReadWindow;
  return b_.serviceRequest(f_.service(window::service(kind)), args);
}

// As many bytes as the CNC says; what runs over the end of the area is left out.
void FanucWindow::storeData(const Answer& answer, ValueId length) {
  for (uint32_t byte = 0; byte < most(); ++byte) {
    const ValueId word = b_.serviceResult(answer.ticket, window::kReadDataAt + byte / kWordBytes);
    b_.when(b_.ltS(b_.constant(Type::I64, byte), length), [&] {
      const ValueId part = b_.shrU(word, b_.i32(8 * (byte % kWordBytes)));
      f_.store(at(nc::pmc::kWindowDataAt + byte), b_.zextOrTrunc(Type::I8, part));
    });
  }
}

// R9000.0 reports an error.
void FanucWindow::finish(const Answer& answer) {
  b_.when(answer.finished, [&] {
    const ValueId failed = b_.ne(answer.end, b_.constant(Type::I64, window::kWindowDone));
    f_.store(at(nc::pmc::kWindowEndAt), b_.zextOrTrunc(Type::I16, answer.end));
    network::storeFlags(f_, failed, {}, {});
    if (writes()) return;
    b_.when(b_.not_(failed), [&] {
      const ValueId length = b_.serviceResult(answer.ticket, kLengthResult);
      f_.store(at(nc::pmc::kWindowLengthAt), b_.zextOrTrunc(Type::I16, length));
      storeData(answer, length);
    });
  });
}

constexpr int64_t kGroupsOfPath = 1000; // path p adds 1000(p-1) to a group
constexpr uint32_t kSignalsOfPath = 1000;

} // namespace

void lowerWindow(Lowering& f) { FanucWindow(f).run(); }

// The group with the path in its thousands. R9000.0 reports a command that does not exist.
void lowerAxisControl(Lowering& f) {
  const int64_t number = f.param(0).value;
  network::controlAxes(f, {.group = nc::fanuc::axisGroups()[static_cast<size_t>(number % kGroupsOfPath - 1)],
                           .commands = nc::fanuc::axisCommands(),
                           .g = areas::kG,
                           .f = areas::kF,
                           .offset = static_cast<uint32_t>(number / kGroupsOfPath) * kSignalsOfPath,
                           .report = [&](ValueId isUnknown) { network::storeFlags(f, isUnknown, {}, {}); }});
}

// No CNC here has external data: a request ends at once, with an error.
void lowerExternalData(Lowering& f) {
  f.b.when(f.act(), [&] { network::storeFlags(f, f.b.bit(true), {}, {}); });
  f.setOutput(f.act());
}

} // namespace rung::frontend::fanuc
