// The NC beside a TECHNOL PLC, composed of the topics in technol/: the life of the program, part-program blocks,
// events, messages (man. ch. 3.17, 5, 14).
#include "rtlib/host/program_info.h"
#include "rtlib/nc/model/nc_model.h"
#include "rtlib/nc/model/technol/blocks.h"
#include "rtlib/nc/model/technol/cells.h"
#include "rtlib/nc/model/technol/configuration.h"
#include "rtlib/nc/model/technol/events.h"
#include "rtlib/nc/model/technol/program_life.h"
#include "rtlib/nc/technol/configuration.h"
#include "rtlib/nc/technol/licences.h"

namespace rung::nc {
namespace {

constexpr int kShutdownScans = 500;  // at most, while MODULE_DONE_FINISHED is owed
constexpr std::string_view kHaltRequested = "halt-status 6: requested"; // man. l.5361
constexpr uint32_t kBehindInput = 1; // hooks of the scan, see assemble.cpp of the dialect

class TechnolModel final : public NcModel {
public:
  void powerOn(host::Instance& instance, PowerOn kind) override {
    NcModel::powerOn(instance, kind);
    blocks_.reset(instance);
    technol::writeCell(instance, kLicenceCell, configuration_.licences());
    life_.powerOn(instance);
    takeMessages(instance);
  }

  void powerOff(host::Instance& instance) override {
    if (!life_.powerOff(instance)) return;
    for (int i = 0; i < kShutdownScans && !instance.faulted() && life_.owesDone(instance); ++i) scan(instance);
  }

  void onHook(host::Instance& instance, uint32_t work) override {
    if (work == kBehindInput) blocks_.supervise(instance);
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

  std::string config(std::string_view key, std::string_view value) override { return configuration_.set(key, value); }

  bool respond(host::Instance& instance, const rt::ServiceRequest& request, rt::ServiceReply& reply) override {
    if (host::serviceName(instance.program(), request.service) != kConfigurationService) return false;
    configuration_.respond(request, reply);
    return true;
  }

  std::string blockStart(host::Instance& instance, const std::vector<NcArgument>& keys) override {
    return blocks_.start(instance, keys);
  }
  std::string blockDone(host::Instance& instance) override { return blocks_.reached(instance); }

  std::string event(host::Instance& instance, std::string_view name, const std::vector<NcArgument>& keys) override {
    if (technol::equalIgnoringCase(name, "CONFIRM")) {
      board_.confirmOldest();
      return {};
    }
    if (technol::equalIgnoringCase(name, "HALT")) {
      instance.halt(kHaltRequested);
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
    if (command == "stop")
      life_.stop(instance);
    else if (command == "start")
      life_.start(instance);
    else
      life_.clear(instance);
    takeMessages(instance);
    return {};
  }

protected:
  std::optional<host::Ref> signal(const host::Instance& instance, std::string_view name) const override {
    return technol::signalPlace(instance, name);
  }

private:
  technol::Blocks blocks_;
  technol::ProgramLife life_;
  technol::Configuration configuration_;
};

} // namespace

std::unique_ptr<NcModel> makeTechnolModel() { return std::make_unique<TechnolModel>(); }

} // namespace rung::nc
