#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "ui/directory_listing.h"
#include "ui/image_view.h"
#include "ui/text_format.h"
#include "ui/toasts.h"

namespace acentric::ui {
namespace {

namespace fs = std::filesystem;

TEST(TextFormat, WritesNumbersForPeople) {
  EXPECT_EQ(formatCount(0), "0");
  EXPECT_EQ(formatCount(999), "999");
  EXPECT_EQ(formatCount(1021813), "1,021,813");
  EXPECT_EQ(formatBytes(512), "512 B");
  EXPECT_EQ(formatBytes(1400000000), "1.4 GB");
  EXPECT_EQ(formatBytes(999999), "1.0 MB");
  EXPECT_EQ(formatDuration(4.04), "4.0 s");
  EXPECT_EQ(formatDuration(200), "3 min 20 s");
  EXPECT_EQ(formatDuration(3900), "1 h 05 min");
  EXPECT_EQ(formatDuration(-1), "unknown");
  EXPECT_EQ(formatArea(8.64), "8.6 m²");
  EXPECT_EQ(formatArea(1492.3), "1,492 m²");
  EXPECT_EQ(formatArea(3978600), "3.98 km²");
  EXPECT_EQ(formatMetres(0.005), "5 mm");
  EXPECT_EQ(formatMetres(0.25), "25 cm");
  EXPECT_EQ(formatMetres(1.5), "1.5 m");
  EXPECT_EQ(formatMetres(2000), "2 km");
  EXPECT_EQ(formatPercent(0.0042), "0.42 %");
  EXPECT_EQ(formatPercent(0.12), "12 %");
}

TEST(TextFormat, ShowsDigitsOfSmallNumbers) {
  EXPECT_EQ(withDigits("%.2f m", 1.6), "%.2f m");
  EXPECT_EQ(withDigits("%.2f m", 0.12), "%.2f m");
  EXPECT_EQ(withDigits("%.2f m", 0.05), "%.3f m");
  EXPECT_EQ(withDigits("%.2f m", -0.0004), "%.5f m");
  EXPECT_EQ(withDigits("%.2f m", 1e-12), "%.6f m");
  EXPECT_EQ(withDigits("%.2f m", 0), "%.2f m");
  EXPECT_EQ(withDigits("%d samples", 0.001), "%d samples");
}

TEST(TextFormat, ShortensPathsInTheMiddleWithoutCuttingCharacters) {
  const std::string path = "/home/someone/models/äöü/a very long folder/gallery.acentric.json";
  EXPECT_EQ(shortenPath(path, 200), path);
  for (std::size_t length = 10; length < path.size(); ++length) {
    const std::string cut = shortenPath(path, length);
    EXPECT_TRUE(cut.ends_with("json"));
    EXPECT_NE(cut.find("…"), std::string::npos);
    // No stray continuation byte right behind the ellipsis (3 bytes long).
    const std::size_t behind = cut.find("…") + 3;
    EXPECT_NE(static_cast<unsigned char>(cut[behind]) & 0xc0U, 0x80U);
  }
}

TEST(FitImage, KeepsTheAspectAndCentres) {
  const FittedImage wide = fitImage({10, 20}, {800, 600}, 16.0 / 9);
  EXPECT_DOUBLE_EQ(wide.size.x, 800);
  EXPECT_DOUBLE_EQ(wide.size.y, 450);
  EXPECT_DOUBLE_EQ(wide.min.y, 20 + 75);
  const FittedImage tall = fitImage({0, 0}, {800, 600}, 0.5);
  EXPECT_DOUBLE_EQ(tall.size.x, 300);
  EXPECT_DOUBLE_EQ(tall.min.x, 250);
}

class DirectoryListingTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("acentric_listing_" + std::to_string(::getpid()));
    fs::create_directories(folder_ / "zoo");
    fs::create_directories(folder_ / "Attic");
    fs::create_directories(folder_ / ".hidden");
    for (const char* name : {"b.GLB", "a.obj", "readme.txt", ".secret.glb"})
      std::ofstream(folder_ / name) << "1234";
    fs::create_symlink(folder_ / "nowhere", folder_ / "broken.glb");
  }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path folder_;
};

TEST_F(DirectoryListingTest, ShowsFoldersFirstAndOnlyWhatCanBeOpened) {
  const DirectoryListing listing = listDirectory(folder_, {".glb", ".obj"});
  EXPECT_TRUE(listing.problem.empty());
  std::vector<std::string> names;
  for (const auto& entry : listing.entries) names.push_back(entry.name);
  EXPECT_EQ(names, (std::vector<std::string>{"Attic", "zoo", "a.obj", "b.GLB", "broken.glb"}));
  EXPECT_EQ(listing.entries[2].bytes, 4U);
}

TEST_F(DirectoryListingTest, SaysWhyAFolderCannotBeRead) {
  const DirectoryListing listing = listDirectory(folder_ / "missing", {});
  EXPECT_TRUE(listing.entries.empty());
  EXPECT_NE(listing.problem.find("missing"), std::string::npos);
}

TEST(Toasts, GoAwayByThemselvesButErrorsStay) {
  Toasts toasts;
  toasts.post(Tone::info, "saved", 10);
  toasts.post(Tone::danger, "disk full", 10);
  EXPECT_EQ(toasts.nextChange(), 10 + Toasts::kSeconds);
  toasts.expire(10 + Toasts::kSeconds);
  EXPECT_EQ(toasts.count(), 1U);
  EXPECT_FALSE(toasts.nextChange().has_value());
}

TEST(Toasts, TheSameMessageIsShownOnce) {
  Toasts toasts;
  toasts.post(Tone::info, "saved", 10);
  toasts.post(Tone::info, "saved", 12);
  EXPECT_EQ(toasts.count(), 1U);
  EXPECT_EQ(toasts.nextChange(), 12 + Toasts::kSeconds);
  for (int i = 0; i < 20; ++i) toasts.post(Tone::info, std::to_string(i), 12);
  EXPECT_EQ(toasts.count(), Toasts::kMost);
}

}  // namespace
}  // namespace acentric::ui
