#include "ui/translate.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <boost/locale/gnu_gettext.hpp>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <fstream>
#include <iterator>
#include <locale>
#include <memory>
#include <optional>
#include <vector>

namespace acentric {
namespace {

namespace fs = std::filesystem;
using Messages = boost::locale::message_format<char>;

constexpr std::array<Language, 3> kLanguages = {{{"en", "English"}, {"de", "Deutsch"}, {"ja", "日本語"}}};
constexpr std::size_t kLargestCatalogue = std::size_t(16) << 20;

struct Catalogue {
  std::string code;
  fs::path file;
  std::string texts;
  std::locale owner;  ///< of `messages`
  const Messages* messages = nullptr;
};

/// Null: English.
std::atomic<const Catalogue*> current{nullptr};

/// Each language's is read once and kept: texts of it may still be shown.
std::vector<std::unique_ptr<const Catalogue>>& known() {
  static std::vector<std::unique_ptr<const Catalogue>> all;
  return all;
}

std::uint32_t numberAt(const std::vector<char>& file, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, file.data() + at, sizeof value);
  return value;
}

/// Every text of a compiled catalogue lies within the file and ends with a zero; the translated ones after
/// each other. Nothing if that is not so. https://www.gnu.org/software/gettext/manual/html_node/MO-Files.html
std::optional<std::string> textsOf(const std::vector<char>& file) {
  constexpr std::uint32_t kMagic = 0x950412de;
  constexpr std::size_t kHeader = 28, kEntry = 8;
  if (file.size() < kHeader || numberAt(file, 0) != kMagic || numberAt(file, 4) >> 16U != 0)
    return std::nullopt;
  const std::size_t count = numberAt(file, 8);
  std::string texts;
  for (const bool translation : {false, true}) {
    const std::size_t table = numberAt(file, translation ? 16 : 12);
    if (table > file.size() || count > (file.size() - table) / kEntry) return std::nullopt;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t length = numberAt(file, table + i * kEntry);
      const std::size_t at = numberAt(file, table + i * kEntry + 4);
      if (at >= file.size() || length >= file.size() - at || file[at + length] != 0) return std::nullopt;
      if (translation && i > 0) texts.append(file.data() + at, length);  // the first is the header
    }
  }
  return count == 0 ? std::nullopt : std::optional(texts);
}

std::vector<char> readCatalogue(const fs::path& file) {
  std::error_code error;
  const auto size = fs::file_size(file, error);
  std::ifstream stream(file, std::ios::binary);
  if (error || size > kLargestCatalogue || !stream) return {};
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Null: it is damaged.
std::unique_ptr<const Catalogue> makeCatalogue(const std::string& code, const fs::path& path) {
  std::vector<char> file = readCatalogue(path);
  const auto texts = textsOf(file);
  if (!texts) return nullptr;
  std::memset(file.data() + 20, 0, 4);  // the hash table, which need not be there, is not relied on
  boost::locale::gnu_gettext::messages_info info;
  info.language = code;
  info.encoding = "UTF-8";
  info.paths = {"."};
  info.domains = {boost::locale::gnu_gettext::messages_info::domain("acentric")};
  info.callback = [&file](const std::string&, const std::string&) { return file; };
  try {
    auto catalogue = std::make_unique<Catalogue>();
    catalogue->code = code;
    catalogue->file = path;
    catalogue->texts = *texts;
    Messages* const messages = boost::locale::gnu_gettext::create_messages_facet<char>(info);
    catalogue->owner = std::locale(std::locale::classic(), messages);
    catalogue->messages = messages;
    return catalogue;
  } catch (const std::exception&) {
    return nullptr;
  }
}

const char* find(const char* context, const char* english) {
  const Catalogue* catalogue = current.load(std::memory_order_acquire);
  if (catalogue == nullptr || *english == '\0') return english;  // the key "" is the catalogue's header
  const char* const found = catalogue->messages->get(0, context, english);
  return found != nullptr ? found : english;
}

/// "de_AT.UTF-8@euro" -> "de"
std::string_view codeOf(std::string_view locale) { return locale.substr(0, locale.find_first_of("_.@")); }

/// The conversions of a pattern of printf after each other: "%d of %.1f %%" -> "%d%.1f%%"
std::string conversionsOf(std::string_view pattern) {
  std::string conversions;
  for (std::size_t at = pattern.find('%'); at < pattern.size(); at = pattern.find('%', at)) {
    const std::size_t end =
        std::min(pattern.find_first_not_of("0123456789.lz+-# *", at + 1), pattern.size() - 1);
    conversions += pattern.substr(at, end + 1 - at);
    at = end + 1;
  }
  return conversions;
}

}  // namespace

