// Goldens: a folder of inputs beside what they become. RUNG_UPDATE=1 writes what they become anew, and removes what
// nothing makes any more; a review reads the difference. In GoogleTest cases, which run in the root of the repository.
#pragma once
#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace rung::test {

class Golden {
public:
  // `folder` from the root of the repository; `extensions` of inputs, with their dots.
  Golden(std::filesystem::path folder, const std::vector<std::string>& extensions);
  // Fails for each file that is neither an input nor compared: nothing holds it to be right.
  ~Golden();
  Golden(const Golden&) = delete;
  Golden& operator=(const Golden&) = delete;

  // In the order of their names; a folder without inputs fails the test.
  const std::vector<std::filesystem::path>& inputs() const { return inputs_; }
  std::string read(const std::filesystem::path& file) const; // "" when it is not there

  // `text` is what the file of the folder holds. An input can be compared as well.
  void expect(const std::string& name, std::string_view text);
  // What `input` becomes, in the file of its name with another extension.
  void expect(const std::filesystem::path& input, std::string_view extension, std::string_view text);

private:
  std::filesystem::path folder_;
  std::vector<std::filesystem::path> inputs_;
  std::set<std::filesystem::path> known_; // inputs, and what was compared
};

} // namespace rung::test
