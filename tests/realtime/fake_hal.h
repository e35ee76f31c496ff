// HAL and RTAPI of LinuxCNC as its component sees them: pins, parameters and functions that the test reads and calls.
// One at a time.
#pragma once
#include <array>
#include <atomic>
#include <cstdarg>
#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <thread>
#include <vector>

namespace rung::test {

class FakeHal {
public:
  FakeHal();
  ~FakeHal();
  FakeHal(const FakeHal&) = delete;
  FakeHal& operator=(const FakeHal&) = delete;

  // Loads the component as halcmd's loadrt does: what its entry returns. An empty text: the argument is not given; of
  // several instances they are separated by commas.
  int load(const std::string& program, const std::string& map, const std::string& retain = {},
           const std::string& prefix = {});
  void unload(); // and waits for the thread, which HAL does not

  // Pins are references to cells of 64 bits (see hal_api.h), and not pointers to variables.
  static bool hasReferences();
  // Of a pin or parameter that is there.
  template <class T>
  volatile T& value(const std::string& name) {
    return *static_cast<volatile T*>(values_.at(name));
  }
  bool has(const std::string& name) const { return values_.contains(name) || functions_.contains(name); }
  bool empty() const { return values_.empty() && functions_.empty(); }
  // Of the last pins that went with hal_exit: bits that were on.
  const std::vector<std::string>& bitsAtExit() const { return bitsAtExit_; }

  // One call of a function by this thread; allocates nothing.
  struct Function {
    void (*code)(void*, long) = nullptr;
    void* argument = nullptr;
    void call(int64_t periodNs) const { code(argument, static_cast<long>(periodNs)); }
  };
  Function function(const std::string& name) const { return functions_.at(name); }
  // A thread that calls it once a period until HAL takes it out, as hal_exit does it: without waiting.
  void startThread(const std::string& function, int64_t periodNs);
  uint64_t calls() const { return threadCalls_; }

  // What the component has printed, without the lines for the start and the end of the host.
  std::vector<std::string> lines() const;
  // How many of these as errors, which LinuxCNC shows to its operator.
  size_t errors() const { return errorCount_.load(); }
  // The number of calls so far of HAL's functions that can fail, hal_exit not counted; the given one fails (from 1).
  int asked() const { return asked_; }
  void failAt(int call) { failAt_ = asked_ + call; }
  int initialised() const { return initialised_; } // by hal_init, and not yet by hal_exit undone

  // For the functions of HAL and RTAPI, which have no argument for it.
  static FakeHal& the() { return *hal_; }
  bool fails() { return ++asked_ == failAt_; }
  int begin();
  int end(int component);
  void* allocate(long size);
  void* addPin(const std::string& name, bool isBit); // null: it fails
  int addValue(const std::string& name, void* place, bool isBit);
  int addFunction(const std::string& name, Function function);
  void print(const char* format, va_list arguments);
  void countError() { ++errorCount_; }

private:
  void setArgument(void* place, const std::string& text);

  static FakeHal* hal_;
  static constexpr size_t kLines = 200;
  static constexpr size_t kLineBytes = 400;
  std::vector<std::vector<double>> memory_; // as long as HAL
  std::deque<std::string> arguments_;       // of the last load
  std::map<std::string, void*> values_;
  std::map<std::string, bool> isBit_;
  std::map<std::string, Function> functions_;
  std::vector<std::string> bitsAtExit_;
  std::atomic<size_t> errorCount_{0};
  std::array<std::array<char, kLineBytes>, kLines> lines_{}; // printing must not allocate
  std::atomic<size_t> lineCount_{0};
  std::thread thread_;
  std::atomic<bool> inList_{false}; // the thread's function
  std::atomic<uint64_t> threadCalls_{0};
  int asked_ = 0;
  int failAt_ = 0;
  int initialised_ = 0;
};

} // namespace rung::test
