// A module under the reference interpreter, for tests.
#pragma once
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "ir/interp/interp.h"
#include "ir/text/text.h"
#include "ir/verify/verify.h"
#include "rtlib/run/instance.h"

namespace rung::ir {

// A module from its text; one that the verifier refuses fails the test.
inline Module moduleFromText(std::string_view text, Mode mode = Mode::Final) {
  ParseOutcome parsed = parse(text);
  EXPECT_TRUE(parsed.module) << parsed.error.line << ':' << parsed.error.column << ": " << parsed.error.message;
  if (!parsed.module) std::abort();
  const std::vector<VerifyError> errors = verify(*parsed.module, mode);
  EXPECT_TRUE(errors.empty()) << render(*parsed.module, errors);
  if (!errors.empty()) std::abort();
  return std::move(*parsed.module);
}

class Machine {
public:
  explicit Machine(Module module, const LayoutOptions& options = {}, runtime::ScheduleHooks* hooks = nullptr)
      : module_(std::move(module)), layout_(module_, options), engine_(layout_, 1), instance_(engine_, hooks) {}

  runtime::Instance& operator*() { return instance_; }
  runtime::Instance* operator->() { return &instance_; }
  const Layout& layout() const { return layout_; }
  const Module& module() const { return module_; }
  void observe(std::unique_ptr<RungObserver> observer) { engine_.setObserver(std::move(observer)); }

  // A little-endian value of a space.
  uint64_t value(std::string_view space, uint32_t byte, uint32_t bytes = 1) const {
    const SpaceId id = findSpace(module_, space);
    uint64_t out = 0;
    for (uint32_t i = 0; i < bytes; ++i)
      out |= static_cast<uint64_t>(instance_.memory().readByte(id.index, byte + i)) << (8 * i);
    return out;
  }
  bool bit(std::string_view space, uint32_t byte, uint32_t number) const {
    return (value(space, byte) >> number & 1) != 0;
  }

private:
  const Module module_;
  const Layout layout_;
  InterpEngine engine_;
  runtime::Instance instance_;
};

} // namespace rung::ir
