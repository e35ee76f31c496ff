// Load, offer, finish (see retained_memory.h).
#include "rtlib/host/retained_memory.h"

namespace rung::host {

RetainedMemory::RetainedMemory(const rung_program& program, const std::string& file, std::chrono::milliseconds period)
    : map_(program), store_(file, map_.hash(), map_.size()), file_(file), period_(period) {}

bool RetainedMemory::load(Instance& instance, std::string& report, std::string& error) {
  const RetainImage image = store_.load();
  report = image.report;
  if (image.found) {
    std::vector<uint8_t> raw(map_.rawSize());
    map_.unpack(image.bytes, raw);
    instance.restoreRetained(raw);
  }
  std::vector<uint8_t> raw(map_.rawSize());
  std::vector<uint8_t> now(map_.size());
  instance.copyRetained(raw);
  map_.pack(raw, now);
  store_.save(now, error);
  saver_ = std::make_unique<RetainSaver>(std::move(store_), map_, period_);
  return image.found;
}

std::string RetainedMemory::finish(const Instance& instance) {
  saver_->finish(instance);
  return saver_->failed() == 0 ? std::string() : saver_->lastError();
}

} // namespace rung::host
