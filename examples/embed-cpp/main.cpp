// A demonstration CNC: one axis, moved by a PLC program. main PROGRAM.so NEXT.so
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <thread>

#include <rung/runtime.hpp>

namespace {

struct Axis {
  bool start = false, jam = false, enable = false;
  int32_t position = 0; // 0.001 mm
  uint8_t strokes = 0;

  // Simulates the machine for a millisecond.
  void move() {
    if (enable) position += 50;
    start = !enable && position == 0;
    if (!enable && position > 0) position = position > 250 ? position - 250 : 0; // back to the start
  }
};

void run(const char* program, const char* nextProgram) {
  const rung::Image image(program), next(nextProgram);
  rung::Instance plc(image);
  Axis axis;
  plc.bindInput("START", axis.start);
  plc.bindInput("JAM", axis.jam);
  plc.bindInput("D0:4", axis.position);
  plc.bindOutput("ENABLE", axis.enable);
  plc.bindOutput("STROKES", axis.strokes);
  plc.powerOn();
  rung::Replacement change(plc, next);
  for (const rung_change& c : change.changes()) std::printf("the new program: %s changes\n", c.name);
  auto due = std::chrono::steady_clock::now();
  bool changed = false;
  for (int ms = 0; ms < 2000; ++ms) {
    if (ms == 700) axis.jam = true;
    if (plc.runDue(1'000'000) == RUNG_FAULTED) { // outputs are 0: the axis does not move
      if (const auto fault = plc.fault()) std::printf("%d ms: %s\n", ms, fault->text);
      axis.jam = false;
      plc.powerOn();
    }
    if (ms >= 1000 && !changed) { // a new program, while the axis moves
      changed = rung::check(plc.replace(change)) == RUNG_OK;
      if (changed) std::printf("%d ms: the new program runs\n", ms);
    }
    axis.move();
    std::this_thread::sleep_until(due += std::chrono::milliseconds(1));
  }
  if (const auto worst = plc.worstRung())
    std::printf("%d strokes; the worst rung is %s, %s:%u\n", axis.strokes, worst->title, worst->file, worst->line);
  plc.powerOff();
}

} // namespace

int main(int argc, char** argv) try {
  if (argc != 3) return 2;
  run(argv[1], argv[2]);
  return 0;
} catch (const rung::Error& error) {
  return std::fprintf(stderr, "%s\n", error.what()), 1;
}
