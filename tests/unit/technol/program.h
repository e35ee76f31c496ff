// Compiles a TECHNOL program from text and runs it on the interpreter.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "frontend/dialects/technol/technol.h"
#include "ir/interp/interp.h"
#include "ir/shape/layout.h"
#include "rtlib/run/instance.h"

namespace rung::technol_test {

// Parts of a complete program; each is lines of source text.
struct Parts {
  std::string data, input, main, init, fast, blockInit, blockDone, clear, halt, done, cont;
};
// The main file of a program with these parts. `main` begins in line 6 + the lines of data and input.
std::string programText(const Parts& parts);

struct Compilation {
  std::unique_ptr<SourceManager> sources;
  std::unique_ptr<Diagnostics> diagnostics;
  std::unique_ptr<ir::Module> module;

  // "file:line code" of each error, and of each warning, sorted by place; the main file is "0".
  std::vector<std::string> errors() const;
  std::vector<std::string> warnings() const;
  std::string text() const; // everything that was reported, rendered
};
Compilation compile(const std::vector<std::string>& files, const frontend::CompileOptions& options = {});
inline Compilation compileMain(std::string main, std::string data = {}) {
  return compile({programText({.data = std::move(data), .main = std::move(main)})});
}

// A running program. The block modules run at hook 1 while `block` says so.
class Machine : public runtime::ScheduleHooks {
public:
  explicit Machine(const std::vector<std::string>& files, const frontend::CompileOptions& options = {});
  explicit Machine(const Parts& parts) : Machine(std::vector<std::string>{programText(parts)}) {}

  // As after power-up: INIT has run. Called by the constructor.
  void start();
  void scan(int times = 1);
  bool run(std::string_view task) { return instance_->runTask(task); }
  runtime::Instance& instance() { return *instance_; }

  int64_t get(std::string_view name) const; // signed
  double real(std::string_view name) const;
  void set(std::string_view name, int64_t value);
  void setReal(std::string_view name, double value);
  // "number/persistent/subid/par1" of each message since the last call, `-` in front of a removal.
  std::vector<std::string> messages();

  void onHook(runtime::Instance& instance, uint32_t work) override;
  bool blockInit = false; // MODULE_BLOCK_INIT runs until it has run through
  bool blockDone = false;

private:
  runtime::Ref resolve(std::string_view name) const;

  Compilation compilation_;
  std::unique_ptr<ir::Layout> layout_;
  std::unique_ptr<ir::InterpEngine> engine_;
  std::unique_ptr<runtime::Instance> instance_;
};

} // namespace rung::technol_test
