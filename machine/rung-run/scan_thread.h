// The thread that scans a program on the machine's clock: a step of the box at each multiple of the period, between the
// newest inputs of its connections and their outputs.
#pragma once
#include <atomic>
#include <cstdint>
#include <future>
#include <string>
#include <thread>

#include "machine/host/box.h"
#include "machine/io/connections/connections.h"
#include "machine/io/host_devices.h"
#include "machine/rung-run/pins.h"
#include "machine/rung-run/step_times.h"
#include "rtlib/run/realtime.h"

namespace rung::rung_run {

struct ScanOptions {
  int64_t periodNs = 1'000'000;
  int64_t earlyNs = 0; // it wakes so long before a step is due; less than the period
  runtime::RealTimeOptions thread;
};

class ScanThread {
public:
  ScanThread(host::Box& box, const Pins& pins, io::Connections& connections, io::HostDevices& devices,
             const ScanOptions& options)
      : box_(box), pins_(pins), connections_(connections), devices_(devices), options_(options) {}
  ~ScanThread() { end(); }
  ScanThread(const ScanThread&) = delete;
  ScanThread& operator=(const ScanThread&) = delete;

  // "" or what the system does not grant.
  std::string start();
  // When the program needs no more steps; a few at most, unless it waits for its machine.
  void end();
  // The same in two: it may be that it waits for the thread that serves the box.
  void beginEnd() noexcept { ending_ = true; }
  bool hasEnded() const noexcept { return ended_; }

  int64_t periodNs() const noexcept { return options_.periodNs; }
  uint64_t steps() const noexcept { return times_.steps(); } // so far
  StepFigures figures() const { return times_.figures(); }

private:
  void run(std::promise<std::string> begun);
  void waitFor(int64_t due) const noexcept;
  void step(int64_t due, int64_t& last) noexcept;

  host::Box& box_;
  const Pins& pins_;
  io::Connections& connections_;
  io::HostDevices& devices_;
  ScanOptions options_;
  std::thread thread_;
  std::atomic<bool> ending_{false};
  std::atomic<bool> ended_{false};
  int64_t begunNs_ = 0;
  StepTimes times_;
};

} // namespace rung::rung_run
