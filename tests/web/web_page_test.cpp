#include "engine/export/web_page.h"

#include <gtest/gtest.h>

#include "engine/base/file.h"
#include "tests/store/temporary_folder.h"

namespace acentric {
namespace {

namespace fs = std::filesystem;

class WebPageTest : public FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    write("page/index.html",
          "<head><script defer src=\"./viewer.js\"></script>\n<link rel=\"stylesheet\" "
          "href=\"./viewer.css\"></head>"
          "<title>Acentric walk</title><main></main>");
    write("page/viewer.js", "const text = '</script>';");
    write("page/viewer.css", "p { margin: 0 }");
    write("bundle/bundle.json", "{}");
    write("bundle/captures/ab.pack", std::string("\0\1\2\3", 4));
  }
  void write(const std::string& name, const std::string& text) {
    fs::create_directories((folder_ / name).parent_path());
    writeQuickly(folder_ / name, std::as_bytes(std::span(text)));
  }
  std::string read(const fs::path& file) {
    const auto text = readText(file);
    EXPECT_TRUE(text) << text.error().describe();
    return text.value_or("");
  }
};

TEST_F(WebPageTest, IsFoundInTheInstallTreeAndInTheBuildTree) {
  fs::create_directories(folder_ / "share/acentric");
  fs::create_directories(folder_ / "sources/web");
  const auto missing = findWebPage(folder_ / "bin/acentric");
  ASSERT_FALSE(missing);
  EXPECT_NE(missing.error().describe().find("npm run build"), std::string::npos);
  fs::copy(folder_ / "page", folder_ / "share/acentric/web", fs::copy_options::recursive);
  const auto installed = findWebPage(folder_ / "bin/acentric");
  ASSERT_TRUE(installed);
  EXPECT_EQ(*installed, folder_ / "share/acentric/web");
  fs::copy(folder_ / "page", folder_ / "sources/web/dist", fs::copy_options::recursive);
  const auto built = findWebPage(folder_ / "sources/build/release/bin/acentric");
  ASSERT_TRUE(built);
  EXPECT_EQ(*built, folder_ / "sources/web/dist");
  fs::remove(folder_ / "sources/web/dist/viewer.js");
  EXPECT_FALSE(findWebPage(folder_ / "sources/build/release/bin/acentric"));
}

TEST_F(WebPageTest, LiesBesideTheBundle) {
  ASSERT_TRUE(addWebPage(folder_ / "page", folder_ / "bundle", {"House <\"A & B\">", "poster.jpg", {}}));
  for (const char* file : {"viewer.js", "viewer.css"})
    EXPECT_EQ(read(folder_ / "bundle" / file), read(folder_ / "page" / file));
  const std::string html = read(folder_ / "bundle" / "index.html");
  for (const char* part : {"<title>House &lt;&quot;A &amp; B&quot;&gt; – walk</title>",
                           "<meta property=\"og:title\" content=\"House &lt;&quot;A &amp; B&quot;&gt;\" />",
                           "<meta property=\"og:image\" content=\"poster.jpg\" />"})
    EXPECT_NE(html.find(part), std::string::npos) << part << "\n" << html;
}

TEST_F(WebPageTest, NamesTheWalkThatItOpens) {
  ASSERT_TRUE(addWebPage(folder_ / "page", folder_ / "bundle", {"walk", {}, "a & b.acentric"}));
  EXPECT_NE(read(folder_ / "bundle" / "index.html")
                .find("<meta name=\"acentric-walk\" content=\"a &amp; b.acentric\" />"),
            std::string::npos);
}

TEST_F(WebPageTest, HoldsTheBundleAsOneFile) {
  const fs::path file = folder_ / "walk.html";
  const auto size = writeSingleFile(folder_ / "page", folder_ / "bundle", file, {"walk", {}, {}});
  ASSERT_TRUE(size) << size.error().describe();
  EXPECT_EQ(*size, fs::file_size(file));
  EXPECT_EQ(
      read(file),
      "<head>\n<style>p { margin: 0 }</style></head><title>walk – walk</title>\n    <meta "
      "name=\"description\" "
      "content=\"A walk through walk\" />\n    <meta property=\"og:title\" content=\"walk\" />\n    <meta "
      "property=\"og:type\" content=\"website\" /><main></main>\n"
      "<script type=\"application/octet-stream\" data-file=\"bundle.json\">e30=</script>\n"
      "<script type=\"application/octet-stream\" data-file=\"captures/ab.pack\">AAECAw==</script>\n"
      "<script>const text = '<\\/script>';</script>");
}

TEST_F(WebPageTest, OfAnotherMakeIsRefused) {
  write("page/index.html", "<title>Acentric walk</title><main></main>");
  const auto written =
      writeSingleFile(folder_ / "page", folder_ / "bundle", folder_ / "walk.html", {"walk", {}, {}});
  ASSERT_FALSE(written);
  EXPECT_NE(written.error().describe().find("npm run build"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder_ / "walk.html"));
}

}  // namespace
}  // namespace acentric
