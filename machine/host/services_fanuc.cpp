// Window functions of the FANUC PMC.
#include <cmath>

#include "machine/host/services_pmc.h"
#include "rtlib/nc/fanuc/services.h"
#include "rtlib/nc/fanuc/window_functions.h"

namespace rung::host {
namespace {

using nc::pmc::WindowAccess;
using nc::pmc::WindowFunction;

enum Code : uint16_t { // codes of functions
  kReadOffset = 13,
  kWriteOffset = 14,
  kReadOrigin = 15,
  kWriteOrigin = 16,
  kReadVariable = 21,
  kWriteVariable = 22,
  kSequence = 25,
  kMachinePosition = 28,
};

constexpr uint32_t kValueBytes = 4;
constexpr uint64_t kMostPlaces = 7; // decimal places of a macro variable

bool isVariable(const WindowDialect::Window& window) noexcept {
  return window.code == kReadVariable || window.code == kWriteVariable;
}

// Answers of one value have four bytes, those of macro variables also the decimal places, those for all axes a value
// each.
class FanucWindows final : public WindowDialect {
public:
  constexpr FanucWindows() : WindowDialect({.stepsPerMm = 1000, .rapidWithoutSpeed = true}) {}

  const WindowFunction* find(uint64_t code) const noexcept override {
    return nc::pmc::findWindowFunction(nc::fanuc::windowFunctions(), code);
  }

  int64_t mistakeOf(const Window& w) const noexcept override {
    if (w.function == nullptr || (w.function->access == WindowAccess::Write) != w.write)
      return nc::fanuc::kWindowNoFunction;
    if (w.function->status != nc::pmc::WindowStatus::Open) return nc::fanuc::kWindowBadData;
    const bool isOffset = w.code == kReadOffset || w.code == kWriteOffset;
    const bool isOrigin = w.code == kReadOrigin || w.code == kWriteOrigin;
    if (isOffset && (w.number == 0 || w.attribute > 3)) return nc::fanuc::kWindowBadNumber;
    if (isOrigin && (w.attribute == 0 || w.attribute > kMostAxes)) return nc::fanuc::kWindowBadNumber; // also -1, all
    return isVariable(w) && placesOf(w) > kMostPlaces ? nc::fanuc::kWindowBadData : nc::fanuc::kWindowDone;
  }

  rung_reply highSpeed(const Window& window, const Live& live) const noexcept override {
    const uint32_t axes = live.axes.load(std::memory_order_relaxed);
    if (window.code == kSequence) return given(window, live.line.load(std::memory_order_relaxed));
    if (window.code != kMachinePosition) return ended(window, nc::fanuc::kWindowBadData);
    if (window.attribute == nc::fanuc::kWindowAllAxes) return allPositions(window, live, axes);
    const uint64_t axis = window.attribute - 1;
    if (axis >= axes) return ended(window, nc::fanuc::kWindowBadNumber);
    return given(window, live.machine[axis].load(std::memory_order_relaxed));
  }

  std::optional<Operation> operationOf(const Window& window) const override {
    const std::optional<Quantity> quantity = quantityOf(window);
    if (!quantity) return std::nullopt;
    const int64_t data = window.write ? valueOf(window) : 0;
    return Operation{.quantity = *quantity,
                     .write = window.write,
                     .number = static_cast<uint32_t>(window.number),
                     .axis = *quantity == Quantity::WorkOffset ? static_cast<uint32_t>(window.attribute - 1) : 0,
                     .value = static_cast<double>(data) / scaleOf(window)};
  }

  rung_reply given(const Window& window, double value) const noexcept override {
    const double data = std::round(value * scaleOf(window));
    if (!fitsBytes(data, kValueBytes)) return ended(window, nc::fanuc::kWindowBadForm);
    rung_reply reply = ended(window, nc::fanuc::kWindowDone);
    put(reply, 0, std::llround(data));
    if (!isVariable(window)) return reply;
    put(reply, 1, static_cast<int64_t>(placesOf(window)));
    reply.results[1] = kValueBytes + 2;
    return reply;
  }

  rung_reply ended(const Window& window, int64_t end) const noexcept override {
    const auto kind = window.write ? nc::pmc::ServiceKind::WriteWindow : nc::pmc::ServiceKind::ReadWindow;
    return {.size = sizeof(rung_reply),
            .ticket = window.request->ticket,
            .error = 0,
            .result_count = nc::fanuc::service(kind).results.count(),
            .results = {end}};
  }

  int64_t endOf(Outcome outcome, bool) const noexcept override {
    switch (outcome) {
    case Outcome::Done: return nc::fanuc::kWindowDone;
    case Outcome::NoNumber:
    case Outcome::NoAxis: return nc::fanuc::kWindowBadNumber;
    case Outcome::BadValue: return nc::fanuc::kWindowBadForm;
    case Outcome::NoQuantity:
    case Outcome::NotNow: return nc::fanuc::kWindowBadData;
    }
    return nc::fanuc::kWindowBadData;
  }

private:
  // Appends a word of an answer.
  static void put(rung_reply& reply, uint32_t word, int64_t value) noexcept {
    reply.results[nc::fanuc::kReadDataAt + word] = value;
    reply.results[1] = (word + 1) * kValueBytes;
  }

  rung_reply allPositions(const Window& window, const Live& live, uint32_t axes) const noexcept {
    static_assert(kMostAxes <= nc::fanuc::kWindowWords);
    rung_reply reply = ended(window, nc::fanuc::kWindowDone);
    for (uint32_t axis = 0; axis < axes; ++axis)
      put(reply, axis, std::llround(live.machine[axis].load(std::memory_order_relaxed) * window.function->scale));
    return reply;
  }

  // The value of a write: the bytes of the first word that count.
  static int64_t valueOf(const Window& window) noexcept {
    const auto word = static_cast<uint32_t>(window.request->args[nc::fanuc::kWriteDataAt]);
    return window.length == 1   ? static_cast<int8_t>(word)
           : window.length == 2 ? static_cast<int16_t>(word)
                                : static_cast<int32_t>(word);
  }

  // Decimal places of a macro variable: of a write after its value, where the length has room for them.
  static uint64_t placesOf(const Window& window) noexcept {
    if (!window.write || window.length < kValueBytes + 2) return window.attribute;
    return static_cast<uint64_t>(window.request->args[nc::fanuc::kWriteDataAt + 1]) & UINT16_MAX;
  }

  static double scaleOf(const Window& window) noexcept {
    return isVariable(window) ? std::pow(10.0, static_cast<double>(placesOf(window))) : window.function->scale;
  }

  static std::optional<Quantity> quantityOf(const Window& window) noexcept {
    constexpr Quantity kOffsets[] = {Quantity::ToolRadiusWear, Quantity::ToolRadius, Quantity::ToolLengthWear,
                                     Quantity::ToolLength}; // indexed by the attribute
    switch (window.code) {
    case kReadOffset:
    case kWriteOffset: return kOffsets[window.attribute];
    case kReadOrigin:
    case kWriteOrigin: return Quantity::WorkOffset;
    case kReadVariable:
    case kWriteVariable: return Quantity::MacroVariable;
    default: return std::nullopt; // parameters, clock
    }
  }
};

} // namespace

const Translation& fanucTranslation() {
  static constexpr FanucWindows kWindows;
  static constexpr PmcTranslation kFanuc(kWindows);
  return kFanuc;
}

} // namespace rung::host
