// Reads every #include of engine, ui and editor; and, on planted trees, checks that a violation would be
// seen.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <regex>
#include <sstream>

#include "engine/base/file.h"
#include "tests/layering/include_rules.h"

namespace acentric {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* kOrder =
    "add_subdirectory(base)  # 0\nadd_subdirectory(image)  # 1\nadd_subdirectory(view) # 3\n";

/// A source tree of the test's own, removed with it.
class PlantedTree : public testing::Test {
 protected:
  void SetUp() override {
    root_ = fs::path(testing::TempDir()) / ("layering-" + std::to_string(getpid()) + "-" +
                                            testing::UnitTest::GetInstance()->current_test_info()->name());
    plant("engine/CMakeLists.txt", kOrder);
    for (const char* top : {"ui", "editor"}) fs::create_directories(root_ / top);
  }
  void TearDown() override { fs::remove_all(root_); }

  void plant(const std::string& path, const std::string& text) {
    fs::create_directories((root_ / path).parent_path());
    ASSERT_TRUE(writeTextAtomically(root_ / path, text).has_value());
  }
  std::vector<std::string> violations() {
    const auto includes = scanIncludes(root_);
    const auto order = readEngineOrder(root_);
    EXPECT_TRUE(includes.has_value() && order.has_value());
    return includes && order ? findViolations(root_, *includes, *order)
                             : std::vector<std::string>{"unreadable"};
  }
  fs::path root_;
};

/// Calls that read or write JSON text without engine/base/json_text.h, each with its file and line.
std::string jsonCallsBesideTheHelper(const fs::path& root) {
  static const std::regex pattern(R"(([Jj]son|json_)::parse\(|\.dump\()");
  std::string found;
  for (const char* top : {"engine", "ui", "editor"})
    for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
      const fs::path& file = entry.path();
      if ((file.extension() != ".cpp" && file.extension() != ".h") || file.stem() == "json_text") continue;
      std::istringstream lines(readText(file).value_or(""));
      int number = 0;
      for (std::string line; std::getline(lines, line);)
        if (++number; std::regex_search(line, pattern))
          found += fmt::format("{}:{}: {}\n", file.lexically_relative(root).string(), number, line);
    }
  return found;
}

TEST(Layering, JsonIsReadAndWrittenByOneHelperAlone) {
  EXPECT_EQ(jsonCallsBesideTheHelper(ACENTRIC_SOURCE_FOLDER), "");
}

TEST_F(PlantedTree, JsonThatIsReadWithoutTheHelperIsSeen) {
  plant("engine/base/json_text.h", "return json.dump(2);");
  EXPECT_EQ(jsonCallsBesideTheHelper(root_), "");
  plant("engine/view/note.cpp", "x();\nauto note = nlohmann::json::parse(text);");
  plant("editor/note.cpp", "write(note.dump());");
  EXPECT_EQ(jsonCallsBesideTheHelper(root_),
            "engine/view/note.cpp:2: auto note = nlohmann::json::parse(text);\n"
            "editor/note.cpp:1: write(note.dump());\n");
}

TEST(Layering, EveryIncludeOfTheProjectKeepsTheLayers) {
  const fs::path root = ACENTRIC_SOURCE_FOLDER;
  const auto order = readEngineOrder(root);
  ASSERT_TRUE(order.has_value()) << order.error().describe();
  const auto includes = scanIncludes(root);
  ASSERT_TRUE(includes.has_value()) << includes.error().describe();
  EXPECT_GT(includes->size(), 100u) << "the scan found hardly any include: it does not see the sources";
  std::string list;
  for (const std::string& violation : findViolations(root, *includes, *order)) list += violation + "\n";
  EXPECT_EQ(list, "");
}

TEST(Layering, EveryFolderOfTheEngineHasItsLevel) {
  const fs::path root = ACENTRIC_SOURCE_FOLDER;
  const auto order = readEngineOrder(root);
  ASSERT_TRUE(order.has_value()) << order.error().describe();
  for (const auto& entry : fs::directory_iterator(root / "engine")) {
    if (!entry.is_directory()) continue;
    const std::string name = entry.path().filename().string();
    EXPECT_TRUE(std::ranges::any_of(*order, [&](const EngineFolder& f) { return f.name == name; }))
        << "engine/" << name << " is missing in engine/CMakeLists.txt";
  }
}

