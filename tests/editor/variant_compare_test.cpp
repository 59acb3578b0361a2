/// Two variants of a project in one walk, without a window.

#include "editor/session/variant_compare.h"

#include "tests/editor/session_fixture.h"

namespace acentric::editor {
namespace {

class VariantCompareTest : public OpenSessionTest {
 protected:
  void SetUp() override {
    OpenSessionTest::SetUp();
    makeCoarse(*session_);
    waitFor([&] { return !session_->working(); });
    ASSERT_TRUE(session_->saveAs(folder_ / "room.acentric.json"));
  }
  void bake() {
    session_->startBake(glm::dvec2(0, 0));
    waitFor([&] { return !session_->working() && session_->captures() && session_->captures()->complete(); });
  }
  VariantRequest request() {
    VariantRequest wanted;
    wanted.now = session_->built();
    const Spawn& start = wanted.now->project.spawn();
    wanted.view.eye = {start.position, wanted.now->layout->eyeZ()};
    wanted.view.yawRadians = start.yawRadians;
    wanted.view.width = 120, wanted.view.height = 80;
    wanted.memoryBytes = std::size_t(1) << 28;
    TaskRunner runner(1);
    const auto walk = loadWalk(*wanted.now, nullptr, runner);
    EXPECT_TRUE(walk);
    auto frame = renderFrame(walk->walk, wanted.view, wanted.now->project.view, runner);
    EXPECT_TRUE(frame);
    wanted.frame = std::make_shared<const Frame>(std::move(*frame));
    return wanted;
  }
};

TEST_F(VariantCompareTest, BothAreComparedWithTheTruthAndKeepTheirCaptures) {
  bake();
  VariantCompare& variants = session_->variants();
  variants.keep(session_->built());
  VariantRequest wanted = request();
  const std::shared_ptr<const Frame> before = wanted.frame;
  const auto follow = [&](const auto& there) {
    waitFor([&] {
      variants.follow(wanted);
      return there() || !variants.problem().empty();
    });
    EXPECT_EQ(variants.problem(), "");
  };
  follow([&] { return variants.figures() != nullptr; });
  EXPECT_EQ(variants.frame()->colour.pixels, before->colour.pixels) << "the project against itself";
  EXPECT_EQ(variants.figures()->kept.psnr, variants.figures()->now.psnr);

  BakeSettings finer = session_->project().bake;
  finer.samplesPerDegree = 4;
  session_->apply(setBakeSettings(session_->project(), finer, "finer"));
  waitFor([&] { return !session_->working(); });
  bake();
  wanted = request();
  follow([&] { return variants.figures() && variants.figures()->now.psnr != variants.figures()->kept.psnr; });
  EXPECT_EQ(variants.frame()->colour.pixels, before->colour.pixels) << "as it was kept";
  EXPECT_GT(variants.figures()->now.psnr, variants.figures()->kept.psnr + 1);
  EXPECT_EQ(variants.figures()->keptBytes.size(), variants.kept()->layout->cameras.size());
  EXPECT_GT(*std::ranges::max_element(variants.figures()->keptBytes), 0U);

  variants.follow(std::nullopt);
  EXPECT_EQ(variants.frame(), nullptr) << "the eye moves";
  EXPECT_EQ(variants.figures(), nullptr);
}

TEST_F(VariantCompareTest, SaysWhyTheKeptOneHasNoPicture) {
  VariantCompare& variants = session_->variants();
  variants.keep(session_->built());
  bake();
  VariantRequest wanted = request();
  fs::remove_all(folder_ / "room.captures");
  const auto told = [&](const std::string& text) {
    waitFor([&] {
      variants.follow(wanted);
      return !variants.problem().empty() || variants.frame();
    });
    EXPECT_NE(variants.problem().find(text), std::string::npos) << variants.problem();
  };
  told("not on disk");
  wanted.view.eye.x += 50;
  told("has no cell where the eye is");
}

}  // namespace
}  // namespace acentric::editor
