// The LinuxCNC real-time component: loads compiled PLC programs and their mapping files, creates the HAL pins, and
// scans in the threads to which its functions are added. User documentation: docs/linuxcnc.md.
#include <rtapi.h>
#include <rtapi_app.h>

#include <pthread.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <exception>
#include <functional>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include <nlohmann/json.hpp>

#include "machine/compile/sources.h"
#include "machine/control/controller.h"
#include "machine/control/server.h"
#include "machine/control/service_loop.h"
#include "machine/host/component_pins.h"
#include "machine/host/plc_host.h"
#include "machine/io/analog/analog.h"
#include "machine/io/host_devices.h"
#include "machine/rung-hal/hal_api.h"
#include "machine/rung-hal/user_rights.h"

namespace {
constexpr int kMostInstances = 16;
}

extern "C" {
int rtapi_app_main();
void rtapi_app_exit();

MODULE_LICENSE("Apache-2.0");
MODULE_DESCRIPTION("Runs PLC programs compiled by rungc");
static char* names[kMostInstances];
RTAPI_MP_ARRAY_STRING(names, kMostInstances, "prefixes of the pins and functions of the instances");
static char* so[kMostInstances];
RTAPI_MP_ARRAY_STRING(so, kMostInstances, "compiled program of each instance, or one for all, absolute path");
static char* source[kMostInstances];
RTAPI_MP_ARRAY_STRING(source, kMostInstances, "instead of so: source file or project, compiled at the start");
static char* map[kMostInstances];
RTAPI_MP_ARRAY_STRING(map, kMostInstances, "mapping file of each instance, or one for all, absolute path");
static char* retain[kMostInstances];
RTAPI_MP_ARRAY_STRING(retain, kMostInstances, "file of the retained memory of each instance, absolute path");
}

