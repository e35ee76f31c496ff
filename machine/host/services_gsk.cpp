// Window functions of the GSK25i (man. l.8482-8945).
#include <cmath>

#include "machine/host/services_pmc.h"
#include "rtlib/nc/gsk/window_functions.h"

namespace rung::host {
namespace {

using nc::pmc::WindowAccess;
using nc::pmc::WindowField;
using nc::pmc::WindowFunction;

enum Code : uint16_t { // codes of functions
  kReadOffset = 1,
  kWriteOffset = 2,
  kReadOrigin = 3,
  kWriteOrigin = 4,
  kReadVariable = 9,
  kWriteVariable = 10,
  kSequence = 14,
  kMachinePosition = 17,
  kTool = 31,
};

bool isOutside(const WindowField& field, uint64_t value) noexcept {
  return !field.meaning.empty() && (value < field.min || (field.max != nc::pmc::kNoLimit && value > field.max));
}

class GskWindows final : public WindowDialect {
public:
  constexpr GskWindows() : WindowDialect({.stepsPerMm = 10000}) {} // data 2 (P54)

  const WindowFunction* find(uint64_t code) const noexcept override {
    return nc::pmc::findWindowFunction(nc::gsk::windowFunctions(), code);
  }

  // Checks in the order of the end codes.
  int64_t mistakeOf(const Window& w) const noexcept override {
    const WindowFunction* f = w.function;
    if (f == nullptr || (f->access == WindowAccess::Write) != w.write) return nc::gsk::kWindowBadFunction;
    if (!nc::gsk::isWindowLength(w.length)) return nc::gsk::kWindowBadLength;
    if (f->status != nc::pmc::WindowStatus::Open) return nc::gsk::kWindowNotProvided;
    if (isOutside(f->number, w.number)) return nc::gsk::kWindowBadCount;
    if (isOutside(f->attribute, w.attribute)) return nc::gsk::kWindowBadAttribute;
    const bool whole = !f->wholeOnly || dataOf(w) % f->scale == 0;
    return whole ? nc::gsk::kWindowDone : nc::gsk::kWindowBadData;
  }

  rung_reply highSpeed(const Window& window, const Live& live) const noexcept override {
    if (window.code == kSequence) return given(window, live.line.load(std::memory_order_relaxed));
    if (window.code != kMachinePosition) return ended(window, nc::gsk::kWindowNotProvided);
    const uint64_t axis = window.attribute - 1;
    if (axis >= live.axes.load(std::memory_order_relaxed)) return ended(window, nc::gsk::kWindowBadAttribute);
    return given(window, live.machine[axis].load(std::memory_order_relaxed));
  }

  std::optional<Operation> operationOf(const Window& window) const override {
    const std::optional<Quantity> quantity = quantityOf(window);
    if (!quantity) return std::nullopt;
    const bool offset = window.code == kReadOffset || window.code == kWriteOffset;
    return Operation{.quantity = *quantity,
                     .write = window.write,
                     .number = static_cast<uint32_t>(window.number) + (offset ? 1 : 0), // M is one less (l.8694)
                     .axis = *quantity == Quantity::WorkOffset ? static_cast<uint32_t>(window.attribute) : 0,
                     .value = static_cast<double>(dataOf(window)) / window.function->scale};
  }

  // In the units of the function; an error if the value exceeds the requested length.
  rung_reply given(const Window& window, double value) const noexcept override {
    const double data = std::round(value * window.function->scale);
    return fitsBytes(data, window.length) ? reply(window, nc::gsk::kWindowDone, data)
                                          : ended(window, nc::gsk::kWindowBadLength);
  }
  rung_reply ended(const Window& window, int64_t end) const noexcept override { return reply(window, end, 0); }

  int64_t endOf(Outcome outcome, bool write) const noexcept override {
    switch (outcome) {
    case Outcome::Done: return nc::gsk::kWindowDone;
    case Outcome::NoQuantity: return nc::gsk::kWindowNotProvided;
    case Outcome::NoNumber: return nc::gsk::kWindowBadCount;
    case Outcome::NoAxis: return nc::gsk::kWindowBadAttribute;
    case Outcome::BadValue: return nc::gsk::kWindowBadData;
    case Outcome::NotNow: return write ? nc::gsk::kWindowProtected : nc::gsk::kWindowNotProvided;
    }
    return nc::gsk::kWindowNotProvided;
  }

private:
  static int64_t dataOf(const Window& window) noexcept { return window.write ? window.request->args[4] : 0; }

  static rung_reply reply(const Window& window, int64_t end, double data) noexcept {
    return {.size = sizeof(rung_reply),
            .ticket = window.request->ticket,
            .error = 0,
            .result_count = window.write ? 1u : 2u,
            .results = {end, std::llround(data)}};
  }

  static std::optional<Quantity> quantityOf(const Window& window) noexcept {
    constexpr Quantity kOffsets[] = {Quantity::ToolLength, Quantity::ToolLengthWear, Quantity::ToolRadius,
                                     Quantity::ToolRadiusWear}; // indexed by the attribute
    switch (window.code) {
    case kReadOffset:
    case kWriteOffset: return kOffsets[window.attribute];
    case kReadOrigin:
    case kWriteOrigin: return Quantity::WorkOffset;
    case kReadVariable:
    case kWriteVariable: return Quantity::MacroVariable;
    case kTool: return Quantity::ToolNumber;
    default: return std::nullopt; // parameters, pitch compensation
    }
  }
};

} // namespace

const Translation& gskTranslation() {
  static constexpr GskWindows kWindows;
  static constexpr PmcTranslation kGsk(kWindows);
  return kGsk;
}

} // namespace rung::host
