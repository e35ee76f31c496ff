// A program from text, compiled and loaded in the process.
#pragma once
#include <memory>
#include <string>

#include "compiler/engines.h"

namespace rung::testing {

class CompiledProgram {
public:
  // `file` names the text in messages; its ending and contents say the dialect. A program that does not compile ends
  // the test.
  CompiledProgram(const std::string& file, const std::string& text,
                  compiler::EngineKind engine = compiler::EngineKind::Jit);

  // Valid as long as this object.
  const rung_program& program() const { return engine_->program(); }
  void* context() const { return engine_->context(); } // for Image::adopt

private:
  compiler::Compiled compiled_;
  std::unique_ptr<runtime::Engine> engine_;
};

} // namespace rung::testing
