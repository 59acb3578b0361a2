/// What is baked as OpenEXR: every capture, bit for bit but for its silhouettes, in a file that says where it
/// belongs.

#include "engine/pipeline/export_exr.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "engine/base/file.h"
#include "engine/store/capture_store.h"
#include "tests/pipeline/small_project.h"
#include "tests/store/temporary_folder.h"

namespace acentric {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class ExportExr : public FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    test::SceneBuilder builder;
    builder.box(builder.material(test::matte()), {-4, -4, 0}, {4, 4, 3}, true).point({0, 0, 2.5F}, 50);
    Project project = test::smallProject(0.5, 1);
    project.bake.ambientRays = 0;
    open_ = test::openWith(builder.rays(), project, folder_ / "room.acentric.json");
  }
  void bake(const BakeRequest& request = {}) {
    TaskRunner runner(1);
    ASSERT_TRUE(bakeProject(open_, request, runner));
  }
  Result<ExportExrReport> write(const ExportExrOptions& options = {}) const {
    TaskRunner runner(1);
    return exportExr({&open_, 1}, folder_ / "exr", options, runner);
  }
  nlohmann::json captures() const {
    const auto index = nlohmann::json::parse(readText(folder_ / "exr" / kExrIndex, 1 << 20).value());
    return index.at("storeys").at(0).at("captures");
  }
  OpenProject open_;
};

TEST_F(ExportExr, HoldsEveryCaptureAsItIsInTheStore) {
  bake();
  const auto report = write();
  ASSERT_TRUE(report) << report.error().describe();
  EXPECT_EQ(report->files, open_.keys.size());
  EXPECT_EQ(report->missing, 0u);
  const auto store = openCaptures(open_.file);
  ASSERT_TRUE(store);
  const auto listed = captures();
  ASSERT_EQ(listed.size(), open_.keys.size());
  std::uint64_t bytes = 0;
  for (std::size_t camera = 0; camera < open_.keys.size(); ++camera) {
    const fs::path file = folder_ / "exr" / listed[camera].at("file").get<std::string>();
    EXPECT_EQ(file.filename(), fmt::format("0-{:05}.exr", camera));
    EXPECT_EQ(listed[camera].at("bytes"), fs::file_size(file));
    bytes += fs::file_size(file);
    const auto stored = store->get(open_.keys[camera]);
    ASSERT_TRUE(stored);
    const fs::path alone = folder_ / "one.exr";
    ASSERT_TRUE(writeCaptureExr(*stored, open_.keys[camera], alone));
    EXPECT_EQ(*readFile(file), *readFile(alone));
    EXPECT_EQ(listed[camera].at("samples"), stored->sampleCount());
    EXPECT_EQ(listed[camera].at("columns"), stored->camera.columns);
  }
  EXPECT_EQ(report->bytes, bytes);
}

TEST_F(ExportExr, RefusesWhatIsNotBakedUnlessAllowed) {
  BakeRequest one;
  one.cameras = std::vector{0};
  bake(one);
  const auto refused = write();
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("not baked yet: run `acentric bake"));
  EXPECT_FALSE(fs::exists(folder_ / "exr"));
  ExportExrOptions options;
  options.allowMissing = true;
  const auto allowed = write(options);
  ASSERT_TRUE(allowed);
  EXPECT_EQ(allowed->files, 1u);
  EXPECT_EQ(allowed->missing, open_.keys.size() - 1);
  EXPECT_EQ(captures().size(), 1u);
}

TEST_F(ExportExr, ReplacesAnEarlierOneAndNothingElse) {
  bake();
  ASSERT_TRUE(write());
  std::ofstream(folder_ / "exr" / "captures" / "left.exr") << "by an earlier layout";
  ASSERT_TRUE(write());
  EXPECT_FALSE(fs::exists(folder_ / "exr" / "captures" / "left.exr"));
  fs::remove(folder_ / "exr" / kExrIndex);
  EXPECT_FALSE(write()) << "now it is any folder";
}

}  // namespace
}  // namespace acentric
