// How long tests wait for what another thread, process or device does: until it has come. The limit is for what never
// comes, so it is generous, and it grows with what others do on the machine.
#pragma once
#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <thread>

namespace rung::test {

// Until something counts as never happening.
inline std::chrono::duration<double> patience() {
  constexpr std::chrono::duration<double> kWithoutOtherWork(60);
  double load = 1; // those that want a processor, in the last minute
  if (getloadavg(&load, 1) != 1) load = 1;
  return kWithoutOtherWork * std::max(1.0, load / std::max(1U, std::thread::hardware_concurrency()));
}

// Whether the condition holds before long: looks at it again and again.
template <class Condition>
bool soon(Condition condition, std::chrono::microseconds pause = std::chrono::milliseconds(1)) {
  const auto begin = std::chrono::steady_clock::now();
  while (!condition()) {
    if (std::chrono::steady_clock::now() - begin > patience()) return false;
    std::this_thread::sleep_for(pause);
  }
  return true;
}

} // namespace rung::test
