// A line on the terminal about work that takes long; it is gone when the work is done.
#pragma once
#include <chrono>
#include <cstdio>
#include <string_view>

namespace rung::scenario {

class Progress {
public:
  // Shows nothing when `out` is not a terminal, nor in the first two seconds.
  explicit Progress(FILE* out);
  // Other work begins: the two seconds count from now.
  void begin();
  ~Progress() { clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void show(std::string_view text); // in place of what it showed before; some times a second
  void clear();                     // before other lines are printed
  double seconds() const;           // since the work began

private:
  FILE* out_;
  bool terminal_;
  bool shown_ = false;
  std::chrono::steady_clock::time_point start_;
  double last_ = 0; // shown at so many seconds
};

} // namespace rung::scenario
