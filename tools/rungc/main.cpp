// rungc: compiles, runs, tests and explains PLC programs of CNC controls. A thin main over libraries.
#include <CLI/CLI.hpp>

#include "tools/rungc/commands.h"

int main(int argc, char** argv) {
  using namespace rung::rungc;
  CLI::App app{"Compiler for the PLC programs of CNC machine tools (NCT2xx/3xx, GSK25i, MEFI TECHNOL)"};
  app.require_subcommand(1);
  app.set_version_flag("--version", "rungc 0.1");
  app.failure_message(CLI::FailureMessage::help);
  app.footer("Exit status: 0 ok, 1 the program or scenario is wrong, 2 wrong usage, 3 environment.");
  int status = kOk;
  addCheck(app, status);
  addBuild(app, status);
  addEmit(app, status);
  addConvert(app, status);
  addView(app, status);
  addRun(app, status);
  addTest(app, status);
  addProfile(app, status);
  addExplain(app, status);
  addDoc(app, status);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kOk : kUsage;
  }
  return status;
}
