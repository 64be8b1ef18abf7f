// Contact between bodies, and walls that push: what a scene may say of them.
#include "scene_folder.hpp"
#include <gmock/gmock.h>

namespace mpm::scene {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class ContactInScenes : public SceneFolder {
 protected:
  static std::string with(const std::string& contact, const std::string& numerics = "{}")
  {
    return R"(materials:
  - {name: block, law: isotropic, youngs_modulus: 1 GPa, poisson_ratio: 0.3, density: 1 g/cm^3}
  - {name: floor, law: isotropic, youngs_modulus: 1 GPa, poisson_ratio: 0.3, density: 1 g/cm^3}
  - {name: die, law: rigid}
specimen:
  size: [1 mm, 1 mm]
  shapes: [{box: {lower: [0 mm, 0 mm], upper: [1 mm, 1 mm]}, material: block}]
free_motion: {end_time: 1 us}
numerics: )" +
           numerics + "\ncontact: " + contact + "\n";
  }
};

TEST_F(ContactInScenes, NamesTwoBodiesAndTheirFriction)
{
  const Scene scene = read(with("[{between: [block, floor], friction: 0.3}]"));
  ASSERT_EQ(scene.contacts.size(), 1);
  EXPECT_THAT(scene.contacts[0].between, ElementsAre("block", "floor"));
  EXPECT_EQ(scene.contacts[0].friction, 0.3);
  EXPECT_EQ(read(with("[{between: [floor, block]}]")).contacts[0].friction, 0);
}

TEST_F(ContactInScenes, IsBetweenTwoDifferentBodiesThatCanBeDeformed)
{
  EXPECT_THAT(problems(with("[{between: [block]}]")),
              ElementsAre("a.yaml:10:21: contact[0].between is ['block'] (contact is between two "
                          "bodies). Name two materials."));
  EXPECT_THAT(problems(with("[{between: [block, flor]}]")),
              ElementsAre("a.yaml:10:29: contact[0].between[1] is 'flor' (no material has this "
                          "name). Use block, floor or die."));
  EXPECT_THAT(problems(with("[{between: [die, floor]}]")),
              ElementsAre("a.yaml:10:22: contact[0].between[0] is 'die' (it is rigid: all bodies "
                          "stick to it). Give it a law that can be deformed, or use formulation: "
                          "total_lagrangian."));
  const std::string cells = "{formulation: total_lagrangian}";
  EXPECT_THAT(problems(with("[{between: [die, floor]}]", cells)), IsEmpty());
  EXPECT_THAT(problems(with("[{between: [die, die]}]", cells)),
              ElementsAre("a.yaml:10:27: contact[0].between[1] is 'die' (rigid bodies do not meet "
                          "each other). Name a body that can be deformed."));
  EXPECT_THAT(
      problems(with("[{between: [floor, floor]}]")),
      ElementsAre(
          "a.yaml:10:29: contact[0].between[1] is 'floor' (a body moves in one velocity field and "
          "cannot touch itself). Name another material, or use formulation: total_lagrangian."));
  EXPECT_THAT(problems(with("[{between: [block, floor]}, {between: [floor, block]}]")),
              ElementsAre("a.yaml:10:48: contact[1].between is ['floor', 'block'] (contact[0] is "
                          "between the same). Remove one."));
}

TEST_F(ContactInScenes, DoesNotGoWithMethodsThatWouldUndoIt)
{
  EXPECT_THAT(problems(with("[{between: [block, floor]}]", "{scheme: fmpm}")),
              ElementsAre("a.yaml:9:20: numerics.scheme is 'fmpm' (refined velocities would go "
                          "through the contact again). Use scheme: flip."));
  EXPECT_THAT(problems(with("[{between: [block, floor]}]", "{update_order: usf}")),
              ElementsAre("a.yaml:9:26: numerics.update_order is 'usf' (stress would see "
                          "velocities before contact acts). Use update_order: musl."));
}

TEST_F(ContactInScenes, IsOfABodyWithItselfTooWhereCellsMeet)
{
  const Scene scene =
      read(with("[{between: [floor, floor], friction: 0.2}]", "{formulation: total_lagrangian}"));
  EXPECT_EQ(scene.contacts[0].friction, 0.2);
  EXPECT_THAT(problems(with("[{between: [block, floor]}]",
                            "{formulation: total_lagrangian, contact_stiffness: 0}")),
              ElementsAre("a.yaml:9:62: numerics.contact_stiffness is 0 (bodies would go through "
                          "each other). Leave it out."));
}

TEST_F(ContactInScenes, WallsThatPushNeedParticlesThatMoveByTheirStrain)
{
  const std::string pushed = smallest + "  grip: contact\n";
  EXPECT_THAT(problems(pushed + "numerics: {formulation: updated_lagrangian}\n"),
              ElementsAre("a.yaml:8:1: numerics.update_order is missing (what a wall with grip: "
                          "contact pushes must move by the velocities that its strain sees). Add "
                          "update_order: musl_displacement."));
  EXPECT_THAT(
      problems(pushed + "numerics: {update_order: usl}\n"),
      ElementsAre(
          "a.yaml:8:26: numerics.update_order is 'usl' (what a wall with grip: contact pushes must "
          "move by the velocities that its strain sees). Use update_order: musl_displacement."));
  EXPECT_THAT(problems(pushed + "numerics: {update_order: musl_displacement, scheme: xpic}\n"),
              ElementsAre("a.yaml:8:53: numerics.scheme is 'xpic' (a wall with grip: contact does "
                          "not know refined velocities). Use scheme: flip."));
  EXPECT_THAT(problems(pushed), IsEmpty());
}

TEST_F(ContactInScenes, WallsRubOnCellsThatTheyPushOnly)
{
  const std::string rubs = smallest + "  friction: 0.3\n", pushes = rubs + "  grip: contact\n";
  EXPECT_THAT(problems(pushes + "numerics: {formulation: total_lagrangian}\n"), IsEmpty());
  EXPECT_THAT(
      problems(pushes + "numerics: {update_order: musl_displacement}\n"),
      ElementsAre("a.yaml:7:13: loading.friction is 0.3 (particles slide on walls that push "
                  "them). Leave it out, or use formulation: total_lagrangian."));
  EXPECT_THAT(problems(rubs + "numerics: {formulation: total_lagrangian}\n"),
              ElementsAre(HasSubstr("grip: contact")));
}

TEST_F(ContactInScenes, AStiffnessIsOfSomethingThatTouches)
{
  EXPECT_THAT(problems(smallest + "numerics: {scheme: flip, contact_stiffness: 1}\n"),
              ElementsAre("a.yaml:7:45: numerics.contact_stiffness is 1 (nothing is in contact). "
                          "Leave it out, or use grip: contact or formulation: total_lagrangian."));
  EXPECT_THAT(
      problems(
          smallest +
          "  grip: contact\nnumerics: {update_order: musl_displacement, contact_stiffness: 0}\n"),
      ElementsAre("a.yaml:8:64: numerics.contact_stiffness is 0 (walls with grip: contact would "
                  "hold nothing back). Leave it out."));
  EXPECT_EQ(contact_stiffness({}), 0.5);
  Numerics total;
  total.formulation = FormulationKind::total_lagrangian;
  EXPECT_EQ(contact_stiffness(total), 2);
}

}  // namespace
}  // namespace mpm::scene
