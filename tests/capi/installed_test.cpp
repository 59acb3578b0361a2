/// The C library as it is installed: what it needs, what it shows, and the examples built against it.

#include <gtest/gtest.h>

#include <set>
#include <sstream>

#include "engine/base/file.h"
#include "engine/image/image.h"
#include "engine/measure/compare.h"
#include "tests/end_to_end/sample_project.h"

namespace acentric::test {
namespace {

std::set<std::string> namesAfter(const std::string& text, const std::string& mark) {
  std::set<std::string> names;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (const auto at = line.find(mark); at != std::string::npos) {
      const auto open = line.find('[', at), close = line.find(']', at);
      names.insert(line.substr(open + 1, close - open - 1));
    }
  return names;
}

TEST(Library, NeedsNothingThatImportsBakesOrOpensWindows) {
  const auto dynamic = runProcess({"readelf", "-dW", ACENTRIC_RUNTIME_LIBRARY});
  ASSERT_EQ(dynamic.exitCode, 0) << dynamic.errors;
#ifndef ACENTRIC_SANITIZED
  const std::set<std::string> known{"libavif.so.15",  "libfmt.so.9",         "libgmp.so.10",
                                    "libxxhash.so.0", "libzstd.so.1",        "libpng16.so.16",
                                    "libstdc++.so.6", "libm.so.6",           "libgcc_s.so.1",
                                    "libc.so.6",      "ld-linux-x86-64.so.2"};
  for (const std::string& name : namesAfter(dynamic.output, "(NEEDED)"))
    EXPECT_TRUE(known.contains(name)) << name;
#endif
  EXPECT_EQ(namesAfter(dynamic.output, "(SONAME)"), std::set<std::string>{"libacentric_runtime.so.1"});
}

/// Of `nm --defined-only` with an option: functions, and all else that is defined there.
struct Defined {
  std::set<std::string> functions, others;
};
Defined definedIn(const std::string& option, const std::string& library) {
  const auto symbols = runProcess({"nm", option, "--defined-only", library});
  EXPECT_EQ(symbols.exitCode, 0) << symbols.errors;
  std::istringstream lines(symbols.output);
  Defined defined;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    if (std::string address, kind, name; words >> address >> kind >> name)
      (kind == "T" ? defined.functions : defined.others)
          .insert(name.substr(0, name.find("@")));  // no version
  }
  return defined;
}

TEST(Library, ShowsItsFunctionsAndNothingElse) {
  const Defined shared = definedIn("-D", ACENTRIC_RUNTIME_LIBRARY);
  for (const std::string& name : shared.functions) EXPECT_TRUE(name.starts_with("acentric_")) << name;
  EXPECT_GT(shared.functions.size(), 30u);
  EXPECT_EQ(shared.others, std::set<std::string>{"ACENTRIC_RUNTIME_1"});
#ifndef ACENTRIC_SANITIZED
  const Defined within = definedIn("-g", ACENTRIC_STATIC_LIBRARY);
  EXPECT_EQ(within.functions, shared.functions);
  EXPECT_EQ(within.others, std::set<std::string>{});
#endif
}

TEST(Library, HasAHeaderForC99) {
  const auto compiled = runProcess({"cc", "-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Werror",
                                    "-fsyntax-only", "-x", "c", ACENTRIC_RUNTIME_HEADER});
  EXPECT_EQ(compiled.exitCode, 0) << compiled.errors;
}

#ifndef ACENTRIC_SANITIZED

ColourImage ppm(const std::filesystem::path& file) {
  std::istringstream text(readText(file).value_or(""));
  std::string magic;
  int width = 0, height = 0, most = 0;
  text >> magic >> width >> height >> most;
  text.get();
  ColourImage image(width, height, {0, 0, 0, 255});
  for (Rgba8& pixel : image.pixels)
    for (int c = 0; c < 3; ++c) pixel[c] = std::uint8_t(text.get());
  return text ? image : ColourImage();
}

TEST(Library, InstalledServesTheExamplesWhoseFramesAreTheCommandLines) {
  const SampleProject project("installed");
  ASSERT_EQ(project.made().exitCode, 0) << project.made().errors;
  const auto at = [&](const char* name) { return (project.folder() / name).string(); };
  const auto run = [](const std::vector<std::string>& arguments) {
    const auto result = runProcess(arguments);
    EXPECT_EQ(result.exitCode, 0) << arguments.front() << ": " << result.output << result.errors;
    return result.exitCode == 0;
  };
  const auto refused = acentric({"export", project.file(), "--to", "bundle", at("bundle")});
  EXPECT_EQ(refused.exitCode, 1);
  EXPECT_NE(refused.errors.find("acentric bake " + project.file()), std::string::npos) << refused.errors;
  ASSERT_TRUE(run({ACENTRIC_PROGRAM, "bake", project.file()}));
  ASSERT_TRUE(run({ACENTRIC_PROGRAM, "export", project.file(), "--to", "bundle", "--colour-quality", "100",
                   at("bundle")}));
  ASSERT_TRUE(run({ACENTRIC_PROGRAM, "render", project.file(), "--renderer", "list", "--eye", "-3,-0.5", "-o",
                   at("expected.png")}));
  const auto expected = readColourImage(at("expected.png"));
  ASSERT_TRUE(expected);

  ASSERT_TRUE(run({ACENTRIC_CMAKE, "--install", ACENTRIC_BUILD_FOLDER, "--prefix", at("prefix"),
                   "--component", "library"}));
  const std::string lib = at("prefix") + "/lib", pkgConfig = lib + "/pkgconfig";
  const std::string source = std::string(ACENTRIC_EXAMPLES) + "/frame.c";
  ASSERT_TRUE(run({"sh", "-c",
                   "export PKG_CONFIG_PATH=" + pkgConfig + "; cc -std=c99 -Wall -Wextra -Wpedantic -Werror " +
                       source + " $(pkg-config --cflags --libs acentric-runtime) -o " + at("frame")}));
  ASSERT_TRUE(
      run({"env", "LD_LIBRARY_PATH=" + lib, at("frame"), at("bundle"), at("frame.ppm"), "-3", "-0.5", "0"}));
  EXPECT_EQ(ppm(at("frame.ppm")).pixels, expected->pixels) << "found by pkg-config";

  ASSERT_TRUE(run(
      {ACENTRIC_CMAKE, "-S", ACENTRIC_EXAMPLES, "-B", at("built"), "-DCMAKE_PREFIX_PATH=" + at("prefix")}));
  ASSERT_TRUE(run({ACENTRIC_CMAKE, "--build", at("built")}));
  ASSERT_TRUE(run({at("built") + "/frame", at("bundle"), at("built.ppm")}));

  // Drawn by OpenGL from the library's models: edges are where the library draws them.
  ASSERT_TRUE(run({ACENTRIC_PROGRAM, "export", project.file(), "--to", "walk", "--colour-quality", "100",
                   at("gallery.acentric")}));
  ASSERT_TRUE(run({"xvfb-run", "-a", "-s", "-screen 0 1280x1024x24", at("built") + "/window",
                   at("gallery.acentric"), at("window.ppm")}));
  const ColourImage window = ppm(at("window.ppm")), frame = ppm(at("built.ppm"));
  ASSERT_EQ(window.width, frame.width);
  ASSERT_EQ(window.height, frame.height);
  EXPECT_GT(psnrOf(window, frame), 20) << "of captures of one sample per degree";

  // The same within the programs, which need no library of Acentric's.
  const auto alone = [&](const std::string& program) {
    const auto needed = runProcess({"ldd", program});
    EXPECT_EQ(needed.exitCode, 0) << needed.errors;
    EXPECT_NE(needed.output.find("libstdc++"), std::string::npos) << needed.output;
    return needed.output.find("acentric_runtime") == std::string::npos;
  };
  const std::string compile = "; cc -std=c99 " + source + " $(pkg-config --cflags acentric-runtime) ";
  const auto link = [&](const std::string& libraries, const std::string& program) {
    return run({"sh", "-c",
                "export PKG_CONFIG_PATH=" + pkgConfig + compile + "$(pkg-config --libs " + libraries +
                    ") -o " + program});
  };
  ASSERT_TRUE(link("acentric-runtime-static", at("static")));
  EXPECT_TRUE(alone(at("static")));
  ASSERT_TRUE(run({at("static"), at("bundle"), at("static.ppm"), "-3", "-0.5", "0"}));
  EXPECT_EQ(ppm(at("static.ppm")).pixels, expected->pixels);
  ASSERT_TRUE(run({ACENTRIC_CMAKE, "-S", ACENTRIC_EXAMPLES, "-B", at("built-static"),
                   "-DCMAKE_PREFIX_PATH=" + at("prefix"), "-DACENTRIC_STATIC=ON"}));
  ASSERT_TRUE(run({ACENTRIC_CMAKE, "--build", at("built-static")}));
  EXPECT_TRUE(alone(at("built-static") + "/frame"));
  ASSERT_TRUE(run({at("built-static") + "/frame", at("bundle"), at("built-static.ppm")}));
  EXPECT_EQ(ppm(at("built-static.ppm")).pixels, ppm(at("built.ppm")).pixels);

  ASSERT_TRUE(run({"env", "ACENTRIC_RUNTIME=" + lib + "/libacentric_runtime.so.1",
                   "PYTHONDONTWRITEBYTECODE=1", "PYTHONPATH=" ACENTRIC_SOURCES "/python", ACENTRIC_PYTHON,
                   std::string(ACENTRIC_EXAMPLES) + "/frame.py", at("bundle"), at("python.ppm")}));
  EXPECT_FALSE(ppm(at("built.ppm")).empty());
  EXPECT_EQ(ppm(at("python.ppm")).pixels, ppm(at("built.ppm")).pixels) << "both from where the walk begins";

  // Where there is no shared library, the plain name is the archive's.
  for (const char* name : {"libacentric_runtime.so", "libacentric_runtime.so.1"})
    ASSERT_TRUE(std::filesystem::remove(lib + "/" + name));
  ASSERT_TRUE(link("--static acentric-runtime", at("only")));
  EXPECT_TRUE(alone(at("only")));
}

/// The commands of a document, as they stand in its blocks ```sh.
std::string commandsOf(const std::filesystem::path& document) {
  std::istringstream lines(readText(document).value_or(""));
  std::string commands;
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```"))
      inside = line == "```sh";
    else if (inside)
      commands += line + "\n";
  }
  return commands;
}

