// Load, offer, finish (see retained_memory.h).
#include "rtlib/retain/retained_memory.h"

namespace rung::runtime {

namespace {

// A program that asks waits for the answer.
std::chrono::milliseconds periodOf(RetainWhen when) {
  return std::chrono::milliseconds(when == RetainWhen::OnRequest ? 5 : 200);
}

} // namespace

RetainedMemory::RetainedMemory(const rung_program& program, const std::string& file, RetainWhen when, RetainTake take,
                               const Outside& outside)
    : RetainedMemory(program, file, when, take, outside.savePeriod.value_or(periodOf(when)), *outside.disk) {}

RetainedMemory::RetainedMemory(const rung_program& program, const std::string& file, RetainWhen when, RetainTake take,
                               std::chrono::milliseconds period, Disk& disk)
    : map_(program), when_(when), take_(take),
      store_(std::make_unique<RetainStore>(file, map_.layout(), map_.size(), disk)), period_(period) {}

bool RetainedMemory::load(Instance& instance, std::string& report, std::string& error) {
  if (!store_->lock(error)) return false;
  RetainImage image = store_->load();
  if (!image.description.empty()) {
    if (take_ != nullptr) take_(instance.program(), map_, image);
    if (!image.found) image.report += "; starting cold";
  }
  report = image.report;
  lost_ = !image.found && !report.empty();
  std::vector<uint8_t> raw(map_.rawSize());
  if (image.found) {
    map_.unpack(image.bytes, raw);
    instance.restoreRetained(raw);
  }
  std::vector<uint8_t> now(map_.size());
  instance.copyRetained(raw);
  map_.pack(raw, now);
  if (!store_->save(now, error)) return false;
  saver_ = std::make_unique<RetainSaver>(std::move(store_), std::make_unique<RetainLane>(map_), period_);
  return image.found;
}

bool RetainedMemory::offer(const Instance& instance, bool asked) noexcept {
  if (instance.faulted()) return false;
  if (!asked) request_ = 0;
  const bool begins = asked && request_ == 0;
  if (instance.atListStart() && (begins || when_ == RetainWhen::Always)) {
    const uint64_t ticket = saver_->offer(instance);
    if (begins) request_ = ticket;
  }
  if (request_ == 0 || saver_->stored() < request_) return false;
  request_ = 0;
  return true;
}

std::string RetainedMemory::finish(const Instance& instance) {
  if (!instance.faulted()) saver_->offer(instance);
  return saver_->flush() ? std::string() : saver_->problem();
}

} // namespace rung::runtime
