// rung_gen_signals DIALECT SIGNALS.CSV OUT.INC: the build-time generator of the signal tables.
#include "rtlib/nc/gen/gen.h"

#include <algorithm>
#include <cstdio>
#include <fstream>

namespace rung::nc::gen {
namespace {

struct Dialect {
  std::string_view name;
  std::vector<Row> (*layout)(const Table&);
  bool ignoreCase;
};

constexpr Dialect kDialects[] = {{"fanuc", layoutFanuc, true},
                                 {"gsk", layoutGsk, false},
                                 {"nct", layoutNct, false},
                                 {"technol", layoutTechnol, true}};

int run(const std::string& name, const char* csv, const char* out) {
  const auto dialect =
      std::find_if(std::begin(kDialects), std::end(kDialects), [&](const Dialect& d) { return d.name == name; });
  if (dialect == std::end(kDialects)) throw TableError{"unknown dialect " + name};
  const std::vector<Row> rows = dialect->layout(Table(csv));
  std::ofstream file(out, std::ios::binary);
  emit(file, rows, dialect->ignoreCase);
  if (!file.flush()) throw TableError{std::string(out) + ": cannot be written"};
  const auto inferred = std::count_if(rows.begin(), rows.end(), [](const Row& row) { return row.inferred; });
  std::printf("%s: %zu signals, %td places inferred\n", name.c_str(), rows.size(), inferred);
  return 0;
}

} // namespace
} // namespace rung::nc::gen

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fputs("usage: rung_gen_signals fanuc|gsk|nct|technol SIGNALS.CSV OUT.INC\n", stderr);
    return 2;
  }
  try {
    return rung::nc::gen::run(argv[1], argv[2], argv[3]);
  } catch (const rung::nc::gen::TableError& error) {
    std::fprintf(stderr, "%s\n", error.message.c_str());
    return 1;
  }
}
