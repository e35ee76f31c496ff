// Retained memory of a run (see retained_files.h).
#include "tools/rungc/retained_files.h"

#include <fmt/format.h>
#include <utility>

namespace rung::rungc {
namespace {

// Once when saving begins to fail, and once when it works again; `fails` is what was reported last.
template <class Kept>
void reportChange(const Kept& kept, const std::string& name, bool& fails, const RetainedFiles::Report& report) {
  if (kept.failing() == fails) return;
  fails = !fails;
  report(fails ? fmt::format("warning: {}; the program continues, and saving is tried again", kept.problem())
               : fmt::format("{} is saved again", name));
}

} // namespace

RetainedFiles::RetainedFiles(scenario::Session& session, const std::string& file, bool realTime, Report report)
    : session_(session), file_(file), memory_(session.nc().control(), session.instance(), file),
      tables_(session.nc(), file), realTime_(realTime), report_(std::move(report)) {}

std::optional<nc::PowerOn> RetainedFiles::load(std::string& error) {
  std::string text;
  const std::optional<nc::PowerOn> kind = memory_.load(text, error);
  if (!text.empty()) report_(text);
  if (!kind) return std::nullopt;
  text.clear();
  tables_.load(text, error);
  if (!text.empty()) report_(text);
  return error.empty() ? kind : std::nullopt;
}

// On the real clock the scans continue while an image that the program asks for is written; on the virtual clock the
// scan ends when it is on disk, or was tried.
void RetainedFiles::scanned(const scenario::Session&) {
  if (!memory_.afterSlice() && !realTime_) {
    memory_.flush();
    memory_.afterSlice();
  }
  tables_.offer();
  reportFailures();
}

// The session's program is replaced between two statements, so there is time to wait for what was offered of the former
// one.
void RetainedFiles::replaced(const scenario::Session& session, const scenario::NextProgram&) {
  memory_.flush();
  auto lane = std::make_unique<host::RetainLane>(host::RetainMap(session.instance().program()));
  memory_.programChanged(lane);
  memory_.settle();
}

void RetainedFiles::reportFailures() {
  reportChange(memory_.memory(), file_, memoryFails_, report_);
  reportChange(tables_, file_ + ".nc", tablesFail_, report_);
}

std::string RetainedFiles::finish() {
  host::Instance& instance = session_.instance();
  memory_.finish();
  if (!instance.faulted()) session_.nc().powerOff(instance);
  std::string error = memory_.finish();
  if (std::string tables = tables_.finish(); error.empty()) error = std::move(tables);
  if (error.empty()) reportFailures();
  return error;
}

} // namespace rung::rungc
