// rung-bench-scan PROGRAM.so RECORDING [FROM COUNT [FOLDER]]: replays a recording in a host that uses the runtime
// library and checks the hash of each part. Under callgrind, started with --collect-atstart=no, only the parts FROM to
// FROM + COUNT are counted, and of them only what the host calls: neither the machine's writes nor the check, which is
// then done after the last part only. With FOLDER the machine's writes are recorded there, whose bytes are printed.
// After the end of the recording the machine writes nothing.
#include <valgrind/callgrind.h>

#include <cstdlib>
#include <exception>
#include <fstream>
#include <iostream>
#include <iterator>
#include <stdexcept>
#include <string>

#include "tools/bench/machines/recording.h"
#include "tools/bench/machines/replay.h"

namespace {

using namespace rung;

struct Counted {
  size_t from = 0;
  size_t count = 0;
  bool has(size_t part) const { return part >= from && part < from + count; }
};

void replay(const std::string& program, const bench::Recording& recording, const Counted& counted,
            const std::string& folder) {
  auto options = sized<rung_image_options>();
  options.allow_unsealed = 1;
  const Image image(program, &options);
  bench::Replay machine(image);
  if (!folder.empty()) machine.record(recording, folder);
  constexpr size_t kBlock = 80; // parts, as if each took a millisecond
  const size_t end = counted.count != 0 ? counted.from + counted.count : recording.parts.size();
  for (size_t i = 0; i < end; ++i) {
    const bench::Part* part = i < recording.parts.size() ? &recording.parts[i] : nullptr;
    if (part != nullptr) machine.write(*part);
    if (counted.has(i)) CALLGRIND_TOGGLE_COLLECT;
    machine.run();
    if (counted.has(i)) CALLGRIND_TOGGLE_COLLECT;
    machine.drain();
    if (!folder.empty() && i % kBlock == 0) (void)machine.recorded();
    const bool isChecked = part != nullptr && (RUNNING_ON_VALGRIND == 0 || i + 1 == end);
    if (isChecked && machine.hash() != part->hash)
      throw std::runtime_error("part " + std::to_string(i) +
                               ": the program's memory is another one than the interpreter's");
  }
  if (!folder.empty()) {
    const runtime::RecordingState state = machine.recorded();
    std::cout << end << " parts, " << state.raw << " bytes, packed " << state.written << "\n";
  }
  if (machine.inside().faulted()) throw std::runtime_error("the program has stopped: " + machine.inside().faultText());
}

} // namespace

int main(int argc, char** argv) try {
  if (argc != 3 && argc != 5 && argc != 6) {
    std::cerr << "usage: rung-bench-scan PROGRAM.so RECORDING [FROM COUNT [FOLDER]]\n";
    return 2;
  }
  std::ifstream file(argv[2]);
  const std::string text(std::istreambuf_iterator<char>(file), {});
  Counted counted;
  if (argc >= 5) counted = {std::strtoul(argv[3], nullptr, 10), std::strtoul(argv[4], nullptr, 10)};
  replay(argv[1], bench::recordingOf(text), counted, argc == 6 ? argv[5] : "");
  return 0;
} catch (const std::exception& problem) {
  std::cerr << "rung-bench-scan: " << problem.what() << '\n';
  return 1;
}
