// Loading, offering and saving at the end.
#include "sim/retained_tables.h"

#include <algorithm>
#include <string_view>

#include "rtlib/load/program_info.h"
#include "rtlib/nc/nct/operand_block.h"
#include "rtlib/nc/service.h"

namespace rung::sim {

namespace {

// To be changed with the order or the meaning of the data that a model retains; other changes are detected by the size.
constexpr uint64_t kFormat = 0x52554E474E430001;

} // namespace

RetainedTables::RetainedTables(SimulatedNc& model, const std::string& file, std::chrono::milliseconds period)
    : model_(&model), size_(model.retainedSize()),
      store_(std::make_unique<runtime::RetainStore>(file + ".nc", kFormat, size_)), period_(period) {}

bool RetainedTables::load(std::string& report, std::string& error) {
  if (size_ == 0 || !store_->lock(error)) return false;
  const runtime::RetainImage image = store_->load();
  report = image.report;
  model_->restoreRetained(image.found ? std::span<const uint8_t>(image.bytes) : std::span<const uint8_t>());
  std::vector<uint8_t> now(size_);
  model_->copyRetained(now);
  if (!store_->save(now, error)) return false;
  const auto pack = [](std::span<const uint8_t> raw, std::span<uint8_t> to) { std::ranges::copy(raw, to.begin()); };
  saver_ = std::make_unique<runtime::RetainSaver>(
      std::move(store_), std::make_unique<runtime::RetainChannel>(kFormat, size_, size_, pack), period_);
  return image.found;
}

void RetainedTables::offer() noexcept {
  if (saver_ && saver_->taken()) saver_->offerFrom([this](std::span<uint8_t> to) { model_->copyRetained(to); });
}

std::string RetainedTables::finish() {
  if (!saver_) return {};
  saver_->offerFrom([this](std::span<uint8_t> to) { model_->copyRetained(to); });
  return saver_->flush() ? std::string() : saver_->problem();
}

// Translates requests for another program.

uint32_t Relocation::service(uint32_t number) const {
  return number < from_->service_count ? runtime::findService(*to_, runtime::serviceName(*from_, number)) : RUNG_NONE;
}

void Relocation::renumber(core::ServiceRequest& request) const {
  const nc::ServiceRow* row = nc::serviceOf(from_->dialect, request.name->kind);
  const auto block = row == nullptr ? std::nullopt : row->arguments.find("block");
  request.service = service(request.service);
  if (block && request.service != RUNG_NONE) {
    int64_t& first = request.args[*block]; // an index of a word in the space
    const auto moved =
        place(runtime::intRef(runtime::findSpace(*from_, nc::nct::kBlockSpace), 4 * static_cast<uint32_t>(first), 32));
    if (moved)
      first = moved->byte / 4;
    else
      request.service = RUNG_NONE;
  }
  if (request.service == RUNG_NONE) request.name = {};
}

} // namespace rung::sim
