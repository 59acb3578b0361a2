#include "engine/view/view_cameras.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/view/capture_fixtures.h"

namespace acentric {
namespace {

TEST(ViewCameras, AreThoseThatThePlanOfTheViewDrawsOrMisses) {
  for (const Configuration configuration : {Configuration::b, Configuration::c, Configuration::e}) {
    const auto layout = test::layoutAroundOrigin(configuration);
    test::RandomViews views(7);
    for (int n = 0; n < 30; ++n) {
      const int region = n % int(layout->regions.size());
      const PerspectiveView view = views.next(*layout, region, n % 2 == 0 ? 60 : 110);
      ViewSettings settings = test::plainSettings();
      settings.secondaryCover = n % 3 == 0;
      const ViewCameras needed = camerasOf(*layout, view, settings);
      EXPECT_EQ(needed.region, region);
      WalkScene empty;
      empty.layout = layout;
      empty.captures.resize(layout->cameras.size());
      const auto plan = planView(empty, view, settings);
      ASSERT_TRUE(plan);
      EXPECT_EQ(plan->missingImages, int(needed.cameras.size()));
    }
  }
}

TEST(ViewCameras, OfAnEyeOutsideAllRegionsAreNone) {
  const auto layout = test::layoutAroundOrigin(Configuration::b);
  PerspectiveView view;
  view.eye = {1000, 0, 1.6};
  const ViewCameras needed = camerasOf(*layout, view, {});
  EXPECT_EQ(needed.region, -1);
  EXPECT_TRUE(needed.cameras.empty());
}

}  // namespace
}  // namespace acentric
