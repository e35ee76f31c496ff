// A generated program in one of its forms, ready to be scanned: compiled by Rung in the host's runner, or the
// straight-line form.
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "ir/support/result.h"
#include "rtlib/run/footprint.h"
#include "rtlib/run/instance.h"
#include "tools/bench/generated/form.h"
#include "tools/bench/generated/machine.h"
#include "tools/bench/generated/straight.h"

namespace rung::bench {

// The current values of everything that the work numbers.
struct Values {
  std::vector<bool> bits;
  std::vector<uint32_t> words, tables;
  std::vector<uint64_t> reals; // their bit patterns
  bool operator==(const Values&) const = default;
};

class Side {
public:
  virtual ~Side() = default;
  virtual void begin(const Machine& machine) = 0; // the state of the first scan
  virtual void apply(const Change& change) = 0;
  virtual void scan() noexcept = 0;
  virtual Values values() const = 0;
};

// Rung's form: a whole scan, without a control. All places are looked up in make().
class Ours final : public Side {
public:
  // Fails if the program lacks one of the places.
  static Result<std::unique_ptr<Ours>> make(runtime::Engine& engine, const Program& program);
  void begin(const Machine& machine) override;
  void apply(const Change& change) override;
  void scan() noexcept override { instance_.scan(); }
  Values values() const override;
  void beginWith(bool condition); // for a program without a machine: sets all of its bits
  runtime::Instance& instance() { return instance_; }
  // Prefetches what a scan reads, until the clock reaches `untilNs`.
  void touch(int64_t untilNs) const noexcept { footprint_.prefetch(instance_.block().data(), untilNs); }

private:
  explicit Ours(runtime::Engine& engine);
  void leaveOut();
  void writeConstants();

  runtime::Instance instance_;
  runtime::Footprint footprint_;
  std::vector<core::Place> inputs_; // where a write of the machine survives the process-image copies
  std::vector<core::Place> bits_, words_, tables_, reals_;
  std::vector<std::pair<core::Place, uint64_t>> constants_;
};

class Straight final : public Side {
public:
  // A shared object of straightSource. Fails if it cannot be loaded.
  static Result<std::unique_ptr<Straight>> load(const std::string& path, const Work& work, BitForm form, int msAScan);
  void begin(const Machine& machine) override;
  void apply(const Change& change) override;
  void scan() noexcept override { scan_(memory_.data(), msAScan_); }
  Values values() const override;

private:
  using Scan = void (*)(uint64_t*, int);
  Straight(Scan scan, const Work& work, BitForm form, int msAScan);
  bool bit(uint32_t number) const;
  void setBit(uint32_t number, bool value);
  uint8_t* bytes() { return reinterpret_cast<uint8_t*>(memory_.data()); }
  const uint8_t* bytes() const { return reinterpret_cast<const uint8_t*>(memory_.data()); }

  Scan scan_;
  const Work& work_;
  StraightLayout layout_;
  int msAScan_;
  std::vector<uint64_t> memory_;
};

// The first place where the values differ; "" if none does.
std::string difference(const Values& ours, const Values& theirs, const Program& program);

} // namespace rung::bench
