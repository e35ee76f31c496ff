// The LinuxCNC real-time component: loads a compiled PLC program and a mapping file, makes their HAL pins, and scans in
// the thread that its function is added to. docs/linuxcnc.md is the user's description.
#include <hal.h>
#include <rtapi.h>
#include <rtapi_app.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <exception>
#include <fstream>
#include <iterator>
#include <optional>
#include <thread>

#include "tools/rung-hal/box.h"

extern "C" {
int rtapi_app_main();
void rtapi_app_exit();

MODULE_LICENSE("Apache-2.0");
MODULE_DESCRIPTION("Runs a PLC program compiled by rungc");
static char* so = nullptr;
RTAPI_MP_STRING(so, "compiled program, absolute path");
static char* map = nullptr;
RTAPI_MP_STRING(map, "mapping file, absolute path");
static char* retain = nullptr;
RTAPI_MP_STRING(retain, "file of the retained memory, absolute path");
static char* name = nullptr;
RTAPI_MP_STRING(name, "prefix of the pins and the function");
}

namespace {

using namespace rung;

constexpr const char* kModule = "rung_hal"; // LinuxCNC wants the file's name here
constexpr const char* kDefaultPrefix = "rung";

struct StatusPins {
  hal::PinCell fault;
  hal::PinCell faultLine;
  hal::PinCell scans;
  hal::PinCell missed;
  hal::PinCell scanTime; // ns
  hal::PinCell scanTimeMax;
  hal::PinCell functionsBusy;
  hal::PinCell functionsTimeout;
  hal::PinCell functionsLost;
  hal::PinCell reset; // of HAL: restarts the program after a fault
  hal_u32_t maxTime;  // parameter: microseconds that the program may run in one call; 0: its budgets alone count
};

struct Component {
  std::string prefix;
  std::optional<Image> image;
  std::unique_ptr<hal::Box> box;
  StatusPins* status = nullptr;  // in HAL's memory
  hal::PinCell* cells = nullptr; // in HAL's memory
  std::thread service;           // reports faults, restarts
  std::atomic<bool> ending{false};
  std::atomic<bool> inScan{false};
  std::atomic<int64_t> periodNs{0};
};

constexpr std::chrono::milliseconds kServicePeriod(20);

Component* component = nullptr; // RTAPI gives rtapi_app_exit no argument
int componentId = -1;

template <class... T>
void complain(const char* format, T... values) {
  rtapi_print_msg(RTAPI_MSG_ERR, format, values...);
}

std::optional<std::string> readFile(const char* path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::nullopt;
  return std::string(std::istreambuf_iterator<char>(file), {});
}

bool loadProgram(Component& c) {
  if (so == nullptr || map == nullptr) {
    complain("%s: so=PROGRAM.so and map=MAPPING_FILE are needed\n", kModule);
    return false;
  }
  try {
    c.image.emplace(so);
  } catch (const Error& error) {
    complain("%s: %s\n", kModule, error.what());
    return false;
  }
  const std::optional<std::string> text = readFile(map);
  if (!text) {
    complain("%s: cannot read %s\n", kModule, map);
    return false;
  }
  std::vector<std::string> errors;
  hal::MapFile mapping = hal::parseMap(*text, map, errors);
  // Both kinds of mistakes at once; a box is only made for a faultless map.
  std::vector<std::string> warnings;
  c.box = hal::Box::make(*c.image, std::move(mapping), errors, retain != nullptr ? retain : "", warnings);
  for (const std::string& warning : warnings) complain("%s: %s\n", kModule, warning.c_str());
  for (const std::string& wrong : errors) complain("%s: %s\n", kModule, wrong.c_str());
  return errors.empty();
}

hal_type_t halType(hal::PinType type) {
  switch (type) {
  case hal::PinType::Bit: return HAL_BIT;
  case hal::PinType::S32: return HAL_S32;
  case hal::PinType::U32: return HAL_U32;
  case hal::PinType::Float: return HAL_FLOAT;
  }
  return HAL_BIT;
}

bool makePin(const Component& c, const char* pin, hal_type_t type, hal_pin_dir_t direction, void** cell) {
  const std::string full = c.prefix + "." + pin;
  const int result = hal_pin_new(full.c_str(), type, direction, cell, componentId);
  if (result != 0)
    complain("%s: cannot make pin %s (%d): is the name too long or taken?\n", kModule, full.c_str(), result);
  return result == 0;
}

bool makeParameters(Component& c) {
  const std::string full = c.prefix + ".max-time";
  const int result = hal_param_u32_new(full.c_str(), HAL_RW, &c.status->maxTime, componentId);
  if (result != 0) complain("%s: cannot make parameter %s (%d)\n", kModule, full.c_str(), result);
  return result == 0;
}

bool makePins(Component& c) {
  const std::vector<hal::MapPin>& pins = c.box->pins();
  c.status = static_cast<StatusPins*>(hal_malloc(sizeof(StatusPins)));
  if (c.status != nullptr)
    c.cells = static_cast<hal::PinCell*>(hal_malloc(static_cast<long>((pins.size() + 1) * sizeof(hal::PinCell))));
  if (c.cells == nullptr) {
    complain("%s: HAL has no memory for the pins\n", kModule);
    return false;
  }
  const auto status = [&c](const char* pin, hal_type_t type, hal::PinCell& cell) {
    return makePin(c, pin, type, HAL_OUT, &cell.any);
  };
  StatusPins& s = *c.status;
  bool ok = status("fault", HAL_BIT, s.fault) && status("fault-line", HAL_U32, s.faultLine) &&
            status("scans", HAL_U32, s.scans) && status("missed", HAL_U32, s.missed) &&
            status("scan-time", HAL_U32, s.scanTime) && status("scan-time-max", HAL_U32, s.scanTimeMax) &&
            status("functions-busy", HAL_BIT, s.functionsBusy) &&
            status("functions-timeout", HAL_BIT, s.functionsTimeout) &&
            status("functions-lost", HAL_U32, s.functionsLost) && makePin(c, "reset", HAL_BIT, HAL_IN, &s.reset.any);
  for (size_t i = 0; i < pins.size() && ok; ++i)
    ok = makePin(c, pins[i].name.c_str(), halType(pins[i].type), pins[i].output ? HAL_OUT : HAL_IN, &c.cells[i].any);
  if (!ok || !makeParameters(c)) return false;
  c.box->connect(c.cells); // all of them are there
  return true;
}

void printMessage(const rung_message_info& message) {
  if (message.op != RUNG_MESSAGE_CLEAR) rtapi_print("%s: message %s\n", kModule, message.text);
}

void runStep(Component& c, long periodNs) {
  constexpr int64_t kNsInUs = 1000;
  const long long begin = rtapi_get_time();
  // While it does not run, the box may belong to the thread that restarts it.
  if (c.box->running()) c.box->setTimeLimit(int64_t{c.status->maxTime} * kNsInUs);
  const hal::StepResult result = c.box->step(periodNs, *c.status->reset.bit);
  const bool runs = c.box->running();
  *c.status->fault.bit = !runs;
  *c.status->functionsBusy.bit = runs && c.box->functions().busy();
  *c.status->functionsTimeout.bit = runs && c.box->functions().late();
  if (runs) *c.status->functionsLost.u32 = c.box->functions().lost();
  if (result == hal::StepResult::Waiting) return;
  const auto time = static_cast<uint32_t>(rtapi_get_time() - begin);
  *c.status->scanTime.u32 = time;
  if (time > *c.status->scanTimeMax.u32) *c.status->scanTimeMax.u32 = time;
  if (result == hal::StepResult::Failed) return; // the instance is the service's now
  const rung_state state = c.box->state();
  *c.status->scans.u32 = static_cast<uint32_t>(state.passes);
  *c.status->missed.u32 = static_cast<uint32_t>(state.missed);
}

void scan(void* argument, long periodNs) {
  Component& c = *static_cast<Component*>(argument);
  c.periodNs.store(periodNs, std::memory_order_relaxed);
  c.inScan.store(true);
  if (!c.ending.load()) runStep(c, periodNs);
  c.inScan.store(false);
}

void serveOnce(Component& c) {
  std::vector<std::string> reports;
  if (c.box->serve(reports)) *c.status->faultLine.u32 = c.box->faultLine();
  for (const std::string& report : reports) complain("%s: %s\n", c.prefix.c_str(), report.c_str());
}

// No exception may leave the module: it would end the whole CNC.
template <class Action>
int guarded(Action action) noexcept {
  try {
    return action();
  } catch (const std::exception& problem) {
    complain("%s: %s\n", kModule, problem.what());
  } catch (...) {
    complain("%s: unknown exception\n", kModule);
  }
  return -ENOMEM;
}

void serve(Component& c) {
  while (!c.ending.load()) {
    guarded([&] { return serveOnce(c), 0; });
    std::this_thread::sleep_for(kServicePeriod);
  }
}

int start() {
  component = new Component;
  Component& c = *component;
  c.prefix = name != nullptr ? name : kDefaultPrefix;
  if (!loadProgram(c) || !makePins(c)) return -EINVAL;
  c.box->setMessageSink(printMessage);
  c.service = std::thread([&c] { serve(c); });
  const std::string function = c.prefix + ".scan";
  const int result = hal_export_funct(function.c_str(), scan, component, 1, 0, componentId);
  if (result == 0) return hal_ready(componentId);
  complain("%s: cannot make the function %s (%d)\n", kModule, function.c_str(), result);
  return result;
}

// HAL takes a function out of its thread without waiting for it: from here on it does nothing, and two periods later no
// thread is about to call it.
void endScans(Component& c) {
  constexpr std::chrono::microseconds kLook(100);
  c.ending.store(true);
  while (c.inScan.load()) std::this_thread::sleep_for(kLook);
  if (c.service.joinable()) c.service.join();
}

void closeProgram(Component& c) {
  if (!c.box) return;
  guarded([&] { return serveOnce(c), 0; }); // a fault of the last moment
  const std::string error = c.box->close();
  if (!error.empty()) complain("%s: %s\n", kModule, error.c_str());
}

void leaveHal(const Component& c) {
  hal_exit(componentId);
  std::this_thread::sleep_for(std::chrono::nanoseconds(2 * c.periodNs.load()));
  while (c.inScan.load()) std::this_thread::yield();
}

void end() {
  if (component == nullptr) {
    hal_exit(componentId);
    return;
  }
  endScans(*component);
  guarded([] { return closeProgram(*component), 0; });
  leaveHal(*component);
  delete component;
  component = nullptr;
}

} // namespace

int rtapi_app_main() {
  const int id = hal_init(kModule);
  if (id < 0) return id; // where one is loaded already, it continues
  componentId = id;
  const int result = guarded(start);
  if (result != 0) guarded([] { return end(), 0; });
  return result;
}

void rtapi_app_exit() {
  guarded([] { return end(), 0; });
}
