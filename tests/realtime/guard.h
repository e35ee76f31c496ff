// What may not happen in a scan, and who notices. Two programs run the same tests: one counts what is asked of the heap
// and of the kernel (counted_guard.cpp), the other has clang's real-time sanitizer linked in, which ends the process at
// a lock, an allocation or a wait (sanitizer_guard.cpp).
#pragma once
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace rung::test {

// What a program that is not real-time clean does in its scan.
enum class Offence { Allocation, Lock, SystemCall };
constexpr std::string_view name(Offence offence) {
  switch (offence) {
  case Offence::Allocation: return "Allocation";
  case Offence::Lock: return "Lock";
  case Offence::SystemCall: return "SystemCall";
  }
  return "";
}

// Of the thread that makes it.
class Guard {
public:
  Guard();
  ~Guard();
  Guard(const Guard&) = delete;
  Guard& operator=(const Guard&) = delete;

  // Nothing between enter and exit may allocate, lock or call the kernel.
  void enter();
  void exit();
  // What happened in between all the same, "" if nothing did.
  std::string offences() const;

  // What this guard notices on this machine.
  static std::vector<Offence> seen();

private:
  struct State;
  std::unique_ptr<State> state_;
};

class Guarded {
public:
  explicit Guarded(Guard& guard) : guard_(guard) { guard_.enter(); }
  ~Guarded() { guard_.exit(); }
  Guarded(const Guarded&) = delete;
  Guarded& operator=(const Guarded&) = delete;

private:
  Guard& guard_;
};

} // namespace rung::test
