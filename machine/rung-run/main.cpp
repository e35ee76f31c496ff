// rung-run: runs a compiled program with a mapping file on the machine's clock, without LinuxCNC. rungctl can connect
// to it.
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <fmt/format.h>
#include <initializer_list>
#include <iostream>
#include <iterator>
#include <memory>
#include <optional>
#include <ranges>
#include <string>
#include <vector>

#include "machine/command-line/usage.h"
#include "machine/compile/sources.h"
#include "machine/control/controller.h"
#include "machine/control/log.h"
#include "machine/control/place.h"
#include "machine/control/service_loop.h"
#include "machine/host/plc_host.h"
#include "machine/io/connections/connections.h"
#include "machine/io/host_devices.h"
#include "machine/rung-run/config_pairs.h"
#include "machine/rung-run/pins.h"
#include "machine/rung-run/scan_thread.h"
#include "machine/rung-run/service_manager.h"
#include "machine/rung-run/simulation.h"
#include "machine/rung-run/status.h"

namespace {

using namespace rung;

struct Options {
  std::string program;
  std::string map;
  std::string name = "rung";
  std::string retain;
  unsigned periodUs = 1000;
  unsigned earlyUs = 0;
  uint32_t catchUp = 1;
  unsigned maxTimeUs = 0;
  int priority = 0;
  bool lockMemory = false;
  bool unsealed = false;
  bool simulate = false;
  std::vector<std::string> config; // KEY=VALUE
  std::vector<std::string> can;    // CHANNEL=INTERFACE
  std::vector<std::string> com;    // PORT=DEVICE
  std::string sharedFile;
};

// Errors are ignored: the reader of the output may have been closed, which must not end the process.
void write(const std::string& line) { std::cerr << "rung-run: " << line << std::endl; }
// For messages before there is a log; those of a compiler have several lines.
void print(const std::string& text) {
  control::Log log(runtime::systemClock(), write);
  for (const auto line : std::views::split(text, '\n'))
    if (!line.empty()) log.always(std::string(line.begin(), line.end()));
}

// Signals after which the program powers off regularly, including a closed terminal and a limit of processor time.
constexpr std::initializer_list<int> kEndSignals = {SIGINT, SIGTERM, SIGHUP, SIGXCPU};

// These signals become write errors.
void ignoreSignals() {
  struct sigaction action{};
  action.sa_handler = SIG_IGN;
  for (const int signal : {SIGPIPE, SIGXFSZ}) sigaction(signal, &action, nullptr);
}

// One running program with its pins and its socket for rungctl, from start to end.
class Run {
public:
  Run(const Options& options, const Image& image, std::unique_ptr<host::PlcHost> host, rung_run::Simulation* simulation,
      io::HostDevices& devices, control::Signals& signals)
      : signals_(signals), devices_(devices), host_(std::move(host)), pins_(*host_), connections_(host_->map()),
        log_(host_->clock(), write), controller_(options.name, *host_, image, log_),
        server_(options.name, getuid(), controller_),
        scans_(*host_, pins_, connections_, devices,
               {.periodNs = int64_t{options.periodUs} * 1000,
                .earlyNs = int64_t{options.earlyUs} * 1000,
                .thread = {.priority = options.priority, .lockMemory = options.lockMemory}}),
        loop_([](const char* problem) { std::fprintf(stderr, "rung-run: %s\n", problem); }, &signals) {
    loop_.add({.controller = &controller_,
               .server = &server_,
               .report = [this] { report(); },
               .turnDone = [this] { manager_.feed(scans_.steps(), host_->clock().nowNs()); }});
    if (!options.retain.empty()) log_.keepBeside(options.retain, host_->map().logBytes);
    controller_.addToStatus([this](nlohmann::json& status) {
      rung_run::addStatus(status, scans_.periodNs(), scans_.figures(), connections_.figures());
    });
    if (simulation != nullptr)
      controller_.setSimulation(
          [simulation](const std::string& name, const nlohmann::json& keys) { return simulation->event(name, keys); });
  }

  int run() {
    for (const std::string& line : connections_.warnings()) log_.always(line);
    connections_.writeOutputs(pins_.cells()); // their safe values
    connections_.start();
    devices_.start();
    if (const std::string wrong = scans_.start(); !wrong.empty()) return log_.always(wrong), int{cli::kEnvironment};
    log_.always("listening at " + server_.path());
    controller_.logStart();
    manager_.ready();
    while (!signals_.came()) loop_.turn();
    return end();
  }

private:
  void report() {
    connections_.report([this](const std::string& line) { (void)log_.line(line); });
    for (const std::string& line : devices_.report()) (void)log_.line(line);
  }