TEST(Library, IsInstalledLinkedAndRunByTheVeryCommandsOfItsDocument) {
  namespace fs = std::filesystem;
  const fs::path sources = ACENTRIC_SOURCES;
  if (fs::path(ACENTRIC_BUILD_FOLDER) != sources / "build" / "release")
    GTEST_SKIP() << "./run builds in build/release, which is not where this test was built";
  const SampleProject project("documented");
  ASSERT_EQ(project.made().exitCode, 0) << project.made().errors;
  const fs::path home = project.folder() / "home", here = project.folder() / "sources";
  const auto baked = acentric({"bake", project.file()});
  ASSERT_EQ(baked.exitCode, 0) << baked.errors;
  fs::create_directory(home);
  fs::create_directory(here);
  const auto exported =
      acentric({"export", project.file(), "--to", "bundle", (here / "walk-bundle").string()});
  ASSERT_EQ(exported.exitCode, 0) << exported.errors;
  // The sources, as one stands in them; what the commands make stays out of them.
  for (const char* name : {"run", "examples", "python"}) fs::create_symlink(sources / name, here / name);

  const std::string commands = commandsOf(sources / "docs" / "runtimes.md");
  for (const char* expected : {"./run install", "cc examples/frame.c", "acentric-runtime-static",
                               "cmake -S examples", "pip install", "frame.py"})
    ASSERT_NE(commands.find(expected), std::string::npos) << "the document no longer says: " << expected;
  // Nothing of the surroundings helps: neither search paths for libraries, pkg-config and Python's packages
  // nor an index of them. Python is Debian's.
  const std::string script =
      "cd \"$1\" && export HOME=\"$2\" PATH=\"/usr/bin:$PATH\" PIP_NO_INDEX=1 && set -ex\n" + commands;
  const auto followed =
      runProcess({"env", "-u", "LD_LIBRARY_PATH", "-u", "PKG_CONFIG_PATH", "-u", "PYTHONPATH", "bash", "-c",
                  script, "bash", here.string(), home.string()});
  ASSERT_EQ(followed.exitCode, 0) << followed.output << followed.errors;
  EXPECT_FALSE(ppm(here / "frame.ppm").empty());
  for (const char* name : {"bin/acentric", "bin/acentric-editor", "libexec/acentric/acentric-importer",
                           "libexec/acentric/acentric-image-files.so", "lib/libacentric_runtime.so.1",
                           "share/acentric/web/index.html"})
    EXPECT_TRUE(fs::exists(home / "acentric" / name)) << name;
  const auto version = runProcess({(home / "acentric/bin/acentric").string(), "--version"});
  EXPECT_EQ(version.exitCode, 0) << version.errors;
}

#endif

}  // namespace
}  // namespace acentric::test
