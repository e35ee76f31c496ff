// The thread that serves the serial ports of this machine.
#pragma once
#include <atomic>
#include <list>
#include <string>
#include <thread>
#include <vector>

#include "machine/io/com/tty_line.h"

namespace rung::io::com {

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
