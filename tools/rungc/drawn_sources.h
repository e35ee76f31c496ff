// A program as the live page shows it, drawn again from its sources.
#pragma once
#include <string>
#include <vector>

#include "compiler/compile.h"
#include "ir/support/result.h"
#include "tools/web/shown_program.h"

namespace rung::rungc {

// From the files from which `compiled` was compiled in this process. Fails if they have been changed since. `title`: of
// the page; "": the names of the files.
Result<web::ShownProgram> drawnAgain(const compiler::Compiled& compiled, const std::string& title = {});
// Of a program that a recording or a machine has. `files`: as on a command line; without any, those that the program
// names. They may have other paths here. Fails if they are not there, or are not those of the program.
Result<web::ShownProgram> drawnFrom(const compiler::Compiled& program, const std::vector<std::string>& files);

} // namespace rung::rungc
