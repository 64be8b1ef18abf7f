/// Every scene under inputs/ is read, and its effective scene reads back the same.

#include <algorithm>
#include <cctype>

#include "scene_folder.hpp"

namespace mpm::scene {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> shipped_scenes()
{
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(MPM_INPUTS_DIR))
    if (entry.path().extension() == ".yaml" &&
        entry.path().stem().extension() != ".anatomy" &&     // for the wood generator
        entry.path().parent_path().filename() != "studies")  // for mpm_study
      files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

class ShippedScene : public testing::TestWithParam<fs::path> {};

TEST_P(ShippedScene, IsReadAndItsEffectiveSceneReadsBackTheSame)
{
  const Scene scene = read_scene(GetParam());
  const fs::path folder = fs::temp_directory_path() / ("shipped_" + std::to_string(getpid()));
  fs::create_directories(folder);
  std::ofstream written(folder / "effective.yaml");
  write_effective_scene(written, scene);
  written.close();
  Scene again = read_scene(folder / "effective.yaml");
  fs::remove_all(folder);
  again.file = scene.file;
  EXPECT_TRUE(again == scene);
}

INSTANTIATE_TEST_SUITE_P(Inputs, ShippedScene, testing::ValuesIn(shipped_scenes()),
                         [](const testing::TestParamInfo<fs::path>& scene) {
                           std::string name = scene.param.parent_path().filename().string() + "_" +
                                              scene.param.stem().string();
                           std::ranges::replace_if(
                               name, [](char c) { return std::isalnum(c) == 0; }, '_');
                           return name;
                         });

}  // namespace
}  // namespace mpm::scene
