// Pages of a program with the results of runs: on its drawing, or for a dialect without drawings as a table of its
// rungs. The program is read again from its files; both functions fail if it cannot be read any more, or has errors
// now.
#pragma once
#include <string>

#include "frontend/dialects/dialect.h"
#include "ir/support/result.h"
#include "tools/report/coverage_report.h"
#include "tools/scenario/profiler.h"

namespace rung::rungc {

// The page of the program that the request's scenarios run.
Result<std::string> profilePage(const report::Profile& profile, const scenario::ProfileRequest& request);
// `project`: the title; "": the names of the files.
Result<std::string> coveragePage(const report::Program& program, const frontend::Dialect& dialect,
                                 const frontend::CompileOptions& options, const std::string& project);

} // namespace rung::rungc
