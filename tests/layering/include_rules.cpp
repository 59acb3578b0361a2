#include "tests/layering/include_rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <regex>
#include <set>
#include <sstream>

#include "engine/base/file.h"

namespace acentric {
namespace {

namespace fs = std::filesystem;

/// Headers that begin with one of `prefixes` may be included only by files that begin with one of `homes`.
struct Home {
  std::string library;
  std::vector<std::string> prefixes;
  std::vector<std::string> homes;
};

const std::vector<Home>& homes() {
  static const std::vector<Home> table{
      {"OpenImageIO", {"OpenImageIO/"}, {"engine/image/files/"}},
      {"Cairo", {"cairo"}, {"engine/picture/"}},
      {"libpng", {"png.h"}, {"engine/image/"}},
      {"libwebp", {"webp/"}, {"engine/export/"}},
      {"libavif", {"avif/"}, {"engine/store/"}},
      {"OpenEXR", {"OpenEXR/", "Imath/", "ImfArray", "Imf"}, {"engine/store/"}},
      {"zstd", {"zstd"}, {"engine/store/", "engine/scene/"}},
      {"tinygltf", {"tiny_gltf", "tinygltf"}, {"engine/scene/"}},
      {"assimp", {"assimp/"}, {"engine/scene/"}},
      {"Draco", {"draco/"}, {"engine/scene/"}},
      {"meshoptimizer", {"meshoptimizer"}, {"engine/scene/", "engine/export/"}},
      {"OpenMesh", {"OpenMesh/"}, {"engine/scene/"}},
      {"Embree", {"embree"}, {"engine/bake/"}},
      {"TBB", {"tbb/", "oneapi/tbb"}, {}},  // stays inside Embree
      {"CGAL", {"CGAL/"}, {"engine/geometry/predicates/"}},
      {"xxHash", {"xxhash"}, {"engine/base/"}},
      {"cpp-httplib", {"httplib"}, {"engine/serve/"}},
      {"spdlog", {"spdlog/"}, {"engine/base/"}},
      {"valijson", {"valijson/"}, {"engine/pipeline/"}},
      {"CLI11", {"CLI/"}, {"engine/cli/", "editor/main.cpp"}},
      {"Boost.Locale", {"boost/locale"}, {"ui/"}},
      {"GLFW", {"GLFW/"}, {"ui/"}},
      {"ImGui", {"imgui", "backends/imgui"}, {"ui/", "editor/panels/", "editor/overlays/", "editor/app"}},
      {"OpenGL", {"epoxy/", "GL/", "GLES"}, {"engine/view_gl/", "ui/"}},
      {"EGL", {"EGL/", "epoxy/egl"}, {"engine/view_gl/", "ui/"}},
      {"GoogleTest", {"gtest/", "gmock/", "rapidcheck"}, {}},
  };
  return table;
}

bool startsWithOne(const std::string& text, const std::vector<std::string>& prefixes) {
  return std::ranges::any_of(prefixes, [&](const std::string& prefix) { return text.starts_with(prefix); });
}

/// "engine/base/file.h" -> {"engine", "base"}; the second is empty for files directly in the first.
std::pair<std::string, std::string> folders(const std::string& path) {
  const auto first = path.find('/');
  if (first == std::string::npos) return {"", ""};
  const auto second = path.find('/', first + 1);
  if (second == std::string::npos) return {path.substr(0, first), ""};
  return {path.substr(0, first), path.substr(first + 1, second - first - 1)};
}

/// Empty = allowed.
std::string whyNotOurs(const Include& include, const std::vector<EngineFolder>& order) {
  const auto [fromTop, fromFolder] = folders(include.file);
  const auto [toTop, toFolder] = folders(include.target);
  if (toTop == "projects" || toTop == "tests") return "programs may not include samples or tests";
  if (fromTop == "engine" && toTop != "engine") return fmt::format("the engine does not know {}", toTop);
  if (fromTop == "ui" && toTop != "ui") return fmt::format("ui knows nothing of {}", toTop);
  if (fromTop != "engine" || fromFolder == toFolder) return "";
  const auto place = [&](const std::string& name) {
    return std::ranges::find(order, name, &EngineFolder::name);
  };
  const auto from = place(fromFolder);
  const auto to = place(toFolder);
  if (from == order.end()) return fmt::format("engine/{} is not listed in engine/CMakeLists.txt", fromFolder);
  if (to == order.end()) return fmt::format("engine/{} is not listed in engine/CMakeLists.txt", toFolder);
  if (to < from) return "";
  return fmt::format("{} (level {}) comes before {} (level {}) in engine/CMakeLists.txt", fromFolder,
                     from->level, toFolder, to->level);
}

std::string whyNotTheirs(const Include& include) {
  for (const Home& home : homes())
    if (startsWithOne(include.target, home.prefixes) && !startsWithOne(include.file, home.homes))
      return home.homes.empty()
                 ? fmt::format("{} has no place in these folders", home.library)
                 : fmt::format("{} has its home in {}", home.library, fmt::join(home.homes, ", "));
  return "";
}

}  // namespace

Result<std::vector<Include>> scanIncludes(const fs::path& root) {
  static const std::set<std::string> extensions{".h", ".hpp", ".c", ".cpp", ".cc", ".inl"};
  // Leading white space only: a commented-out include counts for nothing.
  static const std::regex pattern(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"])");
  std::vector<Include> found;
  for (const char* top : {"engine", "ui", "editor"}) {
    std::error_code error;
    std::vector<fs::path> files;
    for (fs::recursive_directory_iterator it(root / top, error), end; !error && it != end;
         it.increment(error))
      if (it->is_regular_file() && extensions.contains(it->path().extension().string()))
        files.push_back(it->path());
    if (error) return fail(ErrorKind::unreadable, error.message(), (root / top).string());
    std::ranges::sort(files);
    for (const fs::path& file : files) {
      const auto text = readText(file);
      if (!text) return tl::unexpected(text.error());
      std::istringstream lines(*text);
      int number = 0;
      for (std::string line; std::getline(lines, line);) {
        ++number;
        std::smatch match;
        if (line.find("include") != std::string::npos && std::regex_search(line, match, pattern))
          found.push_back(
              {file.lexically_relative(root).generic_string(), number, match[2], match[1] == "\""});
      }
    }
  }
  return found;
}

Result<std::vector<EngineFolder>> readEngineOrder(const fs::path& root) {
  static const std::regex pattern(R"(^\s*add_subdirectory\(\s*([A-Za-z0-9_]+)\s*\)\s*(#\s*([0-9]+))?)");
  const fs::path file = root / "engine" / "CMakeLists.txt";
  const auto text = readText(file);
  if (!text) return tl::unexpected(text.error());
  std::vector<EngineFolder> order;
  std::istringstream lines(*text);
  for (std::string line; std::getline(lines, line);) {
    std::smatch match;
    if (!std::regex_search(line, match, pattern)) continue;
    if (!match[3].matched)
      return fail(ErrorKind::malformed, fmt::format("no level after {}", match[1].str()), file.string());
    const EngineFolder folder{match[1], std::stoi(match[3])};
    if (!order.empty() && folder.level < order.back().level)
      return fail(ErrorKind::malformed, fmt::format("{} is below {}", folder.name, order.back().name),
                  file.string());
    order.push_back(folder);
  }
  return order;
}

std::vector<std::string> findViolations(const fs::path& root, const std::vector<Include>& includes,
                                        const std::vector<EngineFolder>& order) {
  static const std::set<std::string> ours{"engine", "ui", "editor", "projects", "tests"};
  std::vector<std::string> violations;
  for (const Include& include : includes) {
    std::string why;
    if (ours.contains(folders(include.target).first))
      why = whyNotOurs(include, order);
    else if (include.quoted && fs::exists((root / include.file).parent_path() / include.target))
      why = "includes of ours are written from the root";
    else
      why = whyNotTheirs(include);
    if (!why.empty())
      violations.push_back(
          fmt::format("{}:{}: includes {}: {}", include.file, include.line, include.target, why));
  }
  return violations;
}

}  // namespace acentric
