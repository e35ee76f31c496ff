// The NC beside a TECHNOL PLC, composed of the topics in technol/: the life of the program, part-program blocks,
// events, messages (man. ch. 3.17, 5, 14).
#include <iterator>
#include <span>

#include "rtlib/host/program_info.h"
#include "rtlib/nc/config_key.h"
#include "rtlib/nc/faults.h"
#include "tools/sim/nc_model.h"
#include "tools/sim/technol/backup.h"
#include "tools/sim/technol/blocks.h"
#include "tools/sim/technol/cells.h"
#include "tools/sim/technol/configuration.h"
#include "tools/sim/technol/control_files.h"
#include "tools/sim/technol/events.h"
#include "tools/sim/technol/exchange.h"
#include "tools/sim/technol/messages.h"
#include "tools/sim/technol/program_life.h"
#include "rtlib/nc/technol/configuration.h"
#include "rtlib/nc/technol/licences.h"

namespace rung::nc {
namespace {

constexpr int kShutdownScans = 500;  // at most, while MODULE_DONE_FINISHED is owed
constexpr uint32_t kBehindInput = 1; // hooks of the scan, see assemble.cpp of the dialect

class TechnolModel final : public NcModel {
public:
  void powerOn(host::Instance& instance, PowerOn kind) override {
    NcModel::powerOn(instance, kind);
    messages_.clear();
    blocks_.reset(instance);
    technol::writeCell(instance, kLicenceCell, configuration_.licences());
    backup_.powerOn(instance);
    exchange_.beforeInit(instance, true);
    life_.powerOn(instance);
    exchange_.behindInit(instance);
    takeMessages(instance);
  }

  void powerOff(host::Instance& instance) override {
    if (!life_.powerOff(instance)) return;
    for (int i = 0; i < kShutdownScans && !instance.faulted() && life_.owesDone(instance); ++i) scan(instance);
  }

  void onHook(host::Instance& instance, uint32_t work) override {
    if (work == kBehindInput) return blocks_.supervise(instance);
    exchange_.onHook(instance, work);
    if (work == kHookBehindMain) backup_.behindMain(instance);
  }

  void onFault(host::Instance& instance) override { technol::runWith(instance, "HALT", 0, false); }

  void scan(host::Instance& instance) override {
    NcModel::scan(instance);
    life_.afterScan(instance);
  }

  void slot(host::Instance& instance) override {
    NcModel::slot(instance);
    life_.afterScan(instance);
  }

  void betweenSlices(host::Instance& instance) override {
    if (instance.atListStart()) life_.afterScan(instance);
  }

  std::string config(std::string_view key, std::string_view value) override {
    if (const ConfigKey* row = findConfigKey(technolConfigKeys(), key))
      if (std::string wrong = wrongValue(*row, key, value); !wrong.empty()) return wrong;
    constexpr std::string_view kKeys[] = {"PlcErrors", "PlcConstants", "PlcConfig"}; // of files, by ControlFileKind
    for (size_t i = 0; i < std::size(kKeys); ++i)
      if (key == kKeys[i]) return readFile(static_cast<technol::ControlFileKind>(i), value);
    std::string problem = exchange_.configure(key, value);
    return problem.empty() ? configuration_.set(key, value) : problem;
  }
  std::string connect(std::string_view source, std::string_view destination) override {
    exchange_.connect(source, destination);
    return {};
  }
  bool savesOnRequest() const override { return true; }
  void setStored(bool stored) override { backup_.setStored(stored); }
  bool asksToSave(const host::Instance& instance) const override { return backup_.asked(instance); }
  void saved(host::Instance& instance) override { backup_.saved(instance); }

  std::vector<NcProblem> connectionProblems() const override { return exchange_.problems(); }

  // Shared variables have their names beside the program's own; screens write inputs only (man. l.13609).
  std::optional<host::Ref> readPlace(const host::Instance& instance, std::string_view name) const override {
    const auto place = NcModel::readPlace(instance, name);
    return place ? place : exchange_.shared().find(name, false);
  }
  std::optional<host::Ref> writePlace(const host::Instance& instance, std::string_view name) const override {
    const auto place = NcModel::readPlace(instance, name);
    return place ? place : exchange_.shared().find(name, true);
  }
  void beforeWrite(host::Instance& instance, const host::Ref& place) override {
    exchange_.beforeWrite(instance, place);
  }
  std::optional<NcCell> readCell(std::string_view name) const override { return exchange_.cells().read(name); }
  bool writeCell(std::string_view name, const NcCell& value) override { return exchange_.cells().write(name, value); }

  bool respond(host::Instance& instance, const rt::ServiceRequest& request, rt::ServiceReply& reply) override {
    if (exchange_.respond(instance, request, reply)) return true;
    if (host::serviceName(instance.program(), request.service) != kConfigurationService) return false;
    configuration_.respond(request, reply);
    return true;
  }

  void takeMessages(host::Instance& instance) override { messages_.take(instance, board_); }
  std::vector<ShownMessage> messages(const host::Instance&) const override { return messages_.shown(); }

  std::string blockStart(host::Instance& instance, const std::vector<NcArgument>& keys) override {
    return blocks_.start(instance, keys);
  }
  std::string blockDone(host::Instance& instance) override { return blocks_.reached(instance); }

  std::string event(host::Instance& instance, std::string_view name, const std::vector<NcArgument>& keys) override {
    if (technol::equalIgnoringCase(name, "CONFIRM")) {
      messages_.confirm();
      return {};
    }
    if (technol::equalIgnoringCase(name, "HALT")) {
      instance.halt(kTechnolRequested);
      takeMessages(instance);
      return {};
    }
    const auto constant = [this](std::string_view id) { return configuration_.constant(id); };
    const std::optional<std::string> answer = technol::callEvent(instance, name, keys, constant);
    if (!answer) return NcModel::event(instance, name, keys);
    takeMessages(instance);
    return *answer;
  }

  std::string plcCommand(host::Instance& instance, std::string_view command) override {
    if (command == "stop") {
      life_.stop(instance);
    } else if (command == "start") {
      messages_.clear(); // as at power-up
      start(instance);
    } else {
      life_.clear(instance);
    }
    takeMessages(instance);
    return {};
  }

protected:
  std::optional<host::Ref> signal(const host::Instance& instance, std::string_view name) const override {
    return technol::signalPlace(instance, name);
  }

private:
  std::string readFile(technol::ControlFileKind kind, std::string_view file) {
    technol::ControlFiles files = files_;
    std::string wrong = technol::readControlFile(kind, inFolder(file), files);
    const auto added = [](const auto& all, const auto& earlier) { return std::span(all).subspan(earlier.size()); };
    if (wrong.empty())
      wrong =
          configuration_.define(added(files.parameters, files_.parameters), added(files.constants, files_.constants));
    if (!wrong.empty()) return wrong;
    exchange_.take(added(files.connections, files_.connections), added(files.terminals, files_.terminals));
    files_ = std::move(files);
    messages_.define(files_.messages);
    return {};
  }

  // MODULE_INIT tells its variables again.
  void start(host::Instance& instance) {
    exchange_.beforeInit(instance, false);
    life_.start(instance);
    exchange_.behindInit(instance);
  }

  technol::Blocks blocks_;
  technol::ProgramLife life_;
  technol::ControlFiles files_;
  technol::Configuration configuration_;
  technol::Messages messages_;
  technol::Exchange exchange_;
  technol::Backup backup_;
};

} // namespace

std::unique_ptr<NcModel> makeTechnolModel() { return std::make_unique<TechnolModel>(); }

} // namespace rung::nc
