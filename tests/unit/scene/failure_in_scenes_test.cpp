// Where cells fail: what a scene may say of it.
#include "scene_folder.hpp"
#include <gmock/gmock.h>

namespace mpm::scene {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class FailureInScenes : public SceneFolder {
 protected:
  static std::string with(const std::string& failure, const std::string& law = flows,
                          const std::string& numerics = "{formulation: total_lagrangian}")
  {
    return smallest + "numerics: " + numerics + "\nmaterial:\n  failure: " + failure + "\n  " +
           law + "\n  youngs_modulus: 1 GPa\n  poisson_ratio: 0.3\n  density: 1 g/cm^3\n";
  }
  static inline const std::string flows = "law: von_mises\n  yield_stress: 10 MPa";
};

TEST_F(FailureInScenes, IsAtEitherLimitOrBoth)
{
  const Scene both = read(with("{plastic_strain: 1.5, stretch: 4}"));
  ASSERT_TRUE(both.materials[0].failure.has_value());
  EXPECT_EQ(both.materials[0].failure->plastic_strain, 1.5);
  EXPECT_EQ(both.materials[0].failure->stretch, 4);
  const Scene one = read(with("{stretch: 1.2}", "law: neo_hookean"));
  EXPECT_FALSE(one.materials[0].failure->plastic_strain.has_value());
  EXPECT_FALSE(read(smallest).materials.at(0).failure.has_value());
}

TEST_F(FailureInScenes, IsOfCellsAlone)
{
  EXPECT_THAT(problems(with("{stretch: 4}", flows, "{scheme: flip}")),
              ElementsAre("a.yaml:9:3: material.failure is a map (only cells of "
                          "total_lagrangian fail). Leave it out, or set numerics.formulation: "
                          "total_lagrangian."));
}

TEST_F(FailureInScenes, OfPlasticStrainNeedsALawThatFlows)
{
  EXPECT_THAT(problems(with("{plastic_strain: 1.5}", "law: isotropic")),
              ElementsAre("a.yaml:9:29: material.failure.plastic_strain is 1.5 (law isotropic has "
                          "no plastic strain). Use stretch, or a law that flows, such as "
                          "von_mises."));
}

TEST_F(FailureInScenes, NamesALimitThatASoundCellDoesNotReach)
{
  EXPECT_THAT(problems(with("{}")),
              ElementsAre("a.yaml:9:3: material.failure is a map (it sets no limit). Add "
                          "plastic_strain: 1.5 or stretch: 4."));
  EXPECT_THAT(problems(with("{stretch: 1}")),
              ElementsAre(HasSubstr("material.failure.stretch is 1 (must be above 1)")));
  EXPECT_THAT(problems(with("{plastic_strain: 0}")),
              ElementsAre(HasSubstr("material.failure.plastic_strain is 0 (must be above 0)")));
  EXPECT_THAT(problems(with("{strain: 2}")), ElementsAre(HasSubstr("unknown key")));
}

TEST_F(FailureInScenes, IsNotOfRigidBodies)
{
  const std::string scene = R"(materials:
  - {name: block, law: isotropic, youngs_modulus: 1 GPa, poisson_ratio: 0.3, density: 1 g/cm^3}
  - {name: die, law: rigid, failure: {stretch: 4}}
specimen:
  size: [1 mm, 1 mm]
  shapes: [{box: {lower: [0 mm, 0 mm], upper: [1 mm, 1 mm]}, material: block}]
free_motion: {end_time: 1 us}
numerics: {formulation: total_lagrangian}
)";
  EXPECT_THAT(problems(scene), testing::Contains(HasSubstr("(a rigid body bears anything)")));
}

}  // namespace
}  // namespace mpm::scene
