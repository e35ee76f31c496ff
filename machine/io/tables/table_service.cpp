// See table_service.h.
#include "machine/io/tables/table_service.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "rtlib/run/realtime.h"

namespace rung::io {

class TableService::BytesOf final : public AnswerRoom {
public:
  explicit BytesOf(Slot& slot) : slot_(slot) {}
  std::span<uint8_t> make(uint32_t, uint32_t count) override {
    slot_.count = std::min<uint32_t>(count, slot_.bytes.size());
    return std::span(slot_.bytes).first(slot_.count);
  }

private:
  Slot& slot_;
};

std::string TableService::setTable(uint32_t table, const std::string& path) {
  any_ = true;
  return files_.setTable(table, path);
}

// ---- the scan ------------------------------------------------------------------------------------------------------

bool TableService::ask(const DeviceCall& call) noexcept {
  if (freeCount_ == 0) return false;
  const uint8_t number = free_[--freeCount_];
  Slot& slot = slots_[number];
  slot.generation = generation_;
  slot.given = call.request();
  const auto argument = bytesArgumentOf(call.kind());
  slot.count = argument ? static_cast<uint32_t>(call.bytes(*argument, slot.bytes).size()) : 0;
  return asked_.push(number);
}

bool TableService::takeAnswers(core::ServiceQueue& services, AnswerBytes& bytes) noexcept {
  bool any = false;
  for (uint8_t number = 0; answered_.pop(number);) {
    const Slot& slot = slots_[number];
    if (slot.generation == generation_) {
      std::ranges::copy(std::span(slot.bytes).first(slot.count), bytes.make(slot.reply.ticket, slot.count).begin());
      any = services.complete(slot.reply) || any;
    }
    free_[freeCount_++] = number;
  }
  return any;
}

// ---- the thread ----------------------------------------------------------------------------------------------------

void TableService::start() {
  if (!any_) return;
  slots_.resize(kSlots);
  for (; freeCount_ < kSlots; ++freeCount_) free_[freeCount_] = static_cast<uint8_t>(freeCount_);
  thread_ = std::thread([this] { run(); });
}

void TableService::end() {
  if (!thread_.joinable()) return;
  ending_ = true;
  thread_.join();
  serve(); // requests of the last scan
  note(files_.saveNow(tables_));
}

void TableService::run() noexcept {
  runtime::becomeHelper();
  while (!ending_) {
    serve();
    if (std::string wrong = files_.save(tables_, runtime::monotonicNs()); !wrong.empty()) note(std::move(wrong));
    std::this_thread::sleep_for(std::chrono::milliseconds(kPauseMs));
  }
}

void TableService::serve() noexcept {
  for (uint8_t number = 0; asked_.pop(number);) {
    Slot& slot = slots_[number];
    const std::span<const uint8_t> given = std::span(slot.bytes).first(std::exchange(slot.count, 0));
    slot.reply = {};
    BytesOf room(slot);
    DeviceCall call(given, slot.given, slot.reply, room);
    answerTable(tables_, call);
    answered_.push(number);
  }
}

// A persistent problem is reported once.
void TableService::note(std::string problem) noexcept {
  const std::lock_guard lock(mutex_);
  if (problem == noted_) return;
  problem_ = noted_ = std::move(problem);
}

std::string TableService::takeProblem() {
  const std::lock_guard lock(mutex_);
  return std::exchange(problem_, {});
}

} // namespace rung::io
