// PLC tables on a thread of the host, which also accesses their files: requests of the program are sent to it as
// tickets through one ring, and answers return through another (man. l.18671: the instructions take several scans).
#pragma once
#include <array>
#include <atomic>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "machine/io/device_call.h"
#include "machine/io/tables/table_files.h"
#include "machine/io/tables/table_requests.h"
#include "rtlib/core/handover.h"

namespace rung::io {

class TableService {
public:
  // Longest time that a request waits for the thread, which the scan does not wake.
  static constexpr int kPauseMs = 2;

  TableService() = default;
  ~TableService() { end(); }
  TableService(const TableService&) = delete;
  TableService& operator=(const TableService&) = delete;

  // ---- before start; the functions return "", or the errors, one line each
  std::string setDefinition(uint32_t table, const std::string& path) { return files_.setDefinition(table, path); }
  std::string setTable(uint32_t table, const std::string& path);
  std::string load() { return files_.load(tables_); }
  bool isEmpty() const { return !any_; } // no table is configured

  // ---- the thread that starts and ends the host
  void start();
  // Completes pending requests, writes changed tables to disk and ends the thread. A new error is returned by the next
  // takeProblem.
  void end();
  // A new problem with the files since the last call; "": none. Any thread except the scan thread.
  std::string takeProblem();

  // ---- scan thread; nothing waits, allocates or locks
  // At a power-on: answers to earlier requests are dropped.
  void powerOn() noexcept { ++generation_; }
  // Called within the instruction. Returns false if there is no room for the request.
  bool ask(const DeviceCall& call) noexcept;
  // Called between two scans. Returns true if there were answers, which must be delivered.
  bool takeAnswers(core::ServiceQueue& services, AnswerBytes& bytes) noexcept;

private:
  // A request and its answer, passed to the thread and back.
  struct Slot {
    uint32_t generation = 0;
    core::ServiceRequest given;
    core::ServiceReply reply;
    uint32_t count = 0; // number of bytes of the program, later of the answer
    std::array<uint8_t, nc::technol::kMostArgumentBytes> bytes{};
  };
  static constexpr uint32_t kSlots = core::ServiceQueue::kMaxPending; // more requests cannot be unanswered
  class BytesOf;                                                      // the room for an answer's bytes

  void run() noexcept;
  void serve() noexcept;
  void note(std::string problem) noexcept;

  TableFiles files_;
  PlcTables tables_; // used only by the thread between start and end
  bool any_ = false;
  uint32_t generation_ = 0;            // scan thread
  std::vector<Slot> slots_;            // empty before the start
  std::array<uint8_t, kSlots> free_{}; // scan thread
  uint32_t freeCount_ = 0;
  core::FixedRing<uint8_t, kSlots> asked_, answered_; // numbers of slots
  std::atomic<bool> ending_{false};
  std::thread thread_;
  std::mutex mutex_; // never locked by the scan thread
  std::string problem_, noted_;
};

} // namespace rung::io
