// A host of a small program that records, and what the program did.
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "compiler/compile.h"
#include "compiler/engines.h"
#include "ir/support/diag_render.h"
#include "rung/runtime.hpp"

namespace rung::replay {

// A compiled program, with marks.
struct HostProgram {
  // A text is that of a file "t.pmc".
  explicit HostProgram(const char* text) { compile({sources.addBuffer("t.pmc", text)}); }
  static HostProgram ofFile(const char* file) {
    HostProgram program;
    program.compile(std::move(compiler::addFiles(program.sources, {file}, {})).value());
    return program;
  }
  SourceManager sources;
  std::shared_ptr<const compiler::Compiled> compiled;
  std::unique_ptr<runtime::Engine> engine;

private:
  HostProgram() = default;
  void compile(const std::vector<FileId>& files) {
    Diagnostics diagnostics;
    compiler::CompileRequest request;
    request.marks = request.keepBuilt = true;
    auto result = compiler::compile(sources, files, request, diagnostics);
    EXPECT_TRUE(result) << renderText(diagnostics, sources);
    compiled = std::make_shared<compiler::Compiled>(std::move(*result));
    engine = std::move(compiler::makeEngine(compiler::EngineKind::Interp, *compiled, {})).value();
  }
};

// Runs it in the control of GSK, with GO on for every second hundred scans, and records into the folder.
struct RecordedHost {
  static constexpr const char* kProgram =
      "dialect gsk\nsymbol GO X0.0\nsymbol LAMP Y0.0\nsymbol LATE Y0.1\nsymbol COUNT D100\n"
      "FUNC END1\n; lamp\nLD GO\nANI R0.0\nOUT LAMP\n"
      "; late\nLD LAMP\nFUNC TMRB\nPRM 1\nPRM 40\nOUT LATE\nFUNC END2\n";

  static constexpr int kWritten = 700; // the scan before which a client writes COUNT

  explicit RecordedHost(const std::string& folder, int scans = 1500) : program(kProgram) {
    const rung::Image image = rung::Image::adopt(program.engine->program(), program.engine->context());
    rung::Instance instance(image);
    const rung_recording_options options{.size = sizeof options, .state_ms = 2000, .folder = folder.c_str()};
    EXPECT_EQ(rung_instance_record(instance.handle(), &options), RUNG_OK) << rung_error_text();
    uint8_t go = 0;
    instance.bindInput("GO", go);
    instance.powerOn(rung::Power::Cold);
    for (int scan = 0; scan < scans; ++scan) {
      go = scan / 100 % 2;
      if (scan == kWritten)
        instance.write<int64_t>(instance.find("COUNT", rung::Access::Write), 42); // as a client does
      EXPECT_EQ(instance.scan(), RUNG_OK);
      lamps.push_back(static_cast<uint8_t>(instance.read<int64_t>(instance.find("LAMP"))));
      lates.push_back(static_cast<uint8_t>(instance.read<int64_t>(instance.find("LATE"))));
    }
    EXPECT_EQ(rung_instance_record(instance.handle(), nullptr), RUNG_OK);
  }
  HostProgram program;
  std::vector<uint8_t> lamps, lates;
};

} // namespace rung::replay
