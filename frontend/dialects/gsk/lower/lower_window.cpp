// Window functions: what GSK's CNC refuses, is asked for and answers (§8; man. l.3089-3239, 8482-8682).
#include <algorithm>

#include "frontend/dialects/gsk/lower/lower.h"
#include "frontend/network/lower/window.h"
#include "rtlib/nc/gsk/services.h"
#include "rtlib/nc/gsk/window_functions.h"

namespace rung::frontend::gsk {
namespace {

using ir::Type;
using ir::ValueId;
namespace window = nc::gsk;

class GskWindow final : public network::WindowLowering {
public:
  explicit GskWindow(Lowering& f) : WindowLowering(f, f.variant() == kWindowWrite, window::windowFunctions()) {}

private:
  ValueId refusal(ValueId function, ValueId length) override;
  ValueId request(ValueId function, ValueId length) override;
  int64_t notProvided() const override { return window::kWindowNotProvided; }
  void finish(const Answer& answer) override;
  ValueId dataToWrite(ValueId length);
};

// P49: end code of a request that is refused without asking the CNC. Data beyond the end of the area have no valid
// length (end code 2, man. l.8671).
ValueId GskWindow::refusal(ValueId function, ValueId length) {
  const auto access = writes() ? nc::pmc::WindowAccess::Write : nc::pmc::WindowAccess::Read;
  const ValueId known = isOneOf(function, [&](const auto& f) { return f.access == access; });
  const ValueId closed =
      isOneOf(function, [](const auto& f) { return f.status == nc::pmc::WindowStatus::ClosedInList; });
  uint64_t lengths = 0;
  for (uint32_t bytes = 1; bytes <= std::min(room(), window::kWindowMaxLength); ++bytes)
    if (window::isWindowLength(bytes)) lengths |= uint64_t{1} << bytes;
  const auto code = [&](uint16_t end) { return b_.constant(Type::I64, end); };
  const ValueId badLength =
      b_.select(isIn(b_, length, lengths), code(window::kWindowDone), code(window::kWindowBadLength));
  const ValueId badStatus = b_.select(closed, code(window::kWindowNotProvided), badLength);
  return b_.select(known, badStatus, code(window::kWindowBadFunction));
}

ValueId GskWindow::dataToWrite(ValueId length) {
  ValueId data = b_.sextOrTrunc(Type::I64, f_.load(Type::I8, at(nc::pmc::kWindowDataAt)));
  for (uint32_t bytes : {2u, 4u}) {
    if (bytes > room()) break;
    const ValueId wider = b_.sextOrTrunc(Type::I64, f_.load(ir::intOfBytes(bytes), at(nc::pmc::kWindowDataAt)));
    data = b_.select(b_.eq(length, b_.constant(Type::I16, bytes)), wider, data);
  }
  return data;
}

ValueId GskWindow::request(ValueId function, ValueId length) {
  const auto raw = [&](ValueId value) { return b_.zextOrTrunc(Type::I64, value); };
  std::vector<ValueId> args{raw(function), raw(length), raw(word(nc::pmc::kWindowNumberAt)),
                            raw(word(nc::pmc::kWindowAttributeAt))};
  if (writes()) args.push_back(dataToWrite(length));
  const auto kind = writes() ? nc::pmc::ServiceKind::WriteWindow : nc::pmc::ServiceKind::ReadWindow;
  return b_.serviceRequest(f_.service(nc::gsk::service(kind)), args);
}

// End code of an answer. A host that answers with an error, or does not answer although it must, does not provide the
// function.

// P47: bit 0 of the result reports an error. Data are valid only with end code 0 (man. l.8665).
void GskWindow::finish(const Answer& answer) {
  b_.when(answer.finished, [&] {
    f_.store(at(nc::pmc::kWindowEndAt), b_.zextOrTrunc(Type::I16, answer.end));
    const ValueId good = b_.eq(answer.end, b_.constant(Type::I64, window::kWindowDone));
    f_.store(f_.param(1).address, b_.zextOrTrunc(Type::I8, b_.not_(good)));
    if (writes()) return;
    const ValueId data = b_.serviceResult(answer.ticket, 1);
    for (uint32_t bytes : {1u, 2u, 4u}) {
      if (bytes > room()) break;
      b_.when(b_.and_(good, b_.eq(answer.length, b_.constant(Type::I16, bytes))),
              [&] { f_.store(at(nc::pmc::kWindowDataAt), b_.zextOrTrunc(ir::intOfBytes(bytes), data)); });
    }
  });
}

} // namespace

void lowerWindow(Lowering& f) { GskWindow(f).run(); }

} // namespace rung::frontend::gsk
