// Retained memory of a run (see retained_files.h).
#include "tools/rungc/retained_files.h"

#include <array>
#include <fmt/format.h>
#include <utility>

namespace rung::rungc {
namespace {

// Reports when saving begins to fail, and when it works again; `fails` is what was last reported.
void reportChange(bool failsNow, const std::string& problem, const std::string& name, bool& fails,
                  const RetainedFiles::Report& report) {
  if (failsNow == fails) return;
  fails = failsNow;
  report(fails ? fmt::format("warning: {}; the program continues, and will try to save again", problem)
               : fmt::format("{} is saved again", name));
}

} // namespace

RetainedFiles::RetainedFiles(scenario::Session& session, const std::string& file, Report report)
    : session_(session), file_(file), tables_(session.nc(), file), report_(std::move(report)) {
  session.machine().setReport(report_);
  session.machine().instance().keep(file);
}

std::string RetainedFiles::load() {
  std::string text, error;
  tables_.load(text, error);
  if (!text.empty()) report_(text);
  return error;
}

void RetainedFiles::scanned(const scenario::Session&) {
  tables_.offer();
  reportFailures();
}

void RetainedFiles::reportFailures() {
  std::array<char, 512> problem{};
  const bool fails =
      rung_instance_unsaved(session_.machine().instance().handle(), problem.data(), problem.size()) == RUNG_OK;
  reportChange(fails, problem.data(), file_, memoryFails_, report_);
  reportChange(tables_.failing(), tables_.problem(), file_ + ".nc", tablesFail_, report_);
}

std::string RetainedFiles::finish() {
  std::string error;
  try {
    session_.machine().powerOff();
  } catch (const rung::Error& failed) {
    error = failed.what();
  }
  if (std::string tables = tables_.finish(); error.empty()) error = std::move(tables);
  if (error.empty()) reportFailures();
  return error;
}

} // namespace rung::rungc
