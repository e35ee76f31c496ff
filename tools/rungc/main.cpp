// rungc: compiles, runs, tests and explains PLC programs of CNC controls. A thin main over libraries.
#include <CLI/CLI.hpp>

#include "tools/rungc/commands.h"
#include "tools/rungc/usage.h"

int main(int argc, char** argv) {
  using namespace rung::rungc;
  CLI::App app{"Compiler for the PLC programs of CNC machine tools (NCT2xx/3xx, GSK25i, MEFI TECHNOL)"};
  app.require_subcommand(1);
  app.set_version_flag("--version", "rungc 0.1");
  app.footer("Exit status: 0 ok, 1 the program or scenario is wrong, 2 wrong usage, 3 environment.");
  int status = kOk;
  addNew(app, status);
  addCheck(app, status);
  addBuild(app, status);
  addSeal(app, status);
  addKey(app, status);
  addEmit(app, status);
  addConvert(app, status);
  addView(app, status);
  addRun(app, status);
  addTest(app, status);
  addProfile(app, status);
  addExplain(app, status);
  addDoc(app, status);
  addHelp(app, status);
  try {
    app.parse(argc, argv);
  } catch (const CLI::RuntimeError& error) {
    return error.get_exit_code(); // the cause is printed
  } catch (const CLI::Success& asked) {
    return app.exit(asked); // --help, --version
  } catch (const CLI::ParseError& error) {
    return wrongUsage(app, error);
  }
  return status;
}
