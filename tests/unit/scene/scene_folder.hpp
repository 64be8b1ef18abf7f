#pragma once
/// A folder of its own for each test, with a picture in it, and the problems of a scene as text.

#include <mpm/core/error.hpp>
#include <mpm/scene/reader.hpp>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

namespace mpm::scene {

class SceneFolder : public testing::Test {
 protected:
  SceneFolder()
  {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              ("scene_" + std::to_string(getpid()) + "_" + test->name());
    std::filesystem::create_directories(folder_);
    write("wood.png", "only its existence is checked here");
  }
  ~SceneFolder() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path write(const std::string& name, const std::string& text) const
  {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }
  Scene read(const std::string& text, const std::vector<std::string>& overrides = {}) const
  {
    return read_scene(write("a.yaml", text), overrides);
  }
  /// One line per problem, without the folder.
  std::vector<std::string> problems(const std::string& text,
                                    const std::vector<std::string>& overrides = {}) const
  {
    return problems_of(write("a.yaml", text), overrides);
  }
  std::vector<std::string> problems_of(const std::filesystem::path& file,
                                       const std::vector<std::string>& overrides = {}) const
  {
    try {
      read_scene(file, overrides);
    } catch (const InputError& error) {
      std::vector<std::string> lines = error.problems();
      const std::string prefix = folder_.string() + "/";
      for (std::string& line : lines) {
        for (auto at = line.find(prefix); at != std::string::npos; at = line.find(prefix))
          line.erase(at, prefix.size());
      }
      return lines;
    }
    return {};
  }

  std::filesystem::path folder_;
};

/// A micrograph scene that is complete in six lines; tests add to it.
inline const std::string smallest = R"(specimen:
  micrograph: wood.png
  pixel_size: 2.3 um
loading:
  piston: right
  speed: 10 m/s
)";

}  // namespace mpm::scene
