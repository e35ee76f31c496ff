// Load, offer, finish (see retained_tables.h).
#include "sim/retained_tables.h"

#include <algorithm>

namespace rung::sim {
namespace {

// Changes with the order or the meaning of what a model keeps; its size shows the rest.
constexpr uint64_t kFormat = 0x52554E474E430001;

} // namespace

RetainedTables::RetainedTables(SimulatedNc& model, const std::string& file, std::chrono::milliseconds period)
    : model_(&model), size_(model.keptSize()),
      store_(std::make_unique<runtime::RetainStore>(file + ".nc", kFormat, size_)), period_(period) {}

bool RetainedTables::load(std::string& report, std::string& error) {
  if (size_ == 0 || !store_->lock(error)) return false;
  const runtime::RetainImage image = store_->load();
  report = image.report;
  model_->restoreKept(image.found ? std::span<const uint8_t>(image.bytes) : std::span<const uint8_t>());
  std::vector<uint8_t> now(size_);
  model_->copyKept(now);
  if (!store_->save(now, error)) return false;
  const auto pack = [](std::span<const uint8_t> raw, std::span<uint8_t> to) { std::ranges::copy(raw, to.begin()); };
  saver_ = std::make_unique<runtime::RetainSaver>(
      std::move(store_), std::make_unique<runtime::RetainLane>(kFormat, size_, size_, pack), period_);
  return image.found;
}

void RetainedTables::offer() noexcept {
  if (saver_ && saver_->taken()) saver_->offerFrom([this](std::span<uint8_t> to) { model_->copyKept(to); });
}

std::string RetainedTables::finish() {
  if (!saver_) return {};
  saver_->offerFrom([this](std::span<uint8_t> to) { model_->copyKept(to); });
  return saver_->flush() ? std::string() : saver_->problem();
}

} // namespace rung::sim
