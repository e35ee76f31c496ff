// A progress line about work that cannot say how far it is: a thread of its own shows how long it takes.
#pragma once
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace rung::scenario {

class Working {
public:
  // Shows "WHAT, 12 s" on standard error, when that is a terminal, from the third second on until this is destroyed.
  // Nothing else may be printed meanwhile.
  explicit Working(std::string what);
  ~Working();
  Working(const Working&) = delete;
  Working& operator=(const Working&) = delete;

  void say(std::string what); // in place of what it showed before

private:
  void show();

  std::string what_;
  std::mutex mutex_;
  std::condition_variable ends_;
  bool ended_ = false;
  std::thread thread_; // only where there is a terminal
};

} // namespace rung::scenario
