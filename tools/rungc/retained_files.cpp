// Retained memory of a run (see retained_files.h).
#include "tools/rungc/retained_files.h"

#include <chrono>
#include <fmt/format.h>

namespace rung::rungc {
namespace {

constexpr std::chrono::milliseconds kAtRequest(5); // the program waits for it
constexpr std::chrono::milliseconds kAlways(200);

void report(const std::string& text) {
  if (!text.empty()) fmt::print(stderr, "rungc: {}\n", text);
}

} // namespace

RetainedFiles::RetainedFiles(scenario::Session& session, const std::string& file, bool realTime)
    : session_(session),
      memory_(session.instance().program(), file, session.nc().control().savesOnRequest() ? kAtRequest : kAlways),
      tables_(session.nc(), file), realTime_(realTime) {
  session.nc().control().setStored(true);
}

std::optional<nc::PowerOn> RetainedFiles::load(std::string& error) {
  std::string text;
  const bool found = memory_.load(session_.instance(), text, error);
  if (!error.empty()) return std::nullopt;
  report(text);
  if (!found && !text.empty()) session_.nc().control().reportRetainedLost();
  text.clear();
  tables_.load(text, error);
  if (!error.empty()) return std::nullopt;
  report(text);
  return found ? nc::PowerOn::Warm : nc::PowerOn::Cold;
}

void RetainedFiles::scanned(const scenario::Session& session) {
  if (session.nc().control().savesOnRequest())
    saveOnRequest();
  else
    memory_.offer(session.instance());
  tables_.offer();
}

// On the real clock the scans continue while the image is written; a failure is tried again. On the virtual clock the
// scan ends when the image is on disk.
void RetainedFiles::saveOnRequest() {
  nc::Control& nc = session_.nc().control();
  host::Instance& instance = session_.instance();
  if (saving_ && !memory_.written()) return;
  if (saving_ && memory_.failed() == failures_) nc.saved(instance);
  saving_ = false;
  if (!nc.asksToSave(instance)) return;
  failures_ = memory_.failed();
  saving_ = memory_.offer(instance);
  if (realTime_) return;
  if (memory_.finish(instance).empty()) nc.saved(instance);
  saving_ = false;
}

std::string RetainedFiles::finish() {
  if (!session_.instance().faulted()) session_.nc().powerOff(session_.instance());
  if (std::string error = memory_.finish(session_.instance()); !error.empty()) return error;
  return tables_.finish();
}

} // namespace rung::rungc