  // Each step is executed even if the one before has failed.
  int end() {
    std::string error = "the program was not switched off";
    manager_.stopping();
    loop_.guarded([&] { waitForEnd(); });
    loop_.guarded([&] { controller_.serveProgram(&server_); }); // a fault of the last steps
    loop_.guarded([&] { error = host_->close(); });
    loop_.guarded([&] { devices_.end(); });
    loop_.guarded([&] { controller_.serveProgram(&server_); });
    loop_.guarded([&] { report(); });
    loop_.guarded([&] { connections_.writeOutputs(pins_.cells()); }); // their safe values
    loop_.guarded([&] { connections_.end(); });
    loop_.guarded([&] {
      for (const std::string& line : rung_run::report(scans_.figures(), connections_.figures())) log_.always(line);
    });
    if (!error.empty()) log_.always(error);
    return error.empty() ? cli::kOk : cli::kEnvironment;
  }

  // Turns continue, because the steps may have to wait for a restart.
  void waitForEnd() {
    constexpr int64_t kSoonNs = 500'000'000;
    const int64_t begun = host_->clock().nowNs();
    bool said = false;
    for (scans_.beginEnd(); !scans_.hasEnded();) {
      loop_.turn();
      if (said || host_->clock().nowNs() - begun < kSoonNs) continue;
      loop_.guarded([&] { log_.always("the program is being switched off: its last scans run"); });
      said = true;
    }
    scans_.end();
  }

