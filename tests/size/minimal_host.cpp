// The least that a machine's software does with a program file, and all that it needs of the runtime for that: loads
// it, keeps its retained memory, answers for its control, and scans it in a thread of its own.
// minimal_host PROGRAM.so RETAINED SCANS
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string>

#include "rtlib/load/so_engine.h"
#include "rtlib/nc/control/control.h"

using namespace rung;

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  std::string error;
  const std::unique_ptr<runtime::SoEngine> engine = runtime::SoEngine::open(argv[1], error);
  if (engine == nullptr) return std::puts(error.c_str()), 1;
  const std::unique_ptr<nc::Control> control = nc::makeControl(engine->program().dialect);
  runtime::Instance instance(engine->program(), control.get());
  nc::Retention retention(*control, instance, argv[2], nullptr); // the machine's program never changes
  std::string report;
  const std::optional<nc::PowerOn> kind = retention.load(report, error);
  std::puts(report.c_str());
  if (!kind) return std::puts(error.c_str()), 1;
  control->powerOn(instance, *kind);
  const std::optional<runtime::Ref> ready =
      control->readPlace(instance.program(), "READY"); // as it names all that it exchanges
  const auto scan = [&] {
    do { // the machine's own thread would wait for sliceDelayUs() here
      instance.slice();
      control->afterSlice(instance);
      retention.afterSlice();
      for (rung_message message; instance.messages().pop(message);) control->accept(message);
    } while (!instance.atListStart() && !instance.faulted());
  };
  for (long scans = std::atol(argv[3]); scans > 0 && !instance.faulted(); --scans) scan();
  if (ready) std::printf("ready: %d\n", static_cast<int>(instance.read(*ready)));
  if (!instance.faulted()) control->powerOff(instance, scan);
  if (instance.faulted()) std::puts(instance.faultText().c_str());
  error = retention.finish();
  return std::puts(error.c_str()), instance.faulted() || !error.empty() ? 1 : 0;
}
