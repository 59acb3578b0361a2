#include "engine/export/web_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "engine/base/file.h"
#include "engine/base/html_text.h"

namespace acentric {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kScript = R"(<script defer src="./viewer.js"></script>)";
constexpr std::string_view kStyle = R"(<link rel="stylesheet" href="./viewer.css">)";
constexpr std::string_view kEnd = "</main>";
constexpr std::string_view kTitle = "<title>Acentric walk</title>";

std::string base64(std::span<const std::byte> bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t there = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k) word = word << 8 | (k < there ? std::uint32_t(bytes[i + k]) : 0);
    for (std::size_t k = 0; k < 4; ++k) text += k <= there ? kDigits[word >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

/// What a script element may not hold.
std::string escaped(std::string script) {
  constexpr std::string_view kClose = "</script";
  for (std::size_t at = script.find(kClose); at != std::string::npos; at = script.find(kClose, at + 2))
    script.insert(at + 1, "\\");
  return script;
}

/// Of a bundle, by name with '/', sorted.
Result<std::vector<std::string>> filesOf(const fs::path& bundle) {
  std::vector<std::string> names;
  std::error_code error;
  fs::recursive_directory_iterator entries(bundle, error);
  for (const fs::recursive_directory_iterator end; !error && entries != end; entries.increment(error))
    if (entries->is_regular_file(error))
      names.push_back(fs::relative(entries->path(), bundle).generic_string());
  if (error) return fail(ErrorKind::unreadable, error.message(), bundle.string());
  std::ranges::sort(names);
  return names;
}

Status replaceOnce(std::string& text, std::string_view what, const std::string& by, const fs::path& file) {
  const std::size_t at = text.find(what);
  if (at == std::string::npos)
    return fail(ErrorKind::malformed,
                fmt::format("has no {}: build the page again with `npm run build` in web/", what),
                file.string());
  text.replace(at, what.size(), by);
  return {};
}

/// Of Open Graph (ogp.me), which those read who show addresses.
Status setTitle(std::string& html, const PageTitle& title, const fs::path& file) {
  const std::string name = htmlText(title.name);
  std::string head = fmt::format(
      "<title>{0} – walk</title>\n    <meta name=\"description\" content=\"A walk through {0}\" />\n    "
      "<meta "
      "property=\"og:title\" content=\"{0}\" />\n    <meta property=\"og:type\" content=\"website\" />",
      name);
  if (!title.poster.empty())
    head += fmt::format("\n    <meta property=\"og:image\" content=\"{}\" />", htmlText(title.poster));
  if (!title.walk.empty())
    head += fmt::format("\n    <meta name=\"acentric-walk\" content=\"{}\" />", htmlText(title.walk));
  return replaceOnce(html, kTitle, head, file);
}

}  // namespace

Result<fs::path> findWebPage(const fs::path& program) {
  const fs::path folder = program.parent_path();
  for (const char* place : {"../share/acentric/web", "../../../web/dist"}) {
    const fs::path page = (folder / place).lexically_normal();
    std::error_code error;
    if (std::ranges::all_of(kPageFiles,
                            [&](const char* file) { return fs::is_regular_file(page / file, error); }))
      return page;
  }
  return fail(
      ErrorKind::notFound,
      fmt::format("the viewer's page is not built: run `npm ci && npm run build` in the folder web of the "
                  "sources (./run web does so), or install it to {}",
                  (folder / "../share/acentric/web").lexically_normal().string()),
      (folder / "../../../web/dist").lexically_normal().string());
}

Status addWebPage(const fs::path& page, const fs::path& bundle, const PageTitle& title) {
  for (const std::string_view file : kPageFiles) {
    auto text = readText(page / file);
    if (!text) return tl::unexpected(text.error());
    if (file == "index.html")
      if (Status set = setTitle(*text, title, page / file); !set) return set;
    if (Status written = writeTextAtomically(bundle / file, *text); !written) return written;
  }
  return {};
}

Result<std::uint64_t> writeSingleFile(const fs::path& page, const fs::path& bundle, const fs::path& output,
                                      const PageTitle& title) {
  auto html = readText(page / "index.html");
  if (!html) return tl::unexpected(html.error());
  const auto script = readText(page / "viewer.js"), style = readText(page / "viewer.css");
  if (!script) return tl::unexpected(script.error());
  if (!style) return tl::unexpected(style.error());
  const auto names = filesOf(bundle);
  if (!names) return tl::unexpected(names.error());

  std::string data;
  for (const std::string& name : *names) {
    const auto bytes = readFile(bundle / name);
    if (!bytes) return tl::unexpected(bytes.error());
    data += fmt::format("<script type=\"application/octet-stream\" data-file=\"{}\">{}</script>\n", name,
                        base64(*bytes));
    if (data.size() > kLargestSingleFile)
      return fail(
          ErrorKind::tooLarge,
          fmt::format("would be larger than the {} MB that browsers open: export a folder, or bake fewer "
                      "samples per degree",
                      kLargestSingleFile >> 20),
          output.string());
  }
  const fs::path index = page / "index.html";
  if (Status set = setTitle(*html, title, index); !set) return tl::unexpected(set.error());
  if (Status done = replaceOnce(*html, kScript, "", index); !done) return tl::unexpected(done.error());
  if (Status done = replaceOnce(*html, kStyle, "<style>" + *style + "</style>", index); !done)
    return tl::unexpected(done.error());
  const std::string end = fmt::format("{}\n{}<script>{}</script>", kEnd, data, escaped(*script));
  if (Status done = replaceOnce(*html, kEnd, end, index); !done) return tl::unexpected(done.error());
  if (Status written = writeTextAtomically(output, *html); !written) return tl::unexpected(written.error());
  return html->size();
}

}  // namespace acentric
