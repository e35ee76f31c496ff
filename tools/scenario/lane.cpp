// One engine's run (see lane.h).
#include "tools/scenario/lane.h"

#include <iterator>
#include <utility>

#include "rtlib/nc/control/refuse.h"

namespace rung::scenario {
namespace {

constexpr ptrdiff_t kMostUnread = 50'000; // entries of the log; a session of hours must not fill the memory

// A shared object is machine code, whatever made it.
compiler::EngineKind kindOf(const runtime::Engine& engine) {
  return compiler::engineFromName(engine.name()).value_or(compiler::EngineKind::Jit);
}

void serveWith(rung::Image& image, const runtime::Engine& engine, const compiler::GetCompiled& compiled) {
  if (compiled) check(compiler::serveImage(image.handle(), compiled, kindOf(engine), {}));
}

} // namespace

Lane::Lane(runtime::Engine& engine, std::string folder, sim::Clock clock)
    : engine_(&engine),
      machine_(engine.program(), engine.context(), sim::makeSimulatedNc(engine.program().dialect), clock) {
  nc().setFolder(std::move(folder));
  nc().setAnswers(&requests_);
  requests_.report(nc());
}

void Lane::serve(const compiler::GetCompiled& compiled) { serveWith(machine_.image(), *engine_, compiled); }

void Lane::powerOn(nc::PowerOn kind) {
  machine_.powerOn(kind);
  takeLog();
  unreadLog_.clear();
  requests_.clear();
}

std::string Lane::replace(runtime::Engine& next, const compiler::GetCompiled& compiled, ReplaceReport& report) try {
  const rung_program& former = instance().program();
  rung::Image image = sim::imageOf(next.program(), next.context());
  serveWith(image, next, compiled);
  rung::Replacement replacement(machine_.instance(), image);
  replacement.allowLate(); // the clock of a scenario waits
  ReplaceReport planned(replacement);
  requests_.take(instance());
  if (check(rung_instance_replace(machine_.instance().handle(), replacement.handle())) == RUNG_LATER)
    return rung_error_text();
  engine_ = &next;
  machine_.setImage(std::move(image));
  requests_.programChanged(instance(), sim::Relocation(former, instance().program()));
  report = std::move(planned);
  return {};
} catch (const rung::Error& error) {
  return error.what();
}

void Lane::advance(Advance how) {
  (machine_.*how)();
  takeLog();
}

void Lane::takeLog() {
  for (std::string& line : nc().takeLog()) unreadLog_.push_back(std::move(line));
  if (std::ssize(unreadLog_) > 2 * kMostUnread) unreadLog_.erase(unreadLog_.begin(), unreadLog_.end() - kMostUnread);
}

void Lane::ignore() {
  core::ServiceRequest request;
  while (instance().services().take(request)) instance().services().complete(nc::refuse(instance().program(), request));
  unreadLog_.clear();
}

} // namespace rung::scenario
