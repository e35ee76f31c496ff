// One engine's run (see lane.h).
#include "tools/scenario/lane.h"

#include <fmt/format.h>
#include <iterator>
#include <utility>

#include "rtlib/host/program_info.h"
#include "rtlib/nc/control/refuse.h"
#include "tools/compiler/engines.h"

namespace rung::scenario {
namespace {

constexpr ptrdiff_t kMostUnread = 50'000; // entries of the log; a session of hours must not fill the memory

} // namespace

Lane::Lane(host::Engine& engine, std::string folder)
    : engine_(&engine), nc_(sim::makeSimulatedNc(engine.program().dialect)),
      instance_(std::make_unique<host::Instance>(engine, this)) {
  nc_->setFolder(std::move(folder));
}

void Lane::powerOn(nc::PowerOn kind) {
  nc_->powerOn(*instance_, kind);
  unreadLog_.clear();
  requests_.clear();
}

std::string Lane::replace(host::Engine& next, ReplaceReport& report) {
  const rung_program& former = instance_->program();
  host::Replacement replacement(former, {next.program(), next.context()});
  ReplaceReport planned(replacement.transfer());
  requests_.take(*instance_);
  switch (instance_->replace(replacement)) {
  case host::ReplaceResult::Replaced: break;
  case host::ReplaceResult::OtherProgram: return "another program is running";
  case host::ReplaceResult::WithinPass:
    return "the program is within a pass, which slots have left unfinished; a program is replaced between two: write "
           "scan before it";
  case host::ReplaceResult::RequestsWait:
    return fmt::format("a request {} waits for its answer, and the new program numbers its services otherwise",
                       host::serviceName(former, instance_->services().peek()->service));
  case host::ReplaceResult::MechanismWaits:
    return fmt::format("{} waits at an instruction that the new program does not have",
                       replacement.transfer().waiting(instance_->block().data()));
  }
  engine_ = &next;
  requests_.programChanged(*instance_, sim::Relocation(former, instance_->program()));
  report = std::move(planned);
  return {};
}

void Lane::advance(Advance how) {
  (nc_.get()->*how)(*instance_);
  takeLog();
}

void Lane::takeMessages() {
  nc_->takeMessages(*instance_);
  takeLog();
}

void Lane::takeLog() {
  for (std::string& line : nc_->takeLog()) unreadLog_.push_back(std::move(line));
  if (std::ssize(unreadLog_) > 2 * kMostUnread) unreadLog_.erase(unreadLog_.begin(), unreadLog_.end() - kMostUnread);
}

void Lane::ignore() {
  rt::ServiceRequest request;
  while (instance_->services().take(request)) instance_->services().complete(nc::refuse(instance_->program(), request));
  unreadLog_.clear();
}

} // namespace rung::scenario
