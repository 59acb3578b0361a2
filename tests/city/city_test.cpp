#include "projects/city/generator/city.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "projects/city/generator/town.h"

namespace acentric::city {
namespace {

std::size_t trianglesOf(const gallery::Model& model) {
  std::size_t count = 0;
  for (const gallery::Thing& thing : model.things) {
    const std::size_t times = std::max<std::size_t>(thing.placements.size(), 1);
    for (const gallery::Part& part : thing.parts) count += times * part.shape.indices.size() / 3;
  }
  return count;
}

TEST(City, HasAboutTheTrianglesAskedFor) {
  for (const std::size_t wanted : {100'000, 300'000, 1'000'000, 4'000'000, 10'000'000, 20'000'000})
    EXPECT_NEAR(double(trianglesOf(makeCity(wanted))), double(wanted), 0.1 * double(wanted)) << wanted;
}

TEST(City, HasTheSameStreetsWhateverItsTriangles) {
  const gallery::Model coarse = makeCity(100'000), fine = makeCity(2'000'000);
  ASSERT_EQ(coarse.things.size(), fine.things.size());
  for (std::size_t t = 0; t + 1 < fine.things.size(); ++t)  // all but the windows
    for (std::size_t p = 0; p < fine.things[t].parts.size(); ++p)
      EXPECT_EQ(coarse.things[t].parts[p].shape.positions, fine.things[t].parts[p].shape.positions);
  for (const gallery::Model* model : {&coarse, &fine})
    for (const gallery::Thing& thing : model->things)
      for (const gallery::Part& part : thing.parts)
        for (const glm::vec3& p : part.shape.positions)
          if (p.z > 0.1f && thing.placements.empty()) {
            EXPECT_GE(std::max(std::abs(p.x), std::abs(p.y)), 6.0f)
                << "something stands on the middle crossing";
          }
}

TEST(Town, IsFlatLargeAndAlwaysTheSame) {
  const gallery::Model town = makeTown(), again = makeTown();
  EXPECT_NEAR(double(trianglesOf(town)), 30'000, 3'000);
  glm::vec3 low(1e9f), high(-1e9f);
  ASSERT_EQ(town.things.size(), again.things.size());
  for (std::size_t t = 0; t < town.things.size(); ++t)
    for (std::size_t p = 0; p < town.things[t].parts.size(); ++p) {
      const gallery::Shape& shape = town.things[t].parts[p].shape;
      EXPECT_EQ(shape.positions, again.things[t].parts[p].shape.positions);
      for (const glm::vec3& position : shape.positions)
        low = glm::min(low, position), high = glm::max(high, position);
    }
  EXPECT_EQ(glm::vec2(low), glm::vec2(-1000));
  EXPECT_EQ(glm::vec2(high), glm::vec2(1000));
  EXPECT_EQ(low.z, 0);
}

}  // namespace
}  // namespace acentric::city
