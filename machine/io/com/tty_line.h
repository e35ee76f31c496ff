// A serial port of this machine as the line of a Port, over termios. It runs on a thread of the host other than the
// scan thread, because opening, reading and writing are system calls.
//
// A missing or disconnected device (USB) is an error of the port; the device is opened again once a second. Meanwhile
// bytes to be sent stay in the queue.
#pragma once
#include <array>
#include <atomic>
#include <cstdint>
#include <list>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <termios.h>

#include "machine/io/com/port.h"

namespace rung::io::com {

// Returns `found`, changed to raw mode and these settings. Speeds are those that termios has: 50 to 4,000,000.
termios termiosOf(const Settings& settings, termios found);
// The device of a PhysicalComNo, which counts like Windows: 1 is /dev/ttyS0 (l.21024).
std::string devicePath(uint32_t physical);
// Whether termios has a constant for the speed.
bool isStandardSpeed(uint32_t speed);

class TtyLine {
public:
  static constexpr int64_t kReopenMs = 1000;

  // A device by its path, /dev/ttyS0; `step` opens it.
  TtyLine(Port& port, std::string path) : port_(port), path_(std::move(path)) {}
  // An open descriptor; it is closed with the line, or when its device disconnects; the error is then permanent.
  TtyLine(Port& port, int descriptor);
  ~TtyLine() { close(); }
  TtyLine(const TtyLine&) = delete;
  TtyLine& operator=(const TtyLine&) = delete;

  // Moves bytes in both directions as far as possible, without waiting. `nowMs`: time of any steady clock.
  void step(int64_t nowMs) noexcept;

  // For poll: -1 if closed.
  int descriptor() const { return descriptor_; }
  // Whether bytes wait until the system has room for them.
  bool hasUnsent() const { return unsentAt_ < unsentEnd_; }
  // The current problem, for users; "": none. Any thread except the scan thread.
  std::string problem() const;

private:
  static constexpr size_t kBlock = 256;

  void open() noexcept;
  void adopt(int descriptor) noexcept;
  void close() noexcept;
  void fail(const char* what, int error) noexcept;
  void read() noexcept;
  void write() noexcept;
  bool fillUnsent() noexcept;

  Port& port_;
  std::string path_; // "": constructed with a descriptor
  int descriptor_ = -1;
  int64_t openAtMs_ = INT64_MIN; // earliest time of the next attempt to open
  int64_t nowMs_ = 0;
  std::array<uint8_t, kBlock> unsent_{}; // taken from the port
  size_t unsentAt_ = 0, unsentEnd_ = 0;
  mutable std::mutex mutex_;
  std::string problem_;
};

// The thread that serves the serial ports of this machine.

class TtyThread {
public:
  // Longest time that a byte in a queue waits for the thread, which the scan does not wake.
  static constexpr int kPauseMs = 2;

  TtyThread() = default;
  ~TtyThread() { end(); }
  TtyThread(const TtyThread&) = delete;
  TtyThread& operator=(const TtyThread&) = delete;

  // To be called before `start`; the port must outlive the thread, and its settings must not change any more. Returns
  // "", or what is wrong with the settings.
  std::string add(Port& port, std::string path);
  void add(Port& port, int descriptor) { lines_.emplace_back(port, descriptor); }
  void start();
  // Passes the queued bytes to the system, as far as it has room, and ends the thread.
  void end();

  // The current problem of each line that has one, for users. Any thread except the scan thread.
  std::vector<std::string> problems() const;

private:
  void run() noexcept;

  std::list<TtyLine> lines_; // a list, because lines must not move
  std::atomic<bool> ending_{false};
  std::thread thread_;
};

} // namespace rung::io::com