  control::Signals& signals_;
  io::HostDevices& devices_;
  std::unique_ptr<host::PlcHost> host_;
  rung_run::Pins pins_;
  io::Connections connections_;
  control::Log log_;
  control::Controller controller_;
  control::Server server_;
  rung_run::ScanThread scans_;
  rung_run::ServiceManager manager_;
  control::ServiceLoop loop_;
};

Image imageOf(const Options& options) {
  const rung_image_options how{
      .size = sizeof how, .allow_unsealed = options.unsealed ? 1u : 0u, .keys_folder = nullptr};
  if (options.program.ends_with(".so")) return Image(options.program, &how);
  std::string warnings;
  Image image = compile::compiledImage(options.program, getuid(), warnings);
  if (!warnings.empty()) std::cerr << warnings;
  return image;
}

void setDevices(io::HostDevices& devices, const Options& options) {
  const auto check = [](const char* option, const std::string& wrong) {
    if (!wrong.empty()) throw rung_run::WrongOption(std::string(option) + ": " + wrong);
  };
  rung_run::forPairs(options.config,
                     [&](const std::string& key, const std::string& value) { return devices.configure(key, value); });
  for (const std::string& setting : options.can) check("--can", devices.setCan(setting));
  for (const std::string& setting : options.com) check("--com", devices.setCom(setting));
  if (!options.sharedFile.empty()) check("--sa-file", devices.setSharedFile(options.sharedFile));
}

bool namesDevices(const Options& options) {
  return !options.can.empty() || !options.com.empty() || !options.sharedFile.empty() || !options.config.empty();
}

// The environment of the program besides its pins: a simulated control or devices; empty: only the control.
host::PlcHost::NewInstance newInstanceOf(const Options& options, const Image& image, const host::File& map,
                                         std::vector<std::string>& errors,
                                         std::unique_ptr<rung_run::Simulation>& simulation, io::HostDevices& devices) {
  if (options.simulate) {
    simulation = rung_run::loadSimulation(image.program().dialect, options.config);
    return [&simulation](const Image& of, const rung_instance_options& with) { return simulation->instance(of, with); };
  }
  if (!io::HostDevices::isFor(image)) return {};
  host::refuseAxes(map, "rung-run: axes are only moved in LinuxCNC", errors);
  devices.set(map, errors);
  setDevices(devices, options); // options have priority over the map
  return [&devices](const Image& of, const rung_instance_options& with) { return devices.instance(of, with); };
}

// A real-time thread that is active most of the time would block all other threads of its processor.
void checkEarly(const Options& options) {
  constexpr unsigned kPart = 4;
  const unsigned most = options.periodUs / kPart;
  if (options.earlyUs > most)
    throw rung_run::WrongOption(fmt::format("--early: found {}, expected 0 to {}, a quarter of --period {}",
                                            options.earlyUs, most, options.periodUs));
}

int run(const Options& options) try {
  checkEarly(options);
  if (const std::string wrong = control::wrongHostName(options.name); !wrong.empty())
    throw rung_run::WrongOption("--name: " + wrong);
  if (host::isNamedAsMap(options.program))
    throw rung_run::WrongOption("found the mapping file " + options.program +
                                " as the program, expected PROGRAM and then MAP" +
                                (host::isNamedAsMap(options.map) ? "" : "; exchange the two"));
  ignoreSignals();
  control::Signals signals(kEndSignals);
  const Image image = imageOf(options);
  if (!options.simulate && namesDevices(options) && !io::HostDevices::isFor(image))
    throw rung_run::WrongOption(
        "--can, --com, --sa-file, and --config without --simulate are only for programs of TECHNOL; this one is of " +
        std::string(image.program().dialect));
  std::vector<std::string> errors, warnings;
  host::File map = host::loadMap(options.map, errors);
  std::unique_ptr<rung_run::Simulation> simulation;
  io::HostDevices devices;
  const host::PlcHost::NewInstance newInstance = newInstanceOf(options, image, map, errors, simulation, devices);
  const bool hasMap = !map.paths.empty();
  std::unique_ptr<host::PlcHost> host;
  std::string problem; // an error of the machine, not of the map
  try {
    if (hasMap)
      host = host::PlcHost::make(
          image, std::move(map),
          {.retain = options.retain, .newInstance = newInstance, .catchUp = options.catchUp, .reset = "rungctl reset"},
          errors, warnings);
  } catch (const Error& error) {
    problem = error.what();
  }
  if (host != nullptr && simulation != nullptr) std::ranges::move(simulation->problems(), std::back_inserter(warnings));
  std::ranges::move(devices.warnings(), std::back_inserter(warnings));
  for (const std::string& text : warnings) print(text);
  for (const std::string& text : errors) print(text);
  if (!problem.empty()) print(problem);
  if (host == nullptr) return hasMap && problem.empty() ? cli::kWrong : cli::kEnvironment;
  host->setTimeLimit(int64_t{options.maxTimeUs} * 1000);
  return Run(options, image, std::move(host), simulation.get(), devices, signals).run();
} catch (const rung_run::WrongOption& wrong) {
  print(wrong.what());
  return cli::kUsage;
} catch (const std::exception& error) { // from the program or the socket
  print(error.what());
  return cli::kEnvironment;
}

void addOptions(cli::Command& command, Options& options) {
  command
      .option("PROGRAM", options.program,
              "Compiled program (.so), source file or project folder; sources are compiled first")
      .required();
  command.option("MAP", options.map, "Mapping file").required();
  command.option("--name", options.name, "Name of this host, for rungctl").showDefault();
  command.option("--period", options.periodUs, "Period of the scan thread in microseconds; the program keeps its own")
      .between(50u, 100000u)
      .showDefault();
  command
      .option("--early", options.earlyUs,
              "Wake up this many microseconds early and prefetch the program into the caches; up to a quarter of the "
              "period")
      .showDefault();
  command.option("--catch-up", options.catchUp, "Number of scans that may run at once if the thread was late")
      .between(1u, 1000u)
      .showDefault();
  command
      .option("--max-time", options.maxTimeUs,
              "Microseconds that a slice may take; a longer one stops the program with a fault; default: only the step "
              "budget is checked")
      .between(1u, 3'600'000'000u);
  command.option("--retain", options.retain, "Keep the retained memory in FILE.a and FILE.b, and the log in FILE.log");
  command.option("--priority", options.priority, "Real-time priority 1 to 99 (SCHED_FIFO); default: normal scheduling")
      .between(1, 99);
  command.flag("--lock-memory", options.lockMemory, "Lock all memory in RAM");
  command.flag("--unsealed", options.unsealed, "Load a program without a seal");
}

// The options for the environment of the program.
void addDeviceOptions(cli::Command& command, Options& options) {
  const cli::Option simulate =
      command.flag("--simulate", options.simulate, "Simulate the control of the program's dialect");
  command
      .option("--can", options.can, "CHANNEL=INTERFACE: TECHNOL's CAN channel 1 or 2, such as 2=can0; may be repeated")
      .excludes(simulate);
  command
      .option("--com", options.com,
              "PORT=DEVICE: TECHNOL's serial port 0 to 15, such as 1=/dev/ttyUSB0; may be repeated")
      .excludes(simulate);
  command.option("--sa-file", options.sharedFile, "File of TECHNOL's shared areas, for other programs to map")
      .excludes(simulate);
  command.option("--config", options.config,
                 "KEY=VALUE: configure TECHNOL's devices, or the simulated control; may be repeated");
}

} // namespace

int main(int argc, char** argv) {
  cli::CommandLine app(
      {.name = "rung-run",
       .description = "Run a PLC program on the computer's clock, with the pins of a mapping file",
       .exitStatus =
           "0 ok, 1 the mapping file is wrong, 2 wrong usage, 3 a file cannot be read, or the program cannot run",
       .guide = "docs/rung-run.md",
       .seeAlso = {"rungctl(1)", "rungc(1)", "rung-map(5)", "rung_hal(9)"}});
  Options options;
  cli::Command command = app.root();
  addOptions(command, options);
  addDeviceOptions(command, options);
  command.onParsed([&command, &options] {
    if (!command.given("--retain") || !options.retain.empty()) return cli::kOk;
    print("--retain: found an empty name, expected FILE");
    return cli::kUsage;
  });
  int status = cli::kOk;
  cli::addUsage(app, status);
  const std::optional<int> decided = app.run(argc, argv, [](const cli::WrongWords& words) {
    print(words.text + "; see `rung-run --help`");
    return cli::kUsage;
  });
  return decided ? *decided : run(options);
}
