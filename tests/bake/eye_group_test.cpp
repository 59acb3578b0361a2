#include "engine/bake/eye_group.h"

#include <gtest/gtest.h>

#include <random>

#include "engine/geometry/conventions.h"
#include "tests/bake/scene_builder.h"

namespace acentric {
namespace {

constexpr ElevationRange kMiddle{-kPi / 3, kPi / 3};

/// A room with boxes, and eyes in it; the last has no map.
class EyeGroupTest : public testing::Test {
 protected:
  void SetUp() override {
    test::SceneBuilder builder;
    const int white = builder.material(test::matte());
    builder.box(white, {-6, -5, 0}, {6, 5, 3}, true);
    std::uniform_real_distribution<float> place(-4, 4), size(0.05f, 0.5f);
    for (int n = 0; n < 25; ++n) {
      const glm::vec3 at(place(random_), place(random_), 1.5f + 0.3f * place(random_));
      builder.box(white, at - size(random_), at + size(random_));
    }
    const auto scene = builder.rays();
    TaskRunner runner;
    RayCounts rays;
    for (int n = 0; n < 9; ++n)
      eyes_.push_back(EyeView::trace(*scene, {0.4 * n - 1.7, 0.2 * n - 1.1, 1.4 + 0.05 * n}, 90, kMiddle,
                                     runner, rays, {}));
    eyes_.push_back(EyeView::untraced({1, 1, 1.6}));
  }
  std::mt19937 random_{11};
  std::vector<std::shared_ptr<const EyeView>> eyes_;
};

TEST_F(EyeGroupTest, TellsWhatTheMapsOfItsEyesShowHidden) {
  const EyeGroup group(eyes_);
  EXPECT_FALSE(group.isUntraced());
  std::uniform_real_distribution<double> x(-7, 7), y(-6, 6), z(-0.5, 3.5);
  std::vector<std::uint8_t> hidden;
  int told = 0, known = 0;
  for (int n = 0; n < 5000; ++n) {
    const glm::dvec3 point(x(random_), y(random_), z(random_));
    group.findHidden(point, hidden);
    ASSERT_GE(hidden.size(), eyes_.size());
    for (std::size_t e = 0; e < eyes_.size(); ++e) {
      const EyeView::Sees sees = eyes_[e]->looksAt(point);
      EXPECT_TRUE(hidden[e] == 0 || sees == EyeView::Sees::no) << "point " << n << ", eye " << e;
      told += hidden[e], known += sees == EyeView::Sees::no ? 1 : 0;
    }
  }
  EXPECT_GT(known, 10000);
  EXPECT_GT(told, known * 97 / 100) << "rounding keeps back few";
}

TEST_F(EyeGroupTest, TellsNothingOfThePlaceOfAnEyeAndWhereNobodyLooked) {
  const EyeGroup group(eyes_);
  std::vector<std::uint8_t> hidden;
  group.findHidden(eyes_[0]->eye(), hidden);
  EXPECT_EQ(hidden[0], 0);
  group.findHidden(eyes_[0]->eye() + glm::dvec3(0.1, 0.1, 40), hidden);
  for (const std::uint8_t one : hidden) EXPECT_EQ(one, 0);
}

TEST_F(EyeGroupTest, MayHaveNoMaps) {
  EXPECT_TRUE(EyeGroup({eyes_.back()}).isUntraced());
  EXPECT_TRUE(EyeGroup(std::vector<std::shared_ptr<const EyeView>>()).isUntraced());
}

}  // namespace
}  // namespace acentric