const char* tr(const char* english) { return find(nullptr, english); }
const char* trPrintf(const char* english) {
  const char* const text = tr(english);
  return conversionsOf(text) == conversionsOf(english) ? text : english;
}
std::string tr(const std::string& english) { return find(nullptr, english.c_str()); }
const char* trIn(const char* context, const char* english) { return find(context, english); }

std::string translated(const char* english, fmt::format_args values) {
  const char* const text = tr(english);
  if (text != english) try {
      return fmt::vformat(text, values);
    } catch (const fmt::format_error&) {  // the catalogue's fault, not the caller's
    }
  return fmt::vformat(english, values);
}

std::string translated(const char* one, const char* many, std::uint64_t count, fmt::format_args values) {
  if (const Catalogue* catalogue = current.load(std::memory_order_acquire); catalogue != nullptr) try {
      constexpr std::uint64_t kPeriod = 1'000'000;  // no language tells larger numbers apart
      const int form = int(count < kPeriod ? count : kPeriod + count % kPeriod);
      if (const char* const text = catalogue->messages->get(0, nullptr, one, form); text != nullptr)
        return fmt::vformat(text, values);
    } catch (const fmt::format_error&) {
    }
  return fmt::vformat(count == 1 ? one : many, values);
}

std::span<const Language> languages() { return kLanguages; }

bool isLanguage(std::string_view code) {
  for (const Language& each : kLanguages)
    if (code == each.code) return true;
  return false;
}

std::string systemLanguage(const std::function<const char*(const char*)>& variable) {
  const auto valueOf = [&](const char* name) {
    const char* const value = variable(name);
    return std::string(value != nullptr ? value : "");
  };
  std::string locale;
  for (const char* name : {"LC_ALL", "LC_MESSAGES", "LANG"})
    if (locale.empty()) locale = valueOf(name);
  if (locale == "C" || locale == "POSIX") return "en";
  const std::string list = valueOf("LANGUAGE") + ":" + locale;
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t end = std::min(list.find(':', begin), list.size());
    const std::string code(codeOf(std::string_view(list).substr(begin, end - begin)));
    if (isLanguage(code)) return code;
    begin = end + 1;
  }
  return "en";
}

std::string systemLanguage() {
  return systemLanguage([](const char* name) { return std::getenv(name); });
}

fs::path catalogueFolder() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  return (program.parent_path() / "../share/locale").lexically_normal();
}

tl::expected<void, std::string> setLanguage(const std::string& code, const fs::path& folder) {
  current = nullptr;
  if (code == "en") return {};
  const fs::path file = folder / code / "LC_MESSAGES" / "acentric.mo";
  for (const auto& catalogue : known())
    if (catalogue->file == file) {
      current = catalogue.get();
      return {};
    }
  std::error_code error;
  if (!isLanguage(code) || !fs::is_regular_file(file, error))
    return tl::unexpected(
        fmt::format("There are no texts for the language \"{}\": {} is missing; install the program anew",
                    code, file.string()));
  auto catalogue = makeCatalogue(code, file);
  if (!catalogue)
    return tl::unexpected(
        fmt::format("{}: the catalogue of texts is damaged; install the program anew", file.string()));
  current = known().emplace_back(std::move(catalogue)).get();
  return {};
}

std::string language() {
  const Catalogue* catalogue = current;
  return catalogue == nullptr ? "en" : catalogue->code;
}

std::string catalogueTexts() {
  const Catalogue* catalogue = current;
  return catalogue == nullptr ? std::string() : catalogue->texts;
}

}  // namespace acentric
