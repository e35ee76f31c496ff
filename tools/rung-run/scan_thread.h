// The thread that scans a program on the machine's clock: a step of the box at each multiple of the period.
#pragma once
#include <atomic>
#include <cstdint>
#include <future>
#include <string>
#include <thread>

#include "rtlib/host/realtime.h"
#include "tools/plc/box.h"

namespace rung::rung_run {

struct ScanOptions {
  int64_t periodNs = 1'000'000;
  host::RealTimeOptions thread;
};

// Figures of all steps so far, each by itself.
struct ScanFigures {
  uint64_t steps = 0;
  uint64_t overruns = 0; // steps that began a whole period late, or later
  int64_t lateNs = 0;    // the latest beginning of a step
  int64_t worstNs = 0;   // the longest step
};

class ScanThread {
public:
  ScanThread(plc::Box& box, const ScanOptions& options) : box_(box), options_(options) {}
  ~ScanThread() { end(); }
  ScanThread(const ScanThread&) = delete;
  ScanThread& operator=(const ScanThread&) = delete;

  // "" or what the system does not grant.
  std::string start();
  // After the step that is under way.
  void end();

  ScanFigures figures() const noexcept;
  std::string report() const; // for people

private:
  void run(std::promise<std::string> begun);
  void step(int64_t due, int64_t& last) noexcept;

  plc::Box& box_;
  ScanOptions options_;
  std::thread thread_;
  std::atomic<bool> ending_{false};
  std::atomic<uint64_t> steps_{0}, overruns_{0};
  std::atomic<int64_t> lateNs_{0}, worstNs_{0};
};

} // namespace rung::rung_run
