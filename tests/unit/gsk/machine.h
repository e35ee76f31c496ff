// A compiled program that runs in a test: names as in the program, time in slots of 8 ms.
#pragma once
#include <gtest/gtest.h>

#include "ir/interp/interp.h"
#include "ir/shape/layout.h"
#include "ir/verify/verify.h"
#include "rtlib/nc/names/names.h"
#include "rtlib/run/instance.h"
#include "tests/unit/gsk/compile.h"

namespace rung::frontend::gsk::test {

class Machine {
public:
  explicit Machine(std::unique_ptr<Compiled> program) : program_(std::move(program)) {
    if (program_->module == nullptr) {
      ADD_FAILURE() << program_->text();
      std::abort();
    }
    const auto errors = ir::verify(*program_->module, ir::Mode::Built);
    EXPECT_TRUE(errors.empty()) << ir::render(*program_->module, errors);
    layout_ = std::make_unique<ir::Layout>(*program_->module, ir::LayoutOptions{});
    engine_ = std::make_unique<ir::InterpEngine>(*layout_, 0);
    instance_ = std::make_unique<runtime::Instance>(*engine_);
  }

  uint64_t get(const std::string& name) const { return instance_->read(ref(name)); }
  void set(const std::string& name, uint64_t value) { EXPECT_EQ(instance_->write(ref(name), value), std::nullopt); }
  void scan(int count = 1) {
    for (int i = 0; i < count; ++i) instance_->scan();
  }
  runtime::Instance& instance() { return *instance_; }
  const ir::Module& module() const { return *program_->module; }

private:
  runtime::Ref ref(const std::string& name) const {
    const auto found = nc::resolve(instance_->program(), name);
    if (!found) ADD_FAILURE() << name;
    return found.value_or(runtime::Ref{});
  }

  std::unique_ptr<Compiled> program_;
  std::unique_ptr<ir::Layout> layout_;
  std::unique_ptr<ir::InterpEngine> engine_;
  std::unique_ptr<runtime::Instance> instance_;
};

} // namespace rung::frontend::gsk::test