TEST_F(PlantedTree, SoundIncludesPass) {
  plant("engine/base/a.h", "#include <vector>\n");
  plant("engine/view/b.cpp",
        "#include \"engine/base/a.h\"\n#include \"engine/view/b.h\"\n#include <glm/glm.hpp>\n");
  plant("engine/image/files/c.cpp", "#include <OpenImageIO/imageio.h>\n");
  plant("editor/panels/d.cpp",
        "#include <imgui.h>\n#include \"ui/window.h\"\n#include \"engine/view/b.h\"\n");
  plant("engine/base/e.cpp", "// #include \"ui/window.h\" is only talk\n");
  EXPECT_THAT(violations(), IsEmpty());
}

TEST_F(PlantedTree, AnIncludeThatPointsUpIsSeenWithFileAndLine) {
  plant("engine/image/a.cpp", "#include <vector>\n\n  #  include \"engine/view/b.h\"\n");
  EXPECT_THAT(violations(),
              ElementsAre(HasSubstr("engine/image/a.cpp:3: includes engine/view/b.h: image (level 1)")));
}

TEST_F(PlantedTree, TheEngineKnowsNeitherUiNorEditorAndUiKnowsNeither) {
  plant("engine/view/a.cpp", "#include \"ui/window.h\"\n#include \"editor/app.h\"\n");
  plant("ui/b.cpp", "#include \"engine/base/result.h\"\n#include \"editor/app.h\"\n");
  EXPECT_EQ(violations().size(), 4u);
}

TEST_F(PlantedTree, ALibraryAwayFromHomeIsSeen) {
  const std::map<std::string, std::string> strays{{"engine/base/a.cpp", "<OpenImageIO/imageio.h>"},
                                                  {"engine/image/b.cpp", "<OpenEXR/ImfHeader.h>"},
                                                  {"engine/view/c.cpp", "<embree3/rtcore.h>"},
                                                  {"engine/image/o.cpp", "<cairo.h>"},
                                                  {"engine/view/d.cpp", "<CGAL/Epick.h>"},
                                                  {"engine/view/e.cpp", "<tiny_gltf.h>"},
                                                  {"engine/view/f.cpp", "<assimp/scene.h>"},
                                                  {"engine/view/g.cpp", "<epoxy/gl.h>"},
                                                  {"editor/session/h.cpp", "<imgui.h>"},
                                                  {"editor/session/p.cpp", "<httplib.h>"},
                                                  {"editor/panels/i.cpp", "<GLFW/glfw3.h>"},
                                                  {"engine/view/j.cpp", "<tbb/parallel_for.h>"},
                                                  {"engine/view/k.cpp", "<zstd.h>"},
                                                  {"engine/view/l.cpp", "<OpenMesh/Core/IO/MeshIO.hh>"},
                                                  {"editor/tools/m.cpp", "<backends/imgui_impl_glfw.h>"},
                                                  {"engine/view/n.cpp", "<gtest/gtest.h>"}};
  for (const auto& [file, header] : strays) plant(file, "#include " + header + "\n");
  const auto found = violations();
  EXPECT_EQ(found.size(), strays.size());
  for (const auto& [file, header] : strays)
    EXPECT_TRUE(std::ranges::any_of(found, [&](const std::string& v) { return v.starts_with(file + ":1:"); }))
        << file;
}

TEST_F(PlantedTree, AnIncludeRelativeToItsFileIsSeen) {
  plant("engine/base/a.h", "");
  plant("engine/base/a.cpp", "#include \"a.h\"\n");
  EXPECT_THAT(violations(), ElementsAre(HasSubstr("written from the root")));
}

TEST_F(PlantedTree, AnOrderWithoutLevelsOrOutOfOrderIsRefused) {
  plant("engine/CMakeLists.txt", "add_subdirectory(base)\n");
  EXPECT_FALSE(readEngineOrder(root_).has_value());
  plant("engine/CMakeLists.txt", "add_subdirectory(view) # 3\nadd_subdirectory(base) # 0\n");
  EXPECT_FALSE(readEngineOrder(root_).has_value());
}

}  // namespace
}  // namespace acentric