namespace {

using namespace rung;
using host::OwnPin;

constexpr const char* kModule = "rung_hal"; // LinuxCNC requires the name of the file here
constexpr const char* kDefaultPrefix = "rung";

constexpr size_t kOwnPinCount = std::size(host::kOwnPins);

enum Function : size_t { kScan, kFast };

// One program with its pins. Must not move: HAL calls its functions with its address.
struct PlcInstance {
  std::string prefix;
  std::optional<Image> image;
  std::unique_ptr<io::HostDevices> devices; // for a TECHNOL program; must outlive the host
  std::unique_ptr<host::PlcHost> host;
  host::PinCell* ownCells = nullptr; // in HAL's memory, indexed by OwnPin
  host::PinCell* cells = nullptr;    // in HAL's memory
  bool hasPins = false;              // all pins have been created
  std::atomic<uint32_t> inside{0};   // calls of its functions in progress
  std::atomic<uint32_t> calls{0};    // completed calls
  // The threads in which HAL calls its functions; 0: no call yet. A program must run in one thread: if the threads
  // differ, they conflict for good, and the program does not run.
  std::array<std::atomic<pthread_t>, 2> callers{};
  std::atomic<bool> conflict{false};
  bool conflictReported = false;
  bool fastCalled = false;  // since the previous scan
  bool poweringOff = false; // since pin power-off was switched on
  std::atomic<int64_t> periodNs{0};
  const std::atomic<bool>* ending = nullptr; // set by the component
  host::PinCell& own(OwnPin pin) const { return ownCells[static_cast<size_t>(pin)]; }
  std::unique_ptr<control::Log> log;
  std::unique_ptr<control::Controller> controller;
  std::unique_ptr<control::Server> server; // for rungctl; null if it has no socket
};

struct Component {
  std::vector<std::unique_ptr<PlcInstance>> instances;
  std::thread service; // reports faults, restarts, answers rungctl
  std::atomic<bool> ending{false};
};

Component* component = nullptr; // RTAPI passes no argument to rtapi_app_exit
int componentId = -1;

template <class... T>
void complain(const char* format, T... values) {
  rtapi_print_msg(RTAPI_MSG_ERR, format, values...);
}

// The arguments of the component for one instance.
struct Request {
  const char* name = nullptr;
  const char* program = nullptr;
  bool isSource = false;
  const char* map = nullptr;
  const char* retain = nullptr;
};

size_t given(char* const (&list)[kMostInstances]) {
  return static_cast<size_t>(std::find(std::begin(list), std::end(list), nullptr) - std::begin(list));
}

// Lists have one entry for each instance, or one for all.
const char* argument(char* const (&list)[kMostInstances], size_t instance) {
  return given(list) == 1 ? list[0] : list[instance];
}

// Returns false after reporting that the lists do not fit together.
bool checkArguments(size_t count) {
  const auto isEach = [&](char* const(&list)[kMostInstances]) { return given(list) == count; };
  const auto fits = [&](char* const(&list)[kMostInstances]) { return given(list) == 1 || isEach(list); };
  if (given(so) != 0 && given(source) != 0) {
    complain("%s: so=PROGRAM.so and source=PROGRAM exclude each other\n", kModule);
    return false;
  }
  if (!fits(given(source) != 0 ? source : so) || !fits(map)) {
    complain("%s: so=PROGRAM.so, or source=PROGRAM, and map=MAPPING_FILE are needed, one for all instances or one for "
             "each of names=\n",
             kModule);
    return false;
  }
  if (given(retain) == 0 || isEach(retain)) return true;
  complain("%s: retain=FILE is needed for each instance of names=, or for none\n", kModule);
  return false;
}

// Empty if the arguments do not fit together.
std::vector<Request> requests() {
  const size_t count = std::max<size_t>(1, given(names));
  if (!checkArguments(count)) return {};
  std::vector<Request> list(count);
  const bool isSource = given(source) != 0;
  for (size_t i = 0; i < count; ++i)
    list[i] = {given(names) == 0 ? kDefaultPrefix : names[i], argument(isSource ? source : so, i), isSource,
               argument(map, i), retain[i]};
  return list;
}

// Reports each line separately, because RTAPI's messages are short.
void complainLines(const std::string& text) {
  for (size_t at = 0; at < text.size();) {
    const size_t end = std::min(text.find('\n', at), text.size());
    complain("%s: %s\n", kModule, text.substr(at, end - at).c_str());
    at = end + 1;
  }
}

Image imageOf(const Request& request) {
  if (!request.isSource) return Image(request.program);
  std::string warnings;
  Image image = compile::compiledImage(request.program, hal::UserRights::user(), warnings);
  complainLines(warnings);
  return image;
}

// For a program with requests to devices: the devices of its map, and pins for its axes and analogue outputs. Empty for
// other programs, which have only their control.
host::PlcHost::NewInstance withDevices(PlcInstance& c, const Image& image, host::File& map,
                                       std::vector<std::string>& errors) {
  if (!io::HostDevices::isFor(image)) return {};
  c.devices = std::make_unique<io::HostDevices>();
  c.devices->set(map, errors);
  c.devices->addAxisPins(map, errors);
  io::addAnalogPins(map, image.program());
  return [&c](const Image& of, const rung_instance_options& with) { return c.devices->instance(of, with); };
}

std::string conflictText(const PlcInstance& c) {
  return c.prefix + ".fast and " + c.prefix + ".scan are in different threads, but share the memory of one program; " +
         "add both to one thread (addf) and restart";
}

// Returns false after reporting the errors.
bool loadProgram(PlcInstance& c, const Request& request) {
  const Image* image = nullptr;
  try {
    image = &c.image.emplace(imageOf(request));
  } catch (const std::exception& error) {
    complainLines(error.what());
    return false;
  }
  std::vector<std::string> errors;
  std::vector<std::string> warnings;
  host::File mapping = host::loadMap(request.map, errors);
  host::refuseConnections(mapping, "LinuxCNC, where HAL connects the pins", errors);
  const host::PlcHost::NewInstance newInstance = withDevices(c, *image, mapping, errors);
  // Errors of the text and of names are reported together; a host is only made for a map without errors.
  try {
    if (!mapping.paths.empty())
      c.host = host::PlcHost::make(
          *image, std::move(mapping),
          {.retain = request.retain != nullptr ? request.retain : "", .newInstance = newInstance, .measure = true},
          errors, warnings);
  } catch (const Error& error) {
    errors.emplace_back(error.what());
  }
  if (c.devices != nullptr) std::ranges::move(c.devices->warnings(), std::back_inserter(warnings));
  for (const std::string& warning : warnings) complain("%s: %s\n", kModule, warning.c_str());
  for (const std::string& wrong : errors) complain("%s: %s\n", kModule, wrong.c_str());
  if (c.host == nullptr) return false;
  c.log = std::make_unique<control::Log>(
      c.host->clock(), [&c](const std::string& line) { rtapi_print("%s: %s\n", c.prefix.c_str(), line.c_str()); });
  c.controller = std::make_unique<control::Controller>(c.prefix, *c.host, *image, *c.log);
  if (request.retain != nullptr) c.log->keepBeside(request.retain, c.host->map().logBytes);
  c.controller->logStart();
  c.controller->addToStatus([&c](nlohmann::json& status) {
    if (c.conflict.load()) status["not_run"] = conflictText(c);
  });
  return true;
}

bool loadPrograms(Component& c) {
  const std::vector<Request> list = requests();
  bool ok = !list.empty();
  for (const Request& request : list) { // reports the errors of all programs
    auto made = std::make_unique<PlcInstance>();
    made->prefix = request.name;
    made->ending = &c.ending;
    ok = loadProgram(*made, request) && ok;
    c.instances.push_back(std::move(made));
  }
  return ok;
}

bool isMade(int result, const char* what, const std::string& name) {
  const char* const why = result == -ENOMEM ? "HAL has no memory left" : "is the name too long or taken?";
  if (result != 0) complain("%s: cannot make %s %s (%d): %s\n", kModule, what, name.c_str(), result, why);
  return result == 0;
}

bool makePin(const PlcInstance& c, const char* pin, host::PinType type, hal_pin_dir_t direction, host::PinCell& cell) {
  const std::string full = c.prefix + "." + pin;
  return isMade(hal::newPin(full, type, direction, cell, componentId), "pin", full);
}

bool makeParameter(const PlcInstance& c, const char* parameter, host::PinType type, host::PinCell& cell) {
  const std::string full = c.prefix + "." + parameter;
  return isMade(hal::newParameter(full, type, cell, componentId), "parameter", full);
}

// Creates a pin or a parameter of the map, or of the component itself.
template <class Pin>
bool makeMapped(const PlcInstance& c, const Pin& pin, host::PinCell& cell) {
  constexpr hal_pin_dir_t kDirections[] = {HAL_IN, HAL_OUT, HAL_IO}; // indexed by host::Direction
  const std::string name(pin.name);
  if (pin.direction == host::Direction::Parameter) return makeParameter(c, name.c_str(), pin.type, cell);
  return makePin(c, name.c_str(), pin.type, kDirections[static_cast<size_t>(pin.direction)], cell);
}

bool makePins(PlcInstance& c) {
  const std::vector<host::Pin>& pins = c.host->pins();
  const auto cells = [](size_t count) {
    return static_cast<host::PinCell*>(hal_malloc(static_cast<long>(count * sizeof(host::PinCell))));
  };
  c.ownCells = cells(kOwnPinCount);
  if (c.ownCells != nullptr) c.cells = cells(pins.size() + 1);
  if (c.cells == nullptr) {
    complain("%s: HAL has no memory for the pins\n", kModule);
    return false;
  }
  bool ok = true;
  for (size_t i = 0; i < kOwnPinCount && ok; ++i) ok = makeMapped(c, host::kOwnPins[i], c.ownCells[i]);
  for (size_t i = 0; i < pins.size() && ok; ++i) ok = makeMapped(c, pins[i], c.cells[i]);
  if (!ok) return false;
  c.hasPins = true;
  c.host->connect(c.cells, hal::kAccess);
  if (c.devices != nullptr) c.devices->connectAxes(c.cells, hal::kAccess);
  return true;
}

// If HAL has both functions, the period of a scan counts from the call of the fast task.
host::StepResult runFunction(PlcInstance& c, Function function, long periodNs) {
  const bool reset = hal::bit(c.own(OwnPin::Reset));
  const bool hasElapsed = c.fastCalled;
  c.fastCalled = function == kFast;
  if (function == kFast) return c.host->stepFast(periodNs, reset);
  return c.host->step(hasElapsed ? 0 : periodNs, reset);
}

// Axes must come to rest before their program is restarted, which takes a while.
void stepDevices(PlcInstance& c, long periodNs) {
  if (c.devices == nullptr || c.host->restarting()) return;
  c.devices->step(periodNs);
  c.host->setRestartable(c.devices->axesAtRest());
}

void runStep(PlcInstance& c, Function function, long periodNs) {
  constexpr int64_t kNsInUs = 1000;
  if (function == kScan) stepDevices(c, periodNs);
  // During a restart the host belongs to the service thread.
  if (!c.host->restarting()) c.host->setTimeLimit(int64_t{hal::u32(c.own(OwnPin::MaxTime))} * kNsInUs);
  const host::StepResult result = runFunction(c, function, periodNs);
  const bool runs = c.host->running();
  hal::setU32(c.own(OwnPin::FaultLine), c.host->faultLine()); // set before `fault`, for which others wait
  hal::setBit(c.own(OwnPin::Fault), !runs);
  hal::setBit(c.own(OwnPin::Serving), runs && c.host->live().served.load(std::memory_order_acquire));
  hal::setBit(c.own(OwnPin::FunctionsBusy), runs && c.host->functions().busy());
  hal::setBit(c.own(OwnPin::FunctionsTimeout), runs && c.host->functions().late());
  if (runs) hal::setU32(c.own(OwnPin::FunctionsLost), c.host->functions().lost());
  if (result != host::StepResult::Ran) return; // after a fault the instance belongs to the service thread
  const rung_state state = c.host->state();
  hal::setU32(c.own(OwnPin::Scans), static_cast<uint32_t>(state.scans));
  hal::setU32(c.own(OwnPin::Missed), static_cast<uint32_t>(state.missed));
}

// The program has powered off regularly: it no longer runs, and its axes come to rest.
bool isPoweredOff(PlcInstance& c, Function function, long periodNs) {
  c.poweringOff = c.poweringOff || hal::bit(c.own(OwnPin::PowerOff));
  if (!c.poweringOff || !c.host->powerOffDone()) return false;
  c.host->clearPins();
  hal::setBit(c.own(OwnPin::Serving), false);
  hal::setBit(c.own(OwnPin::FunctionsBusy), false);
  hal::setBit(c.own(OwnPin::FunctionsTimeout), false);
  if (function == kScan && (c.devices == nullptr || c.devices->rest(periodNs)))
    hal::setBit(c.own(OwnPin::PoweredOff), true);
  return true;
}

bool threadsConflict(PlcInstance& c, Function function) {
  const pthread_t self = pthread_self();
  c.callers[function].store(self);
  const pthread_t other = c.callers[function == kScan ? kFast : kScan].load();
  if (other != 0 && other != self) c.conflict.store(true);
  return c.conflict.load();
}

void rejectSecondThread(PlcInstance& c) {
  c.host->clearPins();
  hal::setBit(c.own(OwnPin::Fault), true);
}

void call(PlcInstance& c, Function function, long periodNs) {
  c.periodNs.store(periodNs, std::memory_order_relaxed);
  c.inside.fetch_add(1);
  if (!c.ending->load()) {
    if (threadsConflict(c, function)) {
      if (function == kScan)
        rejectSecondThread(c); // in every call: the call of the other thread may have been about to end
    } else if (!isPoweredOff(c, function, periodNs)) {
      runStep(c, function, periodNs);
    }
  }
  c.calls.fetch_add(1);
  c.inside.fetch_sub(1);
}

void scan(void* argument, long periodNs) { call(*static_cast<PlcInstance*>(argument), kScan, periodNs); }
void fast(void* argument, long periodNs) { call(*static_cast<PlcInstance*>(argument), kFast, periodNs); }

void reportConflict(PlcInstance& c) {
  if (!c.conflict.load() || c.conflictReported) return;
  c.conflictReported = true;
  complain("%s: the program does not run: %s\n", kModule, conflictText(c).c_str());
}

void reportDevices(PlcInstance& c) {
  if (c.devices == nullptr) return;
  for (const std::string& line : c.devices->report()) (void)c.log->line(line);
}

// Opens the socket; the program also runs without one.
void listen(PlcInstance& c) {
  try {
    c.server = std::make_unique<control::Server>(c.prefix, hal::UserRights::user(), *c.controller);
  } catch (const std::exception& problem) {
    complain("%s: rungctl cannot reach it: %s\n", c.prefix.c_str(), problem.what());
  }
}

// Exceptions must not leave the module: they would end the whole CNC.
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

// Starts the thread that serves all instances.
void beginService(Component& c) {
  control::ServiceLoop loop([](const char* problem) { complain("%s: %s\n", kModule, problem); });
  for (const auto& instance : c.instances)
    loop.add({.controller = instance->controller.get(), .server = instance->server.get(), .report = [&c = *instance] {
                reportConflict(c);
                reportDevices(c);
              }});
  c.service = std::thread([&c, loop = std::move(loop)]() mutable {
    while (!c.ending.load()) loop.turn();
  });
}

int exportFunction(PlcInstance& c, const char* name, void (*code)(void*, long)) {
  const std::string function = c.prefix + "." + name;
  const int result = hal_export_funct(function.c_str(), code, &c, 1, 0, componentId);
  if (result != 0) complain("%s: cannot make the function %s (%d)\n", kModule, function.c_str(), result);
  return result;
}

int exportFunctions(PlcInstance& c) {
  const int result = exportFunction(c, "scan", scan);
  return result != 0 ? result : exportFunction(c, "fast", fast);
}

int start() {
  const hal::UserRights rights; // also for the threads that are started here
  component = new Component;
  Component& c = *component;
  if (!loadPrograms(c)) return -EINVAL;
  for (const auto& instance : c.instances) {
    if (!makePins(*instance)) return -EINVAL;
    if (instance->devices != nullptr) instance->devices->start();
    listen(*instance);
  }
  beginService(c);
  for (const auto& instance : c.instances)
    if (const int result = exportFunctions(*instance); result != 0) return result;
  return hal_ready(componentId);
}

void waitForScans(const Component& c) {
  constexpr std::chrono::microseconds kLook(100);
  for (const auto& instance : c.instances)
    while (instance->inside.load() != 0) std::this_thread::sleep_for(kLook);
}

// HAL removes a function from its thread without waiting for it: from now on the functions do nothing, and two periods
// later no thread is about to call them.
void endScans(Component& c) {
  c.ending.store(true);
  waitForScans(c);
  if (c.service.joinable()) c.service.join();
}

void closeProgram(PlcInstance& c) {
  if (!c.controller) return; // not loaded
  // Reports a fault of the last steps.
  guarded([&] { return c.controller->serveProgram(c.server.get()), 0; });
  const std::string error = c.host->close();
  if (c.devices != nullptr) c.devices->end();
  reportDevices(c);
  guarded([&] { return c.controller->serveProgram(nullptr), 0; }); // the last messages of the program
  if (!error.empty()) complain("%s: %s\n", kModule, error.c_str());
}

// HAL's thread records the run time of a function after each call, and crashes if the function has been removed by
// then. A new call shows that this is over; the following call is then some time away. Threads may have stopped.
void waitForCall(const PlcInstance& c) {
  constexpr std::chrono::microseconds kLook(20);
  constexpr int64_t kMostPeriods = 20;
  const uint32_t before = c.calls.load();
  const auto end = std::chrono::steady_clock::now() + std::chrono::nanoseconds(kMostPeriods * c.periodNs.load());
  while (c.calls.load() == before && std::chrono::steady_clock::now() < end) std::this_thread::sleep_for(kLook);
}

// Waits for the thread with the shortest period last, because the other threads have more time until their next calls.
void waitBetweenCalls(const Component& c) {
  std::vector<const PlcInstance*> called;
  for (const auto& instance : c.instances)
    if (instance->periodNs.load() != 0) called.push_back(instance.get());
  std::ranges::sort(called, std::greater(), [](const PlcInstance* instance) { return instance->periodNs.load(); });
  for (const PlcInstance* instance : called) waitForCall(*instance);
  constexpr int64_t kPart = 8; // of a period, after which the call has returned
  if (!called.empty()) std::this_thread::sleep_for(std::chrono::nanoseconds(called.back()->periodNs.load() / kPart));
}

void leaveHal(const Component& c) {
  waitBetweenCalls(c);
  hal_exit(componentId);
  int64_t longest = 0;
  for (const auto& instance : c.instances) longest = std::max(longest, instance->periodNs.load());
  std::this_thread::sleep_for(std::chrono::nanoseconds(2 * longest));
  waitForScans(c);
}

void end() {
  if (component == nullptr) {
    hal_exit(componentId);
    return;
  }
  endScans(*component);
  for (const auto& instance : component->instances) guarded([&] { return closeProgram(*instance), 0; });
  leaveHal(*component);
  delete component;
  component = nullptr;
}

} // namespace

int rtapi_app_main() {
  std::setvbuf(stdout, nullptr, _IOLBF, 0); // writes each line of the log to its file at once, however LinuxCNC ends
  const int id = hal_init(kModule);
  if (id < 0) return id; // a component that is already loaded continues
  componentId = id;
  const int result = guarded(start);
  if (result != 0) guarded([] { return end(), 0; });
  return result;
}

void rtapi_app_exit() {
  guarded([] { return end(), 0; });
}
