#!/usr/bin/env python3
"""Each rule of layering.py is broken once in a made-up tree and must be reported; a good tree must pass."""
import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).parent))
import layering

GOOD = {
    "rtlib/run/instance.h": "",
    "rtlib/nc/signal.h": "",
    "rtlib/nc/gsk/signals.h": "",
    "rtlib/abi/rung/program.h": "",
    "rtlib/load/loader.h": '#include "rung/program.h"\nint function, FUNCTION, fNction; // distinct\n',
    "rtlib/nc/control/control.h": "",
    "rtlib/nc/names/names.h": '#include "rtlib/nc/signal.h"\n',
    "rtlib/nc/names/pmc.cpp": 'const char* kGskName = "gsk"; // GSK\n',
    "ir/support/source.h": "#include <vector>\n",
    "ir/core/module.h": '#include "ir/support/source.h"\n#include "rung/program.h"\n',
    "frontend/table/instruction.h": '#include "ir/core/module.h"\n',
    "frontend/dialects/dialect.h": '#include "frontend/table/instruction.h"\n',
    "frontend/network/language.h": '#include "frontend/table/instruction.h"\n#include "rtlib/nc/signal.h"\n',
    "frontend/dialects/gsk/rows.h": '#include "frontend/dialects/dialect.h"\n#include "frontend/network/language.h"\n',
    "frontend/dialects/all.cpp": '#include "frontend/dialects/gsk/rows.h"\n',
    "codegen/cpp/emit.h": '#include "ir/core/module.h"\n',
    "codegen/llvm/emit.cpp": "#include <llvm/IR/Module.h>\n",
    "rtlib/text/similar.h": "#include <string>\n",
    "machine/host/mapping_file.cpp": '#include "rtlib/text/similar.h"\n',
    "machine/io/tables.h": '#include "rtlib/nc/signal.h"\n',
    "machine/io/tables/table_requests.cpp": '#include "machine/io/tables.h"\n#include "rtlib/load/loader.h"\n',
    "machine/io/host_devices.h": "",
    "machine/io/around.cpp": '#include "rtlib/load/loader.h"\n#include "machine/io/host_devices.h"\n',
    "machine/rung-run/main.cpp": '#include "machine/io/host_devices.h"\n',
    "machine/rung-run/devices.cpp": '#include "machine/io/tables.h"\n',
    "sim/simulated_nc.h": "namespace rung::sim::gsk {",
    "tools/report/difference.h": '#include "ir/core/module.h"\n',
    "machine/control/client.h": '#include "machine/control/server.h"\n',
    "machine/control/server.h": "",
    "tools/web/host_link.h": '#include "machine/control/client.h"\n',
    "tools/scenario/session.h": '#include "tools/report/difference.h"\n',
    "tools/rungc/main.cpp": '#include "codegen/cpp/emit.h"\n#include <nlohmann/json.hpp>\n',
}
BAD = {
    "frontend includes codegen": ("frontend/table/x.cpp", '#include "codegen/cpp/emit.h"'),
    "ir includes frontend": ("ir/core/x.cpp", '#include "frontend/table/instruction.h"'),
    "the base includes ir/core": ("ir/support/x.cpp", '#include "ir/core/module.h"'),
    "rtlib includes ir": ("rtlib/load/x.cpp", '#include "ir/support/source.h"'),
    "the ABI includes the host": ("rtlib/abi/rung/x.h", '#include "rtlib/load/loader.h"'),
    "a dialect includes another": ("frontend/dialects/nct/x.cpp", '#include "frontend/dialects/gsk/rows.h"'),
    "the networks include a dialect": ("frontend/network/x.cpp", '#include "frontend/dialects/gsk/rows.h"'),
    "the networks include a table of a dialect": ("frontend/network/x.cpp", '#include "rtlib/nc/gsk/signals.h"'),
    "reading networks includes the IR": ("frontend/network/x.cpp", '#include "ir/core/module.h"'),
    "lowering networks includes a table of a dialect": ("frontend/network/lower/x.cpp", '#include "rtlib/nc/gsk/signals.h"'),
    "the table includes a dialect": ("frontend/table/x.cpp", '#include "frontend/dialects/gsk/rows.h"'),
    "codegen includes frontend": ("codegen/cpp/x.cpp", '#include "frontend/table/instruction.h"'),
    "LLVM outside its wall": ("codegen/cpp/x.cpp", "#include <llvm/IR/Module.h>"),
    "LLVM in quotes": ("ir/core/x.cpp", '# include "llvm/IR/Module.h"'),
    "XML outside the tools": ("ir/support/x.cpp", "#include <pugixml.hpp>"),
    "Unicode outside the base": ("frontend/ladder/x.cpp", "#include <utf8proc.h>"),
    "clang outside its wall": ("codegen/llvm/x.cpp", "#include <clang/AST/AST.h>"),
    "fmt in rtlib": ("rtlib/load/x.cpp", "#include <fmt/format.h>"),
    "cryptography outside the host": ("codegen/cpp/x.cpp", "#include <sodium.h>"),
    "gtest in a library": ("ir/core/x.cpp", "#include <gtest/gtest.h>"),
    "the machine's component includes the simulation": ("machine/rung-hal/x.cpp", '#include "sim/simulated_nc.h"'),
    "the machine's component includes the runtime inside": ("machine/rung-hal/x.cpp", '#include "rtlib/run/instance.h"'),
    "the machine's component includes the compiler": ("machine/rung-hal/x.cpp", '#include "ir/core/module.h"'),
    "a device includes the simulation": ("machine/io/x.cpp", '#include "sim/simulated_nc.h"'),
    "a dialect as a text": ("rtlib/load/x.cpp", 'bool is = dialect == "gsk";'),
    "a dialect in an identifier": ("rtlib/core/x.h", "constexpr int kNctSlices = 5;"),
    "a dialect at the head of an identifier": ("rtlib/core/x.h", "void technolHalt();"),
    "a dialect in a macro": ("rtlib/abi/rung/x.h", "#define RUNG_GSK_SLOTS 1"),
    "a dialect in a comment": ("rtlib/record/x.cpp", "// as TECHNOL's modules do"),
    "another dialect as a text": ("rtlib/load/x.cpp", 'bool is = dialect == "fanuc";'),
    "a dialect in a page": ("rtlib/README.md", "The GSK25i has it."),
    "a dialect in the name of a file": ("rtlib/load/gsk_names.h", ""),
    "the control in the names": ("rtlib/nc/names/x.cpp", '#include "rtlib/nc/control/control.h"'),
    "the names in the signal tables": ("rtlib/nc/x.cpp", '#include "rtlib/nc/names/names.h"'),
    "a report includes what drives programs": ("tools/report/x.cpp", '#include "tools/scenario/session.h"'),
    "a tool includes the server of the socket": ("tools/web/x.cpp", '#include "machine/control/server.h"'),
    "TOML outside its wall": ("machine/host/x.cpp", "#include <toml++/toml.h>"),
    "a library includes a tool": ("codegen/cpp/x.cpp", '#include "tools/rungc/main.cpp"'),
    "an include without its folder": ("ir/core/x.cpp", '#include "module.h"'),
    "the compiler includes the simulation": ("compiler/x.cpp", '#include "sim/simulated_nc.h"'),
    "a namespace of another folder": ("machine/host/x.cpp", "namespace rung::io {"),
    "no namespace of the folder": ("machine/io/can/x.h", "namespace rung {"),
    "a lowering reports": ("frontend/dialects/technol/lower/x.cpp", "program.diagnostics.report(id, at);"),
}


class Layering(unittest.TestCase):
    def found(self, files):
        with tempfile.TemporaryDirectory() as folder:
            for name, text in files.items():
                path = Path(folder, name)
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text, encoding="utf-8")
            return layering.check(Path(folder))

    def test_good_tree(self):
        self.assertEqual(self.found(GOOD), [])

    def test_each_offence(self):
        for name, (path, text) in BAD.items():
            with self.subTest(name):
                found = self.found({**GOOD, path: text})
                self.assertEqual(len(found), 1, found)
                self.assertTrue(found[0].startswith(path), found)


if __name__ == "__main__":
    unittest.main()
