// Runs a fuzz target without libFuzzer: every seed, then EACH mutations for each of them, the same ones every time;
// RUNG_MUTATIONS=N tries N instead. A PATH is a seed or a folder of seeds. bounded EACH PATH...
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "tests/fuzz/mutations.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

namespace {

class Mutator {
public:
  explicit Mutator(std::vector<std::string> seeds) : seeds_(std::move(seeds)) {}

  // Some edits: bytes, pieces of this or another seed, lines.
  std::string next() {
    std::string text = seeds_[below(seeds_.size())];
    for (size_t edits = 1 + below(4); edits > 0; --edits) edit(text);
    return text;
  }

private:
  size_t below(size_t n) { return n == 0 ? 0 : random_() % n; }
  std::string piece(const std::string& text) {
    const size_t begin = below(text.size());
    return text.substr(begin, 1 + below(40));
  }
  std::string line(const std::string& text) {
    const size_t begin = text.rfind('\n', below(text.size()));
    const size_t from = begin == std::string::npos ? 0 : begin + 1;
    const size_t end = text.find('\n', from);
    return text.substr(from, end == std::string::npos ? end : end + 1 - from);
  }
  size_t lineStart(const std::string& text) {
    const size_t begin = text.rfind('\n', below(text.size()));
    return begin == std::string::npos ? 0 : begin + 1;
  }
  void edit(std::string& text) {
    const size_t at = below(text.size() + 1);
    switch (below(7)) {
    case 0: text.insert(at, 1, static_cast<char>(below(256))); return;
    case 1: text.erase(at, 1 + below(3)); return;
    case 2: text.insert(at, piece(seeds_[below(seeds_.size())])); return;
    case 3: text.erase(at, 1 + below(40)); return;
    case 4: text.insert(lineStart(text), line(seeds_[below(seeds_.size())])); return;
    case 5: text.insert(lineStart(text), line(text)); return;
    case 6: {
      const size_t start = lineStart(text);
      const size_t end = text.find('\n', start);
      text.erase(start, end == std::string::npos ? end : end + 1 - start);
      return;
    }
    }
  }

  std::vector<std::string> seeds_;
  std::mt19937_64 random_{1};
};

void run(const std::string& text) {
  LLVMFuzzerTestOneInput(reinterpret_cast<const uint8_t*>(text.data()), text.size());
}

} // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fputs("bounded EACH PATH...\n", stderr);
    return 2;
  }
  namespace fs = std::filesystem;
  std::vector<fs::path> paths;
  for (int i = 2; i < argc; ++i)
    if (fs::is_directory(argv[i]))
      paths.insert(paths.end(), fs::directory_iterator(argv[i]), {});
    else
      paths.emplace_back(argv[i]);
  std::sort(paths.begin(), paths.end());
  std::vector<std::string> seeds;
  for (const fs::path& path : paths) {
    std::ifstream file(path, std::ios::binary);
    if (!file) {
      std::fprintf(stderr, "cannot read %s\n", path.c_str());
      return 2;
    }
    seeds.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
    run(seeds.back());
  }
  if (seeds.empty()) return 2;
  long count = rung::fuzz::mutationsOfEach(std::atol(argv[1])) * static_cast<long>(seeds.size());
  for (Mutator mutator(std::move(seeds)); count > 0; --count) run(mutator.next());
  return 0;
}
