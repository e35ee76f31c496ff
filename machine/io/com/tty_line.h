// A serial port of this machine as the line of a Port, over termios. It belongs to a thread of the host that is not the
// scan's: opening, reading and writing are calls of the system.
//
// A device that is not there, or has gone (USB), is the port's error; it is opened again once a second. Meanwhile bytes
// that are to be sent stay in the queue.
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

// `found`, raw and set so. Speeds are those that termios knows: 50 to 4,000,000.
termios termiosOf(const Settings& settings, termios found);
// The device of PhysicalComNo, which counts as Windows does: 1 is /dev/ttyS0 (l.21024).
std::string devicePath(uint32_t physical);
// Whether termios has a number for it.
bool isStandardSpeed(uint32_t speed);

class TtyLine {
public:
  static constexpr int64_t kReopenMs = 1000;

  // A device by its path, /dev/ttyS0. It is opened in `step`.
  TtyLine(Port& port, std::string path) : port_(port), path_(std::move(path)) {}
  // One that is open; it is closed with the line, or where it has gone, and then the error stays.
  TtyLine(Port& port, int descriptor);
  ~TtyLine() { close(); }
  TtyLine(const TtyLine&) = delete;
  TtyLine& operator=(const TtyLine&) = delete;

  // Moves what can be moved, and does not wait. `nowMs` of any steady clock.
  void step(int64_t nowMs) noexcept;

  // For poll: -1 where it is closed.
  int descriptor() const { return descriptor_; }
  // Bytes wait until the system has room for them.
  bool hasUnsent() const { return unsentAt_ < unsentEnd_; }
  // What has last gone wrong, for people; "" while nothing has. Any thread but the scan's.
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
  std::string path_; // "": a descriptor was given
  int descriptor_ = -1;
  int64_t openAtMs_ = INT64_MIN; // not before
  int64_t nowMs_ = 0;
  std::array<uint8_t, kBlock> unsent_{}; // taken from the port
  size_t unsentAt_ = 0, unsentEnd_ = 0;
  mutable std::mutex mutex_;
  std::string problem_;
};

// The thread that serves the serial ports of this machine.

class TtyThread {
public:
  // The longest that a byte in a queue waits for the thread: the scan does not wake it.
  static constexpr int kPauseMs = 2;

  TtyThread() = default;
  ~TtyThread() { end(); }
  TtyThread(const TtyThread&) = delete;
  TtyThread& operator=(const TtyThread&) = delete;

  // Before `start`; the port outlives the thread, and its settings do not change any more. "" or what is wrong with
  // them.
  std::string add(Port& port, std::string path);
  void add(Port& port, int descriptor) { lines_.emplace_back(port, descriptor); }
  void start();
  // What the queues hold goes to the system, where it has room.
  void end();

  // One a line that has one, for people. Any thread but the scan's.
  std::vector<std::string> problems() const;

private:
  void run() noexcept;

  std::list<TtyLine> lines_; // they do not move
  std::atomic<bool> ending_{false};
  std::thread thread_;
};

} // namespace rung::io::com
